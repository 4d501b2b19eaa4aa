#pragma once

/// What the figures of a sphere's contact have in common: a map of the surface to scale, with the edge of the contact
/// and the border between stick and slip.

#include <sstream>
#include <string>
#include <vector>

#include "studies/drawing/chart_frame.hpp"
#include "studies/drawing/contour_loops.hpp"
#include "studies/drawing/figure_data.hpp"
#include "studies/figures/figure.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

/// Script and data of a figure.
struct FigureText {
  std::string script, data;
};

/// The prefix with which numbers up to `size` run from 0.1 to 100: displacements keep the unit of positions.
ScaledUnit figure_unit(std::string_view unit, double size);

/// "u [mm]"
std::string with_unit(std::string_view symbol, const ScaledUnit& unit);

/// Columns and rows of a grid that a picture can show: all, or every n-th.
struct ShownNodes {
  std::vector<int> columns, rows;
};

/// What of the surface a map shows, in units of its axes.
class MapView {
 public:
  ScaledUnit length;
  Span x, y;

  /// The whole window.
  explicit MapView(const FigureSource& source);
  /// The contact and `room` times its half-length around it.
  MapView(const FigureSource& source, double room);

  /// Nodes inside, about `most` at most along the longer side, the trailing edge and the axis y = 0 among them.
  ShownNodes nodes(const SurfaceGrid& grid, int most) const;

 private:
  int trailing_column_ = 0;
};

/// The largest magnitude of a field.
double largest(const std::vector<double>& values);

/// A field of the window at some of its nodes, divided by its unit.
PlaneField plane_field(const SurfaceGrid& grid, const ShownNodes& nodes, const MapView& view,
                       const std::vector<double>& values, double unit);

/// A map in the making.
class FigureMap {
 public:
  /// @param bar room for a colour bar on the right
  FigureMap(const Figure& figure, const FigureSource& source, const ChartFiles& files, const MapView& view, bool bar);

  std::ostream& script() { return script_; }
  FigureData& data() { return data_; }
  void plot(std::string words) { plots_.push_back(std::move(words)); }
  void explain(LegendEntry entry) { legend_.push_back(std::move(entry)); }

  /// Paints the contact with a light colour.
  void fill_contact();
  /// Blanks what lies outside the contact.
  void blank_outside();
  /// The edge of the contact as a line, the border between stick and slip dashed, with their legend.
  void draw_borders();

  FigureText finished(const std::string& title);

 private:
  std::string columns() const { return with_unit("x", view_.length) + ", " + with_unit("y", view_.length); }

  const FigureSource& source_;
  ChartFiles files_;
  MapView view_;
  bool bar_;
  std::ostringstream script_;
  FigureData data_;
  std::vector<std::string> plots_;
  std::vector<LegendEntry> legend_;
  std::vector<ContourLoop> contact_, stick_;
};

}  // namespace rollres
