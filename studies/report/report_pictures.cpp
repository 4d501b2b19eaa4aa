#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "studies/charts/study_chart.hpp"
#include "studies/report/html.hpp"
#include "studies/report/report_sections.hpp"
#include "studies/text/files.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream && !stream.eof()) throw std::runtime_error(file.string() + ": cannot be read");
  return text;
}

/// Pictures of a section, drawn one after the other.
class Pictures {
 public:
  void add(const std::string& meaning, const std::function<ChartFiles(const std::filesystem::path&)>& draw) {
    const ChartFiles files = draw(folder_ / "picture.svg");
    html_ += html::picture(content(files.svg), meaning);
    ++count_;
  }
  std::string html() const { return count_ == 0 ? "" : "<div class=\"pictures\">\n" + html_ + "</div>\n"; }
  std::size_t count() const { return count_; }

 private:
  ScratchFolder folder_;
  std::string html_;
  std::size_t count_ = 0;
};

struct FixedAxes {
  std::vector<Filter> filters;
  std::string words;  ///< " at load = 10 kN/m"
};

/// All varied axes but the first few, which are numbers and have the most values, at their middle values.
FixedAxes all_but_longest(const ReportSource& source, std::size_t free) {
  std::vector<const QuantityColumn*> axes = source.varied();
  std::stable_sort(axes.begin(), axes.end(), [&](const auto* one, const auto* other) {
    const auto rank = [&](const auto* axis) { return axis->type == "TEXT" ? 0 : source.rows.values(*axis).size(); };
    return rank(one) > rank(other);
  });
  FixedAxes fixed;
  for (std::size_t i = free; i < axes.size(); ++i) {
    const std::set<Cell> values = source.rows.values(*axes[i]);
    const Cell& middle = *std::next(values.begin(), static_cast<std::ptrdiff_t>(values.size() / 2));
    const auto* const number = std::get_if<double>(&middle);
    fixed.filters.push_back(
        {axes[i]->name, Comparison::equal, number ? shortest(*number) : value_in_words(middle, "")});
    fixed.words += (fixed.words.empty() ? " at " : ", ") + in_words(std::string(axes[i]->quantity.key)) + " = " +
                   value_in_words(middle, unit_in(source.rows, *axes[i]));
  }
  return fixed;
}

/// What a chart cannot show is told in its place; a picture nobody asked for is left out.
void where_possible(const std::function<void()>& draw, std::string* refusal = nullptr) {
  try {
    draw();
  } catch (const std::invalid_argument& error) {
    if (refusal) *refusal += html::paragraph(std::string("Not drawn: ") + error.what());
  }
}

void add_map_of_file(const ReportSource& source, const StudyChart& wish, Pictures& pictures) {
  const StoredMap map =
      stored_map(source.store, {.study = source.study.name, .x = wish.x, .y = wish.y, .map = wish.map});
  pictures.add(map.request.value.name + " over " + map.request.x.name + " and " + map.request.y.name,
               [&](const auto& file) { return draw_map(map.request, file); });
}

void add_charts(const ReportSource& source, Pictures& pictures, std::string& refusal) {
  for (const std::string& name : source.definition.chart_names())
    where_possible(
        [&] {
          if (const StudyChart& wish = source.definition.chart(name, source.study.name); !wish.map.empty())
            return add_map_of_file(source, wish, pictures);
          const StoredChart chart = stored_chart(source.store, {.study = source.study.name, .chart = name});
          const ChartRequest& request = chart.request;
          pictures.add(request.y.name + " against " + request.x.name +
                           (request.family.name.empty() ? "" : ", by " + request.family.name),
                       [&](const auto& file) { return draw_chart(request, file); });
        },
        &refusal);
}

void add_shares(const ReportSource& source, Pictures& pictures) {
  where_possible([&] {
    const FixedAxes fixed = all_but_longest(source, 1);
    const StoredChart chart =
        stored_chart(source.store, {.study = source.study.name, .shares = true, .filters = fixed.filters});
    if (!chart.request.lines) return;
    pictures.add("what of the rolling resistance is lost in the layer and what to friction" + fixed.words,
                 [&](const auto& file) { return draw_chart(chart.request, file); });
  });
}

void add_map(const ReportSource& source, const std::string& optimum, Pictures& pictures) {
  constexpr std::size_t fewest = 4;  // values along either axis
  const auto draw = [&] {
    const FixedAxes fixed = all_but_longest(source, 2);
    const StoredMap map =
        stored_map(source.store, {.study = source.study.name, .filters = fixed.filters, .optimum = optimum});
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
  where_possible([&] {
    pictures.add("estimated error against seconds", [&](const auto& file) { return draw_chart(request, file); });
  });
}

}  // namespace

PictureSection together_section(ResultStore& store, const ReportOptions& options) {
  Pictures pictures;
  std::string refusal;
  where_possible(
      [&] {
        const StoredChart chart = stored_chart(store, {.study = options.study, .more_studies = options.more_studies});
        pictures.add(chart.request.y.name + " against " + chart.request.x.name + ", all studies",
                     [&](const auto& file) { return draw_chart(chart.request, file); });
      },
      &refusal);
  return {html::heading("All studies") + pictures.html() + refusal, pictures.count()};
}

PictureSection chart_section(const ReportSource& source, const ReportOptions& options) {
  Pictures pictures;
  std::string refusal;
  add_charts(source, pictures, refusal);
  add_shares(source, pictures);
  const auto& charts = source.definition.charts;
  const bool mapped = std::any_of(charts.begin(), charts.end(), [](const auto& chart) { return !chart.map.empty(); });
  if (!mapped || !options.optimum.empty()) add_map(source, options.optimum, pictures);
  return {html::heading("Charts") + pictures.html() + refusal, pictures.count()};
}

PictureSection accuracy_pictures(const ReportSource& source) {
  Pictures pictures;
  add_work_precision(source, pictures);
  return {pictures.html(), pictures.count()};
}

PictureSection fit_pictures(const FitRecord& fit) {
  ChartRequest request{.title = fit.name + ": residuals",
                       .x = {.name = "measurement", .margin = 0.03},
                       .y = {.name = "residual, in deviations"},
                       .curves = {{}},
                       .lines = false,
                       .mark_peaks = false};
  for (std::size_t i = 0; i < fit.data.size(); ++i)
    request.curves.front().points.push_back({static_cast<double>(i + 1), fit.data[i].residual});
  Pictures pictures;
  where_possible([&] {
    pictures.add("residuals of the fit, (predicted - measured) over deviation",
                 [&](const auto& file) { return draw_chart(request, file); });
  });
  return {pictures.html(), pictures.count()};
}

}  // namespace rollres
