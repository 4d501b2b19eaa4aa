#include "studies/figures/material_chart.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>

#include "core/estimate/grid_choice.hpp"
#include "core/material/master_curve.hpp"
#include "core/material/material_functions.hpp"
#include "core/material/material_scale.hpp"
#include "core/solve/resolve.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

constexpr double turn = 2 * std::numbers::pi;

/// The rows of a layer's table as they act at its temperature; none of other materials.
struct ActingRows {
  std::vector<double> frequencies, storage, loss;  ///< [Hz], [Pa]; of relaxation G(t) at 1/(2 pi t), and no loss
  double lowest = 0, highest = std::numeric_limits<double>::infinity();  ///< frequency

  explicit ActingRows(const MaterialInputs& layer) {
    if (!is_measured_curve(layer.material)) return;
    const double shift = time_shift(layer), scale = modulus_shift(layer);
    const MasterCurve curve = measured_curve(layer);
    for (const double frequency : curve.frequencies) frequencies.push_back(frequency / shift);
    for (const double modulus : curve.storage) storage.push_back(modulus / scale);
    for (const double modulus : curve.loss) loss.push_back(modulus / scale);
    const auto [least, most] = minmax_element(frequencies);
    lowest = *least, highest = *most;
  }

  /// Frequencies at which the curves are drawn, rising: those of the spectrum, and both ends of the table.
  std::vector<double> places(const CreepSpectrum& creep) const {
    constexpr int per_decade = 20;
    std::vector<double> all;
    for (const double omega : angular_frequencies(creep, per_decade)) all.push_back(omega / turn);
    if (!frequencies.empty()) all.insert(all.end(), {lowest, highest});
    std::sort(all.begin(), all.end());
    return all;
  }
};

/// Adds two curves, each solid in the places from `lowest` to `highest` and dashed beyond.
void add_curves(ChartRequest& request, std::vector<ChartCurve> curves, double lowest, double highest) {
  std::vector<ChartCurve> beyond;
  for (ChartCurve& curve : curves) {
    const auto part = [&](double from, double to) {
      std::vector<ChartPoint> points = curve.points;
      std::erase_if(points,
                    [&](const ChartPoint& point) { return !(point.y > 0 && point.x >= from && point.x <= to); });
      return points;
    };
    for (const auto& points : {part(0, lowest), part(highest, std::numeric_limits<double>::infinity())})
      if (points.size() > 1)
        beyond.push_back({.label = curve.label,
                          .points = points,
                          .like = request.curves.size(),
                          .marks = false,
                          .extrapolated = true});
    curve.points = part(lowest, highest);
    curve.marks = false;
    if (!curve.points.empty()) request.curves.push_back(std::move(curve));
  }
  std::move(beyond.begin(), beyond.end(), std::back_inserter(request.curves));
}

/// A chart of moduli of shear without its curves, in a unit for all values between rest and the fastest motion.
ChartRequest empty_chart(const std::string& title, ChartAxis x, const ScaledUnit& unit) {
  x.margin = 0.02;
  return {.title = title,
          .x = std::move(x),
          .y = {.name = "shear modulus", .unit = typeset_unit(unit.name), .logarithmic = true},
          .curves = {},
          .mark_peaks = false};
}

/// Two deviations of storage and loss that a table leaves open [Pa]. @param omega at its own temperature
std::array<double, 2> left_open(const OpenSpectrum& open, double omega) {
  const Eigen::Map<const Eigen::ArrayXd> times(open.times.data(), std::ssize(open.times));
  const Eigen::ArrayXd turned = omega * times, elastic = 1 - 1 / (1 + turned.square()),
                       lossy = times.isInf().select(0, turned / (1 + turned.square()));
  return {2 * open.deviation(elastic), 2 * open.deviation(lossy)};
}

ScaledUnit unit_of(const CreepSpectrum& creep) {
  return scaled_unit_logarithmic("Pa", 1 / creep.at_rest(), 1 / creep.instantaneous);
}

}  // namespace

