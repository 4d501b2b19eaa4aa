#include "core/zones/spectral_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "core/estimate/grid_choice.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/stated_error.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/spectral/graded_system.hpp"
#include "core/zones/pattern_mending.hpp"
#include "core/zones/spectral_field.hpp"
#include "core/zones/spectral_friction_limit.hpp"
#include "core/zones/spectral_search.hpp"
#include "core/zones/spectral_solution.hpp"
#include "core/zones/spectral_start.hpp"
#include "core/zones/surface_panels.hpp"

namespace rollres {

namespace {

constexpr int most_coefficients = 160;
constexpr double smallest_residual = 1e-14;
constexpr double smallest_tolerance = 1e-13;  // that rounding allows
constexpr double largest_violation = 5e-9;    // of any law
/// The same, of rings, whose curvature is known to its memories between points, and where another order mends nothing.
constexpr double borne_violation = 1e-8;
/// Where a ring begins to slip its pressure has a power 3/2 of the distance: between points the laws hold to this,
/// times the slope at the edges and the order to the power -5/2. (A braked cover: 0.55 times that, orders 10 to 157.)
constexpr double of_sheared_rings = 2;
constexpr double default_of_sheared_rings = 1e-6;  // tolerance, in place of the default
constexpr double rounded_tail = 1e-12;             // last coefficients, relative to the largest
constexpr double wrong_pattern = 1e-7;             // violation of an inequality that no order mends
constexpr double tolerated_between = 0.01;         // violation between graded points, which the error then counts
constexpr double plainly_wrong = 0.01;             // the same, seen at once
/// Memories with inertia, in half-widths: logarithms beside shorter ones are not resolved.
constexpr double shortest_with_inertia = 0.1;
/// Orders of graded points at which edges are found and patterns refuted for little work, residuals and evaluations.
constexpr std::array<int, 2> sketch_orders{14, 22};
constexpr double first_sketch_residual = 1e-5, sketch_residual = 1e-7;
/// Few graded points refute right patterns, and tell their own error badly: fewer than this tolerance asks for [1] save
/// little.
constexpr double least_graded_accuracy = 2e-5;
constexpr int most_to_sketch = 30, most_to_find = 60;  // evaluations, where nothing is known of a pattern
constexpr int largest_first_order = 80;
constexpr double fewest_unsketched = 31;   // coefficients, where zones are too short for these
constexpr double fewest_from_grid = 40;    // the same, not to lose the edges that a grid tells better than few points
constexpr double nearly_right = 0.01;      // the same, where the place of what is wrong starts a search nearby
constexpr int most_mended = 6;             // patterns that follow from one another
constexpr int most_stays = 3;              // checks of all laws that find no smaller violation
constexpr double finer_than_grids = 1e-7;  // expected change of R_r [1]
constexpr double slowest_fall = 0.9;       // of the last coefficients, from one order to the next

/// A rotation that is given hands what the edges lack on to the traction.
double handed_on(Drive drive) { return drive == Drive::rotation ? 2.5 : 1; }

/// The change from one order to the next, times how fast coefficients fall, is often too hopeful: the estimate over it.
double estimate_over_change(Drive drive) { return 3.25 * handed_on(drive); }

/// The error estimate (core/spectral/README.md, (S27)). The laws between the points are taken into account too.
double cautious(double error, double violation, Drive drive) {
  constexpr double rounding = 1e-12;
  return estimate_over_change(drive) * error + handed_on(drive) * (0.65 * std::sqrt(error * violation) + rounding);
}

/// Work that is spent before the scene is left to the grids, in evaluations of a system of 100 unknowns with slip in
/// one direction: 0.1 to 0.2 s. Counted and not timed, so that the answer is the same on any machine.
constexpr double most_work = 800;
/// Times as much where a grid would need so much more: compressible layers and inertia.
constexpr double graded_share = 4;
/// And a tenth where a ring that remembers is sheared and no tolerance is asked for: an evaluation takes ten times as
/// long, as the ring's curvature has all its memories. (Of 80 random coated wheels 33 are solved within it, 34 with
/// all of the work.)
constexpr double share_of_rings = 0.1;

/// Work of an evaluation. Systems with slip in both directions take a base of their own (sliding_base.hpp) and, for the
/// resultants, several times as many sources.
double work_of(const SpectralProblem& problem, const SlipPattern& pattern, int order) {
  if (problem.graded(pattern.shear)) {
    const double nodes = order * (1 + 2.5 * static_cast<double>(pattern.sticks())) / 100;
    return 0.6 * nodes * nodes * (nodes + 1);
  }
  const double unknowns = order * (1 + static_cast<double>(pattern.sticks())) / 100;
  return (pattern.one_direction() ? 1.5 : 8) * unknowns * (unknowns + 0.5);
}

/// Work of checking all laws, on points between those of the collocation: for memories much shorter than the contact
/// most of it goes into their tails.
double work_of_check(const SpectralProblem& problem, const SlipPattern& pattern, int order, double half_length) {
  double rate = 0;
  for (const double length : problem.relaxation_length) rate = std::max(rate, half_length / length);
  return 2 * work_of(problem, pattern, order) + std::min(0.3 * std::sqrt(rate), 150.0);
}

class SpectralContact {
 public:
  SpectralContact(const ContactModel& model, const CreepSpectrum& creep)
      : model_(model),
        tolerance_(std::max(model.tolerance.value_or(default_spectral_tolerance), smallest_tolerance)),
        problem_(model, creep, estimate_contact(model).half_width) {
    if (problem_.graded(model.friction_coefficient > 0)) tolerance_ = std::min(tolerance_, least_graded_accuracy);
    if (!model.tolerance && sheared_ring()) tolerance_ = default_of_sheared_rings;
  }

