#include "core/zones/spectral_friction_limit.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/bracketed_root.hpp"
#include "core/zones/spectral_field.hpp"
#include "core/zones/spectral_search.hpp"
#include "core/zones/spectral_start.hpp"
#include "core/zones/surface_panels.hpp"

namespace rollres {

namespace {

/// Whether the body pulls somewhere: of a thin compressible layer under much friction the equations have such roots.
bool pulls(const SpectralProblem& problem, const SpectralState& state) {
  constexpr double tolerated = 1e-3;  // of the largest pressure
  constexpr int points = 100;
  const SpectralField field(problem, state);
  const Interval& contact = state.edges.contact;
  double least = INFINITY, largest = 0;
  for (int k = 1; k < points; ++k) {
    const double pressure = field.pressure(contact.from + 2 * contact.half_length() * k / points);
    least = std::min(least, pressure);
    largest = std::max(largest, pressure);
  }
  return !(least > -tolerated * largest) || !(state.load > 0);
}

/// Surplus of the drive's row [N/m] in the direction asked for, when the body turns so fast (+1) or so slowly (-1) that
/// the whole contact slides one way; NaN if that could not be solved.
double sliding_surplus(const SpectralProblem& given, const Interval& contact, double friction, int direction) {
  SpectralProblem problem = given;
  problem.model.friction_coefficient = friction;
  const SlipPattern sliding{.shear = true, .slips = {-direction}};
  const SpectralEdges start{contact, {}};
  const int order = first_order(problem, start, 1e-8, true);
  const std::optional<SpectralState> state = EdgeSearch(problem, sliding).find(start, {order, order}, 1e-10);
  if (!state || pulls(problem, *state)) return NAN;
  double surplus = drive_row(problem.model, state->driving_torque, state->driving_force) - drive_target(problem.model);
  if (problem.side) {
    surplus += coating_in_drive(problem.model, coating_moments(problem, *state)) -
               coating_in_drive(problem.model, problem.coating_moments);
  }
  return direction * surplus;
}

}  // namespace

std::optional<double> friction_needed(const SpectralProblem& problem, const Interval& contact) {
  const double given = problem.model.friction_coefficient;
  for (const int direction : {1, -1}) {
    const auto surplus = [&](double friction) { return sliding_surplus(problem, contact, friction, direction); };
    if (!(surplus(given) < 0)) continue;
    double low = given, high = 2 * given, at_high = surplus(high);
    for (int doubling = 0; doubling < 40 && at_high < 0; ++doubling) {
      low = high;
      high *= 2;
      at_high = surplus(high);
    }
    if (!(at_high >= 0)) return {};
    return bracketed_root(surplus, low, high, 1e-9);
  }
  return {};
}

}  // namespace rollres
