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

}  // namespace

std::string peak_text(const ChartPoint& top, const ChartSpans& layout) {
  const double fineness = layout.y.logarithmic ? 1 : std::abs(top.y) / (layout.y.highest - layout.y.lowest);
  return short_number(top.y, 3 + static_cast<int>(std::log10(std::max(1.0, fineness))));
}

std::vector<PeakValue> peak_values(const ChartRequest& request, const ChartSpans& layout) {
  struct Top {
    std::size_t curve;
    ChartPoint point;
  };
  std::vector<Top> tops;
  for (std::size_t i = 0; i < request.curves.size(); ++i)
    if (const auto place = peak(request.curves[i])) tops.push_back({i, request.curves[i].points[*place]});
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
