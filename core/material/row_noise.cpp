#include "core/material/row_noise.hpp"

#include <cmath>

#include "core/material/relative_rows.hpp"

namespace rollres {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// Mean squares near each row, with it and without it.
struct MeanSquares {
  ArrayXd all, others;
};

/// @param width  of the normal weights about a row's frequency [decades]
MeanSquares mean_squares(const ArrayXd& decades, const ArrayXd& squares, double width) {
  const Index rows = squares.size();
  MeanSquares means{ArrayXd(rows), ArrayXd(rows)};
  for (Index row = 0; row < rows; ++row) {
    const ArrayXd weights = (-0.5 * ((decades - decades(row)) / width).square()).exp();
    const double sum = (weights * squares).sum(), weight = weights.sum();
    means.all(row) = sum / weight;
    means.others(row) = (sum - squares(row)) / (weight - 1);
  }
  return means;
}

/// Twice the logarithm of the probability of normal errors of these variances.
double log_likelihood(const ArrayXd& squares, const ArrayXd& variances) {
  return -(variances.log() + squares / variances).sum();
}

}  // namespace

Eigen::VectorXd noise_by_frequency(const RelativeRows& rows, const PronySeries& series) {
  constexpr double least_width = 1;     // decades
  constexpr double rows_together = 12;  // that tell one level, about
  constexpr double exact = 2e-5;        // residuals that count as none
  constexpr double least_fit = 0.3;     // of a row
  constexpr double shown = 4;           // a gain of the logarithm that does not come by chance
  const Index count = rows.rows(), each = rows.equations() / count;
  const Eigen::VectorXd alike = Eigen::VectorXd::Ones(rows.equations());
  const double width = std::max(least_width, rows_together / (2.5 * static_cast<double>(count)) * rows.decades());
  if (width > rows.decades() / 4) return alike;
  // Over the fit, not over the row: a modulus that came out small by chance is not the more certain for it.
  const ArrayXd measured = rows.residuals(series), fitted = (1 + measured).max(least_fit), residual = measured / fitted;
  const ArrayXd squares = residual.square().reshaped(count, each).rowwise().mean() + exact * exact;
  const ArrayXd decades = rows.frequencies().array().log10();
  const MeanSquares means = mean_squares(decades, squares, width);
  const double usual = squares.mean();
  const ArrayXd usual_of_others = (squares.sum() - squares) / static_cast<double>(count - 1);
  const double gain = log_likelihood(squares, means.others) - log_likelihood(squares, usual_of_others);
  if (0.5 * static_cast<double>(each) * gain < shown) return alike;
  return (means.all / usual).sqrt().replicate(each, 1) * fitted;
}

}  // namespace rollres
