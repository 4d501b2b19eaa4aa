#include "studies/optimise/design_search.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <nlopt.hpp>

namespace rollres {

namespace {

/// An algorithm of NLopt, and what is known of it.
struct KnownAlgorithm {
  nlopt::algorithm of_nlopt;
  AlgorithmTraits traits = {};
};
constexpr AlgorithmTraits smooth_with_constraints{.slopes = true, .own_constraints = true};

const KnownAlgorithm& known(Algorithm algorithm) {
  static constexpr std::array<KnownAlgorithm, ChoiceNames<Algorithm>::names.size()> all{
      {{nlopt::LN_BOBYQA, {.fewest_variables = 2}},
       {nlopt::LN_COBYLA, {.own_constraints = true}},
       {nlopt::LN_NELDERMEAD},
       {nlopt::LN_SBPLX},
       {nlopt::GN_DIRECT_L, {.global = true}},
       {nlopt::GN_CRS2_LM, {.global = true}},
       {nlopt::LD_SLSQP, smooth_with_constraints},
       {nlopt::LD_MMA, smooth_with_constraints},
       {nlopt::LD_CCSAQ, smooth_with_constraints},
       {nlopt::LD_LBFGS, {.slopes = true}}}};
  return all[static_cast<std::size_t>(algorithm)];
}

struct LimitReached {};

/// What NLopt's callbacks share.
struct Run {
  static constexpr double penalty_factor = 10;
  static constexpr double inside = 1e-6;  // constraints are held by so much: NLopt ends on either side of them

  DesignEvaluator& evaluator;
  const DesignScale& scale;
  const DesignSlopes* slopes;
  std::size_t limit;
  bool penalise;  // constraints are part of the value
  std::size_t calls = 0;
  double worst = 0;  // that NLopt was told of a design with a value
  double best = 0;   // merit of the best place
  std::vector<double> best_place = {};
  std::optional<Design> last = {};
  std::vector<double> last_place = {};
  std::exception_ptr error = {};
  bool at_limit = false;

  /// Algorithms that go round in a circle ask for known designs only: so many calls are allowed for each evaluation.
  const Design& at(const std::vector<double>& place) {
    constexpr std::size_t patience = 50;
    if (last && place == last_place) return *last;
    if (evaluator.count().all() >= limit || ++calls > patience * limit) throw LimitReached();
    last = evaluator(scale.from_box(place));
    last_place = place;
    if (last->found()) {
      worst = std::max(worst, told(*last));
      if (const double own = merit(*last); own < best) {
        best = own;
        best_place = place;
      }
    }
    return *last;
  }

  double merit(const Design& design) const {
    double sum = scale.value(design);
    for (const double excess : scale.constraints(design)) sum += penalty_factor * std::max(0.0, excess + inside);
    return sum;
  }
  /// What NLopt is told of a design with a value.
  double told(const Design& design) const { return penalise ? merit(design) : scale.value(design); }

  double penalty(const std::vector<double>& place) const {
    double square = 0;
    for (std::size_t i = 0; i < place.size(); ++i) square += (place[i] - best_place[i]) * (place[i] - best_place[i]);
    return worst + 1 + square;
  }
  std::vector<double> penalty_slope(const std::vector<double>& place) const {
    std::vector<double> slope;
    for (std::size_t i = 0; i < place.size(); ++i) slope.push_back(2 * (place[i] - best_place[i]));
    return slope;
  }

  double value(const std::vector<double>& place, std::vector<double>& slope) {
    const Design& design = at(place);
    if (!slope.empty()) slope = design.found() ? slopes->of_value(design).along : penalty_slope(place);
    return design.found() ? told(design) : penalty(place);
  }

  double constraint(std::size_t j, const std::vector<double>& place, std::vector<double>& slope) {
    const Design& design = at(place);
    if (!slope.empty()) slope = design.found() ? slopes->of_constraint(design, j).along : penalty_slope(place);
    return design.found() ? scale.constraints(design)[j] + inside : 1;
  }

  /// Lets no exception through to NLopt but its own, and nothing that is not finite.
  template <class Function>
  double guarded(Function function) {
    try {
      const double value = function();
      return std::isfinite(value) ? value : worst + 1;
    } catch (const LimitReached&) {
      at_limit = true;
    } catch (...) {
      error = std::current_exception();
    }
    throw nlopt::forced_stop();
  }
};

double value_of(const std::vector<double>& place, std::vector<double>& slope, void* data) {
  Run& run = *static_cast<Run*>(data);
  return run.guarded([&] { return run.value(place, slope); });
}

struct ConstraintOf {
  Run* run;
  std::size_t constraint;
};

double excess_of(const std::vector<double>& place, std::vector<double>& slope, void* data) {
  const auto& [run, j] = *static_cast<ConstraintOf*>(data);
  return run->guarded([&, j = j, run = run] { return run->constraint(j, place, slope); });
}

}  // namespace

AlgorithmTraits traits(Algorithm algorithm) { return known(algorithm).traits; }

SearchEnd search(DesignEvaluator& evaluator, const DesignScale& scale, const Design& start,
                 const SearchOptions& options, const DesignSlopes* slopes) {
  const AlgorithmTraits kind = traits(options.algorithm);
  const std::size_t constraints = start.constraints.size();
  const bool smooth = options.algorithm == Algorithm::bobyqa || options.algorithm == Algorithm::lbfgs;
  const bool lagrangian = constraints > 0 && !kind.own_constraints && smooth;
  Run run{evaluator, scale, slopes, options.evaluations, constraints > 0 && !kind.own_constraints && !smooth};
  run.worst = run.told(start);
  run.best = run.merit(start);
  run.best_place = scale.to_box(start.point);

  const auto size = static_cast<unsigned>(scale.size());
  const auto prepared = [&](nlopt::algorithm algorithm) {
    nlopt::opt search(algorithm, size);
    search.set_lower_bounds(0);
    search.set_upper_bounds(1);
    search.set_xtol_abs(options.tolerance);
    search.set_ftol_abs(0.01 * options.tolerance);
    search.set_initial_step(options.step);
    return search;
  };
  constexpr unsigned long seed = 1;  // crs2 draws at random, but the same every time
  nlopt::srand(seed);
  nlopt::opt nlopt_search = prepared(lagrangian ? nlopt::AUGLAG : known(options.algorithm).of_nlopt);
  if (lagrangian) nlopt_search.set_local_optimizer(prepared(known(options.algorithm).of_nlopt));
  nlopt_search.set_min_objective(value_of, &run);
  std::vector<ConstraintOf> each(constraints);
  for (std::size_t j = 0; j < constraints; ++j) {
    each[j] = {&run, j};
    if (!run.penalise) nlopt_search.add_inequality_constraint(excess_of, &each[j], 0);
  }

  std::vector<double> place = scale.to_box(start.point);
  double value = 0;
  try {
    nlopt_search.optimize(place, value);
  } catch (const std::exception&) {
    if (run.error) std::rethrow_exception(run.error);
    return run.at_limit ? SearchEnd::limit : SearchEnd::failed;
  }
  return SearchEnd::tolerance;
}

}  // namespace rollres
