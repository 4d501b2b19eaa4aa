#include "studies/optimise/optimise_report.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "studies/run/progress.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/value_and_error.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

Cell rough(double value) { return std::isfinite(value) ? Cell(short_number(value, 3)) : Cell(); }

/// "0.71 +- 0.0021"
Cell with_error(double value, double error) {
  if (!std::isfinite(value)) return {};
  const ValueAndError shown = value_and_error(value, error, "");
  return shown.value + (std::isfinite(error) ? " +- " + shown.error : "");
}

std::string value_in_words(const DesignProblem& problem, const Variable& variable, double value) {
  return readable(variable.quantity, value, problem.unit(variable.quantity));
}

std::string value_in_words(const DesignProblem& problem, const Formula& formula, double value) {
  return readable(value, problem.unit(formula));
}

Json json_of(const DesignProblem& problem, const Design& design) {
  Json variables = Json::object();
  for (std::size_t i = 0; i < design.point.size(); ++i)
    variables[std::string(problem.variables[i].quantity.key)] = design.point[i];
  Json object = json_object("variables", variables, "value", design.value, "feasible", design.feasible(), "reason",
                            design.reason, "keys", design.keys, "warnings", design.warnings, "model_error",
                            design.model_error);
  if (problem.pareto) object["second"] = finite_or_null(design.second);
  return object;
}

Json json_of(const EvaluationCount& count) {
  return {{"all", count.all()}, {"solved", count.solved}, {"recalled", count.recalled}, {"failed", count.failed}};
}

Json elasticities_json(const DesignProblem& problem, const Elasticities& elasticities) {
  Json object = Json::object();
  for (std::size_t i = 0; i < elasticities.of.size(); ++i)
    object[std::string(problem.variables[i].quantity.key)] = {{"elasticity", finite_or_null(elasticities.of[i])},
                                                              {"error", finite_or_null(elasticities.errors[i])}};
  return object;
}

std::string goal_in_words(const DesignProblem& problem, const Goal& goal) {
  return (goal.maximise ? "maximise " : "minimise ") + goal.formula.text() + measure_in_words(problem, goal);
}

std::string searches_in_words(const OptimiseReport& report) {
  std::string text;
  for (const auto& [algorithm, end, evaluations] : report.searches) {
    text += (text.empty() ? "" : ", then ") + std::string(name_of(algorithm)) + " (" + std::to_string(evaluations);
    text += end == SearchEnd::limit ? ", its limit)" : ")";
  }
  return text;
}

Table variables_table(const DesignProblem& problem, const OptimiseReport& report) {
  Table table{{"variable", "value", "from", "to", "bound", "elasticity"}, {}};
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    const Variable& variable = problem.variables[i];
    const auto& optimum = report.optimum;
    const ActiveBound bound = optimum ? optimum->bounds[i] : ActiveBound::none;
    table.rows.push_back({std::string(variable.quantity.key), value_in_words(problem, variable, report.best->point[i]),
                          value_in_words(problem, variable, variable.lowest),
                          value_in_words(problem, variable, variable.highest),
                          bound == ActiveBound::none ? Cell() : Cell(std::string(name_of(bound))),
                          optimum ? with_error(optimum->goal.of[i], optimum->goal.errors[i]) : Cell()});
  }
  return table;
}

