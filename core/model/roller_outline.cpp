#include "core/model/roller_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace rollres {

namespace {

/// Slopes at the points of a monotone piecewise cubic, from the steps between them and what it rises over each.
std::vector<double> monotone_slopes(const std::vector<double>& steps, const std::vector<double>& rises) {
  const std::size_t count = steps.size();
  std::vector<double> slopes(count + 1);
  const auto secant = [&](std::size_t piece) { return rises[piece] / steps[piece]; };
  for (std::size_t i = 1; i < count; ++i) {
    const double before = secant(i - 1), after = secant(i);
    if (!(before * after > 0)) continue;
    const double of_before = steps[i - 1] + 2 * steps[i], of_after = 2 * steps[i - 1] + steps[i];
    slopes[i] = (of_before + of_after) / (of_before / before + of_after / after);
  }
  // By the parabola through three points, as far as it is monotone.
  const auto at_end = [&](std::size_t end, std::size_t next) {
    const double own = secant(end), other = secant(next);
    const double slope = own + (own - other) * steps[end] / (steps[end] + steps[next]);
    if (!(slope * own > 0)) return 0.0;
    return own * other < 0 && std::abs(slope) > 3 * std::abs(own) ? 3 * own : slope;
  };
  slopes.front() = count == 1 ? secant(0) : at_end(0, 1);
  slopes.back() = count == 1 ? secant(0) : at_end(count - 1, count - 2);
  return slopes;
}

/// To rounding of the numbers in a file.
bool mirrors_itself(const std::vector<double>& places, const std::vector<double>& heights) {
  constexpr double rounding = 1e-9;
  const auto [least, largest] = std::minmax_element(heights.begin(), heights.end());
  const double width = places.back() - places.front(), most = *largest - *least;
  for (std::size_t i = 0, j = places.size(); j-- > 0; ++i)
    if (std::abs(places[i] + places[j]) > rounding * width || std::abs(heights[i] - heights[j]) > rounding * most)
      return false;
  return true;
}

}  // namespace

RollerOutline::RollerOutline(double radius, double transverse, Crown crown)
    : radius_(radius), transverse_(transverse), crown_(crown) {}

RollerOutline::RollerOutline(double radius, std::vector<double> places, const std::vector<double>& heights)
    : radius_(radius), even_(mirrors_itself(places, heights)) {
  std::vector<double> steps, rises;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    steps.push_back(places[i + 1] - places[i]);
    rises.push_back(heights[i + 1] - heights[i]);
  }
  const std::vector<double> slopes = monotone_slopes(steps, rises);
  const double lowest = *std::min_element(heights.begin(), heights.end());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double step = steps[i], secant = rises[i] / step;
    pieces_.push_back({places[i], places[i + 1], heights[i] - lowest, slopes[i],
                       (3 * secant - 2 * slopes[i] - slopes[i + 1]) / step,
                       (slopes[i] + slopes[i + 1] - 2 * secant) / (step * step)});
  }
}

double RollerOutline::Piece::value(double along) const {
  const double t = std::clamp(along, from, to) - from;
  return height + t * (slope + t * (bend + t * turn));
}

double RollerOutline::Piece::derivative(double along) const {
  if (along < from || along > to) return 0;
  const double t = along - from;
  return slope + t * (2 * bend + 3 * t * turn);
}

const RollerOutline::Piece& RollerOutline::piece_at(double along) const {
  const auto next = std::upper_bound(pieces_.begin() + 1, pieces_.end(), along,
                                     [](double place, const Piece& piece) { return place < piece.from; });
  return *(next - 1);
}

double RollerOutline::fallen_square(double along) const {
  if (is_profile()) {
    const double height = piece_at(along).value(along);
    return height * (2 * radius_ - height);
  }
  if (crown_ == Crown::ellipse) return along * along * radius_ / transverse_;
  const double arc = std::sqrt(std::max(transverse_ * transverse_ - along * along, 0.0));
  const double fallen = std::min(along * along, transverse_ * transverse_) / (transverse_ + arc);
  return fallen * (2 * radius_ - std::min(fallen, radius_));
}

double RollerOutline::half_slope(double along) const {
  if (is_profile()) {
    const Piece& piece = piece_at(along);
    return -(radius_ - piece.value(along)) * piece.derivative(along);
  }
  if (crown_ == Crown::ellipse) return -along * radius_ / transverse_;
  const double least = 1e-4 * transverse_ * transverse_;
  const double arc = std::sqrt(std::max(transverse_ * transverse_ - along * along, least));
  return -(radius_ - transverse_ + arc) * along / arc;
}

