#include "core/zones/pattern_refinement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/estimate/grid_choice.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/stated_error.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/zones/spectral_start.hpp"
#include "core/zones/spectral_work.hpp"
#include "core/zones/surface_panels.hpp"

namespace rollres {

namespace {

constexpr int most_coefficients = 160, largest_first_order = 80;
constexpr double smallest_residual = 1e-14, rounded_tail = 1e-12;  // a tail: last coefficients over the largest
// Violations between graded points: which the error then counts; seen at once.
constexpr double tolerated_between = 0.01, plainly_wrong = 0.01;
/// Orders of graded points at which edges are found and patterns refuted for little work, residuals and evaluations.
constexpr std::array<int, 2> sketch_orders{14, 22};
constexpr double first_sketch_residual = 1e-5, sketch_residual = 1e-7;
constexpr int most_to_sketch = 30, most_to_find = 60;  // evaluations, where nothing is known of a pattern
constexpr double fewest_unsketched = 31;               // coefficients, where zones are too short for these
constexpr double fewest_from_grid = 40;    // the same, not to lose the edges that a grid tells better than few points
constexpr int most_stays = 3;              // checks of all laws that find no smaller violation
constexpr double finer_than_grids = 1e-7;  // expected change of R_r [1]
/// Of the last coefficients and of a violation that more of them may mend, from one order to the next.
constexpr double slowest_fall = 0.9, slowest_mending = 0.8;
constexpr double order_growth = 1.4, graded_growth = 1.25;
/// The order of the next round; edges from few graded points tell the first change only roughly.
double next_order(double coefficients, bool graded) {
  return (graded ? graded_growth : order_growth) * coefficients + 2;
}

}  // namespace

/// The orders of one pattern as they rise.
struct PatternRefinement::Rise {
  const SlipPattern& pattern;
  EdgeSearch search;
  SpectralEdges edges;
  bool costly, graded;
  double most;          // work
  double coefficients;  // of the next order
  double residual;      // to which its edges are wanted
  bool checked;         // once before the orders suffice, so that a wrong pattern costs no more of them
  bool only_sketched = true;

  // Of the last order.
  double before = RollingSolution::absent, change_before = 1, tail_before = 1;  // its R_r, change and tail
  double coming = 0;                                                            // change to be expected
  OrderResult told = {};
  double error = INFINITY;
  bool enough = false, last = false, falling = false;

