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
#include "core/zones/surface_panels.hpp"

namespace rollres {

/// Neighbouring points of one zone that call for another zone.
struct WrongRun {
  bool in_stick;     ///< too much shear for a stick; else slip against its shear
  std::size_t zone;  ///< index of the stick, or of the zone of slip
  int direction;     ///< of the shear where it sticks; that which would go with the slip where it slips
  double from, to;   ///< [m]
  double amount;     ///< the largest violation in it
};

struct AssessedSpectral {
  /// All outputs but those that only the caller knows (status, reason, iterations, seconds, method, model, warnings,
  /// error_estimate). The fields stand on a uniform grid, 30 intervals per half-length.
  RollingSolution solution;
  /// The largest violation of any law between the points at which they are imposed.
  double violation = 0;
  /// The largest of an inequality: what another pattern would mend. The rest is a matter of the orders.
  double wrong_zone = 0;
  std::vector<WrongRun> wrong_runs;             ///< from the leading edge on
  double peak_place = RollingSolution::absent;  ///< of the largest pressure [m]
};

AssessedSpectral assess(const SpectralProblem& problem, const SpectralState& state);
/// The same with the state's surface, known.
AssessedSpectral assess(const SpectralProblem& problem, const SpectralState& state, const SpectralSurface& surface);

}  // namespace rollres
