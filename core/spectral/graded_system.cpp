#include "core/spectral/graded_system.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/chebyshev.hpp"
#include "core/numerics/dense_algebra.hpp"
#include "core/numerics/memory_functions.hpp"
#include "core/spectral/zoned_system.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// Steps between a place and a node over which the rule is mended for logarithm and jump, and how it fades.
constexpr double mended = 10, fading = 3;

/// What the rule of even steps makes of ln|s| and of the jump at s = 0, against their integrals over the functions that
/// the nodes resolve, at a distance in steps: sources ahead of the place have a positive one.
struct Mend {
  double logarithm, jump;
};

Mend mend(double distance) {
  const double k = std::abs(distance), taper = 0.5 * std::erfc((k - mended) / fading);
  const TrigonometricIntegrals integrals = trigonometric_integrals(M_PI * k);
  const double rest = integrals.sine / M_PI - 0.5;
  return {-taper * integrals.cosine, taper * (distance > 0 ? rest : -rest)};
}

/// The same at odd halves.
const Mend& mend_at_half(Index steps) {  // distance steps + 1/2 >= 0
  static const std::vector<Mend> table = [] {
    std::vector<Mend> values;
    for (int k = 0; k < 40; ++k) values.push_back(mend(k + 0.5));
    return values;
  }();
  return table[static_cast<std::size_t>(std::min<Index>(steps, 39))];
}

class GradedSystem : private ZonedSystem {
 public:
  GradedSystem(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
               const SpectralOrders& orders)
      : ZonedSystem(problem, pattern, edges),
        deep_(*problem.deep),
        grid_(pattern, edges, orders.contact),
        n_(grid_.size()) {
    std::vector<Index> counts;
    for (const GradedZone& zone : grid_.zones()) {
      if (!zone.stick) continue;
      counts.push_back(zone.count);
      stick_zones_.push_back(&zone);
    }
    place_unknowns(n_, counts);
    x_.resize(n_);
    for (Index j = 0; j < n_; ++j) x_(j) = grid_.nodes()[static_cast<std::size_t>(j)].x();
    shear_of_ = MatrixXd::Zero(n_, size_);
    for (const GradedZone& zone : grid_.zones())
      if (!zone.stick)
        for (Index j = zone.first; j < zone.first + zone.count; ++j) shear_of_(j, j) = friction_ * zone.direction;
    for (std::size_t z = 0; z < sticks_.size(); ++z)
      for (Index j = 0; j < sticks_[z].count; ++j) shear_of_(stick_zones_[z]->first + j, sticks_[z].first + j) = 1;
  }

  SpectralState solve() {
    measure_slopes();
    collocate_normal();
    for (std::size_t z = 0; z < sticks_.size(); ++z) collocate_stick(z);
    if (!sticks_.empty()) drive();
    solution_ = SquareSystem(matrix_).solve(right_);
    pressure_ = solution_.head(n_);
    shear_ = shear_of_ * solution_;
    SpectralState state = ZonedSystem::state(approach());
    state.sources = x_;
    state.pressure_forces = grid_.weight().cwiseProduct(pressure_);
    state.shear_forces = grid_.weight().cwiseProduct(shear_);
    state.graded = std::make_shared<const GradedTractions>(
        GradedTractions{grid_, pressure_, shear_, -retarded_normal_ * pressure_ - retarded_cross_ * shear_,
                        retarded_along_ * shear_ - retarded_cross_ * pressure_});
    return state;
  }

 private:
  /// Slopes at the middles by values at nodes: dw/dx under pressure, du/dx under shear, dw/dx under shear and du/dx
  /// under pressure.
  void measure_slopes() {
    const Index rows = n_ + 1;
    MatrixXd poles = MatrixXd::Zero(rows, n_);
    const auto& middles = grid_.middles();
    for (const GradedSource& source : grid_.sources())
      for (Index i = 0; i < rows; ++i)
        poles(i, source.node) += source.weight / middles[static_cast<std::size_t>(i)].less(source.place);
    MatrixXd values = MatrixXd::Zero(rows, n_);
    for (Index i = 0; i < rows; ++i) {
      const GradedStencil stencil = grid_.at_middle(i);
      values.row(i).segment(stencil.first, stencil.weights.size()) = stencil.weights.transpose();
      if (grid_.is_border(i)) poles.row(i) += grid_.left_out_at(i) * values.row(i);
    }
    retarded_normal_ = retarded_along_ = retarded_cross_ = MatrixXd::Zero(rows, n_);
    if (deep_.remembers()) measure_retarded();
    normal_ = deep_.normal() / (2 * M_PI) * poles - retarded_normal_;
    along_ = -deep_.along() / (2 * M_PI) * poles + retarded_along_;
    cross_ = deep_.cross() * values - retarded_cross_;
    if (problem_.layered()) add_layers();
  }

