#include "studies/optimise/design_file.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/model/scene_rules.hpp"
#include "core/scene/scene_input.hpp"
#include "db/rows/schema.hpp"
#include "studies/optimise/design_keys.hpp"
#include "studies/optimise/design_search.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/scene_overrides.hpp"
#include "studies/scene_io/usual_names.hpp"
#include "studies/study/study_outputs.hpp"
#include "studies/study/study_scene.hpp"
#include "studies/study/study_variants.hpp"
#include "studies/study/uncertain_inputs.hpp"
#include "studies/text/file_kind.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// An object under a key, or nullptr.
const Json* object_at(const Json& object, const std::string& key, const std::string& place) {
  const auto found = object.find(key);
  if (found == object.end()) return nullptr;
  if (!found->is_object()) refuse(place, key, *found, "must be an object { ... }");
  return &*found;
}

/// A variable as it was given.
struct GivenVariable {
  SceneEntry start;    ///< its value is null where the file has none
  InputChoice choice;  ///< with both bounds and the scale
};

/// @param scene  the entries of the scene, for units and starts
GivenVariable given_variable(const std::string& key, const Json& object, const std::vector<SceneEntry>& scene,
                             const std::string& variables_place) {
  const std::string place = variables_place + ": " + key;
  if (!find_input(key)) refuse(variables_place, key, object, unknown_input(keys_like(key), key));
  if (!object.is_object()) refuse(variables_place, key, object, "must be an object with from and to");
  refuse_unknown_keys(object, variable_keys, place);
  const InputKind& kind = *find_input(key);
  if (!kind.real()) refuse(variables_place, key, object, "must be an input that is a real number");

  const std::string held = held_key(key);
  const Body body = body_of(scene);
  const auto number = [&](const std::string& name) {
    const Json& given = needed(object, name, place, "a variable has from and to");
    const double value = std::get<double>(input_value({key, given, place + ": " + name}, body));
    if (!std::isfinite(value)) refuse(place, name, given, "must be finite");
    return value;
  };
  const double from = number("from"), to = number("to");
  if (!(from < to)) refuse(place, "to", object["to"], "must be larger than \"from\"");
  const bool logarithmic =
      object.contains("scale") ? name_or_first(object, "scale", spacing_names, place) == "logarithmic" : from > 0;
  if (logarithmic && from <= 0) refuse(place, "from", object["from"], "scale logarithmic: must be > 0");

  double start = logarithmic ? std::sqrt(from) * std::sqrt(to) : from + 0.5 * (to - from);
  if (object.contains("start")) {
    start = number("start");
    if (start < from || start > to) refuse(place, "start", object["start"], "must be between \"from\" and \"to\"");
  } else {
    if (const Json* const given = value_given(scene, held))
      if (const double own = std::get<double>(input_value({held, *given, place}, body)); own >= from && own <= to)
        start = own;
  }
  return {{held, written_input(find_input(held)->quantity, start), place}, {held, from, to, logarithmic}};
}

/// One value of a variable that is a list.
struct Alternative {
  std::vector<SceneEntry> entries;  ///< of a variant several
  std::string name = {};            ///< of a variant
};

/// What may be chosen, key by key.
struct Choices {
  std::vector<GivenVariant> variants;
  std::vector<std::pair<std::string, std::vector<Alternative>>> lists = {};
};

std::vector<Alternative> alternatives_of(const std::string& key, const Json& list, const std::string& place) {
  if (!find_input(key)) refuse(place, key, list, unknown_input(keys_like(key), key));
  if (find_input(key)->list) refuse(place, key, list, "a list cannot be chosen by itself; give each list in a variant");
  if (key == "indenter") refuse(place, key, list, "must be the same in all designs");
  if (list.empty()) refuse(place, key, list, "must be a list of values, or an object with from and to");
  std::vector<Alternative> all;
  for (const Json& value : list) {
    const SceneEntry held = held_entry({key, value, place});
    for (const Alternative& other : all)
      if (other.entries.front().value == held.value) refuse(place, key, value, "value given twice");
    all.push_back({{held}});
  }
  return all;
}

