#include "fitting/fit/fit_report.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fitting/errors/statistics.hpp"
#include "fitting/fit/fit.hpp"
#include "fitting/fit/fit_words.hpp"

namespace rollres {

namespace {

ConfidenceInterval linear_interval(const FitParameter& parameter, double value, double deviation, double quantile) {
  ConfidenceInterval interval;
  if (!std::isfinite(deviation)) return interval;
  const Variable& variable = parameter.variable;
  const auto at = [&](double scaled) { return variable.logarithmic ? std::exp(scaled) : scaled * variable.size; };
  interval.lowest = at(variable.scaled(value) - quantile * deviation);
  interval.highest = at(variable.scaled(value) + quantile * deviation);
  interval.low = interval.high = IntervalEnd::closed;
  return interval;
}

/// Counts the descents that led to the misfit of the best one, to a hundredth of what matters, and notes whether one
/// of them moved: by more than a thousandth of a standard error, and than rounding.
void compare(FitReport& report, const FitProblem& problem, const Descent& best, const std::vector<Descent>& ends) {
  const double enough = 0.01 * interval_threshold(problem) * report.errors.scale;
  for (const Descent& end : ends) {
    if (!end.found() || end.misfit - best.misfit > enough) continue;
    ++report.agreeing;
    const Eigen::VectorXd distance = scaled_point(problem, end.end) - scaled_point(problem, end.start);
    for (Eigen::Index j = 0; j < distance.size(); ++j) {
      const double deviation = report.errors.deviations[j];
      const double unmoved = std::max(std::isfinite(deviation) ? std::min(1e-3 * deviation, 1e-3) : 0, 1e-8);
      report.moved |= std::abs(distance[j]) > unmoved;
    }
  }
}

}  // namespace

FitPoint FitReport::point() const {
  FitPoint values_found;
  for (const FittedParameter& fitted : parameters) values_found.push_back(fitted.value);
  return values_found;
}

ParameterPair worst_pair(const FitReport& report) {
  ParameterPair pair{0, 1};
  double largest = 0;
  const Eigen::MatrixXd& correlations = report.errors.correlations;
  for (Eigen::Index j = 0; j < correlations.rows(); ++j)
    for (Eigen::Index k = j + 1; k < correlations.cols(); ++k)
      if (std::abs(correlations(j, k)) > largest) {
        largest = std::abs(correlations(j, k));
        pair = {static_cast<std::size_t>(j), static_cast<std::size_t>(k)};
      }
  return pair;
}

FitReport report_on(const FitProblem& problem, const Descent& best, const std::vector<Descent>& ends,
                    const std::optional<Slopes>& slopes) {
  FitReport report;
  report.deviations_known = problem.deviations_known;
  report.degrees = degrees_of_freedom(problem);
  report.starts = static_cast<int>(ends.size());
  report.iterations = best.iterations;
  report.stopped = best.why;
  const double absent = RollingSolution::absent;
  report.chi_squared = report.reduced_chi_squared = report.p_value = report.rms = report.relative_rms = absent;
  report.runs_p_value = report.noise = absent;
  report.largest_residual = 0;
  for (std::size_t j = 0; j < problem.size(); ++j)
    report.parameters.push_back(
        {problem.parameters[j], best.end[j], absent, absent, {}, {}, absent, absent, AtBound::no, {}});
  report.slopes.reason = best.prediction.reason;
  if (!best.found()) return report;

  const Eigen::VectorXd misses = residuals(problem, best.prediction);
  report.chi_squared = best.misfit;
  report.reduced_chi_squared = report.degrees > 0 ? best.misfit / report.degrees : absent;
  if (problem.deviations_known && report.degrees > 0 && problem.loss == Loss::none)
    report.p_value = chi_squared_tail(best.misfit, report.degrees);
  report.runs_p_value = runs_test(misses);
  double squares = 0, relative_squares = 0;
  Eigen::Index largest = 0;
  misses.cwiseAbs().maxCoeff(&largest);
  report.largest_residual = static_cast<std::size_t>(largest);
  for (Eigen::Index i = 0; i < misses.size(); ++i) {
    const MeasuredValue& measured = problem.data[static_cast<std::size_t>(i)];
    const double miss = best.prediction.values[i] - measured.value;
    squares += miss * miss;
    relative_squares += std::pow(miss / measured.value, 2);
    report.values.push_back({measured, best.prediction.values[i], misses[i], absent});
  }
  report.rms = std::sqrt(squares / static_cast<double>(misses.size()));
  report.relative_rms = std::sqrt(relative_squares / static_cast<double>(misses.size()));

  report.slopes = slopes ? *slopes : problem.differentiate(best.end, best.prediction);
  if (!report.slopes.found()) return report;
  report.errors = fit_errors(problem, best.end, misses, report.slopes);
  report.noise = report.slopes.noise.cwiseQuotient(best.prediction.values).cwiseAbs().maxCoeff();
  compare(report, problem, best, ends);
  report.weakest_direction = weakest_direction_in_words(problem, report.errors);
  const double quantile = std::sqrt(interval_threshold(problem));
  for (std::size_t j = 0; j < problem.size(); ++j) {
    FittedParameter& fitted = report.parameters[j];
    const auto k = static_cast<Eigen::Index>(j);
    const double deviation = report.errors.deviations[k];
    fitted.relative_error = deviation;
    fitted.standard_error = deviation * std::abs(fitted.parameter.variable.slope(fitted.value));
    fitted.linear = linear_interval(fitted.parameter, fitted.value, deviation, quantile);
    fitted.step = report.slopes.steps[k];
    fitted.slope_doubt = report.errors.slope_doubt[k];
    fitted.at_bound = report.errors.at_bound[j];
  }
  for (Eigen::Index i = 0; i < misses.size(); ++i) {
    double variance = 0;
    for (Eigen::Index j = 0; j < report.slopes.derivatives.cols(); ++j)
      for (Eigen::Index k = 0; k < report.slopes.derivatives.cols(); ++k) {
        const double covariance = report.errors.covariance(j, k);
        if (!std::isnan(covariance))
          variance += report.slopes.derivatives(i, j) * covariance * report.slopes.derivatives(i, k);
      }
    report.values[static_cast<std::size_t>(i)].band = std::sqrt(variance);
  }
  return report;
}

}  // namespace rollres
