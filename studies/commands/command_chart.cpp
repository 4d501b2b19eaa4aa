#include <ostream>
#include <stdexcept>

#include "db/merge/gathered.hpp"
#include "db/rows/fit_store.hpp"
#include "studies/charts/study_chart.hpp"
#include "studies/drawing/peak_values.hpp"
#include "studies/program/commands.hpp"
#include "studies/stored_fits/fit_chart.hpp"
#include "studies/stored_fits/stored_fit.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct ChartArguments {
  std::string out, fit;
  std::vector<std::string> databases, studies, filters;
  std::string x_scale = "auto", y_scale = "auto", map_scale = "auto";
  StudyChartOptions options;
};

AxisScale scale_named(const std::string& name) {
  return static_cast<AxisScale>(find_name(ChoiceNames<AxisScale>::names, name));
}

/// The wished name; without one beside the database: the study's name, and what is shown if that was asked for.
std::filesystem::path name_of_files(const ChartArguments& arguments, const std::string& study) {
  if (!arguments.out.empty()) return arguments.out;
  const StudyChartOptions& options = arguments.options;
  std::string name = study;
  if (options.shares) name += "_shares";
  if (!options.map.empty()) name += "_map_" + options.map;
  for (const std::string& word : {options.chart, options.y, options.x, options.family})
    if (!word.empty()) name += "_" + word;
  for (const std::string& filter : arguments.filters) name += "_" + filter;
  return std::filesystem::path(arguments.databases.front()).parent_path() / (file_name(name) + ".svg");
}

std::string with_unit(double value, const ChartAxis& axis) {
  return short_number(value, 5) + (axis.unit.empty() ? "" : " " + axis.unit);
}

void print_peaks(std::ostream& out, const ChartRequest& request) {
  if (!request.lines || !request.mark_peaks) return;
  const ChartSpans spans = chart_spans(request);
  const auto told = [](const std::string& value, const ChartAxis& axis) {
    return value + (axis.unit.empty() ? "" : " " + axis.unit);
  };
  for (const ChartCurve& curve : request.curves)
    if (const auto top = curve_peak(curve, spans)) {
      out << "peak";
      if (!curve.label.empty())
        out << " of " << (request.family.name.empty() ? "" : request.family.name + " ") << curve.label;
      out << ": " << told(top->y_text(), request.y) << " at " << told(top->x_text(), request.x) << '\n';
    }
}

void print_peaks(std::ostream& out, const MapRequest& request) {
  const auto named = [](double value, const ChartAxis& axis) { return axis.name + " " + with_unit(value, axis); };
  const PlaneField& field = request.field;
  if (const auto place = map_peak(request))
    out << "largest of the points: " << named(field.values[*place], request.value) << " at "
        << named(field.x[*place % field.x.size()], request.x) << ", "
        << named(field.y[*place / field.x.size()], request.y) << '\n';
  if (request.optimum)
    out << request.optimum_meaning << ": at " << named(request.optimum->x, request.x) << ", "
        << named(request.optimum->y, request.y) << '\n';
}

/// What came of a chart or a map.
template <class Picture>
void print(const Picture& picture, const ChartFiles& files, Session& session) {
  if (picture.unanswered > 0)
    session.err << picture.unanswered << " of " << picture.points << " points have no answer; the chart marks them\n";
  if (picture.missing > 0) session.err << picture.missing << " points of the study are not computed yet\n";
  print_peaks(session.out, picture.request);
  for (const auto& file : {files.svg, files.png, files.script, files.data}) session.out << file.string() << '\n';
}

void draw_map(const ChartArguments& arguments, ResultStore& store, Session& session) {
  const StudyChartOptions& options = arguments.options;
  for (const auto& [option, word] : {std::pair("--chart", options.chart), std::pair("--family", options.family)})
    if (!word.empty())
      throw std::invalid_argument(std::string(option) + " = " + word + ": is for curves, not for a map");
  if (options.shares) throw std::invalid_argument("--shares: is for curves, not for a map");
  const StoredMap map = stored_map(store, options);
  print(map, draw_map(map.request, name_of_files(arguments, map.study)), session);
}

