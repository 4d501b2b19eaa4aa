#pragma once

/// Prony series of fixed relaxation times, in even steps of their logarithm over the reduced frequencies: linear in
/// their moduli, which non-negative least squares find (those that are 0 are left out).

#include <Eigen/Core>

#include <vector>

#include "core/material/material_scale.hpp"
#include "core/material/prony_series.hpp"

namespace rollres {

struct MeasuredModulus;

struct EvenSeries {
  PronySeries series;
  double squares = 0;  ///< of the residuals in their deviations
  int times = 0;       ///< that were tried
  double beyond = 0;   ///< decades of times beyond the frequencies at either end

  /// Moduli that are not 0.
  int moduli() const;
};

/// Relaxation times in the middle of so many even steps, ascending [s].
/// @param beyond  decades that the steps reach beyond the frequencies at either end
std::vector<double> even_times(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift, int times,
                               double beyond = 0);

/// Of the rows storage and loss in turn, as in all that follows [Pa].
Eigen::VectorXd measured_values(const std::vector<MeasuredModulus>& data);
Eigen::VectorXd deviations_of(const std::vector<MeasuredModulus>& data);

/// G* at the rows, divided by b_T: in the first column that of a modulus at rest of 1 Pa, then of each time with a
/// modulus of 1 Pa.
Eigen::MatrixXd unit_moduli(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift,
                            const std::vector<double>& times);

EvenSeries even_series(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift, int times,
                       double beyond = 0);

/// The same at given times [s].
EvenSeries series_at_times(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift,
                           const std::vector<double>& times);

/// The number of times that the data ask for, up to two for each decade of frequency, which is as dense as moduli tell
/// times apart, and a decade beyond the frequencies where two rows or more stand in each decade: that of the least
/// generalised cross-validation, n S / (n - k)^2 for the sum of squares S of n values with k moduli that are not 0; or,
/// where deviations are known, of the least S + 2 k.
/// @see Golub, Heath and Wahba (1979), Technometrics 21, 215; Mallows (1973), Technometrics 15, 661
/// @throws std::invalid_argument if the data are too few
EvenSeries automatic_series(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift,
                            bool deviations_known);

}  // namespace rollres
