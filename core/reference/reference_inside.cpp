#include "core/reference/reference_inside.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

InsideStress hertz_line_inside(double a, double p0, double x, double depth) {
  const double sum = a * a - x * x + depth * depth, root = std::hypot(sum, 2 * x * depth);
  const double m = std::sqrt(0.5 * (root + sum)), n = std::copysign(std::sqrt(std::max(0.5 * (root - sum), 0.0)), x);
  const double ratio = (depth * depth + n * n) / (m * m + n * n);
  return {.x = -p0 / a * (m * (1 + ratio) - 2 * depth),
          .z = -p0 / a * m * (1 - ratio),
          .xz = p0 / a * n * (m * m - depth * depth) / (m * m + n * n)};
}

double hertz_line_depth_of_largest_shear() { return std::sqrt((std::sqrt(5.0) - 1) / 2); }

double hertz_line_largest_shear() {
  const double depth = hertz_line_depth_of_largest_shear();
  return depth - depth * depth / std::hypot(1, depth);
}

InsideStress flamant_inside(double pressure, double shear, double x, double depth) {
  const double r2 = x * x + depth * depth;
  // Along the radius only: -2/(pi r) (P cos + Q sin), the angle counted from the depth.
  const double radial = -2 / (M_PI * r2) * (pressure * depth + shear * x);
  return {.x = radial * x * x / r2, .z = radial * depth * depth / r2, .xz = -radial * x * depth / r2};
}

}  // namespace rollres
