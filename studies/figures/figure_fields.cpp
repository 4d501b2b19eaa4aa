#include <cassert>

#include "studies/drawing/colour_map.hpp"
#include "studies/drawing/contour_levels.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/figures/figure_map.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

constexpr int most_contour_nodes = 240, most_relief_nodes = 64;
// [half-lengths of the contact]
constexpr double room_around_contact = 0.15, room_around_relief = 0.2, room_for_displacements = 1.1;

/// Names of the bands that the loops enclose, for a loop of the script.
std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : text.size() % 110 > 100 ? " \\\n" : " ") + word;
  return text;
}

/// A field as a figure shows it, in readable units.
struct FieldOfFigure {
  ShownField shown;
  MapView view;
  ScaledUnit unit;
  PlaneField field;
  ColourBands bands;
  std::string label;  ///< of its values, in gnuplot's markup
};

FieldOfFigure field_of_figure(const FigureSource& source, std::string_view name, double room_around, int most_nodes) {
  const ShownField shown = shown_field(source, name);
  const MapView view(source, shown.traction ? room_around : room_for_displacements);
  const ScaledUnit unit = figure_unit(shown.unit, largest(shown.values));
  const SurfaceGrid& grid = source.surface.grid;
  const PlaneField field = plane_field(grid, view.nodes(grid, most_nodes), view, shown.values, unit.factor);
  const auto [lowest, highest] = minmax_element(field.values);
  return {shown,
          view,
          unit,
          field,
          ColourBands(*lowest, *highest),
          gnuplot::symbol(shown.symbol) + "  [" + typeset_unit(unit.name) + "]"};
}

/// Plots the loops above or below zero by their blocks, named in the script; where there are none, nothing: gnuplot
/// goes through an empty list once.
void plot_loops(FigureMap& map, const std::vector<ContourLoop>& loops, bool negative) {
  std::vector<std::string> blocks;
  for (std::size_t i = 0; i < loops.size(); ++i)
    if ((loops[i].level < 0) == negative) blocks.push_back(std::to_string(i));
  if (blocks.empty()) return;
  const std::string name = negative ? "negative" : "positive";
  map.script() << name << " = \"" << listed(blocks) << "\"\n";
  map.plot("for [i in " + name + "] data index (int(i)) using 1:2 with lines lc rgb '#80000000' lw " +
           (negative ? "1 dt (6,4)" : "0.7") + " notitle");
}

}  // namespace

ShownField shown_field(const FigureSource& source, std::string_view name) {
  const SurfaceFields& fields = source.surface;
  if (name == "sigma_z") {
    std::vector<double> stress = fields.pressure;
    for (double& value : stress) value = 0.0 - value;
    return {"σ_z", "Pa", stress, true};
  }
  if (name == "tau_xz") return {"τ_xz", "Pa", fields.shear_x, true};
  if (name == "tau_yz") return {"τ_yz", "Pa", fields.shear_y, true};
  if (name == "u") return {"u", "m", fields.u, false};
  if (name == "v") return {"v", "m", fields.v, false};
  assert(name == "w");
  return {"w", "m", fields.w, false};
}

PictureText contour_map(const Figure& figure, const FigureSource& source, const ChartFiles& files) {
  const auto [shown, view, unit, field, bands, label] =
      field_of_figure(source, figure.name, room_around_contact, most_contour_nodes);
  const double outside = shown.traction ? 0 : -std::numeric_limits<double>::infinity();
  const std::vector<ContourLoop> loops = contour_loops(field, bands.levels, outside);

  FigureMap map(figure, source, files, view, true);
  write_colours(map.script(), bands, label);
  std::vector<std::string> inside;
  for (const ContourLoop& loop : loops) {
    const double band = bands.inside(loop.level, loop.higher_inside);
    inside.push_back(short_number(band));
    map.add("loop", map.columns() + "; level " + short_number(loop.level) + ", inside about " + inside.back(),
            closed(loop));
  }
  map.script() << "# The inside of each loop of the data, in its colour; then the loops, dashed below zero.\nbands = \""
               << listed(inside) << "\"\n";
  write_contour_levels(map.script(), loops, view.x, view.y);
  if (shown.traction)  // zero outside the contact
    map.script() << "set object rectangle from graph 0, graph 0 to graph 1, graph 1 fillcolor palette cb "
                 << short_number(bands.inside(0, bands.levels.back() > 0)) << " fillstyle solid noborder behind\n";
  map.plot(
      "for [i = 1 : words(bands)] data index (i - 1) using 1:2 with filledcurves closed "
      "fillcolor palette cb real(word(bands, i)) notitle");
  for (const bool negative : {false, true}) plot_loops(map, loops, negative);
  if (shown.traction) map.blank_outside();
  map.draw_borders();
  return map.finished();
}

PictureText relief(const Figure& figure, const FigureSource& source, const ChartFiles& files) {
  const std::string_view name = figure.name.substr(0, figure.name.find("_surface"));
  const auto [shown, view, unit, field, bands, label] =
      field_of_figure(source, name, room_around_relief, most_relief_nodes);
  std::vector<DataRow> rows;
  for (std::size_t row = 0; row < field.y.size(); ++row) {
    if (row > 0) rows.emplace_back();
    for (std::size_t column = 0; column < field.x.size(); ++column)
      rows.push_back({field.x[column], field.y[row], field.at(column, row)});
  }
  PictureBuilder picture(figure.title, files, {.name = "", .symbol = "x", .unit = view.length.name},
                         {field.x.front(), field.x.back()}, {.name = "", .symbol = "y", .unit = view.length.name},
                         {field.y.front(), field.y.back()});
  picture.plot(
      picture.add(name, with_unit("x", view.length) + ", " + with_unit("y", view.length) + ", " + with_unit(name, unit),
                  rows) +
      " using 1:2:3 with pm3d notitle");
  std::ostream& script = picture.script();
  write_colours(script, bands, label);
  // Tractions are seen from ahead of the body, where they dip below zero; displacements from behind it. The labels of x
  // and y stand where terminals with different letters agree.
  const bool from_ahead = shown.traction;
  const std::string length = "  [" + typeset_unit(view.length.name) + "]";
  const auto place_label = [&](const char* axis, const char* symbol, const char* at) {
    script << "unset " << axis << "\nset label " << gnuplot::quoted(gnuplot::symbol(symbol) + length) << " at " << at
           << ", graph 0 center\n";
  };
  place_label("xlabel", "x", from_ahead ? "graph 0.48, graph -0.42" : "graph 0.62, graph -0.4");
  place_label("ylabel", "y", from_ahead ? "graph 1.33, graph 0.5" : "graph -0.48, graph 0.52");
  script << "set palette maxcolors 0\nunset colorbox\nset zlabel " << gnuplot::quoted(label) << " rotate\n"
         << "set border 895 lw 0.8 lc rgb '#888888'\nset grid ztics\n"
         << "set xtics offset 0,-0.3\nset ytics offset 0,-0.3\n"
         << "set xyplane relative 0.05\nset view " << (from_ahead ? "50, 35" : "56, 318") << "\n"
         << "set pm3d depthorder border lc rgb '#303030' lw 0.25\n";
  return picture.finished(std::string(figure.title),
                          {.height = 390, .left = 170, .right = 460, .bottom = 110, .gap = 86, .surface = true});
}

}  // namespace rollres
