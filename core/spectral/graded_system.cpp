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

/// Steps between a place and a node over which the rule is mended for logarithm and jump, how it fades, and from where
/// on there is nothing left of it.
constexpr double mended = 10, fading = 3;
constexpr Index mended_at_all = 26;

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
const Mend& mend_at_half(Index steps) {  // distance steps + 1/2 >= 0, less than mended_at_all
  static const std::vector<Mend> table = [] {
    std::vector<Mend> values;
    for (Index k = 0; k < mended_at_all; ++k) values.push_back(mend(static_cast<double>(k) + 0.5));
    return values;
  }();
  return table[static_cast<std::size_t>(steps)];
}

class GradedSystem : private ZonedSystem {
 public:
  GradedSystem(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
               const SpectralOrders& orders)
      : ZonedSystem(problem, pattern, edges),
        deep_(*problem.deep),
        order_(orders.contact),
        grid_(pattern, edges, order_),
        middles_(grid_.middles()),
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
    std::size_t stick = 0;
    for (const GradedZone& zone : grid_.zones()) {
      for (Index j = 0; j < zone.count; ++j)
        shear_from_.push_back(zone.stick ? ShearFrom{sticks_[stick].first + j, 1}
                                         : ShearFrom{zone.first + j, friction_ * zone.direction});
      if (zone.stick) ++stick;
    }
  }

  SpectralState solve() {
    measure_slopes();
    collocate_normal();
    for (std::size_t z = 0; z < sticks_.size(); ++z) collocate_stick(z);
    if (!sticks_.empty()) drive();
    solution_ = SquareSystem(matrix_).solve(right_);
    pressure_ = solution_.head(n_);
    shear_.resize(n_);
    for (Index j = 0; j < n_; ++j) shear_(j) = shear_from(j).factor * solution_(shear_from(j).unknown);
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
    const GradedSources& sources = grid_.sources();
    for (std::size_t k = 0; k < sources.size(); ++k)
      poles.col(sources.nodes[k]).array() += sources.weights[k] / middles_.less(sources.places[k]);
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
    for (Index j = 0; j < n_; ++j) {
      const Eigen::ArrayXd x = middles_.less(grid_.nodes()[static_cast<std::size_t>(j)]);
      Eigen::ArrayX3d k = grid_.weight()(j) * deep_.slopes(x);
      // In one zone the sum passes the logarithm and the jump.
      const GradedZone& zone = grid_.zones()[grid_.zone_of(j)];
      const double rate = zone.step * zone.rate(static_cast<double>(j - zone.first) * zone.step - zone.reach);
      const Index first = std::max(zone.first + 1, j + 1 - mended_at_all),
                  end = std::min(zone.first + zone.count, j + 1 + mended_at_all);
      const Eigen::ArrayX3d growing = rate * deep_.growing(Eigen::ArrayXd(x.segment(first, end - first)));
      for (Index i = first; i < end; ++i) {
        const Mend& m = mend_at_half(j >= i ? j - i : i - j - 1);
        k.row(i).head<2>() += m.logarithm / (2 * M_PI) * growing.row(i - first).head<2>();
        k(i, 2) -= (j >= i ? m.jump : -m.jump) * growing(i - first, 2);
      }
      retarded_normal_.col(j) = k.col(0);
      retarded_along_.col(j) = k.col(1);
      retarded_cross_.col(j) = k.col(2);
    }
  }

  /// Smooth corrections: between Chebyshev points of the contact where these are fewer.
  void add_layers() {
    const Interval& contact = edges_.contact;
    const double distance = 2 * problem_.correction->depth() / contact.half_length();
    const double rate = std::log(distance + std::sqrt(distance * distance + 1));
    // To a hundredth of what the graded points resolve.
    const auto order = static_cast<Index>(std::min(8 - std::log(0.01 * graded_tail(order_)) / rate, 400.0));
    const VectorXd middles = middles_.x();
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

  VectorXd middles(Index first, Index count) const { return middles_.x().segment(first, count); }

  /// The unknown that the shear at a node is, or of which it is a part.
  struct ShearFrom {
    Index unknown;
    double factor;
  };
  const ShearFrom& shear_from(Index node) const { return shear_from_[static_cast<std::size_t>(node)]; }
  /// Adds columns by the shear at nodes to those by unknowns.
  template <class Rows, class ByNode>
  void add_by_shear(const ByNode& by_node, Rows&& rows) const {
    for (Index j = 0; j < n_; ++j) rows.col(shear_from(j).unknown) += shear_from(j).factor * by_node.col(j);
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
        if (pattern_.shear) add_by_shear(crossed, means.row(m));
      } else {
        add_by_shear(direct, means.row(m));
        means.row(m).head(n_) += crossed;
      }
    }
    return means;
  }
  /// (S7) and (S8) with all slopes.
  void collocate_normal() {
    const VectorXd x = middles(0, n_ + 1);
    matrix_.topLeftCorner(n_ + 1, n_) += normal_;
    if (pattern_.shear) add_by_shear(cross_, matrix_.topRows(n_ + 1));
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
    add_by_shear(along_.middleRows(first, rows), block);
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
    RowVectorXd row = RowVectorXd::Zero(size_);
    add_by_shear(of_shear, row);
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
    // Ever farther from the end: what the powers leave is the product of all distances.
    constexpr int many = 30;  // points, from which on the nearer ones are as good
    const int fitted = order_ < many ? 3 : 5;
    const double nearest = order_ < many ? 7 : 8.5, apart = order_ < many ? 2 : 1.5;
    MatrixXd powers(fitted, fitted);
    VectorXd roots(fitted);
    Index node = stick.first + stick.count - 1;
    for (int k = 0; k < fitted; ++k) {
      const double wanted = std::exp(apart * k - nearest);
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
  int order_;
  GradedGrid grid_;
  GradedPlaces middles_;
  Index n_;
  std::vector<const GradedZone*> stick_zones_;
  VectorXd x_, pressure_, shear_;                               // at nodes
  std::vector<ShearFrom> shear_from_;                           // by node
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

GradedTractions::GradedTractions(const GradedGrid& of_grid, const VectorXd& of_pressure, const VectorXd& of_shear,
                                 const VectorXd& by_w, const VectorXd& by_u)
    : grid(of_grid), pressure(of_pressure), shear(of_shear), retarded_w(by_w), retarded_u(by_u) {
  const GradedSources& sources = grid.sources();
  source_x = GradedPlaces(sources.places).x();
  source_pressure.resize(source_x.size());
  source_shear.resize(source_x.size());
  for (std::size_t k = 0; k < sources.size(); ++k) {
    source_pressure(static_cast<Index>(k)) = sources.weights[k] * pressure(sources.nodes[k]);
    source_shear(static_cast<Index>(k)) = sources.weights[k] * shear(sources.nodes[k]);
  }
}

double GradedTractions::value_at(const VectorXd& values, double x) const {
  const GradedZone* zone = grid.zone_at(x);
  if (!zone) return 0;
  const GradedStencil stencil = grid.at(*zone, x);
  return stencil.weights.dot(values.segment(stencil.first, stencil.weights.size()));
}

double GradedTractions::half_length() const {
  return 0.5 * (grid.zones().back().interval.to - grid.zones().front().interval.from);
}

double GradedTractions::nearest_judged() const {
  double nearest = INFINITY;
  for (const GradedZone& zone : grid.zones())
    nearest = std::min(nearest, std::abs(zone.place(zone.reach - judged_from).offset));
  return std::max(nearest, too_near * half_length());
}

bool GradedTractions::near_end(double x, double nearest) const {
  const GradedZone* zone = grid.zone_at(x);
  if (!zone) return false;
  if (std::min(x - zone->interval.from, zone->interval.to - x) < too_near * half_length()) return true;
  return std::abs(zone->parameter(x)) > zone->reach - nearest;
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
  const Eigen::ArrayXd poles = (x - source_x).inverse() / (2 * M_PI);
  slopes << deep.normal() * (poles * source_pressure).sum(), -deep.along() * (poles * source_shear).sum();
  if (!zone) {
    if (deep.remembers()) {
      const Index n = grid.size();  // the nodes' own are the first
      const Eigen::ArrayX3d k = deep.slopes(x - source_x.head(n)).colwise() * grid.weight().array();
      const auto p = pressure.array(), q = shear.array();
      slopes +=
          Eigen::Array2d(-(k.col(0) * p).sum() - (k.col(2) * q).sum(), (k.col(1) * q).sum() - (k.col(2) * p).sum());
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
