#pragma once

/// What the edge between the nodes changes of a sphere's rolling resistance (core/newton/README.md, section 9).

#include "core/convolution/influence_operator.hpp"
#include "core/model/contact_model.hpp"
#include "core/numerics/vector.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// If the pressure of even cells becomes one that is spread like the root of the distance to the edge, under the same
/// load, shear and rotation.
struct EdgeCorrection {
  double change = 0;  ///< of the resultants' rolling resistance [N]
  double trust = 0;   ///< from 0, none, to 1: how well the edge and the pressure agree
};

/// The normal problem of a sphere under a load, with its shear as it is.
struct PressedSphere {
  const ContactModel& model;
  const SurfaceGrid& half;  // its grid
  const InfluenceOperator& influence;
  Vector height;                   // of the body less the displacement by the shear, at the nodes [m]
  Vector of_load, of_resistance;   // of the pressures of cells [m2]: sums are P and R_r [N]
  double resistance_of_shear = 0;  // [N]
};

/// None where no edge is found with which the pressure agrees.
/// @param pressure of even cells [Pa]   @param approach theirs [m]
EdgeCorrection edge_correction(const PressedSphere& sphere, const Vector& pressure, double approach);

}  // namespace rollres
