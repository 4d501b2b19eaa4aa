#pragma once

/// What a closed ring still has of the same line force one turn, two turns, ... ago, and of the turns to come.
///
/// Functions of the distance along the ring are Re int_0^inf f(k) e^{i k x} dk where it goes on for ever. Where it is
/// closed, their wavenumbers k are n/R with whole n: the integral becomes the sum f(0)/2 + f(1/R) e^{i x/R} + ..., over
/// R. That is the sum of the single passage over all turns (Poisson), and what it has besides the integral belongs to
/// the turns before and after. Both fade alike beyond the harmonics that these can tell.

#include <complex>
#include <span>
#include <vector>

#include "core/surface/fourier_table.hpp"

namespace rollres {

class EarlierTurns {
 public:
  /// @param radius of the ring [m]   @param longest_wave of the functions: below a tenth of its wavenumber they no
  /// longer change but in proportion to k [m]   @param of_wavenumber fills in f(k), k in 1/m, component by component
  /// @param from_origin a component of the functions that counts from its value at 0, which may be large; -1: none
  EarlierTurns(double radius, double longest_wave, std::size_t functions, Eigen::Index components,
               const FourierTable::Transform& of_wavenumber, Eigen::Index from_origin = -1);

  /// @param x of either sign, farther than `reach` radii as there
  LayerSlopes operator()(std::size_t function, double x) const;

  static constexpr double reach = 3;

 private:
  static constexpr int nodes_ = 24;
  double radius_;
  std::vector<LayerSlopes> series_;  // [function, term]
};

}  // namespace rollres