Table constraints_table(const DesignProblem& problem, const OptimiseReport& report) {
  Table table{{"constraint", "left", "right", "slack", "multiplier"}, {}};
  for (const Variable& variable : problem.variables) table.columns.emplace_back(variable.quantity.key);
  for (std::size_t j = 0; j < report.best->constraints.size(); ++j) {
    const ConstraintSides& sides = report.best->constraints[j];
    const Formula& left = limited(problem, j);
    std::vector<Cell> row{constraint_name(problem, j), value_in_words(problem, left, sides.left),
                          value_in_words(problem, left, sides.right)};
    if (report.optimum) {
      const ConstraintState& state = report.optimum->constraints[j];
      row.push_back(state.active ? Cell("active") : rough(state.slack));
      row.push_back(state.active ? rough(state.multiplier) : Cell());
      for (std::size_t i = 0; i < problem.variables.size(); ++i)
        row.push_back(with_error(state.elasticities.of[i], state.elasticities.errors[i]));
    }
    row.resize(table.columns.size());
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table front_table(std::span<const DesignProblem> problems, const ParetoReport& front) {
  const DesignProblem& problem = problems.front();
  Table table{{"front"}, {}};
  for (const ChosenValue& chosen : problem.chosen) table.columns.push_back(chosen.key);
  table.columns.push_back(problem.goal.formula.text());
  const auto shown_already = [&](std::string_view name) { return contains(table.columns, name); };
  const bool second = !shown_already(problem.pareto->goal.formula.text());
  if (second) table.columns.push_back(problem.pareto->goal.formula.text());
  std::vector<std::size_t> variables;  // that are no goals
  for (std::size_t i = 0; i < problem.variables.size(); ++i)
    if (const std::string_view key = problem.variables[i].quantity.key; !shown_already(key)) {
      table.columns.emplace_back(key);
      variables.push_back(i);
    }
  for (const char* const name : {"status", "dominated"}) table.columns.emplace_back(name);
  std::int64_t place = 0;
  for (const ParetoPoint& point : front.points) {
    std::vector<Cell> row{point.report.best && !point.dominated ? Cell(++place) : Cell()};
    for (const ChosenValue& chosen : problems[point.choice].chosen)
      row.emplace_back(problems[point.choice].in_words(chosen));
    if (const auto& best = point.report.best) {
      row.emplace_back(value_in_words(problem, problem.goal.formula, best->value));
      if (second) row.emplace_back(value_in_words(problem, problem.pareto->goal.formula, best->second));
      for (const std::size_t i : variables)
        row.emplace_back(value_in_words(problem, problem.variables[i], best->point[i]));
    }
    row.resize(table.columns.size() - 2);
    row.emplace_back(std::string(name_of(point.report.status)));
    row.emplace_back(point.dominated ? Cell("yes") : Cell());
    table.rows.push_back(std::move(row));
  }
  return table;
}

void print_nearest(const DesignProblem& problem, const Design& design, std::ostream& out) {
  out << "nearest to the constraints:";
  for (std::size_t i = 0; i < design.point.size(); ++i) {
    const Quantity& quantity = problem.variables[i].quantity;
    out << (i == 0 ? " " : ", ") << quantity.key << " = "
        << readable(quantity, design.point[i], quantity.unit_for(problem.body()));
  }
  out << '\n';
  for (std::size_t j = 0; j < design.constraints.size(); ++j)
    if (!design.constraints[j].holds)
      out << "broken: " << constraint_name(problem, j) << ": "
          << value_in_words(problem, limited(problem, j), design.constraints[j].left) << " against "
          << value_in_words(problem, limited(problem, j), design.constraints[j].right) << '\n';
}

}  // namespace

FormulaAxis formula_axis(const DesignProblem& problem, const Formula& formula, double size) {
  const ScaledUnit unit = scaled_unit(problem.unit(formula), size);
  return {{.name = formula_in_words(formula.text()), .unit = typeset_unit(unit.name)}, unit.factor};
}

std::string in_words(const EvaluationCount& count) {
  return std::to_string(count.all()) + " evaluations (" + std::to_string(count.solved) + " solved, " +
         std::to_string(count.recalled) + " recalled, " + std::to_string(count.failed) + " failed)";
}

std::string in_words(const DesignProblem& problem, const OptimiseProgress& progress) {
  std::string text =
      progress.all > 1 ? "choice " + std::to_string(progress.place) + " of " + std::to_string(progress.all) + ": " : "";
  const std::size_t done = progress.count.all();
  text += std::to_string(done) + " of at most " + std::to_string(std::max(done, progress.limit));
  if (progress.all == 1) text += " evaluations";
  if (progress.best) text += ", best " + value_in_words(problem, problem.goal.formula, *progress.best);
  if (progress.count.solved > 0 && progress.limit > done) {
    const auto left = static_cast<double>((progress.limit - done) * (progress.all - progress.place + 1) +
                                          done * (progress.all - progress.place));
    text += ", at most " + duration_in_words(left * progress.seconds / static_cast<double>(done)) + " left";
  }
  return text;
}

const Formula& limited(const DesignProblem& problem, std::size_t constraint) {
  const std::vector<ConstraintPlace> places = constraint_places(problem);
  return constraint < places.size() ? problem.constraints[places[constraint].constraint].left()
                                    : problem.bound->goal.formula;
}

std::string limits_in_words(const DesignProblem& problem, const OptimiseReport& report) {
  std::vector<std::string> limits;
  for (std::size_t j = 0; report.optimum && j < report.optimum->constraints.size(); ++j) {
    const ConstraintState& state = report.optimum->constraints[j];
    if (!state.active) continue;
    limits.push_back(formula_in_words(constraint_name(problem, j)));
    if (std::isfinite(state.multiplier) && state.multiplier > 0)
      limits.back() += ", where 1 % more room would " + std::string(problem.goal.maximise ? "raise" : "lower") +
                       " it by " + short_number(state.multiplier, 3) + " %";
  }
  for (std::size_t i = 0; report.optimum && i < report.optimum->bounds.size(); ++i)
    if (const ActiveBound bound = report.optimum->bounds[i]; bound != ActiveBound::none)
      limits.push_back("the " + std::string(name_of(bound)) + " " + in_words(problem.variables[i].quantity.key) +
                       " allowed");
  const std::string held = limits.empty() ? "" : "It is held back by " + joined(limits, ", and by ") + ". ";
  if (report.status == DesignStatus::optimum) return held + "To first order no design near it is better.";
  return held + "That it is the best near it is not confirmed" +
         (report.reason.empty() ? "." : ": " + report.reason + ".");
}

void print_text(const DesignProblem& problem, const OptimiseReport& report, std::ostream& out) {
  out << problem.name << ": " << name_of(report.status) << (report.reason.empty() ? "" : ": " + report.reason) << '\n';
  if (report.best) {
    const Body body = problem.body();
    out << goal_in_words(problem, problem.goal) << ": " << readable(report.value(), unit_of(problem.goal.formula, body))
        << '\n';
    for (const std::string& warning : report.best->warnings) out << "warning  " << warning << '\n';
    if (std::isfinite(report.best->model_error))
      out << "what is assumed changes R_r by about " << percent(report.best->model_error, 2) << '\n';
    out << '\n';
    write_aligned(out, variables_table(problem, report));
    out << '\n';
    if (!report.best->constraints.empty()) {
      write_aligned(out, constraints_table(problem, report));
      out << '\n';
    }
    if (report.status == DesignStatus::optimum) out << limits_in_words(problem, report) << "\n\n";
    if (!problem.uncertain.any())
      for (const std::string& key : report.best->keys) out << "evaluation " << key << '\n';
  } else if (report.nearest) {
    print_nearest(problem, *report.nearest, out);
  }
  if (!report.searches.empty()) out << "searched by " << searches_in_words(report) << '\n';
  out << in_words(report.count) << ", " << report.slope_evaluations << " of them for the slopes at the end\n";
}

void print_text(std::span<const DesignProblem> problems, const ParetoReport& front, std::ostream& out) {
  const DesignProblem& problem = problems.front();
  out << problem.name << ": " << goal_in_words(problem, problem.goal) << "; "
      << goal_in_words(problem, problem.pareto->goal) << "\n\n";
  write_aligned(out, front_table(problems, front));
  if (!front.conflict) out << "\nthe goals do not conflict: one design is the best for both\n";
  out << '\n' << in_words(front.count) << '\n';
  for (const ParetoPoint& point : front.points)
    if (!point.report.reason.empty() && point.report.status != DesignStatus::optimum)
      out << name_of(point.report.status) << ": " << point.report.reason << '\n';
}

Json json_of(const DesignProblem& problem, const OptimiseReport& report) {
  Json object =
      json_object("study", problem.name, "status", name_of(report.status), "reason", report.reason,
                  problem.goal.maximise ? "maximise" : "minimise", problem.goal.formula.text(), "over",
                  name_of(problem.goal.over), "value", report.value(), "unit", problem.unit(problem.goal.formula),
                  "best", report.best ? json_of(problem, *report.best) : Json(nullptr), "nearest",
                  report.nearest ? json_of(problem, *report.nearest) : Json(nullptr), "evaluations",
                  json_of(report.count), "slope_evaluations", report.slope_evaluations, "searches", Json::array(),
                  "variables", Json::array(), "constraints", Json::array());
  if (problem.uncertain.any()) {
    object["scatter"] = problem.goal.scatter.text();
    object["scatter_points"] = problem.scatter_points();
    object["uncertain"] = in_words(problem.uncertain, problem.body());
  }
  object["evaluations"]["limit"] = evaluation_limit(problem);
  for (const SearchReport& search : report.searches) {
    const char* const ends[] = {"tolerance", "limit", "failed"};
    object["searches"].push_back(json_object("algorithm", name_of(search.algorithm), "end",
                                             ends[static_cast<std::size_t>(search.end)], "evaluations",
                                             search.evaluations));
  }
  const auto& optimum = report.optimum;
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    const Variable& variable = problem.variables[i];
    object["variables"].push_back(
        {{"key", variable.quantity.key},
         {"unit", problem.unit(variable.quantity)},
         {"from", variable.lowest},
         {"to", variable.highest},
         {"scale", name_of(variable.scaling)},
         {"start", problem.start[i]},
         {"value", report.best ? Json(report.best->point[i]) : Json(nullptr)},
         {"bound", optimum ? Json(name_of(optimum->bounds[i])) : Json(nullptr)},
         {"elasticity", optimum ? finite_or_null(optimum->goal.of[i]) : Json(nullptr)},
         {"elasticity_error", optimum ? finite_or_null(optimum->goal.errors[i]) : Json(nullptr)}});
  }
  const std::optional<Design>& shown = report.best ? report.best : report.nearest;
  for (std::size_t j = 0; shown && j < shown->constraints.size(); ++j) {
    const ConstraintSides& sides = shown->constraints[j];
    Json constraint = json_object("constraint", constraint_name(problem, j), "left", sides.left, "right", sides.right,
                                  "holds", sides.holds);
    if (optimum) {
      const ConstraintState& state = optimum->constraints[j];
      constraint["slack"] = finite_or_null(state.slack);
      constraint["active"] = state.active;
      constraint["multiplier"] = finite_or_null(state.multiplier);
      constraint["elasticities"] = elasticities_json(problem, state.elasticities);
    }
    object["constraints"].push_back(std::move(constraint));
  }
  return object;
}

