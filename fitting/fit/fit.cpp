#include "fitting/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "fitting/descent/latin_hypercube.hpp"
#include "fitting/errors/statistics.hpp"

namespace rollres {

namespace {

/// Rows that a descent from afar can do with: few, spread over the table without a period that it could share.
std::vector<std::size_t> few_rows(const FitProblem& problem) {
  const std::size_t all = problem.data.size(), wanted = std::max<std::size_t>(8, 2 * problem.size() + 2);
  if (!problem.predict_rows || 2 * wanted > all) return {};
  constexpr double golden = 0.6180339887498949;
  std::set<std::size_t> rows{0, all - 1};
  for (double turns = 0.5; rows.size() < wanted; turns += golden)
    rows.insert(static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(all)));
  return {rows.begin(), rows.end()};
}

constexpr double near_the_end = 1e6;  // radius of a descent from close by: Gauss and Newton's steps

/// A descent that will be gone on with: first by a few rows; by slopes that cost half as much, evaluated only where
/// secants are not good enough; and no farther than they are worth. Where rough slopes do not exist, by the problem's
/// own.
Descent rough_descent(const FitProblem& problem, const FitPoint& start, const FitOptions& options) {
  constexpr double tolerance = 1e-3, trusted_miss = 0.5;
  const auto roughly = [&problem](const FitPoint& point, const Prediction& prediction) {
    Slopes slopes = rough_differences(problem, point, prediction);
    return slopes.found() ? slopes : problem.differentiate(point, prediction);
  };
  FitPoint begin = start;
  int iterations = 0;
  double radius = DescentOptions{}.radius;
  if (const std::vector<std::size_t> rows = few_rows(problem); !rows.empty() && !options.known) {
    const FitProblem quick = with_secants(part_of(problem, rows), {.trusted_miss = trusted_miss});
    const Descent few = descend(quick, start, {.tolerance = 1e-2, .stop = options.stop});
    if (few.found()) begin = few.end;
    iterations = few.iterations;
  }
  const FitProblem quick =
      with_secants(problem, {.known = options.known, .trusted_miss = trusted_miss, .evaluate = roughly});
  if (options.known || iterations > 0) radius = near_the_end;
  Descent answer = descend(quick, begin, {.tolerance = tolerance, .radius = radius, .stop = options.stop});
  answer.start = start;
  answer.iterations += iterations;
  return answer;
}

/// The other starts: the best quarter of the points of a Latin hypercube.
std::vector<FitPoint> other_starts(const FitProblem& problem, const FitOptions& options) {
  const int wanted = options.starts - 1;
  if (wanted <= 0) return {};
  constexpr int tried_for_each = 4;
  const double reach = std::log(options.reach);
  const Eigen::VectorXd centre = scaled_point(problem, start_point(problem));
  Eigen::VectorXd lowest = centre.array() - reach, highest = centre.array() + reach;
  for (std::size_t j = 0; j < problem.size(); ++j) {
    const Variable& variable = problem.parameters[j].variable;
    const auto k = static_cast<Eigen::Index>(j);
    lowest[k] = std::max(lowest[k], variable.scaled(variable.lowest));
    highest[k] = std::min(highest[k], variable.scaled(variable.highest));
  }
  struct Candidate {
    FitPoint point;
    double misfit;
  };
  std::vector<Candidate> candidates;
  const Eigen::MatrixXd sample = latin_hypercube(tried_for_each * wanted, centre.size(), options.seed);
  for (Eigen::Index row = 0; row < sample.rows(); ++row) {
    const Eigen::VectorXd unit = sample.row(row);
    const FitPoint point = point_of(problem, lowest + unit.cwiseProduct(highest - lowest));
    const Prediction prediction = problem.predict(point);
    if (prediction.found()) candidates.push_back({point, misfit(problem, residuals(problem, prediction))});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.misfit < b.misfit; });
  std::vector<FitPoint> starts;
  for (const Candidate& candidate : candidates)
    if (std::ssize(starts) < wanted) starts.push_back(candidate.point);
  return starts;
}

