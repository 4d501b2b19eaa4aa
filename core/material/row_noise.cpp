#include "core/material/row_noise.hpp"

#include <algorithm>
#include <cmath>

#include "core/material/relative_rows.hpp"

namespace rollres {

namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

/// Twice the logarithm of the probability of normal errors of these variances.
double log_likelihood(const ArrayXd& squares, const ArrayXd& variances) {
  return -(variances.log() + squares / variances).sum();
}

/// Mean squares of the rows near each one.
/// @param near  weights of the rows about each row, one of them 1
ArrayXd levels(const ArrayXXd& near, const ArrayXd& squares, double equations) {
  constexpr double shown = 4;  // a gain of the logarithm that does not come by chance
  const ArrayXd weights = near.rowwise().sum(), sums = (near.matrix() * squares.matrix()).array();
  const double count = static_cast<double>(squares.size());
  const ArrayXd of_others = (sums - squares) / (weights - 1), usual_of_others = (squares.sum() - squares) / (count - 1);
  const double gain = log_likelihood(squares, of_others) - log_likelihood(squares, usual_of_others);
  if (0.5 * equations * gain < shown) return ArrayXd::Constant(squares.size(), squares.mean());
  return sums / weights;
}

/// The root of (1 + r)/(1 - r) at each row. @param scaled  residuals over their level, by frequency, a column of a kind
ArrayXd widenings(const ArrayXXd& near, const ArrayXXd& scaled) {
  constexpr double by_chance = 2, highest = 0.8;
  const Index last = scaled.rows() - 1;
  const auto mean = [&](const ArrayXd& values) { return (near.matrix() * values.matrix()).array(); };
  ArrayXd products = ArrayXd::Zero(scaled.rows());
  products.head(last) = (scaled.topRows(last) * scaled.bottomRows(last)).rowwise().sum();
  const ArrayXd chance = by_chance / (static_cast<double>(scaled.cols()) * near.rowwise().sum()).sqrt();
  const ArrayXd shown = (mean(products) / mean(scaled.square().rowwise().sum()) - chance).max(0.0).min(highest);
  return ((1 + shown) / (1 - shown)).sqrt();
}

}  // namespace

RowNoise noise_by_frequency(const RelativeRows& rows, const PronySeries& series) {
  constexpr double least_width = 1;     // decades
  constexpr double rows_together = 12;  // that tell one level, about
  constexpr double exact = 2e-5;        // residuals that count as none
  constexpr double least_fit = 0.3;     // of a row
  const Index count = rows.rows(), each = rows.equations() / count;
  const double width = std::max(least_width, rows_together / (2.5 * static_cast<double>(count)) * rows.decades());
  if (width > rows.decades() / 4) return {Eigen::VectorXd::Ones(rows.equations())};
  const auto by_frequency = [&](const auto& values) { return values(rows.in_order(), Eigen::all).eval(); };
  const ArrayXd decades = by_frequency(rows.frequencies().array()).log10();
  ArrayXXd near(count, count);
  for (Index row = 0; row < count; ++row) near.row(row) = (-0.5 * ((decades - decades(row)) / width).square()).exp();
  // Over the fit, not over the row: a modulus that came out small by chance is not the more certain for it.
  const ArrayXd measured = rows.residuals(series), fitted = (1 + measured).max(least_fit);
  const ArrayXXd residual = by_frequency((measured / fitted).reshaped(count, each));
  const ArrayXd squares = residual.square().rowwise().mean() + exact * exact;
  const ArrayXd level = levels(near, squares, static_cast<double>(each)).sqrt(),
                wider = widenings(near, residual.colwise() / level);
  const double usual = std::sqrt(squares.mean());
  if ((level == level(0)).all() && (wider == 1).all()) return {Eigen::VectorXd::Ones(rows.equations())};
  ArrayXd deviations(count);
  deviations(rows.in_order()) = wider * level / usual;
  return {deviations.replicate(each, 1) * fitted, 1 / std::sqrt(wider.square().inverse().mean())};
}

}  // namespace rollres
