#include <algorithm>
#include <cmath>

#include "core/scene/friction_law.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/figures/figure_map.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// One line of a figure over x, by the nodes of the window.
struct FieldLine {
  std::string_view symbol;            // in the data; of lines that follow each other and look alike one is explained
  const std::vector<double>& values;  // [SI]
  double factor;                      // by which they are multiplied
  std::string look;
};

}  // namespace

bool exact_edges(const RollingSolution& solution) { return !on_grid(solution.method); }

std::vector<std::array<double, 2>> zone_runs(Zone zone, const SurfaceFields& fields, const RollingSolution& solution) {
  const double half = 0.5 * fields.grid.spacing_x;
  std::vector<std::array<double, 2>> runs;
  for (int i = 0; i < fields.grid.columns; ++i) {
    if (fields.zone[static_cast<std::size_t>(i)] != zone) continue;
    const bool goes_on = i > 0 && fields.zone[static_cast<std::size_t>(i - 1)] == zone;
    if (!goes_on) runs.push_back({fields.grid.x(i) - half, 0});
    runs.back()[1] = fields.grid.x(i) + half;
  }
  if (exact_edges(solution))
    for (auto& [from, to] : runs) {
      if (std::abs(from - solution.trailing_edge) < 2 * half) from = solution.trailing_edge;
      if (std::abs(to - solution.leading_edge) < 2 * half) to = solution.leading_edge;
    }
  return runs;
}

namespace {

/// What one figure shows.
struct LinePlot {
  std::vector<FieldLine> lines;
  std::string y_name;
  ScaledUnit unit;             // of the lines
  double from, to;             // along x [m]
  bool zero_at_edges = false;  // the lines are zero at the edges of the contact and beyond
};

PictureText line_figure(const Figure& figure, const FigureSource& source, const ChartFiles& files,
                        const LinePlot& plot) {
  const std::vector<FieldLine>& lines = plot.lines;
  const ScaledUnit& unit = plot.unit;
  const double from = plot.from, to = plot.to;
  const SurfaceGrid& grid = source.surface.grid;
  const ScaledUnit length = scaled_unit("m", std::max(std::abs(from), std::abs(to)));
  Span x{from / length.factor, to / length.factor}, y;
  y.include(0);
  std::string columns = with_unit("x", length);
  for (const FieldLine& line : lines) columns += ", " + with_unit(line.symbol, unit);
  std::vector<DataRow> rows;
  const auto add = [&](double place, Zone zone, const auto& value) {
    DataRow row{place / length.factor};
    for (const FieldLine& line : lines) {
      row.push_back(line.factor * value(line.values) / unit.factor + 0.0);
      y.include(row.back());
    }
    row.push_back(static_cast<double>(zone));
    rows.push_back(std::move(row));
  };
  for (int i = 0; i < grid.columns; ++i) {
    if (grid.x(i) < from || grid.x(i) > to) continue;
    const auto node = static_cast<std::size_t>(i);
    add(grid.x(i), source.surface.zone[node], [&](const std::vector<double>& values) { return values[node]; });
  }
  if (plot.zero_at_edges && exact_edges(source.solution)) {
    for (const double edge : {source.solution.trailing_edge, source.solution.leading_edge})
      add(edge, Zone::free, [](const std::vector<double>&) { return 0.0; });
    std::sort(rows.begin(), rows.end());
  }

  // The bar of stick and slip stands below all lines.
  const double range = y.highest - y.lowest, bar_top = y.lowest - 0.06 * range, bar_bottom = y.lowest - 0.13 * range;
  y.lowest -= 0.19 * range;
  y.highest += 0.06 * range;

  PictureBuilder picture(figure.title, files, {.name = "along the motion", .symbol = "x", .unit = length.name}, x,
                         {.name = plot.y_name, .symbol = "", .unit = unit.name}, y);
  picture.script() << "set arrow from graph 0, first 0 to graph 1, first 0 nohead lw 0.8 lc rgb '#444444' back\n\n";
  const std::string block = picture.add("fields", columns + ", zone (0 free, 1 stick, 2 slip)", rows);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    picture.plot(block + " using 1:" + std::to_string(i + 2) + " with lines " + lines[i].look + " notitle");
    if (i + 1 < lines.size() && lines[i + 1].look == lines[i].look) continue;
    const auto lowered = static_cast<std::size_t>(lines[i].symbol.find('_') != std::string_view::npos);
    picture.explain(
        {"lines " + lines[i].look, gnuplot::symbol(lines[i].symbol) + kept_blanks, width(lines[i].symbol) - lowered});
  }
  const auto bar = [&](Zone zone, const std::string& look) {
    std::vector<DataRow> boxes;
    for (const auto& [begin, end] : zone_runs(zone, source.surface, source.solution))
      boxes.push_back({0.5 * (begin + end) / length.factor, 0.5 * (bar_bottom + bar_top), begin / length.factor,
                       end / length.factor, bar_bottom, bar_top});
    if (boxes.empty()) return;
    const std::string name(name_of(zone));
    picture.plot(picture.add(name, "middle, height, from, to, below, above", boxes) +
                 " using 1:2:3:4:5:6 with boxxyerror " + look + " notitle");
    picture.explain(LegendEntry::plain("boxes " + look, name));
  };
  bar(Zone::stick, "lc rgb '#0072B2' fs solid 0.45 border lc rgb '#0072B2'");
  bar(Zone::slip, "lc rgb '#D55E00' fs pattern 4 border lc rgb '#D55E00'");
  return picture.finished(std::string(figure.title));
}

}  // namespace

