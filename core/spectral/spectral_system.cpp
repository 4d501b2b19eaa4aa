#include "core/spectral/spectral_system.hpp"

#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/numerics/chebyshev.hpp"
#include "core/numerics/dense_algebra.hpp"
#include "core/spectral/graded_system.hpp"
#include "core/spectral/sliding_base.hpp"
#include "core/spectral/spectral_memory.hpp"
#include "core/spectral/spectral_sources.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// Coefficients of the pressure's tails that a base of several directions mixes into other places.
constexpr int mixed_tail_terms = 120;

class System {
 public:
  System(const SpectralProblem& given_problem, const SlipPattern& given_pattern, const SpectralEdges& given_edges,
         const SpectralOrders& orders)
      : problem_(given_problem),
        pattern_(given_pattern),
        edges_(given_edges),
        friction_(given_pattern.shear ? given_problem.scene.friction_coefficient : 0),
        n_(orders.contact),
        stick_n_(orders.stick),
        terms_(given_problem.terms()),
        rule_(chebyshev_rule(orders.contact)),
        stick_rule_(chebyshev_rule(orders.stick)),
        memory_(given_problem, given_edges.contact, orders.contact),
        slack_(n_),
        amplitude_(n_ + 1),
        rotation_(n_ + 1 + terms_ + static_cast<Index>(pattern_.sticks()) * (stick_n_ + 1 + terms_)),
        size_(rotation_ + (pattern_.sticks() > 0 ? 1 : 0)) {
    for (std::size_t z = 0; z < pattern_.sticks(); ++z)
      zones_.push_back({edges_.sticks[z], n_ + 1 + terms_ + static_cast<Index>(z) * (stick_n_ + 1 + terms_), stick_n_,
                        IntervalMemory(problem_, edges_.sticks[z], orders.stick)});
    if (pattern_.shear) {
      const int tail = !pattern_.one_direction() && memory_.any_tail() ? mixed_tail_terms : 0;
      base_.emplace(pattern_, edges_, orders.contact + tail, orders.stick);
    }
    sources_ = traction_sources(pattern_, edges_, orders, base_ ? &*base_ : nullptr, friction_, stick_places(), size_);
  }

  SpectralState solve() {
    matrix_ = MatrixXd::Zero(size_, size_);
    right_ = VectorXd::Zero(size_);
    collocate_normal();
    remember_normal();
    for (std::size_t z = 0; z < zones_.size(); ++z) {
      collocate_stick(z);
      remember_stick(z);
    }
    if (!zones_.empty()) drive();
    solution_ = SquareSystem(matrix_).solve(right_);
    return state();
  }

 private:
  /// A zone of stick with the places of its unknowns.
  struct Stick {
    Interval interval;
    Index psi, order;
    IntervalMemory memory;
    Index slack() const { return psi + order; }
    Index amplitude() const { return psi + order + 1; }
  };

  std::vector<Index> stick_places() const {
    std::vector<Index> places;
    for (const Stick& zone : zones_) places.push_back(zone.psi);
    return places;
  }

