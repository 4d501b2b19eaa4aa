#pragma once

/// Reads what is wanted of a study: "constraints", "compute", "chart" and "charts" of its file. For sources only: it
/// needs nlohmann_json.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "studies/study/study.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// Keys of the outputs that are numbers: what a chart can show.
std::vector<std::string_view> number_outputs();

/// What stands under "compute": a list of outputs and of objects {NAME: FORMULA}, or one such object. Before them the
/// columns of zips, numbers that go with inputs: {"zip": {"load": [5e3, 8e3]}, "columns": {"share": [0.7, 0.3]}} is the
/// formula of a number `share` that is 0.7 where load is 5e3, else 0.3.
struct ComputeWish {
  std::vector<std::string> columns;  ///< outputs and names of formulas, in their order
  FormulaDefinitions formulas;       ///< each may use those before it, which stand in it in full
};

/// @param place      the file
/// @param bodies  the bodies of the study, whose units must hold in every condition
/// @param formulas   names that the conditions may use
/// @throws std::invalid_argument naming place, condition and rule
std::vector<Condition> study_constraints(const Json& study, std::span<const Body> bodies,
                                         const FormulaDefinitions& formulas, const std::string& place);

/// Empty where the file says nothing.
/// @param bodies  as above: the terms of each formula must fit
/// @throws std::invalid_argument naming place, key, value and rule
ComputeWish compute_wish(const Json& study, std::span<const Body> bodies, const std::string& place);

/// The same of a file that was accepted once; what is not understood any more is left out.
ComputeWish accepted_compute_wish(const Json& study);

/// The charts under "chart" or "charts".
/// @param formulas  numbers that they may show, too
/// @throws std::invalid_argument naming place, key, value and rule
std::vector<StudyChart> study_charts(const Json& study, const std::vector<Axis>& axes,
                                     const FormulaDefinitions& formulas, const std::string& place);

}  // namespace rollres
