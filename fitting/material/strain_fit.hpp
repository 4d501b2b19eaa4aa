#pragma once

/// Fits Kraus's model of moduli that depend on the strain (core/material/strain_softening.hpp) to a strain sweep:
/// storage and loss moduli at small strains, payne_drop, payne_strain, payne_exponent and payne_loss_peak.

#include <string>
#include <vector>

#include "core/scene/material_inputs.hpp"
#include "fitting/fit/fit.hpp"

namespace rollres {

/// Moduli at one amplitude, all at one frequency and temperature, in shear or in tension.
struct MeasuredStrain {
  double amplitude;          ///< of the shear strain [1], > 0
  double storage, loss;      ///< [Pa], > 0
  double storage_deviation;  ///< [Pa]; where none is known, what residuals are measured in
  double loss_deviation;     ///< [Pa]
  std::string place = {};
};

/// Moduli of the fitted model at an amplitude with their standard errors, NaN if those are not known [Pa].
struct SweepModuli {
  double storage, loss, storage_error, loss_error;
};

struct StrainFit {
  FitReport report;           ///< its values: storage and loss in turn
  MaterialInputs layer = {};  ///< its payne_ inputs are those found
  SweepModuli moduli(double amplitude) const;
};

/// @param deviations_known  whether those of the data are; else found from the scatter
/// @throws std::invalid_argument if there are fewer than four strains, or not more data than parameters
StrainFit fit_strain_sweep(const std::vector<MeasuredStrain>& data, bool deviations_known,
                           const FitOptions& options = {});

}  // namespace rollres
