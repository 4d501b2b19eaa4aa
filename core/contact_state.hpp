#pragma once

/// What every method hands over: the surface tractions and the two numbers that belong to them.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/influence.hpp"
#include "core/scene.hpp"
#include "core/solution.hpp"

namespace rollres {

struct ContactState {
  SurfaceGrid grid;
  Eigen::VectorXd pressure;          // -F_W / cell area [Pa]; zero at free nodes
  Eigen::VectorXd shear_x, shear_y;  // F_U, F_V / cell area [Pa]; shear_y has size 0 for a cylinder
  std::vector<Zone> zone;            // as the method sees it
  double approach = 0;               // d [m]
  double rotation_ratio = 0;         // R Omega / V [1]; NaN without friction
  int iterations = 0;
  Status status = Status::not_converged;
  std::string reason;
};

/// Everything else follows from the tractions: displacements and slip from the influence table, resultants and the
/// rolling resistance (Zehil and Gavin 2013, eqs. 20 and 40), losses, and the evidence (law_violation,
/// energy_residual), recomputed from the fields and not from the method's own residual.
RollingSolution summarise(const RollingScene& scene, const InfluenceTable& table, const ContactState& state);

}  // namespace rollres
