#include "core/edge/edge_pressure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/model/contact_surface.hpp"

namespace rollres {

namespace {

/// Weights of a cell and its eight neighbours: x fastest, from -1 to 1.
struct Stencil {
  std::array<double, 9> weights{};
  double& operator()(int column, int row) { return weights[static_cast<std::size_t>(3 * (row + 1) + column + 1)]; }
  double operator()(int column, int row) const { return weights[static_cast<std::size_t>(3 * (row + 1) + column + 1)]; }
};

/// First and second moments of a traction of unit force about a node, less those of an even cell [cells, cells^2].
struct Moments {
  double x = 0, y = 0, xx = -1.0 / 12, yy = -1.0 / 12, xy = 0;

  /// Adds a shape times a factor, so many columns and rows from the node, or its mirror image.
  void add(const CellShape& shape, double factor, int columns, int rows, bool image) {
    constexpr double of_part = 1.0 / (12 * parts * parts);
    for (int j = 0; j < parts; ++j)
      for (int i = 0; i < parts; ++i) {
        const double force = factor * shape.part[static_cast<std::size_t>(j * parts + i)];
        const double along = columns + (i + 0.5) / parts - 0.5, over = (j + 0.5) / parts - 0.5;
        const double across = rows + (image ? -over : over);
        x += force * along;
        y += force * across;
        xx += force * (along * along + of_part);
        yy += force * (across * across + of_part);
        xy += force * along * across;
      }
  }
  /// Even cells that have them.
  Stencil stencil() const {
    Stencil s;
    for (const int side : {-1, 1}) {
      s(side, 0) += 0.5 * (xx + side * x);
      s(0, side) += 0.5 * (yy + side * y);
      for (const int other : {-1, 1}) s(side, other) += 0.25 * side * other * xy;
    }
    s(0, 0) -= xx + yy;
    return s;
  }
};

}  // namespace

class EdgePressure::Assembly {
 public:
  Assembly(const ContactModel& model, const SurfaceGrid& grid, const EdgeCurve& curve, const std::vector<char>& inside,
           EdgePressure& result)
      : grid_(grid), cells_(grid, curve, inside), result_(result) {
    const SteadySurface surface = steady_surface(model);
    compliance_ = surface.half_spaces(surface.moduli(1 / grid.spacing_x)).normal.real();
    for (int row = -furthest; row <= furthest; ++row)
      for (int column = -furthest; column <= furthest; ++column) {
        const double x = -column * grid.spacing_x, y = -row * grid.spacing_y;
        even_.push_back(of_rectangle(x - 0.5 * grid.spacing_x, x + 0.5 * grid.spacing_x, y - 0.5 * grid.spacing_y,
                                     y + 0.5 * grid.spacing_y)
                            .over_r);
      }
  }

  void run() {
    result_.own_ = Vector::Ones(grid_.size());
    for (const Eigen::Index node : result_.contact_) {
      const int column = static_cast<int>(node % grid_.columns), row = static_cast<int>(node / grid_.columns);
      spread(node, row, node, 1, {0, 0});
      const EdgeCell* const cell = cells_.at(column, row);
      if (cell) {
        result_.own_(node) = cell->shape.mean / cell->borne;
        add_edge_cell(*cell, node);
      }
      add_gradient(column, row, node);
    }
  }

 private:
  static constexpr int furthest = reach + 1;

  struct Offset {
    int columns, rows;
  };

  /// A share of the pressure of `source` for the cell beside a node; rows y < 0 are mirror images.
  void spread(Eigen::Index node, int row, Eigen::Index source, double value, Offset beside) {
    const int target_row = row + beside.rows;
    if (target_row < 0) return;  // the image of what goes to the other side
    const double images = target_row == 0 && row > 0 ? 2 : 1;
    result_.spread_.push_back(
        {node + beside.columns + static_cast<Eigen::Index>(beside.rows) * grid_.columns, source, images * value});
  }