  bool at_leading_edge(std::size_t z) const { return z + 1 == zones_.size() && pattern_.sticks_at_leading_edge(); }

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
    const Interval& contact = edges_.contact;
    const VectorXd x = points(contact, rule_);
    matrix_.topLeftCorner(n_ + 1, n_) = 0.5 * rule_.images.rightCols(n_);
    matrix_.block(0, slack_, n_ + 1, 1).setOnes();
    if (terms_ > 0) matrix_.block(0, amplitude_, n_ + 1, terms_) = -rule_.images * memory_.series;
    if (problem_.layered()) matrix_.topRows(n_ + 1) += normal_slopes(sources_, layer(), x);
    const PrescribedSlope body(problem_, contact, x, [&](double at) { return problem_.shape.slope(at); });
    right_.head(n_ + 1) = body.elastic;
    right_.segment(amplitude_, terms_) = body.amplitude;
  }

  /// Left sides of (S8) and (S14): Z_j + g_j sum_m F_jm R_{T_m} g.
  void remember(Index amplitude, const MatrixXd& means) {
    for (Index j = 0; j < terms_; ++j) {
      auto row = matrix_.row(amplitude + j);
      row += problem_.relaxation_modulus[static_cast<std::size_t>(j)] * (problem_.memory_factor.row(j) * means);
      row(amplitude + j) += 1;
    }
  }

  /// The means at the leading edge, by (S12) and (S13), and the rows (S8) of the pressure's amplitudes.
  void remember_normal() {
    means_ = MatrixXd::Zero(terms_, size_);
    const VectorXd leading_edge = VectorXd::Constant(1, edges_.contact.to);
    for (Index m = 0; m < terms_; ++m) {
      means_.row(m).head(n_) = 0.5 * memory_.memory.col(m).tail(n_).transpose();
      means_.row(m).segment(amplitude_, terms_) = memory_.tails.col(m).transpose();
      if (problem_.layered()) means_.row(m) += normal_slopes(sources_, remembered(m), leading_edge);
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
  void add_distant_stick(const Stick& zone, double x, Eigen::Ref<RowVectorXd> row) const {
    const double t = place_in(zone.interval, x);
    row.segment(zone.psi, stick_n_) -=
        0.5 * chebyshev_images(t, static_cast<int>(stick_n_) + 1).tail(stick_n_).transpose();
    for (Index j = 0; j < terms_; ++j)
      if (zone.memory.has_tail[static_cast<std::size_t>(j)])
        row(zone.amplitude() + j) += zone.memory.tail_field(static_cast<std::size_t>(j), zone.interval, x);
  }

  /// The rows (S16).
  void collocate_stick(std::size_t z) {
    const Stick& zone = zones_[z];
    matrix_.block(zone.psi, zone.psi, stick_n_ + 1, stick_n_) = -0.5 * stick_rule_.images.rightCols(stick_n_);
    matrix_.block(zone.psi, zone.slack(), stick_n_ + 1, 1).setOnes();
    // The amplitudes are those of the exponentials in the densities' own field: without slip ahead, the tails of the
    // pressure, which the base follows, are tails of the stick as well (S17).
    MatrixXd kept;
    if (terms_ > 0) {
      kept = stick_rule_.images * zone.memory.series;
      matrix_.block(zone.psi, zone.amplitude(), stick_n_ + 1, terms_) = -kept;
    }
    const VectorXd places = points(zone.interval, stick_rule_);
    prescribe_stick(zone, places);
    if (problem_.layered()) matrix_.middleRows(zone.psi, stick_n_ + 1) += tangential_slopes(sources_, layer(), places);
    RowVectorXd row(size_);
    for (Index i = 0; i <= stick_n_; ++i) {
      const double x = places(i);
      row.setZero();
      add_base(x, row);
      for (const Stick& other : zones_)
        if (&other != &zone) add_distant_stick(other, x, row);
      for (Index j = 0; j < terms_; ++j) {
        // With slip ahead of it the tails' exponential is a given field; at the leading edge it is in the amplitude.
        const double whole = at_leading_edge(z) ? 0 : exponential(edges_.contact, j, x);
        row(amplitude_ + j) -= friction_ * base_->direction(x) * tail_image(j, x, whole);
      }
      matrix_.row(zone.psi + i) += row;
    }
  }

  /// What (S14) and (S16) have of the strain u' = (omega - 1) turning + turning - forward that stick prescribes.
  void prescribe_stick(const Stick& zone, const VectorXd& places) {
    auto column = matrix_.col(rotation_);
    column.segment(zone.psi, stick_n_ + 1).setConstant(-1);
    for (Index j = 0; j < terms_; ++j)
      column(zone.amplitude() + j) = -problem_.relaxation_modulus[static_cast<std::size_t>(j)] / problem_.rubbery;
    if (problem_.shape.slips_evenly()) return;
    const PrescribedSlope turning(problem_, zone.interval, places,
                                  [&](double x) { return problem_.shape.slip(x).turning - 1; });
    column.segment(zone.psi, stick_n_ + 1) -= turning.elastic / problem_.rubbery;
    column.segment(zone.amplitude(), terms_) -= turning.amplitude / problem_.rubbery;
    const PrescribedSlope known(problem_, zone.interval, places, [&](double x) {
      const RigidSlip rigid = problem_.shape.slip(x);
      return rigid.turning - rigid.forward;
    });
    right_.segment(zone.psi, stick_n_ + 1) += known.elastic;
    right_.segment(zone.amplitude(), terms_) += known.amplitude;
  }

  /// The rows of a stick's amplitudes, (S14) or (S17).
  void remember_stick(std::size_t z) {
    const Stick& zone = zones_[z];
    MatrixXd means = MatrixXd::Zero(terms_, size_);
    const double direction = friction_ * pattern_.direction(pattern_.slips.size() - 1);
    RowVectorXd row(size_);
    const bool at_edge = at_leading_edge(z);
    if (terms_ > 0 && (!at_edge || zones_.size() > 1 || !pattern_.one_direction())) {
      const PointsAhead points(problem_, edges_, zone.interval.to, static_cast<int>(n_));
      for (Index q = 0; q < points.x.size(); ++q) {
        const double x = points.x(q);
        row.setZero();
        add_base(x, row);
        for (std::size_t other = 0; other < zones_.size(); ++other)
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
      mean.segment(zone.psi, stick_n_) -= 0.5 * zone.memory.memory.col(m).tail(stick_n_).transpose();
      mean.segment(zone.amplitude(), terms_) += zone.memory.tails.col(m).transpose();
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
    const Stick& zone = zones_[z];
    const double t = place_in(zone.interval, x);
    if (std::abs(t) > 1) return add_distant_stick(zone, x, row);
    const VectorXd images = chebyshev_images(t, static_cast<int>(stick_n_) + 1);
    row.segment(zone.psi, stick_n_) -= 0.5 * images.tail(stick_n_).transpose();
    for (Index j = 0; j < terms_; ++j)
      row(zone.amplitude() + j) += exponential(zone.interval, j, x) - images.dot(zone.memory.series.col(j));
  }

  RowVectorXd resultant(LeverArm (IndenterShape::*arm)(double, double) const) const {
    return resultant_row(problem_.shape, arm, sources_);
  }

  /// What the drive asks of the tractions, and how much (S18).
  std::pair<RowVectorXd, double> drive_row() const {
    const RollingScene& scene = problem_.scene;
    const double half = edges_.contact.half_length();
    const RowVectorXd row =
        rollres::drive_row(scene, resultant(&IndenterShape::torque), resultant(&IndenterShape::driving_force));
    return {row / half, drive_target(scene) / half};
  }

  void drive() {
    const RollingScene& scene = problem_.scene;
    auto row = matrix_.row(rotation_);
    if (scene.drive == Drive::rotation) {
      row(rotation_) = 1;
      right_(rotation_) = problem_.rubbery * (*scene.rotation_ratio - 1);
    } else if (const std::optional<std::size_t> zone = redundant_slack(problem_, pattern_)) {
      row(zones_[*zone].slack()) = 1;
    } else {
      const auto [asked, wanted] = drive_row();
      row = asked;
      right_(rotation_) = wanted;
    }
  }

  /// (S23)
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
           k(layer_slope::cross) * sources_.of_shear.row(q).dot(solution_);
    }
    w *= problem_.rubbery_compliance;
    const VectorXd means = means_ * solution_;
    for (Index m = 0; m < terms_; ++m) {
      const auto i = static_cast<std::size_t>(m);
      w += problem_.creep_compliance[i] * problem_.creep_length[i] * means(m);
    }
    return problem_.shape.profile(leading) - w;
  }

  SpectralState state() const {
    const RollingScene& scene = problem_.scene;
    SpectralState state;
    state.pattern = pattern_;
    state.edges = edges_;
    state.pressure = {solution_.head(n_), solution_.segment(amplitude_, terms_)};
    state.load = resultant(&IndenterShape::load).dot(solution_);
    state.driving_force = resultant(&IndenterShape::driving_force).dot(solution_);
    state.driving_torque = resultant(&IndenterShape::torque).dot(solution_);
    state.approach = approach();
    state.edge_means = means_ * solution_;
    state.sources = sources_.x;
    state.pressure_forces = sources_.of_pressure * solution_;
    state.shear_forces = sources_.of_shear * solution_;
    const double scale = state.load / edges_.contact.half_length();
    state.residuals.resize(pattern_.unknowns());
    state.residuals(0) = solution_(slack_) / scale;
    state.residuals(1) =
        scene.load ? (state.load - *scene.load) / *scene.load : (state.approach - *scene.approach) / *scene.approach;
    if (!zones_.empty())
      state.rotation_ratio = 1 + solution_(rotation_) / problem_.rubbery;
    else if (scene.drive == Drive::rotation)
      state.rotation_ratio = *scene.rotation_ratio;
    Index residual = 2;
    for (std::size_t z = 0; z < zones_.size(); ++z) {
      const Stick& zone = zones_[z];
      state.sticks.push_back({solution_.segment(zone.psi, stick_n_), solution_.segment(zone.amplitude(), terms_)});
      if (pattern_.slips[z] != 0)
        state.residuals(residual++) =
            (redundant_slack(problem_, pattern_) == z ? lacking_drive() : solution_(zone.slack())) / scale;
      if (pattern_.slips[z + 1] != 0) state.residuals(residual++) = root_at_leading_end(z) / scale;
    }
    return state;
  }

  double lacking_drive() const {
    const auto [row, wanted] = drive_row();
    return wanted - row.dot(solution_);
  }

  /// Bounded slip ahead of a stick: no root of the distance in the shear there, be it the base's or the rest's (S19).
  double root_at_leading_end(std::size_t z) const {
    const Stick& zone = zones_[z];
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
    for (Index n = 0; n < stick_n_; ++n) end += static_cast<double>(n + 1) * solution_(zone.psi + n);
    for (Index j = 0; j < terms_; ++j) {
      const VectorXd series = zone.memory.series.col(j);
      const double rate = zone.interval.half_length() / problem_.relaxation_length[static_cast<std::size_t>(j)];
      double rest = rate * (series(0) + 0.5 * series(1));  // sum of n times the coefficients, from beyond the order
      for (Index n = 1; n <= stick_n_; ++n) rest -= static_cast<double>(n) * series(n);
      end -= 2 * solution_(zone.amplitude() + j) * rest;
    }
    return end;
  }

  const SpectralProblem& problem_;
  SlipPattern pattern_;
  SpectralEdges edges_;
  double friction_;
  Index n_, stick_n_, terms_;
  const ChebyshevRule &rule_, &stick_rule_;
  IntervalMemory memory_;
  Index slack_, amplitude_, rotation_, size_;  // places of unknowns after the coefficients phi
  std::vector<Stick> zones_;
  std::optional<SlidingBase> base_;
  TractionSources sources_;
  MatrixXd matrix_, means_;
  VectorXd right_, solution_;
};

}  // namespace

std::optional<std::size_t> redundant_slack(const SpectralProblem& problem, const SlipPattern& pattern) {
  if (problem.terms() > 0 || pattern.sticks() == 0 || problem.scene.drive == Drive::rotation) return {};
  for (std::size_t z = 0; z < pattern.sticks(); ++z)
    if (pattern.slips[z] != 0) return z;
  return 0;
}

SpectralState solve_inside(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
                           const SpectralOrders& orders) {
  if (problem.graded(pattern.shear)) return solve_graded(problem, pattern, edges, orders);
  return System(problem, pattern, edges, orders).solve();
}

}  // namespace rollres
