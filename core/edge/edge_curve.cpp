#include "core/edge/edge_curve.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/algebra/dense_algebra.hpp"

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

/// Distance, in cells, of the zero of p^2 beyond the first of three neighbouring cells.
double zero_beyond(double first, double second, double third) {
  const double q0 = first * first, q1 = second * second, q2 = third * third;
  const double slope = 1.5 * q0 - 2 * q1 + 0.5 * q2, bend = 0.5 * q0 - q1 + 0.5 * q2;
  const double root = slope * slope - 4 * bend * q0;
  return slope < 0 && root >= 0 ? 2 * q0 / (-slope + std::sqrt(root)) : RollingSolution::absent;
}

}  // namespace

CurveRow::CurveRow(const EdgeCurve& curve, double y) {
  const double place = (y - curve.origin) / curve.unit, t = curve.even ? place * place : place,
               by_y = (curve.even ? 2 * place : 1) / curve.unit;
  std::tie(centre, centre_slope) = polynomial(curve.centre, t);
  std::tie(squared, squared_slope) = polynomial(curve.squared_length, t);
  centre_slope *= by_y;
  squared_slope *= by_y;
}

double CurveRow::steepness(double x) const { return std::hypot(along(x), across(x)); }

double CurveRow::sum_of_root(double from, double to) const {
  if (!(squared > 0)) return 0;
  const auto primitive = [this](double x) {
    const double s = std::clamp((x - centre) / std::sqrt(squared), -1.0, 1.0);
    return 0.5 * squared * (std::asin(s) + s * std::sqrt(1 - s * s));
  };
  return primitive(to) - primitive(from);
}

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

EdgeCurve edge_curve(const SurfaceGrid& grid, const Vector& pressure) {
  const std::vector<RowEnds> ends = ends_of_rows(grid, pressure);
  const auto rows = static_cast<Eigen::Index>(ends.size());
  constexpr Eigen::Index fewest = 4, most_terms = 5;
  EdgeCurve curve;
  curve.even = grid.folded;
  const Eigen::Index on_side = curve.even ? rows : (rows + 1) / 2;  // of the contact
  if (on_side < fewest) return {};
  curve.origin = grid.origin_y;
  const auto aside = [&](const RowEnds& end) { return end.y - curve.origin; };
  curve.unit = std::max(std::abs(aside(ends.front())), std::abs(aside(ends.back())));
  const Eigen::Index even_terms = std::min(most_terms, (on_side + 1) / 3 + 1),
                     terms = curve.even ? even_terms : 2 * even_terms - 1;
  Eigen::MatrixXd powers(rows, terms);
  Vector centre(rows), squared(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const RowEnds& end = ends[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < terms; ++k) powers(i, k) = std::pow(aside(end) / curve.unit, curve.even ? 2 * k : k);
    centre(i) = 0.5 * (end.leading + end.trailing);
    squared(i) = 0.25 * std::pow(end.leading - end.trailing, 2);
  }
  const OverdeterminedSystem fit(powers);
  curve.centre = fit.solve(centre);
  curve.squared_length = fit.solve(squared);
  return curve;
}

