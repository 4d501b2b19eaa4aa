#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "db/file/temporary_folder.hpp"
#include "studies/charts/scatter_chart.hpp"
#include "studies/charts/study_chart.hpp"
#include "studies/drawing/chart_frame.hpp"
#include "studies/figures/scene_sketch.hpp"
#include "studies/report/html.hpp"
#include "studies/report/report_sections.hpp"
#include "studies/report/report_slices.hpp"
#include "studies/scatter/scatter_statistics.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/text/files.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// Pictures of a section, drawn one after the other.
class Pictures {
 public:
  void add(const std::string& meaning, const std::function<ChartFiles(const std::filesystem::path&)>& draw) {
    html_ += html::picture(content_of(draw(folder_ / "picture.svg").svg), meaning);
    ++count_;
  }
  void add(const std::string& meaning, const ChartRequest& request) {
    const std::string svg = content_of(draw_chart(request, folder_ / "picture.svg").svg);
    html_ += html::picture(svg, meaning, chart_overlay(request, svg));
    ++count_;
  }
  std::string html() const { return count_ == 0 ? "" : "<div class=\"pictures\">\n" + html_ + "</div>\n"; }
  std::size_t count() const { return count_; }

 private:
  TemporaryFolder folder_;
  std::string html_;
  std::size_t count_ = 0;
};

/// What a chart cannot show is told in its place; a picture nobody asked for is left out.
void where_possible(const std::function<void()>& draw, std::string* refusal = nullptr) {
  try {
    draw();
  } catch (const std::invalid_argument& error) {
    if (refusal) *refusal += html::paragraph(std::string("Not drawn: ") + error.what());
  }
}

void add_map_of_file(const ReportSource& source, const ReportOptions& options, const StudyChart& wish,
                     Pictures& pictures) {
  const StoredMap map =
      stored_map(source.store, *source.shown,
                 {.study = source.study.name, .x = wish.x, .y = wish.y, .filters = options.filters, .map = wish.map});
  pictures.add(map.request.value.name + " over " + map.request.x.name + " and " + map.request.y.name,
               [&](const auto& file) { return draw_map(map.request, file); });
}

void add_curves(const ReportSource& source, const StudyChartOptions& options, const std::string& place,
                Pictures& pictures) {
  const StoredChart chart = stored_chart(*source.with(options.filters).shown, options);
  const ChartRequest& request = chart.request;
  pictures.add(request.y.name + " against " + request.x.name +
                   (request.family.name.empty() ? "" : ", by " + request.family.name) + place,
               request);
}

/// A chart of too many curves as slices: along the axis that is wished, or along each number.
void add_slices(const ReportSource& source, const ReportOptions& options, const StudyChartOptions& chart,
                Pictures& pictures) {
  constexpr std::size_t most_slices = 6;
  const std::vector<const QuantityColumn*> axes = longest_first(source, options.x);
  for (std::size_t i = 0; i < std::min(axes.size(), options.x.empty() ? most_slices : 1); ++i) {
    const QuantityColumn& along = *axes[i];
    if (along.type == "TEXT" || key_of(along) == options.family || source.definition.uncertain.contains(key_of(along)))
      continue;
    const FixedAxes fixed = slice_along(source, options, along);
    StudyChartOptions slice = chart;
    if (options.x.empty()) slice.x = along.name;
    slice.filters = fixed.filters;
    add_curves(source, slice, fixed.words, pictures);
  }
}

void add_charts(const ReportSource& source, const ReportOptions& options, Pictures& pictures, std::string& refusal) {
  for (const std::string& name : source.definition.chart_names())
    where_possible(
        [&] {
          const StudyChart& wish = source.definition.chart(name, source.study.name);
          if (!wish.map.empty()) return add_map_of_file(source, options, wish, pictures);
          const StudyChartOptions chart{.study = source.study.name,
                                        .chart = name,
                                        .x = options.x,
                                        .family = options.family,
                                        .filters = options.filters};
          try {
            add_curves(source, chart, "", pictures);
          } catch (const TooManyCurves&) {
            ReportOptions wished = options;
            if (wished.x.empty()) wished.x = wish.x;
            if (wished.family.empty()) wished.family = wish.family;
            add_slices(source, wished, chart, pictures);
          }
        },
        &refusal);
}

void add_shares(const ReportSource& source, const ReportOptions& options, Pictures& pictures) {
  where_possible([&] {
    const FixedAxes fixed = all_but_longest(source, options, 1);
    const StoredChart chart =
        stored_chart(*source.with(fixed.filters).shown,
                     {.study = source.study.name, .x = options.x, .shares = true, .filters = fixed.filters});
    if (!chart.request.lines) return;
    pictures.add("what of the rolling resistance is lost in the layer and what to friction" + fixed.words,
                 chart.request);
  });
}

