#include <algorithm>
#include <numbers>
#include <optional>
#include <ostream>

#include "core/material/material_functions.hpp"
#include "core/model/scene_rules.hpp"
#include "core/numerics/solution_limits.hpp"
#include "studies/figures/material_chart.hpp"
#include "studies/figures/material_export.hpp"
#include "studies/program/commands.hpp"
#include "studies/scene_io/master_curve_file.hpp"
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

/// What was understood of the tables that a scene names, one line each.
std::vector<std::string> tables_in_words(const MaterialArguments& arguments) {
  std::vector<std::string> words;
  const Json object = read_object(arguments.scene);
  for (const std::string_view key : table_keys) {
    std::filesystem::path file;
    if (const auto named = object.find(std::string(key)); named != object.end() && named->is_string())
      file = std::filesystem::path(arguments.scene).parent_path() / named->get<std::string>();
    const std::string set = std::string(key) + '=';
    for (const std::string& override : arguments.overrides)
      if (override.starts_with(set)) file = override.substr(set.size());
    if (!file.empty()) words.push_back(read_measured_table(file).in_words());
  }
  return words;
}

void print_words(std::ostream& out, const MaterialArguments& arguments, const RollingScene& layer,
                 const CreepSpectrum& creep, const std::optional<ContactFrequencies>& contact) {
  out << "material     " << name_of(layer.material) << '\n';
  for (const std::string& table : tables_in_words(arguments)) out << "table        " << table << '\n';
  if (const std::string route = material_route(layer); !route.empty()) out << "route        " << route << '\n';
  for (const std::string& warning : material_warnings(layer)) out << "warning      " << warning << '\n';
  out << "at rest      G = " << readable(1 / creep.at_rest(), "Pa") << '\n'
      << "at once      G = " << readable(1 / creep.instantaneous, "Pa") << '\n';
  if (contact) out << "contact      " << contact->in_words() << '\n';
  if (creep.terms.empty()) return;
  out << "slow motion  G\"/(ω G') = " << readable(slow_loss_time(creep), "s") << '\n';
  for (const LossPeak& peak : loss_peaks(creep))
    out << "loss peak    G\"/G' = " << short_number(peak.tangent, 4) << " at "
        << readable(peak.omega / (2 * std::numbers::pi), "Hz") << '\n';
}

constexpr auto material_formats = table_formats_and(material_export_formats);

/// Draws the pictures of a material, NAME_moduli and so on; returns the SVG files.
std::vector<std::filesystem::path> draw_material(const MaterialInputs& layer, const std::filesystem::path& name,
                                                 const std::optional<ContactFrequencies>& contact) {
  const std::string base = name.filename().string();
  std::vector<std::filesystem::path> files;
  const auto draw = [&](const char* ending, const ChartRequest& request) {
    files.push_back(draw_chart(request, name.parent_path() / (base + ending)).svg);
  };
  draw("_moduli", moduli_chart(layer, base + ": storage and loss", contact));
  draw("_creep", creep_chart(layer, base + ": creep and relaxation"));
  if (!creep_spectrum(layer).terms.empty()) draw("_spectrum", spectrum_chart(layer, base + ": spectrum of relaxation"));
  if (shifts_times(layer)) draw("_shift", shift_chart(layer, base + ": shift by temperature"));
  if (is_measured_curve(layer.material)) draw("_misfit", misfit_chart(layer, base + ": what the fit misses"));
  return files;
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
  const std::optional<ContactFrequencies> contact = contact_frequencies(scene);
  const bool exports = std::count(material_export_formats.begin(), material_export_formats.end(), arguments.format) > 0;
  if (arguments.format == "table") {
    print_words(session.out, arguments, scene, creep, contact);
    session.out << '\n';
  }
  if (exports)
    session.out << exported_material(scene, arguments.format);
  else
    write_table(session.out, moduli_table(creep, arguments.per_decade), arguments.format);
  if (arguments.chart.empty()) return;
  for (const auto& file : draw_material(scene, arguments.chart, contact))
    session.err << "drawn " << file.string() << '\n';
}

}  // namespace

void add_material(Command& program, Session& session) {
  const auto [command, arguments] = program.add<MaterialArguments>(
      "material", "Show a scene's material: moduli, peaks of loss, creep and relaxation", session, run_material);
  command->add_option("scene SCENE", arguments.scene, "scene file (JSON)")->required();
  command->add_option("--set KEY=VALUE", arguments.overrides, "replace an input, in SI or with a unit; may be repeated")
      ->one_value_each();
  command->add_option(
      "--out PATH", arguments.chart,
      "draw pictures PATH_moduli, PATH_creep, PATH_spectrum, of a shift PATH_shift, of a table PATH_misfit");
  command
      ->add_option("--per-decade N", arguments.per_decade, "rows of the table for each decade of frequency; default: 1")
      ->between(1, 100);
  command
      ->add_option("--format FORMAT", arguments.format,
                   "table (default), csv, json, jsonl or markdown of moduli; or the Prony series with its shift for "
                   "abaqus, ansys, comsol, as prony_csv or as a scene")
      ->one_of(material_formats);
  command->footer("Example: rollres material studies/examples/paper_cylinder.json --out rubber");
}

}  // namespace rollres
