#include "core/edge/contact_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/algebra/dense_algebra.hpp"
#include "core/edge/folded_grid.hpp"
#include "core/numerics/bracketed_root.hpp"
#include "core/scene/friction_law.hpp"

namespace rollres {

namespace {

/// The pressures of a row or a column, from the first node in contact to the last [Pa].
struct LoadedLine {
  int first = 0;
  std::vector<double> pressure = {};

  int count() const { return static_cast<int>(pressure.size()); }
  int last() const { return first + count() - 1; }
  double inwards(bool from_last, int nodes) const {
    return pressure[static_cast<std::size_t>(from_last ? count() - 1 - nodes : nodes)];
  }
  int holes() const { return static_cast<int>(std::count(pressure.begin(), pressure.end(), 0.0)); }
};

/// @param pressure at each of `count` nodes, negative ones counting as none
template <class Pressure>
LoadedLine loaded_line(const Pressure& pressure, int count) {
  LoadedLine line{count};
  int last = -1;
  for (int i = 0; i < count; ++i)
    if (pressure(i) > 0) {
      line.first = std::min(line.first, i);
      last = i;
    }
  for (int i = line.first; i <= last; ++i) line.pressure.push_back(std::max(pressure(i), 0.0));
  return line;
}

/// Where the contact ends beyond the outermost node of a line, and how well that is known [cells].
struct LineEnd {
  double beyond, error;
};

constexpr double unknown_end = 0.6;
/// Of the outermost pressure and the next; larger ones have a peak that the cells do not resolve.
constexpr double largest_ratio = 0.72;

/// @param coefficients of 1, t, t^2, ...
template <class Coefficients>
double value_at(const Coefficients& coefficients, double t) {
  double value = 0;
  for (auto k = coefficients.size(); k-- > 0;) value = value * t + coefficients[k];
  return value;
}

/// (N34), (N35). @param wedge  by which the exponent of the pressure at the edge may differ from 1/2
LineEnd end_of(const LoadedLine& line, bool from_last, double wedge) {
  constexpr std::array place{-0.1766, 0.9841, 0.4713, 0.1095, 0.0722}, second{0.7065, 0.1434, 0.0, 0.031, 0.0},
      third{0.818, 0.0538, 0.035, 0.0, 0.0};
  constexpr int fewest = 8;
  constexpr double least = -0.2, most = 0.85, bent = 0.15, known = 0.05, of_bend = 1.5, of_wedge = 0.8;
  if (line.count() < 2) return {0.5 * (least + most), unknown_end};
  const auto ratio_at = [&](int node) { return line.inwards(from_last, node) / line.inwards(from_last, node + 1); };
  const double ratio = ratio_at(0), r = std::min(ratio, largest_ratio);
  const double even = std::clamp(value_at(place, r), least, most);
  if (line.count() < fewest || !(ratio <= largest_ratio)) return {even, unknown_end};
  const double by_second = ratio_at(1) - value_at(second, r), by_third = ratio_at(2) - value_at(third, r);
  const double bend = std::max(std::abs(by_second), std::abs(by_third));
  if (!(bend < bent)) return {even, unknown_end};
  const double moved = even - 7.41 * r * r * by_second + (2.01 * r - 0.28) * by_third;
  return {std::clamp(moved, least, most), std::min(known + of_bend * bend + of_wedge * wedge, unknown_end)};
}

/// Friction on a compressible layer makes the pressure at an edge go with the exponent 1/2 -+ this.
double wedge_of(const ContactModel& model) {
  double nu = model.top().poisson_ratio;
  if (!model.coating.empty()) nu = std::min(nu, model.coating.front().poisson_ratio);
  return std::atan((1 - 2 * nu) / (2 - 2 * nu) * friction_law(model).slope(0)) / M_PI;
}

/// What a line's nodes tell of the largest pressure on it, over the largest of the nodes.
struct LinePeak {
  double rise = 0, error = 0;
};

/// What peaks within the outermost cells may hide.
double hidden_peak(const LoadedLine& line, double largest) {
  constexpr double higher = 3;
  double hidden = 0;
  for (const bool from_last : {false, true}) {
    const double outermost = line.inwards(from_last, 0), next = line.inwards(from_last, 1);
    if (outermost > largest_ratio * next) hidden = std::max(hidden, higher * std::max(outermost, next) / largest - 1);
  }
  return hidden;
}

/// @param ends the errors of both of the line's ends [cells]
LinePeak peak_of(const LoadedLine& line, double ends) {
  constexpr double at_edge = 2, beside_edge = 0.6, of_third = 0.5, of_bend = 0.05, of_ends = 0.7;
  const auto top = std::max_element(line.pressure.begin(), line.pressure.end());
  const auto from_first = static_cast<int>(top - line.pressure.begin());
  const int inside = std::min(from_first, line.count() - 1 - from_first);
  if (inside == 0) return {0, at_edge};
  const double slope = 0.5 * (top[1] - top[-1]) / *top, bend = 2 - (top[1] + top[-1]) / *top;
  LinePeak peak;
  if (bend > 0 && std::abs(slope) <= bend) peak.rise = 0.5 * slope * slope / bend;
  if (inside == 1) {
    peak.error = beside_edge;
  } else {
    const double before = top[1] - 3 * top[0] + 3 * top[-1] - top[-2],
                 after = top[2] - 3 * top[1] + 3 * top[0] - top[-1];
    peak.error = of_third * std::max(std::abs(before), std::abs(after)) / *top + of_bend * std::max(bend, 0.0);
  }
  peak.error = std::max(peak.error + of_ends * ends / line.count(), hidden_peak(line, *top));
  return peak;
}

class Outline {
 public:
  Outline(const ContactModel& model, const SurfaceGrid& half, const Vector& pressure)
      : grid_(half), pressure_(pressure), wedge_(wedge_of(model)), lateral_(model.dimension == 3) {}

