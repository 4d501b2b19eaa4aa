#include "core/solve/doubts.hpp"

#include <algorithm>
#include <cmath>

#include "core/influence/influence.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/stated_error.hpp"
#include "core/newton/contact_powers.hpp"

namespace rollres {

namespace {

/// Load times the longer half of the contact over the radius, or times the slope that a given pressure makes [N]: what
/// a resistance is small or large against.
double lever_of_load(const ContactModel& model, const RollingSolution& solution) {
  if (model.loaded) return solution.load * std::abs(solution.peak_deflection) / model.loaded->half_length;
  return solution.load * std::max(std::abs(solution.leading_edge), std::abs(solution.trailing_edge)) / model.radius;
}

/// What an elastic layer resists with is rounding and the grid's, of the lever of the load.
bool resists(const ContactModel& model, const RollingSolution& solution) {
  return std::abs(solution.rolling_resistance) >= negligible_resistance * lever_of_load(model, solution);
}

/// From the first node in contact along x to the last [m].
double length_of_nodes(const SurfaceFields& fields) {
  int first = fields.grid.columns, last = -1;
  for (std::size_t i = 0; i < fields.zone.size(); ++i) {
    const auto column = static_cast<int>(i) % fields.grid.columns;
    if (fields.zone[i] == Zone::free) continue;
    first = std::min(first, column);
    last = std::max(last, column);
  }
  return (last - first) * fields.grid.spacing_x;
}

/// What to change where a law of contact is not kept: a method that iterates until it is, another grid.
const char* advice_of_law(const ContactModel& model, const RollingSolution& solution) {
  if (solution.method == Method::active_set) return "take method \"newton\", or another spacing";
  if (!on_grid(solution.method)) return "take method \"newton\"";
  return model.tolerance && !model.spacing ? "take another tolerance, or a spacing" : "take another spacing";
}

}  // namespace

RollingSolution without_answer(Method method, Status status, std::string reason) {
  RollingSolution solution;
  solution.method = method;
  solution.status = status;
  solution.reason = std::move(reason);
  return solution;
}

std::string doubt(const ContactModel& model, const RollingSolution& solution) {
  if (!model.loaded && !(solution.law_violation <= trusted_violation))
    return message_text("a law of contact is violated by ", solution.law_violation, ", more than ", trusted_violation,
                        ": ", advice_of_law(model, solution));
  if (!(solution.rolling_resistance_error >= 0)) return "the error of the rolling resistance cannot be estimated";
  if (model.loaded) return {};  // whose R_r is no sum over the grid, and needs no balance
  const double length =
      on_grid(solution.method) ? length_of_nodes(solution.fields) : solution.leading_edge - solution.trailing_edge;
  if (on_grid(solution.method) && !(length >= 1.5 * solution.spacing))
    return message_text("the contact has only ", solution.contact_nodes, " nodes: take a spacing below ",
                        std::min(solution.spacing, length + solution.spacing) / 8, " m");
  if (!resists(model, solution)) return {};
  const double resistance = solution.rolling_resistance, lever = lever_of_load(model, solution);
  // Printed kinematics leave a power of this order in the balance of a driven body.
  const double reach = model.kinematics == Kinematics::printed ? lever / solution.load : 0;
  const double unbalanced = std::abs(solution.driving_torque) / model.radius * reach * reach;
  if (resistance < -unbalanced - solution.rolling_resistance_error)
    return message_text("the body would gain power: rolling resistance ", model.told(resistance),
                        model.told_per_metre() ? " N/m" : " N", " with an estimated relative error of ",
                        solution.error_estimate);
  // What the edges of the contact take between nodes (core/newton/README.md, (N15)); on random scenes a third of this.
  const double cells = on_grid(solution.method) ? 0.5 * length / solution.spacing : INFINITY;
  const double balanced =
      std::max({trusted_balance, solution.error_estimate, lever / std::abs(resistance) / std::pow(cells, 1.5)});
  if (solution.energy_residual > balanced)
    return message_text("the power balance misses ", solution.energy_residual, " of it, more than ", balanced);
  return {};
}

std::string unknown_resistance(const ContactModel& model, const RollingSolution& solution) {
  const double resistance = std::abs(solution.rolling_resistance), error = solution.rolling_resistance_error;
  if (error <= resistance || !resists(model, solution)) return {};
  const char* advice = model.spacing     ? "give a smaller spacing, or a tolerance in its place"
                       : model.tolerance ? "give a larger time_limit or memory_limit"
                                         : "give a tolerance, such as 0.01";
  return message_text("the rolling resistance, ", solution.rolling_resistance, ", has an estimated error of ", error,
                      ", more than itself: ", advice);
}

double expansion_share(const ContactModel& model, const RollingSolution& solution) {
  constexpr double amplified = 3;  // phases, of which R_r is made, are worse than compliances
  if (!model.composite() || model.period || !on_grid(solution.method)) return 0;
  return amplified * expansion_error(model);
}

bool misses_tolerance(const ContactModel& model, const std::optional<double>& tolerance,
                      const RollingSolution& solution) {
  const double scale = std::max(std::abs(solution.rolling_resistance), 1e-6 * lever_of_load(model, solution));
  return tolerance && solution.rolling_resistance_error > *tolerance * scale;
}

void take_evidence(const ContactModel& model, RollingSolution& solution) {
  if (-solution.rolling_resistance > solution.rolling_resistance_error)
    set_error(-solution.rolling_resistance, solution);
  if (model.loaded || !(solution.energy_residual > trusted_balance) || !resists(model, solution)) return;
  const double missed = solution.energy_residual * std::abs(solution.rolling_resistance);
  solution.error_estimate = std::max(solution.error_estimate, solution.energy_residual);
  solution.rolling_resistance_error = std::max(solution.rolling_resistance_error, missed);
}

}  // namespace rollres
