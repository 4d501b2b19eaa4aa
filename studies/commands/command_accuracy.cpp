#include <ostream>
#include <stdexcept>

#include "studies/evidence/accuracy.hpp"
#include "studies/evidence/random_accuracy.hpp"
#include "studies/program/commands.hpp"
#include "studies/program/watched_run.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/text/files.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

struct AccuracyArguments {
  std::vector<std::string> scenes, overrides, methods, spacings;
  std::string out, format = "text";
  bool json = false;
  AccuracyOptions options;
  std::size_t random = 0;
  std::string indenter = "both";
  RandomAccuracyPlan plan;
};

/// A scene file, or one of the scenes that are inside the program.
RollingScene scene_of(const std::string& file, const std::vector<std::string>& overrides) {
  for (const PaperScene& paper : paper_scenes())
    if (file == paper.name && !std::filesystem::exists(file)) return parse_scene(paper.json, file, overrides);
  return read_scene(file, overrides);
}

/// The names of scene files, a number after one that was taken before.
std::vector<std::string> names_of(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (const std::string& file : files) {
    const std::string stem = std::filesystem::path(file).stem().string();
    std::string name = stem;
    for (int number = 2; contains(names, name); ++number) name = stem + "_" + std::to_string(number);
    names.push_back(name);
  }
  return names;
}

Json object_of(const AccuracyReport& report) {
  const AccuracyReference& reference = report.reference;
  Json object = json_object("scene", report.name, "reference", nullptr, "trends", Json::array(), "points",
                            json_of(accuracy_rows({report})));
  if (reference.found())
    object["reference"] =
        json_object("rolling_resistance", reference.rolling_resistance, "method", name_of(reference.method), "spacing",
                    reference.spacing, "contact_nodes", reference.contact_nodes, "extrapolated", reference.extrapolated,
                    "uncertainty", reference.uncertainty);
  for (const AccuracyTrend& trend : report.trends)
    object["trends"].push_back(json_object("method", name_of(trend.method), "order", trend.order, "order_deviation",
                                           trend.order_deviation, "growth", trend.growth));
  return object;
}

/// Says so where others used the processors, so that wall times are too long.
void warn_of_busy_machine(const std::vector<AccuracyReport>& reports, std::ostream& err) {
  double wall = 0, processor = 0;
  for (const AccuracyReport& report : reports)
    for (const AccuracyPoint& point : report.points)
      if (point.repeats > 0) {
        wall += point.seconds;
        processor += point.processor_seconds;
      }
  constexpr double disturbed = 1.2;
  if (wall > disturbed * processor)
    err << "the machine was busy: the solutions took " << duration_in_words(wall) << " but only "
        << duration_in_words(processor) << " of a processor; times are too long\n";
}

/// Whether errors are what they are said to be, on random scenes.
void random_accuracy(const AccuracyArguments& arguments, Session& session) {
  make_directory(arguments.out);
  RandomAccuracyPlan plan = arguments.plan;
  if (arguments.indenter != "sphere") plan.cylinders = arguments.random;
  if (arguments.indenter != "cylinder") plan.spheres = arguments.random;
  const RandomAccuracyReport report =
      watched_run(plan, session, [&] { return measure_random_accuracy(plan, session.evaluate); });
  const std::filesystem::path file = std::filesystem::path(arguments.out) / "random_accuracy.csv";
  write_file(file, csv_of(judged_table(report.solutions)));
  const Table table = random_accuracy_table(counts_of(report.solutions));
  if (arguments.json) {
    session.out << text_of(json_object("seed", plan.seed, "interrupted", report.interrupted, "results", json_of(table),
                                       "files", Json::array({file.string()})),
                           2)
                << '\n';
  } else {
    write_aligned(session.out, table);
    session.out << file.string() << '\n';
  }
  if (report.interrupted) {
    session.err << "interrupted: only part of the scenes was solved\n";
    session.status = ExitStatus::no_answer;
  }
}

