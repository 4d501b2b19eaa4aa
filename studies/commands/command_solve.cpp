#include <memory>
#include <ostream>
#include <stdexcept>

#include "studies/evidence/simpler_models.hpp"
#include "studies/program/command_line.hpp"
#include "studies/program/commands.hpp"
#include "studies/scene_io/fields_file.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/scene_io/summary.hpp"
#include "studies/text/write_file.hpp"

namespace rollres {

namespace {

struct SolveOptions {
  std::string scene;
  std::vector<std::string> overrides;
  bool json = false, explain = false;
  std::string fields;
};

void run_solve(const SolveOptions& options, bool with_fields, Session& session) {
  const RollingScene scene = read_scene(options.scene, options.overrides);
  if (with_fields && options.fields.empty()) throw std::invalid_argument("--fields = \"\": must name a directory");
  if (with_fields) make_directory(options.fields);  // before the work, not after it

  const RollingSolution solution = session.evaluate(scene);
  session.out << (options.json ? solution_json(scene, solution) + '\n' : summary(scene, solution));
  if (options.explain && !options.json) {
    session.out << explanation(scene, solution);
    if (solution.status == Status::converged)
      session.out << simpler_models_text(scene, solution, simpler_models(scene, solution, session.evaluate));
  }
  session.out << std::flush;
  if (solution.status != Status::converged) session.status = ExitStatus::no_answer;
  if (!with_fields) return;
  if (solution.fields.grid.size() == 0) {
    session.err << "rollres: " << options.fields << ": nothing written, the solution has no fields\n";
    return;
  }
  write_fields(options.fields, scene, solution.fields);
}

}  // namespace

void add_solve(Command& program, Session& session) {
  Command* const command = program.add_subcommand("solve", "Solve one scene and print its rolling resistance");
  const auto options = std::make_shared<SolveOptions>();
  command->add_option("scene", options->scene, "Scene file (JSON)")->required()->option_text("SCENE");
  command->add_option("--set", options->overrides, "Replace an input, in SI or with a unit; may be repeated")
      ->option_text("KEY=VALUE")
      ->one_value_each();
  command->add_flag("--json", options->json, "Print one JSON object");
  command->add_flag(
      "--explain", options->explain,
      "Print what was decided, left out and kept, with the number it rests on, and what simpler models answer");
  CommandOption* const fields =
      command->add_option("--fields", options->fields, "Write the surface's fields to DIR/fields.csv and .vti")
          ->option_text("DIR");
  command->footer("Example: rollres solve studies/examples/paper_cylinder.json --set speed=\"36 km/h\" --fields out");
  command->callback([options, fields, &session] { run_solve(*options, fields->given(), session); });
}

}  // namespace rollres