  SpectralOutcome run(const std::optional<FoundZones>& near) {
    if (model_.adhesion_threshold > 0) return {{}, "adhesion"};
    if (problem_.inertia && !problem_.creep_length.empty() &&
        problem_.creep_length.front() < shortest_with_inertia * problem_.half_width)
      return {{}, "inertia, and memories much shorter than the contact"};
    if (near && model_.friction_coefficient > 0) {
      problem_.coating_moments = near->coating_moments;
      if (refine(near->pattern, near->edges, &*near)) return finished();
      work_ = 0;
      tried_.clear();
    }
    std::optional<SpectralState> smooth = frictionless_start(problem_);
    if (!smooth) return {{}, "no contact found without friction"};
    take_coating(*smooth);
    if (model_.friction_coefficient == 0) {
      if (refine({}, smooth->edges)) return finished();
      return {{}, "no contact found within the laws"};
    }
    if (try_quick_patterns(*smooth)) return finished();
    if (model_.drive != Drive::rotation)
      if (const std::optional<double> needed = friction_needed(problem_, smooth->edges.contact)) {
        RollingSolution solution;
        solution.method = Method::spectral;
        solution.status = Status::no_steady_state;
        solution.friction_needed = *needed;
        solution.reason = too_much_traction(*needed, model_.friction_coefficient);
        solution.iterations = evaluations_;
        return {solution, {}};
      }
    from_grid_ = true;
    tried_.clear();
    for (const double nodes : {60.0, 240.0}) {  // finer ones find little more, and may take a minute
      const std::optional<PatternStart> start = pattern_on_grid(model_, smooth->edges.contact.half_length() / nodes);
      if (!start || was_tried(start->pattern)) continue;
      if (try_mended(*start)) return finished();
    }
    if (answered()) return finished();
    return {{}, "no pattern of zones fits"};
  }