  ContactOutline between_nodes() {
    count_nodes();
    lateral_ ? follow_edge() : measure_line();
    find_peak();
    return outline_;
  }

  ContactOutline of_nodes() {
    constexpr double edge_known = 1, of_edges = 0.7;  // cells
    count_nodes();
    outline_.leading = middle_ + half_;
    outline_.trailing = middle_ - half_;
    outline_.half_width = top_;
    outline_.edge_error = edge_known * cell();
    outline_.area = nodes_ * grid_.cell_area();
    outline_.area_error = of_edges * cell() * (lateral_ ? perimeter() : 2);
    find_peak();
    outline_.peak_error += outline_.peak - pressure_.maxCoeff();
    outline_.peak = pressure_.maxCoeff();
    return outline_;
  }

 private:
  LoadedLine row(int j) const {
    return loaded_line([&](int i) { return pressure_(grid_.index(i, j)); }, grid_.columns);
  }
  /// A column's nodes y < 0 are counted, too: row 0 is the one at `grid_.rows - 1`.
  LoadedLine column(int i) const {
    return loaded_line([&](int j) { return pressure_(grid_.index(i, std::abs(j - grid_.rows + 1))); },
                       2 * grid_.rows - 1);
  }

  void measure_line() {
    const LoadedLine line = row(0);
    const LineEnd ahead = end_of(line, true, wedge_), behind = end_of(line, false, wedge_);
    const double cell = grid_.spacing_x;
    outline_.leading = grid_.x(line.last()) + ahead.beyond * cell;
    outline_.trailing = grid_.x(line.first) - behind.beyond * cell;
    outline_.edge_error = std::max(ahead.error, behind.error) * cell;
    outline_.area = outline_.leading - outline_.trailing;
    outline_.area_error = (ahead.error + behind.error + line.holes()) * cell;
  }

  /// A place on a sphere's edge, in parts of the contact's half-axes.
  struct EdgePlace {
    double x, y, error;  // [1], [1], [cells]
  };

