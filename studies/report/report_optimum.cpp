#include <algorithm>
#include <cmath>

#include "studies/optimise/design_choices.hpp"
#include "studies/optimise/optimise_report.hpp"
#include "studies/report/html.hpp"
#include "studies/report/report_sections.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

using html::TableRow;

std::string with_unit(const DesignProblem& problem, const Formula& formula, double value) {
  return readable(value, problem.unit(formula));
}

/// "layer thickness = 1.63 mm, static shear modulus = 8 MPa"
std::string design_in_words(const DesignProblem& problem, const Design& design) {
  std::string text = chosen_in_words(problem);
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    const Quantity& quantity = problem.variables[i].quantity;
    text += (text.empty() ? "" : ", ") + in_words(quantity.key) + " = " +
            readable(quantity, design.point[i], problem.unit(quantity));
  }
  return text;
}

std::string goal_in_words(const DesignProblem& problem) { return formula_in_words(problem.goal.formula.text()); }

std::string elasticity(const OptimiseReport& search, std::size_t variable) {
  if (!search.optimum) return "";
  const double value = search.optimum->goal.of[variable];
  return std::isfinite(value) ? short_number(value, 3) + " %" : "";
}

std::string design_table(const StoredOptimum& found) {
  const DesignProblem& problem = found.problem;
  const Design& best = *found.best;
  std::vector<TableRow> rows;
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    const Variable& variable = problem.variables[i];
    const std::string_view unit = problem.unit(variable.quantity);
    const auto shown = [&](double value) { return readable(variable.quantity, value, unit); };
    std::vector<std::string> cells{in_words(variable.quantity.key), shown(best.point[i]),
                                   shown(variable.lowest) + " to " + shown(variable.highest)};
    if (found.search) cells.push_back(elasticity(*found.search, i));
    rows.push_back({cells});
  }
  std::vector<html::TableColumn> columns{{"variable"}, {"value", true}, {"allowed"}};
  if (found.search) columns.push_back({"1 % more of it changes the goal by", true});
  std::string section = html::table(columns, rows);
  rows.clear();
  for (std::size_t j = 0; j < best.constraints.size(); ++j) {
    const ConstraintSides& sides = best.constraints[j];
    std::vector<std::string> cells{formula_in_words(constraint_name(problem, j)),
                                   with_unit(problem, limited(problem, j), sides.left),
                                   with_unit(problem, limited(problem, j), sides.right)};
    if (found.search && found.search->optimum) {
      const ConstraintState& state = found.search->optimum->constraints[j];
      cells.push_back(state.active ? "reached" : percent(state.slack, 3) + " left");
      cells.push_back(state.active && std::isfinite(state.multiplier) ? short_number(state.multiplier, 3) + " %" : "");
    }
    rows.push_back({cells});
  }
  columns = {{"constraint"}, {"value", true}, {"limit", true}};
  if (found.search && found.search->optimum)
    columns.insert(columns.end(), {{"room"}, {"1 % more room is worth", true}});
  return section + (rows.empty() ? "" : html::table(columns, rows));
}

