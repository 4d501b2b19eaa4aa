#include "studies/scene_io/master_curve_file.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/material/material_functions.hpp"
#include "core/numerics/sorted_places.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/scene_inputs.hpp"

namespace rollres {

std::vector<double> measured_frequencies(const MeasuredTable& table) {
  const MeasuredColumn* const radians = table.find("angular_frequency");
  if (radians && table.find("frequency"))
    throw std::invalid_argument(table.file + ": give frequency or angular_frequency, not both");
  const std::string rule = frequency_range.rule() + " Hz";
  if (!radians) return measured_numbers(table, table.needed("frequency"), "Hz", frequency_range, rule);
  constexpr double turn = 2 * std::numbers::pi;
  const Range range{turn * frequency_range.lowest, turn * frequency_range.highest};
  measured_numbers(table, *radians, "rad/s", range, rule);
  // As under "frequency": to 15 digits, so that a table in rad/s is to all digits the one in Hz. Rotations are refused.
  return measured_numbers(table, *radians, "Hz", frequency_range, rule);
}

namespace {

/// A name that says whether a column holds G or E, and the name without.
struct ModulusName {
  std::string_view written, plain;
  ListedModuli said;
};
constexpr std::array<ModulusName, 20> modulus_names{
    {{"storage_shear_modulus", "storage_modulus", ListedModuli::shear},
     {"loss_shear_modulus", "loss_modulus", ListedModuli::shear},
     {"G'", "storage_modulus", ListedModuli::shear},
     {"G''", "loss_modulus", ListedModuli::shear},
     {"G\"", "loss_modulus", ListedModuli::shear},
     {"G′", "storage_modulus", ListedModuli::shear},
     {"G″", "loss_modulus", ListedModuli::shear},
     {"storage_young_modulus", "storage_modulus", ListedModuli::young},
     {"loss_young_modulus", "loss_modulus", ListedModuli::young},
     {"E'", "storage_modulus", ListedModuli::young},
     {"E''", "loss_modulus", ListedModuli::young},
     {"E\"", "loss_modulus", ListedModuli::young},
     {"E′", "storage_modulus", ListedModuli::young},
     {"E″", "loss_modulus", ListedModuli::young},
     {"complex_shear_modulus", "complex_modulus", ListedModuli::shear},
     {"complex_young_modulus", "complex_modulus", ListedModuli::young},
     {"relaxation_shear_modulus", "relaxation_modulus", ListedModuli::shear},
     {"relaxation_young_modulus", "relaxation_modulus", ListedModuli::young},
     {"shear_creep_compliance", "creep_compliance", ListedModuli::shear},
     {"tensile_creep_compliance", "creep_compliance", ListedModuli::young}}};

/// The first of these names for a column.
std::string name_that_says(std::string_view plain, ListedModuli said) {
  const auto found =
      find_if(modulus_names, [&](const ModulusName& name) { return name.plain == plain && name.said == said; });
  return std::string(found->written);
}

void drop(MeasuredTable& table, std::string_view name) {
  std::erase_if(table.columns, [&](const MeasuredColumn& column) { return column.name == name; });
}

/// A loss tangent in place of a phase angle.
void take_phase_angle(MeasuredTable& table) {
  const MeasuredColumn* const angle = table.find("phase_angle");
  if (!angle) return;
  if (!table.find("loss_tangent") && !table.find("tan_delta")) {
    constexpr Range acute{.lowest = 0, .highest = 0.99999 * std::numbers::pi / 2, .lowest_excluded = true};
    MeasuredColumn tangent{"loss_tangent", "1", {}, {}, name_in_file(*angle)};
    tangent.cells = angle->cells;
    tangent.values = measured_numbers(table, *angle, "rad", acute, "must be above 0 and below 90 deg");
    for (double& value : tangent.values) value = std::tan(value);
    table.columns.push_back(std::move(tangent));
  }
  drop(table, "phase_angle");
}

/// Storage and loss modulus in place of |G*| and the loss tangent; beside other moduli |G*| says nothing.
void take_complex_modulus(MeasuredTable& table) {
  const MeasuredColumn* const complex = table.find("complex_modulus");
  if (!complex) return;
  if (!table.find("storage_modulus") && !table.find("loss_modulus")) {
    const std::string key = table.find("tan_delta") ? "tan_delta" : "loss_tangent";
    if (!table.find(key))
      throw std::invalid_argument(table.file + ": " + name_in_file(*complex) +
                                  " needs a column beside it: tan_delta or phase_angle [deg]");
    MeasuredColumn storage{"storage_modulus", "Pa", complex->cells, measured_numbers(table, *complex, "Pa", positive),
                           name_in_file(*complex)};
    const std::vector<double> tangents = measured_numbers(table, table.needed(key), "1", positive);
    MeasuredColumn loss = storage;
    loss.name = "loss_modulus";
    for (std::size_t row = 0; row < tangents.size(); ++row) {
      storage.values[row] /= std::hypot(1, tangents[row]);
      loss.values[row] = storage.values[row] * tangents[row];
    }
    drop(table, key);
    table.columns.push_back(std::move(storage));
    table.columns.push_back(std::move(loss));
  }
  drop(table, "complex_modulus");
}

}  // namespace

std::optional<ListedModuli> take_modulus_names(MeasuredTable& table) {
  std::optional<ListedModuli> said;
  std::string saying;
  for (MeasuredColumn& column : table.columns) {
    const auto found = find_if(modulus_names, [&](const ModulusName& name) { return name.written == column.name; });
    if (found == modulus_names.end()) continue;
    if (const MeasuredColumn* const other = table.find(found->plain))
      throw std::invalid_argument(table.file + ": give " + (other->written.empty() ? other->name : other->written) +
                                  " or " + column.name + ", not both");
    if (said && *said != found->said)
      throw std::invalid_argument(table.file + ": " + saying + " and " + column.name +
                                  ": must both be of shear or both Young's; ignore_columns leaves one out");
    said = found->said;
    saying = column.name;
    if (column.written.empty()) column.written = column.name;
    column.name = found->plain;
  }
  take_phase_angle(table);
  take_complex_modulus(table);
  return said;
}

std::string unsaid_moduli(const std::string& what, std::string_view column) {
  return std::string(listed_moduli_key) + " is missing: " + what + ": of shear or Young's? Say \"shear\" or \"young\"" +
         (column.empty() ? std::string()
                         : ", or name the column of the table " + name_that_says(column, ListedModuli::shear) + " or " +
                               name_that_says(column, ListedModuli::young));
}

ListedModuli said_moduli(std::optional<ListedModuli> by_names, std::optional<ListedModuli> by_key,
                         const std::string& file, std::string_view column, const std::string& place) {
  if (!by_names && !by_key)
    throw std::invalid_argument(place + ": " + unsaid_moduli(std::string(column) + " of " + file, column));
  if (by_names && by_key && *by_names != *by_key)
    throw std::invalid_argument(place + ": " + std::string(listed_moduli_key) + " = \"" +
                                std::string(name_of(*by_key)) + "\": the columns of " + file + " say " +
                                std::string(name_of(*by_names)));
  return by_names ? *by_names : *by_key;
}

MeasuredModuli measured_moduli(const MeasuredTable& table, const Range& loss_range, const std::string& rule) {
  const MeasuredColumn* const storage = table.find("storage_modulus");
  const MeasuredColumn* const loss = table.find("loss_modulus");
  const MeasuredColumn* tangent = table.find("loss_tangent");
  const MeasuredColumn* const other = table.find("tan_delta");
  if (tangent && other) throw std::invalid_argument(table.file + ": give loss_tangent or tan_delta, not both");
  if (!tangent) tangent = other;
  MeasuredModuli moduli;
  if (storage || !tangent) moduli.storage = measured_numbers(table, table.needed("storage_modulus"), "Pa", positive);
  if (loss || !tangent || !storage)
    moduli.loss = measured_numbers(table, table.needed("loss_modulus"), "Pa", loss_range, rule);
  if (storage && loss) return moduli;
  const std::vector<double> tangents =
      measured_numbers(table, *tangent, "1", storage ? loss_range : positive, storage ? rule : std::string());
  auto& missing = storage ? moduli.loss : moduli.storage;
  for (std::size_t row = 0; row < table.rows(); ++row)
    missing.push_back(storage ? moduli.storage[row] * tangents[row] : moduli.loss[row] / tangents[row]);
  return moduli;
}

namespace {

bool is_over_time(const MeasuredTable& table) {
  return table.find("relaxation_modulus") || table.find("creep_compliance");
}

/// @param what  "frequencies"
void refuse_one_place(const MeasuredTable& table, const std::vector<double>& places, const std::string& what) {
  if (std::all_of(places.begin(), places.end(), [&](double place) { return place == places.front(); }))
    throw std::invalid_argument(table.file + ": must have rows at two different " + what + " at least");
}

/// Refuses a row that is beyond the extreme of those before it in time by more than noise explains.
/// @param sign  1 of a modulus, which falls, -1 of a compliance, which rises
void refuse_against_time(const MeasuredTable& table, const MeasuredColumn& column, const std::vector<double>& times,
                         const std::vector<double>& values, int sign) {
  constexpr double noise = 0.05;
  const std::vector<std::size_t> order = sorted_places(times.size(), [&](std::size_t row) { return times[row]; });
  std::size_t extreme = order.front();
  for (const std::size_t row : order) {
    if (sign * std::log(values[row] / values[extreme]) > noise)
      throw std::invalid_argument(table.place(row) + ": " + heading(column) + " = " + column.cells[row] +
                                  (sign > 0 ? ": a relaxation modulus must not rise with time, as it does from "
                                            : ": a creep compliance must not fall with time, as it does from ") +
                                  column.cells[extreme] + " in line " + std::to_string(table.lines[extreme]) +
                                  (times[row] == times[extreme] ? ", at the same time" : ""));
    if (sign * values[row] < sign * values[extreme]) extreme = row;
  }
}

/// Takes the temperature of all rows away. @throws std::invalid_argument if they have several
void refuse_temperatures(MeasuredTable& table) {
  constexpr double one = 1;  // [K]
  const MeasuredColumn* const column = table.find("temperature");
  if (!column) return;
  const std::vector<double> all = measured_numbers(table, *column, "K", positive);
  for (std::size_t row = 0; row < all.size(); ++row)
    if (std::abs(all[row] - all.front()) > one)
      throw std::invalid_argument(table.place(row) + ": " + heading(*column) + " = " + column->cells[row] +
                                  ": a master curve is at one temperature, and the first row is at " +
                                  column->cells.front() +
                                  "; \"rollres fit\" with \"shift\": \"free\" makes one of rows at several");
  drop(table, "temperature");
}

/// The lists of a relaxation_curve.
Json lists_over_time(const MeasuredTable& table) {
  table.refuse_others(relaxation_columns);
  const MeasuredColumn *const modulus = table.find("relaxation_modulus"), *const compliance =
                                                                              table.find("creep_compliance");
  if (modulus && compliance)
    throw std::invalid_argument(table.file + ": give " + name_in_file(*modulus) + " or " + name_in_file(*compliance) +
                                ", not both: each row is of relaxation or of creep; ignore_columns leaves one out");
  const MeasuredColumn& column = modulus ? *modulus : *compliance;
  const std::vector<double> times = measured_numbers(table, table.needed("time"), "s", positive),
                            values = measured_numbers(table, column, modulus ? "Pa" : "1/Pa", positive);
  refuse_one_place(table, times, "times");
  refuse_against_time(table, column, times, values, modulus ? 1 : -1);
  // The way from creep grows with the decades. Those of a scene's times:
  constexpr Range time_range{.lowest = 1e-40, .highest = 1e40};
  if (!modulus) measured_numbers(table, table.needed("time"), "s", time_range, time_range.rule() + " s");
  return {{"material", std::string(name_of(MaterialModel::relaxation_curve))},
          {"relaxation_times", times},
          {"relaxation_moduli", modulus ? values : relaxation_of_creep(times, values)}};
}

}  // namespace

Json read_master_curve(const std::filesystem::path& file, const std::vector<std::string>& ignored) {
  MeasuredTable table = read_measured_table(file);
  table.leave_out(ignored);
  const std::optional<ListedModuli> said = take_modulus_names(table);
  const bool over_time = is_over_time(table);
  if (!over_time) {
    refuse_temperatures(table);
    table.refuse_others(modulus_columns);
  }
  Json lists = over_time ? lists_over_time(table) : Json();
  if (said) lists[std::string(listed_moduli_key)] = std::string(name_of(*said));
  if (over_time) return lists;
  const std::vector<double> frequencies = measured_frequencies(table);
  lists["frequencies"] = frequencies;
  const MeasuredModuli moduli =
      measured_moduli(table, not_negative, not_negative.rule() + ": no passive material gives energy back");
  refuse_one_place(table, frequencies, "frequencies");
  lists["storage_moduli"] = moduli.storage;
  lists["loss_moduli"] = moduli.loss;
  return lists;
}

Json read_strain_sweep(const std::filesystem::path& file, const std::vector<std::string>& ignored) {
  MeasuredTable table = read_measured_table(file);
  table.leave_out(ignored);
  take_modulus_names(table);  // of shear or Young's: only their ratios count
  constexpr std::array<std::string_view, 6> known{"strain",       "storage_modulus", "loss_modulus",
                                                  "loss_tangent", "tan_delta",       "note"};
  table.refuse_others(known);
  Json lists;
  lists["sweep_strains"] = measured_numbers(table, table.needed("strain"), "1", positive);
  const MeasuredModuli moduli = measured_moduli(table, positive);
  lists["sweep_storage_moduli"] = moduli.storage;
  lists["sweep_loss_moduli"] = moduli.loss;
  return lists;
}

std::vector<double> measured_shift_factors(const MeasuredTable& table) {
  const MeasuredColumn* const decades = table.find("log10_a_T");
  if (decades && table.find("a_T")) throw std::invalid_argument(table.file + ": give a_T or log10_a_T, not both");
  if (!decades) return measured_numbers(table, table.needed("a_T"), "1", positive);
  constexpr Range representable{.lowest = -300, .highest = 300};
  std::vector<double> factors = measured_numbers(table, *decades, "1", representable);
  for (double& factor : factors) factor = std::pow(10, factor);
  return factors;
}

Json read_shift_table(const std::filesystem::path& file, const std::vector<std::string>& ignored) {
  MeasuredTable table = read_measured_table(file);
  table.leave_out(ignored);
  table.refuse_others(shift_columns);
  Json lists;
  lists["shift_temperatures"] = measured_numbers(table, table.needed("temperature"), "K", positive);
  const MeasuredColumn* const moduli = table.find("b_T");
  if (!moduli || table.find("a_T") || table.find("log10_a_T")) lists["shift_factors"] = measured_shift_factors(table);
  if (moduli) lists["modulus_shifts"] = measured_numbers(table, *moduli, "1", positive);
  return lists;
}

Json read_profile(const std::filesystem::path& file, const std::vector<std::string>& ignored) {
  MeasuredTable table = read_measured_table(file);
  table.leave_out(ignored);
  constexpr std::array<std::string_view, 3> known{"y", "height", "note"};
  table.refuse_others(known);
  return {{"profile_places", measured_numbers(table, table.needed("y"), "m", any_number)},
          {"profile_heights", measured_numbers(table, table.needed("height"), "m", any_number)}};
}

namespace {

/// One part of a scene with the lists of its own tables.
Json with_own_tables(const Json& object, const std::filesystem::path& folder, const std::string& place) {
  const auto named = [&](std::string_view key) { return object.is_object() && object.contains(std::string(key)); };
  const std::string material = "material";
  const bool is_curve = named(material) && object[material] == name_of(MaterialModel::master_curve);
  const std::vector<std::string> ignored = names_or_none(object, std::string(ignored_columns_key), place);
  Json complete = Json::object();
  const auto add_lists = [&](std::string_view file_key, const auto& inputs, const auto& read) {
    const Json& name = object[std::string(file_key)];
    if (!name.is_string() || name.get_ref<const std::string&>().empty())
      refuse(place, file_key, name, "must be the name of a CSV file");
    for (const std::string_view input : inputs)
      if (named(input))
        refuse(place, input, object[std::string(input)], "is in the " + std::string(file_key) + "; give one of them");
    const Json lists = read(folder / name.template get<std::string>(), ignored);
    const std::string said(listed_moduli_key);
    if (lists.contains(said) && named(said) && object[said] != lists[said])
      refuse(place, said, object[said],
             "the columns of " + name.template get<std::string>() + " say " + lists[said].template get<std::string>());
    for (const auto& [input, list] : lists.items()) {  // tables tell the units of all their numbers
      if (input == material && named(material) && !is_curve) continue;
      if (list.is_array() && named(input))
        refuse(place, input, object[input], "is in the " + std::string(file_key) + "; give one of them");
      complete[input] =
          list.is_array() ? written_input(find_input(input)->quantity, list.template get<std::vector<double>>()) : list;
    }
  };
  for (const auto& [key, value] : object.items())
    if (key == master_curve_key)
      add_lists(master_curve_key, master_curve_inputs, read_master_curve);
    else if (key == strain_sweep_key)
      add_lists(strain_sweep_key, strain_sweep_inputs, read_strain_sweep);
    else if (key == shift_table_key)
      add_lists(shift_table_key, shift_table_inputs, read_shift_table);
    else if (key == profile_key)
      add_lists(profile_key, profile_inputs, read_profile);
    else if (key != ignored_columns_key && !(key == material && is_curve && complete.contains(key)))
      complete[key] = value;
  return complete;
}

}  // namespace

std::vector<TablePart> parts_with_tables(Json& scene) {
  if (!scene.is_object()) return {};
  std::vector<TablePart> parts;
  const auto add = [&](Json& object, const std::string& prefix) {
    if (any_of(table_keys, [&](std::string_view key) { return object.contains(std::string(key)); }))
      parts.push_back({&object, prefix});
  };
  add(scene, "");
  for (auto& [key, list] : scene.items()) {
    const InputKind* const kind = find_input(key);
    if (!kind || !kind->layers || !list.is_array()) continue;
    for (std::size_t layer = 0; layer < list.size(); ++layer)
      if (list[layer].is_object()) add(list[layer], key + "[" + std::to_string(layer) + "].");
  }
  return parts;
}

std::string table_key_of(std::string_view input) {
  if (find_name(strain_sweep_inputs, input) >= 0) return std::string(strain_sweep_key);
  if (find_name(shift_table_inputs, input) >= 0) return std::string(shift_table_key);
  if (find_name(profile_inputs, input) >= 0) return std::string(profile_key);
  return std::string(master_curve_key);
}

bool names_tables(const Json& scene) {
  Json copy = scene;
  return !parts_with_tables(copy).empty();
}

Json with_master_curve(const Json& object, const std::filesystem::path& folder, const std::string& place) {
  Json complete = object;
  const std::vector<TablePart> parts = parts_with_tables(complete);
  for (auto part = parts.rbegin(); part != parts.rend(); ++part)  // the layers before the object that holds them
    *part->object =
        with_own_tables(*part->object, folder,
                        part->prefix.empty() ? place : place + ": " + part->prefix.substr(0, part->prefix.size() - 1));
  return complete;
}

}  // namespace rollres
