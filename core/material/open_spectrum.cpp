#include "core/material/open_spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/dense_algebra.hpp"
#include "core/material/relative_rows.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Root of the covariance (a^T a + 1)^-1 of unknowns that are independent, normal and of deviation 1 before rows a.
MatrixXd posterior_root(const MatrixXd& a) {
  const Index n = a.cols();
  MatrixXd all(a.rows() + n, n);
  all << a, MatrixXd::Identity(n, n);
  return inverse_of_upper(OverdeterminedSystem(all).triangle());
}

/// Of times and moduli: a time's change is one modulus less just below it and one more just above.
OpenSpectrum open_terms(const RelativeRows& rows, const PronySeries& series) {
  constexpr double apart = 0.02;            // of the logarithm of a time
  constexpr double least_deviation = 1e-5;  // of the rows
  const TermSlopes terms(rows, series);
  const VectorXd residual = rows.residuals(series);
  const Index count = std::ssize(series.terms), parameters = terms.slopes.cols();
  const auto equations = static_cast<double>(residual.size());
  const double freedom = std::max(equations / 4, equations - static_cast<double>(parameters));
  const double deviation = std::max(least_deviation, std::sqrt(residual.squaredNorm() / freedom));

  OpenSpectrum open;
  MatrixXd moduli = MatrixXd::Zero(3 * count + terms.moduli.size() - count, parameters);
  for (Index j = 0; j < count; ++j) {
    const double time = terms.times[static_cast<std::size_t>(j)], modulus = terms.moduli(j);
    for (const double shift : {0.0, -apart, apart}) open.times.push_back(time * std::exp(shift));
    moduli(3 * j, j) = modulus;
    moduli.col(terms.moduli.size() + j).segment(3 * j + 1, 2) << -modulus / (2 * apart), modulus / (2 * apart);
  }
  if (rows.free_rest()) {
    moduli(3 * count, count) = terms.moduli(count);
    open.times.push_back(INFINITY);
  }
  open.spread = moduli * posterior_root(terms.slopes / deviation);
  return open;
}

/// Of terms that may be missed: at many times a modulus of the order of what the series has there.
OpenSpectrum open_missed_terms(const RelativeRows& rows, const PronySeries& series) {
  constexpr double per_decade = 5, decades_open = 4;  // beyond the table at either end
  // Of the loss modulus, within the table times the square of the parameters that each equation has to bear: a solid of
  // one term that meets all rows leaves little room for others, one with nearly as many parameters as rows much.
  constexpr double share_within = 3, share_beyond = 1;
  constexpr double least_tangent = 1e-3;    // of the loss where it is next to none
  constexpr double least_deviation = 2e-5;  // of the rows
  const double shortest = std::pow(10, -decades_open) / rows.highest();
  const double decades = rows.decades() + 2 * decades_open;
  const int count = checked_count(std::ceil(decades * per_decade), "retardation times");
  OpenSpectrum open;
  for (int j = 0; j <= count; ++j) open.times.push_back(shortest * std::pow(10, decades * j / count));
  const auto row_count = static_cast<double>(rows.rows()), equations = static_cast<double>(rows.equations()),
             parameters = 2 * static_cast<double>(series.terms.size()) + 1;
  const double share = share_within * std::pow(parameters / equations, 2);
  VectorXd before(count + 1 + (rows.free_rest() ? 1 : 0));  // the rows
  for (Index j = 0; j <= count; ++j) {
    const double own = 1 / open.times[static_cast<std::size_t>(j)];
    const double omega = std::clamp(own, rows.lowest(), rows.highest());
    const std::complex<double> modulus = complex_modulus(series, omega);
    before(j) = (own == omega ? share : share_beyond) * std::max(modulus.imag(), least_tangent * modulus.real());
  }
  if (rows.free_rest()) before(count + 1) = series.static_modulus;

  const VectorXd residual = rows.residuals(series);
  const double freedom = std::max(row_count / 2, row_count * (1 - parameters / equations));
  MatrixXd a = rows.responses(open.times) * before.asDiagonal();
  for (Index from = 0; from < rows.equations(); from += rows.rows())
    a.middleRows(from, rows.rows()) /=
        std::max(least_deviation, std::sqrt(residual.segment(from, rows.rows()).squaredNorm() / freedom));
  open.spread = before.asDiagonal() * posterior_root(a);
  if (rows.free_rest()) open.times.push_back(INFINITY);
  return open;
}

}  // namespace

void OpenSpectrum::add(const OpenSpectrum& other) {
  const Index rows = spread.rows(), columns = spread.cols();
  MatrixXd all = MatrixXd::Zero(rows + other.spread.rows(), columns + other.spread.cols());
  all.topLeftCorner(rows, columns) = spread;
  all.bottomRightCorner(other.spread.rows(), other.spread.cols()) = other.spread;
  spread = std::move(all);
  times.insert(times.end(), other.times.begin(), other.times.end());
}

OpenSpectrum open_beside_terms(const RelativeRows& rows, const PronySeries& series) {
  OpenSpectrum open = open_missed_terms(rows, series);
  open.add(open_terms(rows, series));
  return open;
}

OpenSpectrum open_between(const PronySeries& best, const PronySeries& other, double odds) {
  const double share = std::sqrt(odds / (1 + odds));
  OpenSpectrum open;
  std::vector<double> change;
  const auto add = [&](double time, double modulus) {
    open.times.push_back(time);
    change.push_back(share * modulus);
  };
  for (const PronySeries::Term& term : best.terms) add(term.time, -term.modulus);
  for (const PronySeries::Term& term : other.terms) add(term.time, term.modulus);
  add(INFINITY, other.static_modulus - best.static_modulus);
  open.spread = Eigen::Map<const VectorXd>(change.data(), std::ssize(change));
  return open;
}

}  // namespace rollres
