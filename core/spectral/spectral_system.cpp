#include "core/spectral/spectral_system.hpp"

#include <cmath>
#include <optional>

#include "core/algebra/dense_algebra.hpp"
#include "core/numerics/chebyshev.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/spectral/graded_system.hpp"
#include "core/spectral/sliding_base.hpp"
#include "core/spectral/spectral_memory.hpp"
#include "core/spectral/spectral_sources.hpp"
#include "core/spectral/zoned_system.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

class System : private ZonedSystem {
 public:
  System(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
         const SpectralOrders& orders)
      : ZonedSystem(problem, pattern, edges),
        n_(orders.contact),
        stick_n_(orders.stick),
        rule_(chebyshev_rule(orders.contact)),
        stick_rule_(chebyshev_rule(orders.stick)),
        memory_(problem, edges.contact, orders.contact) {
    place_unknowns(n_, std::vector<Index>(pattern.sticks(), stick_n_));
    std::vector<Index> places;
    for (const Stick& stick : sticks_) {
      places.push_back(stick.first);
      memories_.emplace_back(problem, stick.interval, orders.stick);
    }
    if (pattern_.shear) {
      // A base of several directions mixes the pressure's tails into other places.
      const int tail = pattern_.one_direction() ? 0 : memory_.tail_terms();
      base_.emplace(pattern_, edges_, orders.contact + tail, orders.stick);
    }
    sources_ = traction_sources(pattern_, edges_, orders, base_ ? &*base_ : nullptr, friction_, places, size_);
  }

  SpectralState solve() {
    collocate_normal();
    remember_normal();
    for (std::size_t z = 0; z < sticks_.size(); ++z) {
      collocate_stick(z);
      remember_stick(z);
    }
    if (!sticks_.empty()) drive();
    solution_ = SquareSystem(matrix_).solve(right_);
    SpectralState state = ZonedSystem::state(approach());
    state.sources = sources_.x;
    state.runs = sources_.runs;
    state.pressure_forces = sources_.of_pressure * solution_;
    state.shear_forces = sources_.of_shear * solution_;
    return state;
  }

 private:
  bool at_leading_edge(std::size_t z) const { return z + 1 == sticks_.size() && pattern_.sticks_at_leading_edge(); }

  Eigen::VectorXd points(const Interval& interval, const ChebyshevRule& rule) const {
    return interval.centre() + interval.half_length() * rule.points.array();
  }
  LayerKernel remembered(Index m) const {
    return [&correction = *problem_.correction, term = static_cast<std::size_t>(m)](double x) {
      return correction.memory(term, x);
    };
  }
  LayerKernel layer() const {
    return [&correction = *problem_.correction](double x) { return correction.slope(x); };
  }

  /// The rows (S11).
  void collocate_normal() {
    const VectorXd x = points(edges_.contact, rule_);
    matrix_.topLeftCorner(n_ + 1, n_) = 0.5 * rule_.images.rightCols(n_);
    matrix_.block(0, slack_, n_ + 1, 1).setOnes();
    if (terms_ > 0) matrix_.block(0, amplitude_, n_ + 1, terms_) = -rule_.images * memory_.series;
    if (problem_.layered()) {
      matrix_.topRows(n_ + 1) += normal_slopes(sources_, layer(), x);
      mend(problem_.correction->logarithms(finest_distance(edges_.contact, n_)), x, matrix_);
    }
    prescribe_contact(x);
  }

  /// Takes what sums over the sources miss of a ring's logarithms (S24a) from rows of g_w, or of its means, at x.
  template <class Rows>
  void mend(const RingLogarithms& logarithms, const VectorXd& x, Rows&& rows) const {
    if (logarithms.normal.none()) return;
    for (Index i = 0; i < x.size(); ++i) {
      const MissedSlopes missed = missed_slopes(logarithms, sources_.runs, sources_.x, x(i));
      rows.row(i).head(n_) -= missed.normal * sources_.of_pressure.topLeftCorner(n_, n_);
      if (pattern_.shear) rows.row(i) -= missed.hoop * sources_.of_shear;
    }
  }