Choices choices_in(const Json& variables, const std::filesystem::path& path, const std::string& place) {
  Choices choices{given_variants(variables, path.parent_path(), place)};
  std::vector<Alternative> named;
  for (const GivenVariant& variant : choices.variants) {
    for (const SceneEntry& entry : variant.entries)
      if (entry.key == "indenter") refuse(entry.place, entry.key, entry.value, "must be the same in all designs");
    named.push_back({variant.entries, variant.name});
  }
  if (!named.empty()) choices.lists.emplace_back(variant_key, std::move(named));
  double count = static_cast<double>(std::max<std::size_t>(choices.variants.size(), 1));
  for (const auto& [key, value] : variables.items()) {
    if (is_of_variants(key)) continue;
    refuse_given_twice(choices.variants, key, "is a variable too");
    if (!value.is_array()) continue;
    choices.lists.emplace_back(held_key(key), alternatives_of(key, value, place));
    count *= static_cast<double>(value.size());
  }
  constexpr double most_choices = 1000;
  if (count > most_choices)
    throw std::invalid_argument(place + ": more than " + shortest(most_choices) + " combinations of choices");
  return choices;
}

void refuse_set_variables(const std::vector<SceneEntry>& set, const Json& variables, const Choices& choices) {
  for (const SceneEntry& entry : set) {
    for (const auto& [key, value] : variables.items())
      if (held_key(key) == entry.key) refuse(entry.place, entry.key, entry.value, "is a variable too");
    refuse_given_twice(choices.variants, entry.key, "is in \"set\" too");
  }
}

/// The inputs of one scene of a duty cycle.
std::vector<SceneEntry> duty_entries(const Json& duty, const Json& variables, const Choices& choices,
                                     const std::string& place) {
  const std::vector<SceneEntry> set = set_entries(duty, place);
  refuse_set_variables(set, variables, choices);
  for (const SceneEntry& entry : set)
    if (entry.key == "indenter") refuse(entry.place, entry.key, entry.value, "must be the same in all scenes");
  return set;
}

std::vector<DutyScene> duty_scenes(const Json& file, const std::vector<SceneEntry>& base,
                                   const std::vector<GivenVariable>& variables, const Choices& choices,
                                   const std::string& place) {
  std::vector<SceneEntry> starts;
  for (const GivenVariable& variable : variables) starts.push_back(variable.start);
  if (!file.contains("scenes")) return {{scene_from(overridden(base, starts), place), 1}};
  const Json& list = file["scenes"];
  if (!list.is_array() || list.empty()) refuse(place, "scenes", list, "must be a list of objects with set and weight");
  std::vector<DutyScene> scenes;
  for (const Json& item : list) {
    const std::string item_place = place + ": scenes: scene " + std::to_string(scenes.size() + 1);
    if (!item.is_object()) refuse(place, "scenes", item, "must be a list of objects with set and weight");
    refuse_unknown_keys(item, duty_keys, item_place);
    DutyScene duty;
    duty.weight = positive_or(item, "weight", duty.weight, item_place);
    const auto own = overridden(base, duty_entries(item, file["variables"], choices, item_place));
    duty.scene = scene_from(overridden(own, starts), item_place);
    scenes.push_back(std::move(duty));
  }
  return scenes;
}

/// What goals and constraints of one file share.
struct GoalContext {
  const FormulaDefinitions& formulas;
  Body body;
  OverScenes over;  ///< of a goal that does not say so itself
  bool uncertain;   ///< inputs scatter
};

/// How a goal or a constraint is given: a text, or an object with the text under a key.
struct GivenText {
  std::string text;
  Json options = Json::object();
  std::string place;
};

GivenText given_text(const Json& value, const std::string& outer, const char* name, const char* key,
                     std::span<const FileKey> known, const std::string& rule) {
  if (value.is_string() && !value.get<std::string>().empty())
    return {.text = value.get<std::string>(), .place = outer + ": " + name};
  if (!value.is_object()) refuse(outer, name, value, rule);
  const std::string place = outer + ": " + name;
  refuse_unknown_keys(value, known, place);
  return {needed_text(value, key, place, rule), value, place};
}

