#include "core/spectral/graded_system.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/numerics/chebyshev.hpp"
#include "core/numerics/dense_algebra.hpp"
#include "core/numerics/memory_functions.hpp"
#include "core/spectral/spectral_memory.hpp"

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

class GradedSystem {
 public:
  GradedSystem(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
               const SpectralOrders& orders)
      : problem_(problem),
        deep_(*problem.deep),
        pattern_(pattern),
        edges_(edges),
        friction_(pattern.shear ? problem.scene.friction_coefficient : 0),
        grid_(pattern, edges, orders.contact),
        n_(grid_.size()),
        terms_(problem.terms()),
        slack_(n_),
        amplitude_(n_ + 1) {
    Index next = n_ + 1 + terms_;
    for (const GradedZone& zone : grid_.zones()) {
      if (!zone.stick) continue;
      sticks_.push_back({&zone, next});
      next += zone.count + 1 + terms_;
    }
    rotation_ = next;
    size_ = rotation_ + (sticks_.empty() ? 0 : 1);
    x_.resize(n_);
    for (Index j = 0; j < n_; ++j) x_(j) = grid_.nodes()[static_cast<std::size_t>(j)].x();
    shear_of_ = MatrixXd::Zero(n_, size_);
    for (const GradedZone& zone : grid_.zones())
      if (!zone.stick)
        for (Index j = zone.first; j < zone.first + zone.count; ++j) shear_of_(j, j) = friction_ * zone.direction;
    for (const Stick& stick : sticks_)
      for (Index j = 0; j < stick.zone->count; ++j) shear_of_(stick.zone->first + j, stick.shear + j) = 1;
  }

  SpectralState solve() {
    measure_slopes();
    matrix_ = MatrixXd::Zero(size_, size_);
    right_ = VectorXd::Zero(size_);
    collocate_normal();
    for (std::size_t z = 0; z < sticks_.size(); ++z) collocate_stick(z);
    if (!sticks_.empty()) drive();
    solution_ = SquareSystem(matrix_).solve(right_);
    return state();
  }

 private:
  struct Stick {
    const GradedZone* zone;
    Index shear;  // place of its first unknown
    Index slack() const { return shear + zone->count; }
    Index amplitude() const { return slack() + 1; }
  };

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
  void remember(Index amplitude, const MatrixXd& means) {
    for (Index j = 0; j < terms_; ++j) {
      auto row = matrix_.row(amplitude + j);
      row += problem_.relaxation_modulus[static_cast<std::size_t>(j)] * (problem_.memory_factor.row(j) * means);
      row(amplitude + j) += 1;
    }
  }

  /// (S7) and (S8) with all slopes.
  void collocate_normal() {
    const VectorXd x = middles(0, n_ + 1);
    matrix_.topLeftCorner(n_ + 1, n_) += normal_;
    if (pattern_.shear) matrix_.topRows(n_ + 1) += cross_ * shear_of_;
    matrix_.block(0, slack_, n_ + 1, 1).setOnes();
    matrix_.block(0, amplitude_, n_ + 1, terms_) -= exponentials(x, edges_.contact.to);
    const PrescribedSlope body(problem_, edges_.contact, x, [&](double at) { return problem_.shape.slope(at); });
    right_.head(n_ + 1) = body.elastic;
    right_.segment(amplitude_, terms_) = body.amplitude;
    means_ = means_at(edges_.contact.to, true);
    remember(amplitude_, means_);
  }

  /// (S14) with all slopes.
  void collocate_stick(std::size_t z) {
    const Stick& stick = sticks_[z];
    const Index rows = stick.zone->count + 1;
    const Interval& interval = stick.zone->interval;
    const VectorXd x = middles(stick.zone->first, rows);
    auto block = matrix_.middleRows(stick.shear, rows);
    block += along_.middleRows(stick.zone->first, rows) * shear_of_;
    block.leftCols(n_) += cross_.middleRows(stick.zone->first, rows);
    block.col(stick.slack()).setOnes();
    block.middleCols(stick.amplitude(), terms_) -= exponentials(x, interval.to);
    remember(stick.amplitude(), means_at(interval.to, false));
    auto column = matrix_.col(rotation_);
    column.segment(stick.shear, rows).setConstant(-1);
    for (Index j = 0; j < terms_; ++j)
      column(stick.amplitude() + j) = -problem_.relaxation_modulus[static_cast<std::size_t>(j)] / problem_.rubbery;
    if (problem_.shape.slips_evenly()) return;
    const PrescribedSlope turning(problem_, interval, x,
                                  [&](double at) { return problem_.shape.slip(at).turning - 1; });
    column.segment(stick.shear, rows) -= turning.elastic / problem_.rubbery;
    column.segment(stick.amplitude(), terms_) -= turning.amplitude / problem_.rubbery;
    const PrescribedSlope known(problem_, interval, x, [&](double at) {
      const RigidSlip rigid = problem_.shape.slip(at);
      return rigid.turning - rigid.forward;
    });
    right_.segment(stick.shear, rows) += known.elastic;
    right_.segment(stick.amplitude(), terms_) += known.amplitude;
  }

