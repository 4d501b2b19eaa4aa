#pragma once

/// How much the rows of a master curve scatter at each frequency.
///
/// Measured moduli are less certain where the sample is stiff or the shift between temperatures is large. A row far
/// from the frequencies of a contact shall not tell how certain those near it are.

#include <Eigen/Core>

namespace rollres {

class RelativeRows;
struct PronySeries;

/// Deviations of the rows' errors over the usual one, one for each equation, by the residuals of rows at like
/// frequencies. All 1 where a level that depends on the frequency does not foretell the left-out rows better than one
/// for all does.
/// @param rows  all equally certain
Eigen::VectorXd noise_by_frequency(const RelativeRows& rows, const PronySeries& series);

}  // namespace rollres
