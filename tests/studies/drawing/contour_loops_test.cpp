#include "studies/drawing/contour_loops.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

/// A field on [-1, 1]^2.
PlaneField sampled(int nodes, const std::function<double(double, double)>& value) {
  PlaneField field;
  for (int i = 0; i < nodes; ++i) field.x.push_back(-1 + 2.0 * i / (nodes - 1));
  field.y = field.x;
  for (const double y : field.y)
    for (const double x : field.x) field.values.push_back(value(x, y));
  return field;
}

}  // namespace

TEST_CASE("the contour lines of a cone are circles, to second order in the spacing", "[studies][contour]") {
  const auto cone = [](double x, double y) { return -std::hypot(x, y); };
  double error_before = 0;
  for (const int nodes : {21, 41, 81}) {
    const auto loops = contour_loops(sampled(nodes, cone), std::array{-0.7, -0.35}, nothing);
    REQUIRE(loops.size() == 2);
    CHECK(loops[0].level == -0.7);
    CHECK(loops[1].level == -0.35);
    CHECK((loops[0].higher_inside && loops[1].higher_inside));
    const double error = std::abs(loops[0].area - M_PI * 0.49);
    if (nodes > 21) CHECK(error < 0.35 * error_before);
    error_before = error;
    for (const auto& [x, y] : loops[0].points) CHECK(std::hypot(x, y) == Approx(0.7).margin(2.0 / (nodes * nodes)));
  }
  CHECK(error_before < 1e-3);
}

TEST_CASE("a ridge round a hollow has an outer and an inner loop, the larger first", "[studies][contour]") {
  const auto ridge = [](double x, double y) { return -std::abs(std::hypot(x, y) - 0.6); };
  const auto loops = contour_loops(sampled(81, ridge), std::array{-0.15}, nothing);
  REQUIRE(loops.size() == 2);
  CHECK(loops[0].higher_inside);
  CHECK_FALSE(loops[1].higher_inside);
  CHECK(loops[0].area == Approx(M_PI * 0.75 * 0.75).epsilon(2e-3));
  CHECK(loops[1].area == Approx(M_PI * 0.45 * 0.45).epsilon(5e-3));
}

TEST_CASE("a loop runs along the border of the grid where the outside is on the other side", "[studies][contour]") {
  const PlaneField slope = sampled(5, [](double x, double) { return x; });
  const auto low_outside = contour_loops(slope, std::array{-2.0, 0.25}, nothing);
  REQUIRE(low_outside.size() == 2);
  CHECK(low_outside[0].area == Approx(4));
  CHECK(low_outside[1].area == Approx(2 * 0.75));
  const auto level_outside = contour_loops(slope, std::array{-0.25}, 0.0);
  REQUIRE(level_outside.size() == 1);
  CHECK_FALSE(level_outside[0].higher_inside);
  CHECK(level_outside[0].area == Approx(2 * 0.75));
}

TEST_CASE("at a saddle the loops neither cross nor lose a crossing", "[studies][contour]") {
  const PlaneField saddle = sampled(2, [](double x, double y) { return x * y; });
  const auto joined = contour_loops(saddle, std::array{-0.5}, nothing),
             apart = contour_loops(saddle, std::array{0.5}, nothing);
  CHECK(joined.size() == 1);
  CHECK(apart.size() == 2);
  CHECK(joined[0].area == Approx(4 - 2 * 0.5 * 0.5 * 0.5));
  CHECK(apart[0].area == Approx(0.5 * 0.5 * 0.5));
}
