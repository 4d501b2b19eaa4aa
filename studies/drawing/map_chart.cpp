#include "studies/drawing/map_chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "studies/drawing/chart_frame.hpp"
#include "studies/drawing/colour_map.hpp"
#include "studies/drawing/figure_data.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

constexpr double left_edge = 108, right_edge = 424,
                 lower_edge = 88;  // of the map; a colour bar stands on its right [px]

/// Values for the nodes that have none: means of their neighbours, from the answers outwards.
PlaneField filled(PlaneField field) {
  const auto columns = static_cast<std::ptrdiff_t>(field.x.size()), rows = static_cast<std::ptrdiff_t>(field.y.size());
  for (bool missing = true; missing;) {
    missing = false;
    const PlaneField before = field;
    for (std::ptrdiff_t row = 0; row < rows; ++row)
      for (std::ptrdiff_t column = 0; column < columns; ++column) {
        double& value = field.values[static_cast<std::size_t>(row * columns + column)];
        if (std::isfinite(value)) continue;
        double sum = 0;
        int count = 0;
        for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(row - 1, 0); j <= std::min(row + 1, rows - 1); ++j)
          for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(column - 1, 0); i <= std::min(column + 1, columns - 1); ++i)
            if (const double near = before.values[static_cast<std::size_t>(j * columns + i)]; std::isfinite(near)) {
              sum += near;
              ++count;
            }
        if (count > 0) value = sum / count;
        missing = missing || count == 0;
      }
  }
  return field;
}

class MapDrawing {
 public:
  MapDrawing(const MapRequest& request, const ChartFiles& files)
      : request_(request), files_(files), data_(request.title) {
    for (const double x : request.field.x) x_.include(x);
    for (const double y : request.field.y) y_.include(y);
    x_.logarithmic = request.x.logarithmic && x_.lowest > 0;
    y_.logarithmic = request.y.logarithmic && y_.lowest > 0;
    write_axes(script_, files, request.x, x_, request.y, y_);
    script_ << "set border 15\nunset grid\nset tics out\n";
  }

  void paint() {
    const auto [lowest, highest] = extremes();
    const bool logarithmic = request_.value.logarithmic && lowest > 0;
    const std::string unit = request_.value.unit.empty() ? "" : "  [" + gnuplot::plain(request_.value.unit) + "]";
    const std::string label =
        (request_.value.symbol.empty() ? gnuplot::plain(request_.value.name) : gnuplot::symbol(request_.value.symbol)) +
        unit;
    PlaneField field = request_.field;
    if (logarithmic) {
      std::vector<double> levels = logarithmic_levels(lowest, highest);
      write_numbered_colours(script_, levels, label);
      for (double& level : levels) level = std::log10(level);
      for (double& value : field.values) value = std::log10(value);
      paint(field, levels, [&](double level, bool above) {
        const auto place = std::lower_bound(levels.begin(), levels.end(), level) - levels.begin();
        return static_cast<double>(place) + (above ? 0.5 : -0.5);
      });
    } else {
      const ColourBands bands = ColourBands::between(lowest, highest);
      write_colours(script_, bands, label);
      paint(field, bands.levels, [&](double level, bool above) { return bands.inside(level, above); });
    }
  }

  /// Blanks the cells around nodes without an answer.
  void blank() {
    const PlaneField& field = request_.field;
    for (std::size_t row = 0; row < field.y.size(); ++row)
      for (std::size_t column = 0; column < field.x.size(); ++column) {
        if (std::isfinite(field.at(column, row))) continue;
        const double left = field.x[column - std::min<std::size_t>(column, 1)],
                     low = field.y[row - std::min<std::size_t>(row, 1)];
        const double right = field.x[std::min(column + 1, field.x.size() - 1)],
                     top = field.y[std::min(row + 1, field.y.size() - 1)];
        plots_.push_back(
            data_.add("blank", columns(),
                      std::vector<DataRow>{{left, low}, {right, low}, {right, top}, {left, top}, {left, low}}) +
            " using 1:2 with filledcurves closed lc rgb 'white' notitle");
      }
    mark(MapNode::unanswered, "points pt 2 ps 0.7 lw 1.5 lc rgb '#444444'", "no answer");
    mark(MapNode::not_converged, "points pt 6 ps 0.7 lw 1.5 lc rgb '#444444'", "not converged");
  }

  void draw_designs() {
    const std::string dots = "points pt 7 ps 0.35 lc rgb 'white'", halo = "points pt 7 ps 0.55 lc rgb 'black'";
    std::vector<DataRow> rows;
    for (const MapPoint& point : request_.designs)
      if (inside(point)) rows.push_back({point.x, point.y});
    if (!rows.empty()) {
      const std::string block = data_.add("designs", columns(), rows);
      plots_.push_back(block + " using 1:2 with " + halo + " notitle");
      plots_.push_back(block + " using 1:2 with " + dots + " notitle");
      legend_.push_back({halo, "designs looked at", 17});
    }
    if (!request_.optimum || !inside(*request_.optimum)) return;
    const std::string block =
        data_.add("optimum", columns(), std::vector<DataRow>{{request_.optimum->x, request_.optimum->y}});
    plots_.push_back(block + " using 1:2 with points pt 9 ps 2.1 lc rgb 'white' notitle");
    const std::string star = "points pt 9 ps 1.4 lc rgb '#D55E00'";
    plots_.push_back(block + " using 1:2 with " + star + " notitle");
    legend_.push_back({star, gnuplot::plain(request_.optimum_meaning), width(request_.optimum_meaning)});
  }

