#pragma once

/// Which speed, and which load, to measure next.

#include "fitting/fit/experiment_design.hpp"
#include "studies/fit/fit_file.hpp"

namespace rollres {

/// How many choices of a list are shown.
inline constexpr std::size_t best_shown = 5;

/// The best next measurements: speeds from a tenth of the slowest to ten times the fastest for each set of the other
/// inputs, then loads from a third to three times at the best speed.
struct FitDesign {
  MeasurementPlan speeds, loads;  ///< loads: without choices where the scenes give no load
};

FitDesign design_of(const FitFile& file, const FitReport& report, const Evaluate& evaluate, int jobs);

std::string design_summary(const FitDesign& design, const FitFile& file, const FitReport& report);

}  // namespace rollres
