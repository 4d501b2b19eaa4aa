#include <algorithm>
#include <numbers>
#include <optional>
#include <ostream>
#include <stdexcept>

#include "core/material/material_functions.hpp"
#include "core/model/scene_rules.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/scene/scene_input.hpp"
#include "studies/figures/material_chart.hpp"
#include "studies/figures/material_export.hpp"
#include "studies/program/commands.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct MaterialArguments {
  std::string scene, layer, chart, format = "table";
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

/// The layer that was asked for; else the first that loses something, the one in contact before those on the body.
std::string chosen_layer(RollingScene& scene, const MaterialArguments& arguments) {
  std::vector<std::string> keys = layer_keys(scene);
  if (!arguments.layer.empty()) {
    if (std::find(keys.begin(), keys.end(), arguments.layer) == keys.end())
      throw std::invalid_argument("--layer " + arguments.layer + ": the scene has " + joined(keys, ", "));
    return arguments.layer;
  }
  std::stable_partition(keys.begin(), keys.end(), [](const std::string& key) { return !key.starts_with("lower_"); });
  const auto loses = [&](const std::string& key) { return !creep_spectrum(layer_of(scene, key)).terms.empty(); };
  const auto found = std::find_if(keys.begin(), keys.end(), loses);
  return found == keys.end() ? keys.front() : *found;
}

/// What was understood of the tables that a layer of the scene file names, one line each.
std::vector<std::string> tables_in_words(const MaterialArguments& arguments, const std::string& layer) {
  std::vector<std::string> words;
  Json object = read_object(arguments.scene);
  const std::optional<ElementKey> further = element_key(layer);
  if (further) {
    Json layers = object.value(std::string(further->list), Json::array());
    object =
        further->place < layers.size() && layers[further->place].is_object() ? layers[further->place] : Json::object();
  }
  for (const std::string_view key : table_keys) {
    std::filesystem::path file;
    if (const auto named = object.find(std::string(key)); named != object.end() && named->is_string())
      file = std::filesystem::path(arguments.scene).parent_path() / named->get<std::string>();
    const std::string set = (further ? layer + '.' : std::string()) + std::string(key) + '=';
    for (const std::string& override : arguments.overrides)
      if (override.starts_with(set)) file = override.substr(set.size());
    if (!file.empty()) words.push_back(read_measured_table(file).in_words());
  }
  return words;
}

/// @param name of the layer   @param others its neighbours
void print_words(std::ostream& out, const MaterialArguments& arguments, const std::string& name,
                 std::vector<std::string> others, const MaterialInputs& layer, const CreepSpectrum& creep,
                 const std::optional<ContactFrequencies>& contact) {
  std::erase(others, name);
  if (!others.empty()) out << "layer        " << name << " (--layer shows " << joined(others, ", ") << ")\n";
  out << "material     " << name_of(layer.material) << '\n';
  for (const std::string& table : tables_in_words(arguments, name)) out << "table        " << table << '\n';
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
  RollingScene scene = read_scene(arguments.scene, arguments.overrides);
  const SolutionLimits limits = limits_of(scene);
  std::optional<CreepSpectrum> found;
  std::string name;
  try {
    name = chosen_layer(scene, arguments);
    found = creep_spectrum(layer_of(scene, name));
  } catch (const BeyondLimits& limit) {
    session.err << arguments.scene << ": " << limit.what() << '\n';
    session.status = ExitStatus::no_answer;
    return;
  }
  const CreepSpectrum& creep = *found;
  const MaterialInputs& layer = layer_of(scene, name);
  const std::optional<ContactFrequencies> contact = contact_frequencies(scene);
  const bool exports = std::count(material_export_formats.begin(), material_export_formats.end(), arguments.format) > 0;
  if (arguments.format == "table") {
    print_words(session.out, arguments, name, layer_keys(scene), layer, creep, contact);
    session.out << '\n';
  }
  if (exports)
    session.out << exported_material(scene, name, arguments.format);
  else
    write_table(session.out, moduli_table(creep, arguments.per_decade), arguments.format);
  if (arguments.chart.empty()) return;
  for (const auto& file : draw_material(layer, arguments.chart, contact))
    session.err << "drawn " << file.string() << '\n';
}

}  // namespace

void add_material(Command& program, Session& session) {
  const auto [command, arguments] = program.add<MaterialArguments>(
      "material", "Show the material of a scene's layer: moduli, peaks of loss, creep and relaxation", session,
      run_material);
  command->add_option("scene SCENE", arguments.scene, "scene file (JSON)")->required();
  command->add_option("--layer LAYER", arguments.layer,
                      "layer, lower_layers[0] or coating_layers[0] and so on; default: the first that loses something");
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
