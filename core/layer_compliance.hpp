#pragma once

/// Compliance of the layer, one wavenumber at a time.
///
/// A layer of thickness H and unit shear modulus, incompressible, without inertia, bonded to a rigid base, under
/// tractions e^{i k x}: with h = k H and D = cosh 2h + 1 + 2 h^2 (shared derivation: stream function, plane strain
/// along the wave vector, anti-plane shear across it),
///   normal from normal              c_ww = (sinh 2h - 2h) / (2 k D)
///   longitudinal from longitudinal  c_ll = (sinh 2h + 2h) / (2 k D)
///   cross term                      c_x  = 2 h^2 / (2 k D)     (w = ... - i c_x tau, u = ... + i c_x sigma)
///   transverse shear                c_tt = tanh(h) / k
/// Over a half-space they become 1/(2k), 1/(2k), 0 and 1/k. A viscoelastic layer divides by G*(omega).

namespace rollres {

/// Values for one wavenumber [m] for unit shear modulus (displacement = value * traction / G).
struct LayerSymbols {
  double normal = 0;        ///< c_ww
  double longitudinal = 0;  ///< c_ll
  double cross = 0;         ///< c_x
  double transverse = 0;    ///< c_tt
};

/// Symbols of the layer. At k = 0: 0, H, 0, H.
/// @param wavenumber k >= 0 [1/m]   @param thickness H [m], infinity for a half-space (then k > 0)
LayerSymbols layer_symbols(double wavenumber, double thickness);

/// Symbols of the layer of unit thickness less those of the half-space, without cancellation at large h; they fall
/// off like e^{-2h}. At h -> 0 they behave like -1/(2h).
/// @param h wavenumber times thickness, > 0 [1]
LayerSymbols layer_correction(double h);

}  // namespace rollres
