#include "core/interior/interior_lines.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/quadrature.hpp"

namespace rollres {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

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

double amplitude_of(const ArrayXXd& states) {
  ArrayXXd all(states.rows() + 1, states.cols());
  all << states, ArrayXXd::Zero(1, states.cols());
  const auto squares_from = [&](const Eigen::Array<double, 1, Eigen::Dynamic>& from) {
    ArrayXd squares = ArrayXd::Zero(all.rows());
    for (Index c = 0; c < all.cols(); ++c) squares += (all.col(c) - from(c)).square();
    return squares;
  };
  Index one = 0, other = 0;
  squares_from(all.bottomRows(1)).maxCoeff(&one);
  double largest = std::sqrt(squares_from(all.row(one)).maxCoeff(&other));
  // A farther pair has a state this far from the middle, whose farthest partner is no farther than any.
  const ArrayXd radii = squares_from(0.5 * (all.row(one) + all.row(other))).sqrt();
  const double widest = radii.maxCoeff();
  for (Index i = 0; i < all.rows(); ++i)
    if (radii(i) + widest > largest) largest = std::max(largest, std::sqrt(squares_from(all.row(i)).maxCoeff()));
  return 0.5 * largest;
}

ArrayXXd denser(const ArrayXXd& states) {
  constexpr Index parts = 4;
  const Index last = states.rows() - 1;
  if (last < 3) return states;
  ArrayXXd dense(parts * last + 1, states.cols());
  for (Index part = 0; part < parts; ++part) {
    const double t = static_cast<double>(part) / parts;
    const double before = -t * (t - 1) * (t - 2) / 6, here = (t + 1) * (t - 1) * (t - 2) / 2,
                 next = -(t + 1) * t * (t - 2) / 2, beyond = (t + 1) * t * (t - 1) / 6;
    for (Index i = 0; i < last; ++i)
      if (i == 0 || i + 1 == last)
        dense.row(parts * i + part) = (1 - t) * states.row(i) + t * states.row(i + 1);
      else
        dense.row(parts * i + part) =
            before * states.row(i - 1) + here * states.row(i) + next * states.row(i + 1) + beyond * states.row(i + 2);
  }
  dense.row(parts * last) = states.row(last);
  return dense;
}

void CycleSums::add(double width, double loss, double strain_energy, double amplitude) {
  lost += width * std::abs(loss);
  by_loss += width * std::abs(loss) * amplitude;
  energy += width * strain_energy;
  by_energy += width * strain_energy * amplitude;
}

double CycleSums::mean() const { return lost > 0 ? by_loss / lost : energy > 0 ? by_energy / energy : 0; }

LinesBetween::LinesBetween(int per_panel) {
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
