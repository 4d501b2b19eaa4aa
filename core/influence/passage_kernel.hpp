#pragma once

/// Influence coefficients of a single passage (no period), at any speed and for any creep spectrum.
///
/// Each term of the spectrum is the elastic response convolved along x (core/influence/README.md, (K7)). The elastic
/// values at the points of the integrals do not depend on speed or material: one table serves every scene with the same
/// layer and spacing.

#include <memory>
#include <vector>

#include "core/influence/elastic_kernel.hpp"
#include "core/influence/influence.hpp"
#include "core/influence/passage_quadrature.hpp"
#include "core/material/material.hpp"

namespace rollres {

class PassageKernel {
 public:
  /// @param dimension as of ElasticKernel
  /// Elastic values for offsets up to `columns` and `rows` (0 for a cylinder) cells of size cell_x by cell_y [m].
  PassageKernel(int dimension, const Layer& layer, double cell_x, double cell_y, int columns, int rows);

  /// Coefficients for a material and a speed [m/s].
  /// @param reach_x, reach_y offsets in columns and rows, up to those the object was made for
  InfluenceTable table(const CreepSpectrum& material, double speed, int reach_x, int reach_y) const;

  int columns() const { return rules_.columns(); }

 private:
  PassageKernel(const ElasticKernel& kernel, double cell_x, double cell_y, int columns, int rows);

  PassageQuadrature rules_;
  std::vector<std::vector<Coefficients>> values_;  // K at the distances of the rules, for each row
};

/// The kernel for this geometry, from a small cache shared by all threads.
std::shared_ptr<const PassageKernel> shared_passage_kernel(int dimension, const Layer& layer, double cell_x,
                                                           double cell_y, int columns, int rows);

}  // namespace rollres
