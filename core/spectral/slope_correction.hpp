#pragma once

/// What finite thickness adds to the slopes of a surface, whatever lies under it: the interface of method spectral to
/// its surfaces.

#include <cstddef>

#include "core/surface/layer_slopes.hpp"
#include "core/surface/ring_curvature.hpp"

namespace rollres {

/// What goes with ln|x| in the normal slope and in the hoop's part of the cross one, of a ring's curvature [1/m].
struct RingLogarithms {
  LogarithmicSlope normal, hoop;
};

/// Corrections to the elastic slopes g of an incompressible half-space of unit modulus, under unit line forces at a
/// distance: normal, tangential, cross, hoop, as in layer_slopes.hpp. What surfaces of any layers remember beyond the
/// creep of the material next to the contact is part of them, so that they are neither odd nor even. Not for two
/// threads at a time.
class SlopeCorrection {
 public:
  virtual ~SlopeCorrection() = default;

  /// @param x distance from the force, positive ahead of it [m]   @return [1/m]
  virtual LayerSlopes slope(double x) const = 0;
  /// int_0^inf slope(x + s) e^{-s/T}/T ds of the problem's memory length T_term [1/m]
  virtual LayerSlopes memory(std::size_t term, double x) const = 0;
  /// The antiderivatives that vanish far ahead with the half-space's -ln|x|/(2 pi); NaN over a half-space [1].
  virtual LayerSlopes displacement(double x) const = 0;

  /// What sums over points miss. @param finest distance between them [m]
  virtual RingLogarithms logarithms(double /*finest*/) const { return {}; }
  /// The same of the means over a memory.
  virtual RingLogarithms memory_logarithms(std::size_t /*term*/, double /*finest*/) const { return {}; }

  /// Distance of the nearest face that they come from [m]: they are singular at twice as much from the real axis.
  virtual double depth() const = 0;
  /// Distance ahead at which the surface is at rest; infinite where that is not known [m].
  virtual double reach() const = 0;
};

}  // namespace rollres
