#include "core/zones/spectral_contact.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/model/contact_surface.hpp"
#include "core/zones/pattern_mending.hpp"
#include "core/zones/pattern_refinement.hpp"
#include "core/zones/spectral_friction_limit.hpp"
#include "core/zones/spectral_start.hpp"
#include "core/zones/surface_panels.hpp"

namespace rollres {

namespace {

/// Memories with inertia, in half-widths: logarithms beside shorter ones are not resolved.
constexpr double shortest_with_inertia = 0.1;
/// Violation of an inequality, where the place of what is wrong starts a search nearby.
constexpr double nearly_right = 0.01;
constexpr int most_mended = 6;  // patterns that follow from one another

/// The patterns of zones of one scene, in the order in which they are tried.
class SpectralContact {
 public:
  SpectralContact(const ContactModel& model, const CreepSpectrum& creep) : model_(model), patterns_(model_, creep) {}

  SpectralOutcome run(const std::optional<FoundZones>& near) {
    if (model_.adhesion_threshold > 0) return {{}, "adhesion"};
    if (problem().inertia && !problem().creep_length.empty() &&
        problem().creep_length.front() < shortest_with_inertia * problem().half_width)
      return {{}, "inertia, and memories much shorter than the contact"};
    if (near && model_.friction_coefficient > 0) {
      patterns_.start_coating_at(near->coating_moments);
      if (patterns_.refine(near->pattern, near->edges, &*near)) return patterns_.take_best();
      patterns_.forget_work();
      patterns_.forget_tried();
    }
    std::optional<SpectralState> smooth = frictionless_start(problem());
    if (!smooth) return {{}, "no contact found without friction"};
    if (model_.friction_coefficient == 0) {
      if (patterns_.refine({}, smooth->edges)) return patterns_.take_best();
      return {{}, "no contact found within the laws"};
    }
    patterns_.take_coating(*smooth, coating_moments(problem(), *smooth));
    if (try_quick_patterns(*smooth)) return patterns_.take_best();
    if (model_.drive != Drive::rotation)
      if (const std::optional<double> needed = friction_needed(problem(), smooth->edges.contact)) {
        RollingSolution solution;
        solution.method = Method::spectral;
        solution.status = Status::no_steady_state;
        solution.friction_needed = *needed;
        solution.reason = too_much_traction(*needed, model_.friction_coefficient);
        solution.iterations = patterns_.evaluations();
        return {solution, {}};
      }
    patterns_.start_from_grid();
    for (const double nodes : {60.0, 240.0}) {  // finer ones find little more, and may take a minute
      const std::optional<PatternStart> start = pattern_on_grid(model_, smooth->edges.contact.half_length() / nodes);
      if (!start || patterns_.was_tried(start->pattern)) continue;
      if (try_mended(*start)) return patterns_.take_best();
    }
    if (patterns_.answered()) return patterns_.take_best();
    return {{}, "no pattern of zones fits"};
  }

 private:
  const SpectralProblem& problem() const { return patterns_.problem(); }

  bool try_quick_patterns(const SpectralState& smooth) {
    if (model_.drive == Drive::rotation) {
      const int direction = *model_.rotation_ratio < 1 ? 1 : -1;
      if (patterns_.refine({.shear = true, .slips = {direction}}, smooth.edges)) return true;
    }
    const std::optional<PatternStart> start = one_border_start(problem(), smooth.edges.contact);
    return start && (try_mended(*start) || (!patterns_.last() && try_turned(*start)));
  }

  /// A pattern, and those that follow from what is wrong with it.
  bool try_mended(PatternStart start) {
    std::optional<PatternStart> next = std::move(start);
    for (int mendings = 0; next && mendings < most_mended; ++mendings) {
      if (patterns_.refine(next->pattern, next->edges)) return true;
      next = patterns_.last() ? mend_last() : std::nullopt;
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
    std::vector<WrongRun> alone = patterns_.wrong_runs();
    std::stable_sort(alone.begin(), alone.end(),
                     [](const WrongRun& a, const WrongRun& b) { return a.amount > b.amount; });
    if (alone.empty() || (!patterns_.last()->graded && patterns_.wrong() > nearly_right && !alone.front().in_stick))
      return {};
    std::vector<WrongRun> together = patterns_.wrong_runs();
    std::erase_if(together, [&](const WrongRun& run) { return run.amount < large * alone.front().amount; });
    const auto untried = [&](std::span<const WrongRun> runs) -> std::optional<PatternStart> {
      std::optional<PatternStart> next = mended(problem(), *patterns_.last(), runs);
      if (next && (next->pattern.sticks() > most_sticks || patterns_.was_tried(next->pattern))) next.reset();
      return next;
    };
    std::optional<PatternStart> next = untried(together);
    for (std::size_t i = 0; !next && i < alone.size(); ++i) next = untried({&alone[i], 1});
    return next;
  }

  ContactModel model_;
  PatternRefinement patterns_;
};

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
