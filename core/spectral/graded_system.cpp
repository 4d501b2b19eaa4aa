#include "core/spectral/graded_system.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/dense_algebra.hpp"
#include "core/spectral/graded_slopes.hpp"
#include "core/spectral/zoned_system.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

class GradedSystem : private ZonedSystem {
 public:
  GradedSystem(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
               const SpectralOrders& orders)
      : ZonedSystem(problem, pattern, edges),
        deep_(*problem.deep),
        order_(orders.contact),
        grid_(pattern, edges, order_),
        middles_(grid_.middles()),
        n_(grid_.size()),
        slopes_(problem, grid_, middles_, order_, pattern.shear) {
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

  SpectralState solve(NearbySystems& nearby) {
    collocate_normal();
    for (std::size_t z = 0; z < sticks_.size(); ++z) collocate_stick(z);
    if (!sticks_.empty()) drive();
    solve_linear(nearby);
    pressure_ = solution_.head(n_);
    shear_ = shear_of(solution_);
    SpectralState state = ZonedSystem::state(approach());
    state.sources = x_;
    state.pressure_forces = grid_.weight().cwiseProduct(pressure_);
    state.shear_forces = grid_.weight().cwiseProduct(shear_);
    const auto [retarded_w, retarded_u] = slopes_.retarded(pressure_, shear_);
    state.graded = std::make_shared<const GradedTractions>(grid_, pressure_, shear_, retarded_w, retarded_u);
    return state;
  }

 private:
  /// The matrix holds all but the slopes by tractions: these are added where factors are needed.
  void solve_linear(NearbySystems& nearby) {
    NearbySystems::Shape shape{order_};
    for (const GradedZone& zone : grid_.zones()) shape.push_back(zone.stick ? -zone.count : zone.count);
    rows_.resize(terms_ * static_cast<Index>(1 + sticks_.size()) + (sticks_.empty() ? 0 : 1), size_);
    others_.clear();
    Index at = 0;
    const auto add = [&](Index first, Index count, bool whole) {
      for (Index i = first; i < first + count; ++i) {
        others_.push_back(i);
        if (whole) rows_.row(at++) = matrix_.row(i);
      }
    };
    const auto add_all = [&] {
      add(slack_, 1, false);
      add(amplitude_, terms_, true);
      for (const Stick& stick : sticks_) {
        add(stick.slack(), 1, false);
        add(stick.amplitude(), terms_, true);
      }
      if (!sticks_.empty()) add(rotation_, 1, true);
    };
    add_all();
    const auto apply = [&](const VectorXd& x) { return product(x); };
    if (std::optional<VectorXd> solution = nearby.solve(shape, apply, right_)) {
      solution_ = std::move(*solution);
      return;
    }
    matrix_.topLeftCorner(n_ + 1, n_) += slopes_.normal(0, n_ + 1);
    if (pattern_.shear) {
      const MatrixXd cross = slopes_.cross(0, n_ + 1);
      add_by_shear(cross, matrix_.topRows(n_ + 1));
      for (std::size_t z = 0; z < sticks_.size(); ++z) {
        const Index rows = sticks_[z].count + 1, first = stick_zones_[z]->first;
        auto block = matrix_.middleRows(sticks_[z].first, rows);
        add_by_shear(slopes_.along(first, rows), block);
        block.leftCols(n_) += cross.middleRows(first, rows);
      }
    }
    solution_ = nearby.factorise(shape, matrix_, right_);
  }

  /// The matrix with the slopes by tractions, times x.
  VectorXd product(const VectorXd& x) const {
    const auto [w, u] = slopes_.of(x.head(n_), shear_of(x));
    VectorXd y = VectorXd::Zero(size_);
    for (const Index other : others_) y += x(other) * matrix_.col(other);
    y.head(n_ + 1) += w;
    for (std::size_t z = 0; z < sticks_.size(); ++z)
      y.segment(sticks_[z].first, sticks_[z].count + 1) += u.segment(stick_zones_[z]->first, sticks_[z].count + 1);
    const VectorXd whole = rows_ * x;
    Index at = 0;
    y.segment(amplitude_, terms_) = whole.head(terms_);
    at += terms_;
    for (const Stick& stick : sticks_) {
      y.segment(stick.amplitude(), terms_) = whole.segment(at, terms_);
      at += terms_;
    }
    if (!sticks_.empty()) y(rotation_) = whole(at);
    return y;
  }

  VectorXd shear_of(const VectorXd& unknowns) const {
    VectorXd shear(n_);
    for (Index j = 0; j < n_; ++j) shear(j) = shear_from(j).factor * unknowns(shear_from(j).unknown);
    return shear;
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
  GradedSlopes slopes_;
  std::vector<const GradedZone*> stick_zones_;
  VectorXd x_, pressure_, shear_;      // at nodes
  std::vector<ShearFrom> shear_from_;  // by node
  MatrixXd rows_;                      // of the matrix that do not hold slopes
  std::vector<Index> others_;          // columns that are not of tractions
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

SpectralState solve_graded(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
                           const SpectralOrders& orders, NearbySystems& nearby) {
  if (edges.sticks.size() != pattern.sticks() || !has_zones(pattern, edges)) {
    SpectralState nowhere;
    nowhere.residuals.setConstant(pattern.unknowns(), NAN);
    return nowhere;
  }
  return GradedSystem(problem, pattern, edges, orders).solve(nearby);
}

double graded_tail(double order) { return std::exp(-2.7 * std::sqrt(order)); }

double graded_field_error(double order) { return 0.1 * std::exp(-0.9 * std::sqrt(order)); }

}  // namespace rollres