 private:
  SpectralOutcome finished() {
    best_->solution.method = Method::spectral;
    best_->solution.status = Status::converged;
    best_->solution.iterations = evaluations_;
    if (model_.tolerance && best_->solution.rolling_resistance_error > *model_.tolerance * scale_)
      best_->solution.warnings.push_back(tolerance_missed(
          *model_.tolerance, best_->solution, message_text(best_->solution.contact_nodes, " coefficients")));
    SpectralOutcome found{std::move(best_->solution), {}};
    if (model_.friction_coefficient > 0) found.zones = std::move(zones_);
    return found;
  }

  bool try_quick_patterns(const SpectralState& smooth) {
    if (model_.drive == Drive::rotation) {
      const int direction = *model_.rotation_ratio < 1 ? 1 : -1;
      if (refine({.shear = true, .slips = {direction}}, smooth.edges)) return true;
    }
    const std::optional<PatternStart> start = one_border_start(problem_, smooth.edges.contact);
    return start && (try_mended(*start) || (!last_ && try_turned(*start)));
  }

  /// A pattern, and those that follow from what is wrong with it.
  bool try_mended(PatternStart start) {
    std::optional<PatternStart> next = std::move(start);
    for (int mendings = 0; next && mendings < most_mended; ++mendings) {
      if (refine(next->pattern, next->edges)) return true;
      next = last_ ? mend_last() : std::nullopt;
    }
    return false;
  }

  /// Where a short slip at the trailing edge is about to turn round, the contact without friction tells its direction
  /// wrongly.
  bool try_turned(PatternStart start) {
    constexpr double short_slip = 0.05, share = 0.0025;  // of the contact
    const Interval& contact = start.edges.contact;
    Interval& stick = start.edges.sticks.front();
    if (start.pattern.slips.front() == 0 || stick.from - contact.from > short_slip * (contact.to - contact.from))
      return false;
    start.pattern.slips.front() *= -1;
    stick.from = contact.from + share * (contact.to - contact.from);
    return try_mended(std::move(start));
  }

  /// A new pattern that the last state's violations ask for: the large ones together, or one alone, the largest first.
  std::optional<PatternStart> mend_last() {
    constexpr double large = 0.3;  // of the largest
    std::vector<WrongRun> alone = wrong_runs_;
    std::stable_sort(alone.begin(), alone.end(),
                     [](const WrongRun& a, const WrongRun& b) { return a.amount > b.amount; });
    if (alone.empty() || (!last_->graded && wrong_ > nearly_right && !alone.front().in_stick)) return {};
    std::vector<WrongRun> together = wrong_runs_;
    std::erase_if(together, [&](const WrongRun& run) { return run.amount < large * alone.front().amount; });
    const auto untried = [&](std::span<const WrongRun> runs) -> std::optional<PatternStart> {
      std::optional<PatternStart> next = mended(problem_, *last_, runs);
      if (next && (next->pattern.sticks() > most_sticks || was_tried(next->pattern))) next.reset();
      return next;
    };
    std::optional<PatternStart> next = untried(together);
    for (std::size_t i = 0; !next && i < alone.size(); ++i) next = untried({&alone[i], 1});
    return next;
  }
  bool sheared_ring() const { return model_.ring() && model_.friction_coefficient > 0; }
  bool dear_ring() const {
    const std::vector<ModelLayer>& round = model_.coating.empty() ? model_.foundation : model_.coating;
    return sheared_ring() && !model_.tolerance && !round.front().creep.terms.empty();
  }
  bool was_tried(const SlipPattern& pattern) const {
    return std::find(tried_.begin(), tried_.end(), pattern.slips) != tried_.end();
  }

