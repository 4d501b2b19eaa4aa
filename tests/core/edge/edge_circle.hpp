#pragma once

/// A circle of contact that cuts through the cells of a grid, for tests.

#include <algorithm>
#include <cmath>

#include "core/edge/edge_curve.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"
#include "tests/infinite.hpp"

/// A sphere of radius 1 on an elastic half-space of modulus 1.
inline rollres::RollingScene on_half_space(double poisson_ratio) {
  rollres::RollingScene scene;
  scene.indenter = rollres::Indenter::sphere;
  scene.radius = 1;
  scene.layer_thickness = infinite;
  scene.poisson_ratio = poisson_ratio;
  scene.material = rollres::MaterialModel::elastic;
  scene.static_shear_modulus = 1;
  scene.speed = 1;
  scene.load = 1;
  return scene;
}

/// Its centre lies beside the nodes: semi-axes of 12.3 cells, unless told.
struct Circle {
  double radius = 12.3, centre = 0.37;  // [cells]
  rollres::SurfaceGrid half;

  explicit Circle(double spacing, double cells = 12.3) : radius(cells) {
    const int reach = static_cast<int>(cells) + 5;
    half.spacing_x = half.spacing_y = spacing;
    half.first_column = -reach;
    half.columns = 2 * reach + 2;
    half.rows = reach;
    half.folded = true;
  }
  double level(double column, double row) const {  // F in cells^2
    return radius * radius - (column - centre) * (column - centre) - row * row;
  }
  /// Mean over the cell of a node of sqrt(F) times what a function says of place [cells].
  template <class Function>
  double mean(int column, int row, const Function& function) const {
    constexpr int parts = 60;
    double sum = 0;
    for (int j = 0; j < parts; ++j)
      for (int i = 0; i < parts; ++i) {
        const double x = half.first_column + column + (i + 0.5) / parts - 0.5, y = row + (j + 0.5) / parts - 0.5;
        sum += std::sqrt(std::max(0.0, level(x, y))) * function(x, y);
      }
    return sum / (parts * parts);
  }
  double mean(int column, int row) const {
    return mean(column, row, [](double, double) { return 1.0; });
  }
  rollres::EdgeCurve curve() const {
    const double a = half.spacing_x;
    rollres::EdgeCurve curve{radius * a, rollres::Vector::Constant(1, centre * a), rollres::Vector(2)};
    curve.squared_length << radius * radius * a * a, -radius * radius * a * a;
    return curve;
  }
};
