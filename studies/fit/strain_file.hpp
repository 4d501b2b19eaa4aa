#pragma once

/// Files of fits of Kraus's model to a strain sweep.
///
///     {"fit": "softening of a rubber", "material": "kraus", "data": "sweep.csv", "sweep_deformation": "tension",
///      "sigma": "2 %"}
///
/// Columns of the table: strain [1] or [%], two of storage_modulus, loss_modulus and loss_tangent (tan_delta), in any
/// order of rows; frequency, angular_frequency and temperature, of one value each; note. Others are left out with a
/// note, unless they resemble one of these. `sweep_deformation` and `sweep_amplitude` as in scenes. `sigma`: relative
/// deviation of all moduli, or one of each. `ignore_columns`, `scene`, starts, seed, comment as in other fits of
/// materials; strains in tension are turned into shear by the scene's Poisson's ratio, or 1/2.

#include <filesystem>
#include <vector>

#include "fitting/material/strain_fit.hpp"
#include "studies/fit/material_file.hpp"

namespace rollres {

struct StrainFile : AloneFit {
  std::vector<MeasuredStrain> data = {};
  bool deviations_known = false;
  FitOptions options = {};
};

/// @throws std::invalid_argument one line naming file, line of the table or key, value and rule
/// @throws std::runtime_error if a file cannot be read
StrainFile read_strain_fit(const std::filesystem::path& file);

}  // namespace rollres
