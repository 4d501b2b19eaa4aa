#include "fitting/fit/fit_report.hpp"

#include <algorithm>
#include <cmath>

#include "core/messages/message_text.hpp"
#include "core/numerics/sorted_places.hpp"
#include "fitting/errors/statistics.hpp"
#include "fitting/fit/fit.hpp"

namespace rollres {

namespace {

ConfidenceInterval linear_interval(const FitParameter& parameter, double value, double deviation, double quantile) {
  ConfidenceInterval interval;
  if (!std::isfinite(deviation)) return interval;
  const Variable& variable = parameter.variable;
  const auto at = [&](double scaled) {
    return variable.scaling == Scaling::logarithmic ? std::exp(scaled) : scaled * variable.size;
  };
  interval.lowest = at(variable.scaled(value) - quantile * deviation);
  interval.highest = at(variable.scaled(value) + quantile * deviation);
  interval.low = interval.high = IntervalEnd::closed;
  if (interval.lowest < variable.lowest) interval.lowest = variable.lowest, interval.low = IntervalEnd::limit;
  if (interval.highest > variable.highest) interval.highest = variable.highest, interval.high = IntervalEnd::limit;
  return interval;
}

/// Whether the end of a descent is no neighbour of the best: more than five standard errors and a tenth away.
bool is_elsewhere(const FitReport& report, const FitProblem& problem, const Descent& best, const Descent& other) {
  const Eigen::VectorXd distance = scaled_point(problem, other.end) - scaled_point(problem, best.end);
  return report.errors.weakest_deviation < 1 &&
         (distance.array().abs() > report.errors.deviations.array().cwiseMax(0.02) * 5).any();
}

/// "static_shear_modulus = 3.1e+06, creep_time = 0.2 (chi squared 31.2)"
std::string parameters_in_words(const FitProblem& problem, const Descent& descent) {
  std::string words;
  for (std::size_t j = 0; j < problem.size(); ++j)
    words += message_text<4>(j == 0 ? "" : ", ", problem.parameters[j].name, " = ", descent.end[j]);
  return words + message_text<4>(" (chi squared ", descent.misfit, ")");
}

/// Counts the descents that led to the misfit of the best one, to a hundredth of what matters, and notes whether one
/// of them moved: by more than a thousandth of a standard error, and than rounding.
void compare(FitReport& report, const FitProblem& problem, const Descent& best, const std::vector<Descent>& ends) {
  const double enough = 0.01 * interval_threshold(problem) * report.errors.scale;
  for (const Descent& end : ends) {
    if (!end.found() || end.abandoned) continue;
    if (end.misfit - best.misfit > enough) {
      if (end.misfit - best.misfit < interval_threshold(problem) * report.errors.scale &&
          is_elsewhere(report, problem, best, end))
        report.second_best = parameters_in_words(problem, end);
      continue;
    }
    ++report.agreeing;
    const Eigen::VectorXd distance = scaled_point(problem, end.end) - scaled_point(problem, end.start);
    for (Eigen::Index j = 0; j < distance.size(); ++j) {
      const double deviation = report.errors.deviations[j];
      const double unmoved = std::max(std::isfinite(deviation) ? std::min(1e-3 * deviation, 1e-3) : 0, 1e-8);
      report.moved |= std::abs(distance[j]) > unmoved;
    }
  }
}

/// Parameters with a share in the weakest direction, the largest first.
std::vector<std::size_t> sharers(const FitErrors& errors) {
  constexpr double small = 0.25;
  std::vector<std::size_t> found;
  const double largest = errors.weakest.cwiseAbs().maxCoeff();
  for (Eigen::Index j = 0; j < errors.weakest.size(); ++j)
    if (std::abs(errors.weakest[j]) > small * largest) found.push_back(static_cast<std::size_t>(j));
  stable_sort(found, [&](std::size_t a, std::size_t b) {
    return std::abs(errors.weakest[static_cast<Eigen::Index>(a)]) >
           std::abs(errors.weakest[static_cast<Eigen::Index>(b)]);
  });
  return found;
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

void tell_errors(FitReport& report, const FitProblem& problem) {
  FitErrors& errors = report.errors;
  const double quantile = std::sqrt(interval_threshold(problem));
  for (std::size_t j = 0; j < problem.size(); ++j) {
    FittedParameter& fitted = report.parameters[j];
    const auto k = static_cast<Eigen::Index>(j);
    const double deviation = errors.deviations[k] = std::sqrt(errors.covariance(k, k));
    for (Eigen::Index i = 0; i < k; ++i)
      errors.correlations(i, k) = errors.correlations(k, i) =
          errors.covariance(i, k) / (errors.deviations[i] * deviation);
    fitted.relative_error = deviation;
    fitted.standard_error = deviation * std::abs(fitted.parameter.variable.slope(fitted.value));
    fitted.linear = linear_interval(fitted.parameter, fitted.value, deviation, quantile);
  }
  const Eigen::MatrixXd known =
      errors.covariance.unaryExpr([](double entry) { return std::isnan(entry) ? 0 : entry; });  // not held
  for (std::size_t i = 0; i < report.values.size(); ++i) {
    const auto slope = report.slopes.derivatives.row(static_cast<Eigen::Index>(i));
    report.values[i].band = std::sqrt(slope.dot(slope * known));
  }
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
  report.trend_p_value = runs_test(
      misses(sorted_places(std::ssize(problem.data), [&](Eigen::Index i) { return best.prediction.values[i]; })));
  double squares = 0, relative_squares = 0, count = 0;
  Eigen::Index largest = 0;
  misses.cwiseAbs().maxCoeff(&largest);
  report.largest_residual = static_cast<std::size_t>(largest);
  for (Eigen::Index i = 0; i < misses.size(); ++i) {
    const MeasuredValue& measured = problem.data[static_cast<std::size_t>(i)];
    const double miss = best.prediction.values[i] - measured.value;
    if (!measured.prior()) {
      squares += miss * miss;
      relative_squares += std::pow(miss / measured.value, 2);
      ++count;
    }
    report.values.push_back({measured, best.prediction.values[i], misses[i], absent});
  }
  report.rms = std::sqrt(squares / count);
  report.relative_rms = std::sqrt(relative_squares / count);

  report.slopes = slopes ? *slopes : problem.differentiate(best.end, best.prediction);
  if (!report.slopes.found()) return report;
  report.errors = fit_errors(problem, best.end, misses, report.slopes);
  report.noise = report.slopes.noise.cwiseQuotient(best.prediction.values).cwiseAbs().maxCoeff();
  compare(report, problem, best, ends);
  report.weakest_direction = weakest_direction_in_words(problem, report.errors);
  for (std::size_t j = 0; j < problem.size(); ++j) {
    FittedParameter& fitted = report.parameters[j];
    const auto k = static_cast<Eigen::Index>(j);
    fitted.step = report.slopes.steps[k];
    fitted.slope_doubt = report.errors.slope_doubt[k];
    fitted.at_bound = report.errors.at_bound[j];
  }
  tell_errors(report, problem);
  return report;
}

std::string known_combinations(const FitProblem& problem, const FitErrors& errors) {
  constexpr double known = 0.3, small = 0.05;
  constexpr Eigen::Index most = 2;
  std::string text;
  for (Eigen::Index k = 0; k < std::min(most, errors.direction_deviations.size()); ++k) {
    if (!(errors.direction_deviations[k] < known)) break;
    const Eigen::VectorXd direction = errors.directions.col(k);
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    std::string factors = problem.parameters[static_cast<std::size_t>(largest)].name;
    for (Eigen::Index j = 0; j < direction.size(); ++j) {
      const double exponent = direction[j] / direction[largest];
      if (j != largest && std::abs(exponent) > small)
        factors += message_text<2>(" x ", problem.parameters[static_cast<std::size_t>(j)].name, "^", exponent);
    }
    text += (text.empty() ? "" : ", and ") + factors +
            message_text<2>(" to ", 100 * errors.direction_deviations[k] / std::abs(direction[largest]), " %");
  }
  return text;
}

std::string weakest_parameters(const FitProblem& problem, const FitErrors& errors) {
  const std::vector<std::size_t> names = sharers(errors);
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + problem.parameters[names[k]].name;
  return text;
}

std::string weakest_direction_in_words(const FitProblem& problem, const FitErrors& errors) {
  const std::vector<std::size_t> names = sharers(errors);
  if (names.empty()) return "";
  if (!std::isfinite(errors.weakest_deviation))
    return weakest_parameters(problem, errors) + (names.size() > 1 ? " change together" : " changes") +
           " without any effect on the predictions";
  const double sign = errors.weakest[static_cast<Eigen::Index>(names.front())] < 0 ? -1 : 1;
  std::string text;
  for (const std::size_t j : names) {
    const Variable& variable = problem.parameters[j].variable;
    const double moved = sign * errors.weakest[static_cast<Eigen::Index>(j)] * errors.weakest_deviation;
    text += (text.empty() ? "" : " and ") + problem.parameters[j].name;
    text += variable.scaling == Scaling::logarithmic
                ? message_text<4>(" x ", std::exp(moved))
                : message_text<4>(moved < 0 ? " - " : " + ", std::abs(moved) * variable.size);
  }
  return "the fit is almost as good with " + text + " (one standard deviation)";
}

}  // namespace rollres
