#include "studies/scatter/scatter_statistics.hpp"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "fitting/errors/statistics.hpp"

namespace rollres {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
using Estimator = std::function<double(const std::vector<double>& sorted)>;

/// Each batch sorted, without what has no value.
std::vector<std::vector<double>> sorted_batches(const ScatterBatches& batches) {
  std::vector<std::vector<double>> sorted = batches;
  for (std::vector<double>& batch : sorted) {
    std::erase_if(batch, [](double value) { return std::isnan(value); });
    std::sort(batch.begin(), batch.end());
  }
  return sorted;
}

ScatterEstimate sectioned(const std::vector<double>& all, const std::vector<std::vector<double>>& batches,
                          const Estimator& estimator) {
  ScatterEstimate estimate{all.empty() ? none : estimator(all), none};
  const std::size_t count = batches.size();
  if (count < 2 || all.empty()) return estimate;
  double squares = 0;
  for (const std::vector<double>& batch : batches) {
    if (batch.empty()) return estimate;
    const double apart = estimator(batch) - estimate.value;
    squares += apart * apart;
  }
  const auto number = static_cast<double>(count);
  const double t = two_sided_quantile(0.95, static_cast<int>(count) - 1);
  estimate.error = t * std::sqrt(squares / (number - 1) / number);
  return estimate;
}

}  // namespace

double mean_value(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
  if (values.size() < 2) return none;
  const double middle = mean_value(values);
  double squares = 0;
  for (const double value : values) squares += (value - middle) * (value - middle);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double quantile_of_sorted(const std::vector<double>& sorted, double probability) {
  const double place = probability * static_cast<double>(sorted.size()) - 0.5;  // counted from 0
  if (place <= 0) return sorted.front();
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 >= sorted.size()) return sorted.back();
  return std::lerp(sorted[below], sorted[below + 1], place - static_cast<double>(below));
}

double smooth_quantile(std::vector<double> values, double probability) {
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  const double a = (count + 1) * probability, b = (count + 1) * (1 - probability);
  double sum = 0, before = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double here = i + 1 == values.size() ? 1 : boost::math::ibeta(a, b, static_cast<double>(i + 1) / count);
    sum += (here - before) * values[i];
    before = here;
  }
  return sum;
}

std::vector<double> sorted_values(const ScatterBatches& batches) {
  std::vector<double> all;
  for (const std::vector<double>& batch : batches)
    std::copy_if(batch.begin(), batch.end(), std::back_inserter(all), [](double value) { return !std::isnan(value); });
  std::sort(all.begin(), all.end());
  return all;
}

ScatterStatistics scatter_statistics(const ScatterBatches& batches, const std::vector<double>& probabilities) {
  const std::vector<double> all = sorted_values(batches);
  const auto sorted = sorted_batches(batches);
  ScatterStatistics statistics{.quantiles = {}};
  statistics.values = all.size();
  for (const std::vector<double>& batch : batches) statistics.without += batch.size();
  statistics.without -= all.size();
  statistics.mean = sectioned(all, sorted, mean_value);
  statistics.deviation = sectioned(all, sorted, deviation_of);
  for (const double probability : probabilities)
    statistics.quantiles.push_back(sectioned(
        all, sorted, [&](const std::vector<double>& values) { return quantile_of_sorted(values, probability); }));
  return statistics;
}

ScatterEstimate mean_of(const ScatterBatches& batches) {
  return sectioned(sorted_values(batches), sorted_batches(batches), mean_value);
}

std::vector<HistogramBin> histogram_of_sorted(const std::vector<double>& sorted) {
  if (sorted.empty()) return {};
  const double lowest = sorted.front(), highest = sorted.back(), length = highest - lowest;
  if (length <= 0) return {{lowest, highest, 1}};
  const auto count = static_cast<double>(sorted.size());
  const double quartiles = quantile_of_sorted(sorted, 0.75) - quantile_of_sorted(sorted, 0.25);
  const double wished = quartiles > 0 ? length * std::cbrt(count) / (2 * quartiles) : 0;
  const auto bins = static_cast<std::size_t>(std::clamp(std::ceil(wished), 5.0, 60.0));
  std::vector<HistogramBin> histogram;
  for (std::size_t i = 0; i < bins; ++i) {
    const auto end = [&](std::size_t k) {
      return k == bins ? highest : lowest + length * static_cast<double>(k) / static_cast<double>(bins);
    };
    histogram.push_back({end(i), end(i + 1), 0});
  }
  for (const double value : sorted) {
    const double place = (value - lowest) / length * static_cast<double>(bins);
    histogram[std::min(static_cast<std::size_t>(place), bins - 1)].share += 1 / count;
  }
  return histogram;
}

}  // namespace rollres
