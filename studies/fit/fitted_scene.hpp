#pragma once

/// What was fitted, as a scene file that another command takes: inputs in SI with all digits.

#include <string>

#include "studies/fit/fit_file.hpp"
#include "studies/fit/material_file.hpp"
#include "studies/fit/shift_file.hpp"
#include "studies/fit/strain_file.hpp"

namespace rollres {

/// The inputs of the material, with its shift; in the fit file's `scene`, where it has one, in place of that scene's
/// material. Without it they are a part of a scene only: the layer, the body and the motion are missing.
/// A series without a modulus at rest lacks static_shear_modulus: no layer of it bears a load for ever.
std::string fitted_scene(const MaterialFit& fit, const MaterialFile& file);

/// The reference temperature and the constants of a shift, in the fit file's `scene` where it has one.
std::string fitted_scene(const ShiftFit& fit, const ShiftFile& file);

/// Kraus's parameters, in the fit file's `scene` where it has one, in place of a strain sweep there.
std::string fitted_scene(const StrainFit& fit, const StrainFile& file);

/// The scene of the first measurement with the fitted values.
std::string fitted_scene(const FitReport& report, const FitFile& file);

/// Writes one of these.
/// @throws std::runtime_error naming the file
void write_scene(const std::filesystem::path& file, const std::string& scene);

}  // namespace rollres
