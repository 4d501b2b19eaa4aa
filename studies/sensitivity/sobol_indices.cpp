#include <cmath>
#include <numeric>
#include <random>

#include "core/messages/require.hpp"
#include "core/numerics/parallel.hpp"
#include "studies/sensitivity/global_sensitivity.hpp"
#include "studies/study/sampling.hpp"

namespace rollres {

namespace {

constexpr std::size_t fewest_rows = 8;
/// Values of a row: at A, at B, and at A with each column of B.
struct Row {
  double a, b;
  std::vector<double> mixed;

  bool complete() const {
    return std::isfinite(a) && std::isfinite(b) && all_of(mixed, [](double value) { return std::isfinite(value); });
  }
};

struct Estimate {
  double mean = 0, variance = 0;
  std::vector<double> first, total;
};

/// From the rows whose numbers are in `chosen`.
Estimate estimate(const std::vector<Row>& rows, const std::vector<std::size_t>& chosen) {
  const auto count = static_cast<double>(chosen.size());
  const std::size_t inputs = rows.front().mixed.size();
  Estimate found;
  for (const std::size_t row : chosen) found.mean += (rows[row].a + rows[row].b) / (2 * count);
  for (const std::size_t row : chosen)
    for (const double value : {rows[row].a, rows[row].b})
      found.variance += (value - found.mean) * (value - found.mean) / (2 * count - 1);
  for (std::size_t i = 0; i < inputs; ++i) {
    double first = 0, total = 0;
    for (const std::size_t row : chosen) {
      const auto& [a, b, mixed] = rows[row];
      first += (b - found.mean) * (mixed[i] - a) / count;  // centred: the same mean, less scatter
      total += (a - mixed[i]) * (a - mixed[i]) / (2 * count);
    }
    const bool constant = found.variance == 0;
    found.first.push_back(constant ? 0 : first / found.variance);
    found.total.push_back(constant ? 0 : total / found.variance);
  }
  return found;
}

}  // namespace

SobolIndices sobol_indices(const CubeFunction& function, std::size_t inputs, std::size_t count, std::uint64_t seed,
                           int jobs) {
  require(inputs >= 1, "inputs", static_cast<double>(inputs), "must be at least 1");
  require(count >= fewest_rows, "rows", static_cast<double>(count), "must be at least 8");
  const auto sample = unit_sample(SampleMethod::sobol, count, 2 * inputs, seed);
  std::vector<Row> rows(count, {0, 0, std::vector<double>(inputs)});
  const std::size_t each = inputs + 2;
  for_each_piece(count * each, jobs, [&](std::size_t piece) {
    const std::size_t row = piece / each, part = piece % each;
    std::vector<double> place(inputs);
    for (std::size_t i = 0; i < inputs; ++i) {
      const bool of_b = part == 1 || part == i + 2;
      place[i] = sample[of_b ? inputs + i : i][row];
    }
    double& value = part == 0 ? rows[row].a : part == 1 ? rows[row].b : rows[row].mixed[part - 2];
    value = function(place);
  });
  std::erase_if(rows, [](const Row& row) { return !row.complete(); });
  require(rows.size() >= fewest_rows, "rows with values", static_cast<double>(rows.size()), "must be at least 8");

  std::vector<std::size_t> all(rows.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const Estimate whole = estimate(rows, all);
  SobolIndices indices{.first = {},
                       .total = {},
                       .mean = whole.mean,
                       .variance = whole.variance,
                       .rows = rows.size(),
                       .failed_rows = count - rows.size(),
                       .evaluations = count * each};
  constexpr int resamples = 200;
  std::mt19937_64 random(seed);
  std::vector<double> first_squares(inputs), total_squares(inputs);
  for (int k = 0; k < resamples; ++k) {
    std::vector<std::size_t> chosen(rows.size());
    for (std::size_t& row : chosen) row = random() % rows.size();
    const Estimate one = estimate(rows, chosen);
    for (std::size_t i = 0; i < inputs; ++i) {
      first_squares[i] += (one.first[i] - whole.first[i]) * (one.first[i] - whole.first[i]);
      total_squares[i] += (one.total[i] - whole.total[i]) * (one.total[i] - whole.total[i]);
    }
  }
  for (std::size_t i = 0; i < inputs; ++i) {
    indices.first.push_back({whole.first[i], in_95_percent * std::sqrt(first_squares[i] / resamples)});
    indices.total.push_back({whole.total[i], in_95_percent * std::sqrt(total_squares[i] / resamples)});
  }
  return indices;
}

}  // namespace rollres
