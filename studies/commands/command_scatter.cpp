#include <ostream>
#include <stdexcept>

#include "studies/charts/scatter_chart.hpp"
#include "studies/charts/study_chart.hpp"
#include "studies/program/watched_run.hpp"
#include "studies/stored/scatter_report.hpp"
#include "studies/study/study_outputs.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct ScatterArguments {
  std::string study, database, quantiles = "10,50,90", out, retry = "nothing";
  std::vector<std::string> outputs, conditions;
  int jobs = 0;
  bool json = false, replace = false;
};

/// Numbers and formulas that the study names, or the rolling resistance.
std::vector<std::string> usual_outputs(const Study& study) {
  const std::vector<std::string_view> numbers = number_outputs();
  std::vector<std::string> outputs;
  const auto add = [&](const std::string& key) {
    const bool formula = any_of(study.formulas, [&](const auto& one) { return one.first == key; });
    if ((formula || find_name(numbers, key) >= 0) && !contains(outputs, key)) outputs.push_back(key);
  };
  for (const std::string& key : study.compute) add(key);
  for (const StudyChart& chart : study.charts) add(chart.y);
  if (outputs.empty()) outputs.emplace_back("rolling_resistance");
  return outputs;
}

ScatterWish wish_of(const ScatterArguments& arguments, const Study& study) {
  ScatterWish wish{.outputs = {}, .conditions = study.uncertain.probabilities, .probabilities = {}};
  for (const std::string& text : arguments.outputs.empty() ? usual_outputs(study) : arguments.outputs)
    refusing_at("--output", [&] {
      wish.outputs.emplace_back(text, FormulaNames::inputs_and_outputs, study.formulas);
      refuse_never_computed(wish.outputs.back(), study);
    });
  for (const std::string& text : arguments.conditions)
    refusing_at("--probability", [&] {
      wish.conditions.emplace_back(text, FormulaNames::inputs_and_outputs, body_of(study.base), study.formulas);
    });
  for (const std::string& word : split_at_commas(arguments.quantiles)) {
    const std::optional<double> percent = plain_number(word);
    if (!percent || !(*percent > 0 && *percent < 100))
      throw std::invalid_argument("--quantiles = " + arguments.quantiles + ": must be numbers between 0 and 100");
    wish.probabilities.push_back(*percent / 100);
  }
  return wish;
}

SweepReport solve(const Study& study, const ScatterArguments& arguments, Session& session) {
  const SweepOptions options{.jobs = arguments.jobs,
                             .retry = retry_named(arguments.retry),
                             .replace = arguments.replace,
                             .fields = study.fields ? Fields::kept : Fields::dropped};
  std::optional<StopSignal> signal;
  return watched_sweep(study, arguments.database, options, signal, session);
}

void draw(const ScatterReport& report, const ScatterArguments& arguments, Session& session) {
  std::ostream& names = arguments.json ? session.err : session.out;
  const auto name = [&](const ChartFiles& files) { names << files.svg.string() << '\n' << files.png.string() << '\n'; };
  for (std::size_t i = 0; i < report.wish.outputs.size(); ++i) {
    const Formula& formula = report.wish.outputs[i];
    ScatterPicture picture{.title = report.study.name,
                           .axis = {.name = in_words(formula.text())},
                           .unit = unit_of(formula, report.body()),
                           .labels = {},
                           .values = {}};
    const std::string ending = report.wish.outputs.size() == 1 ? "" : formula.text() + "_";
    for (const std::string& line : in_words(report.study.uncertain, report.body()))
      picture.comment += (picture.comment.empty() ? "" : "\n") + line;
    for (const ScatterPlace& place : report.results.places) {
      picture.labels.push_back(place_in_words(report, place));
      picture.values.push_back(place.values[i]);
    }
    picture.ordered = report.study.axes.size() == 1 && report.study.axes.front().texts.empty();
    if (report.results.places.size() <= most_curves) {
      name(draw_chart(histogram_chart(picture), one_of_several(arguments.out, ending + "histogram")));
      name(draw_chart(cumulative_chart(picture), one_of_several(arguments.out, ending + "cumulative")));
    } else {
      session.err << "no histogram of " << report.results.places.size() << " places: rollres query has their numbers\n";
    }
  }
}