bool RollerOutline::reaches(double along) const {
  return !is_profile() || (along >= pieces_.front().from && along <= pieces_.back().to);
}

double RollerOutline::reach() const {
  if (is_profile()) return std::max(std::abs(pieces_.front().from), std::abs(pieces_.back().to));
  if (crown_ == Crown::ellipse) return std::sqrt(radius_ * transverse_);
  return transverse_ > radius_ ? std::sqrt(radius_ * (2 * transverse_ - radius_)) : transverse_;
}

std::optional<double> RollerOutline::hidden_place(double sine) const {
  if (!is_profile() || sine == 0) return std::nullopt;
  const double cosine = std::sqrt(1 - sine * sine), middle = lowest(sine).along;
  constexpr std::size_t parts = 8;  // of a piece
  std::vector<double> places;
  for (const Piece& piece : pieces_)
    for (std::size_t part = 0; part <= parts; ++part)
      places.push_back(piece.from + (piece.to - piece.from) * static_cast<double>(part) / parts);
  // Level places y cos g + rho sin g shall go on outwards, or turn back for good.
  for (const int side : {-1, 1}) {
    std::reverse(places.begin(), places.end());
    double farthest = -INFINITY;
    bool turned_back = false;
    for (const double along : places) {
      if (side * (along - middle) < 0) continue;
      const double level = side * (along * cosine + (radius_ - piece_at(along).value(along)) * sine);
      if (turned_back && level > farthest) return along;
      turned_back = turned_back || level < farthest;
      farthest = std::max(farthest, level);
    }
  }
  return std::nullopt;
}

double RollerOutline::shortest_flank(double rise) const {
  struct Run {
    double length, risen;
  };
  std::vector<Run> runs;  // up and down in turns
  for (const Piece& piece : pieces_) {
    const double length = piece.to - piece.from, risen = piece.value(piece.to) - piece.height;
    if (risen == 0) continue;
    if (runs.empty() || runs.back().risen * risen < 0) runs.push_back({0, 0});
    runs.back().length += length;
    runs.back().risen += risen;
  }
  double shortest = INFINITY;
  for (std::size_t i = 1; i + 1 < runs.size(); ++i)  // the outer ones are the body's ends
    if (std::abs(runs[i].risen) >= rise) shortest = std::min(shortest, runs[i].length);
  return shortest;
}

RollerOutline::Lowest RollerOutline::lowest(double sine) const {
  const double cosine = std::sqrt(1 - sine * sine);
  if (is_profile()) return lowest_of_profile(sine, cosine);
  if (crown_ == Crown::circle)  // below the centre of the arc
    return {-transverse_ * sine, transverse_ - (transverse_ - radius_) * cosine};
  const double square = radius_ * (radius_ - transverse_), depth = std::sqrt(radius_ * radius_ - square * sine * sine);
  return {-radius_ * transverse_ * sine / depth, depth};
}

RollerOutline::Lowest RollerOutline::lowest_of_profile(double sine, double cosine) const {
  // Deepest is rho cos g - y sin g: at a point, or where its derivative is 0. Of several the middle one.
  double deepest = 0, first = 0, last = 0;
  const auto take = [&](const Piece& piece, double along) {
    const double depth = (radius_ - piece.value(along)) * cosine - along * sine;
    constexpr double rounding = 1e-12;
    if (depth > deepest + rounding * radius_) first = last = along, deepest = depth;
    if (depth > deepest - rounding * radius_) first = std::min(first, along), last = std::max(last, along);
  };
  const double wanted = -sine / cosine;  // B'
  for (const Piece& piece : pieces_) {
    take(piece, piece.from);
    take(piece, piece.to);
    const double a = 3 * piece.turn, b = piece.bend, c = piece.slope - wanted, root = b * b - a * c;
    if (!(root >= 0)) continue;
    const double q = -(b + std::copysign(std::sqrt(root), b));  // of a t^2 + 2 b t + c
    for (const double t : {q / a, c / q})
      if (t > 0 && t < piece.to - piece.from) take(piece, piece.from + t);
  }
  return {0.5 * (first + last), deepest};
}

}  // namespace rollres