  /// Solves with rising orders until the tolerance is met; true if the answer obeys all laws. Gives up where higher
  /// orders will not help: the pattern is wrong, a violation stays, coefficients do not fall, or work is used up.
  /// @param near  where the edges are from, if they are from another scene
  bool refine(const SlipPattern& pattern, SpectralEdges edges, const FoundZones* near = nullptr) {
    last_.reset();
    wrong_runs_.clear();
    tried_.push_back(pattern.slips);
    EdgeSearch search(problem_, pattern);
    const bool costly = !pattern.one_direction(), graded = problem_.graded(pattern.shear);
    const double most = (graded ? graded_share : 1) * (dear_ring() ? share_of_rings : 1) * most_work;
    // The laws are held to 5e-9 whatever the tolerance: fewer coefficients only cost another round.
    double coefficients = first_order(problem_, edges, graded ? tolerance_ : std::min(tolerance_, 1e-8), pattern.shear);
    if (near) {
      search.take_over(near->search);
      coefficients = std::max(coefficients, (near->coefficients - 2) / order_growth);
    }
    double before = RollingSolution::absent, change_before = 1, tail_before = 1, least_violation = INFINITY;
    double residual = std::min(1e-9, 0.01 * tolerance_);
    double coming = 0;  // change to be expected
    Told told;
    int stays = 0;
    bool only_sketched = true, done = false, checked = !costly && !graded;
    if (graded && from_grid_) {
      coefficients = std::max(coefficients, fewest_from_grid);
    } else if (graded) {
      const Sketch sketch = sketched(search, pattern, edges, coefficients, most);
      if (sketch.refuted) return false;
      edges = sketch.edges;
      coefficients = sketch.coefficients;
      checked = sketch.lawful;
      before = sketch.resistance;
      tail_before = sketch.tail;
    }
    while (coefficients <= most_coefficients) {
      require_time();
      const auto order = static_cast<int>(coefficients);
      const double work = work_of(problem_, pattern, order);
      if (work_ + 3 * work > most) break;
      const int used = search.evaluations();
      std::optional<SpectralState> state =
          find_with_coating(search, edges, order, residual,
                            std::min(static_cast<int>((most - work_) / work), last_ ? 400 : most_to_find));
      evaluations_ += search.evaluations() - used;
      work_ += work * (search.evaluations() - used);
      if (!state) break;
      edges = state->edges;
      const double resistance = resistance_of(*state);
      const double tail = state->graded ? graded_tail(resolving(order)) : relative_tail(*state);
      const double lever = lever_of(*state), scale = scale_of(*state);
      const double change = std::abs(resistance - before) / scale;
      // Of graded points the changes may pass through zero: then what the one before let expect counts.
      const double expected = graded ? std::max(change, coming) : change;
      double error = expected * std::min(1.0, tail / tail_before) +
                     (1e-15 + state->residuals.cwiseAbs().maxCoeff()) * lever / scale;
      // With all coefficients there, repeated changes tell better what residuals at the limit of rounding do.
      if (std::max(tail, tail_before) < rounded_tail) error = std::min(error, 10 * std::max(change, change_before));
      residual = std::clamp(0.01 * tolerance_ * scale / lever, smallest_residual, residual);
      const bool falling = tail < slowest_fall * tail_before;
      if (std::isfinite(change)) coming = change * std::min(1.0, tail / tail_before);
      // Edges from few graded points tell the first change only roughly.
      const auto next = static_cast<int>(next_order(coefficients, graded));
      const bool last_order = next > most_coefficients || work_ + 4 * work_of(problem_, pattern, next) > most;
      const double wanted = last_order ? largest_change(graded) : wanted_change(graded);
      const bool enough = !(graded && only_sketched) && error <= std::max(wanted, smallest_tolerance * lever / scale);
      told = {.order = order,
              .error = only_sketched ? INFINITY : error,
              .resistance = resistance,
              .lever = lever,
              .scale = scale};
      only_sketched = false;
      before = resistance;
      change_before = change;
      tail_before = tail;
      last_ = std::move(state);
      if (enough || (!checked && error < 1e-4)) {
        checked = true;
        work_ += work_of_check(problem_, pattern, order, edges.contact.half_length());
        AssessedSpectral assessed = assess(problem_, *last_);
        const bool lawful = in_its_zones(assessed, order);
        if (!lawful) take_over_wrongs(assessed);
        if (!lawful && (last_->graded || assessed.wrong_zone > plainly_wrong)) return false;
        const double imposed = imposed_violation(assessed);
        if (enough && lawful && !last_order && misses_tolerance(assessed, told)) {
          keep_best(assessed, told, search);
          coefficients = next_order(coefficients, graded);
          continue;
        }
        if (enough && accept(assessed, told, search, done ? borne_violation : held_violation())) return true;
        if (enough && error <= tolerance_) {
          if (done && !lawful) return false;
          done = true;
          residual =
              std::max(0.01 * residual, smallest_residual);  // where edges that are not quite in place break laws
          if (imposed < 0.5 * least_violation)
            least_violation = imposed;
          else if (++stays == most_stays || imposed > 1e-6)
            return false;
        }
      } else if (costly && order >= 30 && !falling) {
        return false;
      }
      coefficients = next_order(coefficients, graded);
    }
    // A tolerance beyond what rounding and work allow leaves the best answer, better than any grid's.
    if (!last_ || !(told.error <= std::max(finer_than_grids, model_.tolerance.value_or(0)))) return false;
    AssessedSpectral assessed = assess(problem_, *last_);
    return keep_best(assessed, told, search);
  }

