#include "core/newton/coating_power.hpp"

namespace rollres {

namespace {

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

double weight(const ContactProblem& problem, Eigen::Index node) {
  return problem.grid.cell_area() * problem.images(node);
}

/// Derivatives of the displacements w of the coating, times the force with which slopes count: the coefficients the
/// other way, under a pressure of as much.
Displacements under_slopes(const ContactProblem& problem, const InfluenceOperator& influence, const Vector& pressure,
                           const Vector& none) {
  const SurfaceGrid& grid = problem.grid;
  Vector force = Vector::Zero(grid.size());
  for (Eigen::Index i = 0; i < grid.size(); ++i) {
    if (pressure(i) == 0) continue;
    const SlopePlaces places(grid, i);
    const double by_slope = grid.cell_area() * pressure(i) / places.distance;
    const Eigen::Index column = i % grid.columns;
    if (column + 1 < grid.columns) force(i + 1) += by_slope;
    force(column > 0 ? i - 1 : i) -= by_slope;
  }
  return influence.coating_transposed()->apply(force, none, problem.lateral ? none : Vector());
}

}  // namespace

Displacements moved_coating(const InfluenceOperator& influence, const ContactUnknowns& x) {
  if (!influence.coating()) return {};
  return influence.coating()->apply(x.pressure, x.shear_x, x.shear_y);
}

double coating_moment(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x) {
  if (!influence.coating()) return 0;
  const Displacements moved = moved_coating(influence, x);
  double sum = 0;
  for (Eigen::Index i = 0; i < x.pressure.size(); ++i) {
    if (x.pressure(i) == 0) continue;
    const SlopePlaces places(problem.grid, i);
    sum += weight(problem, i) * x.pressure(i) * (moved.w(places.ahead) - moved.w(places.behind)) / places.distance;
  }
  return sum;
}

TractionRow moment_row(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x) {
  const SurfaceGrid& grid = problem.grid;
  const Displacements moved = moved_coating(influence, x);
  const bool sheared = problem.friction;
  const Displacements other =
      under_slopes(problem, influence, x.pressure, sheared ? Vector(Vector::Zero(grid.size())) : Vector());
  TractionRow row;
  row.of_pressure.resize(grid.size());
  if (sheared) row.of_shear_x.resize(grid.size());
  if (sheared && problem.lateral) row.of_shear_y.resize(grid.size());
  for (Eigen::Index i = 0; i < grid.size(); ++i) {
    const SlopePlaces places(grid, i);
    const Eigen::Index at = places.ahead - 1;
    const double slope = (moved.w(places.ahead) - moved.w(places.behind)) / places.distance, images = problem.images(i);
    row.of_pressure(i) = weight(problem, i) * slope + images * other.w(at);
    if (sheared) row.of_shear_x(i) = -images * other.u(at);
    if (sheared && problem.lateral) row.of_shear_y(i) = -images * other.v(at);
  }
  return row;
}

TractionRow coating_in_drive_row(const ContactProblem& problem, const InfluenceOperator& influence,
                                 const ContactUnknowns& x) {
  if (problem.of_coating == 0) return {};
  TractionRow row = moment_row(problem, influence, x);
  for (Vector* part : {&row.of_pressure, &row.of_shear_x, &row.of_shear_y}) *part *= problem.of_coating;
  return row;
}

}  // namespace rollres