PictureText displacement_lines(const Figure& figure, const FigureSource& source, const ChartFiles& files) {
  const SurfaceFields& fields = source.surface;
  const SurfaceGrid& grid = fields.grid;
  // Under a line load on a half-space only differences of w have a meaning.
  const bool relative = std::isinf(source.scene.layer_thickness);
  std::vector<double> w = fields.w;
  if (relative) {
    const auto edge = std::lround((source.solution.leading_edge - grid.x(0)) / grid.spacing_x);
    for (double& value : w) value -= fields.w[static_cast<std::size_t>(edge)];
  }
  return line_figure(figure, source, files,
                     {.lines = {{"u", fields.u, 1, "lw 2.5 lc rgb '#0072B2'"},
                                {relative ? "w - w(x+)" : "w", w, 1, "lw 2.5 dt (12,4) lc rgb '#D55E00'"}},
                      .y_name = "displacement",
                      .unit = figure_unit("m", std::max(largest(fields.u), largest(w))),
                      .from = grid.x(0),
                      .to = grid.x(grid.columns - 1)});
}

PictureText traction_lines(const Figure& figure, const FigureSource& source, const ChartFiles& files) {
  const SurfaceFields& fields = source.surface;
  const RollingSolution& s = source.solution;
  const double room = 0.3 * 0.5 * (s.leading_edge - s.trailing_edge), friction = source.scene.friction_coefficient;
  LinePlot plot{.lines = {{"σ_z", fields.pressure, -1, "lw 2.5 dt (12,4) lc rgb '#D55E00'"}},
                .y_name = "traction on the layer",
                .unit = figure_unit("Pa", largest(fields.pressure)),
                .from = s.trailing_edge - room,
                .to = s.leading_edge + room,
                .zero_at_edges = true};
  std::vector<double> borne = fields.pressure;
  for (double& value : borne) value = friction_law(source.scene).bound(value);
  if (friction > 0) {
    const std::string bound = "lw 1.5 dt (2,3) lc rgb '#444444'";
    plot.lines.push_back({"τ_xz", fields.shear_x, 1, "lw 2.5 lc rgb '#0072B2'"});
    if (!fields.shear_y.empty()) plot.lines.push_back({"τ_yz", fields.shear_y, 1, "lw 2.5 dt (5,4) lc rgb '#009E73'"});
    plot.lines.push_back({"-μσ_z", borne, 1, bound});
    plot.lines.push_back({source.scene.traction_limit ? "±τ_max" : "±μσ_z", borne, -1, bound});
  }
  return line_figure(figure, source, files, plot);
}

}  // namespace rollres