  void measure_retarded() {
    const auto& middles = grid_.middles();
    for (Index j = 0; j < n_; ++j)
      for (Index i = 0; i <= n_; ++i) {
        const double x = middles[static_cast<std::size_t>(i)].less(grid_.nodes()[static_cast<std::size_t>(j)]);
        LayerSlopes k = deep_.slope(x) * grid_.weight()(j);
        // In one zone the sum passes the logarithm and the jump.
        const GradedZone& zone = grid_.zones()[grid_.zone_of(j)];
        if (i > zone.first && i < zone.first + zone.count && std::abs(2 * (j - i) + 1) < 60) {
          const double rate = zone.step * zone.rate(static_cast<double>(j - zone.first) * zone.step - zone.reach);
          const Mend& m = mend_at_half(j >= i ? j - i : i - j - 1);
          const Eigen::Array3d growing = rate * deep_.growing(x);
          k.head<2>() += m.logarithm / (2 * M_PI) * growing.head<2>();
          k(layer_slope::cross) -= (j >= i ? m.jump : -m.jump) * growing(2);
        }
        retarded_normal_(i, j) = k(layer_slope::normal);
        retarded_along_(i, j) = k(layer_slope::tangential);
        retarded_cross_(i, j) = k(layer_slope::cross);
      }
  }

  /// Smooth corrections: between Chebyshev points of the contact where these are fewer.
  void add_layers() {
    const Interval& contact = edges_.contact;
    const double distance = 2 * problem_.correction->depth() / contact.half_length();
    const double rate = std::log(distance + std::sqrt(distance * distance + 1));
    const auto order = static_cast<Index>(std::min(8 + 32 / rate, 400.0));
    VectorXd middles(n_ + 1);
    for (Index i = 0; i <= n_; ++i) middles(i) = grid_.middles()[static_cast<std::size_t>(i)].x();
    if (order >= n_) return add_layers(MatrixXd::Identity(n_ + 1, n_ + 1), middles, x_, MatrixXd::Identity(n_, n_));
    const ChebyshevFit& fit = chebyshev_fit(static_cast<int>(order));
    const VectorXd points = contact.centre() + contact.half_length() * fit.nodes.array();
    const auto to = [&](const VectorXd& x) {
      MatrixXd images(x.size(), order);
      for (Index i = 0; i < x.size(); ++i)
        images.row(i) =
            chebyshev_images(std::clamp(place_in(contact, x(i)), -1.0, 1.0), static_cast<int>(order)).transpose();
      return MatrixXd(images * fit.from_values);
    };
    add_layers(to(middles), points, points, to(x_).transpose());
  }
  void add_layers(const MatrixXd& to, const VectorXd& x, const VectorXd& sources, const MatrixXd& from) {
    MatrixXd normal(x.size(), sources.size()), along = normal, cross = normal;
    for (Index q = 0; q < sources.size(); ++q)
      for (Index i = 0; i < x.size(); ++i) {
        const LayerSlopes k = problem_.correction->slope(x(i) - sources(q));
        normal(i, q) = k(layer_slope::normal);
        along(i, q) = k(layer_slope::tangential);
        cross(i, q) = k(layer_slope::cross);
      }
    const MatrixXd forces = from * grid_.weight().asDiagonal();
    normal_ -= to * normal * forces;
    if (!pattern_.shear) return;
    along_ += to * along * forces;
    cross_ -= to * cross * forces;
  }

  VectorXd middles(Index first, Index count) const {
    VectorXd x(count);
    for (Index i = 0; i < count; ++i) x(i) = grid_.middles()[static_cast<std::size_t>(first + i)].x();
    return x;
  }

  MatrixXd exponentials(const VectorXd& x, double to) const {
    MatrixXd values(x.size(), terms_);
    for (Index j = 0; j < terms_; ++j)
      values.col(j) = ((x.array() - to) / problem_.relaxation_length[static_cast<std::size_t>(j)]).min(1.0).exp();
    return values;
  }

