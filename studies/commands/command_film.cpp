#include <algorithm>
#include <ostream>
#include <stdexcept>

#include "core/derivatives/objective.hpp"
#include "studies/charts/study_chart.hpp"
#include "studies/figures/film.hpp"
#include "studies/program/commands.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct FilmArguments {
  std::string database, study, axis, y = "rolling_resistance", out;
  std::vector<std::string> filters;
  double seconds = 0.25;
};

/// The axis along which the film goes: as wished, else the one with the most values.
const QuantityColumn& film_axis(const FilmArguments& arguments, const ShownStudy& shown) {
  const auto count = [&](const std::string& key) {
    return shown.rows.values(column_of(key, shown.study, shown.rows, "--axis")).size();
  };
  std::string key = arguments.axis;
  for (const std::string& one : shown.study.axes)
    if (arguments.axis.empty() && (key.empty() || count(one) > count(key))) key = one;
  if (key.empty()) throw std::invalid_argument(shown.study.name + ": has no axis along which a film could go");
  return number_column(key, shown.study, shown.rows, "--axis");
}

/// @throws std::invalid_argument if another axis has several values, too
void require_one_line(const ShownStudy& shown, const QuantityColumn& axis) {
  for (const std::string& key : shown.study.axes) {
    const QuantityColumn& other = column_of(key, shown.study, shown.rows, "--axis");
    const std::set<Cell> values = shown.rows.values(other);
    if (&other == &axis || values.size() < 2) continue;
    if (shown.rows.size() == shown.rows.values(axis).size()) continue;  // varies along
    throw std::invalid_argument(shown.study.name + ": " + key + " has " + std::to_string(values.size()) +
                                " values; a film shows one, choose it with --where " +
                                shell_word(key + "=" + value_in_words(*values.begin(), unit_in(shown.rows, other))));
  }
}

/// The stored answers of the rows that are shown, in the order of the axis.
std::vector<StoredEvaluation> answers(ResultStore& store, const ShownStudy& shown, std::vector<Filter> filters,
                                      std::string_view axis) {
  filters.push_back({"study", Comparison::equal, shown.study.name});
  const Table ids = run_query(store.database(), {.filters = filters, .columns = {"id"}});
  std::vector<StoredEvaluation> found;
  for (const auto& row : ids.rows)
    if (auto one = store.find(std::get<std::int64_t>(row.front())); one && one->solution.status == Status::converged)
      found.push_back(std::move(*one));
  const auto place = [&](const StoredEvaluation& one) { return real_input(one.scene, axis); };
  std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  return found;
}

void film(const FilmArguments& arguments, Session& session) {
  StudyChartOptions options{.study = arguments.study};
  for (const std::string& text : arguments.filters) options.filters.push_back(read_filter(text));
  ResultStore store(arguments.database, Access::read);
  const ShownStudy shown(store, options);
  const StudyRows& rows = shown.rows;
  const QuantityColumn& axis = film_axis(arguments, shown);
  const QuantityColumn& output = number_column(arguments.y, shown.study, rows, "--y");
  require_one_line(shown, axis);
  const ColumnScale x = scale_of(rows, axis, AxisScale::automatic, false, "--axis"),
                    y = scale_of(rows, output, AxisScale::automatic, false, "--y");
  FilmRequest request{.title = shown.title(),
                      .subtitle = filters_in_words(options.filters, rows),
                      .x = scaled_axis(axis, x),
                      .y = scaled_axis(output, y),
                      .frames = {},
                      .seconds = arguments.seconds};
  const std::string_view key = axis.quantity.key;
  std::size_t solved = 0, left_out = shown.unanswered();
  for (StoredEvaluation& one : answers(store, shown, options.filters, key)) {
    const double place = real_input(one.scene, key);
    const double value = output_number(one.solution, output.quantity.key);
    if (auto fields = store.find_fields(evaluation_key(one.scene))) {
      one.solution.fields = std::move(*fields);
    } else {
      ++solved;
      one.solution = session.evaluate(one.scene);
    }
    if (one.solution.status != Status::converged || one.solution.fields.grid.size() == 0) {
      ++left_out;
      continue;
    }
    request.frames.push_back({.words = in_words(key) + " " + value_in_words(axis.quantity, place, unit_in(rows, axis)),
                              .point = {x.unit.number(place), y.unit.number(value)},
                              .scene = one.scene,
                              .solution = std::move(one.solution)});
  }
  if (solved > 0)
    session.err << solved << " scenes were solved again: their fields are not stored (rollres sweep STUDY --fields)\n";
  if (left_out > 0) session.err << left_out << " points have no answer and are left out\n";
  if (request.frames.size() < 2)
    throw std::invalid_argument(shown.study.name + ": a film needs two points with an answer, there " +
                                (request.frames.empty() ? "is none" : "is one"));
  std::filesystem::path name = arguments.out;
  if (arguments.out.empty())
    name = std::filesystem::path(arguments.database).replace_filename(file_name(shown.study.name) + "_film");
  const FilmFiles files = draw_film(request, name);
  for (const auto& file : {files.film, files.script, files.data}) session.out << file.string() << '\n';
}

}  // namespace

void add_film(Command& program, Session& session) {
  const auto [command, arguments] = program.add<FilmArguments>(
      "film", "Draw a stored study as a film: stick, slip and tractions along an axis, in one GIF", session, film);
  command->add_option("--db FILE", arguments.database, "database")->or_usual_database();
  command->add_option("--study NAME", arguments.study, "study; may be left out if the database holds one");
  command->add_option("--axis KEY", arguments.axis, "axis along which the film goes; left out: the longest");
  command->add_option("--y KEY", arguments.y, "output of the chart below the pictures; default: rolling_resistance");
  command
      ->add_option("--where FILTER", arguments.filters, "show only points with KEY=VALUE, as in query; may be repeated")
      ->one_value_each();
  command->add_option("--seconds SECONDS", arguments.seconds, "how long each point is shown; default: 0.25")
      ->positive();
  command->add_option("--out PATH", arguments.out,
                      "name of the files, with or without suffix; left out: STUDY_film beside the database");
  command->footer(
      "Points whose fields are not stored are solved again. Script (.gp) and data (.dat) stay beside the film.\n"
      "Example: rollres film --db out/speed_resistance.db --where 'load=20 kN/m' --out out/film");
}

}  // namespace rollres
