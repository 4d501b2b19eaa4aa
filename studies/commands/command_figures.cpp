#include <ostream>
#include <stdexcept>

#include "studies/figures/field_collection.hpp"
#include "studies/figures/figure.hpp"
#include "studies/program/commands.hpp"
#include "studies/scene_io/fields_file.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/text/files.hpp"

namespace rollres {

namespace {

struct FigureArguments {
  std::string scene, out;
  std::vector<std::string> overrides, figures;
  std::string database, study, axis;
};

void draw_figures(const FigureArguments& arguments, Session& session) {
  const RollingScene scene = read_scene(arguments.scene, arguments.overrides);
  const std::vector<Figure> figures = figures_for(scene, arguments.figures);
  make_directory(arguments.out);  // before the work, not after it
  const RollingSolution solution = session.evaluate(scene);
  if (solution.status != Status::converged) {
    session.err << "rollres: " << arguments.scene << ": nothing drawn: " << name_of(solution.status)
                << (solution.reason.empty() ? "" : ", ") << solution.reason << '\n';
    session.status = ExitStatus::no_answer;
    return;
  }
  if (solution.fields.grid.size() == 0) {
    session.err << "rollres: " << arguments.out << ": nothing drawn, the solution has no fields\n";
    return;
  }
  const FigureSource source(scene, solution);
  write_fields(arguments.out, scene, source.surface);
  session.out << (std::filesystem::path(arguments.out) / "fields.vti").string() << std::endl;
  for (const Figure& figure : figures)
    session.out << draw_figure(figure, source, arguments.out).svg.string() << std::endl;
}

void collect_fields(const FigureArguments& arguments, Session& session) {
  ResultStore store(arguments.database, Access::read);
  const StudySummary study = stored_study(store, arguments.study);
  const FieldCollections written = write_field_collections(store, study, arguments.axis, arguments.out);
  if (written.without_fields > 0)
    session.err << "rollres: " << arguments.database << ": " << study.name << ": " << written.without_fields
                << " points have no stored fields; rollres sweep STUDY --fields stores them\n";
  if (written.points == 0) session.status = ExitStatus::no_answer;
  for (const auto& file : written.files) session.out << file.string() << '\n';
}

/// Refuses an option that says nothing about what is drawn.
void require_unused(bool used, const char* option, const char* needs) {
  if (used) throw std::invalid_argument(std::string(option) + ": needs " + needs);
}

void figures(const FigureArguments& arguments, Session& session) {
  if (arguments.out.empty()) throw std::invalid_argument("--out = \"\": must name a directory");
  if (arguments.scene.empty() == arguments.database.empty())
    throw std::invalid_argument("give either a scene file, or --db with the study whose fields are wanted");
  if (!arguments.database.empty()) {
    require_unused(!arguments.overrides.empty(), "--set", "a scene file, not --db");
    require_unused(!arguments.figures.empty(), "--figure", "a scene file, not --db");
    return collect_fields(arguments, session);
  }
  require_unused(!arguments.study.empty(), "--study", "--db");
  require_unused(!arguments.axis.empty(), "--axis", "--db");
  draw_figures(arguments, session);
}

}  // namespace

void add_figures(Command& program, Session& session) {
  const auto [command, arguments] = program.add<FigureArguments>(
      "figures", "Draw the fields of a solution: the paper's figures, and files for ParaView", session, figures);
  command->add_option("scene SCENE", arguments.scene, "Scene file (JSON)");
  command->add_option("--out DIR", arguments.out, "Directory; made if it is missing")->required();
  command->add_option("--set KEY=VALUE", arguments.overrides, "Replace an input, in SI or with a unit; may be repeated")
      ->one_value_each();
  std::string list = "Only this one, by its number in the paper or its name; may be repeated:";
  for (const Figure& figure : all_figures())
    list += (figure.number == all_figures().front().number ? " " : ", ") + std::to_string(figure.number) + " " +
            std::string(figure.name);
  command->add_option("--figure FIGURE", arguments.figures, list)->one_value_each();
  command->add_option("--db FILE", arguments.database,
                      "Database: the stored fields of a study as VTK files and a collection");
  command->add_option("--study NAME", arguments.study, "Study; may be left out if the database holds one");
  command->add_option("--axis KEY", arguments.axis, "Axis whose value is the collection's time; left out: the first");
  command->footer(
      "Pictures as SVG and PNG; beside each stand its script (.gp) and data (.dat): change the script and run gnuplot "
      "on it.\nfields.csv and fields.vti hold the fields of the whole window.\n"
      "Examples: rollres figures studies/examples/paper_sphere.json --out out/sphere\n"
      "          rollres figures --db results.db --study speed_resistance --axis speed --out out/film");
}

}  // namespace rollres