  void mark_peak() {
    const auto place = map_peak(request_);
    if (!place) return;
    const PlaneField& field = request_.field;
    const double x = field.x[*place % field.x.size()], y = field.y[*place / field.x.size()];
    const std::string value = short_number(field.values[*place], 3);
    const std::string ring = "points pt 6 ps 1.3 lw 2 lc rgb ";
    plots_.push_back(data_.add("peak", columns() + ": " + value, std::vector<DataRow>{{x, y}}) + " using 1:2 with " +
                     ring + "'black' notitle");
    const std::string says = "peak " + value + (request_.value.unit.empty() ? "" : " " + request_.value.unit);
    legend_.push_back({ring + "'black'", gnuplot::plain(says), width(says)});
  }

  void draw(const std::string& gnuplot) {
    write_pictures(script_, files_, request_.title + ": " + request_.value.name, plots_, legend_,
                   {.left = left_edge, .right = right_edge, .bottom = lower_edge});
    std::string head;
    for (const char letter : request_.comment + "\n")
      head += head.empty() || head.back() == '\n' ? std::string("# ") + letter : std::string(1, letter);
    draw_pictures(files_, head + data_.text(), script_.str(), gnuplot);
  }

 private:
  /// @param colour  of the band above or below a level, on the palette
  template <class Colour>
  void paint(const PlaneField& values, const std::vector<double>& levels, const Colour& colour) {
    PlaneField field = filled(values);
    for (double& x : field.x) x = x_.along(x);
    for (double& y : field.y) y = y_.along(y);
    for (ContourLoop loop : contour_loops(field, levels, -std::numeric_limits<double>::infinity())) {
      for (auto& point : loop.points) point = {x_.back(point[0]), y_.back(point[1])};
      const std::string block = data_.add("level " + short_number(loop.level), columns(), closed(loop));
      plots_.push_back(block + " using 1:2 with filledcurves closed fillcolor palette cb " +
                       short_number(colour(loop.level, loop.higher_inside)) + " notitle");
      plots_.push_back(block + " using 1:2 with lines lc rgb '#80000000' lw 0.7 notitle");
    }
  }

  static std::string named(const ChartAxis& axis) {
    return axis.name + (axis.unit.empty() ? "" : " [" + axis.unit + "]");
  }
  std::string columns() const { return named(request_.x) + ", " + named(request_.y); }
  bool inside(const MapPoint& point) const {
    return point.x >= x_.lowest && point.x <= x_.highest && point.y >= y_.lowest && point.y <= y_.highest;
  }
  std::pair<double, double> extremes() const {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const double value : request_.field.values)
      if (std::isfinite(value)) {
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
      }
    return {lowest, highest};
  }
  void mark(MapNode kind, const std::string& look, const std::string& meaning) {
    std::vector<DataRow> rows;
    const PlaneField& field = request_.field;
    for (std::size_t i = 0; i < request_.nodes.size(); ++i)
      if (request_.nodes[i] == kind) rows.push_back({field.x[i % field.x.size()], field.y[i / field.x.size()]});
    if (rows.empty()) return;
    plots_.push_back(data_.add(meaning, columns(), rows) + " using 1:2 with " + look + " notitle");
    legend_.push_back({look, meaning, width(meaning)});
  }

  const MapRequest& request_;
  ChartFiles files_;
  FigureData data_;
  Span x_, y_;
  std::ostringstream script_;
  std::vector<std::string> plots_;
  std::vector<LegendEntry> legend_;
};

}  // namespace

std::optional<std::size_t> map_peak(const MapRequest& request) {
  const PlaneField& field = request.field;
  std::optional<std::size_t> highest;
  for (std::size_t i = 0; i < field.values.size(); ++i)
    if (std::isfinite(field.values[i]) && (!highest || field.values[i] > field.values[*highest])) highest = i;
  if (!highest) return std::nullopt;
  const std::size_t column = *highest % field.x.size(), row = *highest / field.x.size();
  if (column == 0 || row == 0 || column + 1 == field.x.size() || row + 1 == field.y.size()) return std::nullopt;
  for (std::size_t j = row - 1; j <= row + 1; ++j)
    for (std::size_t i = column - 1; i <= column + 1; ++i)
      if (!std::isfinite(field.at(i, j))) return std::nullopt;
  return highest;
}

ChartFiles draw_map(const MapRequest& request, const std::filesystem::path& name, const std::string& gnuplot) {
  ChartFiles files = chart_files(name);
  const bool any = std::any_of(request.field.values.begin(), request.field.values.end(),
                               [](double value) { return std::isfinite(value); });
  if (request.field.x.size() < 2 || request.field.y.size() < 2 || !any)
    throw std::invalid_argument(request.title + ": nothing to map, it takes two values at least along " +
                                request.x.name + " and along " + request.y.name + ", and an answer");
  MapDrawing drawing(request, files);
  drawing.paint();
  drawing.blank();
  drawing.draw_designs();
  drawing.mark_peak();
  drawing.draw(gnuplot);
  return files;
}

}  // namespace rollres
