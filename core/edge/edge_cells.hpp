#pragma once

/// The cells at the edge of a sphere's contact: how tractions like sqrt(F) are spread over them, and what that moves
/// (core/newton/README.md, section 8).

#include <array>
#include <utility>
#include <vector>

#include "core/edge/edge_curve.hpp"
#include "core/numerics/vector.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

constexpr int parts = 4;  // of a cell, along each side

/// sqrt(F) over the parts of a cell [m].
struct CellShape {
  std::array<double, parts * parts> part{};  // each over the number of parts; x fastest
  double mean = 0;                           // over the cell: their sum
};

/// Integrals of 1/r, x^2/r^3 and x y/r^3 over a source, x and y its distances from a target [m].
struct Reach {
  double over_r = 0, xx = 0, xy = 0;

  Reach& add(double factor, const Reach& other) {
    over_r += factor * other.over_r;
    xx += factor * other.xx;
    xy += factor * other.xy;
    return *this;
  }
};

/// Of a rectangle, by its sides' distances from the target [m].
Reach of_rectangle(double left, double right, double low, double high);

constexpr int reach = 2;  // cells, beyond which an uneven cell acts as an even one

/// Of the parts of a cell on targets up to a cell beyond `reach`.
class PartReaches {
 public:
  explicit PartReaches(const SurfaceGrid& grid);
  /// Of a cell with the shape times `of_shape` plus an even traction, on the target so many columns and rows from it.
  Reach operator()(const CellShape& shape, double of_shape, double even, int column, int row, bool image) const;

 private:
  static constexpr int most = reach + 1, side = 2 * most + 1;
  static std::size_t index(int column, int row) {
    return static_cast<std::size_t>(((row + most) * side + column + most) * parts * parts);
  }
  std::array<Reach, side * side * parts * parts> table_;
};

/// A cell in contact at the edge, or one outside whose part of the contact its neighbours bear.
struct EdgeCell {
  int column, row;
  CellShape shape;
  double borne = 0;                                         // mean of sqrt(F) with what it bears of others [m]
  std::vector<std::pair<std::size_t, double>> beyond = {};  // those others, and the share of each
};

/// Those within three cells of an edge, and all that F > 0 touches outside.
class EdgeCells {
 public:
  /// @param loaded a flag for each node: those whose cells bear tractions; kept by reference, as the grid is
  EdgeCells(const SurfaceGrid& grid, const EdgeCurve& curve, const std::vector<char>& loaded);

  const std::vector<EdgeCell>& all() const { return cells_; }
  /// Whether a node bears tractions; none outside the grid does.
  bool loaded(int column, int row) const;
  /// None where the node's cell is not at the edge.
  const EdgeCell* at(int column, int row) const;
  const CurveRow& row(int row) const { return rows_[static_cast<std::size_t>(row)]; }
  /// What a unit traction of a cell, spread like sqrt(F), does at a node more than an even one.
  /// @param image of the cell's mirror image at y < 0
  Reach unevenness(const EdgeCell& cell, int column, int row, bool image) const;
  /// Whether a cell has a mirror image that acts, too.
  bool mirrored(const EdgeCell& cell) const { return grid_.images(cell.row) > 1; }
  /// How many cells stand for one beyond that this one bears: on an axis of symmetry also its mirror image.
  int images_on(const EdgeCell& bearer) const { return grid_.folded && bearer.row == 0 ? 2 : 1; }

 private:
  static constexpr int absent = -1;
  void find(const EdgeCurve& curve);
  void share_out();

  const SurfaceGrid& grid_;
  const std::vector<char>& loaded_;
  PartReaches reaches_;
  std::vector<int> place_;  // of a node's cell among those at the edge
  std::vector<CurveRow> rows_;
  std::vector<EdgeCell> cells_;
};

}  // namespace rollres
