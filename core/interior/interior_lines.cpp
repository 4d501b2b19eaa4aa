#include "core/interior/interior_lines.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/quadrature.hpp"

namespace rollres {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

bool is_mirror_image(const SurfaceFields& fields) {
  const SurfaceGrid& grid = fields.grid;
  if (grid.y(0) != -grid.y(grid.rows - 1)) return false;
  for (int j = 0; 2 * j < grid.rows; ++j)
    for (int i = 0; i < grid.columns; ++i) {
      const auto node = static_cast<std::size_t>(grid.index(i, j)),
                 image = static_cast<std::size_t>(grid.index(i, grid.rows - 1 - j));
      if (fields.pressure[node] != fields.pressure[image] || fields.shear_x[node] != fields.shear_x[image] ||
          fields.shear_y[node] != -fields.shear_y[image])
        return false;
    }
  return true;
}

Extent extent_of_row(const std::function<double(int)>& pressure, int count, double first, double spacing) {
  const auto squared = [&](int node) {
    const double p = node < 0 || node >= count ? 0 : pressure(node);
    return p * p;
  };
  double cells = 0, moment = 0;
  for (int i = 0; i < count; ++i) {
    const double here = squared(i), inside = std::max(squared(i - 1), squared(i + 1));
    if (!(here > 0)) continue;
    const double share = 2 * here < inside ? here / (inside - here) : 1;
    cells += share;
    moment += share * (first + spacing * i);
  }
  return {moment / cells, 0.5 * spacing * (1 + cells)};
}

std::vector<double> evenly_spaced(double from, double to, int count) {
  std::vector<double> places;
  for (int i = 0; i < count; ++i) places.push_back(from + (to - from) * i / (count - 1));
  return places;
}

std::vector<double> places_along(const Extent& contact, double thin, InteriorField::Detail detail, int most) {
  constexpr double margin = 2, spacing = 0.125;  // beyond the contact, in half-lengths; of what is thin
  const int fewest = detail == InteriorField::Detail::surface ? 181 : 121;
  const double reach = (1 + margin) * contact.half, from = contact.middle - reach, to = contact.middle + reach;
  return evenly_spaced(from, to, std::clamp(static_cast<int>((to - from) / (spacing * thin)) | 1, fewest, most));
}

double beside_at_bonds(double half, double layers) {
  constexpr double deepest = 10;  // in half-lengths, whose tension is looked for as far as it is deep
  return 2 * half + 2 * std::min(layers, deepest * half);
}

std::vector<WeightedLine> lines_across(const LayeredMedium& medium, double speed, double half, int per_panel) {
  constexpr double farthest = 1e4;  // of a half-space, in lengths over which it moves
  const QuadratureRule& rule = gauss_rule(per_panel);
  std::vector<WeightedLine> lines;
  double above = 0, longest = half;
  for (const MediumLayer& layer : medium)
    for (const CreepSpectrum::Term& term : layer.material.terms) longest = std::max(longest, speed * term.time);
  for (std::size_t layer = 0; layer < medium.size(); ++layer) {
    const double thickness = std::min(medium[layer].thickness, farthest * longest);
    double width = std::max(above, std::min(half, thickness) / 16);
    for (double from = 0; from < thickness;) {
      double to = std::min(from + width, thickness);
      if (thickness - to < 0.3 * width) to = thickness;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i)
        lines.push_back({{layer, from + (to - from) * rule.nodes[i]}, (to - from) * rule.weights[i]});
      from = to;
      width = std::max(above + from, width);
    }
    above += thickness;
  }
  return lines;
}

std::vector<InteriorLine> lines_around(const InteriorLine& line, const LayeredMedium& medium, double down,
                                       double shallowest) {
  constexpr int count = 9;
  std::vector<InteriorLine> lines;
  for (const double depth : evenly_spaced(std::max(line.depth - down, line.layer == 0 ? shallowest : 0.0),
                                          std::min(line.depth + down, medium[line.layer].thickness), count))
    lines.push_back({line.layer, depth});
  return lines;
}

