#include "core/model/loaded_area.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rollres {

namespace {

using std::numbers::pi;

/// The area of the unit circle's quarter between the axes, x and y, both from 0 to 1.
double part_of_disc(double x, double y) {
  if (std::hypot(x, y) <= 1) return x * y;
  const auto below_arc = [](double at) { return 0.5 * (at * std::sqrt(1 - at * at) + std::asin(at)); };
  const double meets = std::sqrt(1 - y * y);  // where the arc falls below y
  return meets * y + below_arc(x) - below_arc(meets);
}

/// The volume under the unit half-ball over the same.
double part_of_ball(double x, double y) {
  const double square = 1 - x * x - y * y;
  if (square <= 0) return 0.25 * pi * (x + y) - pi / 12 * (x * x * x + y * y * y) - pi / 6;
  const double z = std::sqrt(square);
  return (x * y * z - std::atan2(x * y, z)) / 3 +
         (x * (3 - x * x) * std::atan2(y, z) + y * (3 - y * y) * std::atan2(x, z)) / 6;
}

double part_of_circle(double x) { return 0.5 * (x * std::sqrt(1 - x * x) + std::asin(x)); }

}  // namespace

double LoadedArea::area() const { return (shape == PressureShape::rectangle ? 4 : pi) * half_length * half_width; }

double LoadedArea::peak_factor() const {
  if (distribution == PressureDistribution::uniform) return 1;
  return shape == PressureShape::rectangle ? 4 / pi : 1.5;
}

double LoadedArea::share(double from_x, double to_x, double from_y, double to_y) const {
  const bool uniform = distribution == PressureDistribution::uniform;
  // What lies between the axes and a corner, odd in both of its places.
  const auto corner = [&](double x, double y) {
    const double size_x = std::min(std::abs(x) / half_length, 1.0), size_y = std::min(std::abs(y) / half_width, 1.0);
    const double sign = std::copysign(1.0, x) * std::copysign(1.0, y);
    if (shape == PressureShape::rectangle)
      return sign * 0.25 * size_y * (uniform ? size_x : 4 / pi * part_of_circle(size_x));
    return sign * (uniform ? part_of_disc(size_x, size_y) / pi : part_of_ball(size_x, size_y) / (2 * pi / 3));
  };
  return corner(to_x, to_y) - corner(from_x, to_y) - corner(to_x, from_y) + corner(from_x, from_y);
}

}  // namespace rollres
