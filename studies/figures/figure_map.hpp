#pragma once

/// What the figures of a sphere's contact have in common: a map of the surface to scale, with the edge of the contact
/// and the border between stick and slip.

#include "studies/figures/figure.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

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
  /// The contact alone, to the outer borders of its cells; it has a node at least.
  explicit MapView(const SurfaceFields& fields);

  /// Whether a place, in units of the axes, is inside.
  bool holds(double at_x, double at_y) const {
    return at_x >= x.lowest && at_x <= x.highest && at_y >= y.lowest && at_y <= y.highest;
  }

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

/// Outlines of the contact, or of what sticks of it, without the steps of the cells.
std::vector<ContourLoop> zone_loops(const SurfaceFields& fields, const MapView& view, bool stick_only);

/// A map in the making.
class FigureMap : public PictureBuilder {
 public:
  /// @param bar room for a colour bar on the right
  FigureMap(const Figure& figure, const FigureSource& source, const ChartFiles& files, const MapView& view, bool bar);

  /// Paints the contact with a light colour.
  void fill_contact();
  /// Blanks what lies outside the contact.
  void blank_outside();
  /// The edge of the contact as a line, the border between stick and slip dashed, with their legend.
  void draw_borders();
  /// What stands in the first two columns of its data.
  std::string columns() const { return with_unit("x", view_.length) + ", " + with_unit("y", view_.length); }

  PictureText finished();

 private:
  const Figure& figure_;
  const FigureSource& source_;
  MapView view_;
  bool bar_;
  std::vector<ContourLoop> contact_, stick_;
};

// The kinds of figures, each as script and data: figure_lines.cpp over x; figure_fields.cpp, contours and surfaces of a
// field; figure_nodes.cpp, what stands at the nodes: marks and arrows.

/// Figure 3: u and w along x. Figure 4: the tractions along x. Both with a bar for stick and slip.
PictureText displacement_lines(const Figure& figure, const FigureSource& source, const ChartFiles& files);
PictureText traction_lines(const Figure& figure, const FigureSource& source, const ChartFiles& files);

/// Figure 5: the nodes that stick and those that slip.
PictureText zone_map(const Figure& figure, const FigureSource& source, const ChartFiles& files);

/// A field of the surface as it is drawn.
struct ShownField {
  std::string_view symbol, unit;  ///< as Quantity writes them
  std::vector<double> values;     ///< at the nodes of the window [unit]
  bool traction;                  ///< shown over the contact only
};
/// "sigma_z", "tau_xz", "tau_yz", "u", "v", "w"
ShownField shown_field(const FigureSource& source, std::string_view name);

/// Figures 6, 7, 9, 10, 11, 13: contour maps.
PictureText contour_map(const Figure& figure, const FigureSource& source, const ChartFiles& files);

/// Figures 8 and 12: a field as a surface above the plane.
PictureText relief(const Figure& figure, const FigureSource& source, const ChartFiles& files);

/// Figure 14: friction on the layer. Figure 15: velocity of the layer's surface.
PictureText friction_arrows(const Figure& figure, const FigureSource& source, const ChartFiles& files);
PictureText velocity_arrows(const Figure& figure, const FigureSource& source, const ChartFiles& files);

/// Figures 16 and 17, not the paper's: the shear strain and the density of the loss on a section x-z through the
/// layers.
PictureText section_map(const Figure& figure, const FigureSource& source, const ChartFiles& files);

/// Figure 18, not the paper's: the steady temperature and the power lost with the depth below the face.
PictureText temperature_lines(const Figure& figure, const FigureSource& source, const ChartFiles& files);

}  // namespace rollres
