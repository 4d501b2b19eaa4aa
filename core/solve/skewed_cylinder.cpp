#include "core/solve/skewed_cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/estimate/grid_choice.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/stated_error.hpp"
#include "core/numerics/bracketed_root.hpp"
#include "core/solve/doubts.hpp"

namespace rollres {

namespace {

/// tan a at which an elastic half-space, rolling straight, would bear this part of the bound: Carter's solution along
/// the axle, where the surface yields twice as much as to pressure (nu = 1/2).
double skew_of_carter(const ContactModel& model, double half_width, double part) {
  return 2 * model.friction_coefficient * half_width / model.radius * (1 - std::sqrt(1 - part));
}

/// Adds what the resistance is open by where the force at a skew is known as well as the resistance is, from the answer
/// at a neighbouring skew: where nearly all slides, the force hardly tells the skew.
void take_open_skew(double skew, const RollingSolution& beside, double skew_beside, RollingSolution& solution) {
  constexpr double much = 0.05;
  const double force_error = solution.error_estimate * std::abs(solution.axial_force);
  const double change = force_error / std::abs(beside.axial_force - solution.axial_force);
  add_error(change * std::abs(1 - beside.rolling_resistance / solution.rolling_resistance), solution);
  if (const double open = change * std::abs(skew_beside / skew - 1); open > much)
    solution.warnings.push_back(
        message_text("axial_force: nearly all of the contact slides, so that the force hardly "
                     "tells the skew, which is open by ",
                     100 * open, " %"));
}

/// Where a solution on the way has no answer.
struct Failed {
  RollingSolution solution;
};

}  // namespace

RollingSolution solve_at_own_skew(const ContactModel& model,
                                  const std::function<RollingSolution(const ContactModel&)>& solve) {
  if (!model.axial_force) return solve(model);
  const double wanted = *model.axial_force, side = wanted > 0 ? -1 : 1;
  if (wanted == 0) return solve(model);
  const ContactEstimate estimate = estimate_contact(model);
  const double borne = model.friction_coefficient * model.load.value_or(estimate.load);
  const auto beyond = [&](double most) {
    return without_answer(Method::newton, Status::no_steady_state,
                          message_text("axial_force = ", model.told(wanted), ": friction bears ", model.told(most),
                                       model.told_per_metre() ? " N/m" : " N", " along the axle at most"));
  };
  if (model.load && !(std::abs(wanted) < borne)) return beyond(borne);
  constexpr double steepest = 5, growth = 2, tolerance = 1e-11;  // 79 degrees; of the skew, relative
  std::optional<RollingSolution> last;
  const auto missing = [&](double skew) {
    if (skew == 0) return -std::abs(wanted);
    RollingSolution found = solve(model.with_skew(side * skew));
    if (found.status != Status::converged) throw Failed{std::move(found)};
    last = std::move(found);
    return std::abs(last->axial_force) - std::abs(wanted);
  };
  try {
    const double part = std::min(0.999, std::abs(wanted) / borne);
    double high = 1.2 * skew_of_carter(model, estimate.half_width, part), low = 0;
    while (missing(high) < 0) {
      if (high >= steepest) return beyond(std::abs(last->axial_force));
      low = high;
      high = std::min(steepest, growth * high);
    }
    const double skew = bracketed_root(missing, low, high, tolerance), beside = 1.01 * skew;
    RollingSolution answer = std::move(*last);  // at one of the bracket's ends, as good as its root
    missing(beside);
    take_open_skew(skew, *last, beside, answer);
    answer.axial_force = wanted;
    return answer;
  } catch (Failed& failed) {
    return std::move(failed.solution);
  }
}

void turn_to_travel(const ContactModel& model, RollingSolution& solution) {
  if (!model.skewed()) return;
  solution.skew_angle = std::atan(model.skew);
  if (model.friction_coefficient == 0) solution.axial_force = 0;
  const double cosine = std::cos(solution.skew_angle), sine = std::sin(solution.skew_angle);
  solution.rolling_resistance *= cosine;
  solution.rolling_resistance_error *= cosine;
  solution.rolling_resistance_coefficient *= cosine;
  solution.driving_force = cosine * solution.driving_force - sine * solution.axial_force;
  solution.rotation_ratio *= cosine;
  solution.creepage_x = 1 - solution.rotation_ratio * cosine;
  solution.creepage_y = -solution.rotation_ratio * sine;
}

}  // namespace rollres
