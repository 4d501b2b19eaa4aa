#include "core/edge/contact_edge.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "core/surface/contact_surface.hpp"

namespace rollres {

namespace {

/// A polynomial's value and derivative.
std::pair<double, double> polynomial(const Vector& coefficients, double t) {
  double value = 0, slope = 0;
  for (Eigen::Index k = coefficients.size(); k-- > 0;) {
    slope = slope * t + value;
    value = value * t + coefficients(k);
  }
  return {value, slope};
}

/// F = h^2 - (x - m)^2 along x, at one y.
struct CurveRow {
  double centre, squared, centre_slope, squared_slope;

  CurveRow(const EdgeCurve& curve, double y) {
    const double t = y / curve.unit, by_y = 2 * t / curve.unit;
    std::tie(centre, centre_slope) = polynomial(curve.centre, t * t);
    std::tie(squared, squared_slope) = polynomial(curve.squared_length, t * t);
    centre_slope *= by_y;
    squared_slope *= by_y;
  }
  double level(double x) const { return squared - (x - centre) * (x - centre); }
  double along(double x) const { return -2 * (x - centre); }                         // dF/dx
  double across(double x) const { return squared_slope - along(x) * centre_slope; }  // dF/dy
  double steepness(double x) const { return std::hypot(along(x), across(x)); }
  /// int sqrt(F) dx, over what lies in the contact.
  double sum_of_root(double from, double to) const {
    if (!(squared > 0)) return 0;
    const auto primitive = [this](double x) {
      const double s = std::clamp((x - centre) / std::sqrt(squared), -1.0, 1.0);
      return 0.5 * squared * (std::asin(s) + s * std::sqrt(1 - s * s));
    };
    return primitive(to) - primitive(from);
  }
};

/// Distance, in cells, of the zero of p^2 beyond the first of three neighbouring cells.
double zero_beyond(double first, double second, double third) {
  const double q0 = first * first, q1 = second * second, q2 = third * third;
  const double slope = 1.5 * q0 - 2 * q1 + 0.5 * q2, bend = 0.5 * q0 - q1 + 0.5 * q2;
  const double root = slope * slope - 4 * bend * q0;
  return slope < 0 && root >= 0 ? 2 * q0 / (-slope + std::sqrt(root)) : RollingSolution::absent;
}

}  // namespace

std::vector<RowEnds> ends_of_rows(const SurfaceGrid& grid, const Vector& pressure) {
  std::vector<RowEnds> ends;
  constexpr int left_out = 2, fewest = 2 * (left_out + 3);  // cells at an end whose pressure knows of the grid
  constexpr double furthest = left_out + 2;
  for (int row = 0; row < grid.rows; ++row) {
    const auto cells = pressure.segment(grid.index(0, row), grid.columns);
    int first = 0, last = grid.columns - 1;
    while (first < grid.columns && !(cells(first) > 0)) ++first;
    while (last >= 0 && !(cells(last) > 0)) --last;
    if (last - first + 1 < fewest) continue;
    const auto beyond = [&](int end, int inwards) {
      const int from = end + left_out * inwards;
      return zero_beyond(cells(from), cells(from + inwards), cells(from + 2 * inwards));
    };
    const double ahead = beyond(last, -1), behind = beyond(first, 1);
    if (ahead < furthest && behind < furthest)
      ends.push_back({grid.y(row), grid.x(first + left_out) - behind * grid.spacing_x,
                      grid.x(last - left_out) + ahead * grid.spacing_x});
  }
  return ends;
}

namespace {

constexpr int parts = 4;  // of a cell, along each side

/// sqrt(F) over the parts of a cell [m].
struct CellShape {
  std::array<double, parts * parts> part{};  // each over the number of parts; x fastest
  double mean = 0;                           // over the cell: their sum
};

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

constexpr int reach = 2;  // cells, beyond which an uneven cell acts as an even one

/// Of the parts of a cell on targets up to a cell beyond `reach`.
class PartReaches {
 public:
  explicit PartReaches(const SurfaceGrid& grid) {
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
  /// Of a cell with the shape times `of_shape` plus an even traction, on the target so many columns and rows from it.
  Reach operator()(const CellShape& shape, double of_shape, double even, int column, int row, bool image) const {
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

}  // namespace

EdgeCurve edge_curve(const SurfaceGrid& grid, const Vector& pressure) {
  const std::vector<RowEnds> ends = ends_of_rows(grid, pressure);
  const auto rows = static_cast<Eigen::Index>(ends.size());
  constexpr Eigen::Index fewest = 4, most_terms = 5;
  if (rows < fewest) return {};
  EdgeCurve curve;
  curve.unit = ends.back().y;
  const Eigen::Index terms = std::min(most_terms, (rows + 1) / 3 + 1);
  Eigen::MatrixXd powers(rows, terms);
  Vector centre(rows), squared(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const RowEnds& end = ends[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < terms; ++k) powers(i, k) = std::pow(end.y / curve.unit, 2 * k);
    centre(i) = 0.5 * (end.leading + end.trailing);
    squared(i) = 0.25 * std::pow(end.leading - end.trailing, 2);
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> fit(powers);
  curve.centre = fit.solve(centre);
  curve.squared_length = fit.solve(squared);
  return curve;
}

namespace {

/// The cells at the edge and what they do.
class EdgeAssembly {
 public:
  EdgeAssembly(const RollingScene& scene, const SurfaceGrid& grid, const EdgeCurve& curve,
               const std::vector<char>& in_contact)
      : grid_(grid), in_contact_(in_contact), reaches_(grid), place_(static_cast<std::size_t>(grid.size()), absent) {
    // The half-space that waves of a few cells see.
    const SteadySurface surface(scene);
    const SurfaceCompliance near = surface.half_spaces(surface.moduli(1 / grid.spacing_x));
    in_plane_ = near.longitudinal.real();
    more_across_ = near.transverse.real() - in_plane_;
    for (int row = 0; row < grid.rows; ++row) rows_.emplace_back(curve, grid.y(row));
    find_cells(curve);
    share_out_cells_beyond();
  }

  /// @param add takes target, source, xx, xy, yx, yy
  template <class Add>
  void uneven_cells(const Add& add) const {
    const double per = 1 / (2 * M_PI * grid_.spacing_x);
    for (const EdgeCell& cell : cells_)
      for (const bool image : {false, true}) {
        if (!loaded(cell.column, cell.row) || (image && cell.row == 0)) continue;
        const int from = image ? -cell.row : cell.row;
        const double parity = image ? -1 : 1;
        for (int row = std::max(0, from - reach); row <= std::min(grid_.rows - 1, from + reach); ++row) {
          Reach ahead;  // none beyond `reach`, so that all slips together are none
          for (int column = cell.column + reach; column >= cell.column - reach - 1; --column) {
            const Reach here = column < cell.column - reach ? Reach() : unevenness(cell, column, row, image);
            Reach slope = ahead;
            slope.add(-1, here);
            ahead = here;
            if (!loaded(column, row)) continue;
            const double even = in_plane_ * slope.over_r, cross = more_across_ * slope.xy;
            add(grid_.index(column, row), grid_.index(cell.column, cell.row), per * (even + more_across_ * slope.xx),
                per * parity * cross, per * cross, per * parity * (even + more_across_ * (slope.over_r - slope.xx)));
          }
        }
      }
  }

  template <class Add>
  void surface_ahead(const Add& add) const {
    for (const EdgeCell& cell : cells_) {
      const CurveRow& row = rows_[static_cast<std::size_t>(cell.row)];
      const double x = grid_.x(cell.column);
      if (!loaded(cell.column, cell.row) || x < row.centre || row.level(x + grid_.spacing_x) >= 0) continue;
      const Lifted here = lifted(row, x), next = lifted(row, x + grid_.spacing_x);
      const double xx = here.xx - next.xx, xy = here.xy - next.xy, yy = here.yy - next.yy;
      // As the traction over sqrt(F) of this cell and of the next one behind says.
      const EdgeCell* const behind = loaded(cell.column - 1, cell.row) ? cell_at(cell.column - 1, cell.row) : nullptr;
      const double of_behind = behind ? behind->borne : 0;
      // In a row that the contact just touches there is none behind, and what little lies in this one tells nothing.
      constexpr double told = 0.05;  // of sqrt(F) a cell inside of the edge
      const double inside = std::abs(row.along(x + grid_.spacing_x)) * grid_.spacing_x;
      const double squares = std::max(cell.borne * cell.borne + of_behind * of_behind, told * told * inside);
      const Eigen::Index node = grid_.index(cell.column, cell.row);
      const auto from = [&](Eigen::Index source, double mean) {
        const double per = mean / (squares * grid_.spacing_x);
        add(node, source, per * xx, per * xy, per * xy, per * yy);
      };
      from(node, cell.borne);
      if (behind) from(node - 1, of_behind);
    }
  }

 private:
  static constexpr int absent = -1;

  bool loaded(int column, int row) const {
    return column >= 0 && column < grid_.columns && row >= 0 && row < grid_.rows &&
           in_contact_[static_cast<std::size_t>(grid_.index(column, row))] != 0;
  }
  const EdgeCell* cell_at(int column, int row) const {
    if (column < 0 || column >= grid_.columns || row < 0 || row >= grid_.rows) return nullptr;
    const int at = place_[static_cast<std::size_t>(grid_.index(column, row))];
    return at == absent ? nullptr : &cells_[static_cast<std::size_t>(at)];
  }

  void find_cells(const EdgeCurve& curve) {
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

  /// How many cells stand for one beyond that this one bears: on the axis of symmetry also its mirror image.
  static int images_on(const EdgeCell& bearer) { return bearer.row == 0 ? 2 : 1; }

  /// A cell that is partly in the contact and not loaded leaves its part to its neighbours.
  void share_out_cells_beyond() {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (loaded(cells_[i].column, cells_[i].row)) continue;
      std::vector<EdgeCell*> bearers;
      for (const auto& [columns, rows] : {std::pair{-1, 0}, std::pair{1, 0}, std::pair{0, -1}, std::pair{0, 1}}) {
        const int column = cells_[i].column + columns, row = cells_[i].row + rows;
        if (loaded(column, row) && cell_at(column, row)) bearers.push_back(const_cast<EdgeCell*>(cell_at(column, row)));
      }
      for (EdgeCell* const bearer : bearers) {
        const double share = 1.0 / static_cast<double>(bearers.size());
        bearer->borne += (bearer->row == cells_[i].row ? 1 : images_on(*bearer)) * share * cells_[i].shape.mean;
        bearer->beyond.emplace_back(i, share);
      }
    }
  }

  /// What a unit traction of a cell does at a node more than an even one.
  Reach unevenness(const EdgeCell& cell, int column, int row, bool image) const {
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

  /// (N26) for tractions sqrt(F) [m/Pa].
  struct Lifted {
    double xx = 0, xy = 0, yy = 0;
  };
  Lifted lifted(const CurveRow& row, double x) const {
    if (row.level(x) >= 0) return {};
    const double steep = row.steepness(x), n_x = row.along(x) / steep, n_y = row.across(x) / steep;
    const double amount = 2.0 / 3 * std::pow(-row.level(x), 1.5) / steep;
    return {amount * (in_plane_ + more_across_ * n_y * n_y), -amount * more_across_ * n_x * n_y,
            amount * (in_plane_ + more_across_ * n_x * n_x)};
  }

  const SurfaceGrid& grid_;
  const std::vector<char>& in_contact_;
  PartReaches reaches_;
  std::vector<int> place_;  // of a node's cell among those at the edge
  double in_plane_ = 0, more_across_ = 0;
  std::vector<CurveRow> rows_;
  std::vector<EdgeCell> cells_;
};

}  // namespace

EdgeSlip::EdgeSlip(const RollingScene& scene, const SurfaceGrid& half, const EdgeCurve& curve,
                   const std::vector<char>& in_contact) {
  constexpr double coarsest = 9;  // rows; steps on coarser grids do not always converge
  if (!curve.known() || curve.unit < coarsest * half.spacing_y) return;
  curve_ = curve;
  const EdgeAssembly assembly(scene, half, curve, in_contact);
  const auto add = [this](Eigen::Index target, Eigen::Index source, double xx, double xy, double yx, double yy) {
    terms_.push_back({target, source, xx, xy, yx, yy});
  };
  assembly.uneven_cells(add);
  assembly.surface_ahead(add);
}

}  // namespace rollres
