#include "studies/figures/material_chart.hpp"

#include <algorithm>
#include <numbers>

#include "core/material/master_curve.hpp"
#include "core/material/material_functions.hpp"
#include "core/material/material_scale.hpp"
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
    const auto [least, most] = std::minmax_element(frequencies.begin(), frequencies.end());
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

ScaledUnit unit_of(const CreepSpectrum& creep) {
  return scaled_unit_logarithmic("Pa", 1 / creep.at_rest(), 1 / creep.instantaneous);
}

}  // namespace

ChartRequest moduli_chart(const MaterialInputs& layer, const std::string& title) {
  const CreepSpectrum creep = creep_spectrum(layer);
  const ActingRows rows(layer);
  const ScaledUnit unit = unit_of(creep);
  ChartRequest request = empty_chart(title, {.name = "frequency", .unit = "Hz", .logarithmic = true}, unit);
  ChartCurve storage{"storage modulus", {}}, loss{"loss modulus", {}};
  for (const double frequency : rows.places(creep)) {
    const std::complex<double> modulus = 1.0 / creep(turn * frequency) / unit.factor;
    storage.points.push_back({frequency, modulus.real()});
    loss.points.push_back({frequency, modulus.imag()});
  }
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

}  // namespace rollres
