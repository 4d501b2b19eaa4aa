#include "core/newton/contact_powers.hpp"

#include <numbers>

namespace rollres {

namespace {

/// Rolling resistance over the moment of the load's halves: where it is less, the losses tell it better than the
/// resultants, the difference of these halves.
constexpr double cancelled = 1e-2, conditioned = 0.1;

double share_of_losses(double resistance, double halves) {
  const double relative = std::abs(resistance) / halves;
  if (!(relative > cancelled)) return 1;
  const double place = std::log(conditioned / relative) / std::log(conditioned / cancelled);
  const double t = std::clamp(place, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// What friction takes over V [N] where nodes slip, with the slip of its law.
double friction_by_law(const ContactProblem& problem, const Displacements& moved, const Displacements& coating,
                       const ContactUnknowns& unknowns, const std::vector<Zone>& zone) {
  const SurfaceGrid& grid = problem.grid;
  const Eigen::Index size = grid.size();
  Vector slip_x = Vector::Zero(size), slip_y = Vector::Zero(size);
  if (problem.lateral) problem.edge.add(unknowns.shear_x, unknowns.shear_y, slip_x, slip_y);
  const double turning = problem.turning_ratio(unknowns.rotation_ratio);
  double sum = 0;
  for (Eigen::Index i = 0; i < size; ++i) {
    if (zone[static_cast<std::size_t>(i)] != Zone::slip) continue;
    const Eigen::Index at = i / grid.columns * (grid.columns + 1) + i % grid.columns;
    const auto slope = [&](const Vector& values) { return (values(at + 1) - values(at)) / grid.spacing_x; };
    const double weight = grid.cell_area() * problem.images(i);
    if (coating.w.size() == 0) {
      sum += weight * unknowns.shear_x(i) * (slip_x(i) + problem.slip_x(i, slope(moved.u), unknowns.rotation_ratio));
      if (problem.lateral)
        sum += weight * unknowns.shear_y(i) * (slip_y(i) + problem.slip_y(i, slope(moved.v), unknowns.rotation_ratio));
      continue;
    }
    const double x = grid.x(static_cast<int>(i % grid.columns)), y = grid.y(static_cast<int>(i / grid.columns));
    const RigidSlip rigid = problem.shape.slip(x + 0.5 * grid.spacing_x, y);
    sum += weight * unknowns.shear_x(i) *
           (slip_x(i) + rigid.forward - turning * rigid.turning + slope(moved.u) + (turning - 1) * slope(coating.u));
    if (problem.lateral)
      sum +=
          weight * unknowns.shear_y(i) *
          (slip_y(i) + rigid.forward_y - turning * rigid.turning_y + slope(moved.v) + (turning - 1) * slope(coating.v));
  }
  return sum;
}

/// Places among displacements, which have one column more, between which the slope at a node is taken.
struct SlopePlaces {
  Eigen::Index behind, ahead;
  double distance;  // [m]

  SlopePlaces(const SurfaceGrid& grid, Eigen::Index node) {
    const Eigen::Index column = node % grid.columns, at = node / grid.columns * (grid.columns + 1) + column;
    behind = column > 0 ? at - 1 : at;
    ahead = at + 1;
    distance = static_cast<double>(ahead - behind) * grid.spacing_x;
  }
};

double node_weight(const ContactProblem& problem, Eigen::Index node) {
  return problem.grid.cell_area() * problem.images(node);
}

/// Shear of a ring at a node, as its work at the radius that pressure leaves counts in (N3e): over R.
double shear_on_ring(const ContactProblem& problem, const ContactUnknowns& x, Eigen::Index node) {
  return problem.friction && problem.model.ring() ? x.shear_x(node) / problem.model.radius : 0;
}

/// Derivatives of the displacements w of the coating, times the force with which their slopes and they themselves
/// count: the coefficients the other way, under a pressure of as much.
Displacements under_weights(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                            const CoatingMoments& factors, const Vector& none) {
  const SurfaceGrid& grid = problem.grid;
  Vector force = Vector::Zero(grid.size());
  for (Eigen::Index i = 0; i < grid.size(); ++i) {
    if (x.pressure(i) == 0) continue;
    const SlopePlaces places(grid, i);
    const double by_slope = factors.pressed * grid.cell_area() * x.pressure(i) / places.distance;
    const Eigen::Index column = i % grid.columns;
    if (column + 1 < grid.columns) force(i + 1) += by_slope;
    force(column > 0 ? i - 1 : i) -= by_slope;
    force(i) += factors.sheared * grid.cell_area() * shear_on_ring(problem, x, i);
  }
  return influence.coating_transposed()->apply(force, none, problem.lateral ? none : Vector());
}

}  // namespace

ContactPowers contact_powers(const ContactProblem& problem, const Displacements& moved, const Displacements& coating,
                             const ContactUnknowns& unknowns, const std::vector<Zone>& zone) {
  const SurfaceGrid& grid = problem.grid;
  ContactPowers powers;
  const double turning = problem.turning_ratio(unknowns.rotation_ratio);
  powers.load_found = !problem.model.load;
  const bool coated = coating.w.size() > 0;
  double load = 0, nodes = 0, borne = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Index i = grid.index(column, row), at = static_cast<Eigen::Index>(row) * (grid.columns + 1) + column;
      if (zone[static_cast<std::size_t>(i)] == Zone::free) continue;
      const double x = grid.x(column), y = grid.y(row), weight = grid.cell_area() * problem.images(i);
      const auto slope = [&](const Vector& values) {
        const Eigen::Index behind = column > 0 ? at - 1 : at;
        return (values(at + 1) - values(behind)) / (static_cast<double>(at + 1 - behind) * grid.spacing_x);
      };
      const double force = weight * unknowns.pressure(i);
      load += force;
      nodes += problem.images(i);
      if (zone[static_cast<std::size_t>(i)] == Zone::stick) powers.sticking += force;
      const double force_u = problem.friction ? weight * unknowns.shear_x(i) : 0;
      const double force_v = problem.friction && problem.lateral ? weight * unknowns.shear_y(i) : 0;
      powers.halves += std::abs(force * x) / problem.shape.radius();
      const double pressed = coated ? slope(coating.w) : 0;
      powers.coating.pressed += force * pressed;
      powers.layer += force * (slope(moved.w) + (turning - 1) * pressed);
      if (coated) {
        const double sheared = weight * shear_on_ring(problem, unknowns, i) * coating.w(at);
        powers.coating.sheared += sheared;
        powers.layer -= turning * sheared;
      }
      const LeverArm unbalanced = problem.shape.unbalanced_power(turning, x, y);
      powers.unbalanced += unbalanced(force, force_u);
      powers.pushed += unbalanced(force, 0);
      if (!problem.friction) continue;
      double along = slope(moved.u), across = problem.lateral ? slope(moved.v) : 0;
      if (coated) along += (turning - 1) * slope(coating.u);
      if (coated && problem.lateral) across += (turning - 1) * slope(coating.v);
      const RigidSlip rigid = problem.shape.slip(x, y);
      powers.layer -= force_u * along + force_v * across;
      powers.drawn += force_u;
      borne += weight * problem.law.bound(unknowns.pressure(i));
      powers.friction += force_u * (rigid.forward + along - turning * rigid.turning) +
                         force_v * (rigid.forward_y + across - turning * rigid.turning_y);
    }
  powers.unbalanced += (problem.shape.of_coating() - 1) * (turning - 1) * powers.coating.pressed;
  if (problem.friction) powers.by_law = friction_by_law(problem, moved, coating, unknowns, zone);
  if (load > 0) powers.sticking /= load;
  powers.drawn = load > 0 && problem.friction ? std::min(1.0, std::abs(powers.drawn) / borne) : 1;
  powers.cells = std::sqrt(nodes / std::numbers::pi);
  powers.resultants = problem.resistance(unknowns.pressure, unknowns.shear_x, unknowns.shear_y, unknowns.rotation_ratio,
                                         powers.coating);
  powers.share = share_of_losses(powers.losses(), powers.halves);
  return powers;
}

Displacements moved_coating(const InfluenceOperator& influence, const ContactUnknowns& x) {
  if (!influence.coating()) return {};
  return influence.coating()->apply(x.pressure, x.shear_x, x.shear_y);
}

CoatingMoments coating_moments(const ContactProblem& problem, const InfluenceOperator& influence,
                               const ContactUnknowns& x) {
  if (!influence.coating()) return {};
  const Displacements moved = moved_coating(influence, x);
  CoatingMoments moments;
  for (Eigen::Index i = 0; i < x.pressure.size(); ++i) {
    if (x.pressure(i) == 0) continue;
    const SlopePlaces places(problem.grid, i);
    const double weight = node_weight(problem, i);
    moments.pressed += weight * x.pressure(i) * (moved.w(places.ahead) - moved.w(places.behind)) / places.distance;
    moments.sheared += weight * shear_on_ring(problem, x, i) * moved.w(places.ahead - 1);
  }
  return moments;
}

TractionRow moments_row(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                        const CoatingMoments& factors) {
  const SurfaceGrid& grid = problem.grid;
  const Displacements moved = moved_coating(influence, x);
  const bool sheared = problem.friction;
  const Displacements other =
      under_weights(problem, influence, x, factors, sheared ? Vector(Vector::Zero(grid.size())) : Vector());
  TractionRow row;
  row.of_pressure.resize(grid.size());
  if (sheared) row.of_shear_x.resize(grid.size());
  if (sheared && problem.lateral) row.of_shear_y.resize(grid.size());
  for (Eigen::Index i = 0; i < grid.size(); ++i) {
    const SlopePlaces places(grid, i);
    const Eigen::Index at = places.ahead - 1;
    const double slope = (moved.w(places.ahead) - moved.w(places.behind)) / places.distance, images = problem.images(i);
    row.of_pressure(i) = factors.pressed * node_weight(problem, i) * slope + images * other.w(at);
    if (sheared) row.of_shear_x(i) = -images * other.u(at);
    if (sheared && problem.model.ring())
      row.of_shear_x(i) += factors.sheared * node_weight(problem, i) * moved.w(at) / problem.model.radius;
    if (sheared && problem.lateral) row.of_shear_y(i) = -images * other.v(at);
  }
  return row;
}

TractionRow coating_in_drive_row(const ContactProblem& problem, const InfluenceOperator& influence,
                                 const ContactUnknowns& x) {
  if (!problem.coating_drives()) return {};
  return moments_row(problem, influence, x, problem.of_coating);
}

void ContactPowers::take(const EdgeCorrection& correction) {
  constexpr double better_conditioned = 10;
  edge = correction.trust * correction.change;
  share = share_of_losses(std::pow(better_conditioned, correction.trust) * losses(), halves);
}

void add_resistance(const ContactModel& model, double change, RollingSolution& solution) {
  solution.rolling_resistance += change;
  solution.rolling_resistance_coefficient = solution.rolling_resistance / solution.load;
  const double ratio = std::isnan(solution.rotation_ratio) ? 0 : solution.rotation_ratio;
  if (model.drive == Drive::top_force && model.friction_coefficient > 0) {
    solution.driving_force += change / (1 + ratio);
    solution.driving_torque += change / (1 + ratio) * model.radius;
  } else {
    solution.driving_force += change;
  }
}

}  // namespace rollres
