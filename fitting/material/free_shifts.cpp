#include "fitting/material/free_shifts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "core/messages/message_text.hpp"
#include "fitting/material/even_series.hpp"
#include "fitting/material/material_problem.hpp"
#include "fitting/material/series_fit.hpp"
#include "fitting/material/shift_fit.hpp"

namespace rollres {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// A curve y(x) of rising x, by lines between its points.
struct Curve {
  std::vector<double> x, y;

  bool contains(double at) const { return !x.empty() && at >= x.front() && at <= x.back(); }
  double operator()(double at) const {
    const auto above = std::lower_bound(x.begin(), x.end(), at);
    const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, above - x.begin()));
    if (x.size() == 1) return y.front();
    const double t = (at - x[i - 1]) / (x[i] - x[i - 1]);
    return y[i - 1] + t * (y[i] - y[i - 1]);
  }
};

Curve curve_of(std::vector<std::pair<double, double>> points) {
  std::sort(points.begin(), points.end());
  Curve curve;
  for (const auto& [x, y] : points)
    if (curve.x.empty() || x > curve.x.back()) {
      curve.x.push_back(x);
      curve.y.push_back(y);
    }
  return curve;
}

/// The rows at each temperature.
std::vector<std::vector<MeasuredModulus>> rows_at(const std::vector<MeasuredModulus>& data,
                                                  const std::vector<double>& temperatures) {
  std::vector<std::vector<MeasuredModulus>> rows(temperatures.size());
  for (const MeasuredModulus& row : data) rows[nearest_step(temperatures, row.temperature)].push_back(row);
  return rows;
}

/// A number of the rows over log10 of the frequency.
template <class Number>
Curve over_frequency(const std::vector<MeasuredModulus>& rows, Number number) {
  std::vector<std::pair<double, double>> points;
  for (const MeasuredModulus& row : rows) points.emplace_back(std::log10(row.angular_frequency), number(row));
  return curve_of(std::move(points));
}

/// The squares by which one curve, moved by `shift` along x, misses another, at the points of both; and their number.
std::pair<double, int> missed_by(const Curve& one, const Curve& other, double shift) {
  double squares = 0;
  int count = 0;
  const auto add = [&](const Curve& from, const Curve& to, double moved) {
    for (std::size_t i = 0; i < from.x.size(); ++i)
      if (const double at = from.x[i] + moved; to.contains(at)) {
        squares += std::pow(from.y[i] - to(at), 2);
        ++count;
      }
  };
  add(other, one, shift);
  add(one, other, -shift);
  return {squares, count};
}

/// log10 of the factor by which frequencies of the warmer rows become those of the colder ones.
double joining_shift(const std::vector<MeasuredModulus>& colder, const std::vector<MeasuredModulus>& warmer) {
  const auto storage = [](const MeasuredModulus& row) { return std::log10(row.storage); };
  const auto loss = [](const MeasuredModulus& row) { return std::log10(row.loss); };
  const Curve cold[] = {over_frequency(colder, storage), over_frequency(colder, loss)},
              warm[] = {over_frequency(warmer, storage), over_frequency(warmer, loss)};
  constexpr double farthest = 8, step = 0.02;  // decades
  constexpr int fewest = 4;                    // points that tell a shift
  std::pair<double, double> best{std::numeric_limits<double>::infinity(), 0};
  for (double shift = -farthest; shift <= 0; shift += step) {
    const auto [first, one] = missed_by(cold[0], warm[0], shift);
    const auto [second, two] = missed_by(cold[1], warm[1], shift);
    if (one + two >= fewest) best = std::min(best, {(first + second) / (one + two), shift});
  }
  return best.second;
}

TemperatureShift table_of(const TemperatureShift& table, const TemperatureShift& law) {
  TemperatureShift shift = table;
  for (std::size_t i = 0; i < shift.table.temperatures.size(); ++i)
    shift.table.factors[i] = shift_factor(law, shift.table.temperatures[i]);
  return shift;
}

TemperatureShift joined(const std::vector<MeasuredModulus>& data, TemperatureShift shift) {
  const std::vector<double>& temperatures = shift.table.temperatures;
  const auto rows = rows_at(data, temperatures);
  std::vector<double> logarithms{0};
  for (std::size_t i = 1; i < rows.size(); ++i)
    logarithms.push_back(logarithms.back() + joining_shift(rows[i - 1], rows[i]));
  const double reference = logarithms[nearest_step(temperatures, shift.reference)];
  for (std::size_t i = 0; i < rows.size(); ++i) shift.table.factors[i] = std::pow(10, logarithms[i] - reference);
  return shift;
}

}  // namespace

