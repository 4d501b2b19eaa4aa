#pragma once

/// The part of the shear that a zone of stick starts from: mu p m(x), with m = +-1 in the zones of slip.
///
/// Slip in one direction: m is that direction on the whole contact. Slip in both: within the stick x = c' + l' t'
///     m = m_trailing (1/2 - arcsin(t')/pi) + m_leading (1/2 + arcsin(t')/pi),
/// a constant plus half-integer powers of the distance at each border, as the exact shear is, so that what remains is
/// sqrt(1 - t'^2) times a smooth function. Then mu p m is the mean, over borders s that are distributed like
/// 1/(pi sqrt(1 - s'^2)), of shear that jumps at s, whose field for p = sqrt(1 - t^2) U_n(t) follows from
///     F_n(t; s) = int_{-1}^{s} sqrt(1 - r^2) U_n(r)/(t - r) dr,   F_{n+1} = 2 t F_n - F_{n-1} - 2 int sqrt(1-r^2) U_n dr;
/// its logarithm at s = t is integrated over s exactly.

#include <Eigen/Core>

#include "core/spectral_system.hpp"

namespace rollres {

class SlidingBase {
 public:
  /// @param order number of coefficients phi_n of the pressure
  SlidingBase(const SlipPattern& pattern, const SpectralEdges& edges, int order, int stick_order);

  /// Slope du/dx of a half-space of unit modulus at x [m] for mu = 1, by coefficient.
  Eigen::RowVectorXd slope(double x) const;

  /// Smooth functions h(x) integrated against p m: sum over nodes of densities [node, n] h(node) [m].
  Eigen::VectorXd nodes;      // x [m]
  Eigen::MatrixXd densities;  // [node, n]

  /// m(x)
  double direction(double x) const;

 private:
  Eigen::RowVectorXd jump_mean(double x) const;

  SlipPattern pattern_;
  SpectralEdges edges_;
  int order_, borders_;
  Eigen::VectorXd border_angles_;    // of the borders s = cos(angle)
  Eigen::MatrixXd partial_;          // [n, border]: int_{-1}^{s} sqrt(1 - r^2) U_n dr
};

/// Mean over an exponential memory beyond the leading border of the stick: int_0^inf e^{-s/T}/T slope(stick_to + s) ds.
Eigen::RowVectorXd memory_of_base(const SlidingBase& base, const SpectralEdges& edges, double memory_length, int order);

}  // namespace rollres
