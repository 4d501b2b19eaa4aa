#pragma once

/// Tractions and slopes of the surface at any point, and along the whole contact and beyond, from a spectral state.
///
/// Panels run from far ahead of the contact to some way behind it, with borders at every edge; on each the position is
/// x = middle + half sin(pi s/2), s at Chebyshev-Lobatto nodes from +1 to -1, so that roots of the distance at its ends
/// are smooth in s. The memories y_m = R_{T_m} g follow from y - T_m y' = g, panel by panel in the direction of time.
/// Nothing here uses the equations that the state was made to fulfil: what it finds in the contact is a check on them.

#include <optional>
#include <vector>

#include "core/sliding_base.hpp"
#include "core/solution.hpp"
#include "core/spectral_system.hpp"

namespace rollres {

class SpectralField {
 public:
  SpectralField(const SpectralProblem& problem, const SpectralState& state);

  double pressure(double x) const;  // [Pa]
  double shear(double x) const;     // [Pa]
  Zone zone(double x) const;

  /// Slopes dw/dx, du/dx of a layer of unit modulus.
  struct Slopes {
    double w, u;
  };
  Slopes elastic_slopes(double x) const;

 private:
  struct Tails;  // what lies beyond a density's coefficients
  Eigen::VectorXd mixed_tail() const;
  double tail_density(const Tails& tails, double t) const;
  double tail_image(const Tails& tails, double t) const;

  struct Tails {
    Eigen::VectorXd kept;       // amplitude times series up to the order, summed over terms
    Eigen::VectorXd left;       // and beyond it, from order + 1
    Eigen::VectorXd amplitudes, rates;
  };
  static Tails tails_of(const SpectralProblem& problem, const SpectralDensity& density, double half_length);

  const SpectralProblem& problem_;
  const SpectralState& state_;
  double friction_;
  Tails contact_tails_;
  std::vector<Tails> stick_tails_;
  std::optional<SlidingBase> base_;
};

/// One panel; arrays run from the leading to the trailing end.
struct SurfacePanel {
  Zone zone;
  double from, to;              // trailing and leading end [m]
  Eigen::ArrayXd x, weights;    // [m]; sum of weights times values is the integral
  Eigen::ArrayXd pressure, shear, slope_w, slope_u;
  Eigen::ArrayXd gap;           // less that at the leading edge, integrated from there [m]

  /// Integral of values from the leading end to each node.
  Eigen::ArrayXd integrated(const Eigen::ArrayXd& values) const;
  /// A node array at any point of the panel.
  double at(const Eigen::ArrayXd& values, double position) const;
};

/// All panels, from ahead to behind.
std::vector<SurfacePanel> surface_panels(const SpectralProblem& problem, const SpectralState& state,
                                         const SpectralField& field);

}  // namespace rollres
