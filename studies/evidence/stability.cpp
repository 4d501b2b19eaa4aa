#include "studies/evidence/stability.hpp"

#include <chrono>
#include <cmath>

#include "core/messages/message_text.hpp"
#include "core/model/absent_outputs.hpp"
#include "core/model/scene_rules.hpp"
#include "studies/evidence/power_law.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

constexpr double largest_violation = 1e-8;
constexpr double friction_margin = 0.02;

/// The first number of an answer that must be finite and is not; empty if all are. None is missing that the scene
/// cannot have: a cylinder has no approach to a half-space.
std::string_view missing_number(const RollingScene& scene, const RollingSolution& solution) {
  constexpr std::string_view needed =
      "rolling_resistance rolling_resistance_coefficient driving_force driving_torque approach load leading_edge "
      "trailing_edge contact_area mean_pressure peak_pressure viscous_loss energy_residual law_violation";
  constexpr std::string_view needed_with_friction = "rotation_speed rotation_ratio frictional_loss peak_shear_x";
  std::string_view missing;
  visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
      const bool counts = has_word(needed, quantity.key) ||
                          (scene.friction_coefficient > 0 && has_word(needed_with_friction, quantity.key));
      if (counts && missing.empty() && !std::isfinite(value) && why_absent(scene, quantity.key).empty())
        missing = quantity.key;
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

void judge_solution(const Evaluate& evaluate, Trial& trial) {
  const RollingSolution& solution = trial.solution;
  trial.reason = solution.reason;
  switch (solution.status) {
    case Status::converged: {
      const std::string_view missing = missing_number(trial.scene, solution);
      if (!missing.empty())
        trial.reason = message_text<6>("says converged, but ", missing, " is not finite");
      else if (!laws_held(solution))
        trial.reason = message_text<6>("says converged, but a law of contact is violated by ", solution.law_violation);
      trial.outcome = missing.empty() && laws_held(solution) ? Outcome::converged : Outcome::wrong;
      break;
    }
    case Status::no_steady_state: {
      const std::string against = objection(evaluate, trial.scene, solution);
      trial.outcome = against.empty() ? Outcome::refused : Outcome::unconfirmed;
      if (!against.empty()) trial.reason += (trial.reason.empty() ? "" : "; but ") + against;
      break;
    }
    case Status::not_converged:
      trial.outcome = Outcome::not_converged;
      break;
  }
}

/// What a child process tells of a trial.
template <class SomeTrial, class Visitor>
void visit_answer(SomeTrial&& trial, Visitor&& visitor) {
  visitor(trial.outcome);
  visitor(trial.seconds);
  visitor(trial.reason);
  visit_outputs(trial.solution, [&](const Quantity&, auto& value) { visitor(value); });
}

/// All trials of a plan, cylinders and spheres in even mixture, so that the time left can be told.
std::vector<Trial> planned(const StabilityPlan& plan) {
  std::vector<Trial> trials;
  std::size_t cylinder = 0, sphere = 0;
  while (cylinder < plan.cylinders || sphere < plan.spheres) {
    const bool next_is_sphere =
        cylinder == plan.cylinders || (sphere < plan.spheres && sphere * plan.cylinders < cylinder * plan.spheres);
    Trial trial{.number = next_is_sphere ? sphere++ : cylinder++, .scene = {}};
    trial.scene =
        stability_scene(next_is_sphere ? Indenter::sphere : Indenter::cylinder, plan.seed, trial.number, plan.spectra);
    for (const Method method : plan.methods) {
      // Of bodies and surfaces that continuous edges are not there for.
      if (method == Method::spectral && !spectral_refusal(ContactModel(trial.scene)).empty()) continue;
      Trial& added = trials.emplace_back(trial);
      added.scene.method = method;
      added.scene.time_limit = plan.time_limit;
      if (!on_grid(method)) added.scene.spacing.reset();
    }
  }
  return trials;
}

}  // namespace

