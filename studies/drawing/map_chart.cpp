#include "studies/drawing/map_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>

#include "studies/drawing/chart_frame.hpp"
#include "studies/drawing/colour_map.hpp"
#include "studies/drawing/contour_levels.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

constexpr double least_left = 108, right_edge = 424, lower_edge = 88;  // a colour bar stands on the right [px]

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

Span span_of(const std::vector<double>& places, const ChartAxis& axis) {
  Span span{.lowest = places.front(), .highest = places.back()};
  span.logarithmic = axis.logarithmic && span.lowest > 0;
  return span;
}

class MapDrawing : PictureBuilder {
 public:
  MapDrawing(const MapRequest& request, const ChartFiles& files, const Span& x, const Span& y)
      : PictureBuilder(request.title, files, request.x, x, request.y, y), request_(request), x_(x), y_(y) {
    script() << "set border 15\nunset grid\nset tics out\n";
  }

  PictureText text() {
    paint();
    blank();
    draw_limits();
    draw_designs();
    mark_peak();
    PictureText text = finished(request_.title, {.left = std::max(least_left, left_edge_for(y_)),
                                                 .right = right_edge,
                                                 .bottom = lower_edge,
                                                 .subtitle = subtitle()});
    std::string head;
    for (const char letter : request_.comment + "\n")
      head += head.empty() || head.back() == '\n' ? std::string("# ") + letter : std::string(1, letter);
    return {text.script, head + text.data};
  }

 private:
  void paint() {
    const auto [lowest, highest] = extremes();
    const ChartAxis& value = request_.value;
    const std::string label = (value.symbol.empty() ? gnuplot::plain(value.name) : gnuplot::symbol(value.symbol)) +
                              (value.unit.empty() ? "" : "  [" + gnuplot::plain(value.unit) + "]");
    PlaneField field = request_.field;
    if (value.logarithmic && lowest > 0) {
      std::vector<double> levels = logarithmic_levels(lowest, highest);
      write_numbered_colours(script(), levels, label);
      for (double& level : levels) level = std::log10(level);
      for (double& number : field.values) number = std::log10(number);
      paint(
          field, levels, [](double level) { return std::pow(10.0, level); },
          [&](double level, bool above) {
            const auto place = std::lower_bound(levels.begin(), levels.end(), level) - levels.begin();
            return static_cast<double>(place) + (above ? 0.5 : -0.5);
          });
    } else {
      const ColourBands bands = ColourBands::between(lowest, highest);
      write_colours(script(), bands, label);
      paint(
          field, bands.levels, [](double level) { return level; },
          [&](double level, bool above) { return bands.inside(level, above); });
    }
  }

  /// @param shown   the value of a level   @param colour  of the band above or below a level, on the palette
  template <class Value, class Colour>
  void paint(const PlaneField& values, const std::vector<double>& levels, const Value& shown, const Colour& colour) {
    std::vector<ContourLoop> loops = loops_of(values, levels);
    for (ContourLoop& loop : loops) {
      const double band = colour(loop.level, loop.higher_inside);
      loop.level = shown(loop.level);
      const std::string block = add("level " + short_number(loop.level), columns(), closed(loop));
      plot(block + " using 1:2 with filledcurves closed fillcolor palette cb " + short_number(band) + " notitle");
      plot(block + " using 1:2 with lines lc rgb '#80000000' lw 0.7" + (loop.level < 0 ? " dt (5,3)" : "") +
           " notitle");
    }
    std::vector<std::array<double, 2>> marks;
    if (request_.optimum) marks.push_back({request_.optimum->x, request_.optimum->y});
    if (const auto peak = map_peak(request_))
      marks.push_back(
          {request_.field.x[*peak % request_.field.x.size()], request_.field.y[*peak / request_.field.x.size()]});
    write_contour_levels(script(), loops, x_, y_, marks,
                         [&](const std::array<double, 2>& point) { return is_answered(point); });
  }