  /// The means at the leading edge, by (S12) and (S13), and the rows (S8) of the pressure's amplitudes.
  void remember_normal() {
    means_ = MatrixXd::Zero(terms_, size_);
    const VectorXd leading_edge = VectorXd::Constant(1, edges_.contact.to);
    for (Index m = 0; m < terms_; ++m) {
      require_time();
      means_.row(m).head(n_) = 0.5 * memory_.memory.col(m).tail(n_).transpose();
      means_.row(m).segment(amplitude_, terms_) = memory_.tails.col(m).transpose();
      if (!problem_.layered()) continue;
      means_.row(m) += normal_slopes(sources_, remembered(m), leading_edge);
      mend(problem_.correction->memory_logarithms(static_cast<std::size_t>(m), finest_distance(edges_.contact, n_)),
           leading_edge, means_.middleRows(m, 1));
    }
    remember(amplitude_, means_);
  }

  /// Half-space's slope g_u of the base at x, with what the pressure's tails add to it but for their own image there.
  void add_base(double x, Eigen::Ref<RowVectorXd> row) const {
    const RowVectorXd slope = friction_ * base_->slope(x);
    row.head(n_) += slope.head(n_);
    const Index mixed = slope.size() - n_;
    if (mixed == 0) return;
    const double t = place_in(edges_.contact, x);
    const double m = t > 1 ? pattern_.direction(pattern_.slips.size() - 1) : base_->direction(x);
    const RowVectorXd images = chebyshev_images(t, static_cast<int>(n_ + mixed) + 1).tail(mixed).transpose();
    const Index kept = std::min<Index>(mixed, memory_.beyond.rows());
    for (Index j = 0; j < terms_; ++j)
      row(amplitude_ + j) += 2 * (slope.segment(n_, kept) + 0.5 * friction_ * m * images.head(kept))
                                     .dot(memory_.beyond.col(j).head(kept).transpose());
  }

  /// The image of the pressure's tail j at x in the contact, per amplitude.
  double tail_image(Index j, double x, double whole) const {
    const VectorXd images = chebyshev_images(place_in(edges_.contact, x), static_cast<int>(n_) + 1);
    return whole - images.dot(memory_.series.col(j));
  }
  double exponential(const Interval& interval, Index j, double x) const {
    return std::exp((x - interval.to) / problem_.relaxation_length[static_cast<std::size_t>(j)]);
  }

  /// Half-space's slope g_u at x of the densities of a zone of stick, outside it.
  void add_distant_stick(std::size_t z, double x, Eigen::Ref<RowVectorXd> row) const {
    const Stick& zone = sticks_[z];
    const IntervalMemory& memory = memories_[z];
    const double t = place_in(zone.interval, x);
    row.segment(zone.first, stick_n_) -=
        0.5 * chebyshev_images(t, static_cast<int>(stick_n_) + 1).tail(stick_n_).transpose();
    for (Index j = 0; j < terms_; ++j)
      if (memory.has_tail[static_cast<std::size_t>(j)])
        row(zone.amplitude() + j) += memory.tail_field(static_cast<std::size_t>(j), zone.interval, x);
  }

