#include "core/newton/contact_problem.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

ContactProblem::ContactProblem(const RollingScene& given, const SurfaceGrid& half_grid)
    : scene(given),
      grid(half_grid),
      sphere(given.indenter == Indenter::sphere),
      friction(given.friction_coefficient > 0) {
  const double radius = scene.radius, area = grid.cell_area();
  const Eigen::Index size = grid.size();
  profile.resize(size);
  rolling_radius.resize(size);
  for (Resultant* resultant : {&load, &torque, &driving_force, &drive}) {
    resultant->of_pressure = Vector::Zero(size);
    resultant->of_shear_x = Vector::Zero(size);
  }
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Index i = grid.index(column, row);
      const double x = grid.x(column), y = sphere ? grid.y(row) : 0;
      const double height = std::sqrt(std::max(radius * radius - x * x - y * y, 1e-4 * radius * radius));
      profile(i) = (x * x + y * y) / (radius + height);  // R - height without cancellation
      if (sphere) {
        const double count = area * (grid.first_row + row == 0 ? 1 : 2);
        rolling_radius(i) = std::sqrt(std::max(1 - y * y / (radius * radius), 1e-4));
        load.of_pressure(i) = count;
        torque.of_pressure(i) = count * x;
        torque.of_shear_x(i) = -count * height;
        driving_force.of_shear_x(i) = count;
      } else {
        const double cosine = height / radius;
        rolling_radius(i) = 1;
        load.of_pressure(i) = area * cosine;
        load.of_shear_x(i) = -area * x / radius;
        torque.of_shear_x(i) = -area * radius;
        driving_force.of_pressure(i) = area * x / radius;
        driving_force.of_shear_x(i) = area * cosine;
      }
    }
  // Divided by R, so that the row is a force like the load's.
  drive.of_pressure = torque.of_pressure / radius;
  drive.of_shear_x = torque.of_shear_x / radius;
  if (scene.drive == Drive::top_force) {
    drive.of_pressure -= driving_force.of_pressure;
    drive.of_shear_x -= driving_force.of_shear_x;
  }
  if (scene.drive == Drive::torque) drive_target = *scene.driving_torque / radius;
}

SurfaceGrid mirrored(const SurfaceGrid& half, bool sphere) {
  SurfaceGrid whole = half;
  if (sphere) {
    whole.first_row = -(half.rows - 1);
    whole.rows = 2 * half.rows - 1;
  }
  return whole;
}

Vector mirrored(const SurfaceGrid& half, bool sphere, const Vector& values, double parity) {
  if (!sphere) return values;
  const Eigen::Index columns = half.columns, middle = half.rows - 1;
  Vector whole(columns * (2 * half.rows - 1));
  for (Eigen::Index row = 0; row < half.rows; ++row) {
    whole.segment((middle - row) * columns, columns) = parity * values.segment(row * columns, columns);
    whole.segment((middle + row) * columns, columns) = values.segment(row * columns, columns);
  }
  return whole;
}

}  // namespace rollres
