#pragma once

/// Fits inputs of a scene, material parameters above all, to measured rolling resistances (or to another output).

#include <optional>
#include <string>
#include <vector>

#include "core/rolling_contact.hpp"
#include "fitting/fit_problem.hpp"

namespace rollres {

/// One measured value and the scene it belongs to.
struct MeasuredScene {
  RollingScene scene;
  Measurement measured;
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

/// The problem of least squares. Slopes are differences whose steps suit the noise of the output, which is measured
/// once for each input, on three of its scenes at the first point with slopes (core/calibration.hpp), and taken to be
/// proportional to the output; no scene outside the bounds is evaluated (core/gradient.hpp).
/// @param evaluate  called by several threads at once
/// @throws std::invalid_argument naming key, value and rule
FitProblem resistance_problem(const std::vector<MeasuredScene>& scenes, const std::vector<FittedInput>& inputs,
                              Evaluate evaluate, const ResistanceFitOptions& options = {});

/// The scene with the inputs of a point that belong to its data set.
RollingScene scene_with(const RollingScene& scene, const std::string& set, const std::vector<FittedInput>& inputs,
                        const FitPoint& point);

}  // namespace rollres
