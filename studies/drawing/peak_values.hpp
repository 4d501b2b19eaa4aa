#pragma once

/// The peaks of a chart's curves, and where it has room for their values.

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

/// The peak of a curve, with as many digits as its points support.
struct CurvePeak {
  double x, y;
  int x_digits, y_digits;

  std::string x_text() const;
  std::string y_text(int most = 5) const;
};

/// The top of the parabola through the largest point and its neighbours, in the scales of the axes, where the points
/// beyond these change it by less than it rises above the largest point; else the largest point itself, known as well
/// as the parabola's top agrees with it. Empty as `peak` is.
std::optional<CurvePeak> curve_peak(const ChartCurve& curve, const ChartSpans& spans);

/// The value of a peak, and where it is written.
struct PeakValue {
  std::size_t curve;
  CurvePeak point;
  std::string text;  ///< as peak_text
  LabelBox box;      ///< that its letters take
};

/// A peak's value: three significant digits, more where the axis spans little of it, as far as its points support them.
std::string peak_text(const CurvePeak& top, const ChartSpans& layout);

/// The values of the peaks, the highest first, each where it covers no curve, no other peak and no other value; a peak
/// for whose value the plot has no such place has none.
std::vector<PeakValue> peak_values(const ChartRequest& request, const ChartSpans& layout);

}  // namespace rollres
