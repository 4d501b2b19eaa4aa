#pragma once

/// Shape functions of a cell of nine nodes at its nine Gauss points (core/finite_strain/README.md, section 2).

#include <Eigen/Core>
#include <array>

namespace rollres {

/// Derivatives of the nodes' shape functions at the Gauss points (3 times the point along, plus the point down); along
/// and down count from the leading face and from the top.
struct PointShapes {
  using Nodes = Eigen::Matrix<double, 9, 1>;

  std::array<Nodes, 9> along, down;
  std::array<Eigen::Vector3d, 9> pressure;  // 1, xi, eta from -1 to 1
  std::array<double, 9> weight;
};
const PointShapes& point_shapes();

/// int psi^2 over a cell by its area, psi the pressure's 1, xi, eta.
inline const Eigen::Vector3d pressure_masses(1, 1.0 / 3, 1.0 / 3);

/// dE for displacements of the nine nodes (x and z in turn).
/// @param f  deformation gradient  @param x, z  derivatives of the nodes' shape functions
Eigen::Matrix<double, 3, 18> strain_rows(const Eigen::Matrix2d& f, const PointShapes::Nodes& x,
                                         const PointShapes::Nodes& z);

/// Gradient of a field with components (x, z) given at nine nodes.
Eigen::Matrix2d gradient_of(const Eigen::Matrix<double, 18, 1>& field, const PointShapes::Nodes& x,
                            const PointShapes::Nodes& z);

}  // namespace rollres
