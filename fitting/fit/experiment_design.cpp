#include "fitting/fit/experiment_design.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/algebra/dense_algebra.hpp"

namespace rollres {

namespace {

Eigen::MatrixXd covariance_after(const Eigen::MatrixXd& covariance, const DesignChoice& choice) {
  const Eigen::VectorXd moved = covariance * choice.slope;
  return covariance - moved * moved.transpose() / (choice.deviation * choice.deviation + choice.slope.dot(moved));
}

}  // namespace

Eigen::MatrixXd design_covariance(const FitReport& report) {
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

Eigen::VectorXd MeasurementPlan::deviations_with(const Eigen::MatrixXd& with) const {
  Eigen::VectorXd all(std::ssize(aims));
  for (std::size_t k = 0; k < aims.size(); ++k)
    all[static_cast<Eigen::Index>(k)] = std::sqrt(std::max(0.0, aims[k].direction.dot(with * aims[k].direction)));
  return all;
}

void MeasurementPlan::sort() {
  const auto by = static_cast<Eigen::Index>(worst);
  stable_sort(choices,
              [&](const DesignChoice& a, const DesignChoice& b) { return a.deviations[by] < b.deviations[by]; });
}

Eigen::MatrixXd covariance_with(const MeasurementPlan& plan, const std::vector<std::size_t>& places) {
  Eigen::MatrixXd covariance = plan.covariance;
  for (const std::size_t place : places) covariance = covariance_after(covariance, plan.choices[place]);
  return covariance;
}

JointChoice best_together(const MeasurementPlan& plan, std::size_t count) {
  JointChoice best;
  if (plan.choices.empty()) return best;
  const auto worst = [&](const std::vector<std::size_t>& places) {
    return plan.deviations_with(covariance_with(plan, places)).maxCoeff();
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
  best.deviations = plan.deviations_with(covariance_with(plan, best.choices));
  return best;
}

std::vector<ScenePrediction> predictions_at(const FitReport& report, const std::vector<FittedInput>& inputs,
                                            const std::vector<MeasuredScene>& scenes, const Evaluate& evaluate,
                                            const ResistanceFitOptions& options) {
  std::vector<FitParameter> parameters;
  for (const FittedParameter& fitted : report.parameters) parameters.push_back(fitted.parameter);
  return predictions_at(parameters, report.point(), inputs, scenes, evaluate, options);
}

std::vector<ScenePrediction> predictions_at(const std::vector<FitParameter>& parameters, const FitPoint& point,
                                            const std::vector<FittedInput>& inputs,
                                            const std::vector<MeasuredScene>& scenes, const Evaluate& evaluate,
                                            const ResistanceFitOptions& options) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(std::ssize(parameters));
  std::vector<ScenePrediction> answer(scenes.size(), {std::numeric_limits<double>::quiet_NaN(), none});
  if (scenes.empty()) return answer;
  std::vector<std::size_t> places(scenes.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = i;
  std::vector<MeasuredScene> asked = scenes;
  FitProblem problem = resistance_problem(asked, inputs, parameters, evaluate, options);
  Prediction prediction = problem.predict(point);
  if (!prediction.found()) {  // what has no answer cannot be measured
    places.clear();
    asked.clear();
    for (std::size_t i = 0; i < scenes.size() && prediction.values.size() > 0; ++i)
      if (std::isfinite(prediction.values[static_cast<Eigen::Index>(i)])) {
        places.push_back(i);
        asked.push_back(scenes[i]);
      }
    if (asked.empty()) return answer;
    problem = resistance_problem(asked, inputs, parameters, evaluate, options);
    prediction = problem.predict(point);
    if (!prediction.found()) return answer;
  }
  const Slopes slopes = problem.differentiate(point, prediction);
  if (!slopes.found()) return answer;
  constexpr double noisy = 0.1;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (slopes.errors.row(row).norm() > noisy * slopes.derivatives.row(row).norm()) continue;
    answer[places[i]] = {prediction.values[row], slopes.derivatives.row(row).transpose()};
  }
  return answer;
}

std::vector<DesignAim> parameter_aims(const FitReport& report) {
  std::vector<DesignAim> aims;
  const auto count = std::ssize(report.parameters);
  for (const FittedParameter& fitted : report.parameters)
    aims.push_back({fitted.parameter.name, Eigen::VectorXd::Unit(count, std::ssize(aims))});
  return aims;
}

std::vector<DesignAim> prediction_aims(const FitReport& report, const std::vector<FittedInput>& inputs,
                                       const std::vector<MeasuredScene>& scenes, const Evaluate& evaluate,
                                       const ResistanceFitOptions& options) {
  std::vector<DesignAim> aims;
  const std::vector<ScenePrediction> found = predictions_at(report, inputs, scenes, evaluate, options);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (!std::isfinite(found[i].value))
      throw std::invalid_argument(scenes[i].measured.place + ": has no answer with the fitted parameters");
    double value = found[i].value;
    Eigen::VectorXd slope = found[i].slope;
    for (std::size_t j = 0; j < inputs.size(); ++j) {
      if (!is_measured_term(inputs[j].input.key)) continue;
      slope[static_cast<Eigen::Index>(j)] = 0;
      if (inputs[j].input.key == offset_key && (inputs[j].set.empty() || inputs[j].set == scenes[i].set))
        value -= report.parameters[j].value;
    }
    aims.push_back({scenes[i].measured.place, slope / std::abs(value)});
  }
  return aims;
}

MeasurementPlan plan_for(const FitReport& report, std::vector<DesignAim> aims) {
  if (!report.slopes.found()) throw std::invalid_argument("a design needs a fit with slopes");
  MeasurementPlan plan{std::move(aims), 0, {}, {}, design_covariance(report)};
  plan.deviations = plan.deviations_with(plan.covariance);
  Eigen::Index worst = 0;
  plan.deviations.maxCoeff(&worst);
  plan.worst = static_cast<std::size_t>(worst);
  return plan;
}

std::vector<DesignChoice> rated(const MeasurementPlan& plan, const FitReport& report,
                                const std::vector<FittedInput>& inputs, const std::vector<MeasuredScene>& scenes,
                                const Evaluate& evaluate, const ResistanceFitOptions& options) {
  const double relative = usual_relative_deviation(report);
  std::vector<DesignChoice> choices;
  const std::vector<ScenePrediction> found = predictions_at(report, inputs, scenes, evaluate, options);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    DesignChoice& choice =
        choices.emplace_back(DesignChoice{scenes[i].scene, scenes[i].set, found[i].value,
                                          relative * std::abs(found[i].value), plan.deviations, found[i].slope});
    if (std::isfinite(choice.predicted) && choice.deviation > 0)
      choice.deviations = plan.deviations_with(covariance_after(plan.covariance, choice));
  }
  return choices;
}

MeasurementPlan design(const FitReport& report, const std::vector<FittedInput>& inputs,
                       const std::vector<MeasuredScene>& candidates, const Evaluate& evaluate,
                       const ResistanceFitOptions& options, std::vector<DesignAim> aims) {
  MeasurementPlan plan = plan_for(report, aims.empty() ? parameter_aims(report) : std::move(aims));
  for (DesignChoice& choice : rated(plan, report, inputs, candidates, evaluate, options))
    if (std::isfinite(choice.predicted) && choice.slope.squaredNorm() > 0) plan.choices.push_back(std::move(choice));
  plan.sort();
  return plan;
}

}  // namespace rollres
