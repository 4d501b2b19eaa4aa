#include "studies/drawing/peak_values.hpp"

#include <algorithm>
#include <cmath>

#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// Places for the middle of a text of this size around a peak: above, below, beside it, and then farther away all over
/// the plot, the nearest first. @param far  look farther away at all
std::vector<std::array<double, 2>> places_around(double x, double y, double half_width, bool far) {
  std::vector<std::array<double, 2>> places{{x, y + 0.075}, {x, y - 0.075}};
  const double aside = half_width + 0.03;
  for (const double up : {0.055, -0.055, 0.0})
    for (const double side : {1.0, -1.0}) places.push_back({x + side * aside, y + up});
  if (!far) return places;
  std::vector<std::array<double, 2>> farther;
  constexpr int columns = 24, rows = 24;
  for (int column = 0; column <= columns; ++column)
    for (int row = 0; row <= rows; ++row)
      farther.push_back({static_cast<double>(column) / columns, static_cast<double>(row) / rows});
  const auto distance = [&](const std::array<double, 2>& place) {
    return std::hypot(0.7 * (place[0] - x), place[1] - y);  // a step across costs less: leaders may be flat
  };
  stable_sort(farther, [&](const auto& one, const auto& other) { return distance(one) < distance(other); });
  places.insert(places.end(), farther.begin(), farther.end());
  return places;
}

/// Significant digits of a value whose last one is worth more than its doubt.
int digits_known(double value, double doubt) {
  constexpr int fewest = 1, most = 5;
  if (!(doubt > 0) || value == 0) return most;
  const double digits = std::floor(std::log10(std::abs(value))) - std::ceil(std::log10(doubt)) + 1;
  return static_cast<int>(std::clamp<double>(digits, fewest, most));
}

}  // namespace

std::string CurvePeak::x_text() const { return short_number(x, x_digits); }
std::string CurvePeak::y_text(int most) const { return short_number(y, std::min(y_digits, most)); }

std::optional<CurvePeak> curve_peak(const ChartCurve& curve, const ChartSpans& spans) {
  const auto place = peak(curve);
  if (!place) return std::nullopt;
  const auto x = [&](std::size_t i) { return spans.x.along(curve.points[i].x); };
  const auto y = [&](std::size_t i) { return spans.y.along(curve.points[i].y); };
  const std::size_t i = *place;
  const double before = x(i) - x(i - 1), after = x(i + 1) - x(i);
  const double fall_before = (y(i) - y(i - 1)) / before, fall_after = (y(i + 1) - y(i)) / after;
  const double bend = (fall_after - fall_before) / (before + after);  // half the second derivative
  const ChartPoint& largest = curve.points[i];
  if (!(before * after > 0) || !(bend < 0)) return CurvePeak{largest.x, largest.y, 5, 5};
  const double slope = fall_before + bend * before;  // at the largest point
  const double aside = -0.5 * slope / bend, rise = -0.25 * slope * slope / bend;
  // What a cubic through one more point adds at the parabola's top, and by how much it moves the top.
  double more = 0, moved = 0;
  bool known = false;
  const auto compare = [&](std::size_t next) {
    if (!curve.points[next].joined()) return;
    const double away = x(next) - x(i);
    const double missed = y(next) - y(i) - away * (slope + bend * away);
    const double third = missed / ((away + before) * away * (away - after));
    more = std::max(more, std::abs(third * (aside + before) * aside * (aside - after)));
    moved = std::max(
        moved, std::abs(third * (3 * aside * aside + 2 * aside * (before - after) - before * after) / (2 * bend)));
    known = true;
  };
  if (i >= 2) compare(i - 2);
  if (i + 2 < curve.points.size()) compare(i + 2);
  const bool smooth = known && more <= rise;
  const double top_x = smooth ? spans.x.back(x(i) + aside) : largest.x,
               top_y = smooth ? spans.y.back(y(i) + rise) : largest.y;
  const double doubt_along = smooth ? moved : std::max(moved, std::abs(aside)),
               doubt_up = smooth ? more : std::max(more, rise);
  const auto doubt = [](const Span& axis, double value, double along) {
    return axis.logarithmic ? std::abs(value) * std::log(10.0) * along : along;
  };
  return CurvePeak{top_x, top_y, digits_known(top_x, doubt(spans.x, top_x, doubt_along)),
                   digits_known(top_y, doubt(spans.y, top_y, doubt_up))};
}

std::string peak_text(const CurvePeak& top, const ChartSpans& layout) {
  const double fineness = layout.y.logarithmic ? 1 : std::abs(top.y) / (layout.y.highest - layout.y.lowest);
  return top.y_text(3 + static_cast<int>(std::log10(std::max(1.0, fineness))));
}

std::vector<PeakValue> peak_values(const ChartRequest& request, const ChartSpans& layout) {
  struct Top {
    std::size_t curve;
    CurvePeak point;
  };
  std::vector<Top> tops;
  for (std::size_t i = 0; i < request.curves.size(); ++i)
    if (const auto top = curve_peak(request.curves[i], layout)) tops.push_back({i, *top});
  stable_sort(tops, [](const Top& a, const Top& b) { return a.point.y > b.point.y; });

  std::vector<LabelBox> taken;  // first by the rings
  for (const Top& top : tops)
    taken.push_back({layout.x.fraction(top.point.x), layout.y.fraction(top.point.y), 0.014, 0.02});
  constexpr std::size_t most_peaks = 24;  // of more the plot is full
  std::vector<PeakValue> values;
  for (const auto& [i, top] : tops) {
    const std::string value = peak_text(top, layout);
    const double half_width = 0.012 * static_cast<double>(value.size()) + 0.005;
    for (const auto& [x, y] :
         places_around(layout.x.fraction(top.x), layout.y.fraction(top.y), half_width, tops.size() <= most_peaks)) {
      const LabelBox box{x, y, half_width, 0.04};
      const bool inside = box.y - box.half_height > 0 && box.y + box.half_height < 1.02 &&
                          box.x - box.half_width > -0.02 && box.x + box.half_width < 1.02;
      if (!inside || any_of(taken, [&](const LabelBox& other) { return box.meets(other); }) ||
          any_of(request.curves, [&](const ChartCurve& curve) { return box.meets(curve, layout); }))
        continue;
      values.push_back({i, top, value, box});
      taken.push_back(box);
      break;
    }
  }
  return values;
}

}  // namespace rollres
