#include "fitting/errors/fit_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/algebra/dense_algebra.hpp"

namespace rollres {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Parameters at a bound over which the misfit would fall.
std::vector<AtBound> bounds_met(const FitProblem& problem, const FitPoint& point, const Eigen::VectorXd& gradient) {
  std::vector<AtBound> met;
  constexpr double touching = 1e-9;
  for (std::size_t j = 0; j < point.size(); ++j) {
    const Variable& variable = problem.parameters[j].variable;
    const double here = variable.scaled(point[j]), fall = -gradient[static_cast<Eigen::Index>(j)];
    AtBound at = AtBound::no;
    const double lowest = std::fmax(variable.lowest, problem.parameters[j].least);
    if (here - variable.scaled(lowest) < touching && fall < 0) at = AtBound::lowest;
    if (variable.scaled(variable.highest) - here < touching && fall > 0) at = AtBound::highest;
    met.push_back(at);
  }
  return met;
}

/// Of what was measured, over the freedom that parameters leave it: what priors tell of these they do not take from it.
/// @param whitened  slopes over the deviations
double scatter(const FitProblem& problem, const Eigen::VectorXd& residuals, const Eigen::MatrixXd& whitened) {
  double squares = misfit(problem, residuals);
  if (none_of(problem.data, [](const MeasuredValue& one) { return one.prior(); }))
    return squares / degrees_of_freedom(problem);
  const SingularValues svd(whitened);
  const Eigen::Index rank = (svd.values.array() > SingularValues::rank_limit * svd.values[0]).count();
  double freedom = -static_cast<double>(rank);
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    const bool prior = problem.data[static_cast<std::size_t>(i)].prior();
    if (prior) squares -= residuals[i] * residuals[i];
    freedom += prior ? svd.u.row(i).head(rank).squaredNorm() : 1;
  }
  return squares / std::max(freedom, 1.0);
}

}  // namespace

int degrees_of_freedom(const FitProblem& problem) {
  return static_cast<int>(std::ssize(problem.data) - std::ssize(problem.parameters));
}

void require_enough_data(const FitProblem& problem) {
  const int degrees = degrees_of_freedom(problem);
  if (degrees < 0 || (degrees == 0 && !problem.deviations_known))
    throw std::invalid_argument(std::to_string(problem.data.size()) + " measurements cannot tell " +
                                std::to_string(problem.size()) + " parameters" +
                                (degrees == 0 ? " and their own scatter; give sigma or more data" : ""));
}

FitErrors fit_errors(const FitProblem& problem, const FitPoint& point, const Eigen::VectorXd& residuals,
                     const Slopes& slopes) {
  require_enough_data(problem);
  const Eigen::Index rows = residuals.size(), columns = std::ssize(point);
  Eigen::VectorXd roots(rows), deviations(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    roots[i] = std::sqrt(loss_of(problem, static_cast<std::size_t>(i), residuals[i]).weight);
    deviations[i] = problem.data[static_cast<std::size_t>(i)].deviation;
  }
  const Eigen::VectorXd whitening = roots.cwiseQuotient(deviations);
  const Eigen::MatrixXd whitened = whitening.asDiagonal() * slopes.derivatives;
  const Eigen::VectorXd weighted = roots.cwiseProduct(residuals);

  FitErrors errors;
  errors.scale = 1;
  if (!problem.deviations_known) {  // the scatter is at least that of the predictions
    const double noise = slopes.noise.cwiseQuotient(deviations).squaredNorm() / static_cast<double>(rows);
    errors.scale = std::max({scatter(problem, residuals, whitened), noise, std::numeric_limits<double>::min()});
  }
  errors.at_bound = bounds_met(problem, point, whitened.transpose() * weighted);
  const Eigen::VectorXd column_errors = (whitening.asDiagonal() * slopes.errors).colwise().norm().transpose();
  errors.slope_doubt = column_errors.cwiseQuotient(whitened.colwise().norm().transpose());
  errors.slope_errors = column_errors / std::sqrt(errors.scale);
  std::vector<Eigen::Index> inside;
  for (Eigen::Index j = 0; j < columns; ++j)
    if (errors.at_bound[static_cast<std::size_t>(j)] == AtBound::no) inside.push_back(j);

  const double absent = RollingSolution::absent;
  errors.covariance = Eigen::MatrixXd::Constant(columns, columns, absent);
  errors.correlations = errors.covariance;
  errors.deviations = Eigen::VectorXd::Constant(columns, absent);
  errors.weakest = errors.step = Eigen::VectorXd::Zero(columns);
  errors.directions = Eigen::MatrixXd::Zero(columns, std::ssize(inside));
  errors.direction_deviations = Eigen::VectorXd::Constant(std::ssize(inside), infinite);
  errors.condition = 1;
  errors.weakest_deviation = errors.fall = 0;
  if (inside.empty()) return errors;

  const Eigen::MatrixXd own = whitened(Eigen::all, inside);
  const SingularValues svd(own);
  const Eigen::VectorXd& values = svd.values;
  const Eigen::Index count = values.size();
  const double smallest = values[count - 1], rank_limit = SingularValues::rank_limit * values[0];
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::MatrixXd part = svd.v.col(k) * svd.v.col(k).transpose();
    if (values[k] > rank_limit)
      covariance += part / (values[k] * values[k]);
    else
      covariance += part.unaryExpr([](double x) { return std::abs(x) < 1e-9 ? 0 : std::copysign(infinite, x); });
  }
  covariance *= errors.scale;
  errors.condition = smallest > rank_limit ? values[0] / smallest : infinite;
  errors.weakest_deviation = smallest > rank_limit ? std::sqrt(errors.scale) / smallest : infinite;
  for (Eigen::Index k = 0; k < count; ++k)
    if (values[k] > rank_limit) errors.direction_deviations[k] = std::sqrt(errors.scale) / values[k];
  const Eigen::VectorXd step = -svd.least_squares(weighted);
  errors.fall = (svd.u.transpose() * weighted).squaredNorm();
  for (Eigen::Index a = 0; a < count; ++a) {
    const Eigen::Index j = inside[static_cast<std::size_t>(a)];
    errors.deviations[j] = std::sqrt(covariance(a, a));
    errors.weakest[j] = svd.v(a, count - 1);
    errors.step[j] = step[a];
    errors.directions.row(j) = svd.v.row(a);
    for (Eigen::Index b = 0; b < count; ++b) {
      const Eigen::Index k = inside[static_cast<std::size_t>(b)];
      errors.covariance(j, k) = covariance(a, b);
      errors.correlations(j, k) = a == b ? 1 : covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
    }
  }
  return errors;
}

}  // namespace rollres
