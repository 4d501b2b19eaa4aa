#include "studies/drawing/thinned_chart.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "studies/drawing/chart_frame.hpp"

namespace rollres {

namespace {

constexpr std::size_t most_points = 4000;

/// In which of so many equal steps of an axis a number lies; -1 if it has no place there.
int step_of(double number, const Span& axis, int count) {
  const double place = axis.fraction(number);
  return std::isfinite(place) ? std::min(static_cast<int>(count * std::clamp(place, 0.0, 1.0)), count - 1) : -1;
}

/// How a point is drawn: joined by the line, as a mark alone, as a cross, not at all.
int kind_of(const ChartPoint& point) { return point.joined() ? 0 : point.drawn() ? 1 : point.converged ? 2 : 3; }

/// Places in the curve that are kept, in its order.
std::set<std::size_t> of_line(const ChartCurve& curve, const Span& along) {
  constexpr int steps = 1000;
  std::set<std::size_t> kept;
  const std::vector<ChartPoint>& points = curve.points;
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    const int step = step_of(points[begin].x, along, steps), kind = kind_of(points[begin]);
    std::size_t lowest = begin, highest = begin;
    for (end = begin;
         end < points.size() && step_of(points[end].x, along, steps) == step && kind_of(points[end]) == kind; ++end) {
      if (points[end].y < points[lowest].y) lowest = end;
      if (points[end].y > points[highest].y) highest = end;
    }
    kept.insert({begin, lowest, highest, end - 1});
  }
  return kept;
}

std::set<std::size_t> of_marks(const ChartCurve& curve, const ChartSpans& axes) {
  constexpr int along = 240, up = 160;
  std::set<std::size_t> kept;
  std::set<std::tuple<int, int, int>> taken;
  const std::vector<ChartPoint>& points = curve.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (taken.insert({step_of(points[i].x, axes.x, along), step_of(points[i].y, axes.y, up), kind_of(points[i])})
            .second)
      kept.insert(i);
  for (double ChartPoint::*const value : {&ChartPoint::x, &ChartPoint::y}) {
    const auto [least, greatest] = std::minmax_element(
        points.begin(), points.end(), [&](const auto& one, const auto& other) { return one.*value < other.*value; });
    kept.insert(
        {static_cast<std::size_t>(least - points.begin()), static_cast<std::size_t>(greatest - points.begin())});
  }
  return kept;
}

std::size_t points_of(const ChartRequest& request) {
  std::size_t count = 0;
  for (const ChartCurve& curve : request.curves) count += curve.points.size();
  return count;
}

}  // namespace

ChartRequest thinned(const ChartRequest& request) {
  const std::size_t all = points_of(request);
  if (all <= most_points) return request;
  const ChartSpans axes = chart_spans(request);
  ChartRequest drawn = request;
  for (ChartCurve& curve : drawn.curves) {
    if (curve.points.empty()) continue;
    std::vector<ChartPoint> points;
    for (const std::size_t place : (request.lines && curve.line) ? of_line(curve, axes.x) : of_marks(curve, axes))
      points.push_back(curve.points[place]);
    curve.points = std::move(points);
  }
  const std::size_t left = points_of(drawn);
  if (2 * left > all) return request;  // as where a line runs to and fro
  drawn.subtitle += (drawn.subtitle.empty() ? "" : ", ") + ("drawn are " + std::to_string(left)) + " of " +
                    std::to_string(all) + " points";
  return drawn;
}

}  // namespace rollres
