#pragma once

/// Slopes of the surface of an elastic incompressible layer of unit shear modulus under a line force, as functions of a
/// continuous distance, and their means over an exponential memory.
///
/// A normal line force gives a half-space the slope dw/dx = -1/(2 pi x), a tangential one du/dx = -1/(2 pi x). The
/// layer of thickness H adds smooth functions of x/H, tabulated here once and for all (k in units of 1/H, symbols c of
/// layer_compliance.hpp, c' less the half-space's):
///     normal(x)     = -1/(pi H^2) int k c'_ww sin(k x/H) dk    dw/dx from a normal force, odd
///     tangential(x) = -1/(pi H^2) int k c'_ll sin(k x/H) dk    du/dx from a tangential force, odd
///     cross(x)      = -1/(pi H^2) int k c_x   cos(k x/H) dk    du/dx from a normal force, -dw/dx from a tangential,
///     even
/// with the tables in units of 1/H (core/spectral/README.md, (S24) for one material). Beyond `layer_reach` the layer is
/// at rest: the corrections cancel the half-space.

#include <vector>

#include "core/surface/fourier_table.hpp"

namespace rollres {

/// x/H where the response has decayed to e^{-0.74 x/H} = 1e-15.
constexpr double layer_reach = 48;

/// The corrections at any distance x [m].
/// @param thickness H [m], finite
LayerSlopes layer_slope_correction(double x, double thickness);

/// The corrections of the displacements whose slopes these are: w = -ln|x|/(2 pi) + normal, u = -ln|x|/(2 pi) +
/// tangential, cross odd; the sums vanish far away [1].
LayerSlopes layer_displacement_correction(double x, double thickness);

/// int_0^inf e^{-s/T}/T (correction at x + s) ds for one memory length T.
class LayerMemory {
 public:
  /// @param thickness H [m], finite   @param memory_length T [m]
  LayerMemory(double thickness, double memory_length);
  /// @param x [m], of either sign, |x| <= layer_reach H
  LayerSlopes operator()(double x) const;

 private:
  double thickness_, memory_length_;
  void march(LayerSlopes end_value, int first, int last);
  std::vector<LayerSlopes> coefficients_;    // panels from 0 to the reach
  mutable std::vector<LayerSlopes> behind_;  // and those of negative x, once asked for; not for two threads at a time
};

}  // namespace rollres
