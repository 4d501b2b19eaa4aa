#pragma once

/// Where the fit of a Zener material begins if nobody says it.

#include <string_view>
#include <vector>

#include "fitting/fit/resistance_fit.hpp"

namespace rollres {

/// Whether an input can start from closed forms: static_shear_modulus, stiffening, creep_time.
bool has_closed_form_start(std::string_view key);

/// A value of such an input that a scene can hold until its start is found [SI].
double closed_form_placeholder(std::string_view key);

/// Rolling resistance without friction to within a factor of about 2 in a microsecond: c tan(delta) (a/R) P with the
/// half-width a that Hertz, or the thin layer if that is smaller, has at the modulus |G*(V/a)|, and the c of a small
/// constant loss angle (reference_solutions.hpp). @return [N/m] or [N]
double estimated_resistance(const RollingScene& scene);

/// The inputs with starts: those of the list above that have none get the one with which estimated_resistance fits the
/// measured values best, the stiffening 2. Other outputs than the rolling resistance and moduli, and scenes without a
/// load, say nothing.
std::vector<FittedInput> with_closed_form_starts(const std::vector<MeasuredScene>& scenes,
                                                 std::vector<FittedInput> inputs, std::string_view output);

/// Gives a problem what closed forms know of it: rough predictions, and the material that they fit best as a place to
/// start from; rough predictions only where they are of all data. Nothing where a scene has more than one layer.
/// @param problem  resistance_problem of these scenes and inputs
void add_closed_forms(FitProblem& problem, const std::vector<MeasuredScene>& scenes,
                      const std::vector<FittedInput>& inputs, std::string_view output);

}  // namespace rollres
