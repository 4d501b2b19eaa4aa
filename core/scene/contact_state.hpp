#pragma once

/// What a method hands over: the surface tractions, on a whole grid, and the two numbers that belong to them.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

struct ContactState {
  SurfaceGrid grid;
  Eigen::VectorXd pressure;          // -F_W / cell area [Pa]; zero at free nodes
  Eigen::VectorXd shear_x, shear_y;  // F_U, F_V / cell area [Pa]; shear_y has size 0 for a cylinder
  std::vector<Zone> zone;            // as the method sees it
  double approach = 0;               // d [m]
  double rotation_ratio = 0;         // R Omega / V [1]; NaN without friction
  int iterations = 0;
  bool reached_border = false;  // the contact wants more than `grid`
  Status status = Status::not_converged;
  std::string reason;
  double friction_needed = RollingSolution::absent;  // with no_steady_state: at the normal forces of this state
};

}  // namespace rollres
