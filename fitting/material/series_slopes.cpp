#include "fitting/material/series_slopes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/algebra/dense_algebra.hpp"
#include "fitting/material/even_series.hpp"
#include "fitting/material/material_problem.hpp"

namespace rollres {

namespace {

/// Derivatives of the logarithms of a_T and b_T by the scaled constants, at each row.
struct FactorSlopes {
  Eigen::MatrixXd time, modulus;
};

FactorSlopes factor_slopes(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options,
                           std::span<const FitParameter> constants, std::span<const double> at) {
  constexpr double step = 1e-4;  // scaled: factors are smooth and cost little
  const Eigen::Index rows = std::ssize(data), columns = std::ssize(constants);
  FactorSlopes slopes{Eigen::MatrixXd(rows, columns), Eigen::MatrixXd(rows, columns)};
  for (Eigen::Index k = 0; k < columns; ++k) {
    const auto place = static_cast<std::size_t>(k);
    const Variable& variable = constants[place].variable;
    FitPoint below(at.begin(), at.end()), above = below;
    below[place] = std::max(variable.lowest, variable.value(variable.scaled(at[place]) - step));
    above[place] = std::min(variable.highest, variable.value(variable.scaled(at[place]) + step));
    const double width = variable.scaled_step(below[place], above[place]);
    const TemperatureShift one = shift_at(options.shift, below, options.free_shifts),
                           other = shift_at(options.shift, above, options.free_shifts);
    const ShiftFactors from(one), to(other);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const double temperature = data[static_cast<std::size_t>(i)].temperature;
      slopes.time(i, k) = std::log(to.time(temperature) / from.time(temperature)) / width;
      slopes.modulus(i, k) = std::log(to.modulus(temperature) / from.modulus(temperature)) / width;
    }
  }
  return slopes;
}

/// How the moduli at the rows change with the constants.
struct ShiftSlopes {
  Eigen::MatrixXd all;      ///< of the series
  Eigen::MatrixXd of_unit;  ///< of each column of modulus_slopes, summed over the rows times a number for each
};

/// @param at       the values of the constants
/// @param weights  the number for each row
ShiftSlopes slopes_by_shift(const std::vector<MeasuredModulus>& data, const PronySeries& series,
                            const MaterialFitOptions& options, std::span<const FitParameter> constants,
                            std::span<const double> at, SeriesTimes times, const Eigen::VectorXd& weights) {
  const Eigen::Index rows = std::ssize(data), columns = std::ssize(constants), terms = std::ssize(series.terms),
                     at_rest = series.static_modulus > 0 ? 1 : 0;
  const TemperatureShift here = shift_at(options.shift, FitPoint(at.begin(), at.end()), options.free_shifts);
  const ShiftFactors factors(here);
  const FactorSlopes by_constant = factor_slopes(data, options, constants, at);
  Eigen::VectorXd frequencies(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const MeasuredModulus& row = data[static_cast<std::size_t>(i)];
    frequencies[i] = row.angular_frequency * factors.time(row.temperature);
  }
  Eigen::Index slowest = 0, fastest = 0;
  const double low = std::log(frequencies.minCoeff(&slowest)), high = std::log(frequencies.maxCoeff(&fastest));
  ShiftSlopes slopes{Eigen::MatrixXd::Zero(2 * rows, columns), Eigen::MatrixXd::Zero(at_rest + terms, columns)};
  // Of a modulus of 1 Pa at a row, by ln(omega a_T time) and by ln b_T.
  const auto add = [&](Eigen::Index i, Eigen::Index column, double modulus, std::complex<double> by_turn,
                       std::complex<double> by_factor, const Eigen::RowVectorXd& turn) {
    const auto factor = by_constant.modulus.row(i);
    const Eigen::RowVectorXd storage = by_turn.real() * turn + by_factor.real() * factor,
                             loss = by_turn.imag() * turn + by_factor.imag() * factor;
    slopes.all.row(2 * i) += modulus * storage;
    slopes.all.row(2 * i + 1) += modulus * loss;
    slopes.of_unit.row(column) += weights[2 * i] * storage + weights[2 * i + 1] * loss;
  };
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double scale = 1 / factors.modulus(data[static_cast<std::size_t>(i)].temperature);
    const Eigen::RowVectorXd shifted = by_constant.time.row(i);
    if (at_rest > 0) add(i, 0, series.static_modulus, 0, -scale, shifted);
    for (Eigen::Index j = 0; j < terms; ++j) {
      const PronySeries::Term& term = series.terms[static_cast<std::size_t>(j)];
      const std::complex<double> turned(0, frequencies[i] * term.time), one = 1.0 + turned;
      Eigen::RowVectorXd turn = shifted;
      if (times == SeriesTimes::even && high > low) {
        const double place = (-std::log(term.time) - low) / (high - low);
        turn -= (1 - place) * by_constant.time.row(slowest) + place * by_constant.time.row(fastest);
      }
      add(i, at_rest + j, term.modulus, scale * turned / (one * one), -scale * turned / one, turn);
    }
  }
  return slopes;
}

}  // namespace

