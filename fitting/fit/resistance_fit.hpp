#pragma once

/// Fits inputs of a scene, material parameters above all, to measured rolling resistances (or to another output).

#include <optional>
#include <string>
#include <vector>

#include "core/solve/rolling_contact.hpp"
#include "fitting/descent/fit_problem.hpp"
#include "fitting/fit/measured_terms.hpp"

namespace rollres {

/// One measured value and the scene it belongs to.
struct MeasuredScene {
  RollingScene scene;
  MeasuredValue measured;
  std::string set = {};  ///< data set
  /// Output that is measured; empty: that of the fit. Or what the scene's material does: `storage_modulus_key` or
  /// `loss_modulus_key`, at an angular frequency [rad/s], `relaxation_modulus_key` or `creep_compliance_key` at a time
  /// [s] after the step.
  std::string output = {};
  double angular_frequency = RollingSolution::absent, time = RollingSolution::absent;
  ListedModuli listed_moduli = ListedModuli::shear;  ///< whether such a value is of G or of E = 2 (1 + nu) G
};

inline constexpr std::string_view storage_modulus_key = "storage_modulus", loss_modulus_key = "loss_modulus";
inline constexpr std::string_view relaxation_modulus_key = "relaxation_modulus",
                                  creep_compliance_key = "creep_compliance";
/// A curve over time.
inline bool is_curve(std::string_view output) {
  return output == relaxation_modulus_key || output == creep_compliance_key;
}
inline bool is_of_material(std::string_view output) {
  return output == storage_modulus_key || output == loss_modulus_key || is_curve(output);
}

/// What is measured, as a quantity. @throws std::invalid_argument if there is no such output that is a real number
Quantity measured_quantity(std::string_view output);

/// An input that is fitted: one value for all scenes, or for those of one data set. Its key may also be that of an
/// offset or a scale of the measured values (measured_terms.hpp).
struct FittedInput {
  InputChoice input;
  std::optional<double> start = {};  ///< [SI]; default: the value in the first scene, 0 for an offset, 1 for a scale
  std::string set = {};              ///< empty: all
  std::optional<Prior> prior = {};
  std::optional<double> smooth = {};  ///< standard deviation of its logarithm from that of the input before it [1]
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

/// The problem of least squares; a prior is one datum more, behind those of the scenes. Slopes are differences whose
/// steps suit the noise of the output, which is measured once for each input at the first point with slopes, on one of
/// its scenes, or where that is not smooth on three (core/derivatives/calibration.hpp), and taken to be proportional to
/// the output. Where it is all but rounding, differences are to one side. No scene outside the bounds is evaluated
/// (core/derivatives/gradient.hpp).
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
