#pragma once

/// A pressure that is given in place of a body: on which part of the surface it acts, and how it is spread.
///
/// With x over the half-length a and y over the half-width b, on the ellipse x^2 + y^2 <= 1 or the rectangle |x|, |y|
/// <= 1,
///   uniform            p = p_m
///   hertz, ellipse     p = (3/2) p_m sqrt(1 - x^2 - y^2), as under a smooth round body
///   hertz, rectangle   p = (4/pi) p_m sqrt(1 - x^2), as under a long roller

#include "core/scene/scene.hpp"

namespace rollres {

struct LoadedArea {
  PressureShape shape;
  PressureDistribution distribution;
  double half_length, half_width;  // a along the motion, b across it [m]
  double traction;                 // tau_x on the surface over p [1]

  double area() const;         // [m2]
  double peak_factor() const;  // largest pressure over p_m [1]
  /// The part of the load on the rectangle between these sides [m], exactly [1].
  double share(double from_x, double to_x, double from_y, double to_y) const;
};

}  // namespace rollres
