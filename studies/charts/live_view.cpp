#include "studies/charts/live_view.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <sstream>

#include "db/queries/query.hpp"
#include "studies/drawing/text_plot.hpp"
#include "studies/run/progress.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/study/study_definition.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// Seconds since 1970 of "2013-05-01T12:00:00.000Z"; NaN if it is none.
double seconds_of(const std::string& time) {
  std::tm parts{};
  std::istringstream stream(time);
  char letter = 0;
  double seconds = 0;
  int year = 0, month = 0;
  stream >> year >> letter >> month >> letter >> parts.tm_mday >> letter >> parts.tm_hour >> letter >> parts.tm_min >>
      letter >> seconds;
  if (!stream) return std::numeric_limits<double>::quiet_NaN();
  parts.tm_year = year - 1900;
  parts.tm_mon = month - 1;
  return static_cast<double>(timegm(&parts)) + seconds;
}

/// What its first chart shows, or the resistance along the axis with the most values.
struct Shown {
  const QuantityColumn *x = nullptr, *y = nullptr, *family = nullptr;
};

Shown shown_of(const StudyDefinition& definition, const StudyOutline& study, const StudyRows& rows) {
  const StudyChart chart = definition.charts.empty() ? StudyChart() : definition.charts.front();
  Shown shown;
  const auto column = [&](const std::string& key) { return &column_of(key, study, rows, "chart"); };
  shown.y = chart.map.empty() ? column(chart.y.empty() ? "rolling_resistance" : chart.y) : column(chart.map);
  if (!chart.x.empty()) shown.x = column(chart.x);
  std::vector<std::pair<std::size_t, const QuantityColumn*>> axes;
  for (const std::string& key : study.axes) axes.emplace_back(rows.values(*column(key)).size(), column(key));
  stable_sort(axes, [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [values, axis] : axes)
    if (!shown.x && axis->type == "REAL") shown.x = axis;
  if (!chart.family.empty()) shown.family = column(chart.family);
  for (const auto& [values, axis] : axes) {
    constexpr std::size_t most_families = 8;
    if (!shown.family && axis != shown.x && values > 1 && values <= most_families) shown.family = axis;
  }
  return shown;
}

std::string plot_of(ResultStore& store, const StudyOutline& study, std::size_t width, std::size_t height) {
  const StudyRows rows(store, study.name);
  const StudyDefinition definition =
      definition_in(store.definition(study.name).value_or(""), store.database().name() + ": " + study.name);
  const Shown shown = shown_of(definition, study, rows);
  if (!shown.x || rows.values(*find_quantity_column("indenter")).size() > 1) return {};
  const ColumnScale x = scale_of(rows, *shown.x, AxisScale::automatic,
                                 definition.logarithmic.contains(key_of(*shown.x)), "x"),
                    y = scale_of(rows, *shown.y, AxisScale::automatic, false, "y");
  std::map<Cell, TextPlotCurve> curves;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (!rows.converged(row)) continue;
    const Cell family = shown.family ? rows.cell(row, *shown.family) : Cell();
    curves[family].points.emplace_back(x.unit.number(rows.number(row, *shown.x)),
                                       y.unit.number(rows.number(row, *shown.y)));
  }
  std::vector<TextPlotCurve> list;
  for (auto& [value, curve] : curves) {
    if (shown.family) curve.label = value_in_words(shown.family->quantity, value, unit_in(rows, *shown.family));
    list.push_back(std::move(curve));
  }
  const auto axis = [](const QuantityColumn& column, const ColumnScale& scale) {
    return TextPlotAxis{std::string(column.quantity.key) + unit_in_brackets(scale.unit.name), scale.logarithmic};
  };
  return text_plot(axis(*shown.x, x), axis(*shown.y, y), list, width, height);
}

}  // namespace

LiveProgress live_progress(ResultStore& store, const std::string& study, double now) {
  LiveProgress progress{.study = stored_study(store, study)};
  constexpr std::int64_t newest = 60;
  const Table times = run_query(store.database(), {.filters = {{"study", Comparison::equal, progress.study.name}},
                                                   .columns = {"created"},
                                                   .sort = {"-id"},
                                                   .limit = newest});
  std::vector<double> seconds;
  for (const auto& row : times.rows) seconds.push_back(seconds_of(std::get<std::string>(row[0])));
  progress.since_last = seconds.empty() ? std::numeric_limits<double>::quiet_NaN() : now - seconds.front();
  // Answers that came long ago belong to another run.
  constexpr double pause = 600;
  std::size_t together = 1;
  while (together < seconds.size() && seconds[together - 1] - seconds[together] < pause) ++together;
  if (together > 1 && progress.since_last < pause) {
    const double time = std::max(now, seconds.front()) - seconds[together - 1];
    if (time > 0) progress.rate = static_cast<double>(together - 1) / time;
  }
  return progress;
}

std::string in_words(const LiveProgress& progress) {
  const StudySummary& study = progress.study;
  std::string words = study.name + ": " + std::to_string(study.answered) + " of " + std::to_string(study.points) +
                      " answered, " + std::to_string(study.failed) + " failed";
  if (progress.done()) return words;
  if (progress.rate > 0)
    words += ", " + short_number(progress.rate, 3) + "/s, " +
             duration_in_words(static_cast<double>(study.points - study.answered) / progress.rate) + " left";
  constexpr double silent = 10;
  if (std::isnan(progress.since_last))
    words += ", no answer yet";
  else if (progress.since_last > silent)
    words += ", the newest " + duration_in_words(progress.since_last) + " ago";
  return words;
}

std::string live_view(ResultStore& store, const LiveProgress& progress, std::size_t width, std::size_t height) {
  const StudySummary& study = progress.study;
  std::string view = in_words(progress) + '\n';
  constexpr std::size_t margin = 2;
  const std::size_t bar = width - margin;
  const double part = study.points > 0 ? static_cast<double>(study.answered) / static_cast<double>(study.points) : 1;
  const auto full = static_cast<std::size_t>(part * static_cast<double>(bar));
  view += '[' + std::string(full, '#') + std::string(bar - full, '-') + "]\n";
  constexpr std::size_t most_reasons = 3;
  const std::vector<Failure> failures = study.failed > 0 ? store.failures(study.name) : std::vector<Failure>();
  for (std::size_t i = 0; i < failures.size() && i < most_reasons; ++i) {
    const std::string line =
        std::to_string(failures[i].points) + " x " + failures[i].status + ": " + failures[i].reason;
    view += line.substr(0, width) + '\n';
  }
  if (failures.size() > most_reasons)
    view += "and " + std::to_string(failures.size() - most_reasons) + " other reasons\n";
  const auto lines = static_cast<std::size_t>(std::count(view.begin(), view.end(), '\n'));
  constexpr std::size_t frame = 5;  // lines about the points of a plot
  if (study.answered > study.failed && height > lines + frame + 2)
    view += '\n' + plot_of(store, study, width, height - lines - frame);
  return view;
}

}  // namespace rollres
