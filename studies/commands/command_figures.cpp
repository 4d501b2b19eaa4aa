#include <algorithm>
#include <ostream>
#include <stdexcept>

#include "core/scene/scene_input.hpp"
#include "core/solve/strain_iteration.hpp"
#include "studies/figures/figure.hpp"
#include "studies/program/commands.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/scene_io/fields_file.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/text/files.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/words.hpp"
#include "studies/text/xml_text.hpp"

namespace rollres {

namespace {

/// A point of a collection.
struct TimedFile {
  double time;
  std::string file;
};
/// By the values of the other axes: "_load=20 kN/m".
using TimedFiles = std::map<std::string, std::vector<TimedFile>>;

std::string chosen_axis(const StudyOutline& study, const std::string& wish) {
  if (wish.empty()) return study.axes.empty() ? "" : study.axes.front();
  if (contains(study.axes, wish)) return wish;
  throw std::invalid_argument("--axis = " + wish + ": " + unknown("is no axis of " + study.name, study.axes, wish));
}

std::string unit_of_input(std::string_view key, const RollingScene& scene) {
  std::string unit;
  visit_input(scene, key, [&](const Quantity& quantity, const auto&) { unit = quantity.unit_for(body_of(scene)); });
  return unit;
}

/// Times of the values of an axis; names are counted in the order in which they come.
class AxisTimes {
 public:
  double operator()(const Cell& cell) {
    if (const auto number = number_in(cell)) return *number;
    const std::string name = value_in_words(cell, "");
    const auto found = std::find(names_.begin(), names_.end(), name);
    const auto place = found - names_.begin();
    if (found == names_.end()) names_.push_back(name);
    return static_cast<double>(place);
  }

 private:
  std::vector<std::string> names_;
};

std::string collection_text(const std::vector<TimedFile>& files) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const TimedFile& file : files)
    text += "<DataSet timestep=\"" + shortest(file.time) + "\" part=\"0\" file=\"" + xml_text(file.file) + "\"/>\n";
  return text + "</Collection>\n</VTKFile>\n";
}

struct FieldCollections {
  std::string axis;                          ///< whose value is the time
  std::vector<std::filesystem::path> files;  ///< the collections
  std::size_t points = 0;                    ///< in them
  std::size_t without_fields = 0;            ///< answered points whose fields are not stored
};

/// Writes STUDY/0001.vti, ... (the surface around the contact, one file for each point with fields) and STUDY.pvd, a
/// VTK collection in the order of the axis; with several axes one collection for each combination of the others,
/// STUDY_load=20_kN_m.pvd. Where that leaves one point to each (a sample, axes that vary together) there is one for
/// all. The time of an axis of names is their place, counted from 0.
/// @param axis a key of the study's axes; empty: the first
/// @throws std::invalid_argument if the study has no such axis
/// @throws std::runtime_error naming the file or folder that failed
FieldCollections write_field_collections(ResultStore& store, const StudyOutline& study, const std::string& axis,
                                         const std::filesystem::path& directory) {
  FieldCollections written;
  written.axis = chosen_axis(study, axis);
  const std::string base = file_name(study.name);
  TimedFiles collections;
  AxisTimes times;
  std::size_t position = 0;
  for (const std::string& key : store.points(study.name)) {
    ++position;
    std::optional<StoredEvaluation> answer = store.find(key);
    if (!answer || answer->solution.status != Status::converged) continue;
    std::optional<SurfaceFields> fields = store.find_fields(key);
    if (!fields) {
      ++written.without_fields;
      continue;
    }
    if (written.points == 0) make_directory(directory / base);
    answer->solution.fields = std::move(*fields);
    std::string number = std::to_string(position);
    number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');
    const std::string file = base + "/" + number + ".vti";
    // Around the contact, but for moduli at strains that are not stored.
    const SurfaceFields shown = softens(answer->scene) ? answer->solution.fields
                                                       : surface_around(answer->scene, answer->solution, figure_margin);
    write_file(directory / file, fields_vti(answer->scene, shown, answer->solution));
    std::string others;
    for (const std::string& other : study.axes)
      if (other != written.axis)
        others +=
            "_" + other + "=" + value_in_words(input_of(answer->scene, other), unit_of_input(other, answer->scene));
    const double time =
        written.axis.empty() ? static_cast<double>(position) : times(input_of(answer->scene, written.axis));
    collections[others].push_back({time, file});
    ++written.points;
  }
  if (collections.size() == written.points && written.points > 1) {
    TimedFiles all;
    for (const auto& [others, files] : collections) all[""].push_back(files.front());
    collections = std::move(all);
  }
  for (auto& [others, files] : collections) {
    stable_sort(files, [](const auto& a, const auto& b) { return a.time < b.time; });
    const std::string name = file_name(study.name + others);
    std::filesystem::path file = directory / (name + ".pvd");
    for (int again = 2; contains(written.files, file); ++again)
      file = directory / (name + "_" + std::to_string(again) + ".pvd");  // names that had to be cut
    written.files.push_back(file);
    write_file(written.files.back(), collection_text(files));
  }
  return written;
}

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
  write_fields(arguments.out, scene, source.surface, solution);
  session.out << (std::filesystem::path(arguments.out) / "fields.vti").string() << std::endl;
  for (const Figure& figure : figures)
    session.out << draw_figure(figure, source, arguments.out).svg.string() << std::endl;
}

void collect_fields(const FigureArguments& arguments, Session& session) {
  ResultStore store(arguments.database, Access::read);
  const StudyOutline study = stored_outline(store, arguments.study);
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
  command->add_option("scene SCENE", arguments.scene, "scene file (JSON)");
  command->add_option("--out DIR", arguments.out, "folder; made if it is missing")->required();
  command->add_option("--set KEY=VALUE", arguments.overrides, "replace an input, in SI or with a unit; may be repeated")
      ->one_value_each();
  std::string list = "Only this one, by its number in the paper or its name; may be repeated:";
  for (const Figure& figure : all_figures())
    list += (figure.number == all_figures().front().number ? " " : ", ") + std::to_string(figure.number) + " " +
            std::string(figure.name);
  command->add_option("--figure FIGURE", arguments.figures, list)->one_value_each();
  command->add_option("--db FILE", arguments.database,
                      "database: the stored fields of a study as VTK files and a collection");
  command->add_option("--study NAME", arguments.study, "study; may be left out if the database holds one");
  command->add_option("--axis KEY", arguments.axis, "axis whose value is the collection's time; left out: the first");
  command->footer(
      "Pictures as SVG and PNG; beside each stand its script (.gp) and data (.dat): change the script and run gnuplot "
      "on it.\nfields.csv and fields.vti hold the fields of the whole window.\n"
      "Examples: rollres figures studies/examples/paper_sphere.json --out out/sphere\n"
      "          rollres figures --db results.db --study speed_resistance --axis speed --out out/film");
}

}  // namespace rollres
