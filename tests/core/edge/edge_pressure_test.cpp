#include "core/edge/edge_pressure.hpp"

// Covers edge_cells.cpp, whose shapes and reaches these operators are made of.

#include <cmath>

#include "core/convolution/influence_operator.hpp"
#include "core/newton/contact_problem.hpp"
#include "tests/catch.hpp"
#include "tests/core/edge/edge_circle.hpp"

using namespace rollres;

TEST_CASE("uneven cells under Hertz's pressure move a half-space as Hertz says, up to the edge",
          "[core][edge_pressure]") {
  const RollingScene scene = on_half_space(0.3);
  const Circle circle(1e-3);
  const SurfaceGrid& half = circle.half;
  const double a = half.spacing_x;
  const EdgePressure edge(scene, half, circle.curve());
  REQUIRE(edge.fits());

  // Forces of the cells: what a cell bears of those whose nodes lie outside stands in of_cells.
  const Vector own = edge.of_cells(Vector::Ones(half.size()));
  Vector pressure = Vector::Zero(half.size());
  double force = 0, moment = 0;
  for (const Eigen::Index node : edge.contact()) {
    const int column = static_cast<int>(node % half.columns), row = static_cast<int>(node / half.columns);
    pressure(node) = circle.mean(column, row) / circle.radius / own(node);
  }
  const Vector even = edge.even(pressure);
  for (int row = 0; row < half.rows; ++row)
    for (int column = 0; column < half.columns; ++column) {
      const double of_cell = (row == 0 ? 1 : 2) * even(half.index(column, row));
      force += of_cell;
      moment += of_cell * (half.first_column + column);
    }
  CHECK(force == Approx(2 * M_PI / 3 * circle.radius * circle.radius).epsilon(1e-4));
  CHECK(moment / force == Approx(circle.centre).margin(1e-4));

  // Johnson (1985), eq. 3.41a: w = (1 - nu) pi p0/(8 G a) (2 a^2 - r^2); upwards is positive here.
  const InfluenceOperator influence(scene, influence_table(scene, mirrored(half)), half, false);
  const auto worst = [&](const Displacements& moved, bool near) {
    Vector w(half.size());
    for (int row = 0; row < half.rows; ++row)
      w.segment(row * half.columns, half.columns) = moved.w.segment(row * (half.columns + 1), half.columns);
    if (near) edge.add_near(pressure, w);
    double error = 0;
    for (const Eigen::Index node : edge.contact()) {
      const double x = half.x(static_cast<int>(node % half.columns)) / a - circle.centre;
      const double y = static_cast<double>(node / half.columns);
      const double radius = circle.radius;
      const double exact = -0.7 * M_PI / (8 * radius) * (2 * radius * radius - x * x - y * y) * a;
      error = std::max(error, std::abs(w(node) / exact - 1));
    }
    return error;
  };
  CHECK(worst(influence.apply(even, {}, {}), true) < 1.2e-3);
  CHECK(worst(influence.apply(pressure, {}, {}), false) > 4e-3);  // even cells
}

TEST_CASE("a contact at the border of its grid does not fit", "[core][edge_pressure]") {
  Circle circle(1e-3);
  circle.half.rows = 12;
  CHECK_FALSE(EdgePressure(on_half_space(0.5), circle.half, circle.curve()).fits());
}
