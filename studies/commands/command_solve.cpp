#include <ostream>
#include <stdexcept>

#include "studies/evidence/simpler_models.hpp"
#include "studies/program/commands.hpp"
#include "studies/scene_io/fields_file.hpp"
#include "studies/scene_io/interior_file.hpp"
#include "studies/scene_io/model_text.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/scene_io/summary.hpp"
#include "studies/text/files.hpp"

namespace rollres {

namespace {

struct SolveArguments {
  std::string scene;
  std::vector<std::string> overrides;
  bool json = false, explain = false;
  std::optional<std::string> fields;
};

void run_solve(const SolveArguments& options, Session& session) {
  const RollingScene scene = read_scene(options.scene, options.overrides);
  if (options.fields && options.fields->empty()) throw std::invalid_argument("--fields = \"\": must name a directory");
  if (options.fields) make_directory(*options.fields);  // before the work, not after it

  if (options.explain && !options.json) session.out << model_text(scene) << std::flush;
  const RollingSolution solution = session.evaluate(scene);
  session.out << (options.json ? solution_json(scene, solution) + '\n' : summary(scene, solution));
  if (options.explain && !options.json) {
    session.out << explanation(scene, solution);
    if (solution.status == Status::converged && has_interior(scene, solution))
      session.out << interior_text(inside_of_answer(ContactModel(scene), solution), scene);
    // Simpler models have the moduli of small strains.
    if (solution.status == Status::converged && solution.moduli_factors.empty())
      session.out << simpler_models_text(scene, solution, simpler_models(scene, solution, session.evaluate));
  }
  session.out << std::flush;
  if (solution.status != Status::converged) session.status = ExitStatus::no_answer;
  if (!options.fields) return;
  if (solution.fields.grid.size() == 0) {
    session.err << "rollres: " << *options.fields << ": nothing written, the solution has no fields\n";
    return;
  }
  write_fields(*options.fields, scene, solution.fields, solution);
  if (has_interior(scene, solution)) write_interior(*options.fields, scene, solution);
}

}  // namespace

void add_solve(Command& program, Session& session) {
  const auto [command, arguments] =
      program.add<SolveArguments>("solve", "Solve one scene and print its rolling resistance", session, run_solve);
  command->add_option("scene SCENE", arguments.scene, "scene file (JSON)")->required();
  command->add_option("--set KEY=VALUE", arguments.overrides, "replace an input, in SI or with a unit; may be repeated")
      ->one_value_each();
  command->add_flag("--json", arguments.json, "print one JSON object");
  command->add_flag(
      "--explain", arguments.explain,
      "print the model first; after the answer what each assumption costs, and what simpler models answer");
  command->add_option(
      "--fields DIR", arguments.fields,
      "write the surface's fields to DIR/fields.csv and .vti, those inside the layers to inside.csv and .vtr, "
      "losses.csv and bonds.csv, of a sphere's surface and bonds to faces.csv and face_0.vtr, ...");
  command->footer("Example: rollres solve studies/examples/paper_cylinder.json --set speed=\"36 km/h\" --fields out");
}

}  // namespace rollres
