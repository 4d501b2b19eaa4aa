#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "studies/drawing/colour_map.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/figures/figure_drawings.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

constexpr int most_contour_nodes = 240;
constexpr double room_around_contact = 0.15, room_for_displacements = 1.1;  // [half-lengths of the contact]

/// Names of the bands that the loops enclose, for a loop of the script.
std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : text.size() % 110 > 100 ? " \\\n" : " ") + word;
  return text;
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

FigureText contour_map(const Figure& figure, const FigureSource& source, const ChartFiles& files) {
  const ShownField shown = shown_field(source, figure.name);
  const MapView view(source, shown.traction ? room_around_contact : room_for_displacements);
  const ScaledUnit unit = figure_unit(shown.unit, largest(shown.values));
  const PlaneField field = plane_field(source.surface.grid, view.nodes(source.surface.grid, most_contour_nodes), view,
                                       shown.values, unit.factor);
  const auto [lowest, highest] = std::minmax_element(field.values.begin(), field.values.end());
  const ColourBands bands(*lowest, *highest);
  const double outside = shown.traction ? 0 : -std::numeric_limits<double>::infinity();
  const std::vector<ContourLoop> loops = contour_loops(field, bands.levels, outside);

  FigureMap map(figure, source, files, view, true);
  write_colours(map.script(), bands, gnuplot::symbol(shown.symbol) + "  [" + typeset_unit(unit.name) + "]");
  std::vector<std::string> inside;
  const std::string columns = with_unit("x", view.length) + ", " + with_unit("y", view.length);
  for (const ContourLoop& loop : loops) {
    const double band = bands.inside(loop.level, loop.higher_inside);
    inside.push_back(short_number(band));
    map.data().add("loop", columns + "; level " + short_number(loop.level) + ", inside about " + inside.back(),
                   closed(loop));
  }
  map.script() << "# The inside of each loop of the data, in its colour; then the loops.\nbands = \"" << listed(inside)
               << "\"\n";
  if (shown.traction)  // zero outside the contact
    map.script() << "set object rectangle from graph 0, graph 0 to graph 1, graph 1 fillcolor palette cb "
                 << short_number(bands.inside(0, bands.levels.back() > 0)) << " fillstyle solid noborder behind\n";
  map.plot(
      "for [i = 1 : words(bands)] data index (i - 1) using 1:2 with filledcurves closed "
      "fillcolor palette cb real(word(bands, i)) notitle");
  map.plot("for [i = 1 : words(bands)] data index (i - 1) using 1:2 with lines lc rgb '#80000000' lw 0.7 notitle");
  if (shown.traction) map.blank_outside();
  map.draw_borders();
  return map.finished(std::string(figure.title));
}

}  // namespace rollres
