#include "fitting/fit/fit_starts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <utility>

#include "fitting/descent/latin_hypercube.hpp"
#include "fitting/descent/secant_slopes.hpp"
#include "fitting/errors/fit_errors.hpp"
#include "fitting/errors/statistics.hpp"

namespace rollres {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
double misfit_of(const FitProblem& problem, const Prediction& prediction) {
  if (!prediction.found()) return infinite;
  const double found = misfit(problem, residuals(problem, prediction));
  return std::isfinite(found) ? found : infinite;
}

/// The given start, what is suggested, and points between.
std::vector<FitPoint> candidates_of(const FitProblem& problem, const FitOptions& options) {
  const Eigen::Index for_each_start = problem.estimate ? 3 : 5;
  std::vector<FitPoint> points = problem.suggestions;
  points.push_back(start_point(problem));
  const std::vector<UsualSpan> spans = spans_of(problem, options);
  const Eigen::MatrixXd sample =
      latin_hypercube(for_each_start * (options.starts - 1), std::ssize(spans), options.seed);
  for (Eigen::Index row = 0; row < sample.rows(); ++row) {
    Eigen::VectorXd scaled(std::ssize(spans));
    for (Eigen::Index j = 0; j < scaled.size(); ++j) {
      const UsualSpan& span = spans[static_cast<std::size_t>(j)];
      scaled[j] = span.lowest + sample(row, j) * (span.highest - span.lowest);
    }
    points.push_back(point_of(problem, scaled));
  }
  return points;
}

/// Those of which a closed form does not say that they are far worse than others, and the given start.
std::vector<FitPoint> not_far_worse(const FitProblem& problem, std::vector<FitPoint> points) {
  if (!problem.estimate) return points;
  constexpr double far_worse = 30;
  std::vector<double> misfits;
  for (const FitPoint& point : points) misfits.push_back(misfit_of(problem, problem.estimate(point, {})));
  const double best = *min_element(misfits);
  const FitPoint own = start_point(problem);
  std::vector<FitPoint> left;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (misfits[i] <= far_worse * best || points[i] == own) left.push_back(std::move(points[i]));
  return left;
}

}  // namespace

std::vector<UsualSpan> spans_of(const FitProblem& problem, const FitOptions& options) {
  constexpr double beside_closed_forms = 1;
  std::vector<UsualSpan> spans;
  for (std::size_t j = 0; j < problem.size(); ++j) {
    const FitParameter& parameter = problem.parameters[j];
    const Variable& variable = parameter.variable;
    const FitPoint* const suggested = problem.suggestions.empty() ? nullptr : &problem.suggestions.front();
    const bool closed = suggested && (*suggested)[j] != parameter.start;
    const double centre = variable.scaled(closed ? (*suggested)[j] : parameter.start);
    const double reach = closed ? beside_closed_forms : std::log(options.reach);
    UsualSpan span{centre - reach, centre + reach};
    if (std::isfinite(parameter.usual_lowest))
      span = {variable.scaled(parameter.usual_lowest), variable.scaled(parameter.usual_highest)};
    span.lowest = std::clamp(span.lowest, variable.scaled(variable.lowest), variable.scaled(variable.highest));
    span.highest = std::clamp(span.highest, span.lowest, variable.scaled(variable.highest));
    spans.push_back(span);
  }
  return spans;
}

std::vector<std::size_t> few_rows(const FitProblem& problem) {
  std::vector<std::size_t> measured;
  std::set<std::size_t> rows;
  for (std::size_t i = 0; i < problem.data.size(); ++i) {
    if (problem.data[i].prior())
      rows.insert(i);
    else
      measured.push_back(i);
  }
  const std::size_t wanted = std::max<std::size_t>(8, 2 * problem.size() + 2), all = measured.size();
  if (!problem.model.by_rows || 2 * wanted > all) return {};
  constexpr double golden = 0.6180339887498949;
  std::set<std::size_t> chosen{0, all - 1};
  for (double turns = 0.5; chosen.size() < wanted; turns += golden)
    chosen.insert(static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(all)));
  for (const std::size_t place : chosen) rows.insert(measured[place]);
  return {rows.begin(), rows.end()};
}

bool beside(const FitProblem& problem, const FitPoint& a, const FitPoint& b, double distance) {
  return ((scaled_point(problem, a) - scaled_point(problem, b)).array().abs() < distance).all();
}

FitProblem small_problem(const FitProblem& problem) {
  const std::vector<std::size_t> rows = few_rows(problem);
  return rows.empty() ? problem : part_of(problem, rows);
}

std::vector<FitPoint> starts_of(const FitProblem& given, const FitOptions& options) {
  if (options.starts <= 1 || options.known) return {start_point(given)};
  const FitProblem problem = in_logarithms(given), small = small_problem(problem);
  struct Candidate {
    FitPoint point;
    double misfit;
  };
  std::vector<Candidate> candidates;
  for (const FitPoint& point : not_far_worse(problem, candidates_of(problem, options)))
    if (const double here = misfit_of(small, small.predict(point)); std::isfinite(here))
      candidates.push_back({point, here});
  stable_sort(candidates, [](const Candidate& a, const Candidate& b) { return a.misfit < b.misfit; });
  constexpr double twice = 0.69;
  std::vector<FitPoint> starts;
  for (const Candidate& candidate : candidates) {
    if (std::ssize(starts) == options.starts) break;
    if (none_of(starts, [&](const FitPoint& start) { return beside(problem, start, candidate.point, twice); }))
      starts.push_back(candidate.point);
  }
  // Who gives a start knows something: closed forms may have led all others to another least misfit.
  const FitPoint own = start_point(given);
  const bool answered = any_of(candidates, [&](const Candidate& one) { return one.point == own; });
  if (answered && none_of(starts, [&](const FitPoint& start) { return beside(problem, start, own, twice); })) {
    if (std::ssize(starts) == options.starts) starts.pop_back();
    starts.push_back(own);
  }
  if (starts.empty()) starts.push_back(own);
  return starts;
}

}  // namespace rollres
