#include <array>
#include <ostream>
#include <stdexcept>

#include "core/derivatives/objective.hpp"
#include "studies/charts/stored_line.hpp"
#include "studies/figures/characteristic.hpp"
#include "studies/figures/film.hpp"
#include "studies/program/commands.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// Of whatever is drawn along an axis of a stored study.
struct LineArguments {
  std::string database, study, axis, out;
  std::vector<std::string> filters;

  StudyChartOptions options() const {
    StudyChartOptions options{.study = study};
    for (const std::string& text : filters) options.filters.push_back(read_filter(text));
    return options;
  }
  /// Name of the files: as wished, else that of the study with an ending, beside the database.
  std::filesystem::path name(const ShownStudy& shown, const std::string& ending) const {
    if (!out.empty()) return out;
    return std::filesystem::path(database).replace_filename(file_name(shown.study.name) + ending);
  }
};

struct FilmArguments : LineArguments {
  std::string y = "rolling_resistance";
  double seconds = 0.25;
};

/// @throws std::invalid_argument if the line has less than two points
void require_two_points(const ShownStudy& shown, const StoredLine& line, const std::string& picture) {
  if (line.points.size() < 2)
    throw std::invalid_argument(shown.study.name + ": " + picture + " needs two points with an answer, there " +
                                (line.points.empty() ? "is none" : "is one"));
}

void film(const FilmArguments& arguments, Session& session) {
  const StudyChartOptions options = arguments.options();
  ResultStore store(arguments.database, Access::read);
  const ShownStudy shown(store, options);
  const StudyRows& rows = shown.rows;
  const StoredLine line = stored_line(store, shown, options.filters, arguments.axis, "a film", session.evaluate);
  session.err << line.remarks();
  require_two_points(shown, line, "a film");
  const QuantityColumn& output = number_column(arguments.y, shown.study, rows, "--y");
  const ColumnScale x = scale_of(rows, *line.axis, AxisScale::automatic, false, "--axis"),
                    y = scale_of(rows, output, AxisScale::automatic, false, "--y");
  FilmRequest request{.title = shown.title(),
                      .subtitle = filters_in_words(options.filters, rows),
                      .x = scaled_axis(*line.axis, x),
                      .y = scaled_axis(output, y),
                      .frames = {},
                      .seconds = arguments.seconds};
  const Quantity& along = line.axis->quantity;
  for (const StoredEvaluation& one : line.points) {
    const double place = real_input(one.scene, along.key);
    request.frames.push_back(
        {.words = in_words(along.key) + " " + value_in_words(along, place, unit_in(rows, *line.axis)),
         .point = {x.unit.number(place), y.unit.number(output_number(one.solution, output.quantity.key))},
         .scene = one.scene,
         .solution = one.solution});
  }
  const FilmFiles files = draw_film(request, arguments.name(shown, "_film"));
  for (const auto& file : {files.film, files.script, files.data}) session.out << file.string() << '\n';
}

/// What forces, moment and slip depend on: skew, creepage, camber, pivot, and what stands in their place.
constexpr std::array<std::string_view, 7> turning_axes{"skew_angle",  "rotation_ratio", "camber_angle",  "pivot",
                                                       "axial_force", "lateral_force",  "driving_torque"};

void characteristic(const LineArguments& arguments, Session& session) {
  const StudyChartOptions options = arguments.options();
  ResultStore store(arguments.database, Access::read);
  const ShownStudy shown(store, options);
  const StoredLine line =
      stored_line(store, shown, options.filters, arguments.axis, "a characteristic", session.evaluate, turning_axes);
  session.err << line.remarks();
  require_two_points(shown, line, "a characteristic");
  const ColumnScale x = scale_of(shown.rows, *line.axis, AxisScale::automatic, false, "--axis");
  CharacteristicRequest request{.title = shown.title(),
                                .subtitle = subtitle_of(options.filters, shown.rows),
                                .x = scaled_axis(*line.axis, x),
                                .points = {}};
  for (const StoredEvaluation& one : line.points)
    request.points.push_back({x.unit.number(real_input(one.scene, line.axis->quantity.key)), one.scene, one.solution});
  const ChartFiles files = draw_characteristic(request, arguments.name(shown, "_characteristic"));
  for (const auto& file : {files.svg, files.png, files.script, files.data}) session.out << file.string() << '\n';
}

/// @param picture  "a film"   @param ending  of the files' usual name
void add_line_options(Command& command, LineArguments& arguments, const std::string& picture, const std::string& ending,
                      const std::string& of = {}) {
  command.add_option("--db FILE", arguments.database, "database")->or_usual_database();
  command.add_option("--study NAME", arguments.study, "study; may be left out if the database holds one");
  command.add_option("--axis KEY", arguments.axis, "axis along which " + picture + " goes; left out: the longest" + of);
  command
      .add_option("--where FILTER", arguments.filters, "show only points with KEY=VALUE, as in query; may be repeated")
      ->one_value_each();
  command.add_option("--out PATH", arguments.out,
                     "name of the files, with or without suffix; left out: STUDY" + ending + " beside the database");
}

}  // namespace

void add_film(Command& program, Session& session) {
  const auto [command, arguments] = program.add<FilmArguments>(
      "film", "Draw a stored study as a film: stick, slip and tractions along an axis, in one GIF", session, film);
  add_line_options(*command, arguments, "the film", "_film");
  command->add_option("--y KEY", arguments.y, "output of the chart below the pictures; default: rolling_resistance");
  command->add_option("--seconds SECONDS", arguments.seconds, "how long each point is shown; default: 0.25")
      ->positive();
  command->footer(
      "Points whose fields are not stored are solved again. Script (.gp) and data (.dat) stay beside the film.\n"
      "Example: rollres film --db out/speed_resistance.db --where 'load=20 kN/m' --out out/film");
}

void add_characteristic(Command& program, Session& session) {
  const auto [command, arguments] = program.add<LineArguments>(
      "characteristic", "Draw forces, moment and slip regions of a stored study along skew, creepage, camber or pivot",
      session, characteristic);
  add_line_options(*command, arguments, "the characteristic", "_characteristic", " of such axes");
  command->footer(
      "Points whose fields are not stored are solved again. Script (.gp) and data (.dat) stay beside the pictures.\n"
      "Example: rollres characteristic --db out/castor.db --out out/castor");
}

}  // namespace rollres