std::optional<ScatterMeasure> scatter_of(const GivenText& given, bool uncertain) {
  if (!given.options.contains("scatter")) return std::nullopt;
  const std::string text = needed_text(given.options, "scatter", given.place, "must be a text such as \"P90\"");
  if (!uncertain) refuse(given.place, "scatter", text, "needs \"uncertain\": no input scatters");
  return refusing_at(given.place + ": scatter", [&] { return ScatterMeasure(text); });
}

/// What "minimise" or "maximise" says.
Goal goal_of(const Json& object, const GoalContext& context, const std::string& place) {
  const bool least = object.contains("minimise"), greatest = object.contains("maximise");
  if (least == greatest)
    throw std::invalid_argument(place + ": minimise: there must be a formula under minimise or maximise, and not both");
  const std::string key = least ? "minimise" : "maximise";
  const GivenText given = given_text(object[key], place, key.c_str(), "formula", goal_keys,
                                     "must be a formula of inputs and outputs, or an object with formula");
  Goal goal = refusing_at(given.place, [&] {
    const Formula formula(given.text, FormulaNames::inputs_and_outputs, context.formulas);
    refuse_different_units(formula, context.body);
    return Goal{formula, greatest, context.over};
  });
  if (given.options.contains("over")) goal.over = choice_or_first<OverScenes>(given.options, "over", given.place);
  if (const auto scatter = scatter_of(given, context.uncertain)) goal.scatter = *scatter;
  return goal;
}

/// One condition. A number of scenes or points is one of its left side.
DesignConstraint constraint_of(const Json& item, std::size_t number, Body body, const GoalContext& context,
                               const std::string& place) {
  const std::string name = "constraint " + std::to_string(number);
  const GivenText given =
      given_text(item, place, name.c_str(), "condition", constraint_keys,
                 "must be a list of conditions of inputs and outputs, or of objects with condition");
  DesignConstraint constraint = refusing_at(given.place, [&] {
    return DesignConstraint(given.text, FormulaNames::inputs_and_outputs, body, context.formulas);
  });
  if (given.options.contains("over")) constraint.over = choice_or_first<OverScenes>(given.options, "over", given.place);
  const auto scatter = scatter_of(given, context.uncertain);
  if (context.uncertain && !scatter)
    refuse(given.place, "condition", given.text,
           "what of the scatter must hold it? Write {\"condition\": ..., \"scatter\": \"P95\"}, or \"mean\", "
           "\"mean + 2 sd\"");
  if (scatter) constraint.scatter = *scatter;
  if ((constraint.over || scatter) && !constraint.right().keys().empty())
    refuse(given.place, "condition", given.text, "its right side must be a number: divide by what stands there");
  return constraint;
}

std::vector<DesignConstraint> constraints_of(const Json& file, Body body, const GoalContext& context,
                                             const std::string& place) {
  std::vector<DesignConstraint> conditions;
  const auto found = file.find("constraints");
  if (found == file.end()) return conditions;
  if (!found->is_array()) refuse(place, "constraints", *found, "must be a list of conditions of inputs and outputs");
  for (const Json& item : *found)
    conditions.push_back(constraint_of(item, conditions.size() + 1, body, context, place));
  return conditions;
}

DesignStop stop_of(const Json& file, const std::string& place) {
  DesignStop stop;
  const Json* const object = object_at(file, "stop", place);
  if (!object) return stop;
  const std::string own = place + ": stop";
  refuse_unknown_keys(*object, stop_keys, own);
  stop.evaluations = whole_number_or(*object, "evaluations", stop.evaluations, 1, most_points, own);
  if (const auto found = object->find("tolerance"); found != object->end()) {
    if (!found->is_number() || !(*found >= 1e-8 && *found <= 0.1))
      refuse(own, "tolerance", *found, "must be a number from 1e-8 to 0.1");
    stop.tolerance = found->get<double>();
  }
  return stop;
}

