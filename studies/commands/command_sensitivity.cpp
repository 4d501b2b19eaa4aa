#include <bit>
#include <cmath>
#include <mutex>
#include <ostream>

#include "studies/drawing/bar_chart.hpp"
#include "studies/optimise/optimise_report.hpp"
#include "studies/program/watched_run.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/sensitivity/global_sensitivity.hpp"
#include "studies/sensitivity/gradient_report.hpp"
#include "studies/sensitivity/sensitivity.hpp"
#include "studies/study/study_scene.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/value_and_error.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct GradientArguments {
  std::string scene, output = "rolling_resistance";
  std::vector<std::string> overrides, inputs;
  GradientOptions options{.order = 4, .jobs = 0};
  bool json = false;
};

struct SensitivityArguments {
  std::string file, output, indices, database, out;
  std::vector<std::string> overrides, ranges;
  int samples = 0, jobs = 0;
  std::uint64_t seed = 0;
  bool json = false, replace = false;
};

void draw(const BarChart& chart, const SensitivityArguments& arguments, Session& session) {
  const ChartFiles files = draw_bar_chart(chart, arguments.out);
  for (const auto& file : {files.svg, files.png}) (arguments.json ? session.err : session.out) << file.string() << '\n';
}

BarChart elasticity_chart(const GradientReport& report, const std::string& name) {
  const Quantity& output = report.objective.output;
  BarChart chart{.title = name + ": " + in_words(output.key), .axis = {.name = "elasticity"}, .bars = {}};
  for (std::size_t i = 0; i < report.size(); ++i) {
    const InputReport input = report[i];
    const Quantity& quantity = input.variable.quantity;
    chart.bars.push_back({in_words(quantity.key),
                          std::string(symbol_beside_name(quantity)),
                          {{input.gradient.elasticity, input.elasticity_error()}}});
  }
  return chart;
}

void print(const GradientReport& report, bool json, Session& session) {
  if (json)
    session.out << text_of(json_of(report), 2) << '\n';
  else
    print_text(report, session.out, session.err);
  if (!report.gradient.complete()) session.status = ExitStatus::no_answer;
}

/// An output that is a real number and that answers of the scene have. @throws std::invalid_argument otherwise
Quantity present_output(const std::string& key, const RollingScene& scene) {
  return refusing_at("--output", [&] {
    const Quantity output = real_output(key);
    refuse_absent(Formula(key, FormulaNames::inputs_and_outputs), scene);
    return output;
  });
}

void run_gradient(const GradientArguments& arguments, Session& session) {
  const RollingScene scene = read_scene(arguments.scene, arguments.overrides);
  std::vector<InputChoice> inputs;
  for (const std::string& key : arguments.inputs) {
    refusing_at("--inputs", [&] { require_held(key); });
    inputs.push_back({key});
  }
  Objective objective{scene, {}, {}, session.evaluate};
  objective.output = present_output(arguments.output, scene);
  objective.variables = refusing_at(arguments.scene + " with --inputs", [&] { return variables_of(scene, inputs); });
  print(gradient_report(std::move(objective), arguments.options), arguments.json, session);
}

void local_sensitivity(const SensitivityArguments& arguments, Session& session) {
  const RollingScene scene = read_scene(arguments.file, arguments.overrides);
  Objective objective{scene, variables_of(scene, inputs_with_elasticity(scene)), {}, session.evaluate};
  objective.output = present_output(arguments.output.empty() ? "rolling_resistance" : arguments.output, scene);
  GradientReport report = gradient_report(std::move(objective), {.order = 4, .jobs = arguments.jobs});
  sort_by_elasticity(report);
  print(report, arguments.json, session);
  if (!arguments.out.empty() && report.gradient.centre.found())
    draw(elasticity_chart(report, std::filesystem::path(arguments.file).stem().string()), arguments, session);
}

/// What either kind of index says of one input.
struct InputFinding {
  Quantity quantity;
  std::vector<Cell> cells;
  std::vector<BarValue> bars;
  double size;  // by which inputs are sorted
};

struct GlobalFindings {
  Table table;  // without rows
  std::vector<std::string> series;
  std::string axis;
  std::vector<InputFinding> inputs;
  Json summary;  // of the run

  void sort() {
    stable_sort(inputs, [](const auto& a, const auto& b) { return a.size > b.size; });
    for (const InputFinding& input : inputs) table.rows.push_back(input.cells);
  }
};

