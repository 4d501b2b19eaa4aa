#pragma once

/// Study files of an optimisation:
///
///     {"study": "quiet layer", "scene": "paper_cylinder.json", "set": {"tolerance": 1e-8},
///      "variables": {"layer_thickness": {"from": "1 mm", "to": "20 mm", "scale": "logarithmic"},
///                    "static_shear_modulus": {"from": "0.5 MPa", "to": "30 MPa", "start": "3 MPa"}},
///      "minimise": "rolling_resistance",
///      "constraints": ["peak_pressure <= 4 MPa", "approach / layer_thickness <= 0.15"]}
///
/// "study", "scene", "set", "comment" are those of a study (study.hpp). A variable has bounds "from" and "to", "scale"
/// linear or logarithmic (the default where both bounds are positive) and "start" (default: the scene's value if it is
/// between the bounds, else their middle). A variable that is a list is chosen from it, and so is a variant
/// (study_variants.hpp): every combination of such choices is a problem of its own (design_choices.hpp).
///
///     "variables": {"variant": {"soft": {"static_shear_modulus": "1 MPa"}, "hard": {"static_shear_modulus": "4 MPa"}},
///                   "radius": ["20 mm", "25 mm"], "layer_thickness": {"from": "1 mm", "to": "20 mm"}}
///
/// "minimise" or "maximise" is a formula (formula.hpp), and so are the sides of
/// the constraints. What may be added:
///
///     "scenes": [{"set": {"speed": "1 m/s"}, "weight": 0.3}, {"set": {"speed": "5 m/s"}, "weight": 0.7}],
///     "over_scenes": "sum", "mean", "max" or "min",  how the values of the scenes become one; sum, the default, and
///     mean
///                                                    are weighted, max and min are what they are in one scene
///     "algorithm": "cobyla", "global": true,         default: chosen from the problem (optimise.hpp)
///     "stop": {"evaluations": 200, "tolerance": 1e-4},
///     "pareto": {"minimise" or "maximise": FORMULA, "points": 9},
///     "uncertain": {...}                             inputs that scatter (uncertain_inputs.hpp), at 64 points unless
///     it
///                                                    says otherwise; a variable scatters by shares about its value
///
/// A goal may also be an object, and so may a constraint:
///
///     "minimise": {"formula": "rolling_resistance", "over": "max", "scatter": "mean + 2 sd"},
///     "constraints": [{"condition": "peak_pressure <= 4 MPa", "over": "mean", "scatter": "P95"}]
///
/// "scatter" says what of the scatter is meant (scatter_measure.hpp); a goal's default is the mean. A constraint with
/// "over" or "scatter" has a number on its right side.

#include <filesystem>

#include "studies/optimise/design.hpp"

namespace rollres {

/// Reads the file and checks the scenes at the start: one problem for each combination of what is chosen from lists.
/// @throws std::invalid_argument one line naming file, key, value and the rule that is broken
/// @throws std::runtime_error if the study file or its scene file cannot be read
std::vector<DesignProblem> read_design_problems(const std::filesystem::path& file);

/// The same of a file from which nothing is chosen. @throws std::invalid_argument if something is
DesignProblem read_design_problem(const std::filesystem::path& file);

/// The same for the text of a file, as a database keeps it.
/// @param file  for messages, and where the name of a scene file is relative to
std::vector<DesignProblem> parse_design_problems(const std::string& text, const std::filesystem::path& file);

}  // namespace rollres