Json chosen_json(const DesignProblem& problem) {
  Json object = Json::object();
  for (const ChosenValue& chosen : problem.chosen)
    if (const auto* const name = std::get_if<std::string>(&chosen.value))
      object[chosen.key] = *name;
    else
      object[chosen.key] = std::get<double>(chosen.value);
  return object;
}

Json json_of(std::span<const DesignProblem> problems, const ParetoReport& front) {
  const DesignProblem& problem = problems.front();
  const auto goal_json = [](const Goal& goal) {
    return Json{{goal.maximise ? "maximise" : "minimise", goal.formula.text()}, {"over", name_of(goal.over)}};
  };
  Json object =
      json_object("study", problem.name, "goal", goal_json(problem.goal), "second", goal_json(problem.pareto->goal),
                  "conflict", front.conflict, "complete", front.complete(), "interrupted", front.interrupted,
                  "evaluations", json_of(front.count), "front", Json::array());
  for (const ParetoPoint& point : front.points) {
    object["front"].push_back(json_object("limit", point.limit, "status", name_of(point.report.status), "reason",
                                          point.report.reason, "dominated", point.dominated, "design",
                                          point.report.best ? json_of(problem, *point.report.best) : Json(nullptr)));
    if (!problem.chosen.empty()) object["front"].back()["chosen"] = chosen_json(problems[point.choice]);
  }
  return object;
}

