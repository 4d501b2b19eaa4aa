#include "studies/charts/scatter_chart.hpp"

#include <algorithm>
#include <cmath>

#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// A picture with the axis of the number, no curve yet; and the factor of its unit.
struct Prepared {
  ChartRequest request;
  double factor;
};

Prepared prepared(const ScatterPicture& picture, const std::string& name, const std::string& unit) {
  double largest = 0;
  for (const ScatterBatches& batches : picture.values)
    for (const double value : sorted_values(batches)) largest = std::max(largest, std::abs(value));
  const ScaledUnit scaled = scaled_unit(picture.unit, largest);
  ChartRequest request{.title = picture.title, .x = picture.axis, .y = {.name = name, .unit = unit}, .curves = {}};
  request.x.unit = typeset_unit(scaled.name);
  request.mark_peaks = false;
  request.marks = false;
  request.ordered = picture.ordered;
  request.end_labels = false;  // the ends lie on one line
  request.comment = picture.comment;
  return {std::move(request), scaled.factor};
}

}  // namespace

ChartRequest histogram_chart(const ScatterPicture& picture) {
  auto [request, factor] = prepared(picture, "share of the points", "%");
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    ChartCurve& curve = request.curves.emplace_back(ChartCurve{picture.labels[i], {}});
    const auto add = [&, factor = factor](double x, double y) {
      ChartPoint point{x / factor, y};
      if (picture.values.size() == 1) {
        point.low = 0;
        point.high = y;
      }
      curve.points.push_back(point);
    };
    const std::vector<HistogramBin> bins = histogram_of_sorted(sorted_values(picture.values[i]));
    if (bins.empty()) continue;
    add(bins.front().from, 0);
    for (const auto& [from, to, share] : bins) {
      add(from, 100 * share);
      add(to, 100 * share);
    }
    add(bins.back().to, 0);
  }
  return request;
}

ChartRequest cumulative_chart(const ScatterPicture& picture) {
  auto [request, factor] = prepared(picture, "probability of a lower value", "%");
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    ChartCurve& curve = request.curves.emplace_back(ChartCurve{picture.labels[i], {}});
    const std::vector<double> sorted = sorted_values(picture.values[i]);
    const auto count = static_cast<double>(sorted.size());
    for (std::size_t k = 0; k < sorted.size(); ++k)
      curve.points.push_back({sorted[k] / factor, 100 * (static_cast<double>(k) + 0.5) / count});
  }
  return request;
}

}  // namespace rollres
