#pragma once

/// The kinds of figures, each as script and data: figure_lines.cpp, figure_zones.cpp, figure_contours.cpp,
/// figure_relief.cpp, figure_arrows.cpp.

#include "studies/figures/figure_map.hpp"

namespace rollres {

/// Figure 3: u and w along x. Figure 4: the tractions along x. Both with a bar for stick and slip.
FigureText displacement_lines(const Figure& figure, const FigureSource& source, const ChartFiles& files);
FigureText traction_lines(const Figure& figure, const FigureSource& source, const ChartFiles& files);

/// Figure 5: the nodes that stick and those that slip.
FigureText zone_map(const Figure& figure, const FigureSource& source, const ChartFiles& files);

/// A field of the surface as it is drawn.
struct ShownField {
  std::string_view symbol, unit;  ///< as Quantity writes them
  std::vector<double> values;     ///< at the nodes of the window [unit]
  bool traction;                  ///< shown over the contact only
};
/// "sigma_z", "tau_xz", "tau_yz", "u", "v", "w"
ShownField shown_field(const FigureSource& source, std::string_view name);

/// Figures 6, 7, 9, 10, 11, 13: contour maps.
FigureText contour_map(const Figure& figure, const FigureSource& source, const ChartFiles& files);

/// Figures 8 and 12: a field as a surface above the plane.
FigureText relief(const Figure& figure, const FigureSource& source, const ChartFiles& files);

/// Figure 14: friction on the layer. Figure 15: velocity of the layer's surface.
FigureText friction_arrows(const Figure& figure, const FigureSource& source, const ChartFiles& files);
FigureText velocity_arrows(const Figure& figure, const FigureSource& source, const ChartFiles& files);

}  // namespace rollres
