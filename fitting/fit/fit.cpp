#include "fitting/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "fitting/errors/statistics.hpp"
#include "fitting/fit/misfit_cause.hpp"
#include "fitting/fit/rough_descents.hpp"

namespace rollres {

namespace {

Descent& best_of(std::vector<Descent>& descents) {
  return *min_element(descents, [](const Descent& a, const Descent& b) {
    const auto size = [](const Descent& d) {
      return d.found() && !d.abandoned ? d.misfit : std::numeric_limits<double>::infinity();
    };
    return size(a) < size(b);
  });
}

/// A robust loss needs a scale: without known deviations, that of the bulk of the residuals (1.4826 times their median
/// size), first of plain least squares, which an outlier drags along, then of robust fits.
FitProblem with_loss_scale(const FitProblem& problem, const FitOptions& options) {
  if (problem.loss == Loss::none || problem.deviations_known) return problem;
  constexpr int rounds = 4;
  FitProblem scaled = problem;
  scaled.loss = Loss::none;
  FitPoint start = start_point(problem);
  for (int round = 0; round < rounds; ++round) {
    const Descent descent = rough_descent(scaled, start, options);
    if (!descent.found()) break;
    Eigen::VectorXd sizes = residuals(problem, descent.prediction).cwiseAbs();
    std::nth_element(sizes.begin(), sizes.begin() + sizes.size() / 2, sizes.end());
    scaled.loss = problem.loss;
    scaled.loss_scale =
        problem.loss_scale * std::max(1.4826 * sizes[sizes.size() / 2], std::numeric_limits<double>::min());
    start = descent.end;
  }
  scaled.loss = problem.loss;
  return scaled;
}

/// Whether the slopes leave a direction of the parameters free: nothing along it is the least misfit.
bool leaves_free(const FitReport& report) { return !(report.errors.weakest_deviation < 1); }

/// Whether the deviations explain so little of the misfit that its least value to the last digit is of no interest.
bool is_far_off(const FitReport& report) {
  constexpr double far = 20;
  return report.deviations_known && report.reduced_chi_squared > far;
}

/// Whether the misfit is far off, and the slopes promise no other.
bool misses_by_far(const FitReport& report) {
  constexpr double part = 0.25;
  return is_far_off(report) && report.errors.fall < part * report.chi_squared;
}

/// Whether the misfit stays far off, and a round has brought little.
bool creeps_far_off(const FitReport& report, double before) {
  constexpr double little = 0.1;
  return is_far_off(report) && report.chi_squared > (1 - little) * before;
}

/// Whether Gauss and Newton's step from here is but a small part of the standard errors; where it is free along a
/// direction, whether it promises next to nothing; on the edge of what has an answer, or with a noisy model, little.
bool arrived(const FitReport& report) {
  constexpr double near = 0.01, exactly = 1e-7, next_to_nothing = 1;
  if (leaves_free(report) && report.errors.fall < next_to_nothing * report.errors.scale) return true;
  constexpr double little = 0.02, smooth = 1e-5;
  const bool on_edge = any_of(report.parameters, [](const auto& fitted) {
    return fitted.at_bound == AtBound::lowest && std::isfinite(fitted.parameter.least);
  });
  if ((on_edge || report.noise > smooth) && report.errors.fall < little * report.errors.scale) return true;
  const Eigen::VectorXd& step = report.errors.step;
  for (Eigen::Index j = 0; j < step.size(); ++j) {
    const double deviation = report.errors.deviations[j];
    if (std::abs(step[j]) > std::max(std::isfinite(deviation) ? near * deviation : 0, exactly)) return false;
  }
  return true;
}

/// Whether so little is promised that a step over the noise of the model, or another round, is not worth its slopes.
bool promises_little(const FitReport& report) {
  constexpr double little = 1e-3;
  return report.errors.fall < little * report.errors.scale;
}

/// Parameters that the misfit presses against a bound: held, they do not spoil the steps of the others. Least values
/// with an answer move with the others: descents mind them.
std::vector<std::size_t> pressed_on_bounds(const FitReport& report) {
  std::vector<std::size_t> held;
  for (std::size_t j = 0; j < report.errors.at_bound.size(); ++j)
    if (report.errors.at_bound[j] != AtBound::no && !std::isfinite(report.parameters[j].parameter.least))
      held.push_back(j);
  if (held.size() == report.parameters.size()) held.clear();
  return held;
}

/// Gauss and Newton's steps with slopes by differences that suit the noise, where that noise explains why descents end
/// beside the least misfit: at a place where it happens to be low. It changes a sum of squares r^2 by 2 r e.
void step_over_noise(const FitProblem& problem, Descent& best, const std::vector<Descent>& descents,
                     FitReport& report) {
  constexpr int most_steps = 3;
  for (int steps = 0; steps < most_steps && report.slopes.found() && !arrived(report) && !leaves_free(report) &&
                      !misses_by_far(report) && !promises_little(report);
       ++steps) {
    double variance = 0;
    for (std::size_t i = 0; i < report.values.size(); ++i) {
      const double noise = report.slopes.noise[static_cast<Eigen::Index>(i)] / report.values[i].measured.deviation;
      variance += std::pow(2 * report.values[i].residual * noise, 2);
    }
    const FitPoint point = point_of(problem, scaled_point(problem, best.end) + report.errors.step);
    const Prediction prediction = problem.predict(point);
    if (!prediction.found()) return;
    const double there = misfit(problem, residuals(problem, prediction));
    if (!(there < best.misfit + 2 * std::sqrt(variance))) return;
    best.end = point;
    best.prediction = prediction;
    best.misfit = there;
    report = report_on(problem, best, descents);
  }
}

/// Notes whether a descent that met the edge of what has an answer ends on it.
void mind_least_values(FitProblem& problem, const Descent& end) {
  constexpr double below = 1.01;
  for (std::size_t j = 0; j < problem.size(); ++j) {
    FitParameter& parameter = problem.parameters[j];
    if (!parameter.has_least || !end.found() || !(end.met_edge || std::isfinite(parameter.least))) continue;
    FitPoint beyond = end.end;
    beyond[j] = std::max(beyond[j] / below, parameter.variable.lowest);
    parameter.least = problem.predict(beyond).found() ? RollingSolution::absent : end.end[j];
  }
}

/// Whether a fit that has taken most of the solutions that it is worth has little before it but the noise of its model.
bool crawls_over_noise(const FitReport& report, const FitProblem& problem, const FitOptions& options) {
  constexpr double smooth = 1e-5, little = 0.05;
  return report.noise > smooth && report.errors.fall < little * report.errors.scale &&
         problem.ending->solutions() > usual_solutions(problem, options.limits) / 3 * 2;
}

/// The report on the best descent, which goes on from where it stopped for its rough tolerance: by secants from the
/// slopes of the report, which stay good enough for the errors if this leads less than a third of a standard error
/// away.
FitReport settled(FitProblem& problem, std::vector<Descent>& descents, const FitOptions& options) {
  Descent& best = best_of(descents);
  mind_least_values(problem, best);
  FitReport report = report_on(problem, best, descents);
  constexpr int most_rounds = 4;
  constexpr double beside = 0.1, smooth = 1e-5;
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0; round < most_rounds && report.slopes.found() && !arrived(report); ++round) {
    if (options.stop && options.stop->load()) break;
    if ((leaves_free(report) && round > 0) || misses_by_far(report)) break;
    if (crawls_over_noise(report, problem, options)) break;
    if (creeps_far_off(report, before)) break;
    if (round > 0 && promises_little(report)) break;
    before = report.chi_squared;
    const bool last = round + 1 == most_rounds;  // at last with slopes by differences all the way
    const KnownSlopes known{best.end, best.prediction, report.slopes};
    const Descent further =
        descend(last ? problem : with_secants(problem, {.known = known}), best.end,
                {.most_iterations = last && report.noise < smooth ? 60 : 8,
                 .radius = last || report.noise > smooth ? DescentOptions{}.radius : radius_near_the_end,
                 .held = pressed_on_bounds(report),
                 .stop = options.stop});
    if (!further.found() || !(further.misfit < best.misfit)) {
      round = std::max(round, most_rounds - 2);
      continue;
    }
    const Eigen::VectorXd moved = scaled_point(problem, further.end) - scaled_point(problem, best.end);
    const bool near = (moved.array().abs() <= beside * report.errors.deviations.array()).all();
    const int iterations = best.iterations + further.iterations;
    best = {best.start,  further.end, further.misfit, further.prediction, further.stopped_by_itself,
            further.why, iterations};
    best.met_edge = further.met_edge;
    mind_least_values(problem, best);
    report = near && !last ? report_on(problem, best, descents, report.slopes) : report_on(problem, best, descents);
  }
  if (!crawls_over_noise(report, problem, options)) step_over_noise(problem, best, descents, report);
  return report;
}

/// Whether predictions follow the reciprocal of a parameter rather than it: by those at a value that lies by two
/// standard errors, but a fifth at least and twice at most, above.
bool follows_reciprocal(const FitProblem& problem, const Descent& best, const FitReport& report, std::size_t j) {
  constexpr double errors = 2, least = 0.2, most = 1;
  const double value = best.end[j];
  const FitParameter& parameter = problem.parameters[j];
  if (!parameter.saturates || !(value > 0 && parameter.variable.lowest >= 0)) return false;
  const double deviation = report.parameters[j].standard_error / value;
  const double part = std::isfinite(deviation) ? std::clamp(errors * deviation, least, most) : most;
  FitPoint above = best.end;
  above[j] = std::min(value * (1 + part), parameter.variable.highest);
  const Prediction prediction = problem.predict(above);
  if (!prediction.found() || !(above[j] > value)) return false;
  const Eigen::VectorXd moved = residuals(problem, prediction) - residuals(problem, best.prediction);
  Eigen::VectorXd slope = report.slopes.derivatives.col(static_cast<Eigen::Index>(j));
  for (Eigen::Index i = 0; i < slope.size(); ++i) slope[i] /= problem.data[static_cast<std::size_t>(i)].deviation;
  const double straight = parameter.variable.scaled_step(value, above[j]);
  const double reciprocal =
      reciprocal_at(parameter, value).scaled_step(value, above[j]) * value / parameter.variable.slope(value);
  return slope.dot(moved) / slope.squaredNorm() < 0.5 * (straight + reciprocal);
}

/// The problem in variables that predictions follow as straight lines: profiles end after two or three points there.
std::vector<Variable> straight_variables(const FitProblem& problem, const Descent& best, const FitReport& report) {
  std::vector<Variable> variables = variables_of(problem);
  for (std::size_t j = 0; j < problem.size(); ++j)
    if (follows_reciprocal(problem, best, report, j)) variables[j] = reciprocal_at(problem.parameters[j], best.end[j]);
  return variables;
}

/// The order in which parameters have their profiles: those that saturate first, whose slopes say least of what values
/// are as good.
std::vector<std::size_t> order_of_profiles(const FitProblem& problem) {
  std::vector<std::size_t> order(problem.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_partition(order.begin(), order.end(), [&](std::size_t j) { return problem.parameters[j].saturates; });
  return order;
}

void add_profiles(FitReport& report, const FitProblem& given, const Descent& best, const FitOptions& options,
                  FitPoint& better) {
  const std::vector<Variable> variables = straight_variables(given, best, report);
  const FitProblem problem = in_variables(given, variables);
  const Slopes slopes = in_variables(report.slopes, best.end, variables_of(given), variables);
  const FitErrors errors = fit_errors(problem, best.end, residuals(problem, best.prediction), slopes);
  const double threshold = interval_threshold(problem);
  // At a bound, and on the edge of what has an answer, errors by slopes mean nothing.
  const bool needed = options.known || any_of(report.parameters, [&](const auto& fitted) {
                        return fitted.at_bound != AtBound::no || std::isfinite(fitted.parameter.least);
                      });
  const std::size_t usual =
      needed ? std::numeric_limits<std::size_t>::max() / 2 : usual_solutions(problem, options.limits);
  for (const std::size_t j : order_of_profiles(problem)) {
    if (!better.empty() || (options.stop && options.stop->load())) return;
    Profile& here = report.parameters[j].profile;
    const bool saturates = problem.parameters[j].saturates;  // slopes alone would exclude what is as good
    const std::size_t beginning = saturates ? usual + usual / 3 : usual,
                      most = saturates ? beginning : usual + usual / 6;
    if (problem.ending->solutions() < beginning)
      here = profile(problem, best, slopes, errors, j, threshold, options.stop, most);
    else
      here.complete = false;
    better = here.better;
    if (here.complete) continue;
    here = {};
    report.enough = usual;
  }
}

}  // namespace

double interval_threshold(bool deviations_known, int degrees) {
  const double quantile = two_sided_quantile(confidence, deviations_known ? 0 : degrees);
  return quantile * quantile;
}

double interval_threshold(const FitProblem& problem) {
  return interval_threshold(problem.deviations_known, degrees_of_freedom(problem));
}

namespace {

/// Profiles are for fits that the data bind and that describe them: others need no finer intervals.
bool worth_profiles(FitReport report, const FitProblem& problem) {
  judge(report, problem);
  return report.status >= FitStatus::usable_with_warnings || report.status == FitStatus::did_not_move;
}

/// Whether the fit would say that the model does not describe the data, or knows nothing at all.
bool misses_its_data(FitReport report, const FitProblem& problem) {
  constexpr double far = 4, fifth = 0.2;
  if (!report.slopes.found()) return true;
  judge(report, problem);
  return report.status <= FitStatus::misfit &&
         (report.deviations_known ? report.reduced_chi_squared > far : report.relative_rms > fifth);
}

/// A misfit is believed when an offset or a scale of the data would explain it, or descents from elsewhere end no
/// better.
void doubt_misfit(FitProblem& problem, std::vector<Descent>& descents, FitReport& report, const FitOptions& options) {
  if (options.starts <= 1 || options.known || problem.ending->over() || !misses_its_data(report, problem)) return;
  if (report.slopes.found()) report.misfit_cause = missing_term(problem, report, options);
  if (!report.misfit_cause.empty()) return;
  FitOptions elsewhere = options;
  elsewhere.reach = 2 * options.reach;
  ++elsewhere.seed;
  const double before = best_of(descents).misfit;
  for (Descent& descent : rough_descents(problem, elsewhere)) descents.push_back(std::move(descent));
  constexpr double better = 0.9;
  if (report.slopes.found() && !(best_of(descents).misfit < better * before)) return;
  report = settled(problem, descents, options);
  if (misses_its_data(report, problem) && report.slopes.found())
    report.misfit_cause = missing_term(problem, report, options);
}

}  // namespace

std::size_t usual_solutions(const FitProblem& problem, const FitLimits& limits) {
  constexpr std::size_t usual = 3000, for_each_datum = 60;
  if (limits.solutions < std::numeric_limits<std::size_t>::max()) return limits.solutions;
  return std::max(usual, for_each_datum * problem.data.size());
}

FitReport fit(const FitProblem& given, const FitOptions& wanted) {
  for (const FitParameter& parameter : given.parameters)
    if (!(parameter.start >= parameter.variable.lowest && parameter.start <= parameter.variable.highest))
      throw std::invalid_argument(parameter.name + " = " + std::to_string(parameter.start) +
                                  ": the start must be inside its bounds");
  require_enough_data(given);
  given.ending->begin(wanted.stop, wanted.limits);
  FitOptions options = wanted;
  options.stop = &given.ending->over();
  FitProblem problem = with_loss_scale(given, options);
  std::vector<Descent> descents = rough_descents(problem, options);
  if (!options.known) problem = sized_at(problem, best_of(descents).end);
  FitReport report = settled(problem, descents, options);
  doubt_misfit(problem, descents, report, options);
  constexpr int most_returns = 2;
  for (int returns = 0; options.profiles && report.slopes.found() && worth_profiles(report, problem); ++returns) {
    FitPoint better;
    add_profiles(report, problem, best_of(descents), options, better);
    if (better.empty() || returns == most_returns || report.enough > 0) break;
    descents.push_back(rough_descent(problem, better, options));
    report = settled(problem, descents, options);
  }
  report.interrupted = given.ending->over();
  report.ended = given.ending->why();
  judge(report, problem);
  if (report.status == FitStatus::misfit && options.starts > 1 && report.misfit_cause.empty()) {
    report.misfit_cause = place_of_misfit(report);
    judge(report, problem);
  }
  report.evaluations = problem.log->evaluations();
  report.failures = problem.log->failures();
  report.failure_reasons = problem.log->reasons();
  return report;
}

}  // namespace rollres
