#pragma once

/// Displacements of an elastic surface under a force spread uniformly over one cell (core/influence/README.md, (K3)):
/// the half-space's part in closed form plus the layer's correction from tables.
///
/// Sphere (cells ax by ay): Boussinesq's and Cerruti's solutions integrated over the cell (Love 1929; Kalker 1990),
/// and four radial functions of r/H, Hankel transforms of the symbols' difference to the half-space (K4, K5).
/// Cylinder (cells of length ax): ln|x| and ln(x^2 + 4 H^2) integrated over the cell, and antiderivatives of the
/// cosine and sine transforms of what is left of the symbols (K6).

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/influence/surface_shape.hpp"

namespace rollres {

/// Displacement per unit force, times the modulus where the shape is that of unit modulus, in this order: ww, uu, vv,
/// uv, uw, vw [1/m; cylinder: 1]. A cylinder uses ww, uu and uw only.
using Coefficients = Eigen::Array<double, 6, 1>;
namespace coefficient {
enum : Eigen::Index { ww, uu, vv, uv, uw, vw };
/// Sign of each coefficient under x -> -x and under y -> -y.
inline const Coefficients mirror_x{{1, 1, 1, -1, -1, 1}};
inline const Coefficients mirror_y{{1, 1, 1, -1, 1, -1}};
}  // namespace coefficient

/// x asinh(y/|x|), odd in both.
double x_asinh(double x, double y);

class ElasticKernel {
 public:
  /// @param cell_x, cell_y size of the loaded cell [m] (cell_y is not used for a cylinder)
  ElasticKernel(Indenter indenter, const SurfaceShape& shape, double cell_x, double cell_y);
  /// Of a layer of unit shear modulus.
  ElasticKernel(Indenter indenter, const Layer& layer, double cell_x, double cell_y)
      : ElasticKernel(indenter, surface_shape(indenter, layer), cell_x, cell_y) {}

  /// At a distance (x, y) from the centre of the cell [m].
  Coefficients operator()(double x, double y) const;

  Indenter indenter() const { return indenter_; }
  const SurfaceShape& shape() const { return shape_; }

 private:
  Coefficients sphere(double x, double y) const;
  Coefficients cylinder(double x) const;
  Eigen::Array4d radial_limit(double distance) const;
  Eigen::Array3d line_antiderivative(double x) const;

  Indenter indenter_;
  SurfaceShape shape_;
  LayerSymbols beyond_;  // base less deep: what the correction tends to
  double cell_x_, cell_y_;
  Eigen::Array4d radial_tail_ = Eigen::Array4d::Zero();  // what the correction has left at the end of its table
  Eigen::Array3d line_tail_ = Eigen::Array3d::Zero();
  std::vector<double> nodes_x_, weights_x_, nodes_y_, weights_y_;  // average of the correction over the cell
};

}  // namespace rollres
