#pragma once

/// Displacements, stresses, strains and losses inside the layers of a sphere's contact in steady motion.
///
/// The tractions are those waves of e^{i(kx x + ky y)}, |kx|, |ky| <= pi/a, that have the nodes' values at the nodes of
/// the grid: what is shorter than two cells a grid does not know. A wave along n = (cos, sin) with k = |k| meets a
/// material point at the frequency -kx V. In the plane of n and z it is a wave of plane strain (depth_response.hpp),
/// across it one of shear (transverse_response.hpp); with sigma_t = nu (sigma_l + sigma_z) its six stresses turn into
/// those along x, y, z, and with J = 1/G*(-kx V), which depends on kx alone, the strains are
///     epsilon_ij = J/2 [sigma_ij - nu/(1 + nu) sigma_kk delta_ij].
/// A field is
///     f(x, y) = (1/pi) Re int_0^inf e^{i kx x} S(kx, y) dkx,  S = (1/pi) int_0^inf f(kx, ky) {cos, i sin}(ky y) dky
/// of tractions that are their own mirror image in y: f is even in y, but tau_yz, tau_xy and v are odd. Where the body
/// is turned or its profile is not symmetric, a second part is added whose mirror image is its negative: cos and sin
/// change places. The power lost on a line of flow (y, z) is D = (V/pi) int_0^inf kx Im[conj(sigma) : epsilon] dkx of
/// the S of stress and strain there, that of a whole depth the same of f(kx, ky), (1/pi) int dky of it for each part,
/// by Parseval. Integrals by Gauss's rule on panels that widen from what the layers' memories and thicknesses need to
/// what places need.

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "core/interior/interior_field.hpp"
#include "core/surface/layered_medium.hpp"

namespace rollres {

class VolumeField {
 public:
  using Detail = InteriorField::Detail;
  using Wanted = InteriorField::Wanted;

  /// @param medium from the contact away, with the creep that it has at V   @param speed V [m/s]
  /// @param flow  speed at which it flows over V, negative where a coating flows backwards: losses are as often @param
  /// fields of a sphere's solution
  /// @throws std::domain_error if the fields hold no contact
  VolumeField(LayeredMedium medium, double speed, double flow, const SurfaceFields& fields, Detail detail);

  /// @param x ascending [m], evenly spaced for the density   @param y [m]
  /// @throws BeyondLimits
  VolumeFields at(const std::vector<double>& x, const std::vector<double>& y, const std::vector<InteriorLine>& lines,
                  Wanted wanted) const;

  const LayeredMedium& medium() const { return medium_; }
  double speed() const { return std::abs(speed_); }  ///< V [m/s]
  /// Depth of a line below the contact [m].
  double depth_of(const InteriorLine& line) const { return rollres::depth_of(medium_, line); }

 private:
  class Sum;

  LayeredMedium medium_;
  double speed_, flow_;  // flow_ without its sign
  Detail detail_;
  SurfaceGrid grid_;
  bool mirrored_;
  Eigen::MatrixXd pressure_, shear_x_, shear_y_;  // (column, row) [Pa]
  double farthest_x_ = 0, farthest_y_ = 0;        // of the contact [m]
};

}  // namespace rollres