void accuracy(const AccuracyArguments& arguments, Session& session) {
  if (arguments.random > 0) return random_accuracy(arguments, session);
  AccuracyOptions options = arguments.options;
  options.methods = methods_named(arguments.methods);
  StatusLine progress(session.err);
  options.report = [&](const std::string& line) { progress.show(line); };
  std::vector<std::string> files = arguments.scenes;
  if (files.empty())
    for (const PaperScene& paper : paper_scenes()) files.emplace_back(paper.name);
  const std::vector<std::string> names = names_of(files);
  std::vector<RollingScene> scenes;
  for (const std::string& file : files) scenes.push_back(scene_of(file, arguments.overrides));
  for (const std::string& spacing : arguments.spacings)
    options.spacings.push_back(*scene_of(files.front(), {"spacing=" + spacing}).spacing);
  make_directory(arguments.out);

  const Measure measure = [&](const RollingScene& scene, double limit) {
    return measured_solve(session.evaluate, scene, limit);
  };
  std::vector<AccuracyReport> reports;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    reports.push_back(measure_accuracy(names[i], scenes[i], options, measure));
    progress.clear();
    if (arguments.json) continue;
    session.out << accuracy_text(reports.back(), arguments.format == "markdown") << std::endl;
  }
  warn_of_busy_machine(reports, session.err);

  std::vector<std::filesystem::path> written{std::filesystem::path(arguments.out) / "accuracy.csv"};
  write_file(written.front(), csv_of(accuracy_rows(reports)));
  for (const AccuracyReport& report : reports) {
    const ChartRequest request = accuracy_chart(report);
    if (request.curves.empty()) {
      session.err << report.name << ": no chart, no error is known\n";
      continue;
    }
    const ChartFiles chart = draw_chart(request, std::filesystem::path(arguments.out) / ("accuracy_" + report.name));
    for (const auto& file : {chart.svg, chart.png, chart.script, chart.data}) written.push_back(file);
  }
  if (arguments.json) {
    Json object{{"scenes", Json::array()}, {"files", Json::array()}};
    for (const AccuracyReport& report : reports) object["scenes"].push_back(object_of(report));
    for (const auto& file : written) object["files"].push_back(file.string());
    session.out << text_of(object, 2) << '\n';
  } else {
    for (const auto& file : written)
      (arguments.format == "markdown" ? session.err : session.out) << file.string() << '\n';
  }
  for (const AccuracyReport& report : reports)
    for (const AccuracyPoint& point : report.points)
      if (point.status != AccuracyStatus::converged && point.status != AccuracyStatus::skipped)
        session.status = ExitStatus::no_answer;
}

}  // namespace

void add_accuracy(Command& program, Session& session) {
  const auto [command, arguments] = program.add<AccuracyArguments>(
      "accuracy", "Chart error against time, method by method, over a range of spacings", session, accuracy);
  AccuracyOptions& options = arguments.options;
  command->add_option("scene SCENE", arguments.scenes,
                      "scene files (JSON), or paper_cylinder or paper_sphere, which are inside the program; left out: "
                      "these two");
  command->add_option("--out DIR", arguments.out, "folder for accuracy.csv and the charts")->required();
  command->add_option("--methods METHOD,...", arguments.methods, "methods, separated by commas; left out: all")
      ->delimiter(',');
  CommandOption* const spacings = command
                                      ->add_option("--spacings SPACING,...", arguments.spacings,
                                                   "spacings, with a unit or in m, separated by commas")
                                      ->delimiter(',');
  command
      ->add_option("--levels N", options.levels,
                   "how many spacings, each 1/sqrt(2) of the last, from 8 nodes along the contact; left out: to 500 "
                   "nodes along a cylinder's, 130 along a sphere's")
      ->between(1, 100)
      ->excludes(spacings);
  command->add_option("--repeats N", options.repeats, "solutions of which the median time is taken; default: 5")
      ->between(1, 1000);
  command
      ->add_option("--seconds-limit SECONDS", options.seconds_limit,
                   "skip a solution that would take longer, stop one that does; default: 30")
      ->positive();
  command
      ->add_option("--set KEY=VALUE", arguments.overrides,
                   "replace an input of all scenes, in SI or with a unit; may be repeated")
      ->one_value_each();
  command->add_option("--format FORMAT", arguments.format, "text or markdown")->one_of({"text", "markdown"});
  command->add_flag("--json", arguments.json, "print one JSON object");
  CommandOption* const random =
      command
          ->add_option("--random N", arguments.random,
                       "instead: how often, on so many random scenes of each indenter, the error is below its estimate "
                       "and a tolerance is met; into DIR/random_accuracy.csv")
          ->between(1, 1'000'000);
  command->add_option("--seed S", arguments.plan.seed, "of the random scenes; default: 1")->needs(random);
  command
      ->add_option("--tolerances X,...", arguments.plan.tolerances,
                   "of the random scenes' solutions; default: 1e-2,1e-3")
      ->delimiter(',')
      ->positive()
      ->needs(random);
  command
      ->add_option("--indenter INDENTER", arguments.indenter,
                   "of the random scenes: cylinder, sphere or both; default: both")
      ->one_of({"cylinder", "sphere", "both"})
      ->needs(random);
  command->add_option("--jobs N", arguments.plan.jobs, "processes for the random scenes; default: one for each core")
      ->between(1, 1024)
      ->needs(random);
  command
      ->add_option("--time-limit SECONDS", arguments.plan.time_limit, "for one random scene, in seconds; default: 600")
      ->positive()
      ->needs(random);
  command->footer(
      "Each solution runs in a new process on one core, nothing kept from others. Exit status 1: one did not "
      "converge.\n"
      "Example: rollres accuracy studies/examples/paper_sphere.json --out out --methods newton,active_set\n"
      "Example: rollres accuracy --random 100 --seed 1 --out out");
}

}  // namespace rollres
