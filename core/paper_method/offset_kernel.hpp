#pragma once

/// One component of the layer's response as a function of the offset between two nodes, laid out so that sums over
/// lists of nodes and blocks of the (Toeplitz) matrix are quick.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/influence/influence.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

class OffsetKernel {
 public:
  OffsetKernel() = default;
  /// Tabulates value(columns, rows) for all offsets between two nodes of the grid.
  OffsetKernel(const SurfaceGrid& grid, const std::function<double(int, int)>& value);

  /// Response at node `receiver` to a unit force at node `source` (indices into the grid).
  double operator()(int receiver, int source) const { return values_[position(receiver) - position(source) + centre_]; }

  /// Adds to `response` (one entry per receiver) the response to `forces` (one entry per node of the grid) at the
  /// source nodes.
  void add(const std::vector<int>& receivers, const std::vector<int>& sources, const Eigen::VectorXd& forces,
           Eigen::VectorXd& response) const;

 private:
  int position(int node) const { return node / columns_ * width_ + node % columns_; }

  std::vector<double> values_;
  int columns_ = 1, width_ = 0, centre_ = 0;
};

/// Displacement [m/N; cylinder: m2/N] at a node due to a force at another.
OffsetKernel displacement_kernel(const InfluenceTable& table, const SurfaceGrid& grid, Direction displacement,
                                 Direction force);

/// Its derivative along x, by differences [1/N; cylinder: m/N]:
///   forward  (f(i+1) - f(i)) / a    central  (f(i+1) - f(i-1)) / 2a    backward  (f(i) - f(i-1)) / a
OffsetKernel slope_kernel(const InfluenceTable& table, const SurfaceGrid& grid, Direction displacement, Direction force,
                          SlipStencil stencil);

}  // namespace rollres
