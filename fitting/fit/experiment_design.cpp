#include "fitting/fit/experiment_design.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/numerics/dense_algebra.hpp"

namespace rollres {

namespace {

/// The covariance by the slopes at the fit. Directions that no datum tells get a deviation of e^10 in place of
/// infinity, so that what tells them is found.
Eigen::MatrixXd covariance_of(const FitReport& report) {
  constexpr double hardly_anything = 1e-9;
  Eigen::MatrixXd information =
      hardly_anything * Eigen::MatrixXd::Identity(std::ssize(report.parameters), std::ssize(report.parameters));
  for (std::size_t i = 0; i < report.values.size(); ++i) {
    const double deviation = report.values[i].measured.deviation * std::sqrt(report.errors.scale);
    const Eigen::VectorXd slope = report.slopes.derivatives.row(static_cast<Eigen::Index>(i)).transpose() / deviation;
    information += slope * slope.transpose();
  }
  const SingularValues svd(information);  // symmetric and not negative: its eigenvalues
  const Eigen::VectorXd inverse = svd.values.cwiseMax(hardly_anything).cwiseInverse();
  return svd.v * inverse.asDiagonal() * svd.v.transpose();
}

double usual_relative_deviation(const FitReport& report) {
  std::vector<double> relative;
  for (const FittedValue& value : report.values)
    if (!value.measured.prior())
      relative.push_back(value.measured.deviation * std::sqrt(report.errors.scale) / std::abs(value.predicted));
  std::nth_element(relative.begin(), relative.begin() + std::ssize(relative) / 2, relative.end());
  return relative[relative.size() / 2];
}

/// The covariance with some choices measured.
Eigen::MatrixXd covariance_with(const MeasurementPlan& plan, const std::vector<std::size_t>& places) {
  Eigen::MatrixXd covariance = plan.covariance;
  for (const std::size_t place : places) {
    const DesignChoice& choice = plan.choices[place];
    const Eigen::VectorXd moved = covariance * choice.slope;
    covariance -= moved * moved.transpose() / (choice.deviation * choice.deviation + choice.slope.dot(moved));
  }
  return covariance;
}

}  // namespace

JointChoice best_together(const MeasurementPlan& plan, std::size_t count) {
  JointChoice best;
  if (plan.choices.empty()) return best;
  const auto worst = [&](const std::vector<std::size_t>& places) {
    return covariance_with(plan, places).diagonal().maxCoeff();
  };
  constexpr double better = 1 - 1e-9;
  /// Puts into one place what is best there.
  const auto choose = [&](std::size_t place) {
    std::vector<std::size_t> tried = best.choices;
    double least = worst(tried);
    bool changed = false;
    for (std::size_t i = 0; i < plan.choices.size(); ++i) {
      tried[place] = i;
      if (const double left = worst(tried); left < better * least) {
        least = left;
        best.choices[place] = i;
        changed = true;
      }
    }
    return changed;
  };
  for (std::size_t place = 0; place < count; ++place) {
    best.choices.push_back(0);
    choose(place);
  }
  constexpr int most_rounds = 10;
  bool changed = true;
  for (int round = 0; round < most_rounds && changed; ++round) {
    changed = false;
    for (std::size_t place = 0; place < count; ++place) changed |= choose(place);
  }
  std::sort(best.choices.begin(), best.choices.end());
  best.deviations = covariance_with(plan, best.choices).diagonal().cwiseSqrt();
  return best;
}

MeasurementPlan design(const FitReport& report, const std::vector<FittedInput>& inputs,
                       std::vector<MeasuredScene> candidates, const Evaluate& evaluate,
                       const ResistanceFitOptions& options) {
  if (!report.slopes.found()) throw std::invalid_argument("a design needs a fit with slopes");
  const Eigen::MatrixXd covariance = covariance_of(report);
  MeasurementPlan answer;
  answer.covariance = covariance;
  answer.deviations = covariance.diagonal().cwiseSqrt();
  Eigen::Index worst = 0;
  answer.deviations.maxCoeff(&worst);
  answer.worst = static_cast<std::size_t>(worst);

  std::vector<FitParameter> parameters;
  for (const FittedParameter& fitted : report.parameters) parameters.push_back(fitted.parameter);
  const FitPoint point = report.point();
  FitProblem problem = resistance_problem(candidates, inputs, parameters, evaluate, options);
  Prediction prediction = problem.predict(point);
  if (!prediction.found()) {  // what has no answer cannot be measured
    std::vector<MeasuredScene> answered;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (std::isfinite(prediction.values[static_cast<Eigen::Index>(i)])) answered.push_back(candidates[i]);
    candidates = std::move(answered);
    if (candidates.empty()) return answer;
    problem = resistance_problem(candidates, inputs, parameters, evaluate, options);
    prediction = problem.predict(point);
  }
  const Slopes slopes = problem.differentiate(point, prediction);
  const double relative = usual_relative_deviation(report);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Eigen::VectorXd slope = slopes.derivatives.row(row).transpose();
    const double deviation = relative * std::abs(prediction.values[row]);
    const Eigen::VectorXd moved = covariance * slope;
    const Eigen::VectorXd after =
        (covariance.diagonal().array() - moved.array().square() / (deviation * deviation + slope.dot(moved))).sqrt();
    if (slope.squaredNorm() > 0)
      answer.choices.push_back(
          {candidates[i].scene, candidates[i].set, prediction.values[row], deviation, after, slope});
  }
  std::stable_sort(answer.choices.begin(), answer.choices.end(), [&](const DesignChoice& a, const DesignChoice& b) {
    return a.deviations[worst] < b.deviations[worst];
  });
  return answer;
}

}  // namespace rollres
