#pragma once

/// What each measured value of a fit was measured at, as rows of the store.

#include <vector>

#include "db/rows/fit_store.hpp"
#include "studies/fit/fit_file.hpp"
#include "studies/fit/material_file.hpp"
#include "studies/fit/shift_file.hpp"
#include "studies/fit/strain_file.hpp"

namespace rollres {

/// The inputs that are columns of the tables and real numbers; of moduli the angular frequency, too.
std::vector<FitInputRecord> measured_inputs(const FitFile& file);
/// Frequency and temperature; each row has a storage and a loss modulus.
std::vector<FitInputRecord> measured_inputs(const MaterialFile& file);
std::vector<FitInputRecord> measured_inputs(const ShiftFile& file);
/// The amplitude of the shear strain; each row has a storage and a loss modulus.
std::vector<FitInputRecord> measured_inputs(const StrainFile& file);

}  // namespace rollres
