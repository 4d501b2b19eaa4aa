#pragma once

/// Smooth functions of a distance from their transforms over wavenumbers, tabulated where they are asked for.
///
/// Each function is Re int_0^inf f(k) e^{i k x} dk, three of them together (normal, tangential, cross), or four.
/// Distances and wavenumbers are in units of a depth: f(k) falls off like e^{-2k} and its other singularities lie away
/// from the positive axis, relative to k, so that panels of k in constant ratio suit it; the functions are singular at
/// +-2i, so that panels of x may widen with the distance.

#include <Eigen/Core>
#include <array>
#include <complex>
#include <functional>
#include <span>
#include <vector>

namespace rollres {

/// normal, tangential, cross, and what that of w under shear has besides cross on rings, 0 of flat layers [1/m for unit
/// force and modulus]
using LayerSlopes = Eigen::Array4d;
namespace layer_slope {
enum : Eigen::Index { normal, tangential, cross, hoop };
}

class FourierTable {
 public:
  /// Fills in f(k), three or four for each function in turn.
  using Transform = std::function<void(double wavenumber, std::span<std::complex<double>> values)>;

  /// @param components of each function: 4 with those of the hoop, which are else 0
  /// @param lowest_wavenumber below which f no longer changes but in proportion to k
  FourierTable(std::size_t functions, Eigen::Index components, double lowest_wavenumber, Transform transform);

  /// @param x of either sign. Not for two threads at a time.
  LayerSlopes operator()(std::size_t function, double x) const;

 private:
  /// Chebyshev coefficients on a panel of distances and on its mirror image.
  struct PanelPair {
    std::array<std::vector<LayerSlopes>, 2> coefficients;  // ahead, behind; [function, term]
  };
  struct WaveRule;
  WaveRule wave_rule(double from, double to) const;
  PanelPair made(double from, double to) const;

  Eigen::Index components_, columns_;  // of each function, of all
  double lowest_;
  Transform transform_;
  mutable std::vector<double> borders_{0, 1.2};  // of panels
  mutable std::vector<PanelPair> panels_;        // empty ones are not made yet
};

}  // namespace rollres
