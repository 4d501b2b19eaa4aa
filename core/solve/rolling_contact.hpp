#pragma once

/// Steady-state frictional rolling contact: the way in.

#include <functional>
#include <memory>

#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// Solves one scene.
/// @throws std::invalid_argument naming key, value and rule if the scene breaks one (see `check`)
/// Everything else is in the solution: `status`, `reason`, `warnings`.
RollingSolution solve(const RollingScene& scene);

/// Solves scenes one after the other. A scene much like the last one starts from that one's solution where that is
/// faster; where it does not lead to a solution, and everywhere else, it is solved as `solve` does. Kernels and plans
/// of transforms are shared by all solutions of a program anyway. Not for two threads at a time.
class RollingSolver {
 public:
  RollingSolver();
  ~RollingSolver();
  RollingSolver(RollingSolver&&) noexcept;
  RollingSolver& operator=(RollingSolver&&) noexcept;

  /// As the function of that name.
  RollingSolution solve(const RollingScene& scene);

  /// How many solutions have started from the one before.
  int reused() const { return reused_; }

 private:
  struct Last;
  std::unique_ptr<Last> last_;
  int reused_ = 0;
};

/// The waist of the program: studies, fits and optimisers take any function of this shape.
using Evaluate = std::function<RollingSolution(const RollingScene&)>;

}  // namespace rollres
