#include <algorithm>

#include "studies/drawing/colour_map.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/figures/figure_drawings.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

constexpr int most_relief_nodes = 64;
constexpr double room_around_relief = 0.2, room_for_relief = 1.1;  // [half-lengths of the contact]

}  // namespace

FigureText relief(const Figure& figure, const FigureSource& source, const ChartFiles& files) {
  const std::string_view name = figure.name.substr(0, figure.name.find("_surface"));
  const ShownField shown = shown_field(source, name);
  const MapView view(source, shown.traction ? room_around_relief : room_for_relief);
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
  // Tractions are seen from ahead of the body, where they dip below zero; displacements from behind it. The labels of x
  // and y stand where terminals with different letters agree.
  const bool from_ahead = shown.traction;
  const auto place_label = [&](const char* axis, const char* symbol, const char* at) {
    script << "unset " << axis << "\nset label "
           << gnuplot::quoted(gnuplot::symbol(symbol) + "  [" + typeset_unit(view.length.name) + "]") << " at " << at
           << ", graph 0 center\n";
  };
  place_label("xlabel", "x", from_ahead ? "graph 0.48, graph -0.42" : "graph 0.62, graph -0.4");
  place_label("ylabel", "y", from_ahead ? "graph 1.33, graph 0.5" : "graph -0.48, graph 0.52");
  script << "set palette maxcolors 0\nunset colorbox\nset zlabel " << gnuplot::quoted(label) << " rotate\n"
         << "set border 895 lw 0.8 lc rgb '#888888'\nset grid ztics\n"
         << "set xtics offset 0,-0.3\nset ytics offset 0,-0.3\n"
         << "set xyplane relative 0.05\nset view " << (from_ahead ? "50, 35" : "56, 318") << "\n"
         << "set pm3d depthorder border lc rgb '#303030' lw 0.25\n";
  write_pictures(script, files, std::string(figure.title), {block + " using 1:2:3 with pm3d notitle"}, {},
                 {.height = 390, .left = 170, .right = 460, .bottom = 110, .gap = 86, .surface = true});
  return {script.str(), data.text()};
}

}  // namespace rollres
