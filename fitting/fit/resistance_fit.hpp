#pragma once

/// Fits inputs of a scene, material parameters above all, to measured rolling resistances (or to another output).

#include <optional>
#include <string>
#include <vector>

#include "core/solve/rolling_contact.hpp"
#include "fitting/descent/fit_problem.hpp"

namespace rollres {

/// One measured value and the scene it belongs to.
struct MeasuredScene {
  RollingScene scene;
  MeasuredValue measured;
  std::string set = {};  ///< data set
};

/// An input that is fitted: one value for all scenes, or for those of one data set.
struct FittedInput {
  InputChoice input;
  std::optional<double> start = {};  ///< [SI]; default: the value in the first scene
  std::string set = {};              ///< empty: all
};

struct ResistanceFitOptions {
  std::string output = "rolling_resistance";
  int jobs = 0;                     ///< threads; 0: one for each core
  std::optional<double> step = {};  ///< scaled; forced in place of those that suit the noise
};

/// The inputs as parameters, with bounds, scale and start.
/// @throws std::invalid_argument naming key, value and rule
std::vector<FitParameter> fit_parameters(const std::vector<MeasuredScene>& scenes,
                                         const std::vector<FittedInput>& inputs);

/// The problem of least squares. Slopes are differences whose steps suit the noise of the output, which is measured
/// once for each input at the first point with slopes, on one of its scenes, or where that is not smooth on three
/// (core/derivatives/calibration.hpp), and taken to be proportional to the output. Where it is all but rounding,
/// differences are to one side. No scene outside the bounds is evaluated (core/derivatives/gradient.hpp).
/// @param parameters  fit_parameters(scenes, inputs), or those of a fit to other scenes
/// @param evaluate    called by several threads at once
/// @throws std::invalid_argument naming key, value and rule
FitProblem resistance_problem(const std::vector<MeasuredScene>& scenes, const std::vector<FittedInput>& inputs,
                              const std::vector<FitParameter>& parameters, const Evaluate& evaluate,
                              const ResistanceFitOptions& options = {});

/// The same with parameters from these scenes.
inline FitProblem resistance_problem(const std::vector<MeasuredScene>& scenes, const std::vector<FittedInput>& inputs,
                                     const Evaluate& evaluate, const ResistanceFitOptions& options = {}) {
  return resistance_problem(scenes, inputs, fit_parameters(scenes, inputs), evaluate, options);
}

}  // namespace rollres