GlobalFindings sobol_findings(const DesignProblem& problem, const CubeFunction& function,
                              const SensitivityArguments& arguments) {
  const auto rows = static_cast<std::size_t>(arguments.samples > 0 ? arguments.samples : 256);
  if (!std::has_single_bit(rows))
    throw std::invalid_argument("--samples = " + std::to_string(rows) + ": must be a power of two with sobol: " +
                                std::to_string(std::bit_floor(rows)) + " or " + std::to_string(std::bit_ceil(rows)));
  const SobolIndices found = sobol_indices(function, problem.variables.size(), rows, arguments.seed, arguments.jobs);
  GlobalFindings findings{.table = {{"input", "first_order", "first_order_error", "total", "total_error"}, {}},
                          .series = {"first order", "total"},
                          .axis = "share of the variance",
                          .inputs = {},
                          .summary = {{"mean", found.mean},
                                      {"standard_deviation", std::sqrt(found.variance)},
                                      {"rows", found.rows},
                                      {"failed_rows", found.failed_rows}}};
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    const Quantity& quantity = problem.variables[i].quantity;
    const auto &first = found.first[i], &total = found.total[i];
    findings.inputs.push_back({quantity,
                               {std::string(quantity.key), first.value, first.error, total.value, total.error},
                               {{first.value, first.error}, {total.value, total.error}},
                               total.value});
  }
  return findings;
}

GlobalFindings morris_findings(const DesignProblem& problem, const CubeFunction& function,
                               const SensitivityArguments& arguments) {
  const auto trajectories = static_cast<std::size_t>(arguments.samples > 0 ? arguments.samples : 20);
  const MorrisEffects found =
      morris_effects(function, problem.variables.size(), trajectories, arguments.seed, arguments.jobs);
  GlobalFindings findings{.table = {{"input", "mean_size", "mean_size_error", "mean", "deviation", "effects"}, {}},
                          .series = {"mean size µ*", "deviation σ"},
                          .axis = "effect over the range",
                          .inputs = {},
                          .summary = {{"trajectories", trajectories}, {"failed", found.failed}}};
  const auto number = [](double value) { return std::isfinite(value) ? Cell(value) : Cell(); };
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    const Quantity& quantity = problem.variables[i].quantity;
    const MorrisEffect& effect = found.inputs[i];
    findings.inputs.push_back(
        {quantity,
         {std::string(quantity.key), number(effect.mean_size), number(effect.mean_size_error), number(effect.mean),
          number(effect.deviation), static_cast<std::int64_t>(effect.effects)},
         {{effect.mean_size, effect.mean_size_error}, {effect.deviation, RollingSolution::absent}},
         std::isfinite(effect.mean_size) ? effect.mean_size : -1});
  }
  return findings;
}

/// The table for people: numbers beside their errors are rounded by these.
Table rounded_by_errors(Table table) {
  for (std::size_t i = 0; i + 1 < table.columns.size(); ++i) {
    if (table.columns[i + 1] != table.columns[i] + "_error") continue;
    for (auto& row : table.rows) {
      const auto *const value = std::get_if<double>(&row[i]), *const error = std::get_if<double>(&row[i + 1]);
      if (!value || !error) continue;
      const ValueAndError shown = value_and_error(*value, *error, "");
      row[i] = shown.value;
      row[i + 1] = shown.error;
    }
  }
  return table;
}

void global_sensitivity(const SensitivityArguments& arguments, Session& session) {
  const DesignProblem problem = read_ranges(arguments.file, arguments.overrides, arguments.ranges, arguments.output);
  const StopSignal signal;
  std::optional<StoredEvaluations> evaluations;
  if (arguments.database.empty()) {
    evaluations.emplace(session.evaluate, &signal.requested());
  } else {
    StudyRecord study{problem.name + " " + arguments.indices, {}, standalone_study(arguments.file)};
    for (const Variable& variable : problem.variables) study.axes.emplace_back(variable.quantity.key);
    evaluations.emplace(session.evaluate, arguments.database, study, &signal.requested(),
                        StudyStart{arguments.replace, tell_redefined(study.name, session)});
  }
  std::optional<StatusLine> line(session.err);
  std::mutex one_at_a_time;
  const CubeFunction function = [&](std::span<const double> place) {
    const auto evaluate = [&](const RollingScene& scene) { return (*evaluations)(scene); };
    const double value = evaluate_design(problem, point_in_box(problem, place), evaluate).value;
    const std::lock_guard lock(one_at_a_time);
    line->show(std::to_string(evaluations->count().all()) + " scenes solved or recalled");
    return value;
  };
  GlobalFindings findings;
  try {
    findings = arguments.indices == "sobol" ? sobol_findings(problem, function, arguments)
                                            : morris_findings(problem, function, arguments);
  } catch (const Interrupted&) {
    line.reset();
    session.err << "interrupted"
                << (!arguments.database.empty() ? ": the same command goes on where it stopped\n" : "\n");
    session.status = ExitStatus::no_answer;
    return;
  }
  line.reset();
  evaluations->flush();
  findings.sort();

  const EvaluationCount count = evaluations->count();
  const std::string unit = problem.unit(problem.goal.formula);
  if (arguments.json) {
    Json object = json_object("output", problem.goal.formula.text(), "unit", unit, "indices", arguments.indices, "seed",
                              arguments.seed, "evaluations",
                              json_object("solved", count.solved, "recalled", count.recalled, "failed", count.failed));
    object.update(findings.summary);
    object["inputs"] = json_of(findings.table);
    session.out << text_of(object, 2) << '\n';
  } else {
    session.out << problem.goal.formula.text() << (unit.empty() ? "" : " [" + unit + "]") << ", " << arguments.indices
                << ": " << in_words(count) << "\n\n";
    write_aligned(session.out, rounded_by_errors(findings.table));
  }
  if (arguments.out.empty()) return;
  BarChart chart{.title = problem.name + ": " + in_words(problem.goal.formula.text()),
                 .axis = {.name = findings.axis, .unit = arguments.indices == "morris" ? typeset_unit(unit) : ""},
                 .series = findings.series,
                 .bars = {}};
  for (const InputFinding& input : findings.inputs)
    chart.bars.push_back({in_words(input.quantity.key), std::string(symbol_beside_name(input.quantity)), input.bars});
  draw(chart, arguments, session);
}

