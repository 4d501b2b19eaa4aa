#pragma once

/// A half-space that is not the same in all directions, under a force spread uniformly over a rectangle.
///
/// Symbols that fall like 1/k have responses that fall like 1/r: with Fourier series of the angle theta,
///   K = g(theta)/r,   g = sum g_n cos 2n theta (ww, uu, vv), sum g_n sin 2n theta (uv), sum g_n cos (2n+1) theta (uw)
///   or sum g_n sin (2n+1) theta (vw).
/// Their double antiderivatives F over x and y, whose differences over the corners of a rectangle are its response, are
/// closed forms: logarithms as in Love's (1929), and r times a Fourier series.

#include "core/elastic_kernel.hpp"
#include "core/wave_directions.hpp"

namespace rollres {

/// Fourier coefficients of r K from those of k times the symbol.
Harmonics response_harmonics(const Harmonics& symbols);

/// sum of harmonics at the direction of (x, y), not both 0; coefficients in the order of elastic_kernel.hpp.
Coefficients harmonic_sum(const Harmonics& harmonics, double x, double y);

class CornerFunction {
 public:
  CornerFunction() = default;
  /// @param response g_n
  explicit CornerFunction(const Harmonics& response);

  /// F(x, y) but for functions of x or y alone.
  Coefficients operator()(double x, double y) const;

  /// Average of K over a cell around (x, y), where F's differences leave no digits from K itself.
  Coefficients average(double x, double y, double cell_x, double cell_y) const;

 private:
  Harmonics response_, series_;                                                // of r K and of F/r
  Coefficients along_ = Coefficients::Zero(), across_ = Coefficients::Zero();  // of the logarithms
};

}  // namespace rollres
