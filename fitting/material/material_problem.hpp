#pragma once

/// What all fits of materials to moduli share: parameters, the shift with temperature, the problem, the answer.

#include <complex>
#include <functional>
#include <vector>

#include "core/material/master_curve.hpp"
#include "fitting/material/material_fit.hpp"

namespace rollres {

inline constexpr Quantity modulus_at_rest{"static_shear_modulus", "G0", "Pa", "G'(0)", positive};

/// A parameter within its quantity's range; logarithmic where that begins at 0.
FitParameter parameter(const Quantity& quantity, double start, std::string name = {});

/// The place of the temperature that is nearest to one.
std::size_t nearest_step(const std::vector<double>& temperatures, double temperature);

/// The constants of a shift, which start at its own, or where those are 0 at usual ones.
/// @param free  of a table: log10 a_T of each temperature but the one nearest to the reference, where it is 0, then
/// log10 b_T likewise if the table has them
std::vector<FitParameter> shift_parameters(const TemperatureShift& shift, bool free = false);

/// The shift whose constants are the last values of a point.
TemperatureShift shift_at(TemperatureShift shift, const FitPoint& point, bool free = false);

/// G* of the first values of a point [Pa].
using ModulusAt = std::function<std::complex<double>(const FitPoint&, double reduced_frequency)>;

/// Lets a problem be answered by closed forms, and by their differences.
/// @param values  at a point; may throw std::invalid_argument, why there are none
/// @param least_size  of a value, for its rounding
void answer_by(FitProblem& problem, std::function<Eigen::VectorXd(const FitPoint&)> values, double least_size);

/// The problem of a material, divided by the b_T of the shift if it has them, of the first parameters and a shift of
/// the last, which are added here.
FitProblem material_problem(const std::vector<MeasuredModulus>& data, std::vector<FitParameter> parameters,
                            const MaterialFitOptions& options, const ModulusAt& modulus);

/// What a report says of the modulus.
MaterialFit material_answer(FitReport report, const MaterialFitOptions& options, const ModulusAt& modulus);

/// The fit of that problem.
MaterialFit fitted_material(const std::vector<MeasuredModulus>& data, const std::vector<FitParameter>& parameters,
                            const MaterialFitOptions& options, const ModulusAt& modulus);

/// The data as a master curve at the reference temperature.
MasterCurve master_curve_of(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift);

/// Adds a warning, unless it is empty; what was usable is so with warnings.
void warn(FitReport& report, const std::string& warning);

}  // namespace rollres
