#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>
#include <stdexcept>

#include "studies/commands.hpp"
#include "studies/fields_file.hpp"
#include "studies/figure.hpp"
#include "studies/scene_file.hpp"
#include "studies/write_file.hpp"

namespace rollres {

void add_figures(CLI::App& program, Session& session);

namespace {

struct FigureWords {
  std::string scene, out;
  std::vector<std::string> overrides, figures;
};

void draw_figures(const FigureWords& words, Session& session) {
  if (words.out.empty()) throw std::invalid_argument("--out = \"\": must name a directory");
  const RollingScene scene = read_scene(words.scene, words.overrides);
  const std::vector<Figure> figures = figures_for(scene, words.figures);
  make_directory(words.out);  // before the work, not after it
  const RollingSolution solution = session.evaluate(scene);
  if (solution.status != Status::converged) {
    session.err << "rollres: " << words.scene
                << ": nothing drawn, the scene has no answer: " << name_of(solution.status) << ", " << solution.reason
                << '\n';
    session.status = ExitStatus::no_answer;
    return;
  }
  const FigureSource source(scene, solution);
  write_fields(words.out, scene, source.surface);
  for (const Figure& figure : figures) session.out << draw_figure(figure, source, words.out).svg.string() << std::endl;
}

}  // namespace

void add_figures(CLI::App& program, Session& session) {
  CLI::App* const command = program.add_subcommand("figures", "Draw the paper's figures of a scene, as SVG and PNG");
  const auto words = std::make_shared<FigureWords>();
  command->add_option("scene", words->scene, "Scene file (JSON)")->required()->option_text("SCENE");
  command->add_option("--out", words->out, "Directory; made if it is missing")->required()->option_text("DIR");
  command->add_option("--set", words->overrides, "Replace an input, in SI or with a unit; may be repeated")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--figure", words->figures, "Only this one, by number or name; may be repeated")
      ->option_text("FIGURE")
      ->allow_extra_args(false);
  command->callback([words, &session] { draw_figures(*words, session); });
}

}  // namespace rollres
