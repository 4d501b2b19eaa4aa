#pragma once

/// A half-space that is not the same in all directions, under a force spread uniformly over a rectangle.
///
/// Symbols that fall like 1/k have responses that fall like 1/r: with Fourier series of the angle theta,
///   K = g(theta)/r,   g = sum g_n cos 2n theta (ww, uu, vv), sum g_n sin 2n theta (uv), sum g_n cos (2n+1) theta (uw)
///   or sum g_n sin (2n+1) theta (vw).
/// Their double antiderivatives F over x and y, whose differences over the corners of a rectangle are its response, are
/// closed forms: logarithms as in Love's (1929), and r times a Fourier series (core/influence/README.md, (K14)).

#include "core/influence/directional_expansion.hpp"
#include "core/influence/elastic_kernel.hpp"

namespace rollres {

/// Fourier coefficients of r K from those of k times the symbol (K12).
Harmonics response_harmonics(const Harmonics& symbols);

/// The cosines and sines of the direction of (x, y), not both 0, by which harmonics are summed.
Harmonics direction_waves(double x, double y, Eigen::Index harmonics);

/// Sum of harmonics, each times its function of a place or of a cell.
inline Coefficients harmonic_sum(const Eigen::Ref<const Harmonics>& harmonics, const Harmonics& functions) {
  Coefficients sum = Coefficients::Zero();
  for (Eigen::Index n = 0; n < functions.cols(); ++n) sum += harmonics.col(n) * functions.col(n);
  return sum;
}

/// What a cell has of the functions that the response of any half-space is made of, averaged.
struct CellFunctions {
  /// @param x, y the cell's centre, its sides cell_x and cell_y [m]
  CellFunctions(double x, double y, double cell_x, double cell_y, Eigen::Index harmonics);

  bool far;          ///< 1/r and its harmonics, as differences of antiderivatives would leave no digits
  Harmonics values;  ///< near: of the antiderivatives, the logarithms first
};

class DirectionalHalfSpace {
 public:
  /// @param response g_n
  explicit DirectionalHalfSpace(const Harmonics& response);

  /// What the functions of a cell, far or near, are weighed with in the average of K over it.
  const Harmonics& harmonics(bool far) const { return far ? response_ : antiderivative_; }

 private:
  Harmonics response_, antiderivative_;
};

}  // namespace rollres
