#pragma once

/// Slopes of a design problem's goal and constraints along the sides of the unit box, by the finite differences of
/// core/derivatives/gradient.hpp, whose steps suit the noise that is measured once.

#include <string>
#include <vector>

#include "core/derivatives/gradient.hpp"
#include "studies/optimise/design_evaluator.hpp"
#include "studies/optimise/design_scale.hpp"

namespace rollres {

/// The gradient of one scaled function (DesignScale) [1].
struct Slope {
  std::vector<double> along;   ///< d function / d place; 0 where no formula found values at all its points
  std::vector<double> errors;  ///< estimated
  std::string reason = {};     ///< why one is missing; empty if all are there
};

class DesignSlopes {
 public:
  /// Measures noise and bending at a design that has a value. The evaluator and the scale must outlive it.
  /// @throws what the evaluator throws
  DesignSlopes(DesignEvaluator& evaluator, const DesignScale& scale, const Design& design);

  Slope of_value(const Design& design) const;
  /// @param constraint  place in Design::constraints
  Slope of_constraint(const Design& design, std::size_t constraint) const;

 private:
  struct Function {
    Objective objective;
    Calibration calibration;
  };
  Slope slope(const Function& function, const Design& design) const;

  const DesignScale& scale_;
  int jobs_;
  std::vector<Function> functions_;  // of the value, then of the constraints
};

}  // namespace rollres