  /// Means R_{T_m} of g_w or g_u at an end of a zone, by unknown.
  MatrixXd means_at(double x, bool of_w) const {
    MatrixXd means = MatrixXd::Zero(terms_, size_);
    if (terms_ == 0) return means;
    RowVectorXd direct(n_), crossed(n_);
    for (Index m = 0; m < terms_; ++m) {
      const auto term = static_cast<std::size_t>(m);
      for (Index j = 0; j < n_; ++j) {
        LayerSlopes k = deep_.mean(problem_.creep_length[term], x - x_(j));
        if (problem_.layered()) k += problem_.correction->memory(term, x - x_(j));
        direct(j) = grid_.weight()(j) * (of_w ? -k(layer_slope::normal) : k(layer_slope::tangential));
        crossed(j) = -grid_.weight()(j) * k(layer_slope::cross);
      }
      if (of_w) {
        means.row(m).head(n_) += direct;
        if (pattern_.shear) means.row(m) += crossed * shear_of_;
      } else {
        means.row(m) += direct * shear_of_;
        means.row(m).head(n_) += crossed;
      }
    }
    return means;
  }
  /// (S7) and (S8) with all slopes.
  void collocate_normal() {
    const VectorXd x = middles(0, n_ + 1);
    matrix_.topLeftCorner(n_ + 1, n_) += normal_;
    if (pattern_.shear) matrix_.topRows(n_ + 1) += cross_ * shear_of_;
    matrix_.block(0, slack_, n_ + 1, 1).setOnes();
    matrix_.block(0, amplitude_, n_ + 1, terms_) -= exponentials(x, edges_.contact.to);
    prescribe_contact(x);
    means_ = means_at(edges_.contact.to, true);
    remember(amplitude_, means_);
  }

  /// (S14) with all slopes.
  void collocate_stick(std::size_t z) {
    const Stick& stick = sticks_[z];
    const Index rows = stick.count + 1, first = stick_zones_[z]->first;
    const VectorXd x = middles(first, rows);
    auto block = matrix_.middleRows(stick.first, rows);
    block += along_.middleRows(first, rows) * shear_of_;
    block.leftCols(n_) += cross_.middleRows(first, rows);
    block.col(stick.slack()).setOnes();
    block.middleCols(stick.amplitude(), terms_) -= exponentials(x, stick.interval.to);
    remember(stick.amplitude(), means_at(stick.interval.to, false));
    prescribe_stick(stick, x);
  }

  RowVectorXd resultant(LeverArm (IndenterShape::*arm)(double, double) const) const override {
    RowVectorXd of_pressure(n_), of_shear(n_);
    for (Index j = 0; j < n_; ++j) {
      const LeverArm at = (problem_.shape.*arm)(x_(j), 0);
      of_pressure(j) = at.of_pressure * grid_.weight()(j);
      of_shear(j) = at.of_shear_x * grid_.weight()(j);
    }
    RowVectorXd row = of_shear * shear_of_;
    row.head(n_) += of_pressure;
    return row;
  }

  double approach() const {
    if (!problem_.layered()) return NAN;
    double w = 0;
    for (Index j = 0; j < n_; ++j) {
      const double x = edges_.contact.to - x_(j);
      const LayerSlopes k = problem_.correction->displacement(x) + deep_.displacement(x);
      w -= grid_.weight()(j) * (k(layer_slope::normal) * pressure_(j) + k(layer_slope::cross) * shear_(j));
    }
    return ZonedSystem::approach(w);
  }

  /// (S33)
  double root_at_leading_end(std::size_t z) const override {
    const GradedZone &stick = *stick_zones_[z], &slip = grid_.zones()[grid_.zone_of(stick.first) + 1];
    const double bound = friction_ * slip.direction;
    const double power = 0.5 + std::atan(2 * deep_.cross() * bound / deep_.normal()) / M_PI;
    const double scale = std::min(stick.interval.to - stick.interval.from, slip.interval.to - slip.interval.from);
    constexpr int fitted = 3;
    MatrixXd powers(fitted, fitted);
    VectorXd roots(fitted);
    Index node = stick.first + stick.count - 1;
    for (int k = 0; k < fitted; ++k) {
      const double wanted = std::exp(2.0 * k - 7);
      const auto distance = [&] { return -grid_.nodes()[static_cast<std::size_t>(node)].offset / scale; };
      while (node > stick.first + fitted - k && distance() < wanted) --node;
      double power_of_distance = 1;
      const double d = distance();
      for (int i = 0; i < fitted; ++i, power_of_distance *= d) powers(k, i) = power_of_distance;
      roots(k) = (shear_(node) - bound * pressure_(node)) / std::pow(d, power);
      --node;
    }
    return SquareSystem(powers).solve(roots)(0) * std::pow((stick.interval.to - stick.interval.from) / scale, power);
  }