  /// Takes over what the tractions make of a coating's M and N (S18). @return by how much they change the drive's row
  /// [N/m]
  double take_coating(SpectralState& state) {
    if (!problem_.coating) return 0;
    const CoatingMoments before = problem_.coating_moments, now = coating_moments(problem_, state);
    const CoatingMoments change{now.pressed - before.pressed, now.sheared - before.sheared};
    problem_.coating_moments = now;
    state.driving_force -= problem_.shape.of_coating() * change.pressed;
    state.driving_torque += model_.radius * problem_.shape.of_coating() * change.in_torque();
    return coating_in_drive(model_, change);
  }

  /// The search, and again while the drive's row knows another M and N than the tractions make: these hardly depend on
  /// it.
  std::optional<SpectralState> find_with_coating(EdgeSearch& search, SpectralEdges edges, int order, double residual,
                                                 int most_evaluations) {
    constexpr int most_passes = 8;
    constexpr double negligible = 0.02 * largest_violation;  // of the load
    const bool driven = model_.friction_coefficient > 0 && model_.drive != Drive::rotation;
    for (int pass = 1;; ++pass) {
      std::optional<SpectralState> state = search.find(edges, {order, order}, residual, most_evaluations);
      if (!state) return {};
      const double change = take_coating(*state);
      if (!driven || std::abs(change) <= negligible * state->load || pass == most_passes) return state;
      edges = state->edges;
    }
  }

  /// What an order told of the resistance.
  struct Told {
    int order = 0;
    double error = INFINITY;  // expected change, of the scale
    double resistance = 0, lever = 0, scale = 1;
  };

  /// The error of R_r that an answer states, of the scale. Of graded points changes may be small by chance, and tell
  /// nothing of an inequality that is violated a little between points: if that is since the pattern is wrong, all
  /// orders of it share what it costs.
  double estimate_of(const AssessedSpectral& assessed, const Told& told) const {
    if (!last_->graded) {
      const double of_curvature = model_.ring() ? told.lever / told.scale * assessed.violation : 0;
      return cautious(told.error, assessed.violation, model_.drive) + of_curvature;
    }
    constexpr double per_violation = 0.03, usual_share = 0.05;  // of what so many points allow
    const double lever = told.lever / told.scale, field_error = field_error_of(told.order);
    double wrong = assessed.wrong_zone > usual_share * field_error ? assessed.wrong_zone : 0;
    if (assessed.violation > field_error) wrong = std::max(wrong, assessed.violation);
    // Of 185 random answers at a tolerance of 1e-9, 17 % were off by more than this sum, 4 % by more than 1.5 of it.
    constexpr double covering = 1.5;
    return covering * (cautious(told.error, 0, model_.drive) + usual_error(told.order, lever) +
                       handed_on(model_.drive) * per_violation * wrong * std::sqrt(lever));
  }
  /// The order that resolves as much without layers: thin ones narrow the strip in which all is analytic.
  double resolving(int order) const {
    constexpr double usual_strip = 0.7;  // of the random scenes by which the errors of graded points are known
    return order * std::min(1.0, free_strip(problem_, {-problem_.half_width, problem_.half_width}) / usual_strip);
  }
  double field_error_of(int order) const { return graded_field_error(resolving(order)); }