  /// The rows (S16).
  void collocate_stick(std::size_t z) {
    const Stick& zone = sticks_[z];
    matrix_.block(zone.first, zone.first, stick_n_ + 1, stick_n_) = -0.5 * stick_rule_.images.rightCols(stick_n_);
    matrix_.block(zone.first, zone.slack(), stick_n_ + 1, 1).setOnes();
    // The amplitudes are those of the exponentials in the densities' own field: without slip ahead, the tails of the
    // pressure, which the base follows, are tails of the stick as well (S17).
    MatrixXd kept;
    if (terms_ > 0) {
      kept = stick_rule_.images * memories_[z].series;
      matrix_.block(zone.first, zone.amplitude(), stick_n_ + 1, terms_) = -kept;
    }
    const VectorXd places = points(zone.interval, stick_rule_);
    prescribe_stick(zone, places);
    if (problem_.layered())
      matrix_.middleRows(zone.first, stick_n_ + 1) += tangential_slopes(sources_, layer(), places);
    RowVectorXd row(size_);
    for (Index i = 0; i <= stick_n_; ++i) {
      const double x = places(i);
      row.setZero();
      add_base(x, row);
      for (std::size_t other = 0; other < sticks_.size(); ++other)
        if (other != z) add_distant_stick(other, x, row);
      for (Index j = 0; j < terms_; ++j) {
        // With slip ahead of it the tails' exponential is a given field; at the leading edge it is in the amplitude.
        const double whole = at_leading_edge(z) ? 0 : exponential(edges_.contact, j, x);
        row(amplitude_ + j) -= friction_ * base_->direction(x) * tail_image(j, x, whole);
      }
      matrix_.row(zone.first + i) += row;
    }
  }

  /// The rows of a stick's amplitudes, (S14) or (S17).
  void remember_stick(std::size_t z) {
    const Stick& zone = sticks_[z];
    MatrixXd means = MatrixXd::Zero(terms_, size_);
    const double direction = friction_ * pattern_.direction(pattern_.slips.size() - 1);
    RowVectorXd row(size_);
    const bool at_edge = at_leading_edge(z);
    if (terms_ > 0 && (!at_edge || sticks_.size() > 1 || !pattern_.one_direction())) {
      const PointsAhead points(problem_, edges_, zone.interval.to, static_cast<int>(n_));
      for (Index q = 0; q < points.x.size(); ++q) {
        const double x = points.x(q);
        row.setZero();
        add_base(x, row);
        for (std::size_t other = 0; other < sticks_.size(); ++other)
          if (other != z) add_stick(other, x, row);
        if (x < edges_.contact.to)
          for (Index j = 0; j < terms_; ++j)
            row(amplitude_ + j) -=
                friction_ * base_->direction(x) * tail_image(j, x, exponential(edges_.contact, j, x));
        for (Index m = 0; m < terms_; ++m) means.row(m) += points.weights(q, m) * row;
      }
    } else if (terms_ > 0) {
      means.leftCols(n_) -= 0.5 * direction * memory_.memory.bottomRows(n_).transpose();
    }
    const VectorXd leading_end = VectorXd::Constant(1, zone.interval.to);
    for (Index m = 0; m < terms_; ++m) {
      auto mean = means.row(m);
      const double length = problem_.creep_length[static_cast<std::size_t>(m)];
      mean.segment(zone.first, stick_n_) -= 0.5 * memories_[z].memory.col(m).tail(stick_n_).transpose();
      mean.segment(zone.amplitude(), terms_) += memories_[z].tails.col(m).transpose();
      mean.segment(amplitude_, terms_) -=
          direction * std::exp((zone.interval.to - edges_.contact.to) / length) * memory_.tails.col(m).transpose();
      if (problem_.layered()) mean += tangential_slopes(sources_, remembered(m), leading_end);
    }
    remember(zone.amplitude(), means);
    for (Index j = 0; j < terms_; ++j) {
      if (at_edge) matrix_(zone.amplitude() + j, amplitude_ + j) -= direction;
    }
  }

  /// The same as `add_distant_stick`, in the zone as well.
  void add_stick(std::size_t z, double x, Eigen::Ref<RowVectorXd> row) const {
    const Stick& zone = sticks_[z];
    const double t = place_in(zone.interval, x);
    if (std::abs(t) > 1) return add_distant_stick(z, x, row);
    const VectorXd images = chebyshev_images(t, static_cast<int>(stick_n_) + 1);
    row.segment(zone.first, stick_n_) -= 0.5 * images.tail(stick_n_).transpose();
    for (Index j = 0; j < terms_; ++j)
      row(zone.amplitude() + j) += exponential(zone.interval, j, x) - images.dot(memories_[z].series.col(j));
  }

