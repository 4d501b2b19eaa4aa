// Covers influence_terms, padded_convolution, plane_convolution, surface_convolution too.

#include "core/convolution/influence_operator.hpp"

#include <random>

#include "core/newton/contact_problem.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

Vector random_vector(Eigen::Index size, std::mt19937_64& generator) {
  std::uniform_real_distribution<double> between(-1, 1);
  Vector values(size);
  for (double& value : values) value = between(generator);
  return values;
}

/// Sums over all nodes of the whole grid, one by one.
Displacements dense_sums(const InfluenceTable& table, const SurfaceGrid& half, bool sphere, const Vector& pressure,
                         const Vector& shear_x, const Vector& shear_y) {
  const int columns = half.columns, rows = half.rows;
  Displacements moved;
  moved.w = moved.u = moved.v = Vector::Zero((columns + 1) * rows);
  using enum Direction;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column <= columns; ++column)
      for (int r = half.folded ? 1 - rows : 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
          const Eigen::Index from = half.index(c, std::abs(r)), to = row * (columns + 1) + column;
          const int dx = column - c, dy = row - r;
          const double sign = r < 0 ? -1 : 1;
          const double fw = -half.cell_area() * pressure(from), fu = half.cell_area() * shear_x(from);
          const double fv = sphere ? sign * half.cell_area() * shear_y(from) : 0;
          moved.w(to) += table(w, w, dx, dy) * fw + table(w, u, dx, dy) * fu;
          moved.u(to) += table(u, w, dx, dy) * fw + table(u, u, dx, dy) * fu;
          if (!sphere) continue;
          moved.w(to) += table(w, v, dx, dy) * fv;
          moved.u(to) += table(u, v, dx, dy) * fv;
          moved.v(to) += table(v, w, dx, dy) * fw + table(v, u, dx, dy) * fu + table(v, v, dx, dy) * fv;
        }
  return moved;
}

double relative(const Vector& got, const Vector& expected) {
  return (got - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("convolution by Fourier transform equals sums over all nodes, on half a grid with symmetry",
          "[core][influence_operator]") {
  std::mt19937_64 generator(7);
  for (const RollingScene& scene : {paper_cylinder(), paper_sphere()}) {
    const bool sphere = scene.indenter == Indenter::sphere;
    SurfaceGrid half;
    half.spacing_x = 0.4e-3;
    half.spacing_y = sphere ? 0.5e-3 : 1;
    half.first_column = -4;
    half.columns = 11;
    half.rows = sphere ? 6 : 1;
    half.folded = sphere;
    const InfluenceTable table = influence_table(scene, mirrored(half));
    const Vector pressure = random_vector(half.size(), generator), shear_x = random_vector(half.size(), generator);
    Vector shear_y;
    if (sphere) {
      shear_y = random_vector(half.size(), generator);
      shear_y.head(half.columns).setZero();  // odd in y
    }
    const Displacements expected = dense_sums(table, half, sphere, pressure, shear_x, shear_y);
    const Displacements got = InfluenceOperator(scene, table, half, true).apply(pressure, shear_x, shear_y);
    // Rounding of transforms of some hundred values
    CHECK(relative(got.w, expected.w) < 1e-13);
    CHECK(relative(got.u, expected.u) < 1e-13);
    if (sphere) CHECK(relative(got.v, expected.v) < 1e-13);

    const Vector none = Vector::Zero(half.size());
    const Displacements pressed = dense_sums(table, half, sphere, pressure, none, none);
    const InfluenceOperator frictionless_operator(scene, table, half, false);
    CHECK(relative(frictionless_operator.apply(pressure, {}, {}).w, pressed.w) < 1e-13);

    const InfluenceOperator with_friction(scene, table, half, true);
    CHECK(with_friction.self_normal() ==
          Approx(table(Direction::w, Direction::w, 0) * half.cell_area()).epsilon(1e-14));
    CHECK(with_friction.self_slip() > 0);
  }
}

TEST_CASE("of any tractions on a whole grid it equals the sums, too", "[core][influence_operator]") {
  std::mt19937_64 generator(8);
  const RollingScene scene = paper_sphere();
  SurfaceGrid grid;
  grid.spacing_x = 0.4e-3;
  grid.spacing_y = 0.5e-3;
  grid.first_column = -4;
  grid.first_row = -3;
  grid.columns = 10;
  grid.rows = 8;
  const InfluenceTable table = influence_table(scene, grid);
  const Vector pressure = random_vector(grid.size(), generator), shear_x = random_vector(grid.size(), generator),
               shear_y = random_vector(grid.size(), generator), none = Vector::Zero(grid.size());
  const Displacements expected = dense_sums(table, grid, true, pressure, shear_x, shear_y);
  const InfluenceOperator influence(scene, table, grid, true);
  const Displacements got = influence.apply(pressure, shear_x, shear_y);
  CHECK(relative(got.w, expected.w) < 1e-13);
  CHECK(relative(got.u, expected.u) < 1e-13);
  CHECK(relative(got.v, expected.v) < 1e-13);
  CHECK(relative(influence.apply(pressure, {}, {}).w, dense_sums(table, grid, true, pressure, none, none).w) < 1e-13);
}
