#include "core/fractional_zener.hpp"

#include <cmath>
#include <numbers>

namespace rollres {

std::complex<double> complex_modulus(const FractionalZener& solid, double omega) {
  const double angle = std::copysign(solid.order * std::numbers::pi / 2, omega);
  const std::complex<double> z = std::polar(std::pow(std::abs(omega) * solid.creep_time, solid.order), angle);
  const double glassy = 1 + solid.stiffening;
  return solid.static_modulus * glassy * (1.0 + z) / (glassy + z);
}

}  // namespace rollres