  /// What so many graded points leave, of random scenes and by their order alone. @param lever  over the scale
  double usual_error(int order, double lever) const {
    constexpr double per_tail = 2;
    return per_tail * handed_on(model_.drive) * graded_tail(resolving(order)) * std::sqrt(lever);
  }
  bool misses_tolerance(const AssessedSpectral& assessed, const Told& told) const {
    return (last_->graded || problem_.sheared_ring(last_->pattern.shear)) && model_.tolerance &&
           estimate_of(assessed, told) > *model_.tolerance;
  }

  /// Whether the inequalities hold, of graded points to what their number allows.
  bool in_its_zones(const AssessedSpectral& assessed, int order) const {
    return assessed.wrong_zone < std::max(wrong_pattern, between_points(order));
  }
  double between_points(int order) const {
    if (last_->graded) return field_error_of(order);
    if (!problem_.sheared_ring(last_->pattern.shear)) return 0;
    return of_sheared_rings * last_->edges.contact.half_length() / model_.radius * std::pow(order, -2.5);
  }
  /// Of graded points, and on rings, the laws hold where they are imposed, and in between to what their number allows.
  double imposed_violation(const AssessedSpectral& assessed) const {
    return last_->graded || problem_.sheared_ring(last_->pattern.shear) ? assessed.solution.law_violation
                                                                        : assessed.violation;
  }

  /// Takes the last state for the answer if all laws hold and none before was surer of itself. @return whether one is
  /// there that is as sure as asked for, or than no grid would be
  bool keep_best(AssessedSpectral& assessed, const Told& told, const EdgeSearch& search) {
    const bool better = !best_ || estimate_of(assessed, told) * told.scale < best_->solution.rolling_resistance_error;
    if (better) accept(assessed, told, search, held_violation());
    return answered();
  }
  bool answered() const {
    const double finer = 1.25 * estimate_over_change(model_.drive) * finer_than_grids + problem_.left_out;
    return best_ && best_->solution.rolling_resistance_error <= std::max(finer, model_.tolerance.value_or(0)) * scale_;
  }

  double held_violation() const { return model_.ring() ? borne_violation : largest_violation; }
  /// Takes the last state for the answer if all laws hold.
  bool accept(AssessedSpectral& assessed, const Told& told, const EdgeSearch& search, double held) {
    const double largest = std::max(held, last_->graded ? tolerated_between : between_points(told.order));
    if (!in_its_zones(assessed, told.order) || !(assessed.violation < largest) || !(imposed_violation(assessed) < held))
      return false;
    const double relative = estimate_of(assessed, told);
    RollingSolution& solution = assessed.solution;
    solution.peak_pressure_error = peak_error(assessed, told);
    solution.rolling_resistance_error = relative * told.scale + problem_.left_out * std::abs(told.resistance);
    solution.error_estimate = solution.rolling_resistance_error / std::abs(told.resistance);
    scale_ = told.scale;
    best_ = std::move(assessed);
    zones_ = {last_->pattern, last_->edges, static_cast<double>(told.order), search.slopes(), problem_.coating_moments};
    return true;
  }

