#pragma once

/// Influence coefficients of a single passage (no period), at any speed and for any creep spectrum.
///
/// With T = V tau_m the memory length of a term, its part of the displacement is the elastic one convolved along x,
///   g(x) = int_0^inf e^{-s/T}/T K(x + s) ds,   g(x) = e^{-a/T} g(x + a) + int_0^a e^{-s/T}/T K(x + s) ds,
/// one backward recursion per row of nodes. The elastic values K at the points of the integrals do not depend on
/// speed or material: one table serves every scene with the same layer and spacing.

#include <functional>
#include <memory>

#include "core/elastic_kernel.hpp"
#include "core/influence.hpp"
#include "core/material.hpp"
#include "core/quadrature.hpp"

namespace rollres {

/// Displacements of an elastic surface under a cell, for distances y across the motion and then x along it; even or
/// odd in x as coefficient::mirror_x says.
using ResponseAlong = std::function<Coefficients(double x)>;
using ElasticResponse = std::function<ResponseAlong(double y)>;

class PassageKernel {
 public:
  /// @param rows 0 for a cylinder
  PassageKernel(const ResponseScales& scales, const ElasticResponse& response, double cell_x, double cell_y,
                int columns, int rows);
  /// Elastic values for offsets up to `columns` and `rows` (0 for a cylinder) cells of size cell_x by cell_y [m].
  PassageKernel(Indenter indenter, const SurfaceShape& shape, double cell_x, double cell_y, int columns, int rows);
  PassageKernel(Indenter indenter, const Layer& layer, double cell_x, double cell_y, int columns, int rows)
      : PassageKernel(indenter, surface_shape(indenter, layer), cell_x, cell_y, columns, rows) {}

  /// Adds the coefficients for a material and a speed [m/s].
  /// @param table for offsets up to at most those the object was made for
  void add_to(InfluenceTable& table, const CreepSpectrum& material, double speed) const;

  /// Coefficients for offsets up to reach_x columns and reach_y rows.
  InfluenceTable table(const CreepSpectrum& material, double speed, int reach_x, int reach_y) const;

  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  /// Which rule of integration a cell needs: the closer to the loaded cell, the finer.
  enum CellRule { near, middle, far, distant, rule_count };
  CellRule rule_of(int column, int row) const;

  int columns_, rows_;
  double cell_x_;
  std::array<MemoryRule, rule_count> cell_rules_;
  MemoryRule tail_rule_;                      // from the last column to the end of the layer's response
  std::vector<Coefficients> nodes_;           // K at the nodes, x >= 0, row by row
  std::vector<std::size_t> first_sample_;     // of each cell, row by row
  std::vector<Coefficients> samples_, tail_;  // K at the points of the cells' rules; of the tail's, row by row
};

/// The kernel for this geometry, from a small cache shared by all threads.
std::shared_ptr<const PassageKernel> shared_passage_kernel(Indenter indenter, const Layer& layer, double cell_x,
                                                           double cell_y, int columns, int rows);

/// Empties that cache, so that the next solution is as cold as a program's first.
void forget_passage_kernels();

}  // namespace rollres
