#pragma once

/// Edges and borders of a slip pattern: the few unknowns in which the problem with continuous edges is not linear.

#include <optional>

#include "core/spectral/spectral_system.hpp"

namespace rollres {

/// Newton's method with Broyden's updates on the residuals of `solve_inside` (core/spectral/README.md, (S25)). Kept
/// between orders: the slopes hardly change with them.
class EdgeSearch {
 public:
  EdgeSearch(const SpectralProblem& problem, const SlipPattern& pattern) : problem_(problem), pattern_(pattern) {}

  /// The state whose residuals are below `tolerance`, or as small as rounding allows; none if the search leaves the
  /// pattern (a zone vanishes) or does not converge.
  /// @param most_evaluations after which it takes no further step
  std::optional<SpectralState> find(const SpectralEdges& start, const SpectralOrders& orders, double tolerance,
                                    int most_evaluations = 400);

  /// What the search knows of the derivatives, for the same pattern in much the same scene.
  struct Slopes {
    Eigen::MatrixXd inverse;  ///< of the residuals' derivatives; empty: not known
    double unit = 1;          ///< length by which places are measured [m]
  };
  const Slopes& slopes() const { return slopes_; }
  void take_over(const Slopes& slopes) { slopes_ = slopes; }

  int evaluations() const { return evaluations_; }

 private:
  SpectralState evaluate(const Eigen::VectorXd& place, const SpectralOrders& orders);
  bool differentiate(const Eigen::VectorXd& place, const SpectralState& state, const SpectralOrders& orders);

  const SpectralProblem& problem_;
  SlipPattern pattern_;
  Slopes slopes_;
  NearbySystems nearby_;  // linear problems of the former evaluations
  int evaluations_ = 0;
};

}  // namespace rollres
