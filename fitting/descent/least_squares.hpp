#pragma once

/// The least sum of losses of squared residuals within bounds, by Ceres, which is loaded when it is first asked: it and
/// what it links would take every start of the program 2 ms.

#include <cstddef>
#include <string>
#include <vector>

#include "fitting/descent/fit_problem.hpp"

namespace rollres {

/// What is asked of Ceres. A residual is in its standard deviation.
struct LeastSquares {
  struct Parameter {
    double start, lowest, highest;
    bool held = false;  ///< keeps its start
  };

  std::vector<Parameter> parameters;
  std::size_t residuals = 0;
  Loss loss = Loss::none;
  double loss_scale = 1;  ///< c [1]
  int most_iterations = 60;
  double tolerance = 1e-7;  ///< relative change of the sum
  double radius = 100;      ///< of the first step

  enum class Next { step, end, give_up };

  virtual ~LeastSquares() = default;
  /// Goes to a point before its residuals are asked.
  virtual void move_to(const double* parameters, bool with_slopes) = 0;
  /// At the point. @param slopes  by each parameter, or null @return whether there is one
  virtual bool residual(std::size_t row, double& value, double* slopes) const = 0;
  /// Whether a residual has the loss; else it counts by its square.
  virtual bool has_loss(std::size_t /*row*/) const { return true; }
  /// After the start (0) and each try of a step. @param sum  of losses where it is @param moved  whether the step was
  /// taken
  virtual Next after_iteration(int /*iteration*/, double /*sum*/, bool /*moved*/, const double* /*parameters*/) {
    return Next::step;
  }
};

struct LeastSquaresEnd {
  bool converged = false;
  std::string why;  ///< it ended, in Ceres's words
  int iterations = 0;
  std::vector<double> parameters = {};
  double first_sum = 0, last_sum = 0;  ///< of losses
  double radius = 0;                   ///< of the next step
};

/// Where a parameter meets a bound the others end beside their best, since Ceres cuts the common step: hold it, and ask
/// again. Throws std::runtime_error if the library cannot be loaded.
LeastSquaresEnd minimise(LeastSquares& problem);

/// In the library: what minimise calls.
using MinimiseByCeres = void (*)(LeastSquares&, LeastSquaresEnd&);

}  // namespace rollres
