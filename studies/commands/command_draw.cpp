#include <algorithm>
#include <ostream>

#include "core/derivatives/objective.hpp"
#include "studies/figures/scene_sketch.hpp"
#include "studies/program/commands.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

struct DrawArguments {
  std::string scene, out;
  std::vector<std::string> overrides;
};

/// "paper cylinder: R_r = 357.5 N/m"
std::string title_of(const std::string& file, const RollingScene& scene, const RollingSolution& solution) {
  std::string name = std::filesystem::path(file).stem().string();
  std::replace(name.begin(), name.end(), '_', ' ');
  if (solution.status != Status::converged) return name + ": no answer";
  return name + ": rolling resistance " +
         readable(solution.rolling_resistance, real_output("rolling_resistance").unit_for(body_of(scene)));
}

void draw_scene(const DrawArguments& arguments, Session& session) {
  const RollingScene scene = read_scene(arguments.scene, arguments.overrides);
  std::filesystem::path name = arguments.out;
  if (arguments.out.empty()) name = std::filesystem::path(arguments.scene).stem().string() + "_sketch.svg";
  const ChartFiles files = chart_files(name);
  const RollingSolution solution = session.evaluate(scene);
  if (solution.status != Status::converged) {
    session.err << "rollres: " << arguments.scene << ": the body is drawn as it touches: " << name_of(solution.status)
                << (solution.reason.empty() ? "" : ", ") << solution.reason << '\n';
    session.status = ExitStatus::no_answer;
  }
  const std::string title = title_of(arguments.scene, scene, solution);
  const PictureText text = scene_sketch(scene, solution, title, files);
  draw_pictures(files, text.data, text.script, {title, sketch_in_words(scene)});
  for (const auto& file : {files.svg, files.png, files.script, files.data}) session.out << file.string() << '\n';
}

}  // namespace

void add_draw(Command& program, Session& session) {
  const auto [command, arguments] = program.add<DrawArguments>(
      "draw", "Draw a scene to scale: body, layers, load, speed and drive, stick and slip", session, draw_scene);
  command->add_option("scene SCENE", arguments.scene, "scene file (JSON)")->required();
  command->add_option("--set KEY=VALUE", arguments.overrides, "replace an input, in SI or with a unit; may be repeated")
      ->one_value_each();
  command->add_option("--out PATH", arguments.out,
                      "name of the files, with or without suffix; left out: SCENE_sketch in this folder");
  command->footer(
      "The approach and the contact are those of the solution; the dent beyond the contact is sketched.\n"
      "Example: rollres draw studies/examples/paper_cylinder.json --set load=\"10 kN/m\" --out out/cylinder.svg");
}

}  // namespace rollres
