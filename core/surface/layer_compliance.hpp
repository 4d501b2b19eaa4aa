#pragma once

/// Compliance of the layer, one wavenumber at a time.
///
/// A layer of thickness H, Poisson's ratio nu and unit shear modulus, without inertia, bonded to a rigid base, under
/// tractions e^{i k x}: with h = k H, kappa = 3 - 4 nu, q = 5 - 12 nu + 8 nu^2 and D = kappa cosh 2h + q + 2 h^2 (plane
/// strain along the wave vector, anti-plane shear across it; the normal symbol is that of Bentall and Johnson, 1968),
///   normal from normal              c_ww = (1 - nu) (kappa sinh 2h - 2h) / (k D)
///   longitudinal from longitudinal  c_ll = (1 - nu) (kappa sinh 2h + 2h) / (k D)
///   cross term                      c_x  = (2 h^2 - (1 - 2 nu) kappa (cosh 2h - 1)) / (2 k D)
///                                          (w = ... - i c_x tau, u = ... + i c_x sigma)
///   transverse shear                c_tt = tanh(h) / k
/// Over a half-space they become (1 - nu)/k, (1 - nu)/k, -(1 - 2 nu)/(2k) and 1/k. A viscoelastic layer whose Poisson's
/// ratio is constant divides by G*(omega).

namespace rollres {

/// Shape and compressibility of a layer: what its elastic response of unit shear modulus depends on.
struct Layer {
  double thickness;            ///< H [m], infinity for a half-space
  double poisson_ratio = 0.5;  ///< nu [1], from 0 to 1/2

  Layer(double layer_thickness, double ratio = 0.5) : thickness(layer_thickness), poisson_ratio(ratio) {}
  bool operator==(const Layer&) const = default;
};

/// Values for one wavenumber [m] for unit shear modulus (displacement = value * traction / G).
struct LayerSymbols {
  double normal = 0;        ///< c_ww
  double longitudinal = 0;  ///< c_ll
  double cross = 0;         ///< c_x
  double transverse = 0;    ///< c_tt

  bool operator==(const LayerSymbols&) const = default;
};

/// Symbols of the layer. At k = 0: H (1 - 2 nu)/(2 - 2 nu), H, 0, H.
/// @param wavenumber k >= 0 [1/m]; over a half-space k > 0
LayerSymbols layer_symbols(double wavenumber, const Layer& layer);

/// Symbols of the half-space times the wavenumber [1].
LayerSymbols half_space_symbols(double poisson_ratio);

/// Symbols of the layer of unit thickness less those of the half-space, without cancellation at large h; they fall
/// off like e^{-2h}. At h -> 0 they behave like minus the half-space's.
/// @param h wavenumber times thickness, > 0 [1]
LayerSymbols layer_correction(double h, double poisson_ratio = 0.5);

/// Average of e^{ikx} over a cell whose centre is x = 0: what a force spread over the cell has of the wave [1].
double average_over_cell(double wavenumber, double cell);

}  // namespace rollres
