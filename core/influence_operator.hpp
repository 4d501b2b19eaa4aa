#pragma once

/// Surface displacements from surface tractions: convolution with the influence coefficients by fast Fourier
/// transform on a padded grid, and its approximate inverses for preconditioning.
///
/// On a sphere's half grid p, tau_x, w and u are even in y, tau_y and v odd, so that one complex transform carries all
/// three tractions and one all three displacements (surface_transform.hpp).

#include <Eigen/Core>
#include <complex>
#include <memory>

#include "core/contact_problem.hpp"
#include "core/influence.hpp"
#include "core/surface_transform.hpp"

namespace rollres {

/// Displacements at the grid's nodes and one column beyond, x running fastest: size (columns + 1) * rows [m].
struct Displacements {
  Vector w, u, v;
};

/// Tractions on the grid [Pa].
struct Tractions {
  Vector pressure, shear_x, shear_y;
};

/// An operator serves one thread at a time (it keeps work space).
class InfluenceOperator {
 public:
  /// @param half grid as of ContactProblem   @param friction false: only w from p will be wanted
  InfluenceOperator(const RollingScene& scene, const InfluenceTable& table, const SurfaceGrid& half, bool friction);

  /// Tractions [Pa] on the grid. Empty shear: only w is computed; shear_y is empty for a cylinder.
  Displacements apply(const Vector& pressure, const Vector& shear_x, const Vector& shear_y) const;

  /// Displacement w at a node from unit pressure on its own cell, taken positive [m/Pa].
  double self_normal() const { return self_normal_; }
  /// Change of slip along x at a node for unit shear traction on its own cell, taken positive [1/Pa].
  double self_slip() const { return self_slip_; }

  /// Approximately the pressure that gives -w and the shear that gives minus the slip, by the reciprocal of the
  /// layer's symbols on the whole padded grid [Pa]; slips may be empty. The symbols are those of the layer and not of
  /// the truncated coefficients, whose jump at the ends of the window can put a zero among them.
  Tractions approximate_inverse(const Vector& displacement, const Vector& slip_x, const Vector& slip_y) const;

 private:
  using complex = std::complex<double>;
  using Spectrum = std::vector<complex>;  // wavenumbers kx, ky >= 0
  void prepare_inverses(const RollingScene& scene, bool friction);

  SurfaceGrid grid_;
  bool sphere_;
  std::unique_ptr<SurfaceTransform> transform_;
  Spectrum ww_, uu_, vv_, uv_, uw_, vw_;  // per unit traction, normalised for the inverse transform
  Spectrum inverse_ww_, inverse_xx_, inverse_xy_, inverse_yy_;
  double self_normal_ = 0, self_slip_ = 0;
};

}  // namespace rollres