Eigen::MatrixXd modulus_slopes(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift,
                               const PronySeries& series) {
  std::vector<double> times;
  for (const PronySeries::Term& term : series.terms) times.push_back(term.time);
  return unit_moduli(data, shift, times).rightCols(std::ssize(times) + (series.static_modulus > 0 ? 1 : 0));
}

Eigen::MatrixXd time_slopes(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift,
                            const PronySeries& series) {
  const ShiftFactors factors(shift);
  Eigen::MatrixXd slopes(2 * std::ssize(data), std::ssize(series.terms));
  Eigen::Index row = 0;
  for (const MeasuredModulus& measured : data) {
    const double frequency = measured.angular_frequency * factors.time(measured.temperature),
                 scale = 1 / factors.modulus(measured.temperature);
    for (Eigen::Index j = 0; j < slopes.cols(); ++j) {
      const PronySeries::Term& term = series.terms[static_cast<std::size_t>(j)];
      const std::complex<double> turned(0, frequency * term.time), one = 1.0 + turned;
      const std::complex<double> slope = scale * term.modulus * turned / (one * one);
      slopes(row, j) = slope.real();
      slopes(row + 1, j) = slope.imag();
    }
    row += 2;
  }
  return slopes;
}

Eigen::MatrixXd shift_slopes(const std::vector<MeasuredModulus>& data, const PronySeries& series,
                             const MaterialFitOptions& options, std::span<const FitParameter> constants,
                             std::span<const double> at) {
  return slopes_by_shift(data, series, options, constants, at, SeriesTimes::free,
                         Eigen::VectorXd::Zero(2 * std::ssize(data)))
      .all;
}

Eigen::MatrixXd following_slopes(const std::vector<MeasuredModulus>& data, const PronySeries& series,
                                 const Eigen::VectorXd& moduli, const MaterialFitOptions& options,
                                 std::span<const FitParameter> constants, std::span<const double> at) {
  const Eigen::VectorXd weights = deviations_of(data).cwiseInverse();
  const TemperatureShift here = shift_at(options.shift, FitPoint(at.begin(), at.end()), options.free_shifts);
  const Eigen::MatrixXd units = weights.asDiagonal() * modulus_slopes(data, here, series);
  const OverdeterminedSystem system(units);
  const Eigen::MatrixXd inverse = inverse_of_upper(system.triangle());
  const ShiftSlopes slopes = slopes_by_shift(data, series, options, constants, at, SeriesTimes::even,
                                             weights.cwiseAbs2().cwiseProduct(measured_values(data) - moduli));
  Eigen::MatrixXd following = weights.asDiagonal() * slopes.all;
  for (auto slope : following.colwise()) slope -= units * system.solve(slope);
  following += units * (inverse * (inverse.transpose() * slopes.of_unit));
  return weights.cwiseInverse().asDiagonal() * following;
}

}  // namespace rollres
