#include "core/solve/rolling_contact.hpp"

#include <chrono>
#include <cmath>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "core/interior/interior_summary.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/scene_rules.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/solve/heat_balance.hpp"
#include "core/solve/model_answer.hpp"
#include "core/solve/strain_iteration.hpp"

namespace rollres {

namespace {

/// From an answer per metre to that of the body whose width is given.
void count_for_body(const RollingScene& scene, RollingSolution& solution) {
  if (!scene.width) return;
  visit_outputs(solution, [&](const Quantity& quantity, auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
      if (quantity.grows_with_width()) value *= *scene.width;
  });
  // The strain is not plane within about half a contact of each end.
  constexpr double long_enough = 4;
  const double contact = solution.leading_edge - solution.trailing_edge;
  if (*scene.width < long_enough * contact)
    solution.warnings.push_back(message_text("width = ", *scene.width, " m, only ", *scene.width / contact,
                                             " times the contact's length: the ends are left out (plane strain), which "
                                             "reach half a contact inwards"));
}

/// What the scene asks for is part of the answer as it was asked for: methods meet it to their own rounding.
void take_over_what_was_asked(const RollingScene& scene, RollingSolution& solution) {
  if (scene.load) solution.load = *scene.load;
  if (scene.approach) solution.approach = *scene.approach;
  // Without friction a coating takes the torque that turns it, whatever drives the body.
  const bool felt = scene.friction_coefficient > 0 || scene.coating_layers.empty();
  if (felt && scene.drive == Drive::torque && scene.driving_torque) solution.driving_torque = *scene.driving_torque;
  if (felt && scene.drive == Drive::free && std::isfinite(solution.driving_torque)) solution.driving_torque = 0;
  if (scene.drive == Drive::rotation && scene.rotation_ratio) solution.rotation_ratio = *scene.rotation_ratio;
  if (scene.skew_angle) solution.skew_angle = *scene.skew_angle;
  if (scene.skew_angle && is_straight(scene) && solution.status == Status::converged) {
    (dimension_of(scene.indenter) == 2 ? solution.axial_force : solution.lateral_force) = solution.creepage_y = 0;
    solution.creepage_x = 1 - solution.rotation_ratio;
  }
}

/// What `solved` answers, or the reason why there is no answer by this method.
template <class Solved>
RollingSolution answer_or_reason(Method method, Solved solved) {
  RollingSolution none;
  none.method = method;
  try {
    return solved();
  } catch (const BeyondLimits& limit) {
    none.reason = limit.what();
  } catch (const std::domain_error& error) {
    none.reason = error.what();
  } catch (const std::bad_alloc&) {
    none.reason = "this scene needs more memory than there is; give a larger spacing or tolerance";
  }
  return none;
}

RollingSolution isothermal_answer(const ContactModel& model) {
  return softens(model) ? solve_softening(model, solve_model) : solve_model(model);
}

RollingSolution answer(const RollingScene& scene, const ContactModel& model) {
  RollingSolution solution =
      scene.heat == Heat::on ? solve_with_heat(scene, isothermal_answer) : isothermal_answer(model);
  if (scene.interior == Interior::on && solution.status == Status::converged) add_interior(model, solution);
  return solution;
}

}  // namespace

RollingScene scene_per_metre(RollingScene scene) {
  if (!scene.width) return scene;
  if (scene.load) *scene.load /= *scene.width;
  if (scene.driving_torque) *scene.driving_torque /= *scene.width;
  if (scene.axial_force) *scene.axial_force /= *scene.width;
  scene.width.reset();
  return scene;
}

RollingSolution answer_of_width(const RollingScene& scene, RollingSolution per_metre) {
  count_for_body(scene, per_metre);
  take_over_what_was_asked(scene, per_metre);
  return per_metre;
}

RollingSolution solve(const RollingScene& scene) {
  const auto begin = std::chrono::steady_clock::now();
  const SolutionLimits limits = limits_of(scene);
  // A method that is chosen by the model is not known where there is none.
  RollingSolution solution = answer_or_reason(scene.method, [&] {
    require_valid(scene);
    const ContactModel model(scene);
    return answer_or_reason(model.method, [&] { return answer(scene, model); });
  });
  solution = answer_of_width(scene, std::move(solution));
  solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return solution;
}

}  // namespace rollres
