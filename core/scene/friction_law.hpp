#pragma once

/// Coulomb's law of friction at a node, where one is given with a largest shear tau_max: mu |p| below stands for
/// min(mu |p|, tau_max).
///
/// With the shear traction tau on the layer, the pressure p, the slip s of the body relative to the layer and the
/// coefficient mu,
///   |tau| <= mu |p|,   and where s != 0, tau = mu |p| s/|s|.                                                 (C1)
/// As one equation (Alart and Curnier 1991), with q = tau + c s and any c > 0:
///   tau = Proj(q),   Proj(q) = q where |q| <= mu |p| (stick: s = 0),   mu |p| q/|q| elsewhere (slip).        (C2)
/// The derivative of the second branch, with n = q/|q| and beta = mu |p|/|q|, under pressure:
///   dProj = mu n dp + beta (dq - n (n . dq)).                                                                (C3)
/// It holds for tractions [Pa] and for nodal forces [N] alike.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/scene/solution.hpp"

namespace rollres {

/// Proj(q) on the disc of a given radius mu |p|.
class FrictionProjection {
 public:
  FrictionProjection(double bound, double q_x, double q_y = 0)
      : bound_(bound), q_x_(q_x), q_y_(q_y), length_(std::hypot(q_x, q_y)) {}

  bool slips() const { return length_ > bound_; }
  double beta() const { return slips() ? bound_ / length_ : 1; }  // [1]
  double x() const { return beta() * q_x_; }
  double y() const { return beta() * q_y_; }
  double direction_x() const { return q_x_ / length_; }  // n [1]; q must not be zero
  double direction_y() const { return q_y_ / length_; }
  double excess() const { return length_ - bound_; }  // |q| - mu |p|, positive where it slips

 private:
  double bound_, q_x_, q_y_, length_;
};

struct FrictionLaw {
  double coefficient = 0;                                    // mu [1]
  double largest = std::numeric_limits<double>::infinity();  // tau_max [Pa]: of tractions alone, not of forces

  double bound(double pressure) const { return std::min(coefficient * std::abs(pressure), largest); }
  /// Of the bound by the pressure, under pressure [1]; largest at p = 0, so that no shear passes slope(0) p.
  double slope(double pressure) const { return coefficient * std::abs(pressure) < largest ? coefficient : 0; }
  FrictionProjection project(double pressure, double q_x, double q_y = 0) const { return {bound(pressure), q_x, q_y}; }
};

/// The law of a scene, or of the model that is solved of it.
template <class Model>
FrictionLaw friction_law(const Model& model) {
  FrictionLaw law{model.friction_coefficient};
  if (model.traction_limit) law.largest = *model.traction_limit;
  return law;
}

/// Whether shear exceeds its bound by more than rounding does.
inline bool exceeds(double bound, double shear_x, double shear_y = 0) {
  return std::hypot(shear_x, shear_y) > bound * (1 + 1e-12);
}

/// dtau - dProj(q) in the branch of slip (C3), both components.
template <class Real>
std::pair<Real, Real> slip_row(Real slope, Real n_x, Real n_y, Real beta, Real change_of_pressure, Real tau_x,
                               Real tau_y, Real q_x, Real q_y) {
  const Real bound = slope * change_of_pressure, along = n_x * q_x + n_y * q_y;
  return {tau_x - n_x * bound - beta * (q_x - n_x * along), tau_y - n_y * bound - beta * (q_y - n_y * along)};
}

/// How much a node breaks (C1), and by what it does. Shear is measured by `shear_scale`, slip by `slip_scale`.
struct FrictionViolation {
  double shear = 0;  // beyond the bound in stick, off it in slip
  double slip = 0;   // in stick, or of the direction of friction in slip
};
inline FrictionViolation friction_violation(Zone zone, double bound, double shear_x, double shear_y, double slip_x,
                                            double slip_y, double shear_scale, double slip_scale) {
  const double excess = std::hypot(shear_x, shear_y) - bound, slip = std::hypot(slip_x, slip_y);
  if (zone == Zone::stick) return {excess / shear_scale, slip / slip_scale};
  return {std::abs(excess) / shear_scale, std::hypot(shear_x * slip - bound * slip_x, shear_y * slip - bound * slip_y) /
                                              (shear_scale * std::max(slip_scale, slip))};
}

}  // namespace rollres
