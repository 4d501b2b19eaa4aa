#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <ostream>

#include "core/material/material_functions.hpp"
#include "core/material/material_scale.hpp"
#include "core/model/scene_rules.hpp"
#include "core/numerics/solution_limits.hpp"
#include "studies/drawing/chart_frame.hpp"
#include "studies/figures/material_export.hpp"
#include "studies/program/commands.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

struct MaterialArguments {
  std::string scene, chart, format = "table";
  std::vector<std::string> overrides;
  int per_decade = 1;
};

Table moduli_table(const CreepSpectrum& creep, int per_decade) {
  Table table{{"frequency [Hz]", "storage_shear_modulus [Pa]", "loss_shear_modulus [Pa]", "loss_tangent"}, {}};
  for (const double omega : angular_frequencies(creep, per_decade)) {
    const std::complex<double> modulus = 1.0 / creep(omega);
    table.rows.push_back(
        {omega / (2 * std::numbers::pi), modulus.real(), modulus.imag(), modulus.imag() / modulus.real()});
  }
  return table;
}

void print_words(std::ostream& out, const MaterialInputs& layer, const CreepSpectrum& creep) {
  out << "material     " << name_of(layer.material) << '\n';
  if (const std::string route = material_route(layer); !route.empty()) out << "route        " << route << '\n';
  for (const std::string& warning : material_warnings(layer)) out << "warning      " << warning << '\n';
  out << "at rest      G = " << readable(1 / creep.at_rest(), "Pa") << '\n'
      << "at once      G = " << readable(1 / creep.instantaneous, "Pa") << '\n';
  if (creep.terms.empty()) return;
  out << "slow motion  G\"/(ω G') = " << readable(slow_loss_time(creep), "s") << '\n';
  for (const LossPeak& peak : loss_peaks(creep))
    out << "loss peak    G\"/G' = " << short_number(peak.tangent, 4) << " at "
        << readable(peak.omega / (2 * std::numbers::pi), "Hz") << '\n';
}

constexpr auto material_formats = [] {
  std::array<std::string_view, table_formats.size() + material_export_formats.size()> all;
  std::copy(material_export_formats.begin(), material_export_formats.end(),
            std::copy(table_formats.begin(), table_formats.end(), all.begin()));
  return all;
}();

constexpr int points_per_decade = 20;
constexpr double mega = 1e6;
constexpr int all_digits = 15;

/// One line or set of points, its values against those of x.
struct MaterialCurve {
  const char* name;
  bool points;
  std::vector<double> x, y;
};

std::filesystem::path draw_curves(const std::filesystem::path& name, const std::string& title, const ChartAxis& x,
                                  const ChartAxis& y, const std::vector<MaterialCurve>& curves) {
  Span x_span{.logarithmic = true}, y_span{.logarithmic = true};
  for (const MaterialCurve& curve : curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
      x_span.include(curve.x[k]);
      if (curve.y[k] > 0) y_span.include(curve.y[k]);
    }
  x_span.widen(0.02, 0.02);
  y_span.widen(0.04, 0.06);
  const ChartFiles files = chart_files(name);
  PictureBuilder picture(title, files, x, x_span, y, y_span);
  const std::string columns = x.name + " [" + x.unit + "], " + y.name + " [" + y.unit + "]";
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const MaterialCurve& curve = curves[i];
    std::vector<DataRow> rows;
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      rows.push_back({curve.x[k], curve.y[k] > 0 ? curve.y[k] : std::numeric_limits<double>::quiet_NaN()});
    const std::string look = std::string(curve.points ? "points pt 7 ps 0.7" : "lines lw 1.8") + " lc rgb '" +
                             std::string(curve_colour(i % 2)) + "'";
    picture.plot(picture.add(curve.name, columns, rows, all_digits) + " using 1:2 with " + look + " notitle");
    picture.explain(LegendEntry::plain(look, curve.name));
  }
  const PictureText text = picture.finished(title);
  draw_pictures(files, text.data, text.script, {title});
  return files.svg;
}

/// Draws NAME_moduli, moduli against frequency with the rows of the table, and NAME_creep, creep and relaxation against
/// time; returns the SVG files.
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
    // The table holds at the reference temperature: a row acts at the frequency over the shift of times, its moduli
    // over that of moduli.
    const double shift = time_shift(layer), unit = mega * modulus_shift(layer);
    moduli.push_back({"table", true, {}, {}});
    moduli.push_back({"table", true, {}, {}});
    for (std::size_t row = 0; row < layer.frequencies.size(); ++row) {
      for (const std::size_t i : {2U, 3U}) moduli[i].x.push_back(layer.frequencies[row] / shift);
      moduli[2].y.push_back(as_shear(layer, layer.storage_moduli[row]) / unit);
      moduli[3].y.push_back(as_shear(layer, layer.loss_moduli[row]) / unit);
    }
  }
  const ChartAxis modulus{.name = "shear modulus", .unit = "MPa", .logarithmic = true};
  const std::string base = name.filename().string();
  const auto beside = [&](const char* ending) { return name.parent_path() / (base + ending); };
  return {
      draw_curves(beside("_moduli"), base + ": storage and loss",
                  {.name = "frequency", .unit = "Hz", .logarithmic = true}, modulus, moduli),
      draw_curves(beside("_creep"), base + ": creep and relaxation",
                  {.name = "time", .symbol = "t", .unit = "s", .logarithmic = true}, modulus, {creeping, relaxing})};
}

void run_material(const MaterialArguments& arguments, Session& session) {
  const RollingScene scene = read_scene(arguments.scene, arguments.overrides);
  const SolutionLimits limits = limits_of(scene);
  std::optional<CreepSpectrum> found;
  try {
    found = creep_spectrum(scene);
  } catch (const BeyondLimits& limit) {
    session.err << arguments.scene << ": " << limit.what() << '\n';
    session.status = ExitStatus::no_answer;
    return;
  }
  const CreepSpectrum& creep = *found;
  const bool exports = std::count(material_export_formats.begin(), material_export_formats.end(), arguments.format) > 0;
  if (arguments.format == "table") {
    print_words(session.out, scene, creep);
    session.out << '\n';
  }
  if (exports)
    session.out << exported_material(scene, arguments.format);
  else
    write_table(session.out, moduli_table(creep, arguments.per_decade), arguments.format);
  if (arguments.chart.empty()) return;
  for (const auto& file : draw_material(scene, arguments.chart)) session.err << "drawn " << file.string() << '\n';
}

}  // namespace

void add_material(Command& program, Session& session) {
  const auto [command, arguments] = program.add<MaterialArguments>(
      "material", "Show a scene's material: moduli, peaks of loss, creep and relaxation", session, run_material);
  command->add_option("scene SCENE", arguments.scene, "Scene file (JSON)")->required();
  command->add_option("--set KEY=VALUE", arguments.overrides, "Replace an input, in SI or with a unit; may be repeated")
      ->one_value_each();
  command->add_option("--out PATH", arguments.chart, "Draw pictures PATH_moduli and PATH_creep");
  command
      ->add_option("--per-decade N", arguments.per_decade, "Rows of the table for each decade of frequency; default 1")
      ->between(1, 100);
  command
      ->add_option("--format FORMAT", arguments.format,
                   "table (default), csv, json, jsonl or markdown of moduli; or the Prony series with its shift for "
                   "abaqus, ansys, comsol, as prony_csv or as a scene")
      ->one_of(material_formats);
  command->footer("Example: rollres material studies/examples/paper_cylinder.json --out rubber");
}

}  // namespace rollres
