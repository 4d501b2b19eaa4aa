#pragma once

/// Where a chart has room for the values of its peaks.

#include "studies/drawing/chart_frame.hpp"

namespace rollres {

/// A rectangle of the plot, in fractions of its sides.
struct LabelBox {
  double x, y, half_width, half_height;

  bool holds(double at_x, double at_y) const {
    return std::abs(at_x - x) < half_width && std::abs(at_y - y) < half_height;
  }
  bool meets(const LabelBox& other) const {
    return std::abs(other.x - x) < half_width + other.half_width &&
           std::abs(other.y - y) < half_height + other.half_height;
  }
  /// Whether the line or a point of a curve runs through.
  bool meets(const ChartCurve& curve, const ChartSpans& layout) const {
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

/// The value of a peak, and where it is written.
struct PeakValue {
  std::size_t curve;
  ChartPoint point;
  std::string text;  ///< three significant digits, more where the axis spans little of the value
  LabelBox box;      ///< that its letters take
};

/// A peak's value, with more than three digits where the axis spans little of it.
std::string peak_text(const ChartPoint& top, const ChartSpans& layout);

/// The values of the peaks, the highest first, each where it covers no curve, no other peak and no other value; a peak
/// for whose value the plot has no such place has none.
std::vector<PeakValue> peak_values(const ChartRequest& request, const ChartSpans& layout);

}  // namespace rollres
