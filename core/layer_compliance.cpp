#include "core/layer_compliance.hpp"

#include <cmath>

namespace rollres {

LayerSymbols layer_correction(double h) {
  // Numerators and D multiplied by 2 e^{-2h}, the half-space's part subtracted by hand.
  const double e = std::exp(-2 * h);
  const double denominator = 1 + e * e + 2 * e + 4 * h * h * e;
  const double scale = 2 * e / (2 * h * denominator);
  return {.normal = -scale * (1 + e + 2 * h + 2 * h * h),
          .longitudinal = -scale * (1 + e - 2 * h + 2 * h * h),
          .cross = scale * 2 * h * h,
          .transverse = -2 * e / (1 + e) / h};
}

LayerSymbols layer_symbols(double wavenumber, double thickness) {
  if (std::isinf(thickness)) return {0.5 / wavenumber, 0.5 / wavenumber, 0, 1 / wavenumber};
  const double h = wavenumber * thickness;
  if (h < 0.05) {  // series of sinh 2h -+ 2h: the closed form cancels
    const double z = 2 * h, z2 = z * z;
    const double excess = h * z2 / 3 * (1 + z2 / 20 * (1 + z2 / 42 * (1 + z2 / 72)));  // sinh 2h - 2h
    const double d = std::cosh(z) + 1 + 2 * h * h;
    const double over_2k = h > 0 ? thickness / (2 * h * d) : 0;
    if (h == 0) return {0, thickness, 0, thickness};
    return {over_2k * excess, over_2k * (excess + 2 * z), over_2k * 2 * h * h, thickness * std::tanh(h) / h};
  }
  LayerSymbols symbols = layer_correction(h);
  symbols.normal = thickness * (symbols.normal + 0.5 / h);
  symbols.longitudinal = thickness * (symbols.longitudinal + 0.5 / h);
  symbols.cross *= thickness;
  symbols.transverse = thickness * (symbols.transverse + 1 / h);
  return symbols;
}

}  // namespace rollres