  // Of the checks of all laws.
  bool done = false;  // the error was small enough once, and laws were broken
  double least_violation = INFINITY, wrong_before = INFINITY;
  int stays = 0;
};

/// What few graded points tell of a pattern for little work.
struct PatternRefinement::Sketch {
  SpectralEdges edges;
  double coefficients;                                    // to go on with
  double resistance = RollingSolution::absent, tail = 1;  // of the last order
  bool lawful = false, refuted = false;
};

PatternRefinement::PatternRefinement(const ContactModel& model, const CreepSpectrum& creep)
    : model_(model), problem_(model, creep, estimate_contact(model).half_width), accuracy_(model_, problem_) {}

bool PatternRefinement::dear_ring() const {
  const std::vector<ModelLayer>& round = model_.coating.empty() ? model_.foundation : model_.coating;
  return model_.ring() && model_.friction_coefficient > 0 && !model_.tolerance && !round.front().creep.terms.empty();
}

void PatternRefinement::start_from_grid() {
  from_grid_ = true;
  tried_.clear();
}

bool PatternRefinement::refine(const SlipPattern& pattern, const SpectralEdges& edges, const FoundZones* near) {
  last_.reset();
  wrong_runs_.clear();
  tried_.push_back(pattern.slips);
  Rise rise = begin(pattern, edges, near);
  if (rise.graded && from_grid_) {
    rise.coefficients = std::max(rise.coefficients, fewest_from_grid);
  } else if (rise.graded) {
    const Sketch sketch = sketched(rise);
    if (sketch.refuted) return false;
    rise.edges = sketch.edges;
    rise.coefficients = sketch.coefficients;
    rise.checked = sketch.lawful;
    rise.before = sketch.resistance;
    rise.tail_before = sketch.tail;
  }
  while (rise.coefficients <= most_coefficients) {
    require_time();
    if (!solve_order(rise)) break;
    const Verdict verdict = judge(rise);
    if (verdict != Verdict::next_order) return verdict == Verdict::accepted;
    rise.coefficients = next_order(rise.coefficients, rise.graded);
  }
  return take_last_order(rise);
}

PatternRefinement::Rise PatternRefinement::begin(const SlipPattern& pattern, const SpectralEdges& edges,
                                                 const FoundZones* near) const {
  const bool costly = !pattern.one_direction(), graded = problem_.graded(pattern.shear);
  Rise rise{
      .pattern = pattern,
      .search = EdgeSearch(problem_, pattern),
      .edges = edges,
      .costly = costly,
      .graded = graded,
      .most = (graded ? graded_share : 1) * (dear_ring() ? share_of_rings : 1) * most_work,
      // The laws are held to 5e-9 whatever the tolerance: fewer coefficients only cost another round.
      .coefficients = static_cast<double>(first_order(
          problem_, edges, graded ? accuracy_.tolerance() : std::min(accuracy_.tolerance(), 1e-8), pattern.shear)),
      .residual = std::min(1e-9, 0.01 * accuracy_.tolerance()),
      .checked = !costly && !graded};
  if (near) {
    rise.search.take_over(near->search);
    rise.coefficients = std::max(rise.coefficients, (near->coefficients - 2) / order_growth);
  }
  return rise;
}

/// Finds the edges at the next order, and what it tells of the error. @return false where work is used up or there are
/// none
bool PatternRefinement::solve_order(Rise& rise) {
  const auto order = static_cast<int>(rise.coefficients);
  const double work = work_of(problem_, rise.pattern, order);
  if (work_ + 3 * work > rise.most) return false;
  const int affordable = std::min(static_cast<int>((rise.most - work_) / work), last_ ? 400 : most_to_find);
  std::optional<SpectralState> state = searched(rise, rise.edges, order, rise.residual, affordable);
  if (!state || (driven() && !settle_coating(rise, order, *state))) return false;
  last_ = std::move(state);
  rise.edges = last_->edges;
  const double resistance = resistance_of(*last_, model_.radius);
  const double tail = last_->graded ? accuracy_.tail(order) : relative_tail(*last_);
  const double lever = lever_of(*last_, model_.radius), scale = scale_of(*last_, model_.radius);
  const double change = std::abs(resistance - rise.before) / scale;
  // Of graded points the changes may pass through zero: then what the one before let expect counts.
  const double expected = rise.graded ? std::max(change, rise.coming) : change;
  const double falls = std::min(1.0, tail / rise.tail_before);
  rise.error = expected * falls + (1e-15 + last_->residuals.cwiseAbs().maxCoeff()) * lever / scale;
  // With all coefficients there, repeated changes tell better what residuals at the limit of rounding do.
  if (std::max(tail, rise.tail_before) < rounded_tail)
    rise.error = std::min(rise.error, 10 * std::max(change, rise.change_before));
  rise.residual = std::clamp(0.01 * accuracy_.tolerance() * scale / lever, smallest_residual, rise.residual);
  rise.falling = tail < slowest_fall * rise.tail_before;
  if (std::isfinite(change)) rise.coming = change * falls;
  const auto next = static_cast<int>(next_order(rise.coefficients, rise.graded));
  rise.last = next > most_coefficients || work_ + 4 * work_of(problem_, rise.pattern, next) > rise.most;
  const double wanted = rise.last ? accuracy_.largest_change(rise.graded) : accuracy_.wanted_change(rise.graded);
  rise.enough = !(rise.graded && rise.only_sketched) &&
                rise.error <= std::max(wanted, smallest_spectral_tolerance * lever / scale);
  rise.told = {.order = order,
               .error = rise.only_sketched ? INFINITY : rise.error,
               .resistance = resistance,
               .lever = lever,
               .scale = scale};
  rise.only_sketched = false;
  rise.before = resistance;
  rise.change_before = change;
  rise.tail_before = tail;
  return true;
}

/// Checks all laws where the order suffices, or once before.
PatternRefinement::Verdict PatternRefinement::judge(Rise& rise) {
  constexpr double first_check = 1e-4;
  constexpr int should_fall = 30;
  if (!rise.enough && (rise.checked || !(rise.error < first_check)))
    return rise.costly && rise.told.order >= should_fall && !rise.falling ? Verdict::refuted : Verdict::next_order;
  rise.checked = true;
  work_ += work_of_check(problem_, rise.pattern, rise.told.order, rise.edges.contact.half_length());
  AssessedSpectral assessed = settled_and_assessed(rise);
  const bool lawful = accuracy_.in_its_zones(*last_, assessed, rise.told.order);
  if (!lawful) {
    take_over_wrongs(assessed);
    if (last_->graded || assessed.wrong_zone > std::min(plainly_wrong, slowest_mending * rise.wrong_before))
      return Verdict::refuted;
    rise.wrong_before = assessed.wrong_zone;
    rise.checked = false;  // whether more coefficients mend it
  }
  const double imposed = accuracy_.imposed_violation(*last_, assessed);
  if (rise.enough && lawful && !rise.last && accuracy_.misses_tolerance(*last_, assessed, rise.told)) {
    keep_best(assessed, rise);
    return Verdict::next_order;
  }
  if (rise.enough && accept(assessed, rise, rise.done ? borne_violation : held_violation())) return Verdict::accepted;
  if (!rise.enough || rise.error > accuracy_.tolerance()) return Verdict::next_order;
  if (rise.done && !lawful) return Verdict::refuted;
  rise.done = true;
  // Where edges that are not quite in place break laws.
  rise.residual = std::max(0.01 * rise.residual, smallest_residual);
  if (imposed < 0.5 * rise.least_violation)
    rise.least_violation = imposed;
  else if (++rise.stays == most_stays || imposed > 1e-6)
    return Verdict::refuted;
  return Verdict::next_order;
}

/// A tolerance beyond what rounding and work allow leaves the best answer, better than any grid's.
bool PatternRefinement::take_last_order(Rise& rise) {
  if (!last_ || !(rise.told.error <= std::max(finer_than_grids, model_.tolerance.value_or(0)))) return false;
  AssessedSpectral assessed = settled_and_assessed(rise);
  return keep_best(assessed, rise);
}

double PatternRefinement::take_coating(SpectralState& state, const CoatingMoments& now) {
  if (!problem_.side) return 0;
  const CoatingMoments before = problem_.coating_moments;
  const CoatingMoments change{now.pressed - before.pressed, now.sheared - before.sheared};
  problem_.coating_moments = now;
  state.driving_force -= problem_.shape.of_coating() * change.pressed;
  state.driving_torque += model_.radius * problem_.shape.of_coating() * change.in_torque();
  return coating_in_drive(model_, change);
}

bool PatternRefinement::driven() const { return model_.friction_coefficient > 0 && model_.drive != Drive::rotation; }

/// Checks the last state. Where the drive does not ask for M and N they matter to R_r alone, and orders tell the rest.
AssessedSpectral PatternRefinement::settled_and_assessed(Rise& rise) {
  const SpectralSurface surface(problem_, *last_);
  if (!driven()) {
    take_coating(*last_, surface.coating);
    rise.told.resistance = rise.before = resistance_of(*last_, model_.radius);
  }
  return assess(problem_, *last_, surface);
}

/// Makes a state one whose M and N are those that the drive's row knows: the search goes on, as they hardly depend on
/// it. @return false where it leads nowhere
bool PatternRefinement::settle_coating(Rise& rise, int order, SpectralState& state) {
  constexpr int most_passes = 8;
  constexpr double negligible = 0.02 * largest_violation;  // of the load
  for (int pass = 1; problem_.side; ++pass) {
    const double change = take_coating(state, coating_moments(problem_, state));
    if (std::abs(change) <= negligible * state.load || pass == most_passes) break;
    std::optional<SpectralState> next = searched(rise, state.edges, order, rise.residual, most_to_find);
    if (!next) return false;
    state = *std::move(next);
  }
  return true;
}

/// Takes the last state for the answer if all laws hold and none before was surer of itself.
bool PatternRefinement::keep_best(AssessedSpectral& assessed, const Rise& rise) {
  const bool better = !best_ || accuracy_.estimate(*last_, assessed, rise.told) * rise.told.scale <
                                    best_->solution.rolling_resistance_error;
  if (better) accept(assessed, rise, held_violation());
  return answered();
}

bool PatternRefinement::answered() const {
  const double finer = 1.25 * accuracy_.over_change() * finer_than_grids + problem_.left_out;
  return best_ && best_->solution.rolling_resistance_error <= std::max(finer, model_.tolerance.value_or(0)) * scale_;
}

bool PatternRefinement::accept(AssessedSpectral& assessed, const Rise& rise, double held) {
  const OrderResult& told = rise.told;
  const double largest =
      std::max(held, last_->graded ? tolerated_between : accuracy_.between_points(*last_, told.order));
  if (!accuracy_.in_its_zones(*last_, assessed, told.order) || !(assessed.violation < largest) ||
      !(accuracy_.imposed_violation(*last_, assessed) < held))
    return false;
  const double relative = accuracy_.estimate(*last_, assessed, told);
  RollingSolution& solution = assessed.solution;
  solution.peak_pressure_error = accuracy_.peak_error(*last_, assessed, told);
  solution.rolling_resistance_error = relative * told.scale + problem_.left_out * std::abs(told.resistance);
  solution.error_estimate = solution.rolling_resistance_error / std::abs(told.resistance);
  scale_ = told.scale;
  best_ = std::move(assessed);
  zones_ = {last_->pattern, last_->edges, static_cast<double>(told.order), rise.search.slopes(),
            problem_.coating_moments};
  return true;
}

SpectralOutcome PatternRefinement::take_best() {
  RollingSolution& solution = best_->solution;
  solution.method = Method::spectral;
  solution.status = Status::converged;
  solution.iterations = evaluations_;
  if (model_.tolerance && solution.rolling_resistance_error > *model_.tolerance * scale_)
    solution.warnings.push_back(
        tolerance_missed(*model_.tolerance, solution, message_text(solution.contact_nodes, " coefficients")));
  SpectralOutcome found{std::move(solution), {}};
  if (model_.friction_coefficient > 0) found.zones = std::move(zones_);
  return found;
}

PatternRefinement::Sketch PatternRefinement::sketched(Rise& rise) {
  const SpectralEdges start = rise.edges;
  Sketch sketch{start, rise.coefficients};
  for (const int order : sketch_orders) {
    if (sketch.coefficients <= order || sketch.lawful) break;
    const double residual = order == sketch_orders.front() ? first_sketch_residual : sketch_residual;
    const int affordable = static_cast<int>((rise.most - work_) / work_of(problem_, rise.pattern, order));
    std::optional<SpectralState> state =
        searched(rise, sketch.edges, order, residual, std::min(most_to_sketch, affordable));
    if (!state) {
      sketch = {start, std::max(rise.coefficients, fewest_unsketched)};  // edges from too few points lead astray
      break;
    }
    sketch.edges = state->edges;
    sketch.resistance = resistance_of(*state, model_.radius);
    sketch.tail = accuracy_.tail(order);
    const double lever = lever_of(*state, model_.radius) / scale_of(*state, model_.radius);
    const double accuracy =
        std::max(accuracy_.wanted_change(true) * std::min(1 / lever, 1.0), smallest_spectral_tolerance);
    sketch.coefficients =
        std::clamp(graded_order(problem_, sketch.edges.contact, accuracy), order, largest_first_order);
    const auto final_order = [&] { return static_cast<int>(next_order(sketch.coefficients, true)); };
    while (model_.tolerance && sketch.coefficients < largest_first_order &&
           accuracy_.usual_error(final_order(), lever) > 0.5 * *model_.tolerance)
      ++sketch.coefficients;
    last_ = std::move(state);
    if (order == sketch_orders.front()) continue;  // too few points to refute anything
    work_ += work_of_check(problem_, rise.pattern, order, sketch.edges.contact.half_length());
    const AssessedSpectral assessed = assess(problem_, *last_);
    sketch.lawful = assessed.wrong_zone < accuracy_.field_error(final_order());
    sketch.refuted = assessed.wrong_zone > accuracy_.refuted_at(order);
    if (!sketch.refuted) continue;
    take_over_wrongs(assessed);
    break;
  }
  return sketch;
}

/// The search at an order; its evaluations are counted.
std::optional<SpectralState> PatternRefinement::searched(Rise& rise, const SpectralEdges& start, int order,
                                                         double residual, int most_evaluations) {
  const int used = rise.search.evaluations();
  std::optional<SpectralState> state = rise.search.find(start, {order, order}, residual, most_evaluations);
  const int spent = rise.search.evaluations() - used;
  evaluations_ += spent;
  work_ += work_of(problem_, rise.pattern, order) * spent;
  return state;
}

}  // namespace rollres
