#include <algorithm>
#include <cmath>

#include "core/messages/message_text.hpp"
#include "fitting/fit/fit.hpp"
#include "fitting/fit/fit_report.hpp"

namespace rollres {

namespace {

constexpr double noisy_slope = 0.5, doubtful_slope = 0.1;  // estimated error over slope
constexpr double felt = 0.3;                               // error of a slope, in deviations of the data
constexpr double near = 0.1, exactly = 1e-5;               // distance to the least misfit: standard errors, scaled
constexpr double lost = 3;                                 // doubt of a step, standard errors
constexpr double unlikely = 0.01;                          // of a test
constexpr double strong = 0.98;                            // correlation

std::string percent(double part) { return message_text<4>(100 * part, " %"); }

std::string by_how_much(const FitReport& report) {
  return std::isfinite(report.relative_rms) ? " by " + percent(report.relative_rms) + " (rms)"
                                            : ", some of which are 0";
}

/// Noise of the model over the scatter of the data.
double noise_over_scatter(const FitReport& report) {
  double noisy = 0;
  for (std::size_t i = 0; i < report.values.size(); ++i)
    noisy = std::max(noisy, report.slopes.noise[static_cast<Eigen::Index>(i)] / report.values[i].measured.deviation);
  return noisy / std::sqrt(report.errors.scale);
}

/// That the noise of the model is no smaller than the scatter of the data, and what to do; empty if it is.
std::string noise_in_words(const FitReport& report, const FitProblem& problem) {
  if (!report.slopes.found()) return "";
  const double noisy = noise_over_scatter(report);
  if (!(noisy > 0.5)) return "";
  return message_text<4>("the noise of the model, ", percent(report.noise), " of its values, is ", noisy,
                         " times the scatter of the data", problem.noise_remedy.empty() ? "" : "; ",
                         problem.noise_remedy);
}

/// How far the errors of the slopes let Gauss and Newton's step err, in standard errors: (A^T A)^-1 E^T r for slopes
/// A + E and residuals r.
double doubt_of_step(const FitReport& report, Eigen::Index parameter) {
  double squares = 0, variance = 0;
  for (const FittedValue& value : report.values) squares += value.residual * value.residual;
  const double root = std::sqrt(squares / static_cast<double>(report.values.size()) / report.errors.scale);
  for (Eigen::Index k = 0; k < report.errors.covariance.cols(); ++k)
    if (const double covariance = report.errors.covariance(parameter, k); std::isfinite(covariance))
      variance += std::pow(covariance * report.errors.slope_errors[k] * root, 2);
  return std::sqrt(variance) / report.errors.deviations[parameter];
}

/// Why this is no least misfit; empty if it is one.
std::string not_converged(const FitReport& report) {
  if (!report.ended.empty()) return report.ended + ": this is the best so far";
  if (!report.slopes.found()) return report.slopes.reason;
  for (std::size_t j = 0; j < report.parameters.size(); ++j) {
    const FittedParameter& fitted = report.parameters[j];
    if (fitted.slope_doubt > noisy_slope && report.errors.slope_errors[static_cast<Eigen::Index>(j)] > felt)
      return message_text<4>("the slopes by ", fitted.parameter.name, " are noise: with steps of ", fitted.step,
                             " and a relative noise of the model of ", report.noise, " their estimated error is ",
                             percent(fitted.slope_doubt), " of them");
  }
  const bool flat = !(report.errors.weakest_deviation < 1);  // then no place is the least misfit
  for (std::size_t j = 0; j < report.parameters.size() && !flat; ++j) {
    const FittedParameter& fitted = report.parameters[j];
    const double distance = std::abs(report.errors.step[static_cast<Eigen::Index>(j)]);
    const double doubt = doubt_of_step(report, static_cast<Eigen::Index>(j));
    if (doubt > lost)
      return message_text<4>("the noise of the model, ", percent(report.noise), " of its values, leaves ",
                             fitted.parameter.name, " uncertain by ", doubt, " standard errors");
    // A noise e of residuals moves the misfit by about e, and its least place by the root of that. A step that the
    // errors of the slopes explain is no distance: 100 draws of a noise of 0.05 deviations of the data ended within
    // 0.95 standard errors of the least misfit where the doubt was below 3, at steps of up to 1.03 times the doubt.
    const double enough = std::max(std::clamp(std::sqrt(2 * noise_over_scatter(report)), near, 5 * near), 1.5 * doubt);
    if (distance > std::max(enough * fitted.relative_error, exactly))
      return message_text<4>(
          fitted.parameter.name, " is about ", distance / fitted.relative_error,
          " standard errors from the least misfit by its slope (the descent stopped: ", report.stopped, ")");
  }
  return "";
}

/// Whether the parameter moves along the weakest direction, and that changes no prediction.
bool has_no_effect(const FitReport& report, std::size_t parameter) {
  constexpr double share = 0.5;  // of the unit vector
  return report.errors.weakest.size() > 0 && !std::isfinite(report.errors.weakest_deviation) &&
         std::abs(report.errors.weakest[static_cast<Eigen::Index>(parameter)]) > share;
}

/// Whether the slopes do not bind a parameter: not to a factor of e within one standard deviation; or the interval is
/// wider than the bounds that it was given, or than a factor of 1000 either way.
bool not_bounded(const FitReport& report, std::size_t parameter) {
  constexpr double widest = 6.9;
  const FittedParameter& fitted = report.parameters[parameter];
  if (fitted.at_bound != AtBound::no) return false;
  const Variable& variable = fitted.parameter.variable;
  const double half = fitted.relative_error * 1.96, here = variable.scaled(fitted.value);
  const double below = here - variable.scaled(variable.lowest), above = variable.scaled(variable.highest) - here;
  return !(fitted.relative_error < 1) || !(half < widest) || (half > below && half > above);
}

void flag_parameters(FitReport& report) {
  for (std::size_t j = 0; j < report.parameters.size(); ++j) {
    FittedParameter& fitted = report.parameters[j];
    ConfidenceInterval& profile = fitted.profile.interval;
    const auto add = [&](const std::string& words) { fitted.flag += (fitted.flag.empty() ? "" : ", ") + words; };
    fitted.flag.clear();
    if (fitted.at_bound == AtBound::lowest)
      add(std::isfinite(fitted.parameter.least) ? "at the least value with an answer" : "at its lower bound");
    if (fitted.at_bound == AtBound::highest) add("at its upper bound");
    if (has_no_effect(report, j)) {  // what its profile met is rounding
      add("not bounded: changes no prediction");
      profile = fitted.linear = {};
      continue;
    }
    if (fitted.profile.points.empty()) {
      if (!not_bounded(report, j)) continue;
      add("not bounded");
      fitted.linear = {};  // slopes do not tell where so wide an interval ends
      continue;
    }
    if (profile.low == IntervalEnd::open && fitted.at_bound != AtBound::lowest) add("not bounded below");
    if (profile.high == IntervalEnd::open && fitted.at_bound != AtBound::highest) add("not bounded above");
  }
}

/// Why the data do not bind the parameters; empty if they do.
std::string not_identified(const FitReport& report, const FitProblem& problem) {
  const auto pair = [&] {
    const std::string names = weakest_parameters(problem, report.errors);
    return names.find(" and ") == std::string::npos ? std::string() : "; " + names + " are not separable by these data";
  };
  if (!(report.errors.weakest_deviation < 1)) {
    const std::string known = known_combinations(problem, report.errors);
    return report.weakest_direction + pair() + (known.empty() ? "" : "; they tell " + known);
  }
  for (const FittedParameter& fitted : report.parameters)
    if (fitted.flag.find("not bounded") != std::string::npos)
      return "the interval of " + fitted.parameter.name + " does not close" + pair();
  return "";
}

void add_warnings(FitReport& report, const FitProblem& problem) {
  const auto warn = [&](const auto&... words) { report.warnings.push_back(message_text<4>(words...)); };
  for (std::size_t j = 0; j < report.parameters.size(); ++j) {
    const FittedParameter& fitted = report.parameters[j];
    if (fitted.at_bound == AtBound::lowest && std::isfinite(fitted.parameter.least))
      warn(fitted.parameter.name +
           " is at its least value, below which some data have no answer: its error is not known");
    else if (fitted.at_bound != AtBound::no)
      warn(fitted.parameter.name + " is at its bound: its error is not known");
    if (fitted.slope_doubt > doubtful_slope && report.errors.slope_errors[static_cast<Eigen::Index>(j)] > felt)
      warn("the slopes by ", fitted.parameter.name, " are known to ", percent(fitted.slope_doubt), " only");
  }
  for (std::size_t j = 0; j < report.parameters.size(); ++j)
    if (const double doubt = doubt_of_step(report, static_cast<Eigen::Index>(j)); doubt > 5 * near)
      warn("the noise of the model leaves ", report.parameters[j].parameter.name, " uncertain by another ", doubt,
           " standard errors");
  if (report.p_value < unlikely)
    warn("the misfit is larger than the stated deviations of the data explain: p = ", report.p_value);
  if (1 - report.p_value < unlikely)
    warn("the misfit is smaller than expected, so the stated deviations of the data may be too large: 1 - p = ",
         1 - report.p_value);
  if (report.degrees == 0) warn("there are as many parameters as data: nothing is left to judge the fit by");
  if (!(report.runs_p_value < unlikely) && report.trend_p_value < unlikely)
    warn("the residuals are not random in the order of the predicted values: runs test p = ", report.trend_p_value);
  if (report.runs_p_value < unlikely)
    warn("the residuals are not random in the order of the data: runs test p = ", report.runs_p_value);
  const ParameterPair pair = worst_pair(report);
  if (problem.size() > 1) {
    const double correlation =
        report.errors.correlations(static_cast<Eigen::Index>(pair.first), static_cast<Eigen::Index>(pair.second));
    if (std::abs(correlation) > strong)
      warn(problem.parameters[pair.first].name, " and ", problem.parameters[pair.second].name,
           " are hard to separate: correlation ", correlation);
  }
  if (report.enough > 0) {
    std::string names;
    for (const FittedParameter& fitted : report.parameters)
      if (fitted.profile.points.empty()) names += (names.empty() ? "" : ", ") + fitted.parameter.name;
    warn("with ", report.enough, " solutions no further profile is computed: the interval of ", names,
         " is linear; a larger solutions_limit gives the profile");
  }
  if (!report.second_best.empty()) warn("other parameters fit nearly as well: " + report.second_best);
  const double scatter = std::sqrt(report.errors.scale);
  if (const std::string noise = noise_in_words(report, problem); !noise.empty()) warn(noise);
  if (report.relative_rms > 0.2)
    warn("the fit misses the data" + by_how_much(report) + ": the model does not describe them");
  const FittedValue& worst = report.values[report.largest_residual];
  if (std::abs(worst.residual) > 4 * scatter)
    warn(worst.measured.place.empty() ? "a measurement" : worst.measured.place, " is ",
         std::abs(worst.residual) / scatter, " standard deviations off the fit");
}

/// A reduced chi squared from which on a misfit is one.
constexpr double far = 4;

/// Whether the misfit would be one still if it fell as far as the slopes promise.
bool misses_at_its_least(const FitReport& report) {
  constexpr double settled = 0.5;  // of the misfit: slopes that promise more promise what they do not know
  if (!(report.errors.fall < settled * report.chi_squared)) return false;
  return !report.deviations_known || report.chi_squared - report.errors.fall > far * report.degrees;
}

/// Why the model does not describe the data; empty if it may.
std::string misfit_in_words(const FitReport& report) {
  constexpr double least_p = 1e-3, third = 1.0 / 3, fifth = 0.2;
  std::string words;
  if (report.deviations_known) {
    if (!(report.p_value < least_p && report.reduced_chi_squared > far)) return "";
    words = message_text<4>("the residuals are ", std::sqrt(report.reduced_chi_squared),
                            " times as large as the deviations of the data explain (reduced chi squared ",
                            report.reduced_chi_squared, ", p = ", report.p_value, ")");
  } else {
    const bool system = std::min(report.runs_p_value, report.trend_p_value) < unlikely;
    if (!(report.relative_rms > third || (report.relative_rms > fifth && system))) return "";
    words = "the fit misses the data" + by_how_much(report);
  }
  words += ": the model does not describe these data";
  return words + (report.misfit_cause.empty() ? "" : "; " + report.misfit_cause);
}

}  // namespace

void judge(FitReport& report, const FitProblem& problem) {
  report.reason.clear();
  report.warnings.clear();
  flag_parameters(report);
  const bool known = report.slopes.found();
  if (known) add_warnings(report, problem);
  report.status = FitStatus::not_converged;
  report.reason = not_converged(report);
  if (const std::string noise = noise_in_words(report, problem); !report.reason.empty() && !noise.empty())
    report.reason += "; " + noise;
  if (known && report.ended.empty() && report.degrees > 0)
    if (const std::string misfit = misfit_in_words(report); !misfit.empty()) {
      if (misses_at_its_least(report)) {
        report.status = FitStatus::misfit;
        report.reason = misfit;
        return;
      }
      if (report.reason.empty())
        report.reason = message_text<4>("the misfit is large, and its slopes let ",
                                        percent(report.errors.fall / report.chi_squared),
                                        " of it fall (the descent stopped: ", report.stopped, "): start it elsewhere");
    }
  if (known && !report.moved) {
    if (report.reason.empty()) report.status = FitStatus::did_not_move;
    report.reason += report.reason.empty() ? "" : "; ";
    report.reason += "the fit ended where it started, which does not prove a least misfit: give another start";
    return;
  }
  if (!report.reason.empty()) return;
  report.status = FitStatus::not_identified;
  report.reason = not_identified(report, problem);
  if (!report.reason.empty()) return;
  report.status = report.warnings.empty() ? FitStatus::good : FitStatus::usable_with_warnings;
}

}  // namespace rollres
