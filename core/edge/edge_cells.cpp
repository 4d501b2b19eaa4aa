#include "core/edge/edge_cells.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace rollres {

namespace {

CellShape cell_shape(const EdgeCurve& curve, const SurfaceGrid& grid, int column, int row) {
  CellShape shape;
  const double width = grid.spacing_x / parts, left = grid.x(column) - 0.5 * grid.spacing_x;
  for (int j = 0; j < parts; ++j)
    for (const double place : {-0.5 / std::sqrt(3.0), 0.5 / std::sqrt(3.0)}) {  // Gauss's rule in y
      const CurveRow at(curve, grid.y(row) + ((j + 0.5 + place) / parts - 0.5) * grid.spacing_y);
      for (int i = 0; i < parts; ++i) {
        const double value = 0.5 * at.sum_of_root(left + i * width, left + (i + 1) * width) / (width * parts * parts);
        shape.part[static_cast<std::size_t>(j * parts + i)] += value;
        shape.mean += value;
      }
    }
  return shape;
}

}  // namespace

Reach of_rectangle(double left, double right, double low, double high) {
  Reach sum;
  for (const auto& [x, sign_x] : {std::pair{left, -1.0}, std::pair{right, 1.0}})
    for (const auto& [y, sign_y] : {std::pair{low, -1.0}, std::pair{high, 1.0}}) {
      const double along = x == 0 ? 0 : x * std::asinh(y / std::abs(x));
      const double across = y == 0 ? 0 : y * std::asinh(x / std::abs(y));
      sum.add(sign_x * sign_y, {along + across, across, -std::hypot(x, y)});
    }
  return sum;
}

PartReaches::PartReaches(const SurfaceGrid& grid) {
  const double width = grid.spacing_x / parts, height = grid.spacing_y / parts;
  for (int row = -most; row <= most; ++row)
    for (int column = -most; column <= most; ++column)
      for (int j = 0; j < parts; ++j)
        for (int i = 0; i < parts; ++i) {
          const double x = i * width - (0.5 + column) * grid.spacing_x, y = j * height - (0.5 + row) * grid.spacing_y;
          table_[index(column, row) + static_cast<std::size_t>(j * parts + i)] =
              of_rectangle(x, x + width, y, y + height);
        }
}

Reach PartReaches::operator()(const CellShape& shape, double of_shape, double even, int column, int row,
                              bool image) const {
  Reach sum;
  if (std::abs(column) > most || std::abs(row) > most) return sum;
  const std::span part(table_.data() + index(column, row), parts * parts);
  for (int j = 0; j < parts; ++j)
    for (int i = 0; i < parts; ++i) {
      const double mean = shape.part[static_cast<std::size_t>((image ? parts - 1 - j : j) * parts + i)];
      sum.add(of_shape * mean * parts * parts + even, part[static_cast<std::size_t>(j * parts + i)]);
    }
  return sum;
}

EdgeCells::EdgeCells(const SurfaceGrid& grid, const EdgeCurve& curve, const std::vector<char>& loaded)
    : grid_(grid), loaded_(loaded), reaches_(grid), place_(static_cast<std::size_t>(grid.size()), absent) {
  for (int row = 0; row < grid.rows; ++row) rows_.emplace_back(curve, grid.y(row));
  find(curve);
  share_out();
}

bool EdgeCells::loaded(int column, int row) const {
  return column >= 0 && column < grid_.columns && row >= 0 && row < grid_.rows &&
         loaded_[static_cast<std::size_t>(grid_.index(column, row))] != 0;
}

const EdgeCell* EdgeCells::at(int column, int row) const {
  if (column < 0 || column >= grid_.columns || row < 0 || row >= grid_.rows) return nullptr;
  const int place = place_[static_cast<std::size_t>(grid_.index(column, row))];
  return place == absent ? nullptr : &cells_[static_cast<std::size_t>(place)];
}

void EdgeCells::find(const EdgeCurve& curve) {
  constexpr double inside = 3, outside = 1.5;  // cells from the edge
  const double spacing = std::max(grid_.spacing_x, grid_.spacing_y);
  for (int row = 0; row < grid_.rows; ++row)
    for (int column = 0; column < grid_.columns; ++column) {
      const CurveRow& at = rows_[static_cast<std::size_t>(row)];
      const double x = grid_.x(column), limit = at.steepness(x) * spacing;
      if (at.level(x) > inside * limit || at.level(x) < -outside * limit) continue;
      const CellShape shape = cell_shape(curve, grid_, column, row);
      if (!(shape.mean > 0)) continue;
      place_[static_cast<std::size_t>(grid_.index(column, row))] = static_cast<int>(cells_.size());
      cells_.push_back({column, row, shape, shape.mean});
    }
}

/// A cell that is partly in the contact and not loaded leaves its part to its neighbours.
void EdgeCells::share_out() {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (loaded(cells_[i].column, cells_[i].row)) continue;
    std::vector<std::size_t> bearers;
    for (const auto& [columns, rows] : {std::pair{-1, 0}, std::pair{1, 0}, std::pair{0, -1}, std::pair{0, 1}}) {
      const int column = cells_[i].column + columns, row = cells_[i].row + rows;
      if (loaded(column, row) && at(column, row))
        bearers.push_back(static_cast<std::size_t>(at(column, row) - cells_.data()));
    }
    for (const std::size_t at : bearers) {
      EdgeCell& bearer = cells_[at];
      const double share = 1.0 / static_cast<double>(bearers.size());
      bearer.borne += (bearer.row == cells_[i].row ? 1 : images_on(bearer)) * share * cells_[i].shape.mean;
      bearer.beyond.emplace_back(i, share);
    }
  }
}

Reach EdgeCells::unevenness(const EdgeCell& cell, int column, int row, bool image) const {
  const int sign = image ? -1 : 1;
  Reach sum = reaches_(cell.shape, 1 / cell.borne, -1, column - cell.column, row - sign * cell.row, image);
  for (const auto& [i, share] : cell.beyond) {
    const EdgeCell& other = cells_[i];
    const auto add = [&](int side, bool mirror) {
      sum.add(1, reaches_(other.shape, share / cell.borne, 0, column - other.column, row - side * other.row, mirror));
    };
    add(sign, image);
    if (other.row != cell.row && images_on(cell) > 1) add(-sign, !image);
  }
  return sum;
}
}  // namespace rollres
