#pragma once

/// The nested grids of a solution: from a grid with four to eight cells on the half-width of the contact, doubling
/// their number, to the one asked for.

#include <functional>

#include "core/newton/contact_level.hpp"

namespace rollres {

/// Grids numbered by how often they are coarsened: 0 is the one asked for, -1 the next finer one.
struct GridSeries {
  /// Whether the contact's ends have the same place in their cells on every grid: changes are then regular.
  bool tied = false;
  int coarsest = 0;
  /// Whether, on the finest grid, the slow ways that need no good start are taken as well.
  bool last_resort = true;
  /// Where nothing is known but the scene.
  std::function<SurfaceGrid(int coarsening)> first;
  /// Around the contact that was found on another grid.
  std::function<SurfaceGrid(const ContactLevel& level, int coarsening)> around;
};

/// Square cells of a given size [m], a node under the body's axis.
GridSeries fixed_grids(const ContactModel& model, double spacing);

/// Cells in proportion to the contact of a sphere: a node at the centre of pressure, and so many cells, in each
/// direction, on the half-width of the elliptical contact whose pressure (like Hertz's) has the same second moments
/// (core/newton/README.md, (N13)). As
/// the scene changes, the grid changes with the contact, and the nodes in contact hardly do: what is computed is
/// smooth.
GridSeries tied_grids(const ContactModel& model, double cells_on_half_width);

/// The same for a cylinder: both ends of its contact, as the pressure tells them, lie by the same part of a cell beyond
/// the outermost nodes, and so many cells on its half-length (core/newton/README.md, section 5).
GridSeries tied_lines(const ContactModel& model, double cells_on_half_width);

}  // namespace rollres
