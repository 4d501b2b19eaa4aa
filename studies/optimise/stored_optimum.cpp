#include "studies/optimise/stored_optimum.hpp"

#include <atomic>
#include <cmath>

#include "studies/optimise/design_file.hpp"
#include "studies/run/stored_evaluations.hpp"
#include "studies/stored/accepted_study.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

int StoredOptimum::variable(std::string_view key) const {
  for (std::size_t i = 0; i < problem.variables.size(); ++i)
    if (problem.variables[i].quantity.key == key) return static_cast<int>(i);
  return -1;
}

bool is_optimisation(const std::string& definition, const std::string& place) {
  return !definition.empty() && parse_object(definition, place).contains("variables");
}

namespace {

/// The search by stored answers alone: it is deterministic.
std::optional<OptimiseReport> searched_again(const StoredOptimum& found, const Evaluate& recall) {
  std::atomic<bool> all_known = true;
  StoredEvaluations evaluations([&](const RollingScene& scene) {
    RollingSolution answer = recall(scene);
    if (std::isnan(answer.seconds)) all_known = false;
    return answer;
  });
  OptimiseReport report = optimise(found.problem, evaluations, {.jobs = 1});
  if (!all_known || !report.best || report.best->value != found.best->value) return std::nullopt;
  return report;
}

/// Of a variable that scatters: its value at the first point of the scatter over that of the design. Of the rows, those
/// at the first point lead back to designs so; what comes of the others has no answers and is left out.
double first_ratio(const DesignProblem& problem, std::string_view key) {
  for (std::size_t i = 0; i < problem.uncertain.inputs.size(); ++i)
    if (problem.uncertain.inputs[i].key == key)
      return quantile(problem.uncertain.inputs[i].distribution, problem.uncertain_points[i].front());
  return 1;
}

}  // namespace

std::optional<StoredOptimum> stored_optimum(ResultStore& store, const std::string& study) {
  const std::string text = accepted_study(store.definition(study).value_or(""));
  const std::string place = store.database().name() + ": " + study;
  if (!is_optimisation(text, place)) return std::nullopt;

  const std::vector<DesignProblem> problems = parse_design_problems(text, place);
  StoredOptimum found{.problem = problems.front(), .designs = {}, .choices = problems, .best = {}};
  const StudyRows rows(store, study);
  std::set<std::vector<double>> points;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::vector<double> point;
    for (const Variable& variable : found.problem.variables)
      point.push_back(rows.number(row, *find_quantity_column(input_column(variable.quantity.key))) /
                      first_ratio(found.problem, variable.quantity.key));
    points.insert(std::move(point));
  }
  // By keys made now: those that are stored may be an older program's.
  std::map<std::string, RollingSolution> answers;
  for (const std::string& key : store.points(study))
    if (auto evaluation = store.find(key))
      answers[evaluation_key(evaluation->scene, "")] = std::move(evaluation->solution);
  const Evaluate recall = [&](const RollingScene& scene) {
    const auto answer = answers.find(evaluation_key(scene, ""));
    return answer == answers.end() ? RollingSolution() : answer->second;
  };
  for (const DesignProblem& problem : problems)
    for (const std::vector<double>& point : points) {
      if (!answers.contains(evaluation_key(scenes_at(problem, point).front(), ""))) continue;
      Design design = evaluate_design(problem, point, recall);
      if (!design.found()) continue;
      if (design.feasible() && (!found.best || problem.goal.better(design.value, found.best->value))) {
        found.best = design;
        found.problem = problem;
      }
      found.designs.push_back(std::move(design));
      found.choice_of.push_back(static_cast<std::size_t>(&problem - problems.data()));
    }
  if (!found.problem.pareto && found.best) found.search = searched_again(found, recall);
  return found;
}

}  // namespace rollres
