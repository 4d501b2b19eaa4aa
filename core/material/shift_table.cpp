#include "core/material/shift_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/messages/require.hpp"
#include "core/scene/shift_reach.hpp"

namespace rollres {

namespace {

/// Temperature [K] and logarithm of the factor.
using Row = std::pair<double, double>;

double secant(const Row& a, const Row& b) { return (b.second - a.second) / (b.first - a.first); }

/// At the middle one of three rows, which follow each other.
double slope_between(const Row& before, const Row& here, const Row& after) {
  const double left = secant(before, here), right = secant(here, after);
  return left * right > 0 ? left * right / secant(before, after) : 0;
}

/// At the first or last row, from the two next to it.
double slope_at_end(const Row& end, const Row& next, const Row& second) {
  const double near = secant(end, next), far = secant(next, second);
  if (near * far <= 0) return near;
  constexpr double steepest = 3;
  return near * std::min(steepest, secant(end, second) / far);
}

double slope_at(const std::vector<Row>& rows, std::size_t i) {
  const std::size_t last = rows.size() - 1;
  if (last == 1) return secant(rows[0], rows[1]) * rows[1 - i].first / rows[i].first;
  if (i == 0) return slope_at_end(rows[0], rows[1], rows[2]);
  if (i == last) return slope_at_end(rows[last], rows[last - 1], rows[last - 2]);
  return slope_between(rows[i - 1], rows[i], rows[i + 1]);
}

}  // namespace

TableFactors::TableFactors(const std::vector<double>& temperatures, const std::vector<double>& factors) {
  for (std::size_t i = 0; i < temperatures.size(); ++i) rows_.emplace_back(temperatures[i], std::log(factors[i]));
  std::sort(rows_.begin(), rows_.end());
}

double TableFactors::operator()(double temperature) const {
  const std::vector<Row>& rows = rows_;
  require(rows.size() > 1, "temperature", temperature, "needs a table of two shifts or more");
  const std::size_t last = rows.size() - 1;
  const auto [lowest, highest] = reach_of_shifts(rows[0].first, rows[1].first, rows[last - 1].first, rows[last].first);
  require(temperature >= lowest && temperature <= highest, "temperature", temperature,
          "must be within the table of shifts");
  const double here = std::clamp(temperature, rows.front().first, rows.back().first);
  if (const std::size_t end = temperature < here ? 0 : last; here != temperature)
    return std::exp(rows[end].second + slope_at(rows, end) * (temperature - here));
  const auto above = std::lower_bound(rows.begin() + 1, rows.end() - 1, here,
                                      [](const Row& row, double value) { return row.first < value; });
  const auto i = static_cast<std::size_t>(above - rows.begin()) - 1;
  const Row &low = rows[i], &high = rows[i + 1];
  const double line = secant(low, high), t = (here - low.first) / (high.first - low.first), u = 1 - t;
  if (line == 0) return std::exp(low.second);
  const double before = slope_at(rows, i) / line, after = slope_at(rows, i + 1) / line;  // >= 0
  return std::exp((t * t * high.second + t * u * (low.second * after + high.second * before) + u * u * low.second) /
                  (t * t + t * u * (before + after) + u * u));
}

}  // namespace rollres
