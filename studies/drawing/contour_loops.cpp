#include "studies/drawing/contour_loops.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

namespace rollres {

namespace {

using Point = std::array<double, 2>;

/// Loops of one level. The grid is framed by nodes that lie on its border and bear the value outside.
class LevelLoops {
 public:
  LevelLoops(const PlaneField& field, double level, double outside)
      : field_(field), level_(level), outside_(outside), columns_(field.x.size() + 2), rows_(field.y.size() + 2) {}

  void add_to(std::vector<ContourLoop>& loops) {
    for (std::size_t row = 0; row + 1 < rows_; ++row)
      for (std::size_t column = 0; column + 1 < columns_; ++column) join_in_cell(column, row);
    while (!next_.empty()) {
      ContourLoop loop{.level = level_, .higher_inside = false, .area = 0, .points = {}};
      for (auto edge = next_.begin(); edge != next_.end();) {
        const Point point = crossing(edge->first);
        if (loop.points.empty() || point != loop.points.back()) loop.points.push_back(point);
        const std::size_t to = edge->second;
        next_.erase(edge);
        edge = next_.find(to);
      }
      const double area = signed_area(loop.points);
      if (area == 0) continue;
      loop.higher_inside = area > 0;
      loop.area = std::abs(area);
      loops.push_back(std::move(loop));
    }
  }

 private:
  double value(std::size_t column, std::size_t row) const {
    const bool frame = column == 0 || row == 0 || column == columns_ - 1 || row == rows_ - 1;
    return frame ? outside_ : field_.at(column - 1, row - 1);
  }
  bool high(std::size_t column, std::size_t row) const { return value(column, row) >= level_; }
  Point place(std::size_t column, std::size_t row) const {
    return {field_.x[std::clamp<std::size_t>(column, 1, columns_ - 2) - 1],
            field_.y[std::clamp<std::size_t>(row, 1, rows_ - 2) - 1]};
  }

  /// Edges are numbered by their lower left node: even along x, odd along y.
  std::size_t edge_along_x(std::size_t column, std::size_t row) const { return 2 * (row * columns_ + column); }
  std::size_t edge_along_y(std::size_t column, std::size_t row) const { return edge_along_x(column, row) + 1; }

  Point crossing(std::size_t edge) const {
    const std::size_t column = edge / 2 % columns_, row = edge / 2 / columns_;
    const std::size_t along_y = edge % 2, along_x = 1 - along_y;
    const Point from = place(column, row), to = place(column + along_x, row + along_y);
    const double a = value(column, row), b = value(column + along_x, row + along_y);
    const double share = std::isfinite(a) && std::isfinite(b) ? (level_ - a) / (b - a) : 0;  // infinite: at the border
    return {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
  }

  /// Joins the crossings on a cell's edges, the higher side on the left.
  void join_in_cell(std::size_t column, std::size_t row) {
    // Corners and the edges that leave them, counterclockwise.
    const std::array<std::array<std::size_t, 2>, 4> corners{
        {{column, row}, {column + 1, row}, {column + 1, row + 1}, {column, row + 1}}};
    const std::array<std::size_t, 4> edges{edge_along_x(column, row), edge_along_y(column + 1, row),
                                           edge_along_x(column, row + 1), edge_along_y(column, row)};
    std::array<std::size_t, 2> starts{}, ends{};  // where the boundary turns high to low: the segment leaves the cell
    std::size_t start_count = 0, end_count = 0;
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto &here = corners[k], &there = corners[(k + 1) % 4];
      const bool from_high = high(here[0], here[1]), to_high = high(there[0], there[1]);
      sum += value(here[0], here[1]);
      if (from_high && !to_high) starts[start_count++] = k;
      if (!from_high && to_high) ends[end_count++] = k;
    }
    assert(start_count == end_count);
    if (start_count == 1) next_[edges[starts[0]]] = edges[ends[0]];
    if (start_count != 2) return;
    // A saddle: its middle decides whether the two high corners are joined.
    const bool joined = sum / 4 >= level_;
    for (const std::size_t start : starts) next_[edges[start]] = edges[joined ? (start + 1) % 4 : (start + 3) % 4];
  }

  static double signed_area(const std::vector<Point>& points) {
    double twice = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point &a = points[i], &b = points[(i + 1) % points.size()];
      twice += a[0] * b[1] - b[0] * a[1];
    }
    return twice / 2;
  }

  const PlaneField& field_;
  double level_, outside_;
  std::size_t columns_, rows_;
  std::map<std::size_t, std::size_t> next_;  // from each crossed edge to the one that follows on its loop
};

}  // namespace

std::vector<ContourLoop> contour_loops(const PlaneField& field, std::span<const double> levels, double outside) {
  std::vector<ContourLoop> loops;
  for (const double level : levels) LevelLoops(field, level, outside).add_to(loops);
  std::stable_sort(loops.begin(), loops.end(),
                   [](const ContourLoop& a, const ContourLoop& b) { return a.area > b.area; });
  return loops;
}

}  // namespace rollres
