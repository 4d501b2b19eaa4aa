#pragma once

/// Tables of a master curve that scenes name: {"material": "master_curve", "master_curve_file": "rubber.csv"}. For
/// sources only: it needs nlohmann_json.
///
/// Columns: frequency [Hz] or angular_frequency [rad/s]; two of storage_modulus [Pa], loss_modulus [Pa] and
/// loss_tangent [1] (or tan_delta), of all three the moduli count; or complex_modulus [Pa] (|G*|, |E*|) and
/// loss_tangent; a phase_angle [deg] may stand for the tangent; temperature [degC], if all rows are at one; note.
/// Whether the moduli are G or E is said by their names (storage_shear_modulus or G', storage_young_modulus or E',
/// loss_... or G'', E'') or by the key `listed_moduli`. Others are refused unless the key `ignore_columns`, a list of
/// names, leaves them out.
///
/// Or the modulus of a relaxation or the compliance of a creep test over time, a relaxation_curve: time [s] (or t);
/// relaxation_modulus [Pa] or creep_compliance [1/Pa], G or E as their names say (relaxation_shear_modulus or G(t),
/// relaxation_young_modulus or E(t), shear_creep_compliance or J(t), tensile_creep_compliance or D(t)) or the key;
/// note.
///
/// Likewise the table of a strain sweep at one frequency and temperature: {"strain_sweep_file": "sweep.csv"}, with the
/// columns strain [1] or [%], in rising order, and moduli as above; of the moduli only ratios to the first row count.
///
/// And a table of shifts with temperature: {"shift_table_file": "shift.csv"}, with the columns temperature [K] or
/// [degC], a_T or log10_a_T [1], b_T [1] (core/material/material_scale.hpp says which way they count), one of a_T and
/// b_T at least, and note.
///
/// And the profile of a roller along its axle: {"indenter": "profile", "profile_file": "tread.csv"}, with the columns
/// y [m], rising, height [m] counted from the smallest, and note.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/material_inputs.hpp"
#include "core/scene/quantity.hpp"
#include "studies/text/measured_table.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// The key of a scene file; its place is taken by the inputs that the table gives.
inline constexpr std::string_view master_curve_key = "master_curve_file";
inline constexpr std::string_view strain_sweep_key = "strain_sweep_file";
inline constexpr std::string_view shift_table_key = "shift_table_file";
inline constexpr std::string_view profile_key = "profile_file";
inline constexpr std::array<std::string_view, 4> table_keys{master_curve_key, strain_sweep_key, shift_table_key,
                                                            profile_key};
inline constexpr std::string_view ignored_columns_key = "ignore_columns";
inline constexpr std::array<std::string_view, 3> master_curve_inputs{"frequencies", "storage_moduli", "loss_moduli"};
inline constexpr std::array<std::string_view, 2> relaxation_inputs{"relaxation_times", "relaxation_moduli"};
inline constexpr std::array<std::string_view, 3> strain_sweep_inputs{"sweep_strains", "sweep_storage_moduli",
                                                                     "sweep_loss_moduli"};

inline constexpr std::array<std::string_view, 3> shift_table_inputs{"shift_temperatures", "shift_factors",
                                                                    "modulus_shifts"};
inline constexpr std::array<std::string_view, 2> profile_inputs{"profile_places", "profile_heights"};
inline constexpr std::array<std::string_view, 5> shift_columns{"temperature", "a_T", "log10_a_T", "b_T", "note"};

/// Frequencies that a table may have, measured or shifted [Hz].
inline constexpr Range frequency_range{.lowest = 1e-30, .highest = 1e30};

/// The frequencies of a table's rows [Hz], from its column "frequency" or "angular_frequency".
/// @throws std::invalid_argument naming file, line, column, value and rule
std::vector<double> measured_frequencies(const MeasuredTable& table);

inline constexpr std::array<std::string_view, 7> modulus_columns{
    "frequency", "angular_frequency", "storage_modulus", "loss_modulus", "loss_tangent", "tan_delta", "note"};

inline constexpr std::string_view listed_moduli_key = "listed_moduli";

/// Gives columns of moduli the names without G or E ("storage_modulus" for "E'"), and puts storage and loss in place of
/// a complex modulus with its angle. What their names said; nothing if all were without.
/// @throws std::invalid_argument if they say both, or if one modulus has two columns
std::optional<ListedModuli> take_modulus_names(MeasuredTable& table);

/// Whether the moduli of a table are G or E: what the names of its columns said, or the key beside the table's name.
/// @param column  the name of one of them, without G or E   @param place  of the key
/// @throws std::invalid_argument if neither says it, or if they differ
ListedModuli said_moduli(std::optional<ListedModuli> by_names, std::optional<ListedModuli> by_key,
                         const std::string& file, std::string_view column, const std::string& place);

/// "listed_moduli is missing: ...", with both choices. @param what  the moduli
std::string unsaid_moduli(const std::string& what, std::string_view column = "storage_modulus");

/// The moduli of a table's rows [Pa].
struct MeasuredModuli {
  std::vector<double> storage, loss;
};
/// @param loss_range, rule  of the loss modulus and of the loss tangent
/// @throws std::invalid_argument naming file, line, column, value and rule
MeasuredModuli measured_moduli(const MeasuredTable& table, const Range& loss_range, const std::string& rule = {});

inline constexpr std::array<std::string_view, 4> relaxation_columns{"time", "relaxation_modulus", "creep_compliance",
                                                                    "note"};

/// The lists of a table under the keys of inputs, in SI, rows in the order of the file; listed_moduli, if the names of
/// the columns say it; and the material, where it is a relaxation_curve.
/// @throws std::invalid_argument naming file, line, column, value and rule
/// @param ignored  columns that are left out
/// @throws std::runtime_error if the file cannot be read
Json read_master_curve(const std::filesystem::path& file, const std::vector<std::string>& ignored = {});

Json read_strain_sweep(const std::filesystem::path& file, const std::vector<std::string>& ignored = {});

/// a_T of a table's rows, from its column "a_T" or "log10_a_T".
/// @throws std::invalid_argument naming file, line, column, value and rule
std::vector<double> measured_shift_factors(const MeasuredTable& table);

Json read_shift_table(const std::filesystem::path& file, const std::vector<std::string>& ignored = {});

Json read_profile(const std::filesystem::path& file, const std::vector<std::string>& ignored = {});

/// What of a scene names tables: its own layer's inputs, then the objects of further layers.
struct TablePart {
  Json* object;
  std::string prefix;  ///< of its keys: "coating_layers[0]."
};
std::vector<TablePart> parts_with_tables(Json& scene);
bool names_tables(const Json& scene);
/// "master_curve_file" of an input that a table gives: the key that names the table.
std::string table_key_of(std::string_view input);

/// A scene or a part of one with the lists in place of the files' names, in further layers too; without such a key it
/// is left as it is.
/// @param folder that the name is relative to   @param place in messages
Json with_master_curve(const Json& object, const std::filesystem::path& folder, const std::string& place);

}  // namespace rollres