  void add_edge_cell(const EdgeCell& cell, Eigen::Index node) {
    Moments moments;
    moments.add(cell.shape, 1 / cell.borne, 0, 0, false);
    for (const auto& [i, share] : cell.beyond) {
      const EdgeCell& other = cells_.all()[i];
      const int columns = other.column - cell.column, rows = other.row - cell.row;
      moments.add(other.shape, share / cell.borne, columns, rows, false);
      if (rows != 0 && cells_.images_on(cell) > 1) moments.add(other.shape, share / cell.borne, columns, -rows, true);
    }
    const Stencil stencil = moments.stencil();
    for (int row = -1; row <= 1; ++row)
      for (int column = -1; column <= 1; ++column) spread(node, cell.row, node, stencil(column, row), {column, row});

    const double per = -compliance_ / (2 * M_PI);
    for (const bool image : {false, true}) {
      if (image && cell.row == 0) continue;
      const int sign = image ? -1 : 1, from = sign * cell.row;
      for (int row = std::max(0, from - reach); row <= std::min(grid_.rows - 1, from + reach); ++row)
        for (int column = cell.column - reach; column <= cell.column + reach; ++column) {
          if (!cells_.loaded(column, row)) continue;
          double more = cells_.unevenness(cell, column, row, image).over_r;
          for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) more -= stencil(i, j) * even(column - cell.column - i, row - from - sign * j);
          result_.near_.push_back({grid_.index(column, row), node, per * more});
        }
    }
  }

  /// The moment of what varies over a cell, at the edge beside the root, by central differences.
  void add_gradient(int column, int row, Eigen::Index node) {
    const bool at_edge = cells_.at(column, row) != nullptr;
    const double here = (at_edge ? root(column, row).own : 1) / 12;
    const auto along = [&](Offset step) {
      Offset ahead = step, behind{-step.columns, -step.rows};
      double span = 2;
      if (!cells_.loaded(column + ahead.columns, row + ahead.rows)) {
        ahead = {0, 0};
        --span;
      }
      if (!cells_.loaded(column + behind.columns, row + behind.rows)) {
        behind = {0, 0};
        --span;
      }
      if (span == 0) return;
      for (const auto& [offset, sign] : {std::pair{ahead, 1.0}, std::pair{behind, -1.0}}) {
        const int at_column = column + offset.columns, at_row = row + offset.rows;
        const Root there = root(at_column, at_row);
        const double moment = sign * here / span * (at_edge ? 1 : there.own) / there.borne;
        const Eigen::Index source = grid_.index(at_column, at_row);
        spread(node, row, source, 0.5 * moment, step);
        spread(node, row, source, -0.5 * moment, {-step.columns, -step.rows});
      }
    };
    along({1, 0});
    if (row > 0) along({0, 1});
  }

  /// sqrt(F) of a cell, its own and with what it bears [m].
  struct Root {
    double own, borne;
  };
  Root root(int column, int row) const {
    const EdgeCell* const cell = cells_.at(column, row);
    if (cell) return {cell->shape.mean, cell->borne};
    const double value = std::sqrt(cells_.row(row).level(grid_.x(column)));
    return {value, value};
  }

  double even(int columns, int rows) const {
    constexpr int side = 2 * furthest + 1;
    return even_[static_cast<std::size_t>((rows + furthest) * side + columns + furthest)];
  }

  const SurfaceGrid& grid_;
  EdgeCells cells_;
  EdgePressure& result_;
  double compliance_;         // of the half-space that waves of a few cells see [1/Pa]
  std::vector<double> even_;  // integrals of 1/r over even cells [m]
};

EdgePressure::EdgePressure(const ContactModel& model, const SurfaceGrid& grid, const EdgeCurve& curve) {
  std::vector<char> inside(static_cast<std::size_t>(grid.size()));
  for (int row = 0; row < grid.rows; ++row) {
    if (grid.y(row) > curve.unit) break;
    const CurveRow at(curve, grid.y(row));
    for (int column = 0; column < grid.columns; ++column) {
      if (!(at.level(grid.x(column)) > 0)) continue;
      inside[static_cast<std::size_t>(grid.index(column, row))] = 1;
      contact_.push_back(grid.index(column, row));
      if (column == 0 || column == grid.columns - 1 || row == grid.rows - 1) fits_ = false;
    }
  }
  if (contact_.empty()) fits_ = false;
  if (fits_) Assembly(model, grid, curve, inside, *this).run();
}

}  // namespace rollres