  const DeepResponse& deep_;
  GradedGrid grid_;
  Index n_;
  std::vector<const GradedZone*> stick_zones_;
  VectorXd x_, pressure_, shear_;                               // at nodes
  MatrixXd shear_of_;                                           // shear at nodes by unknown
  MatrixXd normal_, along_, cross_;                             // slopes at middles by values at nodes
  MatrixXd retarded_normal_, retarded_along_, retarded_cross_;  // kernels of the retarded parts alone
};

/// Whether every zone of the pattern has a length.
bool has_zones(const SlipPattern& pattern, const SpectralEdges& edges) {
  double at = edges.contact.from;
  for (std::size_t i = 0; i < pattern.sticks(); ++i) {
    const Interval& stick = edges.sticks[i];
    if (!(stick.to > stick.from) || (pattern.slips[i] != 0 && !(stick.from > at))) return false;
    at = stick.to;
  }
  return pattern.sticks() == 0 || pattern.slips.back() == 0 || edges.contact.to > at;
}

}  // namespace

double GradedTractions::value_at(const VectorXd& values, double x) const {
  const GradedZone* zone = grid.zone_at(x);
  if (!zone) return 0;
  const GradedStencil stencil = grid.at(*zone, x);
  return stencil.weights.dot(values.segment(stencil.first, stencil.weights.size()));
}

bool GradedTractions::near_end(double x, double nearest) const {
  const GradedZone* zone = grid.zone_at(x);
  return zone && std::abs(zone->parameter(x)) > zone->reach - nearest;
}

Eigen::Array2d GradedTractions::near_slopes(const SpectralProblem& problem, double x) const {
  const GradedZone* zone = grid.zone_at(x);
  if (!zone) return slopes_between_nodes(problem, nullptr, x);
  const double s = zone->parameter(x), most = zone->reach - 0.5 * zone->step;
  if (std::abs(s) > most) return slopes_between_nodes(problem, zone, zone->place(std::copysign(most, s)).x());
  const double steps = zone->from_first_node(s);
  if (constexpr double near = 1e-4; std::abs(steps - std::round(steps)) < near)  // at a node, from both sides
    return 0.5 * (slopes_between_nodes(problem, zone, zone->place(s - 2 * near * zone->step).x()) +
                  slopes_between_nodes(problem, zone, zone->place(s + 2 * near * zone->step).x()));
  return slopes_between_nodes(problem, zone, x);
}

Eigen::Array2d GradedTractions::slopes_between_nodes(const SpectralProblem& problem, const GradedZone* zone,
                                                     double x) const {
  const DeepResponse& deep = *problem.deep;
  Eigen::Array2d slopes = Eigen::Array2d::Zero();
  for (const GradedSource& source : grid.sources()) {
    const double pole = source.weight / (x - source.place.x());
    slopes += pole * Eigen::Array2d(deep.normal() * pressure(source.node), -deep.along() * shear(source.node));
  }
  slopes /= 2 * M_PI;
  if (!zone) {
    if (deep.remembers())
      for (Index j = 0; j < grid.size(); ++j) {
        const LayerSlopes k = deep.slope(x - grid.nodes()[static_cast<std::size_t>(j)].x()) * grid.weight()(j);
        slopes += Eigen::Array2d(-k(layer_slope::normal) * pressure(j) - k(layer_slope::cross) * shear(j),
                                 k(layer_slope::tangential) * shear(j) - k(layer_slope::cross) * pressure(j));
      }
    return slopes;
  }
  // Between nodes the rule misses a principal value by a cotangent (S32).
  const double steps = zone->from_first_node(zone->parameter(x));
  const double missed = 0.5 / std::tan(M_PI * steps), p = pressure_at(x), q = shear_at(x);
  slopes += missed * Eigen::Array2d(-deep.normal() * p, deep.along() * q) + deep.cross() * Eigen::Array2d(q, p);
  if (deep.remembers()) {
    const GradedStencil stencil = grid.at_from_middles(*zone, x);
    slopes += Eigen::Array2d(stencil.weights.dot(retarded_w.segment(stencil.first, stencil.weights.size())),
                             stencil.weights.dot(retarded_u.segment(stencil.first, stencil.weights.size())));
  }
  return slopes;
}

SpectralState solve_graded(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
                           const SpectralOrders& orders) {
  if (edges.sticks.size() != pattern.sticks() || !has_zones(pattern, edges)) {
    SpectralState nowhere;
    nowhere.residuals.setConstant(pattern.unknowns(), NAN);
    return nowhere;
  }
  return GradedSystem(problem, pattern, edges, orders).solve();
}

double graded_tail(int order) { return std::exp(-2.7 * std::sqrt(order)); }

double graded_field_error(int order) { return 0.1 * std::exp(-0.9 * std::sqrt(order)); }

}  // namespace rollres
