#pragma once

/// One harmonic e^{i n phi} through a ring of one material, n >= 0 of any size, whole or not.
///
/// In t = ln r the equations of plane strain have constant coefficients: the state (u_r, u_phi, r sigma_rr/G, r
/// sigma_rphi/G), those along phi as factors of sin(n phi) where those along r are of cos(n phi), obeys dy/dt = A y,
/// with f = 1/(1 - nu),
///     A = [-nu f    -n nu f  (1-2nu)f/2    0 ]
///         [  n         1         0         1 ]
///         [ 2f        2n f      nu f      -n ]
///         [2n f      2n^2 f    n nu f     -1 ],    eigenvalues +-(n - 1), +-(n + 1),
/// so that a ring of any thickness is exp(A h), h = ln(outer/inner radius), whatever n and nu, n = 0, n = 1 and nu =
/// 1/2 among them.

#include <Eigen/Core>

namespace rollres {

class RingWaves {
 public:
  /// @param harmonic n   @param poisson_ratio up to 1/2
  RingWaves(double harmonic, double poisson_ratio);

  /// exp(A h): the state at a radius from that at a radius smaller by e^-h. Displacements are multiplied by `scale()`.
  Eigen::Matrix4d outwards(double h) const;
  /// Times n displacements keep the size of stresses: max(n, 1).
  double scale() const { return scale_; }
  static double scale_of(double harmonic);

  /// Steps over h of which none lets a wave grow by more than e^1.5.
  int steps(double h) const;

 private:
  double n_, scale_;
  Eigen::Matrix4d a_, excess_;  // A, and A^2 less the smaller of its two eigenvalues, (n - 1)^2
};

/// What a step's outer face yields, from what its inner face does: displacements, times the scale, per r sigma/G.
struct RingStep {
  Eigen::Matrix2cd give;     ///< of the outer face
  Eigen::Matrix2cd inwards;  ///< r sigma/G of the inner face per that of the outer

  /// @param outwards of the step (RingWaves)   @param inner what its inner face yields
  RingStep(const Eigen::Matrix4d& outwards, const Eigen::Matrix2cd& inner);
};

}  // namespace rollres
