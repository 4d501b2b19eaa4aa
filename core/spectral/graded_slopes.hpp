#pragma once

/// Slopes of the surface at the middles of a graded grid from the tractions at its nodes (core/spectral/README.md,
/// (S30) to (S32)). For sources only.

#include <vector>

#include "core/spectral/graded_grid.hpp"

namespace rollres {

class GradedSlopes {
 public:
  /// @param order of the grid   @param sheared whether there is shear at all
  GradedSlopes(const SpectralProblem& problem, const GradedGrid& grid, const GradedPlaces& middles, int order,
               bool sheared);

  /// Of unit modulus, dw/dx and du/dx [Pa].
  struct Slopes {
    Eigen::VectorXd w, u;
  };
  Slopes of(const Eigen::VectorXd& pressure, const Eigen::VectorXd& shear) const;
  /// Those by the retarded parts of the half-space alone.
  Slopes retarded(const Eigen::VectorXd& pressure, const Eigen::VectorXd& shear) const;

  /// The same by value at each node, at some of the middles: dw/dx under pressure, du/dx under shear, and dw/dx under
  /// shear, which is du/dx under pressure.
  Eigen::MatrixXd normal(Eigen::Index first, Eigen::Index rows) const;
  Eigen::MatrixXd along(Eigen::Index first, Eigen::Index rows) const;
  Eigen::MatrixXd cross(Eigen::Index first, Eigen::Index rows) const;

 private:
  void measure_poles(const GradedGrid& grid, const GradedPlaces& middles);
  void measure_retarded(const GradedGrid& grid, const GradedPlaces& middles);
  void measure_layers(const GradedGrid& grid, const GradedPlaces& middles, int order, bool sheared);
  void tabulate(const Eigen::VectorXd& x, const Eigen::VectorXd& sources, bool sheared);
  Eigen::VectorXd between_nodes(const Eigen::VectorXd& values) const;
  /// Of a layer's kernel between its points, that between middles and nodes.
  Eigen::MatrixXd spread(const Eigen::MatrixXd& kernel, Eigen::Index first, Eigen::Index rows) const;

  const SpectralProblem& problem_;
  Eigen::Index nodes_;
  Eigen::MatrixXd poles_;  // Cauchy's kernel
  std::vector<GradedStencil> stencils_;
  Eigen::MatrixXd retarded_normal_, retarded_along_, retarded_cross_;  // empty if the half-space is elastic at once
  /// Layers: kernels between few points, from the values at nodes to forces there, and from there to the middles.
  Eigen::MatrixXd layer_normal_, layer_along_, layer_cross_, from_nodes_, to_middles_;
};

}  // namespace rollres
