#include "core/newton/contact_problem.hpp"

#include "core/estimate/grid_choice.hpp"
#include "core/model/contact_surface.hpp"

namespace rollres {

namespace {

/// Where in a cell ahead of its node the rigid slip along y is taken, which a spin makes uneven along x: at the middle
/// the side force of the paper's sphere under camber is 1.1 % too large on 940 nodes, here 0.1 % too small.
constexpr double place_of_spin = 0.4;

}  // namespace

ContactProblem::ContactProblem(const ContactModel& given, const SurfaceGrid& given_grid)
    : model(given),
      grid(given_grid),
      shape(given, share_of_coating(given)),
      law(friction_law(given)),
      friction(given.friction_coefficient > 0),
      lateral(given.lateral()),
      plane(given.dimension == 3),
      smooth_edge(has_smooth_edge(given)),
      drive_target(rollres::drive_target(given)) {
  const Eigen::Index size = grid.size();
  profile.resize(size);
  forward.resize(size);
  turning.resize(size);
  forward_y.resize(size);
  turning_y.resize(size);
  for (Resultant* resultant : {&load, &torque, &driving_force, &resisting})
    for (Vector* arms : {&resultant->of_pressure, &resultant->of_shear_x, &resultant->of_shear_y}) arms->resize(size);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Index i = grid.index(column, row);
      const double x = grid.x(column), y = grid.y(row), area = grid.cell_area() * images(i);
      profile(i) = shape.profile(x, y);
      const RigidSlip rigid = shape.law_slip(x + 0.5 * grid.spacing_x, y);  // where the forward difference is centred
      forward(i) = rigid.forward;
      turning(i) = rigid.turning;
      const RigidSlip across = shape.law_slip(x + place_of_spin * grid.spacing_x, y);
      forward_y(i) = across.forward_y;
      turning_y(i) = across.turning_y;
      const auto keep = [&](Resultant& resultant, LeverArm arm) {
        resultant.of_pressure(i) = area * arm.of_pressure;
        resultant.of_shear_x(i) = area * arm.of_shear_x;
        resultant.of_shear_y(i) = area * arm.of_shear_y;
      };
      keep(load, shape.load(x, y));
      keep(driving_force, shape.driving_force(x, y));
      keep(torque, shape.torque(x, y));
      keep(resisting, shape.resisting_force(x, y));
    }
  if (!given.coating.empty()) {
    idle_ratio = given.flow;
    if (friction && !rotation_given())
      of_coating = {rollres::coating_in_drive(given, {1, 0}), rollres::coating_in_drive(given, {0, 1})};
  }
  drive = {drive_row(model, torque.of_pressure, driving_force.of_pressure),
           drive_row(model, torque.of_shear_x, driving_force.of_shear_x),
           drive_row(model, torque.of_shear_y, driving_force.of_shear_y)};
}

SurfaceGrid mirrored(const SurfaceGrid& grid) {
  if (!grid.folded) return grid;
  SurfaceGrid whole = grid;
  whole.first_row = -(grid.rows - 1);
  whole.rows = grid.whole_rows();
  whole.folded = false;
  return whole;
}

Vector mirrored(const SurfaceGrid& grid, const Vector& values, double parity) {
  if (!grid.folded) return values;
  const Eigen::Index columns = grid.columns, middle = grid.rows - 1;
  Vector whole(columns * grid.whole_rows());
  for (Eigen::Index row = 0; row < grid.rows; ++row) {
    whole.segment((middle - row) * columns, columns) = parity * values.segment(row * columns, columns);
    whole.segment((middle + row) * columns, columns) = values.segment(row * columns, columns);
  }
  return whole;
}

std::vector<double> on_whole_grid(const SurfaceGrid& grid, const Vector& values, double parity) {
  const Vector whole = mirrored(grid, values, parity);
  return {whole.begin(), whole.end()};
}

Vector at_nodes(const SurfaceGrid& grid, const Vector& moved) {
  Vector kept(grid.size());
  for (int row = 0; row < grid.rows; ++row)
    kept.segment(grid.index(0, row), grid.columns) = moved.segment(row * (grid.columns + 1), grid.columns);
  return kept;
}

}  // namespace rollres