void run_sensitivity(const SensitivityArguments& arguments, Session& session) {
  if (!arguments.out.empty()) chart_files(arguments.out);  // a wrong name is told before the work
  arguments.indices.empty() ? local_sensitivity(arguments, session) : global_sensitivity(arguments, session);
}

}  // namespace

void add_sensitivity(Command& program, Session& session) {
  const auto [command, arguments] = program.add<SensitivityArguments>(
      "sensitivity", "Which inputs a result depends on: elasticities, or indices over ranges", session,
      run_sensitivity);
  command->add_option("file SCENE|STUDY", arguments.file, "scene file; with --indices also a study file")->required();
  command->add_option("--output KEY", arguments.output,
                      "output, with --indices a formula; default: rolling_resistance");
  command
      ->add_option("--set KEY=VALUE", arguments.overrides,
                   "replace an input of the scene, in SI or with a unit; may be repeated")
      ->one_value_each();
  auto* const indices =
      command->add_option("--indices INDICES", arguments.indices, "sobol or morris: over ranges of the inputs")
          ->one_of({"sobol", "morris"});
  const auto with_indices = [&](CommandOption* option) { return option->needs(indices); };
  with_indices(command->add_option("--range KEY=FROM:TO[:logarithmic]", arguments.ranges,
                                   "range of an input of a scene; may be repeated"))
      ->one_value_each();
  with_indices(command->add_option("--samples N", arguments.samples,
                                   "sobol: rows, a power of two; default: 256. morris: trajectories; default: 20"))
      ->between(2, 10'000'000);
  with_indices(command->add_option("--seed S", arguments.seed, "of the sample; default: 0"));
  with_indices(
      command->add_option("--db FILE", arguments.database, "database; every evaluation is stored and recalled"));
  with_indices(command->add_flag("--replace", arguments.replace,
                                 "take the place of a study of this name that is defined otherwise; its rows stay"));
  command->add_option("--jobs N", arguments.jobs, "threads; default: one for each core")->between(1, 1024);
  command->add_option("--out PATH", arguments.out, "draw bars with their errors as PATH.svg and PATH.png");
  command->add_flag("--json", arguments.json, "print one JSON object");
  command->footer(
      "Without --indices: d ln output / d ln input for every input that is present and not zero, as rollres gradient\n"
      "finds them, the largest first. sobol: shares of the variance, rows * (inputs + 2) evaluations; morris: mean "
      "size\n"
      "and deviation of elementary effects, trajectories * (inputs + 1). Errors are half-widths of 95 % intervals.\n"
      "Example: rollres sensitivity studies/examples/paper_cylinder.json --set tolerance=1e-8 --out sensitivity");
}

void add_gradient(Command& program, Session& session) {
  const auto [command, arguments] = program.add<GradientArguments>(
      "gradient", "Differentiate one output of a scene by some of its inputs", session, run_gradient);
  command->add_option("scene SCENE", arguments.scene, "scene file (JSON)")->required();
  command->add_option("--inputs KEY,...", arguments.inputs, "inputs to differentiate by, separated by commas")
      ->required()
      ->delimiter(',');
  command->add_option("--output KEY", arguments.output, "output; default: rolling_resistance");
  command->add_option("--set KEY=VALUE", arguments.overrides, "replace an input, in SI or with a unit; may be repeated")
      ->one_value_each();
  command->add_option("--order ORDER", arguments.options.order, "order of the differences; default: 4")
      ->one_of({"2", "4"});
  command->add_option("--jobs N", arguments.options.jobs, "threads; default: one for each core")->between(1, 1024);
  command->add_flag("--json", arguments.json, "print one JSON object");
  command->footer(
      "Derivatives are by finite differences whose steps suit the noise of the output and the scale over which an\n"
      "input acts. These are measured first: mostly 8 evaluations for each input, 40 at most; then 2 or 4. \"+-\" is\n"
      "the estimated error: truncation, three standard deviations of the noise, and the error of the solutions.\n"
      "Steps are relative, noise is relative to the output; elasticity is d ln output / d ln input.\n"
      "Example: rollres gradient studies/examples/paper_cylinder.json --inputs load,speed,creep_time");
}

}  // namespace rollres