Descent& best_of(std::vector<Descent>& descents) {
  return *std::min_element(descents.begin(), descents.end(), [](const Descent& a, const Descent& b) {
    const auto size = [](const Descent& d) { return d.found() ? d.misfit : std::numeric_limits<double>::infinity(); };
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

/// Whether Gauss and Newton's step from here is but a small part of the standard errors.
bool arrived(const FitReport& report) {
  constexpr double near = 0.002, exactly = 1e-7;
  for (Eigen::Index j = 0; j < report.errors.step.size(); ++j) {
    const double deviation = report.errors.deviations[j];
    if (std::abs(report.errors.step[j]) > std::max(std::isfinite(deviation) ? near * deviation : 0, exactly))
      return false;
  }
  return true;
}

/// Parameters that the misfit presses against a bound: held, they do not spoil the steps of the others.
std::vector<std::size_t> pressed_on_bounds(const FitReport& report) {
  std::vector<std::size_t> held;
  for (std::size_t j = 0; j < report.errors.at_bound.size(); ++j)
    if (report.errors.at_bound[j] != AtBound::no) held.push_back(j);
  if (held.size() == report.parameters.size()) held.clear();
  return held;
}

/// Gauss and Newton's steps with slopes by differences that suit the noise, where that noise explains why descents end
/// beside the least misfit: at a place where it happens to be low. It changes a sum of squares r^2 by 2 r e.
void step_over_noise(const FitProblem& problem, Descent& best, const std::vector<Descent>& descents,
                     FitReport& report) {
  constexpr int most_steps = 3;
  for (int steps = 0; steps < most_steps && report.slopes.found() && !arrived(report); ++steps) {
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

/// The report on the best descent, which goes on from where it stopped for its rough tolerance: by secants from the
/// slopes of the report, which stay good enough for the errors if this leads less than a third of a standard error
/// away.
FitReport settled(const FitProblem& problem, std::vector<Descent>& descents, const FitOptions& options) {
  Descent& best = best_of(descents);
  FitReport report = report_on(problem, best, descents);
  constexpr int most_rounds = 4;
  constexpr double beside = 0.1, smooth = 1e-5;
  for (int round = 0; round < most_rounds && report.slopes.found() && !arrived(report); ++round) {
    if (options.stop && options.stop->load()) break;
    const bool last = round + 1 == most_rounds;  // at last with slopes by differences all the way
    const KnownSlopes known{best.end, best.prediction, report.slopes};
    const Descent further = descend(last ? problem : with_secants(problem, {.known = known}), best.end,
                                    {.most_iterations = last ? 60 : 8,
                                     .radius = last || report.noise > smooth ? DescentOptions{}.radius : near_the_end,
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
    report = near && !last ? report_on(problem, best, descents, report.slopes) : report_on(problem, best, descents);
  }
  step_over_noise(problem, best, descents, report);
  return report;
}

void add_profiles(FitReport& report, const FitProblem& problem, const Descent& best, const FitOptions& options,
                  FitPoint& better) {
  for (std::size_t j = 0; j < problem.size() && better.empty(); ++j) {
    if (options.stop && options.stop->load()) return;
    report.parameters[j].profile =
        profile(problem, best, report.slopes, report.errors, j, interval_threshold(problem), options.stop);
    better = report.parameters[j].profile.better;
  }
}

}  // namespace

double interval_threshold(const FitProblem& problem) {
  const double quantile = two_sided_quantile(confidence, problem.deviations_known ? 0 : degrees_of_freedom(problem));
  return quantile * quantile;
}

FitReport fit(const FitProblem& given, const FitOptions& options) {
  for (const FitParameter& parameter : given.parameters)
    if (!(parameter.start >= parameter.variable.lowest && parameter.start <= parameter.variable.highest))
      throw std::invalid_argument(parameter.name + " = " + std::to_string(parameter.start) +
                                  ": the start must be inside its bounds");
  const FitProblem problem = with_loss_scale(given, options);
  std::vector<FitPoint> starts{start_point(problem)};
  for (FitPoint& start : other_starts(problem, options)) starts.push_back(std::move(start));
  std::vector<Descent> descents;
  for (const FitPoint& start : starts) {
    if (!descents.empty() && options.stop && options.stop->load()) break;
    descents.push_back(rough_descent(problem, start, options));
  }
  FitReport report = settled(problem, descents, options);
  constexpr int most_returns = 2;
  for (int returns = 0; options.profiles && report.slopes.found(); ++returns) {
    FitPoint better;
    add_profiles(report, problem, best_of(descents), options, better);
    if (better.empty() || returns == most_returns) break;
    descents.push_back(rough_descent(problem, better, options));
    report = settled(problem, descents, options);
  }
  report.interrupted = options.stop && options.stop->load();
  judge(report, problem);
  report.evaluations = problem.log->evaluations();
  report.failures = problem.log->failures();
  report.failure_reasons = problem.log->reasons();
  return report;
}

}  // namespace rollres
