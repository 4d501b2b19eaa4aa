#include "studies/optimise/design_choices.hpp"

#include <cmath>
#include <ostream>

#include "studies/optimise/optimise_report.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// Whether the search of one problem leaves no better design to be expected there.
bool has_ended(const OptimiseReport& report) {
  return report.status == DesignStatus::optimum || report.status == DesignStatus::no_feasible_design;
}

void judge(std::span<const DesignProblem> problems, ChoicesReport& all) {
  for (std::size_t i = 0; i < all.reports.size(); ++i) {
    const OptimiseReport& one = all.reports[i];
    if (one.best && (!all.best || problems[i].goal.better(one.value(), all.reports[*all.best].value()))) all.best = i;
  }
  if (all.best) all.status = DesignStatus::optimum;
  for (std::size_t i = 0; i < all.reports.size(); ++i) {
    const OptimiseReport& one = all.reports[i];
    if (all.best ? has_ended(one) : one.status != DesignStatus::interrupted) continue;
    all.status = one.status;
    all.reason =
        chosen_in_words(problems[i]) + ": " + (one.reason.empty() ? std::string(name_of(one.status)) : one.reason);
    if (all.status == DesignStatus::interrupted) return;
  }
  if (!all.best && all.reason.empty()) all.reason = "no choice has a design that meets the constraints";
}

Table table_of(std::span<const DesignProblem> problems, const ChoicesReport& report) {
  Table table;
  for (const ChosenValue& chosen : problems.front().chosen) table.columns.push_back(chosen.key);
  table.columns.push_back(problems.front().goal.formula.text());
  for (const Variable& variable : problems.front().variables) table.columns.emplace_back(variable.quantity.key);
  table.columns.insert(table.columns.end(), {"status", "best"});
  for (std::size_t i = 0; i < report.reports.size(); ++i) {
    const DesignProblem& problem = problems[i];
    const OptimiseReport& one = report.reports[i];
    std::vector<Cell>& row = table.rows.emplace_back();
    for (const ChosenValue& chosen : problem.chosen) row.emplace_back(problem.in_words(chosen));
    row.push_back(one.best ? Cell(readable(one.value(), problem.unit(problem.goal.formula))) : Cell());
    for (std::size_t v = 0; v < problem.variables.size(); ++v)
      row.push_back(one.best ? Cell(readable(problem.variables[v].quantity, one.best->point[v],
                                             problem.unit(problem.variables[v].quantity)))
                             : Cell());
    row.emplace_back(std::string(name_of(one.status)));
    row.push_back(report.best == i ? Cell("best") : Cell());
  }
  return table;
}

/// Choices that differ from the best one by less than the errors of both, a sentence for each.
std::vector<std::string> undecided(std::span<const DesignProblem> problems, const ChoicesReport& report) {
  std::vector<std::string> sentences;
  if (!report.best) return sentences;
  const Design& best = *report.reports[*report.best].best;
  for (std::size_t i = 0; i < report.reports.size(); ++i) {
    const std::optional<Design>& other = report.reports[i].best;
    if (i == *report.best || !other) continue;
    const double apart = std::abs(other->value - best.value), open = std::hypot(other->error, best.error);
    if (!(apart < open)) continue;
    const auto words = [&](double value) { return readable(value, problems[i].unit(problems[i].goal.formula)); };
    sentences.push_back(chosen_in_words(problems[i]) + " is worse than the best by " + words(apart) +
                        ", less than the errors of both (" + words(open) +
                        "), so the better one may be the worse in truth");
  }
  return sentences;
}

}  // namespace

std::string chosen_in_words(const DesignProblem& problem) {
  return joined(problem.chosen, ", ",
                [&](const ChosenValue& chosen) { return chosen.key + " = " + problem.in_words(chosen); });
}

ChoicesReport optimise_choices(std::span<const DesignProblem> problems, StoredEvaluations& evaluations,
                               const OptimiseOptions& options) {
  ChoicesReport all;
  const EvaluationCount before = evaluations.count();
  std::optional<double> best;
  for (const DesignProblem& problem : problems) {
    evaluations.be_of_variant(problem.variant());
    const auto the_better = [&](std::optional<double> value) {
      return best && (!value || !problem.goal.better(*value, *best)) ? best : value;
    };
    OptimiseOptions here = options;
    if (options.report)
      here.report = [&](OptimiseProgress progress) {
        progress.place = all.reports.size() + 1;
        progress.all = problems.size();
        progress.best = the_better(progress.best);
        options.report(progress);
      };
    all.reports.push_back(optimise(problem, evaluations, here));
    const OptimiseReport& last = all.reports.back();
    if (last.status == DesignStatus::interrupted) break;
    if (last.best) best = the_better(last.value());
  }
  all.count = evaluations.count() - before;
  judge(problems, all);
  return all;
}

void print_text(std::span<const DesignProblem> problems, const ChoicesReport& report, std::ostream& out) {
  out << problems.front().name << ": " << name_of(report.status) << (report.reason.empty() ? "" : ": " + report.reason)
      << "\n\n";
  write_aligned(out, table_of(problems, report));
  for (const std::string& sentence : undecided(problems, report)) out << sentence << '\n';
  out << '\n' << in_words(report.count) << " for all choices\n";
  if (!report.best) return;
  out << "\nthe best, " << chosen_in_words(problems[*report.best]) << ":\n";
  print_text(problems[*report.best], report.reports[*report.best], out);
}

Json json_of(std::span<const DesignProblem> problems, const ChoicesReport& report) {
  const std::size_t shown = report.best.value_or(0);
  Json object = json_of(problems[shown], report.reports[shown]);
  object["status"] = name_of(report.status);
  object["reason"] = report.reason;
  object["chosen"] = report.best ? chosen_json(problems[shown]) : Json(nullptr);
  object["undecided"] = undecided(problems, report);
  object["choices"] = Json::array();
  for (std::size_t i = 0; i < report.reports.size(); ++i) {
    const OptimiseReport& one = report.reports[i];
    Json variables = Json::object();
    for (std::size_t v = 0; one.best && v < one.best->point.size(); ++v)
      variables[std::string(problems[i].variables[v].quantity.key)] = one.best->point[v];
    object["choices"].push_back(json_object("chosen", chosen_json(problems[i]), "status", name_of(one.status), "reason",
                                            one.reason, "value", one.value(), "variables", variables));
  }
  return object;
}

}  // namespace rollres
