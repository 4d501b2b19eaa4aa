#pragma once

/// A roller with a crown, whose axle may be turned: its lower surface.
///
/// A point of the surface lies at y_b = e . r along the axle e from the body's middle O, and at rho(y_b) from the axle,
/// rho = R - R_t + sqrt(R_t^2 - y_b^2) (circle) or R sqrt(1 - y_b^2/(R R_t)) (ellipse). At (x, y) below O it is h deep:
///   x^2 + y^2 + h^2 = y_b^2 + rho(y_b)^2,   y_b = e_x x + e_y y - e_z h
///   b = -grad h = (x - s e_x, y - s e_y)/(h + s e_z),   s = y_b + (rho^2)'/2

#include <array>

#include "core/scene/scene.hpp"

namespace rollres {

class CrownedBody {
 public:
  /// @param axle unit vector to its left end
  CrownedBody(double radius, double transverse_radius, Crown crown, const std::array<double, 3>& axle);

  /// A place on the surface below O [m].
  struct Place {
    double x = 0, y = 0, depth = 0;
  };
  const Place& lowest() const { return lowest_; }
  /// h(x, y), held at R/100 beyond the body [m].
  double depth(double x, double y) const;
  bool covers(double x, double y) const { return depth(x, y) > held(); }
  /// Height above the lowest point [m].
  double profile(double x, double y) const;
  std::array<double, 2> slopes(double x, double y) const;  // b

 private:
  double held() const { return 1e-2 * radius_; }
  double fallen_arc(double along) const;      // R - rho of a circle, up to the arc's end [m]
  double squared_radius(double along) const;  // rho^2, < 0 beyond an ellipsoid [m2]
  double half_slope(double along) const;      // (rho^2)'/2 [m]
  Place lowest_place() const;

  double radius_, transverse_;
  Crown crown_;
  std::array<double, 3> axle_;
  Place lowest_;
};

}  // namespace rollres
