#include "core/zones/spectral_start.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/estimate/grid_choice.hpp"
#include "core/newton/nested_newton.hpp"
#include "core/numerics/bracketed_root.hpp"

namespace rollres {

double free_strip(const SpectralProblem& problem, const Interval& contact) {
  return problem.layered() ? 2 / M_PI * std::atan(2 * problem.correction->depth() / contact.half_length()) : 1;
}

int graded_order(const SpectralProblem& problem, const Interval& contact, double accuracy) {
  constexpr double coupled = 0.01;  // from where on pressure and shear have other exponents than roots
  const double factor = std::abs(problem.deep->cross()) < coupled ? 3 : 6;
  const double order = std::pow(factor - std::log(accuracy), 2) / (1.5 * M_PI * M_PI * free_strip(problem, contact));
  return static_cast<int>(order / 1.25 - 2);
}

int first_order(const SpectralProblem& problem, const SpectralEdges& edges, double tolerance, bool shear) {
  if (problem.graded(shear)) {
    const double strip = free_strip(problem, edges.contact);
    return std::clamp(static_cast<int>(std::pow(4.6 - std::log(tolerance), 2) / (1.5 * M_PI * M_PI * strip)), 6, 80);
  }
  // The corrections are singular at twice their depth from the surface: coefficients fall like rate^{-n}.
  const double distance = problem.layered() ? 2 * problem.correction->depth() / edges.contact.half_length() : INFINITY;
  const double rate = std::isfinite(distance) ? std::log(distance + std::sqrt(distance * distance + 1)) : 5;
  return std::clamp(static_cast<int>(3 - std::log(tolerance) / (2.2 * rate)), 4, 40);
}

std::optional<SpectralState> frictionless_start(const SpectralProblem& problem) {
  const double half = problem.half_width;
  const double widest = widest_window(problem.model);
  for (const double size : {1.0, 0.7, 1.3, 0.5, 2.0})
    for (const double shift : {0.0, 0.3}) {
      const double l = std::min(size * half, 0.7 * widest), c = shift * l;
      EdgeSearch search(problem, {});
      const SpectralEdges start{{c - l, c + l}, {}};
      const int order = first_order(problem, start, 1e-3, false);
      if (std::optional<SpectralState> state = search.find(start, {order, order}, 1e-4)) return state;
    }
  return {};
}

std::optional<PatternStart> one_border_start(const SpectralProblem& problem, const Interval& contact) {
  SpectralEdges edges{contact, {contact}};
  const int order = first_order(problem, edges, problem.graded(true) ? 1e-3 : 1e-4, true);
  SlipPattern pattern{.shear = true, .slips = {1, 0}};
  const auto missing = [&](double place) {  // root of the slipping part
    edges.sticks[0].from = contact.from + 2 * contact.half_length() * place * place;
    return solve_inside(problem, pattern, edges, {order, order}).residuals(2);
  };
  // With next to no slip the shear would be singular at the trailing edge, in the direction of the slip to come.
  double low = problem.graded(true) ? 1e-3 : 1e-7, at_low = missing(low);
  if (!std::isfinite(at_low)) return {};
  if (std::abs(at_low) < 1e-9) {
    edges.sticks[0] = contact;
    pattern.slips[0] = 0;
    return PatternStart{pattern, edges};
  }
  pattern.slips[0] = at_low < 0 ? 1 : -1;
  at_low = missing(low);
  for (const double high : {1e-5, 2e-3, 0.03, 0.2, 0.45, 0.63, 0.8, 0.92, 0.97, 0.99}) {
    if (high < low) continue;
    const double at_high = missing(high);
    if (!std::isfinite(at_high)) return {};
    if (std::signbit(at_high) != std::signbit(at_low)) {
      missing(low - at_low * (high - low) / (at_high - at_low));
      return PatternStart{pattern, edges};
    }
    low = high;
    at_low = at_high;
  }
  return {};
}

namespace {

/// Neighbouring nodes of a grid that are in one zone, of slip in one direction.
struct NodeRun {
  Zone zone;
  int direction;
  double from, to;  // [m]
};

/// From the leading edge: slip (perhaps), stick (perhaps), slip.
std::vector<NodeRun> node_runs(const ContactLevel& level, double spacing) {
  const SurfaceGrid& grid = level.problem->grid;
  std::vector<NodeRun> runs;
  for (int i = grid.columns - 1; i >= 0; --i) {
    const Zone zone = level.outcome.zone[static_cast<std::size_t>(i)];
    if (zone == Zone::free) continue;
    const double x = grid.x(i);
    const int direction = zone == Zone::stick ? 0 : level.outcome.unknowns.shear_x(i) > 0 ? 1 : -1;
    if (runs.empty() || runs.back().zone != zone || runs.back().direction != direction)
      runs.push_back({zone, direction, x - 0.5 * spacing, x + 0.5 * spacing});
    runs.back().from = x - 0.5 * spacing;
  }
  return runs;
}

/// Single nodes at the edges are artefacts of the grid: slip ahead of all stick, anything behind all slip.
void drop_single_nodes(std::vector<NodeRun>& runs, double spacing) {
  const auto single = [&](const NodeRun& run) { return run.to - run.from < 1.5 * spacing; };
  const double leading = runs.front().to, trailing = runs.back().from;
  if (runs.size() > 1 && runs.front().zone == Zone::slip && single(runs.front())) {
    runs.erase(runs.begin());
    runs.front().to = leading;
  }
  if (runs.size() > 1 && single(runs.back())) {
    runs.pop_back();
    runs.back().from = trailing;
  }
}

}  // namespace

std::optional<PatternStart> pattern_on_grid(const ContactModel& model, double spacing) {
  ContactModel gridded = model;
  gridded.tolerance.reset();
  // What takes a grid long has zones that this method does not know.
  GridSeries grids = fixed_grids(gridded, spacing);
  grids.last_resort = false;
  const NestedOutcome nested = solve_nested(gridded, grids);
  if (nested.status != Status::converged) return {};
  std::vector<NodeRun> runs = node_runs(nested.finest, spacing);
  if (runs.empty()) return {};
  const double leading = runs.front().to, trailing = runs.back().from;
  drop_single_nodes(runs, spacing);
  std::reverse(runs.begin(), runs.end());
  PatternStart start;
  start.edges.contact = {trailing, leading};
  start.pattern.shear = true;
  if (runs.front().zone == Zone::stick) start.pattern.slips.push_back(0);
  // Slip turns round over a stick whose length is in proportion to the friction, perhaps much less than a cell.
  const double turn = 5 * model.friction_coefficient * (leading - trailing);
  const auto add_stick = [&](double from, double to) {
    const double centre = 0.5 * (from + to),
                 half = 0.5 * (to - from < 1.5 * spacing ? std::min(to - from, turn) : to - from);
    start.edges.sticks.push_back({centre - half, centre + half});
  };
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (i > 0 && runs[i].zone == runs[i - 1].zone)
      add_stick(runs[i].from - 0.5 * spacing, runs[i].from + 0.5 * spacing);
    if (runs[i].zone == Zone::stick)
      add_stick(runs[i].from, runs[i].to);
    else
      start.pattern.slips.push_back(runs[i].direction);
  }
  if (runs.back().zone == Zone::stick) start.pattern.slips.push_back(0);
  if (start.pattern.sticks() > most_sticks) return {};
  return start;
}

}  // namespace rollres
