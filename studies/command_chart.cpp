#include <algorithm>
#include <memory>
#include <ostream>

#include "studies/command_line.hpp"
#include "studies/commands.hpp"
#include "studies/file_name.hpp"
#include "studies/read_filter.hpp"
#include "studies/readable_number.hpp"
#include "studies/study_chart.hpp"

namespace rollres {

namespace {

struct ChartWords {
  std::string database, out;
  std::vector<std::string> filters;
  std::string x_scale = "auto", y_scale = "auto";
  StudyChartWishes wishes;
};

AxisScale scale_named(const std::string& name) {
  return static_cast<AxisScale>(find_name(ChoiceNames<AxisScale>::names, name));
}

/// Beside the database: the study's name, and what is shown if that was asked for.
std::filesystem::path usual_name(const ChartWords& words, const StoredChart& chart) {
  std::string name = chart.study;
  for (const std::string& word : {words.wishes.chart, words.wishes.y, words.wishes.x, words.wishes.family})
    if (!word.empty()) name += "_" + word;
  for (const std::string& filter : words.filters) name += "_" + filter;
  return std::filesystem::path(words.database).parent_path() / (file_name(name) + ".svg");
}

void print_peaks(std::ostream& out, const ChartRequest& request) {
  if (!request.lines) return;
  for (const ChartCurve& curve : request.curves)
    if (const auto place = peak(curve)) {
      const ChartPoint& top = curve.points[*place];
      const auto with_unit = [](double value, const ChartAxis& axis) {
        return short_number(value, 5) + (axis.unit.empty() ? "" : " " + axis.unit);
      };
      out << "peak";
      if (!curve.label.empty())
        out << " of " << (request.family.name.empty() ? "" : request.family.name + " ") << curve.label;
      out << ": " << with_unit(top.y, request.y) << " at " << with_unit(top.x, request.x) << '\n';
    }
}

void draw(const ChartWords& words, ResultStore& store, Session& session) {
  StudyChartWishes wishes = words.wishes;
  for (const std::string& text : words.filters) wishes.filters.push_back(read_filter(text));
  wishes.x_scale = scale_named(words.x_scale);
  wishes.y_scale = scale_named(words.y_scale);
  const StoredChart chart = stored_chart(store, wishes);
  const ChartFiles files =
      draw_chart(chart.request, words.out.empty() ? usual_name(words, chart) : std::filesystem::path(words.out));
  if (chart.unanswered > 0)
    session.err << chart.unanswered << " of " << chart.points << " points have no answer; the chart marks them\n";
  if (chart.missing > 0) session.err << chart.missing << " points of the study are not computed yet\n";
  print_peaks(session.out, chart.request);
  for (const auto& file : {files.svg, files.png, files.script, files.data}) session.out << file.string() << '\n';
}

/// One chart of the study, or all of them; with --out, the name of each of several ends with that of the chart.
void chart(const ChartWords& words, Session& session) {
  ResultStore store(words.database, Access::read);
  if (words.wishes.chart != "all") return draw(words, store, session);
  for (const std::string& name : stored_charts(store, words.wishes.study)) {
    ChartWords one = words;
    one.wishes.chart = name;
    if (!one.out.empty()) {
      const std::filesystem::path script = chart_files(words.out).script;  // its suffix is known
      one.out = (script.parent_path() / (script.stem().string() + "_" + file_name(name) + ".svg")).string();
    }
    draw(one, store, session);
  }
}

}  // namespace

void add_chart(Command& program, Session& session) {
  Command* command = program.add_subcommand("chart", "Draw a stored study as SVG and PNG, through gnuplot");
  const auto words = std::make_shared<ChartWords>();
  StudyChartWishes& wishes = words->wishes;
  command->add_option("--db", words->database, "database")->required();
  command->add_option("--study", wishes.study, "study; may be left out if the database holds one");
  command->add_option("--chart", wishes.chart,
                      "chart of the study file, by its name or its number; all: every one; left out: the first");
  command->add_option("--x", wishes.x,
                      "input or output along x; left out: as the study file says, or its longest axis");
  command->add_option("--y", wishes.y, "output along y; left out: as the study file says, or rolling_resistance");
  command->add_option("--family", wishes.family, "axis with one curve for each value; left out: the other axes");
  command->add_option("--where", words->filters, "show only points with KEY=VALUE, as in query; may be repeated")
      ->one_value_each();
  const std::vector<std::string_view> scales{"auto", "linear", "logarithmic"};
  command->add_option("--x-scale", words->x_scale, "auto: logarithmic if the study spaced it so or over two decades")
      ->one_of(scales);
  command->add_option("--y-scale", words->y_scale, "auto, linear or logarithmic")->one_of(scales);
  command->add_option("--out", words->out, "name of the files, with or without suffix; left out: beside the database");
  command->footer(
      "The script (.gp) and the data (.dat) stay beside the pictures: change the script and run gnuplot on it.\n"
      "Examples: rollres chart --db results.db --study speed_resistance --x speed --y rolling_resistance --family "
      "load\n"
      "          rollres chart --db results.db --chart all");
  command->callback([words, &session] { chart(*words, session); });
}

}  // namespace rollres
