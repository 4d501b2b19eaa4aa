#include "core/spectral_field.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/chebyshev_rule.hpp"
#include "core/memory_functions.hpp"

namespace rollres {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_tail_terms = 4000, most_mixed_tail_terms = 300;

/// sum c_k T_k(t), and with `first` = 1 sum c_k T_{k+1}(t), ...; beyond |t| = 1 the field's continuation.
double image_sum(const VectorXd& c, double t, Index first) {
  if (std::abs(t) > 1) {
    const double root = std::sqrt((std::abs(t) - 1) * (std::abs(t) + 1));
    const double factor = std::copysign(1 / (std::abs(t) + root), t);
    double power = std::pow(factor, static_cast<double>(first)), sum = 0;
    for (Index k = 0; k < c.size(); ++k, power *= factor) sum += c(k) * power;
    return sum;
  }
  const double angle = std::acos(t);
  double before = std::cos(static_cast<double>(first - 1) * angle), here = std::cos(static_cast<double>(first) * angle);
  double sum = 0;
  for (Index k = 0; k < c.size(); ++k) {
    sum += c(k) * here;
    const double next = 2 * t * here - before;
    before = here;
    here = next;
  }
  return sum;
}

/// sqrt(1 - t^2) sum c_k U_{first+k-1}(t) = sum c_k sin((first + k) angle)
double density_sum(const VectorXd& c, double t, Index first) {
  if (!(std::abs(t) < 1)) return 0;
  const double angle = std::acos(t);
  double before = std::sin(static_cast<double>(first - 1) * angle), here = std::sin(static_cast<double>(first) * angle);
  double sum = 0;
  for (Index k = 0; k < c.size(); ++k) {
    sum += c(k) * here;
    const double next = 2 * t * here - before;
    before = here;
    here = next;
  }
  return sum;
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
    const Index count = series.size() - order - 1;
    if (tails.left.size() < count) tails.left.conservativeResizeLike(VectorXd::Zero(count));
    tails.left.head(count) += series.tail(count);
  }
  return tails;
}

SpectralField::SpectralField(const SpectralProblem& problem, const SpectralState& state)
    : problem_(problem),
      state_(state),
      friction_(state.pattern.shear ? problem.scene.friction_coefficient : 0),
      contact_tails_(tails_of(problem, state.pressure, state.edges.contact.half_length())) {
  for (std::size_t z = 0; z < state.sticks.size(); ++z)
    stick_tails_.push_back(tails_of(problem, state.sticks[z], state.edges.sticks[z].half_length()));
  if (state.pattern.shear)
    base_.emplace(state.pattern, state.edges, static_cast<int>(state.pressure.coefficients.size() + mixed_tail().size()),
                  state.sticks.empty() ? 0 : static_cast<int>(state.sticks.front().coefficients.size()));
}

/// What of the pressure's tails a base of several directions mixes into other places, as coefficients.
VectorXd SpectralField::mixed_tail() const {
  if (state_.pattern.one_direction()) return {};
  return 2 * contact_tails_.left.head(std::min<Index>(contact_tails_.left.size(), most_mixed_tail_terms));
}

double SpectralField::tail_density(const Tails& tails, double t) const {
  if (tails.left.size() == 0) return 0;
  return 2 * density_sum(tails.left, t, tails.kept.size());
}

double SpectralField::tail_image(const Tails& tails, double t) const {
  if (tails.left.size() == 0) return 0;
  if (std::abs(t) > 1) return image_sum(tails.left, t, tails.kept.size());
  double sum = -image_sum(tails.kept, t, 0);
  for (Index j = 0; j < tails.rates.size(); ++j) sum += tails.amplitudes(j) * std::exp(tails.rates(j) * (t - 1));
  return sum;
}

double SpectralField::pressure(double x) const {
  const double t = place_in(state_.edges.contact, x);
  return density_sum(state_.pressure.coefficients, t, 1) + tail_density(contact_tails_, t);
}