/// One chart of the study. One of its file may be a map, unless other axes are wished for.
void draw(ChartArguments arguments, ResultStore& store, Session& session) {
  StudyChartOptions& options = arguments.options;
  const StudyChart in_file = chart_of_file(store, options.study, options.chart);
  if (in_file.map.empty() || options.shares || !(options.x + options.y + options.family).empty()) {
    const StoredChart chart = stored_chart(store, options);
    return print(chart, draw_chart(chart.request, name_of_files(arguments, chart.study)), session);
  }
  arguments.out = name_of_files(arguments, stored_study_name(store, options.study)).string();
  options.map = in_file.map;
  options.x = in_file.x;
  options.y = in_file.y;
  options.chart.clear();
  draw_map(arguments, store, session);
}

/// The name of the fit that is meant: one of a study's name is meant by --fit alone.
std::string fit_meant(const ChartArguments& arguments, ResultStore& store) {
  if (!arguments.fit.empty()) return arguments.fit;
  const auto fit = meant_fit(store, arguments.studies.empty() ? "" : arguments.studies.front(), FitParts::without_data);
  return fit ? fit->name : "";
}

void refuse_for_a_fit(const ChartArguments& arguments) {
  const StudyChartOptions& options = arguments.options;
  std::string filters;
  for (const std::string& filter : arguments.filters) filters += filter;
  for (const auto& [option, word] :
       {std::pair("--x", options.x), std::pair("--y", options.y), std::pair("--family", options.family),
        std::pair("--map", options.map), std::pair("--optimum", options.optimum), std::pair("--where", filters)})
    if (!word.empty())
      throw std::invalid_argument(std::string(option) + " = " + word + ": is for studies, not for a fit");
  if (options.shares) throw std::invalid_argument("--shares: is for studies, not for a fit");
  if (arguments.studies.size() > 1 || (!arguments.fit.empty() && !arguments.studies.empty()))
    throw std::invalid_argument("--study = " + arguments.studies.back() + ": a fit is drawn alone");
}

/// One chart of a fit, or all of them.
void draw_fit(const ChartArguments& arguments, const std::string& name, ResultStore& store, Session& session) {
  refuse_for_a_fit(arguments);
  const std::optional<FitRecord> fit = find_fit(store.database(), name, FitParts::with_data);
  if (!fit) refuse_fit(store.database(), name, arguments.databases.front() + ": --fit = ");
  const std::vector<FitChart> charts = fit_charts(*fit);
  if (charts.empty()) throw std::invalid_argument(name + ": this fit has no answer that could be drawn");
  const std::string& wanted = arguments.options.chart;
  const bool all = wanted.empty() || wanted == "all";
  const std::filesystem::path usual =
      std::filesystem::path(arguments.databases.front()).parent_path() / (file_name(name) + ".svg");
  bool any = false;
  for (const FitChart& chart : charts) {
    if (!all && chart.name != wanted) continue;
    any = true;
    const std::filesystem::path out = arguments.out.empty() ? usual : std::filesystem::path(arguments.out);
    const bool named = !all && !arguments.out.empty();
    session.out << draw_chart(chart.request, named ? out : one_of_several(out, chart.name)).svg.string() << ": "
                << chart.meaning << '\n';
  }
  if (any) return;
  std::vector<std::string_view> names{"all"};
  for (const FitChart& chart : charts) names.push_back(chart.name);
  throw std::invalid_argument(unknown("--chart = " + wanted + ": no such chart of " + name, names, wanted));
}

