#include "core/derivatives/calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "core/numerics/finite_difference.hpp"
#include "core/numerics/parallel.hpp"

namespace rollres {

namespace {

constexpr double wide_spacing = 0.03, narrowing = 10;  // of the tables' spacing
constexpr int most_tables = 5;
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
  constexpr int strict = 2;  // of the attempts: with points as well known as the centre
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
        if (!sample || (shrinking < strict && line.is_poor(*sample))) break;
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
  double slope = 0, slope_error = 0;  // of the function in the centre, by the points of the table next to it
  double change = 0;                  // largest value minus smallest
  double formula_error = 0;           // that the best formula promises of the derivative
  bool at_floor = false;              // the noise seen is below what the solutions' own error may hide
  bool falls = false;                 // the noise falls from order to order: a function that is not resolved
  NoiseOutcome outcome = {};

  bool constant() const { return outcome == NoiseOutcome::spacing_too_small; }
  bool smooth() const { return outcome == NoiseOutcome::spacing_too_large; }
  bool resolved() const {
    constexpr double of_change = 1e-4;
    return smooth() || size.noise <= of_change * change;
  }
  bool agrees_with(const TableReading& other) const {
    constexpr double deviations = 3;
    return std::abs(slope - other.slope) <= deviations * (slope_error + other.slope_error);
  }
};

/// The derivative in the centre by the five points next to it.
void read_slope(const ValueTable& table, double centre, TableReading& reading) {
  constexpr std::size_t count = 5;
  std::vector<std::size_t> places(table.points.size());
  std::iota(places.begin(), places.end(), 0);
  std::sort(places.begin(), places.end(),
            [&](std::size_t a, std::size_t b) { return std::abs(table.points[a]) < std::abs(table.points[b]); });
  std::vector<double> offsets;
  for (std::size_t j = 0; j < count; ++j) offsets.push_back(table.points[places[j]]);
  const std::vector<double> weights = first_derivative_weights(offsets);
  for (std::size_t j = 0; j < count; ++j) reading.slope += weights[j] * (table.values[places[j]] - centre);
  const FormulaError error = FormulaSize(weights, offsets).error(1, reading.size);
  reading.slope_error = error.truncation + error.noise;
}

/// What the best formula promises of the derivative.
double promised_error(const FunctionSize& size, const SampledLine& line) {
  constexpr int order = 4;
  const std::vector<DifferenceFormula> found = formulas(order, size, size.reach, line.room_below(), line.room_above());
  return found.empty() ? std::numeric_limits<double>::infinity() : found.front().expected_error;
}

TableReading read(const ValueTable& table, const SampledLine& line) {
  const double centre = line.centre_value();
  const NoiseEstimate estimate = table_noise(table);
  TableReading reading{.outcome = estimate.outcome};
  const double noise = reading.constant() ? largest_change(table.values)  // a constant, or a staircase: its steps
                       : reading.smooth() ? last_level(estimate)
                                          : estimate.noise;
  // Solutions may differ by their own error over any distance; a larger one is nearly the same at neighbouring points.
  constexpr double largest_floor = 1e-9;
  const double rounding = std::numeric_limits<double>::epsilon() * std::abs(centre),
               floor = std::max(rounding, std::min(table.relative_error, largest_floor) * std::abs(centre));
  FunctionSize& size = reading.size;
  size.noise = std::max(noise, floor);
  reading.at_floor = noise <= floor;
  constexpr double unlike_jumps = 4;  // over two or three orders, in which those of jumps hardly fall
  const std::vector<double>& levels = estimate.levels;
  reading.falls = levels.size() > 6 && levels[3] > unlike_jumps * std::max(levels[5], levels[6]);
  size.derivatives = derivative_bounds(table, centre, std::max(noise, rounding));
  size.reach = std::max(std::abs(table.points.front()), std::abs(table.points.back()));
  read_slope(table, centre, reading);
  const auto [least, most] = std::minmax_element(table.values.begin(), table.values.end());
  reading.change = *most - *least;
  reading.formula_error = promised_error(size, line);
  return reading;
}

/// Whether the derivative is as good as it gets: a narrower table is not worth its evaluations.
bool good(const TableReading& reading, double relative_error, double centre) {
  constexpr double by_rounding = 1e-13, least = 1e-8, most = 1e-6, of_error = 1e3, by_floor = 1e-5;
  const double wanted = relative_error == 0 ? (reading.smooth() ? by_rounding : most)
                        : reading.at_floor  ? by_floor
                                            : std::clamp(of_error * relative_error, least, most);
  return reading.formula_error <= wanted * std::max(std::abs(reading.slope), 0.1 * std::abs(centre));
}

/// Whether the solutions are those of continuous edges, which make no jumps: grids hardly ever state errors so small.
bool is_continuous(double relative_error) { return relative_error > 0 && relative_error < 1e-6; }

/// Whether what a table shows beside a smooth function are the jumps of a grid: small against the error that the
/// solutions state, or against what the function does over the table.
bool jumps_as_grids(const TableReading& reading, double relative_error, double centre) {
  constexpr double of_change = 0.01, of_error = 3;
  if (reading.smooth() || reading.falls || is_continuous(relative_error)) return false;
  return reading.size.noise <= std::max(of_change * reading.change, of_error * relative_error * std::abs(centre));
}

/// What a narrower table that agrees tells of the noise: a wider one may take the function for noise, and noise for the
/// function.
void take_noise(const TableReading& narrower, const SampledLine& line, TableReading& wider) {
  double& noise = wider.size.noise;
  if (wider.smooth())
    noise = std::min(noise, narrower.size.noise);
  else if (!narrower.smooth())
    noise = std::max(noise, narrower.size.noise);
  wider.formula_error = promised_error(wider.size, line);
}

InputCalibration calibrated(SampledLine line) {
  InputCalibration calibration;
  const double centre = line.centre_value(), relative_error = line.centre_error();
  std::optional<TableReading> best;
  double spacing = wide_spacing, widest_change = 0;
  for (int tables = 0; tables < most_tables; ++tables) {
    const ValueTable table = tabulate(line, values_of_table, spacing);
    if (table.empty()) break;
    const TableReading reading = read(table, line);
    if (best && reading.constant() && reading.change <= 0.5 * widest_change) {
      // between the steps of a grid, or where the input has no effect
      if (is_continuous(relative_error)) best = reading;
      break;
    }
    const bool agrees = best && reading.agrees_with(*best);
    if (agrees) take_noise(reading, line, *best);
    if (!agrees || reading.formula_error < best->formula_error)
      best = reading;
    else if (best->resolved() || reading.at_floor)
      break;  // only what rounding does grows
    if (tables == 0) widest_change = reading.change;
    if (good(*best, relative_error, centre) || jumps_as_grids(reading, relative_error, centre)) break;
    spacing = table.spacing / narrowing;
  }
  if (best) calibration.size = best->size;
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
    calibration.inputs[input] = calibrated(SampledLine(objective, point, input, calibration.centre));
  });
  return calibration;
}

}  // namespace rollres