void scatter(const ScatterArguments& arguments, Session& session) {
  const Study study = read_study(arguments.study);
  if (!study.uncertain.any())
    throw std::invalid_argument(arguments.study + ": uncertain is missing: no input of this study scatters");
  const ScatterWish wish = wish_of(arguments, study);
  if (!arguments.out.empty()) chart_files(arguments.out);  // a wrong name is told before the work
  const SweepReport swept = solve(study, arguments, session);
  ResultStore store(arguments.database, Access::read);
  const ScatterReport report{study, wish,
                             scatter_results(study, StudyPlan(study), store, wish.outputs, wish.conditions)};
  if (arguments.json) {
    Json object = json_of(report);
    object["recalled"] = swept.recalled;
    object["solved"] = swept.solved;
    object["dropped"] = swept.dropped;
    object["seconds"] = swept.seconds;
    session.out << text_of(object, 2) << '\n';
  } else {
    print_text(report, session.out);
    session.out << "\nbehind ±: half the width of the 95 % interval, from the " << study.uncertain.scramblings
                << " scramblings\n"
                << swept.recalled << " points recalled, " << swept.solved << " solved in "
                << duration_in_words(swept.seconds) << '\n';
  }
  if (swept.dropped > 0)
    session.err << swept.dropped << " points are dropped by constraints: the numbers are of those that meet them\n";
  const std::size_t without = report.results.failed() + report.results.missing();
  if (without > 0) {
    session.err
        << without << " of " << report.results.points()
        << " points have no answer; the numbers are of the others, and may be off by what these would have been\n";
    for (const auto& [reason, count] : report.results.reasons) session.err << count << " x " << reason << '\n';
    session.status = ExitStatus::no_answer;
  }
  if (swept.interrupted) session.err << "interrupted: the same command solves what is missing\n";
  if (!arguments.out.empty()) draw(report, arguments, session);
}

}  // namespace

void add_scatter(Command& program, Session& session) {
  const auto [command, arguments] = program.add<ScatterArguments>(
      "scatter", "Solve a study whose inputs scatter, and say how its outputs do", session, scatter);
  command->add_option("study STUDY", arguments.study, "study file with uncertain inputs")->required();
  command->add_option("--db FILE", arguments.database, "database; created if it is missing")->or_usual_database();
  command
      ->add_option("--output FORMULA", arguments.outputs,
                   "output, or a formula; may be repeated; left out: those that the study computes or draws")
      ->one_value_each();
  command
      ->add_option("--probability CONDITION", arguments.conditions,
                   "how probable it is that this holds, 'peak_pressure > 2 MPa'; may be repeated")
      ->one_value_each();
  command->add_option("--quantiles P,...", arguments.quantiles, "in percent; default: 10,50,90");
  command->add_option("--jobs N", arguments.jobs, "threads; default: one for each core")->between(1, 1024);
  command->add_option("--retry WHICH", arguments.retry, "solve again what is stored: failed, not_converged, or all")
      ->one_of({"failed", "not_converged", "all"});
  command->add_flag("--replace", arguments.replace,
                    "take the place of a study of this name that is defined otherwise; its rows stay");
  command->add_option("--out PATH", arguments.out,
                      "draw each output's histogram and cumulative distribution as PATH_histogram.svg and so on");
  command->add_flag("--json", arguments.json, "print one JSON object");
  command->footer(
      "Points are stored and recalled as in a sweep; rollres sweep may solve them first, in shards too. Errors are\n"
      "half-widths of 95 % intervals. rollres chart draws a study with axes with bands from P10 to P90.\n"
      "Example: rollres scatter studies/examples/rubber_scatter.json --db results.db");
}

}  // namespace rollres