/// A text of the file as it stands, anything else as JSON.
std::string written(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// What the file asks for: the goal, the formulas that it uses, and the scenes of the duty cycle with their weights.
std::string task_tables(const ReportSource& source) {
  const Json file = parse_object(source.definition_text, source.file() + ": " + source.study.name);
  std::vector<TableRow> formulas, scenes;
  for (const char* const key : {"minimise", "maximise"})
    if (file.contains(key)) formulas.push_back({{key, written(file.at(key))}});
  if (file.contains("compute") && file.at("compute").is_array())
    for (const Json& one : file.at("compute"))
      if (one.is_object())
        for (const auto& [name, formula] : one.items()) formulas.push_back({{in_words(name), written(formula)}});
  if (file.contains("scenes") && file.at("scenes").is_array())
    for (const Json& scene : file.at("scenes")) {
      std::string inputs;
      if (scene.contains("set"))
        for (const auto& [key, value] : scene.at("set").items())
          inputs += (inputs.empty() ? "" : ", ") + in_words(key) + " = " + written(value);
      scenes.push_back({{inputs, scene.contains("weight") ? written(scene.at("weight")) : "1"}});
    }
  std::string section = formulas.empty() ? "" : html::table({{"asked for"}, {"formula"}}, formulas);
  if (!scenes.empty()) section += html::table({{"scene of the duty cycle"}, {"weight", true}}, scenes);
  return section;
}

/// An axis for a variable, and what its values are divided by.
std::pair<ChartAxis, double> variable_axis(const DesignProblem& problem, std::size_t place) {
  const Variable& variable = problem.variables[place];
  const auto& unit = problem.unit(variable.quantity);
  const bool logarithmic = variable.scaling == Scaling::logarithmic;
  const ScaledUnit scaled = logarithmic ? scaled_unit_logarithmic(unit, variable.lowest, variable.highest)
                                        : scaled_unit(unit, variable.highest);
  return {{.name = in_words(variable.quantity.key),
           .symbol = std::string(symbol_beside_name(variable.quantity)),
           .unit = typeset_unit(scaled.name),
           .logarithmic = logarithmic,
           .margin = 0.03},
          scaled.factor};
}

/// All designs over the first two variables: those that keep the constraints, those that do not, the way of the search
/// from one best design to the next, and the last of them.
std::optional<ChartRequest> design_chart(const ReportSource& source, const StoredOptimum& found) {
  const DesignProblem& problem = found.problem;
  if (problem.variables.size() < 2) return std::nullopt;
  const auto [x, x_factor] = variable_axis(problem, 0);
  const auto [y, y_factor] = variable_axis(problem, 1);
  ChartRequest request{.title = title_of_study(source.definition, source.study.name),
                       .subtitle = "designs looked at",
                       .x = x,
                       .y = y,
                       .curves = {{"meets the constraints", {}},
                                  {"breaks a constraint", {}},
                                  {"in the order of the search", {}},
                                  {"best", {}}},
                       .mark_peaks = false};
  const auto place = [&](const Design& design) {
    return ChartPoint{design.point[0] / x_factor, design.point[1] / y_factor};
  };
  for (const Design& design : found.designs) request.curves[design.feasible() ? 0 : 1].points.push_back(place(design));
  if (found.search)
    for (const Design& design : found.search->designs) request.curves[2].points.push_back(place(design));
  if (found.best) request.curves[3].points.push_back(place(*found.best));
  for (const std::size_t points : {0, 1, 3}) request.curves[points].line = false;
  request.curves[2].marks = false;
  std::erase_if(request.curves, [](const ChartCurve& curve) { return curve.points.empty(); });
  return request;
}

/// The values that a problem takes from the lists of the file: "filled rubber, 20 mm".
std::string choice_in_words(const DesignProblem& problem) {
  return joined(problem.chosen, ", ", [&](const ChosenValue& chosen) { return problem.in_words(chosen); });
}

/// The best design of each choice, in the order of the file.
std::string choices_table(const StoredOptimum& found) {
  if (found.choices.size() < 2) return {};
  std::vector<TableRow> rows;
  for (std::size_t choice = 0; choice < found.choices.size(); ++choice) {
    const DesignProblem& problem = found.choices[choice];
    const Design* best = nullptr;
    int answered = 0;
    for (std::size_t i = 0; i < found.designs.size(); ++i) {
      const Design& design = found.designs[i];
      if (found.choice_of[i] != choice) continue;
      ++answered;
      if (design.feasible() && (!best || problem.goal.better(design.value, best->value))) best = &design;
    }
    std::vector<std::string> cells;
    for (const ChosenValue& chosen : problem.chosen) cells.push_back(problem.in_words(chosen));
    cells.push_back(best ? with_unit(problem, problem.goal.formula, best->value) : "none within the constraints");
    for (std::size_t i = 0; i < problem.variables.size(); ++i) {
      const Quantity& quantity = problem.variables[i].quantity;
      cells.push_back(best ? readable(quantity, best->point[i], problem.unit(quantity)) : "");
    }
    cells.push_back(std::to_string(answered));
    rows.push_back({cells});
  }
  std::vector<html::TableColumn> columns;
  for (const ChosenValue& chosen : found.problem.chosen) columns.push_back({in_words(chosen.key)});
  columns.push_back({"best " + goal_in_words(found.problem), true});
  for (const Variable& variable : found.problem.variables) columns.push_back({in_words(variable.quantity.key), true});
  columns.push_back({"designs", true});
  return html::table(columns, rows);
}

/// The goal of the designs that meet the constraints over one variable, of each choice.
ChartRequest goal_chart(const ReportSource& source, const StoredOptimum& found, std::size_t variable) {
  const auto [x, x_factor] = variable_axis(found.problem, variable);
  double size = 0;
  for (const Design& design : found.designs)
    if (design.feasible()) size = std::max(size, std::abs(design.value));
  const auto [y, y_factor] = formula_axis(found.problem, found.problem.goal.formula, size);
  ChartRequest request{.title = title_of_study(source.definition, source.study.name),
                       .subtitle = "designs that meet the constraints",
                       .x = x,
                       .y = y,
                       .curves = {},
                       .lines = false,
                       .mark_peaks = false};
  for (const DesignProblem& choice : found.choices) request.curves.push_back({choice_in_words(choice), {}});
  for (std::size_t i = 0; i < found.designs.size(); ++i)
    if (const Design& design = found.designs[i]; design.feasible())
      request.curves[found.choice_of[i]].points.push_back({design.point[variable] / x_factor, design.value / y_factor});
  std::erase_if(request.curves, [](const ChartCurve& curve) { return curve.points.empty(); });
  return request;
}

}  // namespace

