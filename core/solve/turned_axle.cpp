#include "core/solve/turned_axle.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

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

/// The output that answers `ContactModel::side_force`.
double RollingSolution::*side_force_of(const ContactModel& model) {
  return model.dimension == 2 ? &RollingSolution::axial_force : &RollingSolution::lateral_force;
}

/// Adds what the resistance is open by where the force at a skew is known as well as the resistance is, from the answer
/// at a neighbouring skew: where nearly all slides, the force hardly tells the skew.
/// @param force and force_beside at these skews
void take_open_skew(double skew, double force, const RollingSolution& beside, double skew_beside, double force_beside,
                    const std::string& key, RollingSolution& solution) {
  constexpr double much = 0.05;
  const double change = solution.error_estimate * std::abs(force) / std::abs(force_beside - force);
  add_error(change * std::abs(1 - beside.rolling_resistance / solution.rolling_resistance), solution);
  if (const double open = change * std::abs(skew_beside / skew - 1); open > much)
    solution.warnings.push_back(message_text(
        key, ": nearly all of the contact slides, so that the force hardly tells the skew, which is open by ",
        100 * open, " %"));
}

/// The skew and the creepages of a sphere, whose model is in the frame of the travel.
void tell_turning(const ContactModel& model, RollingSolution& solution) {
  if (model.skew == 0 && model.camber == 0 && model.pivot == 0 && !model.side_force) return;
  solution.skew_angle = std::atan(model.skew);
  if (model.mirrored()) solution.lateral_force = solution.spin_moment = solution.overturning_moment = 0;
  const auto [e_x, e_y, e_z] = model.axle();
  const double turning = solution.rotation_ratio;
  solution.creepage_x = 1 - turning * e_y;
  solution.creepage_y = turning * e_x + 0.0;  // no negative zero
  solution.spin = turning * e_z / model.radius + model.pivot;
}

/// Where a solution on the way has no answer.
struct Failed {
  RollingSolution solution;
};

}  // namespace

RollingSolution solve_at_own_skew(const ContactModel& model,
                                  const std::function<RollingSolution(const ContactModel&)>& solve) {
  if (!model.side_force) return solve(model);
  const double wanted = *model.side_force;
  double RollingSolution::*const force = side_force_of(model);
  const std::string key = model.dimension == 2 ? "axial_force" : "lateral_force";
  std::optional<RollingSolution> last;
  double most = 0;  // of the forces on the way
  const auto solved = [&](double skew) {
    RollingSolution found = solve(model.with_skew(skew));
    if (found.status != Status::converged) throw Failed{std::move(found)};
    last = std::move(found);
    most = std::max(most, std::abs((*last).*force));
    return (*last).*force;
  };
  const ContactEstimate estimate = estimate_contact(model);
  const double borne = model.friction_coefficient * model.load.value_or(estimate.load);
  const auto beyond = [&](double bears) {
    return without_answer(Method::newton, Status::no_steady_state,
                          message_text(key, " = ", model.told(wanted), ": friction bears ", model.told(bears),
                                       model.told_per_metre() ? " N/m along the axle"
                                       : model.dimension == 2 ? " N along the axle"
                                                              : " N across the travel",
                                       " at most"));
  };
  constexpr double steepest = 5, growth = 2, tolerance = 1e-11;  // 79 degrees; of the skew, relative
  try {
    // The force falls as the skew grows; without another turning it is zero with the axle straight.
    const bool turned = model.camber != 0 || model.pivot != 0;
    const double when_straight = turned ? solved(0) : 0;
    if (when_straight == wanted) return turned ? std::move(*last) : solve(model.with_skew(0));
    if (model.dimension == 2 && model.load && !(std::abs(wanted) < borne)) return beyond(borne);
    const double side = when_straight > wanted ? 1 : -1;
    const auto missing = [&](double skew) {
      return side * (wanted - (skew == 0 ? when_straight : solved(side * skew)));
    };
    const double part = std::min(0.999, std::abs(wanted - when_straight) / borne);
    double high = 1.2 * skew_of_carter(model, estimate.half_width, part), low = 0;
    while (missing(high) < 0) {
      if (high >= steepest) return beyond(most);
      low = high;
      high = std::min(steepest, growth * high);
    }
    const double skew = bracketed_root(missing, low, high, tolerance), beside = 1.01 * skew;
    RollingSolution answer = std::move(*last);  // at one of the bracket's ends, as good as its root
    const double force_beside = solved(side * beside);
    take_open_skew(skew, answer.*force, *last, beside, force_beside, key, answer);
    answer.*force = wanted;
    return answer;
  } catch (Failed& failed) {
    return std::move(failed.solution);
  }
}

void turn_to_travel(const ContactModel& model, RollingSolution& solution) {
  if (model.dimension == 3) return tell_turning(model, solution);
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