/// One chart of the study, or all of them; with --out, the name of each of several ends with that of the chart.
void chart(ChartArguments arguments, Session& session) {
  StudyChartOptions& options = arguments.options;
  for (const std::string& text : arguments.filters) options.filters.push_back(read_filter(text));
  options.x_scale = scale_named(arguments.x_scale);
  options.y_scale = scale_named(arguments.y_scale);
  options.map_scale = scale_named(arguments.map_scale);
  const GatheredDatabases gathered(arguments.databases);
  session.err << gathered.renamed_in_words();
  ResultStore store(gathered.file(), Access::read);
  if (const std::string fit = fit_meant(arguments, store); !fit.empty())
    return draw_fit(arguments, fit, store, session);
  std::vector<std::string> studies = arguments.studies;
  if (studies.empty() && arguments.databases.size() > 1) studies = store.study_names();
  if (!studies.empty()) options.study = studies.front();
  if (studies.size() > 1) options.more_studies.assign(studies.begin() + 1, studies.end());
  if (!options.map.empty()) return draw_map(arguments, store, session);
  if (!options.optimum.empty()) throw std::invalid_argument("--optimum = " + options.optimum + ": needs --map");
  if (options.chart != "all") return draw(arguments, store, session);
  for (const std::string& name : stored_charts(store, options.study)) {
    ChartArguments one = arguments;
    one.options.chart = name;
    if (!one.out.empty()) one.out = one_of_several(arguments.out, name).string();
    draw(one, store, session);
  }
}

}  // namespace

void add_chart(Command& program, Session& session) {
  const auto [command, arguments] = program.add<ChartArguments>(
      "chart", "Draw a stored study, or a fit, as SVG and PNG, through gnuplot", session, chart);
  StudyChartOptions& options = arguments.options;
  command->add_option("--db FILE", arguments.databases, "database; may be repeated: several are read as one")
      ->one_value_each()
      ->or_usual_database();
  command
      ->add_option(
          "--study NAME", arguments.studies,
          "study, or fit; may be left out if the database holds one; may be repeated: the studies are drawn together, "
          "each a family")
      ->one_value_each();
  command->add_option("--fit NAME", arguments.fit,
                      "fit: data and fit, residuals against each input, normal quantiles, profiles, ellipses");
  command->add_option("--chart NAME", options.chart,
                      "chart of the study file, by its name or its number; all: every one; left out: the first. Of a "
                      "fit: data, residuals, residuals_KEY, residuals_fit, quantiles, profile_KEY or ellipse; left "
                      "out: every one");
  command->add_option("--x KEY", options.x,
                      "input or output along x; left out: as the study file says, or its longest axis");
  command->add_option("--y KEY", options.y,
                      "output along y; left out: as the study file says, or rolling_resistance. With --map: an axis");
  command->add_option("--family KEY", options.family, "axis with one curve for each value; left out: the other axes");
  command->add_flag("--shares", options.shares,
                    "what of the rolling resistance is lost in the layer and what to friction, stacked");
  command->add_option("--map KEY", options.map, "contour map of this output over the axes --x and --y");
  command->add_option("--optimum NAME", options.optimum,
                      "with --map: draw the designs and the optimum of this optimisation");
  command
      ->add_option("--where FILTER", arguments.filters, "show only points with KEY=VALUE, as in query; may be repeated")
      ->one_value_each();
  const std::vector<std::string_view> scales{"auto", "linear", "logarithmic"};
  command
      ->add_option("--x-scale SCALE", arguments.x_scale,
                   "auto: logarithmic if the study spaced it so or over two decades")
      ->one_of(scales);
  command->add_option("--y-scale SCALE", arguments.y_scale, "auto, linear or logarithmic")->one_of(scales);
  command->add_option("--map-scale SCALE", arguments.map_scale, "of the colours of a map: auto, linear or logarithmic")
      ->one_of(scales);
  command->add_option("--out PATH", arguments.out,
                      "name of the files, with or without suffix; left out: beside the database");
  command->footer(
      "The script (.gp) and the data (.dat) stay beside the pictures: change the script and run gnuplot on it.\n"
      "Examples: rollres chart --db results.db --study speed_resistance --x speed --y rolling_resistance --family "
      "load\n"
      "          rollres chart --db results.db --shares --where 'load=20 kN/m'\n"
      "          rollres chart --db results.db --map rolling_resistance --x speed --y load\n"
      "          rollres chart --db one.db --db other.db --study summer --study winter --x speed\n"
      "          rollres chart --db results.db --chart all\n"
      "          rollres chart --db fits.db --fit rubber --chart data --out rubber");
}

}  // namespace rollres
