#pragma once

/// The kinds of figures, each as script and data: figure_lines.cpp over x; figure_fields.cpp, contours and surfaces of
/// a field; figure_nodes.cpp, what stands at the nodes: marks and arrows.

#include "studies/figures/figure_map.hpp"

namespace rollres {

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

}  // namespace rollres
