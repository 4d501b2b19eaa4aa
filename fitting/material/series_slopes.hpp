#pragma once

/// Derivatives of the moduli that a Prony series has at the rows: what a fit by it descends along.

#include <Eigen/Core>

#include <span>
#include <vector>

#include "fitting/descent/fit_problem.hpp"
#include "fitting/material/material_fit.hpp"

namespace rollres {

/// By its moduli, that at rest first unless it is 0: storage and loss in turn, as in even_series.hpp.
Eigen::MatrixXd modulus_slopes(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift,
                               const PronySeries& series);

/// By the logarithms of its times.
Eigen::MatrixXd time_slopes(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift,
                            const PronySeries& series);

/// By the scaled constants of the shift, the series as it is.
/// @param at  the values of the constants
Eigen::MatrixXd shift_slopes(const std::vector<MeasuredModulus>& data, const PronySeries& series,
                             const MaterialFitOptions& options, std::span<const FitParameter> constants,
                             std::span<const double> at);

/// By the scaled constants of the shift, where the series follows: its times keep their places between the lowest and
/// the highest reduced frequency, and its moduli are those of least squares (Golub and Pereyra 1973, SIAM J. Numer.
/// Anal. 10, 413).
/// @param moduli  what the series has at the rows, storage and loss in turn [Pa]
Eigen::MatrixXd following_slopes(const std::vector<MeasuredModulus>& data, const PronySeries& series,
                                 const Eigen::VectorXd& moduli, const MaterialFitOptions& options,
                                 std::span<const FitParameter> constants, std::span<const double> at);

}  // namespace rollres
