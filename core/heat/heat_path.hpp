#pragma once

/// The way of the heat of rolling: through the warmed layers, all of one conductivity, to the air and the ground at the
/// face that meets the contact and to the core (of a belt: its other face), as the mean of a turn.
///
/// All is counted per metre of a cylinder's length and for the whole turn. A ring's area at a depth s is 2 pi (R - s),
/// a belt's is its length: conduction from the face down to s has the resistance
///     -ln(1 - s/R)/(2 pi k)   or   s/(k L).
/// What touches the ground for t_c in each turn t_t loses to it as two half-spaces that are brought together (Carslaw
/// and Jaeger 1959, section 2.8), in the mean of the turn as by
///     h_c = 2 e sqrt(t_c/pi)/t_t,   1/e = 1/e_layers + 1/e_ground,   e_layers = sqrt(k c).

#include <cmath>

#include "core/scene/scene.hpp"

namespace rollres {

/// What takes heat away at a face.
struct HeatExit {
  double conductance = 0;  ///< [W/m/K]; infinite: the face has that temperature
  double temperature = 0;  ///< [K]
};

struct HeatPath {
  double thickness = 0;      ///< of the warmed layers, H [m]
  double turn = 0;           ///< length of the face in a turn [m]
  double radius = INFINITY;  ///< of the face of a ring [m]; infinite: a belt
  double conductivity = 0;   ///< k [W/m/K]
  HeatExit air, ground;      ///< at the face
  HeatExit core;

  /// From the face to a depth [m K/W].
  double resistance(double depth) const;
};

/// @param scene obeys `check`, with heat   @param contact its length along the motion [m]
HeatPath heat_path(const RollingScene& scene, double contact);

/// Numbers that tell how evenly warm a turn is; NaN without a heat_capacity, but for Biot's.
struct HeatNumbers {
  double warming_time = NAN;  ///< H^2/kappa [s], kappa = k/c
  double peclet = NAN;        ///< V H^2/(kappa R), R that of a ring as long as the turn: large where a turn is even
  double fourier = NAN;       ///< kappa t_t/H^2, of one turn: small there
  double biot = NAN;          ///< (h + h_c) H/k, of the face
};
HeatNumbers heat_numbers(const RollingScene& scene, const HeatPath& path);

}  // namespace rollres
