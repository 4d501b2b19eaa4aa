#pragma once

/// A fit as the rows of the database, from which alone it is told (stored_fit.hpp).

#include <vector>

#include "db/rows/fit_store.hpp"
#include "fitting/fit/fit_report.hpp"
#include "studies/fit/fit_curves.hpp"
#include "studies/fit/fit_file.hpp"
#include "studies/fit/material_file.hpp"
#include "studies/fit/shift_file.hpp"
#include "studies/fit/strain_file.hpp"

namespace rollres {

/// What each measured value was measured at: the inputs that are columns of the tables and real numbers; of moduli the
/// angular frequency, too.
std::vector<FitInputRecord> measured_inputs(const FitFile& file);
/// Frequency and temperature; each row has a storage and a loss modulus.
std::vector<FitInputRecord> measured_inputs(const MaterialFile& file);
std::vector<FitInputRecord> measured_inputs(const ShiftFile& file);
/// The amplitude of the shear strain; each row has a storage and a loss modulus.
std::vector<FitInputRecord> measured_inputs(const StrainFile& file);

/// What the file of a fit says, before anything is fitted: names, texts, units, inputs of the data, what is fixed.
FitRecord begun_fit(const FitFile& file);
FitRecord begun_fit(const MaterialFile& file);
FitRecord begun_fit(const ShiftFile& file);
FitRecord begun_fit(const StrainFile& file);

/// What a fit found, joined to what its file said. @param begun  of begun_fit   @param body  which decides units
FitRecord with_report(FitRecord begun, const FitReport& report, Body body);

/// The fit with its curves for pictures, where there are some.
FitRecord with_curves(FitRecord fit, const FitCurves& curves);

}  // namespace rollres