std::optional<ParetoWish> pareto_of(const Json& file, const GoalContext& context, const std::string& place) {
  const Json* const object = object_at(file, "pareto", place);
  if (!object) return std::nullopt;
  const std::string own = place + ": pareto";
  refuse_unknown_keys(*object, pareto_keys, own);
  return ParetoWish{
      goal_of(*object, context, own),
      whole_number(needed(*object, "points", own, "how many designs on the front"), "points", 2, most_points, own)};
}

/// Shares are of values > 0, and what scatters by them stays in its range at both bounds of a variable.
void refuse_no_scatter(const DesignProblem& problem, const Json& given, const std::string& place) {
  for (const UncertainInput& input : problem.uncertain.inputs) {
    if (!input.relative) continue;
    std::vector<double> values;
    for (const DutyScene& duty : problem.scenes) values.push_back(real_input(duty.scene, input.key));
    for (const Variable& variable : problem.variables)
      if (variable.quantity.key == input.key) values.insert(values.end(), {variable.lowest, variable.highest});
    const Range& range = find_input(input.key)->quantity.range;
    for (const double value : values) {
      const std::string at = "at " + short_number(value) + ": ";
      if (!(value > 0) || !std::isfinite(value))
        refuse(place, input.key, given[input.key], at + "what scatters by shares must be > 0 and finite");
      if (!input.truncated && weight_outside(times(input.distribution, value), range) > negligible_weight)
        refuse(place, input.key, given[input.key],
               at + "has weight outside its range (" + range.rule() + "): \"truncated\": true cuts it off there");
    }
  }
}

/// What scatters, at fewer points than a study has: each design asks for all of them.
void read_uncertain(DesignProblem& problem, const Json& file, const std::vector<SceneEntry>& scene,
                    const std::vector<GivenVariable>& variables, const Choices& choices, const std::string& place) {
  std::vector<std::string> keys;
  for (const GivenVariable& variable : variables) keys.push_back(variable.choice.key);
  for (const auto& [key, alternatives] : choices.lists) keys.push_back(key);
  problem.uncertain = uncertain_inputs(file, scene, place, {.points = 64, .scramblings = 1}, keys);
  if (!problem.uncertain.any()) return;
  if (!problem.uncertain.probabilities.empty())
    refuse(place + ": uncertain", "probability", file["uncertain"]["probability"],
           "is for rollres scatter; in an optimisation a constraint with \"scatter\": \"P95\" keeps it below 5 %");
  refuse_no_scatter(problem, file["uncertain"], place + ": uncertain");
  problem.uncertain_points = uncertain_points(problem.uncertain);
}

