#pragma once

/// Surface displacements from surface tractions: convolution with the influence coefficients by fast Fourier
/// transform on a padded grid.
///
/// On a sphere's half grid p, tau_x, w and u are even in y, tau_y and v odd; p and tau_y share one transform, as do
/// w and v, and are told apart by their parity.

#include <Eigen/Core>
#include <complex>

#include "core/contact_problem.hpp"
#include "core/fft.hpp"
#include "core/influence.hpp"

namespace rollres {

/// Displacements at the grid's nodes and one column beyond, x running fastest: size (columns + 1) * rows [m].
struct Displacements {
  Vector w, u, v;
};

class InfluenceOperator {
 public:
  /// @param half grid as of ContactProblem   @param friction false: only w from p is wanted
  InfluenceOperator(const InfluenceTable& table, const SurfaceGrid& half, bool sphere, bool friction);

  /// Tractions [Pa] on the grid; shear may be empty if there is none (shear_y for a cylinder).
  Displacements apply(const Vector& pressure, const Vector& shear_x, const Vector& shear_y) const;

  /// Displacement w at a node from unit pressure on its own cell, taken positive [m/Pa].
  double self_normal() const { return self_normal_; }
  /// Change of slip along x at a node for unit shear traction on its own cell, taken positive [1/Pa].
  double self_slip() const { return self_slip_; }

  /// Approximate inverses, by the reciprocal of the circulant symbols: the pressure that gives -w, and the shear
  /// that gives minus the slip, each on the whole padded grid [Pa].
  Vector approximate_pressure(const Vector& displacement) const;
  void approximate_shear(const Vector& slip_x, const Vector& slip_y, Vector& shear_x, Vector& shear_y) const;

 private:
  using complex = std::complex<double>;
  using Spectrum = FftBuffer<complex>;

  void load_field(FftBuffer<double>& field, const Vector& even, const Vector& odd) const;
  void read_field(const FftBuffer<double>& field, int columns, Vector& even, Vector* odd) const;
  Spectrum spectrum_of(const Vector& even, const Vector& odd) const;
  std::size_t conjugate_row(std::size_t at) const;

  SurfaceGrid grid_;
  bool sphere_, friction_;
  int padded_columns_, padded_rows_;
  FftPlan plan_;
  Spectrum ww_, uu_, vv_, uv_, uw_, vw_;  // per unit traction, normalised for the inverse transform
  Spectrum inverse_ww_, inverse_xx_, inverse_xy_, inverse_yy_;
  double self_normal_ = 0, self_slip_ = 0;
};

}  // namespace rollres