  void count_nodes() {
    double trailing = INFINITY, leading = -INFINITY;
    for (int j = 0; j < grid_.rows; ++j) {
      const LoadedLine line = row(j);
      if (line.count() == 0) continue;
      trailing = std::min(trailing, grid_.x(line.first));
      leading = std::max(leading, grid_.x(line.last()));
      top_ = grid_.y(j);
      nodes_ += (lateral_ && j > 0 ? 2 : 1) * (line.count() - line.holes());
    }
    constexpr double beyond = 0.32;  // cells, on average
    middle_ = 0.5 * (trailing + leading);
    half_ = 0.5 * (leading - trailing);
    length_ = half_ + beyond * grid_.spacing_x;
    width_ = top_ + beyond * grid_.spacing_y;
  }

  void follow_edge() {
    take_ellipse();
    const std::vector<EdgePlace> places = places_on_edge();
    constexpr std::size_t fewest = 8;
    if (places.size() >= fewest) fit(places);
  }

  double perimeter() const { return 2 * M_PI * std::sqrt(0.5 * (length_ * length_ + width_ * width_)); }
  double cell() const { return lateral_ ? std::max(grid_.spacing_x, grid_.spacing_y) : grid_.spacing_x; }

  /// What the outermost nodes and the number of nodes tell.
  void take_ellipse() {
    constexpr double surplus = 0.18;  // cells, as nodes enter the contact late
    outline_.leading = middle_ + length_;
    outline_.trailing = middle_ - length_;
    outline_.half_width = width_;
    outline_.edge_error = unknown_end * cell();
    outline_.area = nodes_ * grid_.cell_area() - surplus * cell() * perimeter();
    outline_.area_error = 0.5 * unknown_end * cell() * perimeter();
  }

  /// Of rows where the edge runs rather across the motion, of columns where it runs rather along.
  std::vector<EdgePlace> places_on_edge() const {
    constexpr int fewest = 6;
    std::vector<EdgePlace> places;
    for (int j = 0; j < grid_.rows; ++j) {
      const LoadedLine line = row(j);
      if (line.count() < fewest) continue;
      const double y = grid_.y(j) / width_;
      for (const bool ahead : {false, true}) {
        const LineEnd end = end_of(line, ahead, wedge_);
        const double at = ahead ? grid_.x(line.last()) + end.beyond * grid_.spacing_x
                                : grid_.x(line.first) - end.beyond * grid_.spacing_x;
        const double x = (at - middle_) / length_;
        if (std::abs(x) >= y) places.push_back({x, y, end.error});
      }
    }
    for (int i = 0; i < grid_.columns; ++i) {
      const LoadedLine line = column(i);
      if (line.count() < fewest) continue;
      const LineEnd end = end_of(line, true, wedge_);
      const double x = (grid_.x(i) - middle_) / length_;
      const double y = (grid_.y(line.last() - grid_.rows + 1) + end.beyond * grid_.spacing_y) / width_;
      if (y > std::abs(x)) places.push_back({x, y, end.error});
    }
    return places;
  }

  /// x^2 = (h^2 - m^2) + 2 m x through the places, as (N24).
  void fit(const std::vector<EdgePlace>& places) {
    const auto count = static_cast<Eigen::Index>(places.size());
    const Eigen::Index of_squares = std::clamp<Eigen::Index>(count / 5, 2, 4),
                       of_centre = std::clamp<Eigen::Index>(count / 8, 1, 3);
    Eigen::MatrixXd matrix(count, of_squares + of_centre);
    Vector squares(count);
    double error = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
      const EdgePlace& place = places[static_cast<std::size_t>(i)];
      const double t = place.y * place.y;
      for (Eigen::Index k = 0; k < of_squares; ++k) matrix(i, k) = std::pow(t, k);
      for (Eigen::Index k = 0; k < of_centre; ++k) matrix(i, of_squares + k) = 2 * place.x * std::pow(t, k);
      squares(i) = place.x * place.x;
      error += place.error / static_cast<double>(count);
    }
    const Vector found = OverdeterminedSystem(matrix).solve(squares);
    const double scatter =
        0.5 * (matrix * found - squares).norm() / std::sqrt(static_cast<double>(count)) * length_ / grid_.spacing_x;
    take_curve(found.head(of_squares), found.tail(of_centre), error + scatter);
  }

