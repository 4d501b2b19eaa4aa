#pragma once

/// The surface along the whole contact and beyond, from a spectral state.
///
/// Panels run from far ahead of the contact to some way behind it, with borders at every edge; on each the position is
/// x = middle + half sin(pi s/2), s at Chebyshev-Lobatto nodes from +1 to -1, so that roots of the distance at its ends
/// are smooth in s. The memories y_m = R_{T_m} g follow from y - T_m y' = g, panel by panel in the direction of time.

#include <vector>

#include "core/zones/spectral_field.hpp"

namespace rollres {

/// One panel; arrays run from the leading to the trailing end.
struct SurfacePanel {
  Zone zone;
  double from, to;            // trailing and leading end [m]
  Eigen::ArrayXd x, weights;  // [m]; sum of weights times values is the integral
  Eigen::ArrayXd pressure, shear, slope_w, slope_u;
  Eigen::ArrayXd coating_w, coating_u;  // the coating's part of the slopes, if there is one
  Eigen::ArrayXd gap;                   // less that at the leading edge, integrated from there [m]

  /// Integral of values from the leading end to each node.
  Eigen::ArrayXd integrated(const Eigen::ArrayXd& values) const;
  /// A node array at any point of the panel.
  double at(const Eigen::ArrayXd& values, double position) const;
};

/// M and N of (S18): int p c_x dx, the power over R Omega that the pressure gives to the coating, and of a ring int tau
/// c/R dx, by which the shear gives it less [N/m]. 0 without one.
CoatingMoments coating_moments(const SpectralProblem& problem, const SpectralState& state);

/// What a state makes of the surface. The state's edges and tractions stay as they are while it is used.
struct SpectralSurface {
  SpectralSurface(const SpectralProblem& problem, const SpectralState& state);

  SpectralField field;
  std::vector<SurfacePanel> panels;  ///< all, from ahead to behind
  CoatingMoments coating;            ///< as `coating_moments` has them
};

}  // namespace rollres