ChartRequest course_chart(const DesignProblem& problem, const OptimiseReport& report) {
  const auto [axis, factor] = formula_axis(problem, problem.goal.formula, std::abs(report.value()));
  ChartRequest request{.title = problem.name,
                       .subtitle = "the best design seen so far",
                       .x = {.name = "designs with an answer"},
                       .y = axis,
                       .curves = {},
                       .mark_peaks = false};
  ChartCurve curve;
  std::optional<double> best;
  for (std::size_t i = 0; i < report.designs.size(); ++i) {
    const Design& design = report.designs[i];
    if (design.feasible() && (!best || problem.goal.better(design.value, *best))) best = design.value;
    if (best) curve.points.push_back({static_cast<double>(i + 1), *best / factor});
  }
  request.curves.push_back(std::move(curve));
  return request;
}

ChartRequest front_chart(std::span<const DesignProblem> problems, const ParetoReport& front) {
  const DesignProblem& problem = problems.front();
  double size = 0, second_size = 0;
  for (const ParetoPoint& point : front.points)
    if (point.report.best) {
      size = std::max(size, std::abs(point.report.best->value));
      second_size = std::max(second_size, std::abs(point.report.best->second));
    }
  const auto [x, x_factor] = formula_axis(problem, problem.pareto->goal.formula, second_size);
  const auto [y, y_factor] = formula_axis(problem, problem.goal.formula, size);
  ChartRequest request{
      .title = problem.name, .subtitle = "the designs of the front", .x = x, .y = y, .curves = {}, .mark_peaks = false};
  request.x.margin = 0.03;
  for (std::size_t choice = 0; choice < problems.size(); ++choice) {
    ChartCurve curve;
    if (!problem.chosen.empty())
      curve.label = joined(problems[choice].chosen, ", ",
                           [&](const ChosenValue& chosen) { return problems[choice].in_words(chosen); });
    for (const ParetoPoint& point : front.points)
      if (const auto& best = point.report.best; best && !point.dominated && point.choice == choice)
        curve.points.push_back(
            {best->second / x_factor, best->value / y_factor, point.report.status == DesignStatus::optimum});
    if (problems.size() == 1 || !curve.points.empty()) request.curves.push_back(std::move(curve));
  }
  return request;
}

}  // namespace rollres