  /// @param error of the curve [cells]
  void take_curve(const Vector& squares, const Vector& centre, double error) {
    const auto middle_at = [&](double y) { return value_at(centre, y * y); };
    const auto squared_half = [&](double y) { return value_at(squares, y * y) + std::pow(middle_at(y), 2); };
    constexpr double from = 0.8, to = 1.3;
    if (!(squared_half(from) > 0 && squared_half(to) < 0)) return;
    const double inside = bracketed_root(squared_half, from, to);
    constexpr int lines = 64;
    double area = 0, leading = -INFINITY, trailing = INFINITY;
    for (int i = 0; i < lines; ++i) {
      const double angle = M_PI / 2 * (i + 0.5) / lines, y = inside * std::sin(angle);
      const double half = std::sqrt(std::max(squared_half(y), 0.0)), middle = middle_at(y);
      area += half * inside * std::cos(angle);
      leading = std::max(leading, middle + half);
      trailing = std::min(trailing, middle - half);
    }
    outline_.leading = middle_ + length_ * leading;
    outline_.trailing = middle_ + length_ * trailing;
    outline_.half_width = width_ * inside;
    outline_.edge_error = error * cell();
    outline_.area = 4 * length_ * width_ * area * M_PI / 2 / lines;
    outline_.area_error = 0.5 * error * cell() * perimeter();
  }

  void find_peak() {
    Eigen::Index top = 0;
    const double largest = pressure_.maxCoeff(&top);
    const auto i = static_cast<int>(top) % grid_.columns, j = static_cast<int>(top) / grid_.columns;
    const double ends = outline_.edge_error / grid_.spacing_x;
    const LinePeak along = peak_of(row(j), 2 * ends), across = lateral_ ? peak_of(column(i), 2 * ends) : LinePeak{};
    outline_.peak = largest * (1 + along.rise + across.rise);
    outline_.peak_error = largest * (along.error + across.error);
  }

  const SurfaceGrid& grid_;
  const Vector& pressure_;
  double wedge_;
  bool lateral_;
  double nodes_ = 0;
  double middle_ = 0, half_ = 0, top_ = 0;  // of the nodes in contact along x, and their largest y [m]
  double length_ = 0, width_ = 0;           // half-axes of the contact, as its nodes tell them [m]
  ContactOutline outline_;
};

}  // namespace

ContactOutline contact_outline(const ContactModel& model, const SurfaceGrid& grid, const Vector& pressure) {
  if (!grid.folded && grid.rows > 1) {
    SurfaceGrid half = folded(grid);
    half.origin_y = 0;  // widths are told from the grid's middle row
    ContactOutline left = contact_outline(model, half, side_of(grid, pressure, 1));
    const ContactOutline right = contact_outline(model, half, side_of(grid, pressure, -1));
    left.leading = std::max(left.leading, right.leading);
    left.trailing = std::min(left.trailing, right.trailing);
    left.half_width = 0.5 * (left.half_width + right.half_width);
    left.area = 0.5 * (left.area + right.area);
    left.peak = std::max(left.peak, right.peak);
    for (double ContactOutline::*error :
         {&ContactOutline::edge_error, &ContactOutline::area_error, &ContactOutline::peak_error})
      left.*error = std::max(left.*error, right.*error);
    return left;
  }
  const bool as_printed = model.kinematics == Kinematics::printed || model.method == Method::active_set;
  Outline outline(model, grid, pressure);
  return as_printed || model.adhesion_threshold > 0 ? outline.of_nodes() : outline.between_nodes();
}

}  // namespace rollres
