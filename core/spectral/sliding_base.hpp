#pragma once

/// The part of the shear that zones of stick start from: mu p m(x), with m = +-1 in the zones of slip.
///
/// Slip in one direction: m is that direction on the whole contact. Between zones of different directions a and b the
/// stick at t' has m = a (1/2 - arcsin(t')/pi) + b (1/2 + arcsin(t')/pi), the mean of shear that jumps at borders
/// distributed like 1/(pi sqrt(1 - s'^2)), so that what remains is sqrt(1 - t'^2) times a smooth function:
/// core/spectral/README.md, (S20) to (S22).

#include <Eigen/Core>
#include <vector>

#include "core/spectral/spectral_system.hpp"

namespace rollres {

class SlidingBase {
 public:
  /// @param order number of coefficients phi_n of the pressure   @param stick_order of the densities in the stick
  SlidingBase(const SlipPattern& pattern, const SpectralEdges& edges, int order, int stick_order);

  /// Slope du/dx of a half-space of unit modulus at x [m] for mu = 1, by coefficient.
  Eigen::RowVectorXd slope(double x) const;

  /// m(x)
  double direction(double x) const;

  /// Smooth functions h(x) integrated against p m: sum over nodes of densities [node, n] h(node) [m].
  const Eigen::VectorXd& nodes() const { return nodes_; }  // x [m]
  const Eigen::MatrixXd& densities() const { return densities_; }
  const std::vector<SourceRun>& runs() const { return runs_; }  // of these nodes

 private:
  /// A zone of stick between different directions.
  struct Transition {
    Interval stick;
    int change;                    // of m, from its trailing to its leading end
    Eigen::ArrayXd border_angles;  // of the borders s = cos(angle)
    Eigen::VectorXd partial;       // 2 int_{-1}^{s} sqrt(1 - r^2) U_n dr, mean over the borders
  };
  void place_nodes();
  Eigen::RowVectorXd jump_mean(const Transition& transition, double x) const;

  Interval contact_;
  int trailing_, leading_, order_;  // directions, number of coefficients
  std::vector<Transition> transitions_;
  std::vector<SourceRun> runs_;
  Eigen::VectorXd nodes_;
  Eigen::MatrixXd densities_;
};

}  // namespace rollres
