#include "core/solve/coating_flow.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/assumptions.hpp"
#include "core/estimate/grid_choice.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/stated_error.hpp"
#include "core/solve/doubts.hpp"
#include "core/solve/resolve.hpp"

namespace rollres {

namespace {

/// Whether the drive decides how fast a coating flows through the contact, and the answer depends on it.
bool flow_is_unknown(const ContactModel& model) {
  return model.friction_coefficient > 0 && model.drive != Drive::rotation && coating_flow_counts(model);
}

/// The model with the coating's share of what yields (indenter_shape.hpp) as the contact found has it, and not one that
/// was estimated, which depends on whether the load or the approach is given.
ContactModel with_own_share(ContactModel model, const RollingSolution& found) {
  if (!model.coating.empty()) model.coating_share = share_of_coating(model, half_length(found));
  return model;
}

/// Whether that share would change the creepage where the rotation is given, by more than R_r's stated error allows:
/// its terms are of second order in the slope.
bool share_counts(const ContactModel& model, const RollingSolution& found) {
  if (model.coating.empty() || model.friction_coefficient == 0 || model.drive != Drive::rotation ||
      found.status != Status::converged)
    return false;
  constexpr double share_of_error = 0.01, least_error = 1e-8;
  const double slope = half_length(found) / model.radius;
  const double change = share_of_coating(model, half_length(found)) - share_of_coating(model);
  return std::abs(change) * slope * slope >
         share_of_error * std::max(least_error, found.error_estimate) * std::abs(1 - found.rotation_ratio);
}

constexpr const char* stopped =
    "this drive stops the coated body or turns it backwards; give rotation_ratio, with drive \"rotation\"";

}  // namespace

RollingSolution solve_at_own_flow(const ContactModel& full,
                                  const std::function<RollingSolution(const ContactModel&)>& solve_at) {
  const ContactModel first = simplified(full);
  RollingSolution solution = solve_at(first);
  if (share_counts(first, solution)) return solve_at(with_own_share(first, solution));
  if (!flow_is_unknown(full) || !flow_is_unknown(first)) return solution;
  constexpr int most_solutions = 8;
  constexpr double share_of_error = 0.01;
  double flow = full.flow, response = 0, sensitivity = std::abs(solution.rolling_resistance);
  for (int solutions = 1; solution.status == Status::converged; ++solutions) {
    const double step = (solution.rotation_ratio - flow) / (1 - response), left = sensitivity * std::abs(step);
    if (left <= share_of_error * solution.rolling_resistance_error || solutions == most_solutions) {
      if (left > solution.rolling_resistance_error)
        solution.warnings.push_back(
            message_text("the speed at which the coating flows was found to ", std::abs(step), " of V only"));
      add_error(left / std::abs(solution.rolling_resistance), solution);
      break;
    }
    flow += step;
    if (!(flow > 0)) return without_answer(solution.method, Status::not_converged, stopped);
    const RollingSolution before = std::move(solution);
    solution = solve_at(with_own_share(simplified(full.with_flow(flow)), before));
    response = std::clamp((solution.rotation_ratio - before.rotation_ratio) / step, -2.0, 0.8);
    sensitivity = std::abs((solution.rolling_resistance - before.rolling_resistance) / step);
  }
  return solution;
}

}  // namespace rollres