std::vector<double> steps_of_temperature(const std::vector<MeasuredModulus>& data) {
  std::vector<const MeasuredModulus*> rows;
  for (const MeasuredModulus& row : data) rows.push_back(&row);
  std::sort(rows.begin(), rows.end(), [](const auto* a, const auto* b) { return a->temperature < b->temperature; });
  constexpr double apart = 1, widest = 2;  // [K]
  std::vector<double> steps;
  for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
    double sum = 0;
    for (end = begin; end < rows.size(); ++end) {
      if (end > begin && rows[end]->temperature - rows[end - 1]->temperature > apart) break;
      if (rows[end]->temperature - rows[begin]->temperature > widest)
        throw std::invalid_argument(message_text(rows[end]->place,
                                                 ": temperature = ", in_celsius<3>(rows[end]->temperature),
                                                 ": free shifts need temperatures in steps of more than 1 K, and from ",
                                                 in_celsius<3>(rows[begin]->temperature), " they run on without one"));
      sum += rows[end]->temperature;
    }
    steps.push_back(sum / static_cast<double>(end - begin));
  }
  if (steps.size() < 2)
    throw std::invalid_argument("free shifts need rows at two temperatures at least, more than 1 K apart");
  return steps;
}

TemperatureShift start_of_free_shifts(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options) {
  std::vector<TemperatureShift> starts;
  for (const ShiftLaw law : {ShiftLaw::wlf, ShiftLaw::arrhenius}) {
    MaterialFitOptions lawful = options;
    lawful.free_shifts = false;
    lawful.shift = usual_constants({.law = law, .reference = options.shift.reference}, data);
    starts.push_back(table_of(options.shift, best_shift(data, lawful)));
  }
  starts.push_back(joined(data, options.shift));
  // Where moduli hardly change with the frequency, as in the glassy state, neighbours tell no shift: a law goes first
  // unless it misses the data by twice as much.
  constexpr int terms = 40;
  constexpr double twice_missed = 4;
  std::pair<double, std::size_t> best{std::numeric_limits<double>::infinity(), 0};
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double squares = even_series(data, starts[i], terms).squares;
    best = std::min(best, {i + 1 < starts.size() ? squares : twice_missed * squares, i});
  }
  return starts[best.second];
}

std::vector<KnownBefore> even_steps(const TemperatureShift& shift, double deviation, std::size_t parameter) {
  constexpr double of_mean_step = 0.3, of_vertical = 0.02;  // decades
  const std::vector<double>& temperatures = shift.table.temperatures;
  const std::size_t count = temperatures.size(), reference = nearest_step(temperatures, shift.reference);
  const double whole = std::log10(shift.table.factors.front() / shift.table.factors.back());
  std::vector<KnownBefore> known;
  const auto add = [&](std::size_t first, double change) {
    for (std::size_t i = 1; i + 1 < count; ++i) {
      const double below = temperatures[i] - temperatures[i - 1], above = temperatures[i + 1] - temperatures[i],
                   mean = 0.5 * (below + above);
      KnownBefore& one = known.emplace_back();
      one.deviation = change / deviation;
      one.of = "even steps of the shift";
      const double weights[] = {mean / below, -mean / below - mean / above, mean / above};
      for (std::size_t k = 0; k < 3; ++k)
        if (const std::size_t place = i - 1 + k; place != reference)
          one.parts.push_back({first + place - (place > reference ? 1 : 0), false, weights[k]});
    }
  };
  add(parameter, of_mean_step * std::max(0.1, std::abs(whole) / static_cast<double>(count - 1)));
  if (!shift.table.moduli.empty()) add(parameter + count - 1, of_vertical);
  return known;
}

std::string LawThrough::in_words() const {
  return message_text<2>(name, " through the shifts (", constants, ") misses them by ", missed, " decades (rms)");
}

std::vector<LawThrough> laws_through(const TemperatureShift& shift) {
  std::vector<MeasuredShift> table;
  for (std::size_t i = 0; i < shift.table.temperatures.size(); ++i)
    table.push_back({shift.table.temperatures[i], shift.table.factors[i]});
  const std::optional<double> reference = take_reference(table);
  std::vector<LawThrough> laws;
  for (const auto& [law, name] :
       {std::pair(ShiftLaw::wlf, "WLF"), {ShiftLaw::arrhenius, "Arrhenius"}, {ShiftLaw::vft, "VFT"}})
    try {
      const ShiftFit found =
          fit_shift(table, {.law = law, .reference = shift.reference}, not_known, {.profiles = false}, reference);
      LawThrough through{name, found.shift, "", 0};
      for (const FittedParameter& fitted : found.report.parameters) {
        const std::string_view unit = fitted.parameter.variable.quantity.unit;
        through.constants += message_text<4>(through.constants.empty() ? "" : ", ", fitted.parameter.name, " = ",
                                             fitted.value, unit == "1" ? "" : " " + std::string(unit));
      }
      double squares = 0;
      for (const FittedValue& value : found.report.values)
        squares += std::pow((value.predicted - value.measured.value) / std::numbers::ln10, 2);
      through.missed = std::sqrt(squares / static_cast<double>(found.report.values.size()));
      laws.push_back(std::move(through));
    } catch (const std::invalid_argument&) {  // too few temperatures for this law
    }
  return laws;
}

