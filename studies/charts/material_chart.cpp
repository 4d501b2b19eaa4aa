#include "studies/charts/material_chart.hpp"

#include <numbers>
#include <sstream>

#include "core/material/material_functions.hpp"
#include "core/material/material_scale.hpp"
#include "studies/drawing/chart_frame.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

constexpr int points_per_decade = 20;
constexpr double mega = 1e6;

/// One line or set of points, its values against those of x.
struct MaterialCurve {
  const char* name;
  bool points;
  std::vector<double> x, y;
};

std::filesystem::path draw(const std::filesystem::path& name, const std::string& title, const ChartAxis& x,
                           const ChartAxis& y, const std::vector<MaterialCurve>& curves) {
  const ChartFiles files = chart_files(name);
  std::ostringstream script, data;
  Span x_span{.logarithmic = true}, y_span{.logarithmic = true};
  std::vector<std::string> plots;
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const MaterialCurve& curve = curves[i];
    data << (i == 0 ? "# " : "\n\n# ") << curve.name << '\n';
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
      x_span.include(curve.x[k]);
      if (curve.y[k] > 0) y_span.include(curve.y[k]);
      data << shortest(curve.x[k]) << ' ' << (curve.y[k] > 0 ? shortest(curve.y[k]) : "NaN") << '\n';
    }
    const std::string look = std::string(curve.points ? "points pt 7 ps 0.7" : "lines lw 1.8") + " lc rgb '" +
                             std::string(curve_colour(i % 2)) + "'";
    plots.push_back("data index " + std::to_string(i) + " using 1:2 with " + look + " notitle");
    entries.push_back({look, std::string(curve.name) + kept_blanks, width(curve.name)});
  }
  x_span.widen(0.02, 0.02);
  y_span.widen(0.04, 0.06);
  write_axes(script, files, x, x_span, y, y_span);
  write_pictures(script, files, title, plots, entries);
  draw_pictures(files, data.str(), script.str());
  return files.svg;
}

}  // namespace

std::vector<std::filesystem::path> draw_material(const MaterialInputs& layer, const std::filesystem::path& name) {
  const CreepSpectrum creep = creep_spectrum(layer);
  const RelaxationSpectrum relaxation = relaxation_spectrum(creep);
  MaterialCurve storage{"storage modulus", false, {}, {}}, loss{"loss modulus", false, {}, {}};
  MaterialCurve creeping{"1/J(t)", false, {}, {}}, relaxing{"G(t)", false, {}, {}};
  for (const double omega : angular_frequencies(creep, points_per_decade)) {
    const std::complex<double> modulus = 1.0 / creep(omega) / mega;
    storage.x.push_back(omega / (2 * std::numbers::pi));
    storage.y.push_back(modulus.real());
    loss.y.push_back(modulus.imag());
    creeping.x.insert(creeping.x.begin(), 1 / omega);
    creeping.y.insert(creeping.y.begin(), 1 / creep_compliance(creep, 1 / omega) / mega);
    relaxing.y.insert(relaxing.y.begin(), relaxation_modulus(relaxation, 1 / omega) / mega);
  }
  loss.x = storage.x;
  relaxing.x = creeping.x;
  std::vector<MaterialCurve> moduli{storage, loss};
  if (layer.material == MaterialModel::master_curve) {
    // The table holds at the reference temperature: a row acts at the frequency over the shift of times.
    const double shift = time_shift(layer);
    moduli.push_back({"table", true, {}, {}});
    moduli.push_back({"table", true, {}, {}});
    for (std::size_t row = 0; row < layer.frequencies.size(); ++row) {
      for (const std::size_t i : {2U, 3U}) moduli[i].x.push_back(layer.frequencies[row] / shift);
      moduli[2].y.push_back(as_shear(layer, layer.storage_moduli[row]) / mega);
      moduli[3].y.push_back(as_shear(layer, layer.loss_moduli[row]) / mega);
    }
  }
  const ChartAxis modulus{.name = "shear modulus", .unit = "MPa", .logarithmic = true};
  const std::string base = name.filename().string();
  const auto beside = [&](const char* ending) { return name.parent_path() / (base + ending); };
  return {draw(beside("_moduli"), base + ": storage and loss", {.name = "frequency", .unit = "Hz", .logarithmic = true},
               modulus, moduli),
          draw(beside("_creep"), base + ": creep and relaxation",
               {.name = "time", .symbol = "t", .unit = "s", .logarithmic = true}, modulus, {creeping, relaxing})};
}

}  // namespace rollres
