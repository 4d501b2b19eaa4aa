#include "core/derivatives/calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/numerics/finite_difference.hpp"
#include "core/numerics/parallel.hpp"

namespace rollres {

namespace {

constexpr double wide_spacing = 0.03, narrowing = 6;  // of the tables' spacing
constexpr int most_tables = 4;
constexpr std::size_t values_of_table = 9;

struct ValueTable {
  double spacing = 0;  // about
  std::vector<double> points = {}, values = {};
  double relative_error = 0;  // the largest of the solutions

  bool empty() const { return values.empty(); }
};

/// A number near i, 0 for 0. The distances of neighbours, from 0.6 to 1.4, have no period that a grid could share.
double uneven(int i) {
  constexpr double golden = 0.6180339887498949, shift = 0.6;
  const double turns = golden * i;
  return i == 0 ? 0 : i + shift * (turns - std::floor(turns) - 0.5);
}

/// Values around the centre, or beside it where a bound or a failure is near.
ValueTable tabulate(SampledLine& line, std::size_t size, double spacing) {
  const double below = line.room_below(), above = line.room_above();
  const int intervals = static_cast<int>(size) - 1;
  spacing = std::min(spacing, (below + above) / (intervals + 1));  // one more: the centre is a point of the table
  for (int shrinking = 0; shrinking < 3; ++shrinking, spacing /= 4) {
    const int lowest_first = -std::min(intervals, static_cast<int>(std::min<double>(intervals, below / spacing)));
    const int highest_first = static_cast<int>(std::min<double>(intervals, above / spacing)) - intervals;
    int tried = 1;
    for (const int wanted : {-intervals / 2, 0, -intervals}) {
      const int first = std::max(lowest_first, std::min(highest_first, wanted));
      if (first < lowest_first || first > 0 || first == tried) continue;
      tried = first;
      ValueTable table{.spacing = spacing};
      for (int i = 0; i <= intervals; ++i) {
        const auto sample = line.at(std::clamp(uneven(first + i) * spacing, -below, above));
        if (!sample) break;
        table.points.push_back(sample->offset);
        table.values.push_back(sample->value);
        table.relative_error = std::max(table.relative_error, sample->relative_error);
      }
      if (table.values.size() == size) return table;
    }
  }
  return {};
}

double largest_change(const std::vector<double>& values) {
  double largest = 0;
  for (std::size_t i = 1; i < values.size(); ++i) largest = std::max(largest, std::abs(values[i] - values[i - 1]));
  return largest;
}

/// The noise of a table, also of one that does not resolve the function. The level of a smooth, resolved function falls
/// at each order to a fraction of the last one, or, where a derivative happens to vanish, of the one before that. Jumps
/// and kinks do not, and where they are few they do not change sign as often as `estimate_noise` wants.
NoiseEstimate table_noise(const ValueTable& table) {
  constexpr double fall = 6;
  NoiseEstimate estimate = estimate_noise(table.points, table.values);
  if (estimate.outcome != NoiseOutcome::spacing_too_large) return estimate;
  const std::vector<double>& levels = estimate.levels;
  for (std::size_t k = 4; k < levels.size() && estimate.outcome != NoiseOutcome::found; ++k)
    if (levels[k] > std::max(levels[k - 1] / fall, levels[k - 2] / (fall * fall))) {
      estimate.outcome = NoiseOutcome::found;
      estimate.noise = std::max(levels[k - 1], levels[k]);
    }
  return estimate;
}

/// What is below the last levels cannot be told from the smooth part.
double last_level(const NoiseEstimate& estimate) {
  const std::vector<double>& levels = estimate.levels;
  return *std::max_element(levels.end() - 3, levels.end());  // a difference or two alone are small by chance
}

double root_mean_square(const std::vector<double>& numbers) {
  const double squares = std::inner_product(numbers.begin(), numbers.end(), numbers.begin(), 0.0);
  return std::sqrt(squares / static_cast<double>(numbers.size()));
}

/// The size of a derivative by a table, and what noise makes of it.
struct DerivativeSize {
  double size, doubt;

