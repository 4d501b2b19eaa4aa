#include "studies/study/study_definition.hpp"

#include <stdexcept>

#include "studies/scene_io/scene_inputs.hpp"
#include "studies/study/study_outputs.hpp"
#include "studies/study/study_variants.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

std::string text_under(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

const Json& under(const Json& object, const char* key) {
  static const Json nothing;
  const auto found = object.find(key);
  return found == object.end() ? nothing : *found;
}

StudyChart chart_in(const Json& object) {
  return {text_under(object, "name"), text_under(object, "x"), text_under(object, "y"), text_under(object, "family"),
          text_under(object, "map")};
}

void add_axis(StudyDefinition& definition, const std::string& key, const Json& axis) {
  if (axis.is_object() && (text_under(axis, "spacing") == "logarithmic" || text_under(axis, "scale") == "logarithmic"))
    definition.logarithmic.insert(held_key(key));
}

/// Axes of an object whose values vary together.
std::set<std::string> add_group(StudyDefinition& definition, const Json& inputs) {
  std::set<std::string> group;
  if (!inputs.is_object()) return group;
  for (const auto& [key, axis] : inputs.items()) {
    add_axis(definition, key, axis);
    group.insert(held_key(key));
  }
  definition.together.push_back(group);
  return group;
}

/// The goal under minimise or maximise, if it is understood.
void add_goal(StudyDefinition& definition, const std::string& name, const Json& object) {
  for (const char* const key : {"minimise", "maximise"}) {
    const Json& goal = under(object, key);
    const std::string text = goal.is_object() ? text_under(goal, "formula") : text_under(object, key);
    if (text.empty()) continue;
    const std::string complete = with_definitions(text, definition.formulas);
    try {
      Formula(complete, FormulaNames::inputs_and_outputs);
      definition.goals.emplace_back(name, complete);
    } catch (const std::invalid_argument&) {  // of another version
    }
  }
}

}  // namespace

bool StudyDefinition::are_together(const std::string& one, const std::string& other) const {
  return any_of(together, [&](const auto& group) { return group.contains(one) && group.contains(other); });
}

std::vector<std::string> StudyDefinition::chart_names() const {
  std::vector<std::string> names;
  for (const StudyChart& chart : charts)
    names.push_back(chart.name.empty() ? std::to_string(names.size() + 1) : chart.name);
  return names;
}

const StudyChart& StudyDefinition::chart(const std::string& name, const std::string& place) const {
  const std::vector<std::string> names = chart_names();
  for (std::size_t i = 0; i < charts.size(); ++i)
    if (name.empty() || name == names[i] || name == std::to_string(i + 1)) return charts[i];
  throw std::invalid_argument(place + ": chart = " + name + ": must be one of " + joined(names));
}

std::vector<std::string> charted_numbers(const StudyDefinition& definition, const std::vector<std::string>& axes) {
  std::vector<std::string> names;
  const auto holds = [](const auto& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  for (const StudyChart& chart : definition.charts)
    for (const std::string& name : {chart.y, chart.map, chart.x}) {
      const bool formula = std::any_of(definition.formulas.begin(), definition.formulas.end(),
                                       [&](const auto& one) { return one.first == name; });
      if ((formula || holds(output_keys(), name)) && !holds(axes, name) && !holds(names, name)) names.push_back(name);
    }
  return names;
}

std::string title_of_study(const StudyDefinition& definition, const std::string& name) {
  constexpr std::size_t most_letters = 96;
  std::string title = definition.comment.empty() ? name : definition.comment;
  for (const char* const clause_end : {". ", ": ", "; ", ", "})
    if (const std::size_t end = title.find(clause_end); width(title) > most_letters && end != std::string::npos)
      title.resize(end);
  return title;
}

StudyDefinition definition_in(const std::string& text, const std::string& place) {
  StudyDefinition definition{.comment = {},
                             .charts = {},
                             .compute = {},
                             .formulas = {},
                             .goals = {},
                             .logarithmic = {},
                             .together = {},
                             .sampled = {}};
  const Json study = text.empty() ? Json::object() : parse_object(text, place);
  definition.comment = text_under(study, "comment");
  if (const Json& chart = under(study, "chart"); chart.is_object()) definition.charts = {chart_in(chart)};
  for (const Json& chart : under(study, "charts"))
    if (chart.is_object()) definition.charts.push_back(chart_in(chart));
  if (definition.charts.empty()) definition.charts.emplace_back();
  ComputeWish wish = accepted_compute_wish(study);
  definition.compute = std::move(wish.columns);
  definition.formulas = std::move(wish.formulas);
  if (const Json& axes = under(study, "axes"); axes.is_object())
    for (const auto& [key, axis] : axes.items()) {
      if (is_of_variants(key)) continue;
      add_axis(definition, key, axis);
      if (axis.is_object()) add_group(definition, under(axis, "zip"));
    }
  if (const Json& sample = under(study, "sample"); sample.is_object())
    definition.sampled = add_group(definition, under(sample, "ranges"));
  if (const Json& uncertain = under(study, "uncertain"); uncertain.is_object()) {
    for (const auto& [key, distribution] : uncertain.items())
      if (find_input(key) && distribution.is_object()) definition.uncertain.insert(held_key(key));
    definition.together.push_back(definition.uncertain);
  }
  if (const Json& variables = under(study, "variables"); variables.is_object())  // of an optimisation
    definition.sampled = add_group(definition, variables);
  if (study.contains("variables")) add_goal(definition, "goal", study);
  if (const Json& pareto = under(study, "pareto"); pareto.is_object()) add_goal(definition, "second_goal", pareto);
  return definition;
}

}  // namespace rollres
