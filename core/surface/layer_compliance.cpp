#include "core/surface/layer_compliance.hpp"

#include <cmath>

namespace rollres {

namespace {

/// Numbers that the symbols have in common.
struct Shape {
  double kappa, q, compressibility;  // 3 - 4 nu, 5 - 12 nu + 8 nu^2, 1 - 2 nu
  explicit Shape(double nu) : kappa(3 - 4 * nu), q(5 - 12 * nu + 8 * nu * nu), compressibility(1 - 2 * nu) {}
};

}  // namespace

LayerSymbols half_space_symbols(double nu) { return {1 - nu, 1 - nu, -0.5 * (1 - 2 * nu), 1}; }

LayerSymbols layer_correction(double h, double nu) {
  // Numerators and D multiplied by 2 e^{-2h}, the half-space's part subtracted by hand.
  const auto [kappa, q, compressibility] = Shape(nu);
  const double e = std::exp(-2 * h);
  const double denominator = kappa * (1 + e * e) + 2 * q * e + 4 * h * h * e;
  const double scale = 2 * e / (2 * h * denominator);
  const double common = kappa * e + q + 2 * h * h;
  return {.normal = -scale * 2 * (1 - nu) * (common + 2 * h),
          .longitudinal = -scale * 2 * (1 - nu) * (common - 2 * h),
          .cross = scale * (2 * h * h + compressibility * (kappa + q + 2 * h * h)),
          .transverse = -2 * e / (1 + e) / h};
}

LayerSymbols layer_symbols(double wavenumber, const Layer& layer) {
  const double nu = layer.poisson_ratio;
  const LayerSymbols deep = half_space_symbols(nu);
  if (std::isinf(layer.thickness))
    return {deep.normal / wavenumber, deep.longitudinal / wavenumber, deep.cross / wavenumber,
            deep.transverse / wavenumber};
  const double thickness = layer.thickness, h = wavenumber * thickness;
  if (h < 0.05) {  // series of sinh 2h -+ 2h: the closed form cancels
    const auto [kappa, q, compressibility] = Shape(nu);
    const double z = 2 * h, z2 = z * z, sinh_h = std::sinh(h);
    // (sinh 2h - 2h)/h
    const double excess = z2 / 3 * (1 + z2 / 20 * (1 + z2 / 42 * (1 + z2 / 72)));
    const double per_d = thickness / (kappa * std::cosh(z) + q + 2 * h * h);
    const double cross = h > 0 ? (h * h - compressibility * kappa * sinh_h * sinh_h) / h : 0;
    return {(1 - nu) * per_d * (kappa * excess + 4 * compressibility),
            (1 - nu) * per_d * (kappa * excess + 2 * (kappa + 1)), per_d * cross,
            h > 0 ? thickness * std::tanh(h) / h : thickness};
  }
  LayerSymbols symbols = layer_correction(h, nu);
  symbols.normal = thickness * (symbols.normal + deep.normal / h);
  symbols.longitudinal = thickness * (symbols.longitudinal + deep.longitudinal / h);
  symbols.cross = thickness * (symbols.cross + deep.cross / h);
  symbols.transverse = thickness * (symbols.transverse + deep.transverse / h);
  return symbols;
}

double average_over_cell(double wavenumber, double cell) {
  const double z = 0.5 * wavenumber * cell;
  return z == 0 ? 1 : std::sin(z) / z;
}

}  // namespace rollres
