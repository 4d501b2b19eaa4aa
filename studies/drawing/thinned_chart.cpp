#include "studies/drawing/thinned_chart.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

namespace rollres {

namespace {

constexpr std::size_t most_points = 4000;

/// Places along an axis in equal steps of the picture.
class Steps {
 public:
  Steps(const ChartRequest& request, const ChartAxis& axis, double ChartPoint::*value, int count)
      : value_(value), count_(count) {
    bool positive = axis.logarithmic;
    double least = INFINITY, greatest = -INFINITY;
    const auto each = [&](const auto& act) {
      for (const ChartCurve& curve : request.curves)
        for (const ChartPoint& point : curve.points)
          if (std::isfinite(point.*value)) act(point.*value);
    };
    each([&](double number) { positive = positive && number > 0; });
    logarithmic_ = positive;
    each([&](double number) {
      least = std::min(least, drawn(number));
      greatest = std::max(greatest, drawn(number));
    });
    from_ = least;
    width_ = greatest > least ? greatest - least : 1;
  }

  int operator()(const ChartPoint& point) const {
    const double number = point.*value_;
    return std::isfinite(number)
               ? std::clamp(static_cast<int>(count_ * (drawn(number) - from_) / width_), 0, count_ - 1)
               : -1;
  }

 private:
  double drawn(double number) const { return logarithmic_ ? std::log(number) : number; }

  double ChartPoint::*value_;
  int count_;
  bool logarithmic_ = false;
  double from_ = 0, width_ = 1;
};

/// How a point is drawn: joined by the line, as a mark alone, as a cross, not at all.
int kind_of(const ChartPoint& point) { return point.joined() ? 0 : point.drawn() ? 1 : point.converged ? 2 : 3; }

/// Places in the curve that are kept, in its order.
std::set<std::size_t> of_line(const ChartCurve& curve, const Steps& along) {
  std::set<std::size_t> kept;
  const std::vector<ChartPoint>& points = curve.points;
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    const int step = along(points[begin]), kind = kind_of(points[begin]);
    std::size_t lowest = begin, highest = begin;
    for (end = begin; end < points.size() && along(points[end]) == step && kind_of(points[end]) == kind; ++end) {
      if (points[end].y < points[lowest].y) lowest = end;
      if (points[end].y > points[highest].y) highest = end;
    }
    kept.insert({begin, lowest, highest, end - 1});
  }
  return kept;
}

std::set<std::size_t> of_marks(const ChartCurve& curve, const Steps& along, const Steps& up) {
  std::set<std::size_t> kept;
  std::set<std::tuple<int, int, int>> taken;
  const std::vector<ChartPoint>& points = curve.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (taken.insert({along(points[i]), up(points[i]), kind_of(points[i])}).second) kept.insert(i);
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
  constexpr int along_line = 1000, along_marks = 240, up_marks = 160;
  const Steps line(request, request.x, &ChartPoint::x, along_line),
      along(request, request.x, &ChartPoint::x, along_marks), up(request, request.y, &ChartPoint::y, up_marks);
  ChartRequest drawn = request;
  for (ChartCurve& curve : drawn.curves) {
    if (curve.points.empty()) continue;
    std::vector<ChartPoint> points;
    for (const std::size_t place : request.lines&& curve.line ? of_line(curve, line) : of_marks(curve, along, up))
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
