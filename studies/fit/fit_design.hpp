#pragma once

/// What to measure next. For sources only: it needs nlohmann_json.

#include <string>
#include <vector>

#include "fitting/fit/experiment_design.hpp"
#include "studies/fit/fit_file.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// How many choices of a list are shown.
inline constexpr std::size_t best_shown = 5;

/// The best next measurements for the aims of the file: its targets, or the parameters. Speeds from a tenth of the
/// slowest to ten times the fastest for each set of the other inputs, then loads from a third to three times at the
/// best speed; and anywhere in the design space (design_space.hpp), all inputs at once.
struct FitDesign {
  MeasurementPlan speeds, loads, anywhere;  ///< loads: without choices where the scenes give no load
  std::vector<std::string> inputs = {};     ///< that vary in `anywhere`
  std::vector<std::size_t> best = {};       ///< places in it of the best choices that lie apart
  std::vector<JointChoice> together = {};   ///< of `anywhere`: the best one, two, ... measurements
};

FitDesign design_of(const FitFile& file, const FitReport& report, const Evaluate& evaluate, int jobs);

std::string design_summary(const FitDesign& design, const FitFile& file);

Json json_of(const FitDesign& design);

}  // namespace rollres
