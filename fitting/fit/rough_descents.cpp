#include "fitting/fit/rough_descents.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "fitting/descent/secant_slopes.hpp"
#include "fitting/errors/fit_errors.hpp"
#include "fitting/errors/statistics.hpp"
#include "fitting/fit/fit_starts.hpp"

namespace rollres {

namespace {

constexpr double no_misfit = std::numeric_limits<double>::infinity();

/// The problem for descents from afar: in logarithms, and no farther than twice the usual values, or the starts. Beyond
/// them lie scenes that cost a hundred times as much and describe no body that rolls; who ends there goes on by itself.
FitProblem from_afar(const FitProblem& given) {
  constexpr double twice = 2;
  FitProblem problem = in_logarithms(given);
  for (std::size_t j = 0; j < problem.size(); ++j) {
    const FitParameter& parameter = given.parameters[j];
    if (!std::isfinite(parameter.usual_lowest)) continue;
    double lowest = std::min(parameter.usual_lowest, parameter.start);
    double highest = std::max(parameter.usual_highest, parameter.start);
    for (const FitPoint& suggestion : given.suggestions) {
      lowest = std::min(lowest, suggestion[j]);
      highest = std::max(highest, suggestion[j]);
    }
    Variable& variable = problem.parameters[j].variable;
    variable.lowest = std::max(variable.lowest, lowest / twice);
    variable.highest = std::min(variable.highest, highest * twice);
  }
  return problem;
}

/// A rough descent, the slopes near its end, and what they say; nothing where there are too few data for that.
struct Way {
  Descent descent;
  std::optional<KnownSlopes> known = {};
  std::optional<FitErrors> errors = {};
};

/// Down by slopes that cost half as much, evaluated only where secants are not good enough.
/// @param known  slopes near the start, if there are any
Way way_down(const FitProblem& problem, const FitPoint& start, const FitOptions& options, DescentOptions how,
             const std::optional<KnownSlopes>& known) {
  constexpr double trusted_miss = 0.5;
  // The problem's own slopes measure its noise where they are first asked for: of several starts none that is far off.
  const auto roughly = [&problem, &options](const FitPoint& point, const Prediction& prediction) {
    Slopes slopes = rough_differences(problem, point, prediction);
    return slopes.found() || options.starts > 1 ? slopes : problem.differentiate(point, prediction);
  };
  const auto latest = std::make_shared<std::optional<KnownSlopes>>();
  const FitProblem quick =
      with_secants(problem, {.known = known, .trusted_miss = trusted_miss, .evaluate = roughly, .latest = latest});
  // A change of the misfit by a twentieth of what a standard error makes is worth no step.
  how.tolerance = std::max(how.tolerance, 0.05 / std::max(1, degrees_of_freedom(problem)));
  how.stop = options.stop;
  Way way{descend(quick, start, how)};
  way.known = *latest;
  const int degrees = degrees_of_freedom(problem);
  if (way.descent.found() && *latest && (degrees > 0 || (degrees == 0 && problem.deviations_known)))
    way.errors = fit_errors(problem, way.descent.end, residuals(problem, way.descent.prediction), (*latest)->slopes);
  return way;
}

constexpr DescentOptions by_few_rows{.tolerance = 3e-2}, by_all_rows{.most_iterations = 20, .tolerance = 1e-3};

/// By all rows from where a descent by a few of them ended.
Descent further(const FitProblem& problem, const Descent& few, const FitOptions& options, double rival) {
  DescentOptions how = by_all_rows;
  how.radius = radius_near_the_end;
  how.rival = rival;
  Descent answer = way_down(problem, few.found() ? few.end : few.start, options, how, options.known).descent;
  answer.start = few.start;
  answer.iterations += few.iterations;
  return answer;
}

bool explains(const FitProblem& problem, const Descent& descent) {
  constexpr double least_p = 1e-3, small = 0.1;
  const int degrees = degrees_of_freedom(problem);
  if (problem.deviations_known) return degrees > 0 && chi_squared_tail(descent.misfit, degrees) > least_p;
  double squares = 0;
  for (std::size_t i = 0; i < problem.data.size(); ++i)
    squares += std::pow(descent.prediction.values[static_cast<Eigen::Index>(i)] / problem.data[i].value - 1, 2);
  return squares < small * small * static_cast<double>(problem.data.size());
}

/// The variance of a residual by the least misfit that is known: 1 as far as deviations are and explain it.
double scatter(const FitProblem& problem, double misfit) {
  const double reduced = misfit / std::max(1, degrees_of_freedom(problem));
  return problem.deviations_known ? std::max(1.0, reduced) : reduced;
}

/// The parameter that alone makes up the weakest direction, if that is free: the data feel it no longer.
std::optional<std::size_t> idle_parameter(const FitErrors& errors) {
  constexpr double alone = 0.95;
  Eigen::Index largest = 0;
  if (errors.weakest_deviation < 1 || errors.weakest.cwiseAbs().maxCoeff(&largest) < alone) return std::nullopt;
  return static_cast<std::size_t>(largest);
}

/// A point with one parameter back at usual values, three over their span.
std::vector<FitPoint> with_other_values(const FitProblem& problem, const FitPoint& point, std::size_t parameter,
                                        const FitOptions& options) {
  const UsualSpan span = spans_of(problem, options)[parameter];
  std::vector<FitPoint> points;
  for (const double part : {0.2, 0.45, 0.7}) {
    points.push_back(point);
    points.back()[parameter] =
        problem.parameters[parameter].variable.value(span.lowest + part * (span.highest - span.lowest));
  }
  return points;
}

double misfit_of(const Way& way) { return way.descent.found() ? way.descent.misfit : no_misfit; }

/// Down from each start.
std::vector<Way> ways_down(const FitProblem& problem, const std::vector<FitPoint>& starts, const FitOptions& options,
                           const DescentOptions& how) {
  constexpr double free_by_far = 2;
  std::vector<Way> ways;
  double best = no_misfit;
  for (std::size_t k = 0; k < starts.size() && !(k > 0 && options.stop && options.stop->load()); ++k) {
    DescentOptions own = how;
    if (std::isfinite(best)) own.rival = best;
    ways.push_back(way_down(problem, starts[k], options, own, options.known));
    best = std::min(best, misfit_of(ways.back()));
    const std::optional<FitErrors>& errors = ways.back().errors;
    if (k > 0 || !errors || errors->weakest_deviation < free_by_far) continue;
    if (!idle_parameter(*errors) && explains(problem, ways.front().descent)) break;
  }
  return ways;
}

void sort_by_misfit(std::vector<Way>& ways) {
  stable_sort(ways, [](const Way& a, const Way& b) { return misfit_of(a) < misfit_of(b); });
}

/// From the best end with one parameter held at values all over its usual ones, each from where the one before ended,
/// beginning where it acts least; then from the two best with that parameter free.
void add_values_of(std::vector<Way>& ways, const FitProblem& problem, std::size_t parameter, const FitOptions& options,
                   const DescentOptions& how) {
  constexpr int values = 5;
  constexpr std::size_t freed = 2;
  if (!ways.front().descent.found()) return;
  const UsualSpan span = spans_of(problem, options)[parameter];
  DescentOptions holding = how;
  holding.held = {parameter};
  FitPoint from = ways.front().descent.end;
  std::optional<KnownSlopes> known = ways.front().known;
  std::vector<Way> held;
  for (int k = values; k-- > 0 && !(options.stop && options.stop->load());) {
    from[parameter] =
        problem.parameters[parameter].variable.value(span.lowest + (span.highest - span.lowest) * k / (values - 1.0));
    Way way = way_down(problem, from, options, holding, known);
    if (!way.descent.found()) continue;  // too little friction for the drive, as an example
    from = way.descent.end;
    known = way.known;
    held.push_back(std::move(way));
  }
  sort_by_misfit(held);
  for (std::size_t k = 0; k < std::min(freed, held.size()); ++k)
    ways.push_back(way_down(problem, held[k].descent.end, options, how, held[k].known));
}

/// Whether two ways from apart lead to one place that explains the data and binds a parameter: its other values need no
/// trial. The best way first.
bool is_bound_by_two(const FitProblem& problem, const std::vector<Way>& ways, std::size_t parameter) {
  constexpr double same_place = 0.2, little = 0.1, narrow = 0.3;
  const Way& best = ways.front();
  if (!best.errors || !explains(problem, best.descent)) return false;
  if (!(best.errors->deviations[static_cast<Eigen::Index>(parameter)] < narrow)) return false;
  return std::any_of(ways.begin() + 1, ways.end(), [&](const Way& other) {
    return misfit_of(other) - best.descent.misfit < little * scatter(problem, best.descent.misfit) &&
           beside(problem, other.descent.end, best.descent.end, same_place);
  });
}

/// The ways down from all starts, and from other values of a parameter that the best end no longer feels or that may
/// act no longer; the best first.
std::vector<Way> all_ways_down(const FitProblem& problem, const std::vector<FitPoint>& starts,
                               const FitOptions& options, const DescentOptions& how) {
  std::vector<Way> ways = ways_down(problem, starts, options, how);
  sort_by_misfit(ways);
  bool tried = false;
  for (std::size_t j = 0; j < problem.size(); ++j)
    if (problem.parameters[j].saturates && !is_bound_by_two(problem, ways, j)) {
      add_values_of(ways, problem, j, options, how);
      sort_by_misfit(ways);
      tried = true;
    }
  if (tried || !ways.front().errors) return ways;
  if (const std::optional<std::size_t> idle = idle_parameter(*ways.front().errors)) {
    DescentOptions holding = how;
    holding.held = {*idle};
    const Descent end = way_down(problem, ways.front().descent.end, options, holding, {}).descent;
    for (Way& way : ways_down(problem, with_other_values(problem, end.end, *idle, options), options, how))
      ways.push_back(std::move(way));
    sort_by_misfit(ways);
  }
  return ways;
}

/// The ways by a few rows, the best of them followed by all rows.
std::vector<Descent> by_few_then_all(const FitProblem& problem, const std::vector<std::size_t>& rows,
                                     const std::vector<FitPoint>& starts, const FitOptions& options) {
  constexpr double same_place = 0.5, worse = 0.5;
  constexpr std::size_t most_followed = 2;
  const FitProblem part = part_of(problem, rows);
  const std::vector<Way> ways = all_ways_down(part, starts, options, by_few_rows);
  const Descent few = ways.front().descent;
  std::vector<Descent> descents{further(problem, few, options, RollingSolution::absent)};
  std::size_t followed = 1;
  for (std::size_t k = 1; k < ways.size(); ++k) {
    const Descent& other = ways[k].descent;
    const bool close = other.found() && other.misfit - few.misfit < worse * scatter(part, few.misfit);
    if (close && beside(problem, other.end, few.end, same_place)) {
      descents.push_back(descents.front());
    } else if (close && followed < most_followed && descents.front().found()) {
      descents.push_back(further(problem, other, options, descents.front().misfit));
      ++followed;
    } else {
      descents.push_back(other);
      descents.back().abandoned = true;
      descents.back().misfit = descents.front().misfit * other.misfit / few.misfit;  // of all rows, about
    }
    descents.back().start = other.start;
  }
  return descents;
}

/// The rows, with some of those that had no prediction where a descent by the others ended.
std::vector<std::size_t> with_unanswered(std::vector<std::size_t> rows, const Descent& descent) {
  constexpr std::size_t most = 4;
  std::size_t added = 0;
  for (Eigen::Index i = 0; i < descent.prediction.values.size() && added < most; ++i) {
    const auto row = static_cast<std::size_t>(i);
    if (std::isfinite(descent.prediction.values[i]) || contains(rows, row)) continue;
    rows.push_back(row);
    ++added;
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

}  // namespace

Descent rough_descent(const FitProblem& given, const FitPoint& start, const FitOptions& options) {
  const FitProblem problem = options.known ? given : in_logarithms(given);
  const std::vector<std::size_t> rows = options.known ? std::vector<std::size_t>() : few_rows(problem);
  if (rows.empty()) {
    DescentOptions how = by_all_rows;
    if (options.known) how.radius = radius_near_the_end;
    return way_down(problem, start, options, how, options.known).descent;
  }
  return further(problem, way_down(part_of(problem, rows), start, options, by_few_rows, options.known).descent, options,
                 RollingSolution::absent);
}

std::vector<Descent> rough_descents(const FitProblem& given, const FitOptions& options) {
  const std::vector<FitPoint> starts = starts_of(given, options);
  if (starts.size() == 1) return {rough_descent(given, starts.front(), options)};
  const FitProblem problem = from_afar(given);
  std::vector<std::size_t> rows = few_rows(problem);
  std::vector<Descent> descents;
  if (rows.empty()) {
    for (Way& way : all_ways_down(problem, starts, options, by_all_rows)) descents.push_back(std::move(way.descent));
    return descents;
  }
  constexpr int most_rounds = 3;
  for (int round = 0; round < most_rounds; ++round) {
    descents = by_few_then_all(problem, rows, starts, options);
    const std::vector<std::size_t> more = with_unanswered(rows, descents.front());
    if (descents.front().found() || more.size() == rows.size()) break;
    rows = more;  // where some have no answer the few rows must know it
  }
  return descents;
}

}  // namespace rollres
