#include "studies/evidence/stability_trial.hpp"

#include <chrono>
#include <cmath>
#include <exception>
#include <optional>
#include <type_traits>

#include "core/messages/message_text.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

namespace {

constexpr double largest_violation = 1e-8;
constexpr double friction_margin = 0.02;

/// The first number of an answer that must be finite and is not; empty if all are.
std::string_view missing_number(const RollingScene& scene, const RollingSolution& solution) {
  static constexpr std::string_view needed[] = {"rolling_resistance", "rolling_resistance_coefficient",
                                                "driving_force",      "driving_torque",
                                                "approach",           "load",
                                                "leading_edge",       "trailing_edge",
                                                "contact_area",       "mean_pressure",
                                                "peak_pressure",      "viscous_loss",
                                                "energy_residual",    "law_violation"};
  static constexpr std::string_view needed_with_friction[] = {"rotation_speed", "rotation_ratio", "frictional_loss",
                                                              "peak_shear_x"};
  std::string_view missing;
  visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
      const bool counts = find_name(needed, quantity.key) >= 0 ||
                          (scene.friction_coefficient > 0 && find_name(needed_with_friction, quantity.key) >= 0);
      if (counts && missing.empty() && !std::isfinite(value)) missing = quantity.key;
    }
  });
  return missing;
}

bool laws_held(const RollingSolution& solution) {
  return solution.status == Status::converged && solution.law_violation < largest_violation;
}

/// What speaks against a refusal; empty if it is confirmed.
std::string objection(const Evaluate& evaluate, RollingScene scene, const RollingSolution& refused) {
  // Too little friction for the drive, or too much for the body.
  const bool too_little = std::isfinite(refused.friction_needed);
  const double limit = too_little ? refused.friction_needed : refused.friction_borne;
  const double margin = too_little ? friction_margin : -friction_margin;
  const std::string_view more = too_little ? "2 % more" : "2 % less", less = too_little ? "2 % less" : "2 % more";
  const std::string_view verb = too_little ? "needed" : "borne";
  if (!std::isfinite(limit)) return "it does not say which friction coefficient is needed or borne";
  if (too_little ? limit <= scene.friction_coefficient : limit >= scene.friction_coefficient)
    return message_text<6>("the friction coefficient ", verb, " is ", limit, " and it has ",
                           scene.friction_coefficient);
  const auto solved_with = [&](double part) {
    scene.friction_coefficient = part * limit;
    return evaluate(scene);
  };
  const RollingSolution inside = solved_with(1 + margin);
  if (inside.status != Status::converged)
    return message_text<6>("with ", more, " friction than ", verb, " (", scene.friction_coefficient, ") it is ",
                           name_of(inside.status), inside.reason.empty() ? "" : ": ", inside.reason);
  if (!laws_held(inside))
    return message_text<6>("with ", more, " friction than ", verb, " (", scene.friction_coefficient,
                           ") a law of contact is violated by ", inside.law_violation);
  if (solved_with(1 - margin).status == Status::converged)
    return message_text<6>("it converges with ", less, " friction than ", verb, " (", scene.friction_coefficient, ")");
  return {};
}

void judge_solution(const Evaluate& evaluate, const RollingSolution& solution, Trial& trial) {
  TrialNumbers& numbers = trial.numbers;
  trial.reason = solution.reason;
  numbers.law_violation = solution.law_violation;
  numbers.energy_residual = solution.energy_residual;
  numbers.friction_needed = solution.friction_needed;
  numbers.rolling_resistance = solution.rolling_resistance;
  numbers.contact_nodes = solution.contact_nodes;
  numbers.slip_nodes = solution.slip_nodes;
  numbers.iterations = solution.iterations;
  switch (solution.status) {
    case Status::converged: {
      const std::string_view missing = missing_number(trial.scene, solution);
      if (!missing.empty())
        trial.reason = message_text<6>("says converged, but ", missing, " is not finite");
      else if (!laws_held(solution))
        trial.reason = message_text<6>("says converged, but a law of contact is violated by ", solution.law_violation);
      numbers.outcome = missing.empty() && laws_held(solution) ? Outcome::converged : Outcome::wrong;
      break;
    }
    case Status::no_steady_state: {
      const std::string against = objection(evaluate, trial.scene, solution);
      numbers.outcome = against.empty() ? Outcome::refused : Outcome::unconfirmed;
      if (!against.empty()) trial.reason += (trial.reason.empty() ? "" : "; but ") + against;
      break;
    }
    case Status::not_converged:
      numbers.outcome = Outcome::not_converged;
      break;
  }
}

}  // namespace

Trial judge(const Evaluate& evaluate, const RollingScene& scene, std::size_t number) noexcept {
  Trial trial{number, scene, {}, {}};
  try {
    const auto begin = std::chrono::steady_clock::now();
    const RollingSolution solution = evaluate(scene);
    trial.numbers.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    judge_solution(evaluate, solution, trial);
  } catch (const std::exception& error) {
    trial.numbers.outcome = Outcome::crashed;
    trial.reason = error.what();
  } catch (...) {
    trial.numbers.outcome = Outcome::crashed;
    trial.reason = "an exception of unknown type";
  }
  return trial;
}

Table trials_table(const std::vector<Trial>& trials) {
  Table table{{"number"}, {}};
  for (const std::string_view key : input_keys()) table.columns.emplace_back(key);
  for (const char* name : {"outcome", "reason", "law_violation", "energy_residual", "friction_needed",
                           "rolling_resistance", "contact_nodes", "slip_nodes", "iterations", "seconds"})
    table.columns.emplace_back(name);
  for (const Trial& trial : trials) {
    std::vector<Cell>& row = table.rows.emplace_back();
    row.push_back(cell_of(trial.number));
    for (Cell& cell : input_cells(trial.scene)) row.push_back(std::move(cell));
    const TrialNumbers& n = trial.numbers;
    for (const Cell& cell :
         {cell_of(n.outcome), cell_of(trial.reason), cell_of(n.law_violation), cell_of(n.energy_residual),
          cell_of(n.friction_needed), cell_of(n.rolling_resistance), cell_of(n.contact_nodes), cell_of(n.slip_nodes),
          cell_of(n.iterations), cell_of(n.seconds)})
      row.push_back(cell);
  }
  return table;
}

std::string failed_scene_json(const Trial& trial) {
  Json scene = Json::object();
  scene["comment"] = std::string(name_of(trial.numbers.outcome)) + (trial.reason.empty() ? "" : ": ") + trial.reason;
  scene.update(parse_object(scene_json(trial.scene), "scene"));
  return scene.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string failed_scene_name(const Trial& trial) {
  return std::string(name_of(trial.scene.method)) + '-' + std::string(name_of(trial.scene.indenter)) + '-' +
         std::to_string(trial.number) + ".json";
}

}  // namespace rollres
