#include "core/newton/contact_problem.hpp"

#include "core/estimate/grid_choice.hpp"
#include "core/model/contact_surface.hpp"

namespace rollres {

ContactProblem::ContactProblem(const ContactModel& given, const SurfaceGrid& half_grid)
    : model(given),
      grid(half_grid),
      shape(given, share_of_coating(given)),
      law(friction_law(given)),
      friction(given.friction_coefficient > 0),
      lateral(given.lateral()),
      plane(given.dimension == 3),
      sideways(-given.skew),
      drive_target(rollres::drive_target(given)) {
  const Eigen::Index size = grid.size();
  profile.resize(size);
  forward.resize(size);
  turning.resize(size);
  for (Resultant* resultant : {&load, &torque, &driving_force}) {
    resultant->of_pressure.resize(size);
    resultant->of_shear_x.resize(size);
  }
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Index i = grid.index(column, row);
      const double x = grid.x(column), y = grid.y(row), area = grid.cell_area() * images(i);
      profile(i) = shape.profile(x, y);
      const RigidSlip rigid = shape.law_slip(x + 0.5 * grid.spacing_x, y);  // where the forward difference is centred
      forward(i) = rigid.forward;
      turning(i) = rigid.turning;
      const auto keep = [&](Resultant& resultant, LeverArm arm) {
        resultant.of_pressure(i) = area * arm.of_pressure;
        resultant.of_shear_x(i) = area * arm.of_shear_x;
      };
      keep(load, shape.load(x, y));
      keep(driving_force, shape.driving_force(x, y));
      keep(torque, shape.torque(x, y));
    }
  if (!given.coating.empty()) {
    idle_ratio = given.flow;
    if (friction && !rotation_given())
      of_coating = {rollres::coating_in_drive(given, {1, 0}), rollres::coating_in_drive(given, {0, 1})};
  }
  drive = {drive_row(model, torque.of_pressure, driving_force.of_pressure),
           drive_row(model, torque.of_shear_x, driving_force.of_shear_x)};
}

SurfaceGrid mirrored(const SurfaceGrid& half) {
  SurfaceGrid whole = half;
  whole.first_row = -(half.rows - 1);
  whole.rows = 2 * half.rows - 1;
  return whole;
}

Vector mirrored(const SurfaceGrid& half, const Vector& values, double parity) {
  const Eigen::Index columns = half.columns, middle = half.rows - 1;
  Vector whole(columns * (2 * half.rows - 1));
  for (Eigen::Index row = 0; row < half.rows; ++row) {
    whole.segment((middle - row) * columns, columns) = parity * values.segment(row * columns, columns);
    whole.segment((middle + row) * columns, columns) = values.segment(row * columns, columns);
  }
  return whole;
}

}  // namespace rollres
