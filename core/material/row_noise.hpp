#pragma once

/// How much the rows of a master curve scatter at each frequency.
///
/// Measured moduli are less certain where the sample is stiff or the shift between temperatures is large. A row far
/// from the frequencies of a contact shall not tell how certain those near it are. And residuals that go together from
/// row to row are not independent: those of storage and loss that no passive material has keep one sign over decades.

#include <Eigen/Core>

namespace rollres {

class RelativeRows;
struct PronySeries;

struct RowNoise {
  /// Deviations of the rows' errors over the usual one, one for each equation.
  Eigen::VectorXd deviations;
  /// What rows of these deviations leave open is so many times what their residuals say: by (1 + r)/(1 - r), its root,
  /// where r is the correlation of neighbours beyond chance.
  double widening = 1;
};

/// By the residuals at like frequencies. All alike where a level that depends on the frequency does not foretell the
/// left-out rows better than one for all does, and where neighbours have nothing in common.
/// @param rows  all equally certain
RowNoise noise_by_frequency(const RelativeRows& rows, const PronySeries& series);

}  // namespace rollres
