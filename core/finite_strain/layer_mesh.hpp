#pragma once

/// Cells of the undeformed layers: columns from the leading to the trailing end, rows from the surface down. Layers
/// under the body are flat; those of its cover lie around its core (core/finite_strain/README.md, section 6).

#include <Eigen/Core>
#include <vector>

namespace rollres {

/// Each cell has nine nodes: columns 2e, 2e + 1, 2e + 2 and rows 2r, 2r + 1, 2r + 2 belong to cell (e, r).
struct LayerMesh {
  std::vector<double> x;   // of the cells' borders, descending: the material flows on in this order
  std::vector<double> z;   // of the cells' borders, from 0 down to the base
  std::vector<int> layer;  // of each row of cells
  double curvature = 0;    // of the surface, 1/R of a covered cylinder; 0: flat

  int cells_along() const { return static_cast<int>(x.size()) - 1; }
  int cells_down() const { return static_cast<int>(z.size()) - 1; }
  int columns() const { return 2 * cells_along() + 1; }  // of nodes
  int free_rows() const { return 2 * cells_down(); }     // of nodes; the row below them is held by the base
  double length(int e) const { return x[static_cast<std::size_t>(e)] - x[static_cast<std::size_t>(e) + 1]; }
  double height(int r) const { return z[static_cast<std::size_t>(r)] - z[static_cast<std::size_t>(r) + 1]; }
  double node_x(int column) const;
  double node_z(int row) const;
  /// Length along a line of flow over that along the surface above it, r/R.
  double shortening(double depth) const { return 1 + depth * curvature; }
  /// Place of an undeformed particle; (x, z) where the mesh is flat.
  Eigen::Vector2d rest(double along, double depth) const;
  /// Directions along the line of flow and to the surface there, as columns.
  Eigen::Matrix2d frame(double along) const;
  /// Length of the surface that a node's force acts on, by Simpson's rule.
  double share(int column) const;
};

struct MeshWishes {
  double trailing = 0, leading = 0;  // edges of the contact on the undeformed surface
  int cells = 0;                     // in the contact, crowded at its edges
  std::vector<double> thicknesses;   // of the layers, from above
  double curvature = 0;              // of the surface
};

LayerMesh layer_mesh(const MeshWishes& wishes);

}  // namespace rollres
