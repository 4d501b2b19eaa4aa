#include "core/spectral_start.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/bracketed_root.hpp"
#include "core/grid_choice.hpp"
#include "core/nested_newton.hpp"

namespace rollres {

int first_order(const SpectralProblem& problem, const SpectralEdges& edges, double tolerance) {
  // The layer's corrections are singular at 2 H from the surface: coefficients fall like rate^{-n}.
  const double distance = 2 * problem.thickness / edges.half_length();
  const double rate = std::isfinite(distance) ? std::log(distance + std::sqrt(distance * distance + 1)) : 5;
  return std::clamp(static_cast<int>(3 - std::log(tolerance) / (2.2 * rate)), 4, 40);
}

std::optional<SpectralState> frictionless_start(const SpectralProblem& problem) {
  const double half = estimate_contact(problem.scene).half_width;
  const double widest = widest_window(problem.scene);
  for (const double size : {1.0, 0.7, 1.3, 0.5, 2.0})
    for (const double shift : {0.0, 0.3}) {
      const double l = std::min(size * half, 0.7 * widest), c = shift * l;
      EdgeSearch search(problem, {});
      const SpectralEdges start{c - l, c + l, c - l, c + l};
      const int order = first_order(problem, start, 1e-3);
      if (std::optional<SpectralState> state = search.find(start, {order, order}, 1e-4)) return state;
    }
  return {};
}

std::optional<PatternStart> one_border_start(const SpectralProblem& problem, const SpectralEdges& contact) {
  const int order = first_order(problem, contact, 1e-4);
  SpectralEdges edges = contact;
  edges.stick_to = contact.leading;
  SlipPattern pattern{.shear = true, .stick = true, .trailing = 1, .leading = 0};
  const auto missing = [&](double place) {  // root of the slipping part
    edges.stick_from = contact.trailing + 2 * contact.half_length() * place * place;
    return solve_inside(problem, pattern, edges, {order, order}).residuals(2);
  };
  // With next to no slip the shear would be singular at the trailing edge, in the direction of the slip to come.
  double low = 1e-7, at_low = missing(low);
  if (!std::isfinite(at_low)) return {};
  if (std::abs(at_low) < 1e-9) {
    edges.stick_from = contact.trailing;
    return PatternStart{{.shear = true, .stick = true, .trailing = 0, .leading = 0}, edges};
  }
  pattern.trailing = at_low < 0 ? 1 : -1;
  at_low = missing(low);
  for (const double high : {1e-5, 1e-3, 0.03, 0.2, 0.45, 0.63, 0.8, 0.92, 0.97, 0.99}) {
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

std::optional<PatternStart> pattern_on_grid(const RollingScene& scene, double spacing) {
  RollingScene gridded = scene;
  gridded.tolerance.reset();
  const NestedOutcome nested = solve_nested(gridded, spacing, nullptr);
  if (nested.status != Status::converged) return {};
  const ContactLevel& level = nested.finest;
  const SurfaceGrid& grid = level.problem->grid;
  // From the leading edge: slip (perhaps), stick (perhaps), slip.
  struct Run {
    Zone zone;
    int direction;
    double from, to;
  };
  std::vector<Run> runs;
  for (int i = grid.columns - 1; i >= 0; --i) {
    const Zone zone = level.outcome.zone[static_cast<std::size_t>(i)];
    if (zone == Zone::free) continue;
    const double x = grid.x(i);
    const int direction = zone == Zone::stick ? 0 : level.outcome.unknowns.shear_x(i) > 0 ? 1 : -1;
    if (runs.empty() || runs.back().zone != zone || runs.back().direction != direction)
      runs.push_back({zone, direction, x - 0.5 * spacing, x + 0.5 * spacing});
    runs.back().from = x - 0.5 * spacing;
  }
  if (runs.empty()) return {};
  PatternStart start;
  start.edges = {runs.back().from, runs.front().to, runs.back().from, runs.front().to};
  start.pattern.shear = true;
  // A single slipping node at the leading edge is an artefact of the grid.
  if (runs.size() > 1 && runs.front().zone == Zone::slip && runs.front().to - runs.front().from < 1.5 * spacing)
    runs.erase(runs.begin());
  if (runs.size() == 1) {
    if (runs[0].zone == Zone::stick) return {};
    start.pattern.trailing = runs[0].direction;
    return start;
  }
  const bool leading = runs[0].zone == Zone::slip;
  const std::size_t stick = leading ? 1 : 0;
  if (runs.size() != stick + 2 || runs[stick].zone != Zone::stick) return {};
  start.pattern.stick = true;
  start.pattern.trailing = runs[stick + 1].direction;
  start.edges.stick_from = runs[stick].from;
  if (leading) {
    start.pattern.leading = runs[0].direction;
    start.edges.stick_to = runs[stick].to;
  }
  return start;
}

}  // namespace rollres