/// The resistance at each place of the axes that do not scatter.
struct ScatteredResistance {
  std::vector<const QuantityColumn*> axes;
  std::map<std::vector<Cell>, std::vector<double>> places;  ///< the values there, rising

  explicit ScatteredResistance(const ReportSource& source) {
    if (source.definition.uncertain.empty()) return;
    for (const QuantityColumn* const axis : source.varied())
      if (!source.definition.uncertain.contains(key_of(*axis))) axes.push_back(axis);
    for (std::size_t row = 0; row < source.rows.size(); ++row) {
      std::vector<Cell> place;
      for (const QuantityColumn* const axis : axes) place.push_back(source.rows.cell(row, *axis));
      if (const double value = source.rows.number(row, "rolling_resistance"); source.rows.converged(row))
        places[place].push_back(value);
    }
    for (auto& [place, values] : places) std::sort(values.begin(), values.end());
  }
};

/// How the resistance scatters: its histogram, and the probability below a value.
void add_scatter(const ReportSource& source, const ScatteredResistance& found, Pictures& pictures) {
  const QuantityColumn& output = *find_quantity_column("rolling_resistance");
  const auto& [axes, places] = found;
  if (places.empty() || places.size() > most_curves) return;
  ScatterPicture picture{.title = title_of_study(source.definition, source.study.name),
                         .axis = described(output),
                         .unit = std::string(unit_in(source.rows, output)),
                         .labels = {},
                         .values = {},
                         .ordered = axes.size() == 1 && axes.front()->type != "TEXT"};
  for (const auto& [place, values] : places) {
    std::string label;
    for (std::size_t i = 0; i < axes.size(); ++i)
      label +=
          (label.empty() ? "" : ", ") + value_in_words(axes[i]->quantity, place[i], unit_in(source.rows, *axes[i]));
    picture.labels.push_back(label);
    picture.values.push_back({values});
  }
  where_possible([&] { pictures.add("how often the resistance lies where", histogram_chart(picture)); });
  where_possible([&] { pictures.add("the probability of a resistance below a value", cumulative_chart(picture)); });
}

/// Mean, deviation and quantiles at each place.
std::string scatter_table(const ReportSource& source, const ScatteredResistance& found) {
  if (found.places.empty()) return "";
  std::vector<html::TableColumn> columns;
  for (const QuantityColumn* const axis : found.axes) columns.push_back({in_words(axis->quantity.key), true});
  const QuantityColumn& output = *find_quantity_column("rolling_resistance");
  for (const char* const name : {"points", "mean", "standard deviation", "P10", "P50", "P90"})
    columns.push_back({name, true});
  std::vector<html::TableRow> rows;
  for (const auto& [place, values] : found.places) {
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < place.size(); ++i)
      cells.push_back(value_in_words(found.axes[i]->quantity, place[i], unit_in(source.rows, *found.axes[i])));
    cells.push_back(std::to_string(values.size()));
    for (const double number : {mean_value(values), deviation_of(values), quantile_of_sorted(values, 0.1),
                                quantile_of_sorted(values, 0.5), quantile_of_sorted(values, 0.9)})
      cells.push_back(std::isfinite(number) ? readable(number, unit_in(source.rows, output)) : "");
    rows.push_back({cells});
  }
  return html::paragraph("How the rolling resistance scatters; rollres scatter tells the errors of these numbers:") +
         html::table(columns, rows);
}

void add_map(const ReportSource& source, const ReportOptions& options, Pictures& pictures) {
  const std::string& optimum = options.optimum;
  constexpr std::size_t fewest = 4;  // values along either axis
  const auto draw = [&] {
    const FixedAxes fixed = all_but_longest(source, options, 2);
    const StoredMap map = stored_map(source.store, *source.with(fixed.filters).shown,
                                     {.study = source.study.name, .filters = fixed.filters, .optimum = optimum});
    const MapRequest& request = map.request;
    if (optimum.empty() && (request.field.x.size() < fewest || request.field.y.size() < fewest)) return;
    pictures.add(request.value.name + " over " + request.x.name + " and " + request.y.name + fixed.words,
                 [&](const auto& file) { return draw_map(request, file); });
  };
  if (optimum.empty())
    where_possible(draw);
  else
    draw();
}