SectionRows section_rows(const LayeredMedium& medium, bool on_body, double half) {
  constexpr double down = 4;  // in half-lengths
  constexpr int in_layer = 40;
  SectionRows rows;
  double above = 0;
  for (std::size_t layer = 0; layer < medium.size() && above < down * half; ++layer) {
    const double thickness = std::min(medium[layer].thickness, down * half - above);
    for (const double share : evenly_spaced(0, 1, in_layer)) {
      rows.lines.push_back({layer, thickness * (layer == 0 ? std::pow(share, 1.5) : share)});
      rows.z.push_back((on_body ? 1 : -1) * depth_of(medium, rows.lines.back()));
      rows.layer.push_back(layer);
    }
    above += thickness;
  }
  return rows;
}

namespace {

using State = Eigen::Array<double, 1, Eigen::Dynamic>;

ArrayXd squares_from(const ArrayXXd& states, const State& from) {
  ArrayXd squares = (states.col(0) - from(0)).square();
  for (Index c = 1; c < states.cols(); ++c) squares += (states.col(c) - from(c)).square();
  return squares;
}

/// A distant pair of states, and where all lie, seen from its middle. No pair is farther apart than two radii.
struct DistantPair {
  double distance, widest;
  ArrayXd radii, along;  ///< from the middle, and along the line through the pair

  explicit DistantPair(const ArrayXXd& states) {
    Index one = 0, other = 0;
    squares_from(states, states.bottomRows(1)).maxCoeff(&one);
    distance = std::sqrt(squares_from(states, states.row(one)).maxCoeff(&other));
    const State middle = 0.5 * (states.row(one) + states.row(other)),
                axis = (states.row(other) - states.row(one)) / std::max(distance, 1e-300);
    radii = squares_from(states, middle).sqrt();
    along = (states.rowwise() - middle).matrix() * axis.matrix().transpose();
    widest = radii.maxCoeff();
  }
};

/// States that may belong to a farther pair, on one side of the middle.
struct FarStates {
  struct Place {
    Index state;
    double along, beside;  // the line through the pair
  };
  std::vector<Place> places = {};
  double nearest = INFINITY, farthest = 0, widest = 0;

  void add(Index state, const DistantPair& pair) {
    const double along = std::abs(pair.along(state));
    const double beside = std::sqrt(std::max(std::pow(pair.radii(state), 2) - along * along, 0.0));
    places.push_back({state, along, beside});
    nearest = std::min(nearest, along);
    farthest = std::max(farthest, along);
    widest = std::max(widest, beside);
  }
  /// No other of them is farther away.
  double reach(const Place& from) const {
    return std::hypot(std::max(from.along - nearest, farthest - from.along), from.beside + widest);
  }
  /// The same from the other side.
  double reach_across(const Place& from) const { return std::hypot(from.along + farthest, from.beside + widest); }
};

/// Of many states near one end (at rest, far from the contact) only those at the other end are compared with all.
double largest_distance(const ArrayXXd& states) {
  const DistantPair pair(states);
  FarStates few, many;
  for (Index i = 0; i < states.rows(); ++i)
    if (pair.radii(i) + pair.widest > pair.distance) (pair.along(i) > 0 ? few : many).add(i, pair);
  if (few.places.size() > many.places.size()) std::swap(few, many);
  double largest = pair.distance;
  const auto compare = [&](Index state) {
    largest = std::max(largest, std::sqrt(squares_from(states, states.row(state)).maxCoeff()));
  };
  for (const FarStates::Place& place : few.places)
    if (std::max(few.reach(place), many.reach_across(place)) > largest) compare(place.state);
  for (const FarStates::Place& place : many.places)
    if (many.reach(place) > largest) compare(place.state);
  return largest;
}

/// With the unstrained state at the end.
ArrayXXd with_rest(const ArrayXXd& states) {
  ArrayXXd all(states.rows() + 1, states.cols());
  all << states, ArrayXXd::Zero(1, states.cols());
  return all;
}

/// Between two states, at a part of their distance, by the cubic through four; at the ends by a line.
State state_between(const ArrayXXd& states, Index i, double t) {
  if (i == 0 || i + 2 >= states.rows()) return (1 - t) * states.row(i) + t * states.row(i + 1);
  const double before = -t * (t - 1) * (t - 2) / 6, here = (t + 1) * (t - 1) * (t - 2) / 2,
               next = -(t + 1) * t * (t - 2) / 2, beyond = (t + 1) * t * (t - 1) / 6;
  return before * states.row(i - 1) + here * states.row(i) + next * states.row(i + 1) + beyond * states.row(i + 2);
}

}  // namespace

