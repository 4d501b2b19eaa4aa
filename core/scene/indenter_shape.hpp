#pragma once

/// The rigid body that rolls: its shape, and what tractions on it do to it. What kind of body it is, is decided here
/// and in the grid alone.
///
/// The body touches the surface first at (0, 0). With q(x, y) = sqrt(R^2 - x^2 - y^2) the height of its centre above
/// its lower surface (a cylinder has y = 0),
///   profile R - q,   slope x/q,   rolling radius R(y) = sqrt(R^2 - y^2) (a cylinder: R).
/// Pressure p and shear tau_x, on a unit of area, give the load P, the driving force Q and the torque T (Zehil and
/// Gavin 2013, eqs. 12, 17, 19, 21, 37): a cylinder's act normal to and along its arc, a sphere's vertically and
/// horizontally,
///              P                    Q                    T
///   cylinder   (q p - x tau_x)/R    (x p + q tau_x)/R    -R tau_x
///   sphere     p                    tau_x                x p - q tau_x
/// The slip is that of the body relative to the layer, over V, with omega = R Omega / V (their eqs. 15, 25, 26):
///   s_x = 1 + du/dx - omega R(y)/R,   s_y = dv/dx.

#include <algorithm>
#include <cmath>

#include "core/scene/scene.hpp"

namespace rollres {

/// Dimensions of a body's contact problem: 2 (per metre of length, no y) or 3.
inline int dimensions(const RollingScene& scene) { return scene.indenter == Indenter::sphere ? 3 : 2; }

/// What a unit of each traction gives.
struct LeverArm {
  double of_pressure = 0, of_shear_x = 0;  // [1] for a force, [m] for a torque
  double operator()(double pressure, double shear_x) const { return of_pressure * pressure + of_shear_x * shear_x; }
};

class IndenterShape {
 public:
  explicit IndenterShape(const RollingScene& scene) : radius_(scene.radius), flat_in_y_(dimensions(scene) == 2) {}

  double radius() const { return radius_; }  // R [m]
  /// Whether there is a lower surface above this place.
  bool covers(double x, double y) const { return x * x + y * y < radius_ * radius_; }
  /// q(x, y), held at R/100 beyond the body so that grids may be wider [m].
  double height(double x, double y = 0) const {
    return std::sqrt(std::max(radius_ * radius_ - x * x - y * y, 1e-4 * radius_ * radius_));
  }
  /// Height of the lower surface above its lowest point, without the cancellation of R - q [m].
  double profile(double x, double y = 0) const { return (x * x + y * y) / (radius_ + height(x, y)); }
  /// Its derivative along x [1].
  double slope(double x, double y = 0) const { return x / height(x, y); }
  /// R(y)/R [1]
  double rolling_radius(double y) const {
    return flat_in_y_ ? 1 : std::sqrt(std::max(1 - y * y / (radius_ * radius_), 1e-4));
  }

  LeverArm load(double x, double y = 0) const;           // P
  LeverArm driving_force(double x, double y = 0) const;  // Q
  LeverArm torque(double x, double y = 0) const;         // T
  /// Power over V that the resultants at rotation ratio omega, Q + omega T/R, put in beyond what goes into the moving
  /// surface and into slip (core/newton/README.md, (N23)): of second order in the slope.
  LeverArm unbalanced_power(double omega, double x, double y = 0) const;

 private:
  double radius_;
  bool flat_in_y_;
};

/// The row of the drive, from torques and driving forces (numbers or rows of a system): T/R, less Q if a force at the
/// top drives. It shall be `drive_target`; unused with drive "rotation".
template <class Value>
Value drive_row(const RollingScene& scene, const Value& torque, const Value& driving_force) {
  if (scene.drive != Drive::top_force) return torque / scene.radius;
  return torque / scene.radius - driving_force;
}
inline double drive_target(const RollingScene& scene) {
  return scene.drive == Drive::torque ? *scene.driving_torque / scene.radius : 0;
}

}  // namespace rollres
