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
  const auto farthest = [&](Index first, const auto& from) {
    ArrayXd distance = ArrayXd::Zero(states.rows() - first);
    for (Index c = 0; c < states.cols(); ++c) distance += (states.col(c).tail(distance.size()) - from(c)).square();
    return distance.maxCoeff();
  };
  double largest = farthest(0, [](Index) { return 0.0; });
  for (Index i = 0; i + 1 < states.rows(); ++i)
    largest = std::max(largest, farthest(i + 1, [&](Index c) { return states(i, c); }));
  return 0.5 * std::sqrt(largest);
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
