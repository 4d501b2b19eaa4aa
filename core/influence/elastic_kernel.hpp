#pragma once

/// Displacements of an elastic surface under a force spread uniformly over one cell (core/influence/README.md, (K3)):
/// the half-space's part in closed form plus the layer's correction from tables.
///
/// Sphere (cells ax by ay): Boussinesq's and Cerruti's solutions integrated over the cell (Love 1929; Kalker 1990),
/// and four radial functions of r/H, Hankel transforms of the symbols' difference to the half-space (K4, K5).
/// Cylinder (cells of length ax): ln|x| and ln(x^2 + 4 H^2) integrated over the cell, and antiderivatives of the
/// cosine and sine transforms of what is left of the symbols (K6). Along its axle: ln coth(pi |x|/4H)/pi.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "core/influence/layer_tables.hpp"
#include "core/scene/quantity.hpp"
#include "core/surface/layer_compliance.hpp"

namespace rollres {

/// Displacement per unit force, times the modulus where the surface is that of unit modulus, in this order: ww, uu, vv,
/// uv, uw, vw [1/m; cylinder: 1]. A cylinder uses ww, uu and uw only.
using Coefficients = Eigen::Array<double, 6, 1>;
namespace coefficient {
enum : Eigen::Index { ww, uu, vv, uv, uw, vw };
/// Sign of each coefficient under x -> -x and under y -> -y.
inline const Coefficients mirror_x{{1, 1, 1, -1, -1, 1}};
inline const Coefficients mirror_y{{1, 1, 1, -1, 1, -1}};
}  // namespace coefficient

/// Lengths over which the response of a surface changes.
struct ResponseScales {
  double length = std::numeric_limits<double>::infinity();  ///< the finest scale [m]
  double extent = std::numeric_limits<double>::infinity();  ///< distance where tables end [m]
  bool rigid_base = false;                                  ///< whether the surface is at rest beyond
  bool line_load = false;                                   ///< whether a half-space's response is -ln x, not 1/x

  /// Distance beyond which the surface does not move [m]; infinite where the base is a half-space.
  double reach() const { return rigid_base ? extent : std::numeric_limits<double>::infinity(); }
  /// Length over which the response at a distance is smooth [m].
  double grain(double distance) const {
    if (distance >= extent) return std::numeric_limits<double>::infinity();
    return std::min(std::max(length, 0.5 * distance), extent / 30);
  }
};

/// x asinh(y/|x|), odd in both.
double x_asinh(double x, double y);

/// Of a layer of unit shear modulus on a rigid base, or of a half-space.
class ElasticKernel {
 public:
  /// @param dimension 1: along lines of force, v under tau_y as if it were ww; 2: under lines of force; 3: under forces
  /// on a plane   @param cell_x, cell_y size of the loaded
  /// cell [m] (cell_y is not used for a cylinder)
  ElasticKernel(int dimension, const Layer& layer, double cell_x, double cell_y);

  /// At a distance (x, y) from the centre of the cell [m].
  Coefficients operator()(double x, double y) const;

  const ResponseScales& scales() const { return scales_; }

  /// Points at which the layer's part of a coefficient is taken.
  double points_in_a_cell() const {
    return nodes_x_.empty() ? 1 : static_cast<double>(nodes_x_.size()) * static_cast<double>(nodes_y_.size());
  }

 private:
  Coefficients sphere(double x, double y) const;
  /// What the layer's base changes of a half-space's coefficients, by quadrature over the cell. @pre there is one
  Coefficients sphere_correction(double x, double y) const;
  Coefficients cylinder(double x) const;
  Coefficients along_axle(double x) const;
  Eigen::Array3d line_correction(double left, double right) const;

  int dimension_;  // 1, 2 or 3
  double cell_x_, cell_y_;
  LayerSymbols deep_;                          // symbols times k as k -> infinity: the half-space under short waves
  ResponseScales scales_;                      // the thickness is the unit of the tables' distances
  std::shared_ptr<const RadialTable> radial_;  // of a sphere; none for a half-space
  std::shared_ptr<const LineTable> line_;      // of a cylinder,
  std::shared_ptr<const LineSlopes> slopes_;   // instead, where cells are short against the layer
  std::vector<double> nodes_x_, weights_x_, nodes_y_, weights_y_;  // average of the correction over the cell
};

}  // namespace rollres
