#include "core/zones/spectral_field.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/contact_surface.hpp"
#include "core/numerics/chebyshev.hpp"
#include "core/numerics/memory_functions.hpp"
#include "core/spectral/graded_tractions.hpp"
#include "core/spectral/spectral_sources.hpp"

namespace rollres {

namespace {

using Eigen::ArrayX2d;
using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_tail_terms = 4000, most_mixed_tail_terms = 300;
constexpr double negligible_power = 1e-30;

/// Places that a processor does side by side.
using Lanes = Eigen::Array<double, 8, 1>;

/// sum c_k h_k of cosines or sines of multiples of acos(t), from the one before the first and the first; at one place
/// or at several.
template <class Value>
Value harmonic_sum(const VectorXd& c, const Value& t, Value before, Value here) {
  Value sum = 0 * t;
  for (Index k = 0; k < c.size(); ++k) {
    sum += c(k) * here;
    const Value next = 2 * t * here - before;
    before = here;
    here = next;
  }
  return sum;
}

/// sum c_k T_{first+k}(t); beyond |t| = 1 the field's continuation.
double image_sum(const VectorXd& c, double t, Index first) {
  if (std::abs(t) > 1) {
    const double root = std::sqrt((std::abs(t) - 1) * (std::abs(t) + 1));
    const double factor = std::copysign(1 / (std::abs(t) + root), t);
    double power = std::pow(factor, static_cast<double>(first)), sum = 0;
    for (Index k = 0; k < c.size() && std::abs(power) > negligible_power; ++k, power *= factor) sum += c(k) * power;
    return sum;
  }
  const double angle = std::acos(t);
  return harmonic_sum(c, t, std::cos(static_cast<double>(first - 1) * angle),
                      std::cos(static_cast<double>(first) * angle));
}

/// sqrt(1 - t^2) sum c_k U_{first+k-1}(t) = sum c_k sin((first + k) angle)
double density_sum(const VectorXd& c, double t, Index first) {
  if (!(std::abs(t) < 1)) return 0;
  const double angle = std::acos(t);
  return harmonic_sum(c, t, std::sin(static_cast<double>(first - 1) * angle),
                      std::sin(static_cast<double>(first) * angle));
}

Lanes density_sum(const VectorXd& c, const Lanes& t, Index first) {
  const Lanes angle = t.max(-1).min(1).acos();
  const Lanes before = (static_cast<double>(first - 1) * angle).sin(),
              here = (static_cast<double>(first) * angle).sin();
  return (t.abs() < 1).select(harmonic_sum(c, t, before, here), 0.0);
}

/// A function of the place in a zone, at places x.
template <class Function>
ArrayXd by_lanes(const Interval& zone, const ArrayXd& x, const Function& function) {
  ArrayXd values(x.size());
  for (Index first = 0; first < x.size(); first += Lanes::SizeAtCompileTime) {
    const Index count = std::min<Index>(x.size() - first, Lanes::SizeAtCompileTime);
    Lanes t = Lanes::Zero();
    for (Index k = 0; k < count; ++k) t(k) = place_in(zone, x(first + k));
    values.segment(first, count) = function(t).head(count);
  }
  return values;
}

}  // namespace

SpectralField::Tails SpectralField::tails_of(const SpectralProblem& problem, const SpectralDensity& density,
                                             double half_length) {
  const Index order = density.coefficients.size();
  Tails tails{.kept = VectorXd::Zero(order + 1), .left = {}, .amplitudes = density.amplitudes, .rates = {}};
  tails.rates.resize(density.amplitudes.size());
  const double scale = density.coefficients.size() > 0 ? density.coefficients.cwiseAbs().maxCoeff() : 0;
  for (Index j = 0; j < density.amplitudes.size(); ++j) {
    const double rate = half_length / problem.relaxation_length[static_cast<std::size_t>(j)];
    tails.rates(j) = rate;
    const int last = std::min(static_cast<int>(order) + 1 + static_cast<int>(9 * std::sqrt(rate)), most_tail_terms);
    VectorXd series = 2 * density.amplitudes(j) * scaled_bessel_i(rate, std::max(last, static_cast<int>(order) + 2));
    series(0) /= 2;
    tails.kept += series.head(order + 1);
    if (std::abs(series(order + 1)) < 1e-15 * scale) continue;
    Index count = series.size() - order - 1;
    while (count > 1 && std::abs(series(order + count)) < 1e-17 * scale) --count;
    if (tails.left.size() < count) tails.left.conservativeResizeLike(VectorXd::Zero(count));
    tails.left.head(count) += series.segment(order + 1, count);
  }
  return tails;
}

SpectralField::SpectralField(const SpectralProblem& problem, const SpectralState& state)
    : problem_(problem),
      state_(state),
      friction_(state.pattern.shear ? problem.model.friction_coefficient : 0),
      contact_tails_(state.graded ? Tails{} : tails_of(problem, state.pressure, state.edges.contact.half_length())) {
  if (state.graded) return;
  const VectorXd& phi = state.pressure.coefficients;
  contact_image_ = Image(contact_tails_, 0.5 * phi);
  if (state.pattern.shear) tail_image_ = Image(contact_tails_, VectorXd::Zero(phi.size()));
  const double finest = finest_distance(state.edges.contact, state.pressure.coefficients.size());
  if (problem.layered()) of_surface_ = problem.correction->logarithms(finest);
  if (problem.side && problem.side->layered()) of_side_ = problem.side->correction->logarithms(finest);
  for (std::size_t z = 0; z < state.sticks.size(); ++z) {
    stick_tails_.push_back(tails_of(problem, state.sticks[z], state.edges.sticks[z].half_length()));
    stick_images_.emplace_back(stick_tails_.back(), -0.5 * state.sticks[z].coefficients);
  }
  if (state.pattern.shear)
    base_.emplace(state.pattern, state.edges,
                  static_cast<int>(state.pressure.coefficients.size() + mixed_tail().size()),
                  state.sticks.empty() ? 0 : static_cast<int>(state.sticks.front().coefficients.size()));
}

/// What of the pressure's tails a base of several directions mixes into other places, as coefficients.
VectorXd SpectralField::mixed_tail() const {
  if (state_.pattern.one_direction()) return {};
  return 2 * contact_tails_.left.head(std::min<Index>(contact_tails_.left.size(), most_mixed_tail_terms));
}

template <class Value>
Value SpectralField::tail_density(const Tails& tails, const Value& t) const {
  if (tails.left.size() == 0) return 0 * t;
  return 2 * density_sum(tails.left, t, tails.kept.size());
}

SpectralField::Image::Image(const Tails& tails, const VectorXd& weighted)
    : inside_(-tails.kept),
      outside_(weighted.size() + tails.left.size()),
      amplitudes_(tails.amplitudes),
      rates_(tails.rates) {
  inside_.tail(weighted.size()) += weighted;
  outside_ << weighted, tails.left;
}

ArrayXd SpectralField::Image::at(const Interval& zone, const ArrayXd& x) const {
  return by_lanes(zone, x, [&](const Lanes& t) -> Lanes {
    const Lanes size = t.abs();
    Lanes within = Lanes::Zero(), beyond = Lanes::Zero();
    if (size.minCoeff() <= 1) {
      const Lanes place = t.max(-1).min(1);
      within = harmonic_sum(inside_, place, place, Lanes::Ones().eval());
      for (Index j = 0; j < rates_.size(); ++j) within += amplitudes_(j) * (rates_(j) * (place - 1)).exp();
    }
    if (size.maxCoeff() > 1) {
      const Lanes outer = size.max(1);
      const Lanes factor = (size > 1).select(t.sign() / (outer + ((outer - 1) * (outer + 1)).sqrt()), 0.0);
      const double powers = std::log(negligible_power) / std::log(factor.abs().maxCoeff());
      const Index count = powers < static_cast<double>(outside_.size()) ? static_cast<Index>(powers) : outside_.size();
      Lanes power = factor;
      for (Index k = 0; k < count; ++k, power *= factor) beyond += outside_(k) * power;
    }
    return (size <= 1).select(within, beyond);
  });
}

double SpectralField::pressure(double x) const {
  if (state_.graded) return state_.graded->pressure_at(x);
  const double t = place_in(state_.edges.contact, x);
  return density_sum(state_.pressure.coefficients, t, 1) + tail_density(contact_tails_, t);
}

ArrayXd SpectralField::pressure(const ArrayXd& x) const {
  if (state_.graded) return x.unaryExpr([&](double place) { return state_.graded->pressure_at(place); });
  return by_lanes(state_.edges.contact, x, [&](const Lanes& t) -> Lanes {
    return density_sum(state_.pressure.coefficients, t, 1) + tail_density(contact_tails_, t);
  });
}

double SpectralField::shear(double x) const { return shear(x, pressure(x)); }

ArrayXd SpectralField::shear(const ArrayXd& x, const ArrayXd& pressure_there) const {
  ArrayXd values = ArrayXd::Zero(x.size());
  if (!state_.pattern.shear) return values;
  for (Index k = 0; k < x.size(); ++k)
    values(k) = state_.graded ? state_.graded->shear_at(x(k)) : friction_ * base_->direction(x(k)) * pressure_there(k);
  if (state_.graded) return values;
  for (std::size_t z = 0; z < state_.sticks.size(); ++z)
    values += by_lanes(state_.edges.sticks[z], x, [&](const Lanes& t) -> Lanes {
      return density_sum(state_.sticks[z].coefficients, t, 1) - tail_density(stick_tails_[z], t);
    });
  return values;
}

double SpectralField::shear(double x, double pressure_there) const {
  if (!state_.pattern.shear) return 0;
  if (state_.graded) return state_.graded->shear_at(x);
  double sum = friction_ * base_->direction(x) * pressure_there;
  for (std::size_t z = 0; z < state_.sticks.size(); ++z) {
    const double t = place_in(state_.edges.sticks[z], x);
    if (std::abs(t) < 1) sum += density_sum(state_.sticks[z].coefficients, t, 1) - tail_density(stick_tails_[z], t);
  }
  return sum;
}

Zone SpectralField::zone(double x) const {
  const SpectralEdges& edges = state_.edges;
  if (!(x >= edges.contact.from && x <= edges.contact.to)) return Zone::free;
  for (const Interval& stick : edges.sticks)
    if (x >= stick.from && x <= stick.to) return Zone::stick;
  return Zone::slip;
}

template <class Kernel>
SpectralField::Slopes SpectralField::sum_of_sources(const SpectralProblem& part, double x, Kernel kernel) const {
  const double side = side_of(part);
  Slopes sum{0, 0};
  for (Index q = 0; q < state_.sources.size(); ++q) {
    LayerSlopes k = kernel(x - state_.sources(q));
    k.tail<2>() *= side;
    sum.w -= k(layer_slope::normal) * state_.pressure_forces(q) +
             (k(layer_slope::cross) + k(layer_slope::hoop)) * state_.shear_forces(q);
    sum.u += k(layer_slope::tangential) * state_.shear_forces(q) - k(layer_slope::cross) * state_.pressure_forces(q);
  }
  return sum;
}

SpectralField::Slopes SpectralField::added_slopes(const SpectralProblem& part, double x) const {
  if (!part.layered()) return {0, 0};
  Slopes sum = sum_of_sources(part, x, [&](double r) { return part.correction->slope(r); });
  if (state_.graded) return sum;
  const RingLogarithms& logarithms = &part == problem_.side.get() ? of_side_ : of_surface_;
  if (logarithms.normal.none()) return sum;
  const MissedSlopes missed = missed_slopes(logarithms, state_.runs, state_.sources, x);
  sum.w -= missed.normal.dot(state_.pressure_forces.head(missed.normal.size()));
  if (state_.pattern.shear) sum.w -= side_of(part) * missed.hoop.dot(state_.shear_forces);
  return sum;
}

ArrayX2d SpectralField::deep_slopes(const ArrayXd& x) const {
  ArrayX2d slopes = ArrayX2d::Zero(x.size(), 2);
  if (state_.graded) {
    for (Index k = 0; k < x.size(); ++k) slopes.row(k) = state_.graded->near_slopes(problem_, x(k)).transpose();
    return slopes;
  }
  const Interval& contact = state_.edges.contact;
  slopes.col(0) = contact_image_.at(contact, x);
  if (state_.pattern.shear) {
    const VectorXd &phi = state_.pressure.coefficients, mixed = mixed_tail();
    const ArrayXd tail = tail_image_.at(contact, x);
    for (Index k = 0; k < x.size(); ++k) {
      const Eigen::RowVectorXd slope = base_->slope(x(k));
      const double m = base_->direction(x(k));
      double sum = slope.head(phi.size()).dot(phi) - m * tail(k);
      if (mixed.size() > 0)
        sum +=
            slope.tail(mixed.size()).dot(mixed) + 0.5 * m * image_sum(mixed, place_in(contact, x(k)), phi.size() + 1);
      slopes(k, 1) = friction_ * sum;
    }
    for (std::size_t z = 0; z < state_.sticks.size(); ++z)
      slopes.col(1) += stick_images_[z].at(state_.edges.sticks[z], x);
  }
  if (problem_.deep->cross() != 0) slopes.col(1) += problem_.deep->cross() * pressure(x);
  return slopes;
}

SpectralField::Slopes SpectralField::remembered_ahead(const SpectralProblem& part, std::size_t term, double x) const {
  const double length = part.creep_length[term];
  return sum_of_sources(part, x, [&](double r) -> LayerSlopes {
    LayerSlopes k = part.deep->mean(length, r);
    if (part.layered()) k += part.correction->memory(term, r);
    return k;
  });
}

SpectralField::Slopes SpectralField::displacement_ahead(const SpectralProblem& part, double x) const {
  if (!part.layered() || !has_rigid_base(part.model)) return {0, 0};
  Slopes sum = sum_of_sources(
      part, x, [&](double r) -> LayerSlopes { return part.correction->displacement(r) + part.deep->displacement(r); });
  sum.w *= part.rubbery_compliance;
  sum.u *= part.rubbery_compliance;
  for (std::size_t m = 0; m < part.creep_length.size(); ++m) {
    const Slopes mean = remembered_ahead(part, m, x);
    const double weight = part.creep_compliance[m] * part.creep_length[m];
    sum.w += weight * mean.w;
    sum.u += weight * mean.u;
  }
  return sum;
}

}  // namespace rollres