  /// What memories too short to matter leave of the pressure at a place [Pa]. At many lengths rho_1 behind the leading
  /// edge, a share x = rho_1/distance, an amplitude Z_1 is answered by a pressure of Z_1 x^(1/2); a change that leaves
  /// the loss as it is, as where the shortest memory stands for those below it, by one of x^(3/2).
  double left_by_short_memories(double place) const {
    if (problem_.terms() == 0) return 0;
    const double length = problem_.relaxation_length.front(), share = length / (last_->edges.contact.to - place);
    const double amplitude = std::abs(last_->pressure.amplitudes(0));
    constexpr double covering = 1.5;  // where the peak is but a few lengths behind the edge
    if (problem_.taken_up) return amplitude * std::min(1.0, covering * std::pow(share, 1.5));
    const double loss = problem_.glassy * problem_.glassy * problem_.made_elastic;
    return amplitude * loss / (problem_.relaxation_modulus.front() * length) * std::min(1.0, std::sqrt(share));
  }

  /// Of the largest pressure [Pa]: what coefficients, or graded points, and short memories leave.
  double peak_error(const AssessedSpectral& assessed, const Told& told) const {
    constexpr double over_resistance = 3;  // of random scenes
    const double share = last_->graded ? field_error_of(told.order) : over_resistance * estimate_of(assessed, told);
    return (share + assessed.violation) * assessed.solution.peak_pressure + left_by_short_memories(assessed.peak_place);
  }

  /// What few graded points tell of a pattern for little work.
  struct Sketch {
    SpectralEdges edges;
    double coefficients;                                    // to go on with
    double resistance = RollingSolution::absent, tail = 1;  // of the last order
    bool lawful = false, refuted = false;
  };
  Sketch sketched(EdgeSearch& search, const SlipPattern& pattern, const SpectralEdges& start, double coefficients,
                  double most) {
    Sketch sketch{start, coefficients};
    for (const int order : sketch_orders) {
      if (sketch.coefficients <= order || sketch.lawful) break;
      std::optional<SpectralState> state = edges_at(search, pattern, sketch.edges, order, most);
      if (!state) {
        sketch = {start, std::max(coefficients, fewest_unsketched)};  // edges from too few points lead astray
        break;
      }
      sketch.edges = state->edges;
      sketch.resistance = resistance_of(*state);
      sketch.tail = graded_tail(resolving(order));
      const double part = std::min(scale_of(*state) / lever_of(*state), 1.0);
      const double accuracy = std::max(wanted_change(true) * part, smallest_tolerance);
      sketch.coefficients =
          std::clamp(graded_order(problem_, sketch.edges.contact, accuracy), order, largest_first_order);
      const double lever = lever_of(*state) / scale_of(*state);
      const auto final_error = [&] {
        return usual_error(static_cast<int>(next_order(sketch.coefficients, true)), lever);
      };
      while (model_.tolerance && sketch.coefficients < largest_first_order && final_error() > 0.5 * *model_.tolerance)
        ++sketch.coefficients;
      last_ = std::move(state);
      if (order == sketch_orders.front()) continue;  // too few points to refute anything
      work_ += work_of_check(problem_, pattern, order, sketch.edges.contact.half_length());
      const AssessedSpectral assessed = assess(problem_, *last_);
      const auto final_order = static_cast<int>(next_order(sketch.coefficients, true));
      sketch.lawful = assessed.wrong_zone < field_error_of(final_order);
      sketch.refuted = assessed.wrong_zone > refuted_at(order);
      if (!sketch.refuted) continue;
      take_over_wrongs(assessed);
      break;
    }
    return sketch;
  }