double amplitude_of(const ArrayXXd& states) { return 0.5 * largest_distance(with_rest(states)); }

double amplitude_between_points(const ArrayXXd& states) {
  constexpr Index parts = 4;
  constexpr double margin = 0.03;  // by which states between points may lie farther out than these
  const ArrayXXd all = with_rest(states);
  const DistantPair pair(all);
  const double least = (1 - margin) * pair.distance - (1 + margin) * pair.widest;
  const Index last = states.rows() - 1;
  ArrayXXd far(parts * last + 2, states.cols());
  Index count = 0;
  for (Index i = 0; i < last; ++i)
    if (std::max(pair.radii(i), pair.radii(i + 1)) >= least)
      for (Index part = 0; part < parts; ++part)
        far.row(count++) =
            part == 0 ? State(states.row(i)) : state_between(states, i, static_cast<double>(part) / parts);
  for (const Index end : {last, last + 1})
    if (pair.radii(end) >= least) far.row(count++) = all.row(end);
  return 0.5 * largest_distance(far.topRows(count));
}

void CycleSums::add(double width, double loss, double strain_energy, double amplitude) {
  lost += width * std::abs(loss);
  by_loss += width * std::abs(loss) * amplitude;
  energy += width * strain_energy;
  by_energy += width * strain_energy * amplitude;
}

double CycleSums::mean() const { return lost > 0 ? by_loss / lost : energy > 0 ? by_energy / energy : 0; }

LinesBetween::LinesBetween(int per_panel, int count) {
  const QuadratureRule& rule = gauss_rule(per_panel);
  from_gauss_.resize(per_panel, count);
  for (int line = 0; line < count; ++line) {
    const double place = static_cast<double>(line) / (count - 1);
    for (int i = 0; i < per_panel; ++i) {
      double basis = 1;
      for (int j = 0; j < per_panel; ++j)
        if (j != i)
          basis *= (place - rule.nodes[static_cast<std::size_t>(j)]) /
                   (rule.nodes[static_cast<std::size_t>(i)] - rule.nodes[static_cast<std::size_t>(j)]);
      from_gauss_(i, line) = basis;
    }
  }
}

std::vector<WeightedLine> LinesBetween::lines(std::span<const WeightedLine> panel) const {
  double width = 0;
  ArrayXXd depths(1, from_gauss_.rows());
  for (Index i = 0; i < depths.cols(); ++i) {
    const WeightedLine& line = panel[static_cast<std::size_t>(i)];
    width += line.weight;
    depths(0, i) = line.line.depth;
  }
  const Eigen::MatrixXd depth = (*this)(depths);
  std::vector<WeightedLine> between;
  const auto count = static_cast<int>(from_gauss_.cols());
  for (int line = 0; line < count; ++line) {
    const bool end = line == 0 || line + 1 == count;
    const double share = (end ? 1.0 : line % 2 == 0 ? 2.0 : 4.0) / (3 * (count - 1));
    between.push_back({{panel.front().line.layer, depth(line)}, share * width});
  }
  return between;
}

Largest largest_of(const std::vector<double>& x, const Eigen::ArrayXd& values) {
  Index top = 0;
  const double value = values.maxCoeff(&top);
  const auto place = static_cast<std::size_t>(top);
  if (top == 0 || top + 1 == values.size()) return {x[place], value};
  const double slope = 0.5 * (values(top + 1) - values(top - 1));
  const double curvature = values(top + 1) - 2 * value + values(top - 1);
  if (!(curvature < 0)) return {x[place], value};
  const double shift = std::clamp(-slope / curvature, -0.5, 0.5);
  return {x[place] + shift * (x[1] - x[0]), value + 0.5 * slope * shift};
}

}  // namespace rollres
