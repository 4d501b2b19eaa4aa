#pragma once

/// Files of fits of a shift law to a table of shift factors.
///
///     {"fit": "shift of a rubber", "material": "shift", "shift": "wlf", "data": "shift.csv",
///      "reference_temperature": "20 degC", "sigma": "5 %"}
///
/// Columns of the table: temperature [K] or [degC], a_T [1] or log10_a_T [1], note. Others, b_T among them, are left
/// out with a note, unless they resemble one of these. `shift`: "wlf" (default), "arrhenius" or "vft".
/// `reference_temperature`: default that of the row whose factor is nearest to 1. `sigma`: relative deviation of a_T.
/// `ignore_columns`, `scene`, starts, seed, comment as in other fits of materials.

#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

#include "fitting/material/shift_fit.hpp"
#include "studies/fit/material_file.hpp"

namespace rollres {

struct ShiftFile : AloneFit {
  std::vector<MeasuredShift> data = {};
  std::optional<double> relative_to = std::nullopt;  ///< temperature of the row that was 1 [K], which is no datum
  TemperatureShift law = {};
  double deviation = std::numeric_limits<double>::quiet_NaN();
  FitOptions options = {};
};

/// @throws std::invalid_argument one line naming file, line of the table or key, value and rule
/// @throws std::runtime_error if a file cannot be read
ShiftFile read_shift_fit(const std::filesystem::path& file);

}  // namespace rollres