/// One mark for each converged point, those of each method alike.
void add_work_precision(const ReportSource& source, Pictures& pictures) {
  const StudyRows& rows = source.rows;
  const auto scale = [&](const char* key) {
    return scale_of(rows, *find_quantity_column(key), AxisScale::automatic, false, key);
  };
  const ColumnScale seconds = scale("seconds"), error = scale("error_estimate");
  ChartRequest request{.title = source.study.name,
                       .x = scaled_axis(*find_quantity_column("seconds"), seconds),
                       .y = scaled_axis(*find_quantity_column("error_estimate"), error),
                       .curves = {},
                       .lines = false,
                       .mark_peaks = false};
  request.x.margin = 0.03;
  std::map<std::string, std::vector<ChartPoint>> methods;
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (rows.converged(row))
      methods[value_in_words(rows.cell(row, *find_quantity_column("method")), "")].push_back(
          {rows.number(row, "seconds") / seconds.unit.factor, rows.number(row, "error_estimate") / error.unit.factor});
  for (auto& [method, points] : methods) request.curves.push_back({method, std::move(points)});
  where_possible([&] { pictures.add("estimated error against seconds", request); });
}

}  // namespace

PictureSection together_section(ResultStore& store, const ReportOptions& options) {
  Pictures pictures;
  std::string refusal;
  where_possible(
      [&] {
        const StoredChart chart = stored_chart(store, {.study = options.study,
                                                       .more_studies = options.more_studies,
                                                       .x = options.x,
                                                       .family = options.family,
                                                       .filters = options.filters});
        pictures.add(chart.request.y.name + " against " + chart.request.x.name + ", all studies", chart.request);
      },
      &refusal);
  return {html::heading("All studies") + pictures.html() + refusal, pictures.count()};
}

namespace {

/// The value of an axis at an evaluation of the study: an input of its scene, or the variant that its row is of.
Cell value_at(const ReportSource& source, const StoredEvaluation& answer, const QuantityColumn& axis) {
  if (key_of(axis) != variant_key) return input_of(answer.scene, key_of(axis));
  const Table row =
      run_query(source.store.database(), {.filters = {{"study", Comparison::equal, source.study.name},
                                                      {"id", Comparison::equal, std::to_string(answer.id)}},
                                          .columns = {axis.name}});
  return row.rows.empty() ? Cell() : row.rows.front().front();
}

}  // namespace

PictureSection sketch_section(const ReportSource& source, const std::optional<StoredOptimum>& found) {
  const bool best = found && found->best && !found->best->keys.empty();
  const std::vector<std::string> keys = best ? found->best->keys : source.store.points(source.study.name);
  for (std::size_t i = 0; i < keys.size(); ++i) {  // from the middle on, round
    const auto answer = source.store.find(keys[(i + keys.size() / 2) % keys.size()]);
    if (!answer || answer->solution.status != Status::converged) continue;
    const RollingScene& scene = answer->scene;
    const std::string place = joined(source.varied(), ", ", [&](const QuantityColumn* axis) {
      return in_words(axis->quantity.key) + " = " +
             value_in_words(axis->quantity, value_at(source, *answer, *axis), axis->quantity.unit_for(body_of(scene)));
    });
    Pictures pictures;
    const std::string meaning =
        (best ? "The best design, to scale" : "One of the scenes, to scale") + (place.empty() ? "" : ": " + place);
    where_possible([&] {
      pictures.add(meaning, [&](const std::filesystem::path& file) {
        const ChartFiles files = chart_files(file);
        const PictureText text = scene_sketch(scene, answer->solution, "Scene, to scale", files);
        draw_pictures(files, text.data, text.script, {meaning, sketch_in_words(scene)});
        return files;
      });
    });
    return {pictures.html(), pictures.count()};
  }
  return {};
}

PictureSection chart_pictures(const std::vector<std::pair<std::string, ChartRequest>>& charts) {
  Pictures pictures;
  for (const auto& [meaning, request] : charts) where_possible([&] { pictures.add(meaning, request); });
  return {pictures.html(), pictures.count()};
}

PictureSection chart_section(const ReportSource& study, const ReportOptions& options) {
  const ReportSource source = study.with(options.filters);
  Pictures pictures;
  std::string refusal;
  add_charts(source, options, pictures, refusal);
  add_shares(source, options, pictures);
  const ScatteredResistance scattered(source);
  add_scatter(source, scattered, pictures);
  const auto& charts = source.definition.charts;
  const bool mapped = any_of(charts, [](const auto& chart) { return !chart.map.empty(); });
  if (!mapped || !options.optimum.empty()) add_map(source, options, pictures);
  return {html::heading("Charts") + pictures.html() + refusal + scatter_table(source, scattered), pictures.count()};
}

PictureSection accuracy_pictures(const ReportSource& source) {
  Pictures pictures;
  add_work_precision(source, pictures);
  return {pictures.html(), pictures.count()};
}

}  // namespace rollres
