#include <ostream>
#include <stdexcept>

#include "studies/optimise/design_choices.hpp"
#include "studies/optimise/design_file.hpp"
#include "studies/optimise/design_records.hpp"
#include "studies/optimise/optimise_report.hpp"
#include "studies/program/watched_run.hpp"
#include "studies/study/study_definition.hpp"
#include "studies/study/study_scene.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

struct OptimiseArguments {
  std::string study, database, algorithm, out;
  int evaluations = 0, jobs = 0;
  bool json = false, replace = false;
};

/// One, or one of each combination of what is chosen from lists.
std::vector<DesignProblem> problems_of(const OptimiseArguments& arguments) {
  std::vector<DesignProblem> problems = read_design_problems(arguments.study);
  for (DesignProblem& problem : problems) {
    if (arguments.evaluations > 0) problem.stop.evaluations = arguments.evaluations;
    if (arguments.algorithm.empty()) continue;
    const auto& names = ChoiceNames<Algorithm>::names;
    const auto algorithm = static_cast<Algorithm>(find_name(names, arguments.algorithm));
    if (problem.variables.size() < traits(algorithm).fewest_variables)
      throw std::invalid_argument("--algorithm = " + arguments.algorithm + ": needs at least two variables");
    problem.algorithm = algorithm;
  }
  return problems;
}

/// The designs of the front as a study of their own, so that it can be listed, shown and drawn.
std::string store_front(ResultStore& store, std::span<const DesignProblem> problems, const StudyRecord& study,
                        const ParetoReport& front, const std::vector<DesignRecord>& designs) {
  StudyRecord record = study;
  record.name += " front";
  std::vector<std::string> keys, variants;
  for (const ParetoPoint& point : front.points)
    if (point.report.best && !point.dominated)
      for (const std::string& key : point.report.best->keys)
        if (!contains(keys, key)) {
          keys.push_back(key);
          variants.push_back(problems[point.choice].variant());
        }
  store.start_study(record, keys, variants);
  store.set_designs(record.name, designs);
  return record.name;
}

/// Draws and names the pictures, under the title of the study.
void draw(ChartRequest request, const StudyRecord& study, const OptimiseArguments& arguments, Session& session) {
  request.title = title_of_study(definition_in(study.definition, arguments.study), study.name);
  const ChartFiles files = draw_chart(request, arguments.out);
  for (const auto& file : {files.svg, files.png}) (arguments.json ? session.err : session.out) << file.string() << '\n';
}

void run_optimise(const OptimiseArguments& arguments, Session& session) {
  const std::vector<DesignProblem> problems = problems_of(arguments);
  const DesignProblem& problem = problems.front();
  if (!arguments.out.empty()) chart_files(arguments.out);  // a wrong name is told before the work
  StudyRecord study{problem.name, {}, standalone_study(arguments.study)};
  for (const ChosenValue& chosen : problem.chosen) study.axes.push_back(chosen.key);
  for (const Variable& variable : problem.variables) study.axes.emplace_back(variable.quantity.key);
  const StopSignal signal;
  StoredEvaluations evaluations(session.evaluate, arguments.database, study, &signal.requested(),
                                {arguments.replace, tell_redefined(study.name, session)});

  OptimiseOptions options{.jobs = arguments.jobs};
  StatusLine line(session.err);
  if (line) options.report = [&](const OptimiseProgress& progress) { line.show(in_words(problem, progress)); };

  const auto keep = [&](const std::vector<DesignRecord>& designs) {
    ResultStore(arguments.database).set_designs(study.name, designs);
  };
  const auto tell = [&](const auto& asked, const auto& report, bool found, const auto& chart, bool complete,
                        const std::string& more = "") {
    if (arguments.json)
      session.out << text_of(json_of(asked, report), 2) << '\n';
    else
      print_text(asked, report, session.out), session.out << more;
    if (!arguments.out.empty() && found) draw(chart(), study, arguments, session);
    if (!complete) session.status = ExitStatus::no_answer;
  };
  if (problem.pareto) {
    const ParetoReport front = pareto_front(problems, evaluations, options);
    evaluations.flush();
    line.clear();
    const std::vector<DesignRecord> designs = design_records(problems, front);
    keep(designs);
    ResultStore store(arguments.database);
    const std::string stored = store_front(store, problems, study, front, designs);
    return tell(
        problems, front, front.any(), [&] { return front_chart(problems, front); }, front.complete(),
        "the front is stored as study \"" + stored + "\"\n");
  }
  if (!problem.chosen.empty()) {
    const ChoicesReport report = optimise_choices(problems, evaluations, options);
    line.clear();
    keep(design_records(problems, report.reports));
    const auto chart = [&] { return course_chart(problems[*report.best], report.reports[*report.best]); };
    return tell(problems, report, report.best.has_value(), chart, report.status == DesignStatus::optimum);
  }
  const OptimiseReport report = optimise(problem, evaluations, options);
  line.clear();
  keep(design_records({&problem, 1}, {&report, 1}));
  const auto chart = [&] { return course_chart(problem, report); };
  tell(problem, report, report.best.has_value(), chart, report.status == DesignStatus::optimum);
}

}  // namespace

void add_optimise(Command& program, Session& session) {
  const auto [command, arguments] = program.add<OptimiseArguments>(
      "optimise", "Find the best values of some inputs, under constraints, or a Pareto front", session, run_optimise);
  command->add_option("study STUDY", arguments.study, "study file with variables and minimise or maximise")->required();
  command->add_option("--db FILE", arguments.database, "database; created if it is missing")->or_usual_database();
  command
      ->add_option("--algorithm ALGORITHM", arguments.algorithm,
                   "bobyqa, cobyla, nelder_mead, subplex, direct_l, crs2, slsqp, mma, ccsaq or lbfgs")
      ->one_of(ChoiceNames<Algorithm>::names);
  command->add_option("--max-evaluations N", arguments.evaluations, "most scenes that a search may ask for")
      ->between(1, 100'000'000);
  command->add_option("--jobs N", arguments.jobs, "threads; default: one for each core")->between(1, 1024);
  command->add_option("--out PATH", arguments.out,
                      "draw the course of the search, or the front, as PATH.svg and PATH.png");
  command->add_flag("--replace", arguments.replace,
                    "take the place of a study of this name that is defined otherwise; its rows stay");
  command->add_flag("--json", arguments.json, "print the outcome as one JSON object");
  command->footer(
      "Every evaluation is stored and recalled: the same command repeats the run at no cost, or goes on where it was\n"
      "stopped. Status: optimum (to first order nothing near is better), unconfirmed, evaluation_limit, interrupted,\n"
      "no_feasible_design; exit status 0 for optimum, else 1. A multiplier tells by how many % the goal improves for\n"
      "1 % more room in a constraint; elasticities are d ln / d ln.\n"
      "Example: rollres optimise studies/examples/optimise_layer.json --db results.db");
}

}  // namespace rollres
