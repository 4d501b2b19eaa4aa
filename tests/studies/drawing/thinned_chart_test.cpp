#include "studies/drawing/thinned_chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/catch.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

constexpr std::size_t many = 50'000;

/// A curve with one high point, one low one, a gap, and a point that did not converge, each a place wide.
ChartRequest of_many_points() {
  ChartRequest request{.title = "many", .x = {"speed", "V", "m/s", true}, .y = {"load"}, .curves = {{"one", {}}}};
  for (std::size_t i = 0; i < many; ++i)
    request.curves[0].points.push_back(
        {std::pow(10, 3e-4 * static_cast<double>(i)), 1 + 1e-5 * static_cast<double>(i)});
  request.curves[0].points[12'345].y = 7;
  request.curves[0].points[23'456].y = -3;
  request.curves[0].points[34'567].y = std::numeric_limits<double>::quiet_NaN();
  request.curves[0].points[40'001].converged = false;
  return request;
}

bool has(const ChartCurve& curve, const auto& wanted) {
  return std::any_of(curve.points.begin(), curve.points.end(), wanted);
}

}  // namespace

TEST_CASE("of a curve of many points its ends, extremes, gaps and failures are drawn", "[studies][chart]") {
  const ChartRequest request = of_many_points(), drawn = thinned(request);
  const std::vector<ChartPoint>&all = request.curves[0].points, &kept = drawn.curves[0].points;
  CHECK(kept.size() < 4100);
  CHECK(kept.front().x == all.front().x);
  CHECK(kept.back().x == all.back().x);
  CHECK(has(drawn.curves[0], [](const ChartPoint& point) { return point.y == 7; }));
  CHECK(has(drawn.curves[0], [](const ChartPoint& point) { return point.y == -3; }));
  CHECK(has(drawn.curves[0], [](const ChartPoint& point) { return std::isnan(point.y); }));
  CHECK(has(drawn.curves[0], [](const ChartPoint& point) { return !point.converged; }));
  CHECK(std::is_sorted(kept.begin(), kept.end(), [](const auto& one, const auto& other) { return one.x < other.x; }));
  CHECK(drawn.subtitle == "drawn are " + std::to_string(kept.size()) + " of 50000 points");
}

TEST_CASE("of many marks those in one place are one, and the outermost remain", "[studies][chart]") {
  ChartRequest request = of_many_points();
  request.lines = false;
  const ChartRequest drawn = thinned(request);
  const std::vector<ChartPoint>& kept = drawn.curves[0].points;
  CHECK(kept.size() < 1000);
  CHECK(kept.front().x == request.curves[0].points.front().x);
  CHECK(kept.back().x == request.curves[0].points.back().x);
  CHECK(has(drawn.curves[0], [](const ChartPoint& point) { return point.y == 7; }));
  CHECK(has(drawn.curves[0], [](const ChartPoint& point) { return point.y == -3; }));
}

TEST_CASE("a chart of as many points as a picture shows is drawn whole", "[studies][chart]") {
  ChartRequest request = of_many_points();
  request.curves[0].points.resize(4000);
  const ChartRequest drawn = thinned(request);
  CHECK(drawn.curves[0].points.size() == 4000);
  CHECK(drawn.subtitle.empty());
}
