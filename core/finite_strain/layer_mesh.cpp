#include "core/finite_strain/layer_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

/// Cells further from the contact are so much larger, for each unit of distance.
constexpr double growth_along = 0.35, growth_down = 0.5;
/// The first row of cells over the mean length of cells in the contact.
constexpr double first_row = 0.5;
/// Thicknesses of all layers that the mesh goes beyond the contact: there stresses have decayed.
constexpr double reach = 10;
/// Of half the circumference, where a cover's mesh ends at the latest.
constexpr double around = 0.97;

/// Borders from 0 to `length` of cells that begin with `first` and grow with the distance from `origin` before 0.
std::vector<double> growing(double length, double first, double growth, double origin = 0) {
  const double near = std::log1p(growth * origin / first), far = std::log1p(growth * (origin + length) / first);
  const double step = std::log1p(growth);
  const int cells = std::max(1, checked_count(std::ceil((far - near) / step), "cells of the mesh"));
  std::vector<double> borders;
  for (int k = 0; k <= cells; ++k)
    borders.push_back(std::expm1(near + (far - near) * k / cells) * first / growth - origin);
  borders.front() = 0;
  borders.back() = length;
  return borders;
}

}  // namespace

double LayerMesh::node_x(int column) const {
  const auto e = static_cast<std::size_t>(column / 2);
  return column % 2 == 0 ? x[e] : 0.5 * (x[e] + x[e + 1]);
}

double LayerMesh::node_z(int row) const {
  const auto r = static_cast<std::size_t>(row / 2);
  return row % 2 == 0 ? z[r] : 0.5 * (z[r] + z[r + 1]);
}

Eigen::Vector2d LayerMesh::rest(double along, double depth) const {
  if (curvature == 0) return {along, depth};
  const double angle = along * curvature, half = std::sin(0.5 * angle);
  // The axis lies at (0, -1/curvature).
  return {shortening(depth) / curvature * std::sin(angle), depth - 2 * shortening(depth) / curvature * half * half};
}

Eigen::Matrix2d LayerMesh::frame(double along) const {
  const double angle = along * curvature;
  Eigen::Matrix2d columns;
  columns << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
  return columns;
}

double LayerMesh::share(int column) const {
  const int e = column / 2;
  if (column % 2 == 1) return length(e) * 2 / 3;
  return ((e > 0 ? length(e - 1) : 0) + (e < cells_along() ? length(e) : 0)) / 6;
}

LayerMesh layer_mesh(const MeshWishes& wishes) {
  LayerMesh mesh;
  mesh.curvature = wishes.curvature;
  const double half = 0.5 * (wishes.leading - wishes.trailing), middle = 0.5 * (wishes.leading + wishes.trailing);
  const double thickness = std::accumulate(wishes.thicknesses.begin(), wishes.thicknesses.end(), 0.0);
  const double edge_cell = half * (1 - std::cos(std::numbers::pi / wishes.cells));
  const double turn = around * std::numbers::pi / wishes.curvature - std::max(wishes.leading, -wishes.trailing);
  const std::vector<double> beyond =
      growing(std::max(std::min(reach * thickness + half, turn), edge_cell), edge_cell, growth_along);
  for (auto it = beyond.rbegin(); it != beyond.rend(); ++it) mesh.x.push_back(wishes.leading + *it);
  for (int k = 1; k < wishes.cells; ++k)
    mesh.x.push_back(middle + half * std::cos(std::numbers::pi * k / wishes.cells));
  for (const double distance : beyond) mesh.x.push_back(wishes.trailing - distance);

  const double first = first_row * 2 * half / wishes.cells;
  double depth = 0;
  mesh.z.push_back(0);
  for (std::size_t i = 0; i < wishes.thicknesses.size(); ++i) {
    const std::vector<double> borders = growing(wishes.thicknesses[i], first, growth_down, depth);
    for (std::size_t k = 1; k < borders.size(); ++k) {
      mesh.z.push_back(-depth - borders[k]);
      mesh.layer.push_back(static_cast<int>(i));
    }
    depth += wishes.thicknesses[i];
  }
  return mesh;
}

}  // namespace rollres
