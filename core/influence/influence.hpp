#pragma once

/// Influence coefficients: the displacements of surface nodes for unit forces at surface nodes.
///
/// A nodal force is spread uniformly over its cell. The coefficients depend on the offset between receiving and
/// loaded node only; they contain the layer, the material and the speed, so that a sum over nodes is the whole
/// steady-state response of the layer (Zehil and Gavin 2013, eq. 5). Theory: core/influence/README.md.

#include <memory>
#include <vector>

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// Direction of a displacement or of a force on the layer: w up, u along x, v along y.
enum class Direction { w, u, v };

class InfluenceTable {
 public:
  InfluenceTable() = default;
  /// Zeros for offsets up to +-reach_x columns and +-reach_y rows (reach_y = 0 and no v for a cylinder, vv alone for a
  /// skewed one: `axial_coefficients`).
  InfluenceTable(int reach_x, int reach_y);

  int reach_x() const { return reach_x_; }
  int reach_y() const { return reach_y_; }

  /// Displacement at a node `columns` and `rows` away from (positive: at larger x and y than) a unit force
  /// [m/N; cylinder: m2/N].
  double operator()(Direction displacement, Direction force, int columns, int rows = 0) const;

  /// Independent components as stored, rows 0 to reach_y: C_uv and C_vw are odd in y, the others even;
  /// C_wu = -C_uw, of rings -(C_uw + hoop) (core/surface/ring_compliance.hpp); C_wv = -C_vw, C_vu = C_uv.
  std::vector<double> ww, uu, vv, uv, uw, vw;
  std::vector<double> hoop;  // even in y; empty where 0
  /// Makes room for the hoop's part, as zeros.
  void bend() { hoop.assign(uw.size(), 0.0); }
  int index(int columns, int rows) const { return rows * (2 * reach_x_ + 1) + columns + reach_x_; }

  /// The coefficients of the same layers flowing the other way: x and displacements along it change sign.
  InfluenceTable reversed() const;
  /// Those with the offsets the other way, and displacements in place of forces.
  InfluenceTable transposed() const;
  /// Adds those of a coating, whose cross terms are opposite (steady_surface.hpp).
  void add_coating(const InfluenceTable& coating) { add(coating, -1); }
  /// @param cross sign of its cross terms
  void add(const InfluenceTable& other, double cross = 1);

  /// What of a long wave's displacement steps between cells had made, and was taken out (long_waves.hpp) [1].
  double steps = 0;
  /// What the body's coating has of these, if there is one.
  std::shared_ptr<const InfluenceTable> coating;

 private:
  int reach_x_ = 0, reach_y_ = 0;
};

/// Coefficients between all nodes of `grid` and one column beyond it (for differences along x). Chooses the kernel:
/// periodic_kernel.hpp, passage_kernel.hpp, line_passage.hpp or sphere_passage.hpp.
/// @throws std::invalid_argument if the scene's layer or material is not one this program knows
InfluenceTable influence_table(const ContactModel& model, const SurfaceGrid& grid);

/// Largest relative error of the expansion in retardation times (medium_expansion.hpp) that the coefficients of a
/// composite surface contain (contact_surface.hpp) [1].
double expansion_error(const ContactModel& model);

}  // namespace rollres