  RowVectorXd resultant(LeverArm (IndenterShape::*arm)(double, double) const) const {
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

  std::pair<RowVectorXd, double> drive_row() const {
    const double half = edges_.contact.half_length();
    const RowVectorXd row =
        rollres::drive_row(problem_.scene, resultant(&IndenterShape::torque), resultant(&IndenterShape::driving_force));
    return {row / half, drive_target(problem_.scene) / half};
  }

  void drive() {
    auto row = matrix_.row(rotation_);
    if (problem_.scene.drive == Drive::rotation) {
      row(rotation_) = 1;
      right_(rotation_) = problem_.rubbery * (*problem_.scene.rotation_ratio - 1);
    } else if (const std::optional<std::size_t> zone = redundant_slack(problem_, pattern_)) {
      row(sticks_[*zone].slack()) = 1;
    } else {
      const auto [asked, wanted] = drive_row();
      row = asked;
      right_(rotation_) = wanted;
    }
  }

  /// (S23)
  double approach(const VectorXd& pressure, const VectorXd& shear) const {
    if (!problem_.layered()) return NAN;
    const double leading = edges_.contact.to;
    double w = 0;
    for (Index j = 0; j < n_; ++j) {
      const double x = leading - x_(j);
      const LayerSlopes k = problem_.correction->displacement(x) + deep_.displacement(x);
      w -= grid_.weight()(j) * (k(layer_slope::normal) * pressure(j) + k(layer_slope::cross) * shear(j));
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
    const VectorXd pressure = solution_.head(n_), shear = shear_of_ * solution_;
    state.pressure = {pressure, solution_.segment(amplitude_, terms_)};
    state.load = resultant(&IndenterShape::load).dot(solution_);
    state.driving_force = resultant(&IndenterShape::driving_force).dot(solution_);
    state.driving_torque = resultant(&IndenterShape::torque).dot(solution_);
    state.approach = approach(pressure, shear);
    state.edge_means = means_ * solution_;
    state.sources = x_;
    state.pressure_forces = grid_.weight().cwiseProduct(pressure);
    state.shear_forces = grid_.weight().cwiseProduct(shear);
    const double scale = state.load / edges_.contact.half_length();
    state.residuals.resize(pattern_.unknowns());
    state.residuals(0) = solution_(slack_) / scale;
    state.residuals(1) =
        scene.load ? (state.load - *scene.load) / *scene.load : (state.approach - *scene.approach) / *scene.approach;
    if (!sticks_.empty())
      state.rotation_ratio = 1 + solution_(rotation_) / problem_.rubbery;
    else if (scene.drive == Drive::rotation)
      state.rotation_ratio = *scene.rotation_ratio;
    Index residual = 2;
    const std::optional<std::size_t> redundant = redundant_slack(problem_, pattern_);
    for (std::size_t z = 0; z < sticks_.size(); ++z) {
      state.sticks.push_back({solution_.segment(sticks_[z].shear, sticks_[z].zone->count),
                              solution_.segment(sticks_[z].amplitude(), terms_)});
      if (pattern_.slips[z] != 0)
        state.residuals(residual++) =
            (redundant && *redundant == z ? lacking_drive() : solution_(sticks_[z].slack())) / scale;
      if (pattern_.slips[z + 1] != 0) state.residuals(residual++) = root_at_leading_end(z, pressure, shear) / scale;
    }
    state.graded = std::make_shared<const GradedTractions>(
        GradedTractions{grid_, pressure, shear, -retarded_normal_ * pressure - retarded_cross_ * shear,
                        retarded_along_ * shear - retarded_cross_ * pressure});
    return state;
  }

  double lacking_drive() const {
    const auto [row, wanted] = drive_row();
    return wanted - row.dot(solution_);
  }

  /// (S33)
  double root_at_leading_end(std::size_t z, const VectorXd& pressure, const VectorXd& shear) const {
    const GradedZone &stick = *sticks_[z].zone, &slip = grid_.zones()[grid_.zone_of(stick.first) + 1];
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
      while (node > stick.first + fitted - k && (k > 0 ? distance() < wanted : distance() < wanted)) --node;
      double power_of_distance = 1;
      const double d = distance();
      for (int i = 0; i < fitted; ++i, power_of_distance *= d) powers(k, i) = power_of_distance;
      roots(k) = (shear(node) - bound * pressure(node)) / std::pow(d, power);
      --node;
    }
    return SquareSystem(powers).solve(roots)(0) * std::pow((stick.interval.to - stick.interval.from) / scale, power);
  }

  const SpectralProblem& problem_;
  const DeepResponse& deep_;
  SlipPattern pattern_;
  SpectralEdges edges_;
  double friction_;
  GradedGrid grid_;
  Index n_, terms_, slack_, amplitude_, rotation_, size_;
  std::vector<Stick> sticks_;
  VectorXd x_;
  MatrixXd shear_of_;                                           // shear at nodes by unknown
  MatrixXd normal_, along_, cross_;                             // slopes at middles by values at nodes
  MatrixXd retarded_normal_, retarded_along_, retarded_cross_;  // kernels of the retarded parts alone
  MatrixXd matrix_, means_;
  VectorXd right_, solution_;
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