  bool hidden() const { return size < 6 * doubt; }  // the noise itself is known within a factor of 3
};

DerivativeSize derivative_size(const ValueTable& table, std::size_t order, double noise) {
  const DividedDifferences differences = divided_differences(table.points, table.values, order);
  const double factorial = std::tgamma(static_cast<double>(order) + 1);
  return {factorial * root_mean_square(differences.values), factorial * noise * root_mean_square(differences.norms)};
}

/// So many points of a table, from end to end.
ValueTable thinned(const ValueTable& table, std::size_t size) {
  ValueTable few{.spacing = table.spacing};
  for (std::size_t j = 0; j < size; ++j) {
    const std::size_t place = j * (table.points.size() - 1) / (size - 1);
    few.points.push_back(table.points[place]);
    few.values.push_back(table.values[place]);
  }
  return few;
}

/// Bounds of |f''|, |f'''|, |f''''|, |f^(5)|. A fourth or fifth difference that noise hides is taken to be no larger
/// than f and its lower derivatives: the scaled variable has that meaning.
std::array<double, 4> derivative_bounds(const ValueTable& table, double centre, double noise) {
  std::array<double, 4> bounds{};
  double usual = std::max(std::abs(centre), derivative_size(table, 1, noise).size);
  bounds[0] = derivative_size(table, 2, noise).size + derivative_size(table, 2, noise).doubt;
  for (std::size_t order = 3; order <= 5; ++order) {
    DerivativeSize found = derivative_size(table, order, noise);
    if (found.hidden()) found = derivative_size(thinned(table, order + 1), order, noise);
    double& bound = bounds[order - 2];
    bound = found.size + found.doubt;
    if (found.hidden() && order > 3) bound = std::min(bound, usual);
    usual = std::max(usual, bound);
  }
  return bounds;
}

/// What one table says of the function.
struct TableReading {
  FunctionSize size = {};
  double slope = 0, change = 0;  // of the function: its derivative, and by how much it changes over the table
  bool constant = false, rough = false,
       settled = false;  // nothing but equal values; jumps or noise, or what is not resolved; noise as the
                         // solutions' own error, below which none is seen
  double error = 0;      // that the best formula promises of the derivative, noise as it is counted
};

TableReading read(const ValueTable& table, const SampledLine& line) {
  constexpr double largest_noise =
      1e-8;  // of solutions; a larger error hardly changes with the input, which is no noise
  const double least_noise =
      std::max(std::min(table.relative_error, largest_noise), std::numeric_limits<double>::epsilon()) *
      std::abs(line.centre_value());
  const NoiseEstimate estimate = table_noise(table);
  TableReading reading;
  reading.constant = estimate.outcome == NoiseOutcome::spacing_too_small;
  reading.rough = reading.constant || estimate.outcome == NoiseOutcome::found;
  const double noise = reading.constant ? largest_change(table.values)  // a constant, or a staircase: its steps
                       : reading.rough  ? estimate.noise
                                        : last_level(estimate);
  FunctionSize& size = reading.size;
  size.noise = std::max(noise, least_noise);
  reading.settled = noise <= least_noise;
  size.derivatives = derivative_bounds(table, line.centre_value(), size.noise);
  size.reach = std::max(std::abs(table.points.front()), std::abs(table.points.back()));
  reading.slope = derivative_size(table, 1, 0).size;
  const auto [least, most] = std::minmax_element(table.values.begin(), table.values.end());
  reading.change = *most - *least;
  constexpr int order = 4;
  const std::vector<DifferenceFormula> found = formulas(order, size, size.reach, line.room_below(), line.room_above());
  reading.error = found.empty() ? INFINITY : found.front().expected_error;
  return reading;
}

/// Whether a narrower table may tell more: this one's derivative is not as good as rounding allows, and what disturbs
/// it is not jumps as a grid makes them.
bool unresolved(const TableReading& reading, double value, double solution_error) {
  constexpr double good = 1e-13, good_if_settled = 1e-5, of_grid = 0.004, of_error = 3;
  if (reading.error <= (reading.settled ? good_if_settled : good) * std::max(reading.slope, 0.1 * std::abs(value)))
    return false;
  const double noise = reading.size.noise;
  return !reading.rough || noise > std::max(of_grid * reading.change, of_error * solution_error);
}

InputCalibration calibrated(SampledLine line, double relative_error) {
  InputCalibration calibration;
  double spacing = wide_spacing, error = INFINITY;
  for (int tables = 0; tables < most_tables; ++tables) {
    const ValueTable table = tabulate(line, values_of_table, spacing);
    if (table.empty()) break;
    const TableReading reading = read(table, line);
    if (tables > 0 && reading.constant) break;
    if (reading.error < error || tables == 0) {
      calibration.size = reading.size;
      error = reading.error;
    }
    constexpr double worse = 3;  // than before, where what disturbs does not grow narrower with the table
    if ((!reading.rough && reading.error > worse * error) ||
        !unresolved(reading, line.centre_value(), relative_error * std::abs(line.centre_value())))
      break;
    spacing = table.spacing / narrowing;
  }
  calibration.evaluations = line.evaluations();
  calibration.failures = line.failures();
  return calibration;
}

}  // namespace

Calibration calibrate(const Objective& objective, std::span<const double> point, int jobs) {
  require_inside(objective, point);
  Calibration calibration{{point.begin(), point.end()}, value_at(objective, point), {}};
  calibration.inputs.resize(point.size());
  if (!calibration.centre.found()) return calibration;
  for_each_piece(point.size(), jobs, [&](std::size_t input) {
    calibration.inputs[input] =
        calibrated(SampledLine(objective, point, input, calibration.centre.value), calibration.centre.relative_error);
  });
  return calibration;
}

}  // namespace rollres
