#pragma once

/// Files of fits of materials to measured storage and loss moduli.
///
///     {"fit": "rubber", "material": "prony", "data": "master_curve.csv", "terms": "auto", "shift": "wlf",
///      "reference_temperature": "293.15 K", "sigma": "2 %"}
///
/// Columns of the table: those of a master curve (master_curve_file.hpp), and where there are several, temperature [K]
/// or [degC]. Others are left out, with a note, unless they resemble one of these; `ignore_columns` lists columns that
/// are left out. `modulus`: "shear" (default), or "young" for E' and E", divided by 3 (incompressible). `sigma`: a
/// relative deviation of all moduli, or {"storage_modulus": "1 %", "loss_modulus": "3 %"}; without it all residuals
/// weigh the same relative to their values. `shift`: "none" (default), "wlf", "arrhenius", "vft", or "free": a factor
/// for each temperature of the table, with `vertical_shift` "auto", "free" or "none" for b_T. `terms`: a number, or
/// "auto"; `times`: "even" or "free". `scene`: a scene or the name of its file, in which the fitted material is
/// written. Also starts, seed, comment.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "fitting/material/material_fit.hpp"

namespace rollres {

struct FileKey;

/// What the files of all fits without scenes say.
struct AloneFit {
  std::string name, definition, data_digest = {};
  std::vector<std::string> notes = {};  ///< what was understood of the table, columns that were left out
  std::string scene = {};               ///< JSON object that what is fitted is to stand in; empty: none
};

struct MaterialFile : AloneFit {
  std::vector<MeasuredModulus> data = {};
  MaterialFitOptions options = {};
};

/// The name and the text of such a file, and its starts and seed.
/// @throws std::invalid_argument naming place, key, value and rule
AloneFit given_name(const nlohmann::ordered_json& object, std::span<const FileKey> keys, const std::string& place);
FitOptions given_descents(const nlohmann::ordered_json& object, const std::string& place);

/// The note on columns of its data that are left out, where there are some.
void note_left_out(AloneFit& fit, const nlohmann::ordered_json& object, const std::vector<std::string>& columns);

/// What stands under "reference_temperature" [K], or 20 degC; and the object of the scene under "scene", or nothing.
/// @throws std::invalid_argument naming place, key, value and rule
double given_reference_temperature(const nlohmann::ordered_json& object, const std::string& place);
std::string given_scene(const nlohmann::ordered_json& object, const std::filesystem::path& file,
                        const std::string& place);

/// A relative deviation > 0, given as a percentage. @throws std::invalid_argument naming place, key, value and rule
double relative_sigma(const nlohmann::ordered_json& value, const std::string& key, const std::string& place,
                      const char* rule);

/// Relative deviations of storage and loss moduli, 1 if none are given; what stands under "sigma".
struct ModulusSigmas {
  bool known = false;
  double storage = 1, loss = 1;
};
/// @throws std::invalid_argument naming place, key, value and rule
ModulusSigmas given_modulus_sigmas(const nlohmann::ordered_json& object, const std::string& place);

/// What is fitted: to outputs of scenes, or what the key "material" says.
enum class FitKind { resistance, material, shift, strain };
FitKind kind_of_fit(const std::filesystem::path& file);

/// @throws std::invalid_argument one line naming file, line of the table or key, value and rule
/// @throws std::runtime_error if a file cannot be read
MaterialFile read_material_fit(const std::filesystem::path& file);

}  // namespace rollres