  /// Whether the nodes around a place all have answers.
  bool is_answered(const std::array<double, 2>& point) const {
    const PlaneField& field = request_.field;
    const auto before = [](const std::vector<double>& places, double at) {
      const auto above = std::upper_bound(places.begin(), places.end(), at) - places.begin();
      return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, std::ssize(places) - 2));
    };
    const std::size_t column = before(field.x, point[0]), row = before(field.y, point[1]);
    return std::isfinite(field.at(column, row)) && std::isfinite(field.at(column + 1, row)) &&
           std::isfinite(field.at(column, row + 1)) && std::isfinite(field.at(column + 1, row + 1));
  }

  /// Contours of a field whose missing nodes are filled, in the units of the axes.
  std::vector<ContourLoop> loops_of(const PlaneField& values, std::span<const double> levels) const {
    PlaneField field = filled(values);
    for (double& x : field.x) x = x_.along(x);
    for (double& y : field.y) y = y_.along(y);
    std::vector<ContourLoop> loops = contour_loops(field, levels, -std::numeric_limits<double>::infinity());
    for (ContourLoop& loop : loops)
      for (auto& point : loop.points) point = {x_.back(point[0]), y_.back(point[1])};
    return loops;
  }

  /// Blanks the cells around nodes without an answer, and those around nodes without a steady state in grey.
  void blank() {
    const auto steady = [&](MapNode node) { return node != MapNode::no_steady_state; };
    blank("unsteady", "fc rgb '#D0D0D0'", [&](MapNode node) { return !steady(node); });
    blank("blank", "fc rgb 'white'", steady);
    if (!all_of(request_.nodes, steady))
      explain("boxes fc rgb '#D0D0D0' fs solid border lc rgb '#444444'", "no steady state");
    mark(MapNode::unanswered, "points pt 2 ps 0.7 lw 1.5 lc rgb '#444444'", "no answer");
    mark(MapNode::not_converged, "points pt 6 ps 0.7 lw 1.5 lc rgb '#444444'", "not converged");
  }

  /// The cells around nodes of some kind that have no answer.
  template <class OfKind>
  void blank(std::string_view name, const std::string& colour, const OfKind& of_kind) {
    const PlaneField& field = request_.field;
    for (std::size_t row = 0; row < field.y.size(); ++row)
      for (std::size_t column = 0; column < field.x.size(); ++column) {
        if (std::isfinite(field.at(column, row)) || !of_kind(request_.nodes[row * field.x.size() + column])) continue;
        const double left = field.x[column - std::min<std::size_t>(column, 1)],
                     low = field.y[row - std::min<std::size_t>(row, 1)];
        const double right = field.x[std::min(column + 1, field.x.size() - 1)],
                     top = field.y[std::min(row + 1, field.y.size() - 1)];
        plot_block(name, {{left, low}, {right, low}, {right, top}, {left, top}, {left, low}},
                   "filledcurves closed " + colour);
      }
  }

  void mark(MapNode kind, const std::string& look, const std::string& meaning) {
    std::vector<DataRow> rows;
    const PlaneField& field = request_.field;
    for (std::size_t i = 0; i < request_.nodes.size(); ++i)
      if (request_.nodes[i] == kind) rows.push_back({field.x[i % field.x.size()], field.y[i / field.x.size()]});
    if (rows.empty()) return;
    plot_block(meaning, rows, look);
    explain(look, meaning);
  }

  /// What is shown, and at which values of the other axes.
  std::string subtitle() const {
    return request_.value.name + (request_.subtitle.empty() ? "" : " at " + request_.subtitle);
  }

  /// Veils what breaks a constraint, and draws the border on which it is met.
  void draw_limits() {
    std::vector<std::string> looks{"lines lc rgb 'white' lw 2.5 dt (6,3)", "lines lc rgb 'white' lw 2.5 dt (2,2)"};
    for (std::size_t i = 0; i < request_.limits.size(); ++i) {
      const MapLimit& limit = request_.limits[i];
      if (none_of(limit.excess, [](double value) { return value > 0; })) continue;
      const std::vector<ContourLoop> loops =
          loops_of({request_.field.x, request_.field.y, limit.excess}, std::array{0.0});
      const std::string block = add("beyond " + limit.meaning, columns(), loops);
      const std::string hatch = "fs transparent pattern " + std::to_string(4 + i % 2);  // of either slant
      if (loops.size() == 1)  // a hole in it would be veiled, too
        for (const std::string& veil : {std::string("'white' fs transparent solid 0.5"), "'#000000' " + hatch})
          plot(block + " using 1:2 with filledcurves closed fc rgb " + veil + " noborder notitle");
      plot(block + " using 1:2 with lines lc rgb 'black' lw 4.5 notitle");
      const std::string& look = looks[i % looks.size()];
      plot(block + " using 1:2 with " + look + " notitle");
      explain("boxes fc rgb '#000000' " + hatch + " border lc rgb 'black'", "breaks " + limit.meaning);
    }
  }

  void draw_designs() {
    const std::string halo = "points pt 7 ps 0.55 lc rgb 'black'", star = "points pt 9 ps 1.4 lc rgb '#D55E00'";
    std::vector<DataRow> rows;
    for (const MapPoint& point : request_.designs)
      if (inside(point)) rows.push_back({point.x, point.y});
    if (!rows.empty()) {
      const std::string block = plot_block("designs", rows, halo);
      plot(block + " using 1:2 with points pt 7 ps 0.35 lc rgb 'white' notitle");
      explain("points pt 6 ps 0.5 lw 1.2 lc rgb 'black'", "designs looked at");
    }
    if (!request_.optimum || !inside(*request_.optimum)) return;
    const std::string block =
        plot_block("optimum", {{request_.optimum->x, request_.optimum->y}}, "points pt 9 ps 2.1 lc rgb 'white'");
    plot(block + " using 1:2 with " + star + " notitle");
    explain(star, request_.optimum_meaning);
  }

  void mark_peak() {
    const auto place = map_peak(request_);
    if (!place) return;
    const PlaneField& field = request_.field;
    const double x = field.x[*place % field.x.size()], y = field.y[*place / field.x.size()];
    const std::string value = short_number(field.values[*place], 3), ring = "points pt 6 ps 1.3 lw 2 lc rgb 'black'";
    plot(add("peak", columns() + ": " + value, std::vector<DataRow>{{x, y}}) + " using 1:2 with " + ring + " notitle");
    explain(ring, "peak " + value + (request_.value.unit.empty() ? "" : " " + request_.value.unit));
  }

  /// Adds a block of data and plots it; returns how further plots refer to it.
  std::string plot_block(std::string_view name, const std::vector<DataRow>& rows, const std::string& look) {
    const std::string block = add(name, columns(), rows);
    plot(block + " using 1:2 with " + look + " notitle");
    return block;
  }
  void explain(const std::string& look, const std::string& meaning) {
    PictureBuilder::explain({look, gnuplot::plain(meaning), width(meaning)});
  }
  std::string columns() const {
    const auto named = [](const ChartAxis& axis) { return axis.name + unit_in_brackets(axis.unit); };
    return named(request_.x) + ", " + named(request_.y);
  }
  bool inside(const MapPoint& point) const {
    return point.x >= x_.lowest && point.x <= x_.highest && point.y >= y_.lowest && point.y <= y_.highest;
  }
  std::pair<double, double> extremes() const {
    Span span;
    for (const double value : request_.field.values)
      if (std::isfinite(value)) span.include(value);
    return {span.lowest, span.highest};
  }

  const MapRequest& request_;
  Span x_, y_;
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
  const bool any = any_of(request.field.values, [](double value) { return std::isfinite(value); });
  if (request.field.x.size() < 2 || request.field.y.size() < 2 || !any)
    throw std::invalid_argument(request.title + ": nothing to map, it takes two values at least along " +
                                request.x.name + " and along " + request.y.name + ", and an answer");
  MapDrawing drawing(request, files, span_of(request.field.x, request.x), span_of(request.field.y, request.y));
  const PictureText text = drawing.text();
  draw_pictures(files, text.data, text.script,
                {request.title, "contour map of " + request.value.name + " over " + request.x.name + " and " +
                                    request.y.name + (request.subtitle.empty() ? "" : ", " + request.subtitle)},
                gnuplot);
  return files;
}

}  // namespace rollres
