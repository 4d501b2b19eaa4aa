#include <ostream>

#include "studies/program/commands.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/sensitivity/gradient_report.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct GradientArguments {
  std::string scene, output = "rolling_resistance";
  std::vector<std::string> overrides, inputs;
  GradientOptions options{.order = 4, .jobs = 0};
  bool json = false;
};

void run_gradient(const GradientArguments& arguments, Session& session) {
  const RollingScene scene = read_scene(arguments.scene, arguments.overrides);
  std::vector<InputChoice> inputs;
  for (const std::string& key : arguments.inputs) inputs.push_back({key});
  Objective objective{scene, {}, {}, session.evaluate};
  objective.output = refusing_at("--output", [&] { return real_output(arguments.output); });
  objective.variables = refusing_at(arguments.scene + " with --inputs", [&] { return variables_of(scene, inputs); });

  const GradientReport report = gradient_report(std::move(objective), arguments.options);
  if (arguments.json)
    session.out << text_of(json_of(report), 2) << '\n';
  else
    print_text(report, session.out, session.err);
  if (!report.gradient.complete()) session.status = ExitStatus::no_answer;
}

}  // namespace

void add_gradient(Command& program, Session& session) {
  const auto [command, arguments] = program.add<GradientArguments>(
      "gradient", "Differentiate one output of a scene by some of its inputs", session, run_gradient);
  command->add_option("scene SCENE", arguments.scene, "Scene file (JSON)")->required();
  command->add_option("--inputs KEY,...", arguments.inputs, "Inputs to differentiate by, separated by commas")
      ->required()
      ->delimiter(',');
  command->add_option("--output KEY", arguments.output, "Output; default rolling_resistance");
  command->add_option("--set KEY=VALUE", arguments.overrides, "Replace an input, in SI or with a unit; may be repeated")
      ->one_value_each();
  command->add_option("--order ORDER", arguments.options.order, "2 or 4 (default): order of the differences")
      ->one_of({"2", "4"});
  command->add_option("--jobs N", arguments.options.jobs, "Threads; default: one for each core")->between(1, 1024);
  command->add_flag("--json", arguments.json, "Print one JSON object");
  command->footer(
      "Derivatives are by finite differences whose steps suit the noise of the output, which is measured first (8 or "
      "14\n"
      "evaluations for each input, then 2 or 4). \"+-\" is the estimated error: truncation and three standard "
      "deviations "
      "of\nthe noise. Steps are relative, noise is relative to the output; elasticity is d ln output / d ln input.\n"
      "Example: rollres gradient studies/examples/paper_cylinder.json --inputs load,speed,creep_time");
}

}  // namespace rollres
