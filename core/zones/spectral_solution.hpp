#pragma once

/// From a spectral state to a solution: resultants, losses, fields, and how well every law of contact holds between the
/// points at which it was imposed.
///
/// The slopes w' and u' are recomputed from the tractions (spectral_field.hpp), and with them, on a fine set of points:
///   outside: no penetration;   contact: p >= 0, gap = 0 (integrated from the leading edge);
///   stick: |tau| <= mu p, slip = 0;   slip: |tau| = mu p along the slip.
/// Scales and power balance are those of core/newton/grid_solution.hpp; the sums are quadratures over the same points.

#include <vector>

#include "core/scene/solution.hpp"
#include "core/spectral/spectral_system.hpp"

namespace rollres {

struct AssessedSpectral {
  /// All outputs but those that only the caller knows (status, reason, iterations, seconds, method, model, warnings,
  /// error_estimate). The fields stand on a uniform grid, 30 intervals per half-length.
  RollingSolution solution;
  /// The largest violation of any law between the points at which they are imposed.
  double violation = 0;
  /// The largest of an inequality: what another pattern would mend. The rest is a matter of the orders.
  double wrong_zone = 0;
  /// Place of the largest shear beyond friction's bound in the stick, if any [m], and the direction of shear there.
  double overloaded = RollingSolution::absent;
  int overload_direction = 0;
  /// Up to where from the trailing edge the body slips against the shear there, if at all [m].
  double reversed = RollingSolution::absent;
  double peak_place = RollingSolution::absent;  ///< of the largest pressure [m]
};

AssessedSpectral assess(const SpectralProblem& problem, const SpectralState& state);

}  // namespace rollres
