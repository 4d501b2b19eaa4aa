#pragma once

/// The fitted curves between the measured values of a resistance fit.

#include "studies/fit/fit_chart.hpp"
#include "studies/fit/fit_file.hpp"

namespace rollres {

/// Output against the speed (or, where that does not vary, the first input that does), one curve for each combination
/// of the other inputs, with its 95 % band. @param evaluate called by several threads at once
FitCurves fit_curves(const FitFile& file, const FitReport& report, const Evaluate& evaluate, int jobs);

}  // namespace rollres
