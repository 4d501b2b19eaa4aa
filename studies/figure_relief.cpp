#include <algorithm>

#include "studies/colour_map.hpp"
#include "studies/figure_drawings.hpp"
#include "studies/gnuplot.hpp"
#include "studies/readable_number.hpp"

namespace rollres {

namespace {

constexpr int most_relief_nodes = 64;
constexpr double room_around_contact = 0.2;  // [half-lengths of the contact]

}  // namespace

FigureText relief(const Figure& figure, const FigureSource& source, const ChartFiles& files) {
  const std::string_view name = figure.name.substr(0, figure.name.find("_surface"));
  const ShownField shown = shown_field(source, name);
  const MapView view = shown.traction ? MapView(source, room_around_contact) : MapView(source);
  const ScaledUnit unit = figure_unit(shown.unit, largest(shown.values));
  const PlaneField field = plane_field(source.surface.grid, view.nodes(source.surface.grid, most_relief_nodes), view,
                                       shown.values, unit.factor);
  std::vector<DataRow> rows;
  for (std::size_t row = 0; row < field.y.size(); ++row) {
    if (row > 0) rows.emplace_back();
    for (std::size_t column = 0; column < field.x.size(); ++column)
      rows.push_back({field.x[column], field.y[row], field.at(column, row)});
  }
  FigureData data(figure.title);
  const std::string block = data.add(
      name, with_unit("x", view.length) + ", " + with_unit("y", view.length) + ", " + with_unit(name, unit), rows);

  const auto [lowest, highest] = std::minmax_element(field.values.begin(), field.values.end());
  const ColourBands bands(*lowest, *highest);
  const std::string label = gnuplot::symbol(shown.symbol) + "  [" + typeset_unit(unit.name) + "]";
  std::ostringstream script;
  write_axes(script, files, {.name = "", .symbol = "x", .unit = view.length.name}, {field.x.front(), field.x.back()},
             {.name = "", .symbol = "y", .unit = view.length.name}, {field.y.front(), field.y.back()});
  write_colours(script, bands, label);
  script << "unset colorbox\nset zlabel " << gnuplot::quoted(label) << " rotate\nset ztics autofreq\n"
         << "set border 4095 lw 0.8 lc rgb '#888888'\nset tics in offset 0,0\nset grid ztics\n"
         << "set xyplane relative 0.05\nset view 52, 322, 1, 1.1\nset view equal xy\n"
         << "set pm3d depthorder border lc rgb '#303030' lw 0.25\n";
  write_pictures(script, files, std::string(figure.title), {block + " using 1:2:3 with pm3d notitle"}, {},
                 {.height = 400, .left = 30, .right = 540, .bottom = 40, .surface = true});
  return {script.str(), data.text()};
}

}  // namespace rollres
