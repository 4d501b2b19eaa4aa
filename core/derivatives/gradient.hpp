#pragma once

/// Gradients of an objective by finite differences whose steps suit its noise.
///
///     const Objective f = objective(scene, {{"load"}, {"speed"}}, "rolling_resistance", solve);
///     const std::vector<double> x = base_point(f);
///     const Calibration calibration = calibrate(f, x);      // once: 8 or 14 evaluations for each input
///     const Gradient there = gradient(f, x, calibration);   // often: 1, 2 or 4 evaluations for each input
///
/// A formula with weights w_j at the scaled offsets o_j errs by the noise, of deviation sigma |w|, and by truncation,
/// at most sum_k |sum_j w_j o_j^k| |f^(k)| / k!. The calibration holds sigma and bounds of f'' to f^(5);
/// scheme and step are those with the smallest sum. For two central points that is h = (3 sigma / |f'''|)^(1/3), the
/// counterpart of the forward difference of Moré and Wild (2012, ACM Trans. Math. Softw. 38, 19).

#include <span>
#include <string_view>
#include <vector>

#include "core/derivatives/calibration.hpp"
#include "core/derivatives/objective.hpp"

namespace rollres {

/// Where the points of a formula lie; those of `forward` and `backward` begin in the centre.
enum class Scheme { central, forward, backward, none };
template <>
struct ChoiceNames<Scheme> {
  static constexpr std::array<std::string_view, 4> names{"central", "forward", "backward", "none"};
};

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
  double step = RollingSolution::absent;              ///< distance of neighbouring points, scaled [1]
  Scheme scheme = Scheme::none;
  int evaluations = 0;
  std::vector<FailedPoint> failures = {};

  double error() const { return truncation_error + noise_error; }
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