/// The problem with what is chosen. @param base  entries of the scene with these choices
DesignProblem problem_in(const Json& file, const std::vector<SceneEntry>& base, const Choices& choices,
                         const std::string& place) {
  const std::string variables_place = place + ": variables";
  std::vector<GivenVariable> variables;
  for (const auto& [key, value] : file["variables"].items())
    if (!value.is_array() && !is_of_variants(key)) {
      GivenVariable variable = given_variable(key, value, base, variables_place);
      for (const GivenVariable& other : variables)
        if (other.start.key == variable.start.key)
          throw std::invalid_argument(variables_place + ": " + variable.start.key + ": is a variable already");
      variables.push_back(std::move(variable));
    }

  const Body body = body_of(base);
  const FormulaDefinitions formulas = compute_wish(file, {&body, 1}, place).formulas;
  const GoalContext context{formulas, body, choice_or_first<OverScenes>(file, "over_scenes", place),
                            file.contains("uncertain")};
  DesignProblem problem{.name = needed_text(file, "study", place, "must be the name of the study"),
                        .scenes = duty_scenes(file, base, variables, choices, place),
                        .variables = {},
                        .start = {},
                        .goal = goal_of(file, context, place)};
  std::vector<InputChoice> inputs;
  for (const GivenVariable& variable : variables) inputs.push_back(variable.choice);
  refusing_at(variables_place, [&] {
    for (const DutyScene& duty : problem.scenes) problem.variables = variables_of(duty.scene, inputs);
  });
  problem.start = base_point({problem.scenes.front().scene, problem.variables, {}, {}});
  problem.constraints = constraints_of(file, body, context, place);
  read_uncertain(problem, file, base, variables, choices, place);
  if (file.contains("algorithm")) problem.algorithm = choice_or_first<Algorithm>(file, "algorithm", place);
  problem.global = is_true(file, "global", place);
  if (problem.algorithm && problem.variables.size() < traits(*problem.algorithm).fewest_variables)
    refuse(place, "algorithm", file["algorithm"], "needs at least two variables");
  problem.stop = stop_of(file, place);
  problem.pareto = pareto_of(file, context, place);
  // A goal that no answer has would be missed at every point.
  for (const DutyScene& duty : problem.scenes) {
    refusing_at(place, [&] { refuse_absent(problem.goal.formula, duty.scene); });
    if (problem.pareto)
      refusing_at(place + ": pareto", [&] { refuse_absent(problem.pareto->goal.formula, duty.scene); });
    for (std::size_t i = 0; i < problem.constraints.size(); ++i)
      for (const Formula& side : {problem.constraints[i].left(), problem.constraints[i].right()})
        refusing_at(place + ": constraint " + std::to_string(i + 1), [&] { refuse_absent(side, duty.scene); });
  }
  return problem;
}

/// The problems of all combinations, the last list varying fastest.
std::vector<DesignProblem> problems_in(Json file, const std::filesystem::path& path) {
  const std::string place = path.string();
  require_kind(FileKind::design, file, place);
  resolve_fit(file, path, place);
  if (const auto axes = file.find("axes"); axes != file.end())
    refuse(place, "axes", *axes, "a study has axes; a design has variables in their place, and finds their values");
  refuse_unknown_keys(file, design_keys, place);
  refuse_ignored_other_than_texts(file, place);
  const std::string rule = "must be an object with at least one input";
  const Json& given = needed(file, "variables", place, rule);
  if (!given.is_object() || given.empty()) refuse(place, "variables", given, rule);
  const Choices choices = choices_in(given, path, place + ": variables");
  const std::vector<SceneEntry> set = set_entries(file, place);
  refuse_set_variables(set, given, choices);
  const std::vector<SceneEntry> base = overridden(scene_entries_of(file, path, place), set);

  std::size_t combinations = 1;
  for (const auto& [key, alternatives] : choices.lists) combinations *= alternatives.size();
  std::vector<DesignProblem> problems;
  for (std::size_t combination = 0; combination < combinations; ++combination) {
    std::vector<SceneEntry> entries = base;
    std::vector<ChosenValue> chosen;
    std::size_t of_each = combinations;
    for (const auto& [key, alternatives] : choices.lists) {
      of_each /= alternatives.size();
      const Alternative& one = alternatives[combination / of_each % alternatives.size()];
      entries = overridden(std::move(entries), one.entries);
      chosen.push_back(
          {key, key == variant_key ? InputValue(one.name) : input_value(one.entries.front(), body_of(base))});
    }
    problems.push_back(problem_in(file, entries, choices, place));
    problems.back().chosen = std::move(chosen);
  }
  return problems;
}

}  // namespace

std::vector<DesignProblem> read_design_problems(const std::filesystem::path& path) {
  return problems_in(read_object(path.string()), path);
}

DesignProblem read_design_problem(const std::filesystem::path& path) {
  std::vector<DesignProblem> problems = read_design_problems(path);
  for (const ChosenValue& chosen : problems.front().chosen)
    throw std::invalid_argument(path.string() + ": variables: " + chosen.key +
                                ": is chosen from a list, which has no range; give one of its values in set");
  return std::move(problems.front());
}

std::vector<DesignProblem> parse_design_problems(const std::string& text, const std::filesystem::path& path) {
  return problems_in(parse_object(text, path.string()), path);
}

}  // namespace rollres