ChartRequest moduli_chart(const MaterialInputs& layer, const std::string& title,
                          const std::optional<ContactFrequencies>& contact) {
  const CreepSpectrum creep = creep_spectrum(layer);
  const ActingRows rows(layer);
  const ScaledUnit unit = unit_of(creep);
  ChartRequest request = empty_chart(title, {.name = "frequency", .unit = "Hz", .logarithmic = true}, unit);
  ChartCurve storage{"storage modulus", {}}, loss{"loss modulus", {}};
  const double shift = time_shift(layer), scale = modulus_shift(layer) * unit.factor;
  const auto fit = is_measured_curve(layer.material) ? shared_master_curve_fit(layer) : nullptr;
  const auto with_band = [](double frequency, double modulus, double open) {
    constexpr double lowest = 0.02;  // of the curve, on an axis of logarithms
    return ChartPoint{frequency, modulus, true, std::max(modulus - open, lowest * modulus), modulus + open};
  };
  for (const double frequency : rows.places(creep)) {
    const std::complex<double> modulus = 1.0 / creep(turn * frequency) / unit.factor;
    storage.points.push_back({frequency, modulus.real()});
    loss.points.push_back({frequency, modulus.imag()});
    if (!fit || frequency < rows.lowest || frequency > rows.highest) continue;
    const auto [of_storage, of_loss] = left_open(fit->open, turn * frequency * shift);
    storage.points.back() = with_band(frequency, modulus.real(), of_storage / scale);
    loss.points.back() = with_band(frequency, modulus.imag(), of_loss / scale);
  }
  if (fit) request.areas = "left open by the table (95 %)";
  if (contact && contact->band)
    request.range =
        ChartRange{contact->band->lowest, contact->band->highest, "where the contact loses 80 % of its power"};
  add_curves(request, {storage, loss}, rows.lowest, rows.highest);
  if (rows.loss.empty()) return request;
  request.subtitle = "marks: the table's rows";
  for (const auto& [curve, moduli] : {std::pair(0, &rows.storage), std::pair(1, &rows.loss)}) {
    ChartCurve marks{.label = "table", .points = {}, .like = curve, .line = false};
    for (std::size_t row = 0; row < moduli->size(); ++row)
      if ((*moduli)[row] > 0) marks.points.push_back({rows.frequencies[row], (*moduli)[row] / unit.factor});
    request.curves.push_back(std::move(marks));
  }
  return request;
}

ChartRequest creep_chart(const MaterialInputs& layer, const std::string& title) {
  const CreepSpectrum creep = creep_spectrum(layer);
  const RelaxationSpectrum relaxation = relaxation_spectrum(creep);
  const ActingRows rows(layer);
  const ScaledUnit unit = unit_of(creep);
  ChartRequest request = empty_chart(title, {.name = "time", .symbol = "t", .unit = "s", .logarithmic = true}, unit);
  ChartCurve creeping{"1/J(t)", {}}, relaxing{"G(t)", {}};
  const auto time = [](double frequency) { return 1 / (turn * frequency); };
  for (const double frequency : rows.places(creep)) {
    const double t = time(frequency);
    creeping.points.push_back({t, 1 / creep_compliance(creep, t) / unit.factor});
    relaxing.points.push_back({t, relaxation_modulus(relaxation, t) / unit.factor});
  }
  add_curves(request, {creeping, relaxing}, time(rows.highest),
             rows.lowest > 0 ? time(rows.lowest) : std::numeric_limits<double>::infinity());
  if (rows.frequencies.empty() || !rows.loss.empty()) return request;
  request.subtitle = "marks: the table's rows";
  ChartCurve marks{.label = "table", .points = {}, .like = 1, .line = false};
  for (std::size_t row = 0; row < rows.storage.size(); ++row)
    marks.points.push_back({time(rows.frequencies[row]), rows.storage[row] / unit.factor});
  request.curves.push_back(std::move(marks));
  return request;
}

ChartRequest misfit_chart(const MaterialInputs& layer, const std::string& title) {
  const MasterCurve curve = measured_curve(layer);
  const auto fit = shared_master_curve_fit(layer);
  const PronySeries& series = fit->series;
  ChartRequest request{.title = title,
                       .subtitle = fit->in_words(),
                       .x = {.name = curve.is_relaxation() ? "time" : "frequency",
                             .unit = curve.is_relaxation() ? "s" : "Hz",
                             .logarithmic = true,
                             .margin = 0.02},
                       .y = {.name = "fit less row, of the row", .unit = "%"},
                       .curves = {{curve.is_relaxation() ? "modulus" : "storage modulus", {}}},
                       .lines = false,
                       .mark_peaks = false};
  if (!curve.is_relaxation()) request.curves.push_back({"loss modulus", {}});
  for (const std::size_t row : rows_in_order(curve)) {
    const double omega = turn * curve.frequencies[row], x = curve.is_relaxation() ? 1 / omega : curve.frequencies[row];
    const auto add = [&](std::size_t which, double fitted, double measured) {
      if (measured > 0) request.curves[which].points.push_back({x, 100 * (fitted / measured - 1)});
    };
    if (curve.is_relaxation()) {
      add(0, relaxation_modulus(series, 1 / omega), curve.storage[row]);
      continue;
    }
    const std::complex<double> fitted = complex_modulus(series, omega);
    add(0, fitted.real(), curve.storage[row]);
    add(1, fitted.imag(), curve.loss[row]);
  }
  return request;
}