bool SuperpositionTest::holds() const {
  constexpr double noticed = 2, share = 0.1, covering = 2;  // [deg], of the angle, of what interpolation misses
  return !(rms > std::hypot(std::max(noticed, share * mean_angle), covering * between));
}

std::string SuperpositionTest::in_words() const {
  if (std::isnan(rms)) return "no two temperatures have moduli of one size: superposition is not tested";
  return message_text<2>(
      "at the same |G*| the loss angles of neighbouring temperatures differ by ", rms, " degrees (rms) of ", mean_angle,
      between > 0.5 * rms ? message_text<2>(", where interpolation between rows misses ", between) : "",
      holds() ? ": time-temperature superposition holds"
              : ": no shift of frequencies joins them, superposition does not hold",
      untested == 0 ? ""
                    : message_text("; of ", pairs, " pairs of neighbours ", untested, untested == 1 ? " has" : " have",
                                   " no |G*| in common and ", untested == 1 ? "is" : "are", " not tested"));
}

std::vector<MeasuredModulus> times_vertical_shifts(std::vector<MeasuredModulus> data, const TemperatureShift& shift) {
  const ShiftFactors factors(shift);
  for (MeasuredModulus& row : data) {
    const double factor = factors.modulus(row.temperature);
    row.storage *= factor;
    row.loss *= factor;
  }
  return data;
}

SuperpositionTest superposition_test(const std::vector<MeasuredModulus>& data,
                                     const std::vector<double>& temperatures) {
  std::vector<Curve> curves;
  for (const auto& rows : rows_at(data, temperatures)) {
    std::vector<std::pair<double, double>> points;
    for (const MeasuredModulus& row : rows)
      points.emplace_back(std::log10(std::hypot(row.storage, row.loss)),
                          std::atan2(row.loss, row.storage) * 180 / std::numbers::pi);
    curves.push_back(curve_of(std::move(points)));
  }
  // A row that is left out is missed by about four times what interpolation misses between rows.
  double missed = 0;
  int left_out = 0;
  for (const Curve& curve : curves)
    for (std::size_t k = 1; k + 1 < curve.x.size(); ++k, ++left_out) {
      const Curve neighbours{{curve.x[k - 1], curve.x[k + 1]}, {curve.y[k - 1], curve.y[k + 1]}};
      missed += std::pow(0.25 * (curve.y[k] - neighbours(curve.x[k])), 2);
    }
  double squares = 0, sum = 0;
  int count = 0, pairs = 0, untested = 0;
  for (std::size_t i = 0; i + 1 < curves.size(); ++i) {
    const int before = count;
    for (const auto& [from, to] : {std::pair(i, i + 1), std::pair(i + 1, i)})
      for (std::size_t k = 0; k < curves[from].x.size(); ++k)
        if (const double at = curves[from].x[k]; curves[to].contains(at) && curves[to].x.size() > 1) {
          squares += std::pow(curves[from].y[k] - curves[to](at), 2);
          sum += curves[from].y[k];
          ++count;
        }
    ++pairs;
    if (count == before) ++untested;
  }
  if (count == 0) return {not_known, not_known, not_known, pairs, untested};
  return {std::sqrt(squares / count), sum / count, left_out > 0 ? std::sqrt(missed / left_out) : 0, pairs, untested};
}

std::string without_overlap(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift) {
  const std::vector<double>& temperatures = shift.table.temperatures;
  const auto rows = rows_at(data, temperatures);
  const ShiftFactors factors(shift);
  std::string pairs;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    double slowest = std::numeric_limits<double>::infinity(), fastest = 0;
    for (const MeasuredModulus& row : rows[i])
      slowest = std::min(slowest, row.angular_frequency * factors.time(row.temperature));
    for (const MeasuredModulus& row : rows[i + 1])
      fastest = std::max(fastest, row.angular_frequency * factors.time(row.temperature));
    if (fastest < slowest)
      pairs +=
          (pairs.empty() ? "" : ", ") + in_celsius<3>(temperatures[i]) + " and " + in_celsius<3>(temperatures[i + 1]);
  }
  if (pairs.empty()) return "";
  return "reduced frequencies do not overlap between " + pairs +
         ": nothing but the smoothness of the material joins them";
}

}  // namespace rollres