  /// Edges at a low order; none if they are not found.
  std::optional<SpectralState> edges_at(EdgeSearch& search, const SlipPattern& pattern, const SpectralEdges& start,
                                        int order, double most) {
    const int used = search.evaluations();
    const double work = work_of(problem_, pattern, order);
    const double residual = order == sketch_orders.front() ? first_sketch_residual : sketch_residual;
    const int affordable = std::min(most_to_sketch, static_cast<int>((most - work_) / work));
    std::optional<SpectralState> state = search.find(start, {order, order}, residual, affordable);
    const int spent = search.evaluations() - used;
    evaluations_ += spent;
    work_ += work * spent;
    return state;
  }

  /// What the last change may let expect, if no higher order can be had: a missed tolerance is then warned of [1].
  double largest_change(bool graded) const { return tolerance_ / (graded && model_.tolerance ? 2 : 1); }
  /// The same else: a tolerance that is asked for is one of the estimate [1].
  double wanted_change(bool graded) const {
    if (!model_.tolerance) return largest_change(graded);
    return std::min(largest_change(graded), *model_.tolerance / estimate_over_change(model_.drive));
  }

  void take_over_wrongs(const AssessedSpectral& assessed) {
    wrong_ = assessed.wrong_zone;
    wrong_runs_ = assessed.wrong_runs;
  }

  static constexpr double order_growth = 1.4;
  static double next_order(double coefficients, bool graded) { return (graded ? 1.25 : 1.4) * coefficients + 2; }
  /// Violation of an inequality at an order of few graded points that refutes the pattern.
  double refuted_at(int order) const {
    constexpr double times_field_error = 1.5, usual_friction = 0.2;  // of right patterns less, on random scenes
    return times_field_error * field_error_of(order) * std::max(1.0, usual_friction / model_.friction_coefficient);
  }

  double resistance_of(const SpectralState& state) const {
    return state.driving_force + state.driving_torque * state.rotation_ratio / model_.radius;
  }
  /// Rounding and what is left of the residuals move the centre of pressure; an elastic layer resists with nothing.
  double lever_of(const SpectralState& state) const {
    return state.load * state.edges.contact.half_length() / model_.radius;
  }
  double scale_of(const SpectralState& state) const {
    return std::max(std::abs(resistance_of(state)), 1e-6 * lever_of(state));
  }

  static double relative_tail(const SpectralState& state) {
    const auto part = [](const Eigen::VectorXd& c) { return c.size() > 2 ? c.tail(2).cwiseAbs().maxCoeff() : 0.0; };
    double tail = part(state.pressure.coefficients);
    for (const SpectralDensity& stick : state.sticks) tail += part(stick.coefficients);
    return tail / state.pressure.coefficients.cwiseAbs().maxCoeff();
  }

  ContactModel model_;
  double tolerance_;
  SpectralProblem problem_;
  std::optional<SpectralState> last_;
  std::optional<AssessedSpectral> best_;
  double wrong_ = RollingSolution::absent;
  std::vector<WrongRun> wrong_runs_;     // of the last pattern, from the leading edge on
  std::vector<std::vector<int>> tried_;  // slips of patterns that were refined
  bool from_grid_ = false;               // whether edges to start with are a grid's
  int evaluations_ = 0;
  double work_ = 0;
  std::optional<FoundZones> zones_;  // of the best answer
  double scale_ = 0;                 // by which errors of the best answer are measured [N/m]
};

}  // namespace

namespace {

SpectralOutcome solve_with(const ContactModel& model, const CreepSpectrum& creep,
                           const std::optional<FoundZones>& near) {
  std::optional<SpectralContact> contact;
  try {
    contact.emplace(model, creep);
  } catch (const std::domain_error& error) {
    return {{}, error.what()};
  }
  return contact->run(near);
}

}  // namespace

SpectralOutcome solve_spectral(const ContactModel& model, const std::optional<FoundZones>& near) {
  return solve_with(model, near_spectrum(model), near);
}

SpectralOutcome solve_spectral(const ContactModel& model, const CreepSpectrum& creep) {
  return solve_with(model, creep, {});
}

}  // namespace rollres
