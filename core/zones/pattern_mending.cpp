#include "core/zones/pattern_mending.hpp"

#include <algorithm>
#include <cmath>

#include "core/zones/spectral_field.hpp"

namespace rollres {

namespace {

constexpr double touching = 0.02;    // of a zone's length: distance from its end that counts as none
constexpr double short_stick = 0.3;  // half-length of a stick where slip turns round, of the distance to the zone's end

/// Slip against its shear over most of a zone at the edge of contact, in parts of its length: the zone is longer, and
/// slip turns round over a stick, as met with where pressure and shear are coupled.
constexpr double mostly = 0.5, turned_at = 0.3, turned_within = 0.13, lengthened = 0.5;

/// Whether a run reaches the ends of its zone.
struct Reach {
  Reach(const Interval& zone, const WrongRun& run)
      : back(run.from - zone.from < touching * 2 * zone.half_length()),
        front(zone.to - run.to < touching * 2 * zone.half_length()) {}
  bool back, front;
  bool all() const { return back && front; }
};

/// The point of a stick from which on to its leading end the shear is too large: near that end it may be so between the
/// points of the assessment alone.
double overload_start(const SpectralProblem& problem, const SpectralState& state, const Interval& stick) {
  const SpectralField field(problem, state);
  const double friction = problem.model.friction_coefficient, step = 0.01 * (stick.to - stick.from);
  const auto overloaded = [&](double x) { return std::abs(field.shear(x)) > friction * field.pressure(x); };
  double start = stick.to - 0.5 * step;
  for (int k = 1; k < 99; ++k)
    if (const double x = stick.to - k * step; overloaded(x)) start = x;
  if (!state.graded || start < stick.to - step) return start;
  for (double distance = step; distance > 1e-7 * step; distance *= 0.8)
    if (const double x = stick.to - distance; overloaded(x)) return x;
  return start;
}

bool add_slip(const SpectralProblem& problem, const SpectralState& state, const WrongRun& run, PatternStart& start) {
  std::vector<int>& slips = start.pattern.slips;
  std::vector<Interval>& sticks = start.edges.sticks;
  const auto zone = static_cast<std::ptrdiff_t>(run.zone);
  const Interval stick = sticks[run.zone];
  const Reach reach(stick, run);
  const bool at_edge = reach.front ? run.zone + 1 == sticks.size() && slips.back() == 0
                                   : reach.back && run.zone == 0 && slips.front() == 0;
  if (reach.all()) return false;
  if (at_edge) {
    (reach.front ? slips.back() : slips.front()) = run.direction;
    (reach.front ? sticks.back().to : sticks.front().from) =
        reach.front ? overload_start(problem, state, stick) : run.to;
    return true;
  }
  // Next to slip the same way it is the border's place that is wrong.
  if ((reach.front && slips[run.zone + 1] == run.direction) || (reach.back && slips[run.zone] == run.direction))
    return false;
  const double kept = short_stick * (run.to - run.from);
  sticks[run.zone] = {stick.from, reach.back ? stick.from + kept : run.from};
  sticks.insert(sticks.begin() + zone + 1, Interval{reach.front ? stick.to - kept : run.to, stick.to});
  slips.insert(slips.begin() + zone + 1, run.direction);
  return true;
}

bool add_stick(const SpectralState& state, const WrongRun& run, PatternStart& start) {
  std::vector<int>& slips = start.pattern.slips;
  std::vector<Interval>& sticks = start.edges.sticks;
  const auto zone = static_cast<std::ptrdiff_t>(run.zone);
  const bool first = run.zone == 0, last = run.zone == sticks.size();
  const Interval slip{first ? state.edges.contact.from : sticks[run.zone - 1].to,
                      last ? state.edges.contact.to : sticks[run.zone].from};
  const Reach reach(slip, run);
  if (reach.all()) {
    if (first || last) {
      slips[run.zone] = run.direction;
    } else {
      sticks[run.zone - 1].to = sticks[run.zone].to;
      sticks.erase(sticks.begin() + zone);
      slips.erase(slips.begin() + zone);
    }
    return true;
  }
  if (reach.back ? !first : reach.front && !last) return false;  // the border of a stick is at the wrong place
  Interval stick{run.from, run.to};
  if (reach.back || reach.front) {
    const double outer = reach.back ? slip.from : slip.to, inner = reach.back ? slip.to : slip.from;
    const double wrong = reach.back ? run.to : run.from, length = inner - outer;
    double turning = wrong, half = std::min(short_stick * std::abs(wrong - outer), 0.5 * std::abs(inner - wrong));
    if (std::abs(wrong - outer) > mostly * std::abs(length) && !sticks.empty()) {
      turning = outer + turned_at * length;
      half = turned_within * std::abs(length);
      Interval& next = reach.back ? sticks[run.zone] : sticks[run.zone - 1];
      const double further = std::min(lengthened * std::abs(length), next.half_length());
      reach.back ? next.from += further : next.to -= further;
    }
    stick = {turning - half, turning + half};
  }
  sticks.insert(sticks.begin() + zone, stick);
  slips.insert(slips.begin() + zone + (reach.front ? 1 : 0),
               reach.back || reach.front ? run.direction : slips[run.zone]);
  return true;
}

}  // namespace

std::optional<PatternStart> mended(const SpectralProblem& problem, const SpectralState& state,
                                   std::span<const WrongRun> runs) {
  PatternStart start{state.pattern, state.edges};
  const WrongRun* before = nullptr;
  for (const WrongRun& run : runs) {  // from the leading edge on: zones behind keep their indices
    const bool same_zone = before && before->in_stick == run.in_stick && before->zone == run.zone;
    if (!(run.to > run.from) || (same_zone && start.pattern.slips.size() != state.pattern.slips.size())) return {};
    if (!(run.in_stick ? add_slip(problem, state, run, start) : add_stick(state, run, start))) return {};
    before = &run;
  }
  return start;
}

}  // namespace rollres