namespace {

/// The mean of sqrt(distance) over a cell, by the distance of its centre inside a straight edge, and by how much that
/// changes from one side of the cell to the other, along x and along y.
double mean_of_root(double distance, double along_x, double along_y) {
  const double x = std::abs(along_x), y = std::abs(along_y), large = std::max(x, y), small = std::min(x, y);
  const auto power = [](double inside, double exponent) { return inside > 0 ? std::pow(inside, exponent) : 0; };
  constexpr double aligned = 1e-2;
  if (small < aligned * large)
    return 2.0 / 3 * (power(distance + 0.5 * large, 1.5) - power(distance - 0.5 * large, 1.5)) / large;
  double sum = 0;
  for (const double i : {-0.5, 0.5})
    for (const double j : {-0.5, 0.5}) sum += 4 * i * j * power(distance + i * large + j * small, 2.5);
  return 4.0 / 15 * sum / (large * small);
}

/// Of a cell so far inside the edge, 1 in the ring; it falls to 0 outside, as the edge found is to be smooth.
double weight_in(const EdgeRing& ring, double distance) {
  const double fade = 0.5 * ring.from;
  const double t = std::clamp(std::min(distance - ring.from + fade, ring.to + 1 - distance) / fade, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// sum c_k cos k angle
double cosine_series(const Vector& coefficients, double angle) {
  double sum = 0;
  for (Eigen::Index k = 0; k < coefficients.size(); ++k)
    sum += coefficients(k) * std::cos(static_cast<double>(k) * angle);
  return sum;
}

/// An edge as radius over angle, r = rho(theta), in coordinates scaled by the ellipse of the pressure's moments.
class PolarEdge {
 public:
  PolarEdge(const SurfaceGrid& grid, const Vector& pressure, Eigen::Index terms)
      : grid_(grid), pressure_(pressure), terms_(terms), radius_(Vector::Unit(terms, 0)) {
    double sum = 0, of_x = 0, of_xx = 0, of_yy = 0;
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) {
        const double weight = (grid.first_row + row == 0 ? 1 : 2) * pressure(grid.index(column, row));
        const double x = grid.x(column), y = grid.y(row);
        sum += weight;
        of_x += weight * x;
        of_xx += weight * x * x;
        of_yy += weight * y * y;
      }
    centre_ = of_x / sum;
    length_ = std::sqrt(5 * (of_xx / sum - centre_ * centre_));
    width_ = std::sqrt(5 * of_yy / sum);
    cell_ = std::max(grid.spacing_x, grid.spacing_y);
    const Eigen::Index places = 4 * terms;
    Eigen::MatrixXd cosines(places, terms);
    for (Eigen::Index i = 0; i < places; ++i) {
      angles_.push_back(M_PI * (static_cast<double>(i) + 0.5) / static_cast<double>(places));
      for (Eigen::Index k = 0; k < terms; ++k) cosines(i, k) = std::cos(static_cast<double>(k) * angles_.back());
    }
    through_places_ = OverdeterminedSystem(cosines);
  }

  /// On the half-length of the contact.
  double cells() const { return length_ / cell_; }

  /// Moves the edge to where p^2 of the ring, a parabola in the distance, is zero; by how much [cells], NaN where the
  /// ring does not tell.
  double follow(const EdgeRing& ring) {
    std::vector<double> squares;
    std::vector<Vector> rows;
    for (int row = 0; row < grid_.rows; ++row)
      for (int column = 0; column < grid_.columns; ++column) {
        const double value = pressure_(grid_.index(column, row));
        if (!(value > 0)) continue;
        const double x = (grid_.x(column) - centre_) / length_, y = grid_.y(row) / width_, r = std::hypot(x, y);
        if (!(r > 0)) continue;
        const Vector cosines = cosines_of_multiples(x / r);
        const double steep = std::hypot(x / length_, y / width_) / r;
        const double inside = radius_.dot(cosines) - r, distance = inside / (steep * cell_);
        const double weight = weight_in(ring, distance);
        if (!(weight > 0)) continue;
        const double per_cell = 1 / (r * steep * cell_);
        const double mean =
            mean_of_root(distance, x / length_ * grid_.spacing_x * per_cell, y / width_ * grid_.spacing_y * per_cell);
        const double at_node = value * std::sqrt(distance) / mean;
        squares.push_back(weight * at_node * at_node);
        const double depth = inside * length_ / cell_;
        Vector terms(3 * terms_);
        terms << weight * cosines, weight * depth * cosines, weight * depth * depth * cosines;
        rows.push_back(std::move(terms));
      }
    constexpr double least_per_term = 2;
    const auto count = static_cast<Eigen::Index>(rows.size());
    if (static_cast<double>(count) < least_per_term * static_cast<double>(3 * terms_)) return RollingSolution::absent;
    Eigen::MatrixXd matrix(count, 3 * terms_);
    for (Eigen::Index i = 0; i < count; ++i) matrix.row(i) = rows[static_cast<std::size_t>(i)];
    const Vector fit = OverdeterminedSystem(matrix).solve(Eigen::Map<const Vector>(squares.data(), count));
    Vector moved(static_cast<Eigen::Index>(angles_.size()));
    for (std::size_t i = 0; i < angles_.size(); ++i) {
      const double value = cosine_series(fit.head(terms_), angles_[i]);
      const double slope = cosine_series(fit.segment(terms_, terms_), angles_[i]);
      const double bend = cosine_series(fit.tail(terms_), angles_[i]);
      const double root = slope * slope - 4 * bend * value;
      if (!(slope > 0 && root >= 0)) return RollingSolution::absent;
      moved(static_cast<Eigen::Index>(i)) = -2 * value / (slope + std::sqrt(root));
    }
    radius_ -= through_places_.solve(moved) * (cell_ / length_);
    return moved.cwiseAbs().maxCoeff();
  }

  /// The curve through all places, so many cells further inside.
  EdgeCurve curve(double inwards) const {
    constexpr Eigen::Index of_squares = 5, of_centre = 4, places = 48;
    Vector x(places), y(places);
    for (Eigen::Index i = 0; i < places; ++i) {
      const double angle = M_PI * (static_cast<double>(i) + 0.5) / places, cosine = std::cos(angle),
                   sine = std::sin(angle);
      const double radius =
          cosine_series(radius_, angle) - inwards * cell_ * std::hypot(cosine / length_, sine / width_);
      x(i) = radius * cosine;
      y(i) = radius * sine;
    }
    EdgeCurve curve;
    const double top = y.maxCoeff();
    curve.unit = top * width_;
    // x^2 = (h^2 - m^2) + 2 m x, linear in the coefficients of h^2 - m^2 and m.
    Eigen::MatrixXd matrix(places, of_squares + of_centre);
    for (Eigen::Index i = 0; i < places; ++i)
      for (Eigen::Index k = 0; k < of_squares; ++k) {
        const double power = std::pow(y(i) / top, 2 * static_cast<double>(k));
        matrix(i, k) = power;
        if (k < of_centre) matrix(i, of_squares + k) = 2 * x(i) * power;
      }
    const Vector fit = OverdeterminedSystem(matrix).solve(x.cwiseAbs2());
    const Vector middle = fit.tail(of_centre);
    Vector squared = Vector::Zero(2 * of_centre - 1);
    squared.head(of_squares) = fit.head(of_squares);
    for (Eigen::Index i = 0; i < of_centre; ++i)
      for (Eigen::Index k = 0; k < of_centre; ++k) squared(i + k) += middle(i) * middle(k);
    curve.squared_length = squared * (length_ * length_);
    curve.centre = middle * length_;
    curve.centre(0) += centre_;
    return curve;
  }

 private:
  /// cos k angle, from cos angle.
  Vector cosines_of_multiples(double cosine) const {
    Vector cosines(terms_);
    for (Eigen::Index k = 0; k < terms_; ++k)
      cosines(k) = k == 0 ? 1 : k == 1 ? cosine : 2 * cosine * cosines(k - 1) - cosines(k - 2);
    return cosines;
  }

  const SurfaceGrid& grid_;
  const Vector& pressure_;
  Eigen::Index terms_;
  Vector radius_;  // coefficients of rho
  double centre_ = 0, length_ = 1, width_ = 1, cell_ = 1;
  std::vector<double> angles_;
  OverdeterminedSystem through_places_;
};

}  // namespace

EdgeCurve edge_around(const SurfaceGrid& grid, const Vector& pressure, const EdgeRing& ring) {
  if (!(pressure.sum() > 0)) return {};
  constexpr Eigen::Index terms = 7;
  constexpr int moves = 4;
  // The first ring is one of the whole contact, as the edge may lie cells beside the ellipse.
  constexpr double wide_from = 0.1, wide_to = 0.4, of_first_move = 0.3, of_next_moves = 0.1;
  PolarEdge edge(grid, pressure, terms);
  const double cells = edge.cells();
  for (int move = 0; move < moves; ++move) {
    const bool first = move == 0;
    const double moved = edge.follow(
        first ? EdgeRing{std::max(ring.from, wide_from * cells), std::max(ring.to, wide_to * cells), 0} : ring);
    if (!(moved < (first ? of_first_move : of_next_moves) * cells)) return {};
  }
  return edge.curve(ring.beyond);
}

}  // namespace rollres
