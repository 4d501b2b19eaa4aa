#include "studies/stored_fits/free_shift_files.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "fitting/material/free_shifts.hpp"
#include "fitting/material/material_problem.hpp"
#include "studies/drawing/chart.hpp"
#include "studies/text/files.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

ChartRequest shifts_chart(const MaterialFit& found, const std::string& name) {
  const ShiftTable& table = found.shift.table;
  const auto in_celsius = [](double temperature) { return celsius().number(temperature); };
  ChartRequest request{.title = name,
                       .subtitle = "shifts found with the material, reference " +
                                   short_number(in_celsius(found.shift.reference), 4) + " °C",
                       .x = {.name = "temperature", .symbol = "T", .unit = "°C"},
                       .y = {.name = "log10 a_T"},
                       .curves = {{"found", {}}},
                       .mark_peaks = false};
  request.curves.front().line = false;
  for (std::size_t i = 0; i < table.temperatures.size(); ++i)
    request.curves.front().points.push_back(
        {in_celsius(table.temperatures[i]), std::log10(shift_factor(found.shift, table.temperatures[i]))});
  const auto [lowest, highest] = minmax_element(table.temperatures);
  for (const LawThrough& law : laws_through(found.shift)) {
    ChartCurve& curve = request.curves.emplace_back(ChartCurve{law.name, {}});
    curve.marks = false;
    constexpr int pieces = 80;
    for (int i = 0; i <= pieces; ++i) {
      const double temperature = *lowest + (*highest - *lowest) * i / pieces;
      curve.points.push_back({in_celsius(temperature), std::log10(shift_factor(law.shift, temperature))});
    }
  }
  return request;
}

/// Loss angle over |G*|, times b_T where it was found: no shift of frequencies changes it.
ChartRequest angles_chart(const MaterialFit& found, const std::vector<MeasuredModulus>& data, const std::string& name) {
  const std::vector<double>& temperatures = found.shift.table.temperatures;
  const std::vector<MeasuredModulus> moved = times_vertical_shifts(data, found.shift);
  const auto size = [](const MeasuredModulus& row) { return std::hypot(row.storage, row.loss); };
  const auto [least, most] = std::minmax_element(
      moved.begin(), moved.end(), [&](const auto& one, const auto& other) { return size(one) < size(other); });
  const ScaledUnit unit = scaled_unit_logarithmic("Pa", size(*least), size(*most));
  ChartRequest request{.title = name,
                       .subtitle = superposition_test(moved, temperatures).in_words(),
                       .x = {.name = found.shift.table.moduli.empty() ? "|G*|" : "b_T |G*|",
                             .unit = typeset_unit(unit.name),
                             .logarithmic = true},
                       .y = {.name = "loss angle", .symbol = "δ", .unit = "deg"},
                       .curves = {},
                       .mark_peaks = false};
  for (const double temperature : temperatures)
    request.curves.push_back({short_number(std::round(10 * celsius().number(temperature)) / 10, 4) + " °C", {}});
  for (const MeasuredModulus& row : moved)
    request.curves[nearest_step(temperatures, row.temperature)].points.push_back(
        {size(row) / unit.factor, std::atan2(row.loss, row.storage) * 180 / std::numbers::pi});
  for (ChartCurve& curve : request.curves)
    std::sort(curve.points.begin(), curve.points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  return request;
}

}  // namespace

std::vector<std::filesystem::path> write_free_shifts(const MaterialFit& found, const std::vector<MeasuredModulus>& data,
                                                     const std::string& name, const std::filesystem::path& folder) {
  const bool vertical = !found.shift.table.moduli.empty();
  std::string text = "# " + name + ": shifts found with the material, 0 at " + short_number(found.shift.reference, 6) +
                     " K\ntemperature [K],log10_a_T [1]" + (vertical ? ",b_T [1]" : "") + '\n';
  for (const double temperature : found.shift.table.temperatures)
    text += short_number(temperature, 7) + ',' + shortest(std::log10(shift_factor(found.shift, temperature))) +
            (vertical ? ',' + shortest(modulus_factor(found.shift, temperature)) : "") + '\n';
  const std::filesystem::path file = folder / "shifts.csv";
  write_file(file, text);
  const ChartFiles picture = draw_chart(shifts_chart(found, name), folder / "shifts");
  const ChartFiles angles = draw_chart(angles_chart(found, data, name), folder / "van_gurp_palmen");
  return {file, picture.svg, picture.png, angles.svg, angles.png};
}

}  // namespace rollres