double SpectralField::shear(double x) const {
  if (!state_.pattern.shear) return 0;
  double sum = friction_ * base_->direction(x) * pressure(x);
  for (std::size_t z = 0; z < state_.sticks.size(); ++z) {
    const double t = place_in(state_.edges.sticks[z], x);
    if (std::abs(t) < 1)
      sum += density_sum(state_.sticks[z].coefficients, t, 1) - tail_density(stick_tails_[z], t);
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

SpectralField::Slopes SpectralField::elastic_slopes(double x) const {
  const double t = place_in(state_.edges.contact, x);
  const double tail = tail_image(contact_tails_, t);
  const VectorXd& phi = state_.pressure.coefficients;
  Slopes g{0.5 * image_sum(phi, t, 1) + tail, 0};
  if (state_.pattern.shear) {
    const Eigen::RowVectorXd slope = base_->slope(x);
    const double m = base_->direction(x);
    g.u = friction_ * (slope.head(phi.size()).dot(phi) - m * tail);
    const VectorXd mixed = mixed_tail();
    if (mixed.size() > 0)
      g.u += friction_ * (slope.tail(mixed.size()).dot(mixed) + 0.5 * m * image_sum(mixed, t, phi.size() + 1));
    for (std::size_t z = 0; z < state_.sticks.size(); ++z) {
      const double s = place_in(state_.edges.sticks[z], x);
      g.u += tail_image(stick_tails_[z], s) - 0.5 * image_sum(state_.sticks[z].coefficients, s, 1);
    }
  }
  if (problem_.layered())
    for (Index q = 0; q < state_.sources.size(); ++q) {
      const LayerSlopes k = layer_slope_correction(x - state_.sources(q), problem_.thickness);
      g.w -= k(0) * state_.pressure_forces(q) + k(2) * state_.shear_forces(q);
      g.u += k(1) * state_.shear_forces(q) - k(2) * state_.pressure_forces(q);
    }
  return g;
}

namespace {

/// Chebyshev-Lobatto nodes s_k = cos(pi k/last) with everything a panel needs.
struct PanelRule {
  static constexpr int last = 20, count = last + 1;
  ArrayXd s, place, rate;          // nodes, sin(pi s/2), its derivative
  MatrixXd derivative, integral;   // by s; from s = 1
  PanelRule() : s(count), derivative(count, count), integral(count, count) {
    MatrixXd values(count, count), integrals(count, count), slopes(count, count);  // of T_n at nodes
    for (int k = 0; k < count; ++k) {
      const double angle = M_PI * k / last;
      s(k) = std::cos(angle);
      for (int n = 0; n < count; ++n) {
        values(k, n) = std::cos(n * angle);
        const double upper = n == 0 ? std::cos(angle) : n == 1 ? 0.25 * std::cos(2 * angle) : 0;
        const double at_end = n == 0 ? 1 : n == 1 ? 0.25 : 0.5 / (n + 1) - 0.5 / (n - 1);
        integrals(k, n) =
            (n < 2 ? upper : 0.5 * std::cos((n + 1) * angle) / (n + 1) - 0.5 * std::cos((n - 1) * angle) / (n - 1)) -
            at_end;
        slopes(k, n) = k == 0      ? n * n
                       : k == last ? (n % 2 ? 1 : -1) * n * n
                                   : n * std::sin(n * angle) / std::sin(angle);
      }
    }
    const MatrixXd to_series = values.inverse();
    derivative = slopes * to_series;
    integral = integrals * to_series;
    place = (M_PI / 2 * s).sin();
    rate = M_PI / 2 * (M_PI / 2 * s).cos();
    rate(0) = rate(last) = 0;
  }
};

const PanelRule& panel_rule() {
  static const PanelRule rule;
  return rule;
}

}  // namespace

ArrayXd SurfacePanel::integrated(const ArrayXd& values) const {
  const PanelRule& rule = panel_rule();
  return rule.integral * (0.5 * (to - from) * rule.rate * values).matrix();
}

double SurfacePanel::at(const ArrayXd& values, double position) const {
  const PanelRule& rule = panel_rule();
  const double sine = std::clamp((2 * position - from - to) / (to - from), -1.0, 1.0);
  const double s = 2 / M_PI * std::asin(sine);
  double numerator = 0, denominator = 0;
  for (int k = 0; k < PanelRule::count; ++k) {
    if (s == rule.s(k)) return values(k);
    const double weight = (k % 2 ? -1.0 : 1.0) * (k == 0 || k == PanelRule::last ? 0.5 : 1.0) / (s - rule.s(k));
    numerator += weight * values(k);
    denominator += weight;
  }
  return numerator / denominator;
}

std::vector<SurfacePanel> surface_panels(const SpectralProblem& problem, const SpectralState& state,
                                         const SpectralField& field) {
  const Interval& contact = state.edges.contact;
  const double half = contact.half_length();
  std::vector<SurfacePanel> panels;
  // Ends at which tractions or slopes have roots of the distance, and layers as thin as the shortest memory.
  std::vector<double> ends{contact.from, contact.to};
  for (const Interval& stick : state.edges.sticks)
    for (const double end : {stick.from, stick.to})
      if (std::find(ends.begin(), ends.end(), end) == ends.end()) ends.push_back(end);
  std::vector<double> borders = ends;
  double shortest = half, reach = 0.5 * half;
  for (const double length : problem.relaxation_length) shortest = std::min(shortest, length);
  for (const double length : problem.creep_length) reach = std::max(reach, 40 * length);
  if (problem.layered()) reach = std::max(0.5 * half, std::min(reach, layer_reach * problem.thickness));
  for (const double end : ends)
    for (double distance = 0.25 * half; distance > 0.7 * shortest; distance *= 0.25)
      for (const double border : {end - distance, end + distance})
        if (border < contact.to + 0.5 * half) borders.push_back(border);
  // Ahead, as far as the memories reach and the layer moves, in panels that widen with the distance.
  double width = std::min(0.5 * half, problem.layered() ? problem.thickness : half), ahead = 0;
  for (; ahead < reach; width *= 2) borders.push_back(contact.to + (ahead += width));
  borders.push_back(contact.from - 0.5 * half);
  borders.push_back(contact.from - 1.5 * half);
  // In contact: a number of the coefficients' oscillations for each panel, at most.
  const auto order =
      static_cast<double>(state.pressure.coefficients.size());
  const int parts = 1 + static_cast<int>(M_PI * order / 14);
  for (int i = 1; i < parts; ++i) borders.push_back(contact.centre() + half * std::cos(M_PI * i / parts));
  std::sort(borders.rbegin(), borders.rend());
  // Of borders that nearly coincide those stay that are ends.
  std::vector<double> kept;
  for (const double border : borders) {
    const bool is_end = std::find(ends.begin(), ends.end(), border) != ends.end();
    if (!kept.empty() && kept.back() - border < 0.2 * std::min(shortest, 0.05 * half)) {
      if (is_end && std::find(ends.begin(), ends.end(), kept.back()) == ends.end()) kept.back() = border;
      if (!is_end || kept.back() == border) continue;
    }
    kept.push_back(border);
  }
  for (std::size_t i = 1; i < kept.size(); ++i) {
    const double from = kept[i], to = kept[i - 1];
    panels.push_back({.zone = field.zone(0.5 * (from + to)), .from = from, .to = to, .x = {}, .weights = {},
                      .pressure = {}, .shear = {}, .slope_w = {}, .slope_u = {}, .gap = {}});
  }

  const PanelRule& rule = panel_rule();
  const Index terms = problem.terms();
  Eigen::ArrayXXd memory = Eigen::ArrayXXd::Zero(terms, 2);  // of w and u at the panel's leading end
  double gap = 0;
  for (SurfacePanel& panel : panels) {
    const double half_panel = 0.5 * (panel.to - panel.from);
    panel.x = 0.5 * (panel.from + panel.to) + half_panel * rule.place;
    panel.x(0) = panel.to;
    panel.x(PanelRule::last) = panel.from;
    panel.weights = -(rule.integral.row(PanelRule::last).transpose().array() * half_panel * rule.rate);
    panel.pressure = panel.shear = ArrayXd::Zero(PanelRule::count);
    MatrixXd elastic(PanelRule::count, 2);
    for (int k = 0; k < PanelRule::count; ++k) {
      const SpectralField::Slopes g = field.elastic_slopes(panel.x(k));
      elastic.row(k) << g.w, g.u;
      if (panel.zone == Zone::free) continue;
      panel.pressure(k) = field.pressure(panel.x(k));
      panel.shear(k) = field.shear(panel.x(k));
    }
    MatrixXd slopes = problem.glassy_compliance * elastic;
    for (Index m = 0; m < terms; ++m) {
      // x'(s) y - T dy/ds = x'(s) g, y given at the leading end.
      const double length = problem.creep_length[static_cast<std::size_t>(m)];
      const ArrayXd rate = half_panel * rule.rate;
      MatrixXd system = -length * rule.derivative;
      system.diagonal().array() += rate;
      MatrixXd right = elastic.array().colwise() * rate;
      system.row(0).setZero();
      system(0, 0) = 1;
      right.row(0) = memory.row(m);
      const MatrixXd y = system.partialPivLu().solve(right);
      slopes += problem.creep_compliance[static_cast<std::size_t>(m)] * y;
      memory.row(m) = y.row(PanelRule::last).array();
    }
    panel.slope_w = slopes.col(0);
    panel.slope_u = slopes.col(1);
    ArrayXd opening(PanelRule::count);
    for (int k = 0; k < PanelRule::count; ++k) opening(k) = problem.slope(panel.x(k)) - panel.slope_w(k);
    panel.gap = gap + panel.integrated(opening);
    gap = panel.gap(PanelRule::last);
    if (panel.from == contact.to) {  // measured from the leading edge
      for (SurfacePanel& other : panels) {
        if (other.gap.size() > 0) other.gap -= gap;
        if (&other == &panel) break;
      }
      gap = 0;
    }
  }
  return panels;
}

}  // namespace rollres
