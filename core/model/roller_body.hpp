#pragma once

/// A body of revolution whose axle may be turned: its lower surface.
///
/// A point of the surface lies at y_b = e . r along the axle e from the body's middle O, and at rho(y_b) from the axle
/// (roller_outline.hpp). At (x, y) below O it is h deep:
///   x^2 + y^2 + h^2 = y_b^2 + rho(y_b)^2,   y_b = e_x x + e_y y - e_z h
///   b = -grad h = (x - s e_x, y - s e_y)/(h + s e_z),   s = y_b + (rho^2)'/2

#include <array>

#include "core/model/roller_outline.hpp"

namespace rollres {

class RollerBody {
 public:
  /// @param axle unit vector to its left end
  RollerBody(const RollerOutline& outline, const std::array<double, 3>& axle);

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
  double held() const { return 1e-2 * outline_.radius(); }
  /// How far a place below O is outside the body, as a square [m2].
  double outside(double x, double y, double depth) const;
  double searched_depth(double x, double y) const;

  RollerOutline outline_;
  std::array<double, 3> axle_;
  Place lowest_;
};

}  // namespace rollres
