#pragma once

/// Files of fits of materials to measured storage and loss moduli.
///
///     {"fit": "rubber", "material": "prony", "data": "master_curve.csv", "terms": "auto", "shift": "wlf",
///      "reference_temperature": "293.15 K", "sigma": "2 %"}
///
/// Columns of the table: frequency [Hz] or angular_frequency [rad/s], storage_modulus, loss_modulus, and where there
/// are several, temperature [K] or [degC]; note. `modulus`: "shear" (default), or "young" for E' and E", divided by 3
/// (incompressible). `sigma`: one relative deviation; without it all residuals weigh the same relative to their values.
/// `shift`: "none" (default), "wlf" or "arrhenius". `terms`: a number, or "auto". Also starts, seed, comment.

#include <filesystem>
#include <string>
#include <vector>

#include "fitting/fit/material_fit.hpp"

namespace rollres {

struct MaterialFile {
  std::string name, definition, data_digest;
  std::vector<MeasuredModulus> data;
  MaterialFitOptions options;
};

/// Whether a fit's file is one of these: it has a key "material".
bool is_material_fit(const std::filesystem::path& file);

/// @throws std::invalid_argument one line naming file, line of the table or key, value and rule
/// @throws std::runtime_error if a file cannot be read
MaterialFile read_material_fit(const std::filesystem::path& file);

}  // namespace rollres
