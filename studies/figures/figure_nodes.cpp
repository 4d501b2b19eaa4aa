#include <algorithm>
#include <cmath>

#include "studies/drawing/gnuplot.hpp"
#include "studies/figures/figure_map.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

constexpr int most_marks = 60;
constexpr double room_around_zones = 0.15;  // [half-lengths of the contact]

/// A field of arrows.
struct ArrowField {
  std::string_view name, symbol, unit;
  const std::vector<double>&x, &y;
  bool in_contact_only;
};

/// An arrow of a round value in the lower left corner.
/// @param longest of the arrows, and what it takes of the map's width
void draw_measure(std::ostream& script, double longest, double share, const ScaledUnit& unit) {
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  const double value = power * (longest >= 5 * power ? 5 : longest >= 2 * power ? 2 : 1);
  const double start = 0.025, text_start = start + share * value / longest + 0.02;
  const std::string text = short_number(value) + " " + typeset_unit(unit.name);
  script << "set object rectangle from graph 0, graph 0 to graph "
         << short_number(text_start + 0.026 * static_cast<double>(width(text)), 3)
         << ", graph 0.075 front fillcolor rgb 'white' fillstyle solid border lc rgb '#444444'\n"
         << "set arrow from graph " << start << ", graph 0.038 rto first length * " << short_number(value)
         << ", graph 0 front filled size graph 0.014,22 lw 1.3 lc rgb 'black'\n"
         << "set label " << gnuplot::quoted(text + kept_blanks) << " at graph " << short_number(text_start, 3)
         << ", graph 0.038 front\n";
}

PictureText arrow_map(const Figure& figure, const FigureSource& source, const ChartFiles& files,
                      const ArrowField& field, const MapView& view, int most) {
  const SurfaceGrid& grid = source.surface.grid;
  const ShownNodes nodes = view.nodes(grid, most);
  double longest = 0;
  for (std::size_t i = 0; i < field.x.size(); ++i) longest = std::max(longest, std::hypot(field.x[i], field.y[i]));
  if (longest == 0) longest = 1;  // nothing but points
  const ScaledUnit unit = figure_unit(field.unit, longest);
  const double longest_arrow =
      1.5 * (view.x.highest - view.x.lowest) / std::max(1.0, static_cast<double>(nodes.columns.size()) - 1);

  FigureMap map(figure, source, files, view, false);
  map.fill_contact();
  map.draw_borders();
  map.script() << "# Length of an arrow [" << view.length.name << "] for 1 " << unit.name
               << ".\nlength = " << short_number(longest_arrow * unit.factor / longest) << "\n";
  const auto arrows = [&](Zone zone, const std::string& look, const char* words) {
    std::vector<DataRow> rows;
    for (const int row : nodes.rows)
      for (const int column : nodes.columns) {
        const auto node = static_cast<std::size_t>(grid.index(column, row));
        if (source.surface.zone[node] != zone) continue;
        const double x = grid.x(column) / view.length.factor, y = grid.y(row) / view.length.factor;
        const double half = 0.5 * longest_arrow / longest, along = half * field.x[node], across = half * field.y[node];
        if (!view.holds(x - along, y - across) || !view.holds(x + along, y + across)) continue;  // would be cut off
        rows.push_back({x, y, field.x[node] / unit.factor + 0.0, field.y[node] / unit.factor + 0.0});
      }
    if (rows.empty()) return;
    const std::string symbol(field.symbol);
    const std::string block = map.add(
        std::string(field.name) + "_" + std::string(name_of(zone)),
        map.columns() + ", " + with_unit(symbol + " along x", unit) + ", " + with_unit(symbol + " along y", unit),
        rows);
    map.plot(block + " using ($1 - length * $3 / 2):($2 - length * $4 / 2):(length * $3):(length * $4) with vectors " +
             look + " notitle");
    map.explain({"vectors " + look, words, std::string_view(words).size()});
  };
  arrows(Zone::stick, "filled head size graph 0.014,22 lw 1.3 lc rgb '#0072B2'", "stick");
  arrows(Zone::slip, "empty head size graph 0.018,28 lw 1.3 lc rgb '#D55E00'", "slip");
  if (!field.in_contact_only) arrows(Zone::free, "filled head size graph 0.010,18 lw 1 lc rgb '#777777'", "free");
  draw_measure(map.script(), longest / unit.factor, longest_arrow / (view.x.highest - view.x.lowest), unit);
  return map.finished();
}

}  // namespace

PictureText zone_map(const Figure& figure, const FigureSource& source, const ChartFiles& files) {
  const MapView view(source, room_around_zones);
  FigureMap map(figure, source, files, view, false);
  map.fill_contact();
  map.draw_borders();
  const SurfaceGrid& grid = source.surface.grid;
  const ShownNodes nodes = view.nodes(grid, most_marks);
  const double size = 26.0 / static_cast<double>(std::max(nodes.columns.size(), nodes.rows.size()));
  const auto mark = [&](Zone zone, const std::string& look) {
    std::vector<DataRow> rows;
    for (const int row : nodes.rows)
      for (const int column : nodes.columns)
        if (source.surface.zone[static_cast<std::size_t>(grid.index(column, row))] == zone)
          rows.push_back({grid.x(column) / view.length.factor, grid.y(row) / view.length.factor});
    if (rows.empty()) return;
    const std::string name(name_of(zone)), style = "points " + look + " ps ";
    map.plot(map.add(name + "_nodes", map.columns(), rows) + " using 1:2 with " + style + short_number(size, 3) +
             " notitle");
    map.explain({style + "0.8", zone == Zone::stick ? "stick" : "slip", 5});
  };
  mark(Zone::stick, "pt 7 lc rgb '#0072B2'");
  mark(Zone::slip, "pt 8 lw 1.5 lc rgb '#D55E00'");
  return map.finished();
}

PictureText friction_arrows(const Figure& figure, const FigureSource& source, const ChartFiles& files) {
  return arrow_map(figure, source, files, {"friction", "τ", "Pa", source.surface.shear_x, source.surface.shear_y, true},
                   MapView(source, 0.15), 28);
}

PictureText velocity_arrows(const Figure& figure, const FigureSource& source, const ChartFiles& files) {
  return arrow_map(figure, source, files, {"velocity", "velocity", "m/s", source.velocity.x, source.velocity.y, false},
                   MapView(source, 1.0), 36);
}

}  // namespace rollres