std::vector<std::string> optimum_sentences(const StoredOptimum& found) {
  const DesignProblem& problem = found.problem;
  const std::string extreme = problem.goal.maximise ? "greatest " : "least ", goal = goal_in_words(problem);
  const auto feasible = count_if(found.designs, [](const Design& design) { return design.feasible(); });
  const std::string counted = std::to_string(found.designs.size()) + " designs have an answer, " +
                              std::to_string(feasible) + " of them meet " +
                              (problem.constraints.size() == 1 ? "the constraint." : "the constraints.");
  if (!found.best) return {"No design that was looked at meets the constraints.", counted};
  const bool constrained = !found.best->constraints.empty();
  std::vector<std::string> sentences{"The " + extreme + goal + (constrained ? " within the constraints" : "") + " is " +
                                     with_unit(problem, problem.goal.formula, found.best->value) + ", with " +
                                     design_in_words(problem, *found.best) + "."};
  if (found.search) sentences.push_back(limits_in_words(problem, *found.search));
  sentences.push_back(counted);
  return sentences;
}

PictureSection optimum_section(const ReportSource& source, const StoredOptimum& found) {
  std::string section = html::heading("Best design");
  if (!found.best) return {section + html::paragraph("No design meets the constraints."), 0};
  section += design_table(found) + choices_table(found) + task_tables(source);
  if (!found.search)
    section += html::paragraph("What the constraints cost: rollres optimise tells it, with the file at the end.");
  std::vector<std::pair<std::string, ChartRequest>> charts;
  if (auto designs = design_chart(source, found)) charts.emplace_back("The designs that were looked at", *designs);
  constexpr std::size_t most_charts = 6, most_choices = 12;
  if (!found.problem.pareto && found.choices.size() <= most_choices)
    for (std::size_t i = 0; i < std::min(found.problem.variables.size(), most_charts); ++i)
      charts.emplace_back("What the designs cost against " + in_words(found.problem.variables[i].quantity.key),
                          goal_chart(source, found, i));
  if (found.search && found.search->designs.size() > 1) {
    charts.emplace_back("The best design seen so far, in the course of the search",
                        course_chart(found.problem, *found.search));
    charts.back().second.title = title_of_study(source.definition, source.study.name);
  }
  const PictureSection pictures = chart_pictures(charts);
  return {section + pictures.html, pictures.pictures};
}

}  // namespace rollres