ChartRequest spectrum_chart(const MaterialInputs& layer, const std::string& title) {
  const CreepSpectrum creep = creep_spectrum(layer);
  const RelaxationSpectrum relaxation = relaxation_spectrum(creep);
  const ScaledUnit unit = unit_of(creep);
  ChartRequest request = empty_chart(title, {.name = "relaxation time", .unit = "s", .logarithmic = true}, unit);
  request.subtitle = "moduli of the terms of its Prony series";
  request.lines = false;
  ChartCurve terms{"", {}};
  for (const RelaxationSpectrum::Term& term : relaxation.terms)
    if (term.modulus > 0) terms.points.push_back({term.time, term.modulus / unit.factor});
  request.curves.push_back(std::move(terms));
  return request;
}

bool shifts_times(const MaterialInputs& layer) {
  return layer.reference_temperature &&
         (layer.wlf_c1 || layer.vft_b || layer.activation_energy || !layer.shift_factors.empty());
}

ChartRequest shift_chart(const MaterialInputs& layer, const std::string& title) {
  const ScaledUnit degrees = celsius();
  const double reference = *layer.reference_temperature, own = layer.temperature.value_or(reference);
  const auto point = [&](double temperature) {
    MaterialInputs there = layer;
    there.temperature = temperature;
    return ChartPoint{degrees.number(temperature), time_shift(there)};
  };
  ChartRequest request{
      .title = title,
      .subtitle = "times at T over those at " + short_number(degrees.number(reference), 4) + " " + degrees.name,
      .x = {.name = "temperature", .symbol = "T", .unit = degrees.name, .margin = 0.02},
      .y = {.name = "shift of times", .symbol = "a_T", .logarithmic = true},
      .curves = {},
      .mark_peaks = false};
  double lowest = std::min(own, reference), highest = std::max(own, reference);
  ChartCurve rows{.label = "table", .points = {}, .line = false};
  if (!layer.shift_factors.empty()) {
    for (const double temperature : layer.shift_temperatures) rows.points.push_back(point(temperature));
    const auto [first, last] = minmax_element(layer.shift_temperatures);
    lowest = std::min(lowest, *first), highest = std::max(highest, *last);
  } else {
    constexpr double aside = 30;  // of a law [K]; it ends at its pole
    const double pole = layer.wlf_c2 ? reference - *layer.wlf_c2 : layer.vft_temperature.value_or(0);
    lowest = std::max(lowest - aside, 0.5 * (lowest + pole));
    highest += aside;
  }
  constexpr int pieces = 120;
  ChartCurve curve{.label = rows.points.empty() ? "law" : "between the rows", .points = {}, .marks = false};
  for (int i = 0; i <= pieces; ++i) curve.points.push_back(point(lowest + (highest - lowest) * i / pieces));
  request.curves.push_back(std::move(curve));
  if (!rows.points.empty()) request.curves.push_back(std::move(rows));
  request.curves.push_back({.label = "this layer, " + short_number(degrees.number(own), 4) + " " + degrees.name,
                            .points = {point(own)},
                            .line = false});
  return request;
}

std::string ContactFrequencies::in_words() const {
  std::string words = "about " + short_number(typical, 3) + " Hz";
  if (band)
    words += "; 80 % of the power is lost between " + short_number(band->lowest, 3) + " and " +
             short_number(band->highest, 3) + " Hz";
  return words;
}

std::optional<ContactFrequencies> contact_frequencies(const RollingScene& scene) {
  try {
    const ContactModel model = resolve(scene);
    const double half_width = estimate_contact(model).half_width;
    return ContactFrequencies{scene.speed / (turn * half_width), loss_band(model, half_width)};
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

}  // namespace rollres
