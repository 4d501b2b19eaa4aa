#pragma once

/// Gradients of an objective by finite differences whose steps suit its noise.
///
///     const Objective f = objective(scene, {{"load"}, {"speed"}}, "rolling_resistance", solve);
///     const std::vector<double> x = base_point(f);
///     const Calibration calibration = calibrate(f, x);      // once: 8 to 40 evaluations for each input
///     const Gradient there = gradient(f, x, calibration);   // often: 1, 2 or 4 evaluations for each input
///
/// The calibration holds the noise sigma and bounds of f'' to f^(5); scheme and step are those with the smallest error
/// by them (formula.hpp). For two central points that is h = (3 sigma / |f'''|)^(1/3), the counterpart of the forward
/// difference of Moré and Wild (2012, ACM Trans. Math. Softw. 38, 19). What the solutions themselves err by is no
/// noise where it changes smoothly with the input: it is counted apart, as `solution_error`.

#include <span>
#include <string_view>
#include <vector>

#include "core/derivatives/calibration.hpp"
#include "core/derivatives/formula.hpp"
#include "core/derivatives/objective.hpp"

namespace rollres {

struct GradientOptions {
  int order = 4;  ///< of the truncation error in the step: 1 (one evaluation for each input), 2 (two) or 4 (four)
  int jobs = 1;   ///< threads, each with an input of its own; 0: one for each core
};

/// The derivative by one input; without a formula whose points all have values its scheme is none and it is NaN.
struct InputGradient {
  double derivative = RollingSolution::absent;        ///< d output / d input [SI]
  double elasticity = RollingSolution::absent;        ///< d ln output / d ln input [1]; NaN where one of them is 0
  double truncation_error = RollingSolution::absent;  ///< of the derivative [SI]
  double noise_error = RollingSolution::absent;       ///< of the derivative [SI]: three standard deviations
  double solution_error = RollingSolution::absent;    ///< of the derivative [SI]: by the error of the solutions
  double step = RollingSolution::absent;              ///< distance of neighbouring points in the scaled variable [1]
  Scheme scheme = Scheme::none;
  int evaluations = 0;
  std::vector<FailedPoint> failures = {};

  double error() const { return truncation_error + noise_error + solution_error; }
};

struct Gradient {
  std::vector<double> point;  ///< [SI]
  ObjectiveValue centre;
  std::vector<InputGradient> inputs;

  bool complete() const;    ///< every derivative is there
  int evaluations() const;  ///< beside the centre
};

/// The gradient at a point, which may be another than that of the calibration. No point outside the bounds is ever
/// evaluated; near a bound, and beside points without a value, the formula is one-sided or its step smaller. The centre
/// is evaluated once, or not at all if it is that of the calibration.
/// @throws std::invalid_argument if the point is outside the bounds, or the order is not 1, 2 or 4
Gradient gradient(const Objective& objective, std::span<const double> point, const Calibration& calibration,
                  const GradientOptions& options = {});

}  // namespace rollres
