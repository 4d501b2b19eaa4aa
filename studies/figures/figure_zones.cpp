#include "studies/figures/figure_drawings.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

constexpr int most_marks = 60;
constexpr double room_around_zones = 0.15;  // [half-lengths of the contact]

}  // namespace

FigureText zone_map(const Figure& figure, const FigureSource& source, const ChartFiles& files) {
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
    map.plot(map.data().add(name + "_nodes", with_unit("x", view.length) + ", " + with_unit("y", view.length), rows) +
             " using 1:2 with " + style + short_number(size, 3) + " notitle");
    map.explain({style + "0.8", zone == Zone::stick ? "stick" : "slip", 5});
  };
  mark(Zone::stick, "pt 7 lc rgb '#0072B2'");
  mark(Zone::slip, "pt 8 lw 1.5 lc rgb '#D55E00'");
  return map.finished(std::string(figure.title));
}

}  // namespace rollres