  RowVectorXd resultant(LeverArm (IndenterShape::*arm)(double, double) const) const override {
    return resultant_row(problem_.shape, arm, sources_);
  }

  double approach() const {
    if (!problem_.layered()) return NAN;
    const double half = edges_.contact.half_length(), leading = edges_.contact.to;
    double w = 0;  // of unit modulus
    for (Index n = 0; n < n_; ++n) {
      const double mean =
          n == 0 ? 0.5 - std::log(2 / half) : 1.0 / static_cast<double>(n + 2) - 1.0 / static_cast<double>(n);
      w += half / 4 * solution_(n) * mean;
    }
    w += half * memory_.tail_lift.dot(solution_.segment(amplitude_, terms_));
    for (Index q = 0; q < sources_.x.size(); ++q) {
      const LayerSlopes k = problem_.correction->displacement(leading - sources_.x(q));
      w -= k(layer_slope::normal) * sources_.of_pressure.row(q).dot(solution_) +
           (k(layer_slope::cross) + k(layer_slope::hoop)) * sources_.of_shear.row(q).dot(solution_);
    }
    return ZonedSystem::approach(w);
  }

  /// Bounded slip ahead of a stick: no root of the distance in the shear there, be it the base's or the rest's (S19).
  double root_at_leading_end(std::size_t z) const override {
    const Stick& zone = sticks_[z];
    const int change = pattern_.direction(z + 1) - pattern_.direction(z);
    double end = 0;
    if (change != 0) {
      const double angle = std::acos(place_in(edges_.contact, zone.interval.to));
      for (Index n = 0; n < n_; ++n) end -= solution_(n) * std::sin(static_cast<double>(n + 1) * angle);
      for (Index k = 0; k < memory_.beyond.rows(); ++k)
        end -= 2 * memory_.beyond.row(k).dot(solution_.segment(amplitude_, terms_)) *
               std::sin(static_cast<double>(n_ + 1 + k) * angle);
      end *= friction_ * change / M_PI;
    }
    for (Index n = 0; n < stick_n_; ++n) end += static_cast<double>(n + 1) * solution_(zone.first + n);
    for (Index j = 0; j < terms_; ++j) {
      const VectorXd series = memories_[z].series.col(j);
      const double rate = zone.interval.half_length() / problem_.relaxation_length[static_cast<std::size_t>(j)];
      double rest = rate * (series(0) + 0.5 * series(1));  // sum of n times the coefficients, from beyond the order
      for (Index n = 1; n <= stick_n_; ++n) rest -= static_cast<double>(n) * series(n);
      end -= 2 * solution_(zone.amplitude() + j) * rest;
    }
    return end;
  }

  Index n_, stick_n_;
  const ChebyshevRule &rule_, &stick_rule_;
  IntervalMemory memory_;
  std::vector<IntervalMemory> memories_;  // of the sticks
  std::optional<SlidingBase> base_;
  TractionSources sources_;
};

}  // namespace

std::optional<std::size_t> redundant_slack(const SpectralProblem& problem, const SlipPattern& pattern) {
  if (problem.terms() > 0 || pattern.sticks() == 0 || problem.model.drive == Drive::rotation) return {};
  for (std::size_t z = 0; z < pattern.sticks(); ++z)
    if (pattern.slips[z] != 0) return z;
  return 0;
}

SpectralState solve_inside(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
                           const SpectralOrders& orders, NearbySystems& nearby) {
  if (problem.graded(pattern.shear)) return solve_graded(problem, pattern, edges, orders, nearby);
  return System(problem, pattern, edges, orders).solve();
}

SpectralState solve_inside(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
                           const SpectralOrders& orders) {
  NearbySystems nearby;
  return solve_inside(problem, pattern, edges, orders, nearby);
}

}  // namespace rollres
