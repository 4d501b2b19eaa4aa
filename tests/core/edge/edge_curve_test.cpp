#include "core/edge/edge_curve.hpp"

#include <cmath>

#include "tests/catch.hpp"
#include "tests/core/edge/edge_circle.hpp"

using namespace rollres;

TEST_CASE("the edge of Hertz's contact is found inside the cells", "[core][contact_edge]") {
  const Circle circle(1e-3);
  Vector pressure = Vector::Zero(circle.half.size());
  for (int row = 0; row < circle.half.rows; ++row)
    for (int column = 0; column < circle.half.columns; ++column)
      if (circle.level(circle.half.first_column + column, row) > 0)
        pressure(circle.half.index(column, row)) = 1e6 * circle.mean(column, row);
  const EdgeCurve curve = edge_curve(circle.half, pressure);
  REQUIRE(curve.known());
  CHECK(curve.centre(0) == Approx(0.37e-3).margin(2e-5));
  for (const double y : {0.0, 6e-3, 11e-3}) {
    double squared = 0;
    for (Eigen::Index k = 0; k < curve.squared_length.size(); ++k)
      squared += curve.squared_length(k) * std::pow(y / curve.unit, 2 * k);
    const double length = std::sqrt(12.3e-3 * 12.3e-3 - y * y);
    // Across the edge, of a cell: p^2 of means over cells is bent where rows cut the edge aslant.
    CHECK(std::abs(std::sqrt(squared) - length) * length / 12.3e-3 < 0.06e-3);
  }
  CHECK_FALSE(edge_curve(circle.half, Vector::Zero(circle.half.size())).known());
}

TEST_CASE("a ring of cells tells the edge of a contact to a fiftieth of a cell, all around", "[core][edge_curve]") {
  // Pressures that lean forwards, as a viscoelastic layer's; the truth is the circle they were drawn on.
  const Circle circle(1e-3, 19.4);
  for (const double lean : {0.0, 0.5}) {
    Vector pressure = Vector::Zero(circle.half.size());
    for (int row = 0; row < circle.half.rows; ++row)
      for (int column = 0; column < circle.half.columns; ++column)
        pressure(circle.half.index(column, row)) =
            circle.mean(column, row, [&](double x, double) { return 1e6 * (1 + lean * x / circle.radius); });
    const EdgeCurve curve = edge_around(circle.half, pressure, {0.5, 5, 0});
    REQUIRE(curve.known());
    const EdgeCurve shrunk = edge_around(circle.half, pressure, {0.5, 5, 0.1});
    for (int i = 0; i < 20; ++i) {
      const double angle = M_PI * (i + 0.5) / 20, a = circle.half.spacing_x;
      const double x = (circle.centre + circle.radius * std::cos(angle)) * a, y = circle.radius * std::sin(angle) * a;
      const auto outside = [&](const EdgeCurve& of) {  // of the point, in cells
        const CurveRow at(of, y);
        return -at.level(x) / at.steepness(x) / a;
      };
      CHECK(std::abs(outside(curve)) < 0.02);
      CHECK(outside(shrunk) - outside(curve) == Approx(0.1).margin(0.003));
    }
  }
}

TEST_CASE("where pressures tell of no edge none is stated", "[core][edge_curve]") {
  const Circle circle(1e-3), small(1e-3, 3.2);
  CHECK_FALSE(edge_around(circle.half, Vector::Zero(circle.half.size()), {0.5, 5, 0}).known());
  Vector few = Vector::Zero(small.half.size()), flat = Vector::Zero(circle.half.size());
  for (int row = 0; row < small.half.rows; ++row)
    for (int column = 0; column < small.half.columns; ++column)
      few(small.half.index(column, row)) = small.mean(column, row);
  CHECK_FALSE(edge_around(small.half, few, {2, 5, 0}).known());
  // A punch's pressure does not fall towards its edge.
  for (int row = 0; row < circle.half.rows; ++row)
    for (int column = 0; column < circle.half.columns; ++column)
      flat(circle.half.index(column, row)) = circle.level(circle.half.first_column + column, row) > 0 ? 1e6 : 0;
  CHECK_FALSE(edge_around(circle.half, flat, {0.5, 5, 0}).known());
}
