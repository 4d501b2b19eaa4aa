#pragma once

/// Where things stand in a chart: what its axes span, their numbers, and room for the values of peaks.

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "studies/drawing/chart.hpp"

namespace rollres {

/// What an axis spans.
struct Span {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  bool logarithmic = false;

  double along(double value) const { return logarithmic ? std::log10(value) : value; }
  double back(double place) const { return logarithmic ? std::pow(10.0, place) : place; }
  double decades() const { return std::log10(highest / lowest); }
  /// 0 at the lower end of the axis, 1 at the upper.
  double fraction(double value) const { return (along(value) - along(lowest)) / (along(highest) - along(lowest)); }

  void include(double value) {
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  /// Widens the axis by fractions of its length; an axis of no length becomes one around its value.
  void widen(double below, double above) {
    const double from = along(lowest), to = along(highest);
    const double length = to > from ? to - from : (logarithmic ? 1.0 : std::max(0.2 * std::abs(to), 1e-12));
    if (to <= from) below = above = 0.5;
    lowest = back(from - below * length);
    highest = back(to + above * length);
  }
};

struct Layout {
  Span x, y;
};

/// Axes that hold all points with a value, with room above the highest; a linear y starts at zero where no value is
/// negative and the smallest is at most half the largest.
Layout lay_out(const ChartRequest& request);

/// Whether any area is wide enough to be drawn.
bool areas_are_seen(const ChartRequest& request, const Layout& layout);

/// A step of 1, 2 or 5 times a power of ten that divides a length into so many parts or some more, up to 2.5 times as
/// many.
double even_step(double length, double fewest = 4);

/// Numbers for a logarithmic axis so short that powers of ten alone would leave it with hardly a number; else empty.
std::vector<double> ticks(const Span& span);

/// The value of a peak, to be written above or below it.
struct PeakValue {
  std::size_t curve;
  ChartPoint point;
  std::string text;  ///< three significant digits, more where the axis spans little of the value
  bool above;
};

/// The values of those peaks (the highest first) that have room for it: no curve, no other peak and no other value is
/// covered.
std::vector<PeakValue> peak_values(const ChartRequest& request, const Layout& layout);

}  // namespace rollres
