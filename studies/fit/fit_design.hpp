#pragma once

/// What to measure next.

#include <string>
#include <vector>

#include "fitting/fit/experiment_design.hpp"
#include "studies/fit/fit_file.hpp"

namespace rollres {

/// How many choices of a list are shown.
inline constexpr std::size_t best_shown = 5;

/// How many measurements are named together.
inline constexpr std::size_t named_together = 3;

/// The best next measurements: speeds from a tenth of the slowest to ten times the fastest for each set of the other
/// inputs, then loads from a third to three times at the best speed; and anywhere, over these ranges and those of all
/// other inputs that vary, at once: a Latin hypercube, then ever smaller ones around the best so far.
struct FitDesign {
  MeasurementPlan speeds, loads, anywhere;  ///< loads: without choices where the scenes give no load
  std::vector<std::string> inputs = {};     ///< that vary in `anywhere`
  JointChoice together = {};                ///< of `anywhere`
};

FitDesign design_of(const FitFile& file, const FitReport& report, const Evaluate& evaluate, int jobs);

std::string design_summary(const FitDesign& design, const FitFile& file, const FitReport& report);

}  // namespace rollres
