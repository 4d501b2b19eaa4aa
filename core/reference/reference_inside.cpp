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

VolumeStress point_forces_inside(double pressure, double shear, double poisson_ratio, double x, double y,
                                 double depth) {
  const double z = depth, rho = std::sqrt(x * x + y * y + z * z), r2 = x * x + y * y, above = rho * (rho + z);
  const double soft = 1 - 2 * poisson_ratio, p = pressure / (2 * M_PI), q = shear / (2 * M_PI);
  const double rho3 = rho * rho * rho, rho5 = rho3 * rho * rho;
  const auto under_pressure = [&](double along, double across) {
    return soft * ((along * along - across * across) / (r2 * above) + z * across * across / (r2 * rho3)) -
           3 * z * along * along / rho5;
  };
  const double sum = rho + z;
  // Johnson counts z downwards: shear stresses on z change sign.
  return {
      .x = p * under_pressure(x, y) +
           q * (-3 * x * x * x / rho5 + soft * (x / rho3 - 3 * x / (rho * sum * sum) + x * x * x / (rho3 * sum * sum) +
                                                2 * x * x * x / (rho * rho * sum * sum * sum))),
      .y = p * under_pressure(y, x) +
           q * (-3 * x * y * y / rho5 + soft * (x / rho3 - x / (rho * sum * sum) + x * y * y / (rho3 * sum * sum) +
                                                2 * x * y * y / (rho * rho * sum * sum * sum))),
      .z = -3 * z * z * (p * z + q * x) / rho5,
      .yz = 3 * y * z * (p * z + q * x) / rho5,
      .xz = 3 * x * z * (p * z + q * x) / rho5,
      .xy = p * (soft * (2 * x * y / (r2 * above) - x * y * z / (r2 * rho3)) - 3 * x * y * z / rho5) +
            q * (-3 * x * x * y / rho5 + soft * (-y / (rho * sum * sum) + x * x * y / (rho3 * sum * sum) +
                                                 2 * x * x * y / (rho * rho * sum * sum * sum)))};
}

AxisShear hertz_point_largest_shear(double poisson_ratio) {
  const auto difference = [&](double z) {
    const double share = 1 / (1 + z * z);
    return 1.5 * share - (1 + poisson_ratio) * (1 - z * std::atan(1 / z));
  };
  // Golden section: one largest value between the surface and the depth a.
  double from = 1e-9, to = 1;
  const double cut = 0.5 * (std::sqrt(5.0) - 1);
  while (to - from > 1e-9) {
    const double left = to - cut * (to - from), right = from + cut * (to - from);
    (difference(left) > difference(right) ? to : from) = difference(left) > difference(right) ? right : left;
  }
  return {difference(0.5 * (from + to)), 0.5 * (from + to)};
}

}  // namespace rollres
