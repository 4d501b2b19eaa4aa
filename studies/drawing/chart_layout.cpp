#include "studies/drawing/chart_layout.hpp"

#include <algorithm>

#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// A rectangle of the plot, in fractions of its sides.
struct Box {
  double x, y, half_width, half_height;

  bool holds(double at_x, double at_y) const {
    return std::abs(at_x - x) < half_width && std::abs(at_y - y) < half_height;
  }
  bool meets(const Box& other) const {
    return std::abs(other.x - x) < half_width + other.half_width &&
           std::abs(other.y - y) < half_height + other.half_height;
  }
  /// Whether the line or a point of a curve runs through.
  bool meets(const ChartCurve& curve, const Layout& layout) const {
    constexpr int parts = 8;
    const auto& points = curve.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i].drawn()) continue;
      const double x0 = layout.x.fraction(points[i].x), y0 = layout.y.fraction(points[i].y);
      if (holds(x0, y0)) return true;
      if (i + 1 == points.size() || !points[i].joined() || !points[i + 1].joined()) continue;
      const double x1 = layout.x.fraction(points[i + 1].x), y1 = layout.y.fraction(points[i + 1].y);
      for (int part = 1; part < parts; ++part)
        if (const double t = static_cast<double>(part) / parts; holds(x0 + t * (x1 - x0), y0 + t * (y1 - y0)))
          return true;
    }
    return false;
  }
};

}  // namespace

bool areas_are_seen(const ChartRequest& request, const Layout& layout) {
  constexpr double narrowest = 0.008;
  const auto place = [&](double y) { return layout.y.fraction(std::max(y, layout.y.lowest)); };
  return std::any_of(request.curves.begin(), request.curves.end(), [&](const ChartCurve& curve) {
    return std::any_of(curve.points.begin(), curve.points.end(), [&](const ChartPoint& point) {
      return point.joined() && point.area() && place(point.high) - place(point.low) > narrowest;
    });
  });
}

double even_step(double length, double fewest) {
  const double power = std::pow(10.0, std::floor(std::log10(length / fewest)));
  for (const int step : {5, 2})
    if (length / (step * power) >= fewest) return step * power;
  return power;
}

Layout lay_out(const ChartRequest& request) {
  Layout layout;
  for (const ChartCurve& curve : request.curves)
    for (const ChartPoint& point : curve.points) {
      if (std::isfinite(point.x)) layout.x.include(point.x);
      if (point.drawn()) layout.y.include(point.y);
    }
  auto& [x, y] = layout;
  x.logarithmic = request.x.logarithmic && x.lowest > 0;
  y.logarithmic = request.y.logarithmic && y.lowest > 0;
  for (const ChartCurve& curve : request.curves)
    for (const ChartPoint& point : curve.points)
      if (!y.logarithmic && point.joined() && point.area()) {
        y.include(std::max(point.low, point.y - std::abs(point.y)));
        y.include(std::min(point.high, point.y + std::abs(point.y)));
      }
  x.widen(request.x.margin, request.x.margin);
  const bool from_zero = !y.logarithmic && y.lowest >= 0 && y.lowest <= 0.5 * y.highest && y.highest > 0;
  y.widen(0.06, request.mark_peaks ? 0.14 : 0.06);  // above: room for the value of a peak
  if (from_zero) y.lowest = 0;
  return layout;
}

std::vector<double> ticks(const Span& span) {
  constexpr double rounding = 1e-9;
  std::vector<double> numbers;
  if (!span.logarithmic) return numbers;
  const double powers_of_ten = std::floor(std::log10(span.highest)) - std::ceil(std::log10(span.lowest)) + 1;
  if (span.decades() >= 1.7 && powers_of_ten >= 2) return numbers;
  if (span.decades() < 0.5) {
    const double step = even_step(span.highest - span.lowest);
    const double last = std::floor(span.highest / step + rounding);
    for (double tick = std::ceil(span.lowest / step - rounding); tick <= last; ++tick) numbers.push_back(tick * step);
    return numbers;
  }
  for (double decade = std::floor(std::log10(span.lowest)); decade <= std::log10(span.highest); ++decade)
    for (const int step : {1, 2, 3, 5, 7})
      if (span.decades() < 1.2 || (step != 3 && step != 7)) numbers.push_back(step * std::pow(10.0, decade));
  return numbers;
}

std::vector<PeakValue> peak_values(const ChartRequest& request, const Layout& layout) {
  struct Top {
    std::size_t curve;
    ChartPoint point;
  };
  std::vector<Top> tops;
  for (std::size_t i = 0; i < request.curves.size(); ++i)
    if (const auto place = peak(request.curves[i])) tops.push_back({i, request.curves[i].points[*place]});
  std::stable_sort(tops.begin(), tops.end(), [](const Top& a, const Top& b) { return a.point.y > b.point.y; });

  std::vector<Box> taken;  // first by the rings
  for (const Top& top : tops)
    taken.push_back({layout.x.fraction(top.point.x), layout.y.fraction(top.point.y), 0.014, 0.02});
  std::vector<PeakValue> values;
  for (const auto& [i, top] : tops) {
    const double fineness = layout.y.logarithmic ? 1 : std::abs(top.y) / (layout.y.highest - layout.y.lowest);
    const std::string value = short_number(top.y, 3 + static_cast<int>(std::log10(std::max(1.0, fineness))));
    const double x = layout.x.fraction(top.x), y = layout.y.fraction(top.y);
    for (const int side : {1, -1}) {
      const Box box{x, y + 0.075 * side, 0.012 * static_cast<double>(value.size()) + 0.005, 0.04};
      const bool inside = box.y - box.half_height > 0 && box.y + box.half_height < 1.02 &&
                          box.x - box.half_width > -0.02 && box.x + box.half_width < 1.02;
      if (!inside || std::any_of(taken.begin(), taken.end(), [&](const Box& other) { return box.meets(other); }) ||
          std::any_of(request.curves.begin(), request.curves.end(),
                      [&](const ChartCurve& curve) { return box.meets(curve, layout); }))
        continue;
      values.push_back({i, top, value, side > 0});
      taken.push_back(box);
      break;
    }
  }
  return values;
}

}  // namespace rollres