Trial judge(const Evaluate& evaluate, const RollingScene& scene) noexcept {
  Trial trial{.scene = scene};
  try {
    const auto begin = std::chrono::steady_clock::now();
    trial.solution = evaluate(scene);
    trial.seconds = seconds_since(begin);
    judge_solution(evaluate, trial);
  } catch (const std::exception& error) {
    trial.outcome = Outcome::crashed;
    trial.reason = error.what();
  } catch (...) {
    trial.outcome = Outcome::crashed;
    trial.reason = "an exception of unknown type";
  }
  return trial;
}

Table trials_table(const std::vector<Trial>& trials) {
  return table_of(trials, [](const Trial& trial) {
    NamedCells row = input_cells(trial.scene);
    row.insert(row.begin(), {"number", cell_of(trial.number)});
    row.emplace_back("outcome", cell_of(trial.outcome));
    row.emplace_back("reason", cell_of(trial.reason));
    for (const char* key : {"law_violation", "energy_residual", "friction_needed", "rolling_resistance",
                            "contact_nodes", "slip_nodes", "iterations"})
      row.emplace_back(key, output_of(trial.solution, key));
    row.emplace_back("seconds", cell_of(trial.seconds));
    return row;
  });
}

std::string failed_scene_json(const Trial& trial) {
  Json scene = Json::object();
  scene["comment"] = std::string(name_of(trial.outcome)) + (trial.reason.empty() ? "" : ": ") + trial.reason;
  scene.update(parse_object(scene_json(trial.scene), "scene"));
  return scene.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string failed_scene_name(const Trial& trial) {
  return std::string(name_of(trial.scene.method)) + '-' + std::string(name_of(trial.scene.indenter)) + '-' +
         std::to_string(trial.number) + ".json";
}

StabilityReport run_stability(const StabilityPlan& plan, const Evaluate& evaluate) {
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<Trial> trials = planned(plan);
  const auto tell = [&](const Trial& trial, Packer& pack) { visit_answer(judge(evaluate, trial.scene), pack); };
  const auto take = [&](Trial& trial, const PieceEnd& end) {
    if (end.out_of_time) {
      trial.outcome = Outcome::not_converged;
      trial.seconds = end.seconds;
      trial.reason = "no answer within " + short_number(plan.time_limit) + " s";
    } else if (!end.death.empty()) {
      trial.reason = end.death;
    } else {
      visit_answer(trial, Unpacker{end.answer});
    }
    if (plan.on_trial) plan.on_trial(trial);
    return !is_failure(trial.outcome);
  };
  StabilityReport report{.trials = try_forked(plan.work(trials.size()), trials, tell, take)};
  stable_sort(report.trials, [](const Trial& a, const Trial& b) {
    return a.scene.indenter != b.scene.indenter ? a.scene.indenter < b.scene.indenter : a.number < b.number;
  });
  report.interrupted = report.trials.size() < trials.size();
  report.seconds = seconds_since(begin);
  return report;
}

std::vector<StabilityCount> counts(const std::vector<Trial>& trials) {
  std::vector<StabilityCount> all;
  for (std::size_t indenter = 0; indenter < ChoiceNames<Indenter>::names.size(); ++indenter)
    for (std::size_t method = 0; method < ChoiceNames<Method>::names.size(); ++method) {
      StabilityCount count{static_cast<Method>(method), static_cast<Indenter>(indenter)};
      std::vector<double> times;
      for (const Trial& trial : trials) {
        if (trial.scene.method != count.method || trial.scene.indenter != count.indenter) continue;
        ++count.of[static_cast<std::size_t>(trial.outcome)];
        if (std::isfinite(trial.seconds)) times.push_back(trial.seconds);
      }
      if (count.trials() == 0) continue;
      count.median_seconds = quantile(times, 0.5);
      count.seconds_95 = quantile(times, 0.95);
      count.longest_seconds = quantile(times, 1);
      all.push_back(count);
    }
  return all;
}

}  // namespace rollres
