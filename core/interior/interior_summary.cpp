#include "core/interior/interior_summary.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/quadrature.hpp"
#include "core/surface/contact_surface.hpp"

namespace rollres {

using Eigen::ArrayXd;
using Eigen::Index;

namespace {

SurfaceFields mirrored_shear(SurfaceFields fields) {
  for (double& shear : fields.shear_x) shear = -shear;
  for (TractionPanel& panel : fields.panels)
    for (double& shear : panel.shear) shear = -shear;
  return fields;
}

/// The contact's middle and half-length.
struct Extent {
  double middle, half;
};

/// On a grid its edges lie between nodes, so that they move smoothly with the pressures and do not jump with the nodes
/// in contact: near an edge p^2 grows as the distance s from it, the share s/h of a cell is r/(1 - r) with r the ratio
/// of p^2 to that of the neighbour inside.
Extent extent_on_grid(const SurfaceFields& fields) {
  const SurfaceGrid& grid = fields.grid;
  const auto squared = [&](int column) {
    const double p = column < 0 || column >= grid.columns ? 0 : fields.pressure[static_cast<std::size_t>(column)];
    return p * p;
  };
  double cells = 0, moment = 0;
  for (int i = 0; i < grid.columns; ++i) {
    const double here = squared(i), inside = std::max(squared(i - 1), squared(i + 1));
    if (!(here > 0)) continue;
    const double share = 2 * here < inside ? here / (inside - here) : 1;
    cells += share;
    moment += share * grid.x(i);
  }
  return {moment / cells, 0.5 * grid.spacing_x * (1 + cells)};
}

Extent extent_of(const SurfaceFields& fields) {
  const SurfaceTractions tractions(fields, 0);  // refuses fields without a contact
  if (fields.panels.empty()) return extent_on_grid(fields);
  return {0.5 * (tractions.from() + tractions.to()), 0.5 * (tractions.to() - tractions.from())};
}

std::vector<double> evenly_spaced(double from, double to, int count) {
  std::vector<double> places;
  for (int i = 0; i < count; ++i) places.push_back(from + (to - from) * i / (count - 1));
  return places;
}

/// A line with the thickness that it stands for.
struct WeightedLine {
  InteriorLine line;
  double weight;
};

/// Lines of Gauss's rule on panels that widen with the distance from the contact.
std::vector<WeightedLine> lines_across(const InteriorField& field, double half, int per_panel) {
  constexpr double farthest = 1e4;  // of a half-space, in lengths over which it moves
  const QuadratureRule& rule = gauss_rule(per_panel);
  std::vector<WeightedLine> lines;
  double above = 0, longest = half;
  for (const MediumLayer& layer : field.medium())
    for (const CreepSpectrum::Term& term : layer.material.terms) longest = std::max(longest, field.speed() * term.time);
  for (std::size_t layer = 0; layer < field.medium().size(); ++layer) {
    const double thickness = std::min(field.medium()[layer].thickness, farthest * longest);
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

/// Half of the largest distance between two states of a line, 0 among them.
double amplitude(const ArrayXd& stretch, const ArrayXd& shear) {
  double largest = (stretch.square() + shear.square()).maxCoeff();
  for (Index i = 0; i + 1 < stretch.size(); ++i) {
    const Index rest = stretch.size() - i - 1;
    largest = std::max(
        largest, ((stretch.tail(rest) - stretch(i)).square() + (shear.tail(rest) - shear(i)).square()).maxCoeff());
  }
  return 0.5 * std::sqrt(largest);
}

/// The largest of values at evenly spaced places, by the parabola through its neighbours.
struct Largest {
  double place = 0, value = 0;
};
Largest largest_of(const std::vector<double>& x, const ArrayXd& values) {
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

ArrayXd shear_strains(const InteriorFields& fields, Index line) {
  return ((fields.strain_x.col(line) - fields.strain_z.col(line)).square() + fields.shear_strain.col(line).square())
      .sqrt();
}

class Summary {
 public:
  Summary(const RollingScene& scene, const SurfaceFields& fields, InteriorField::Detail detail)
      : detail_(detail),
        extent_(extent_of(fields)),
        shallowest_(fields.panels.empty() ? 0.5 * fields.grid.spacing_x : 0) {
    constexpr double margin = 2;  // beyond the contact, in half-lengths
    constexpr int most = 901;
    const int fewest = detail == InteriorField::Detail::surface ? 181 : 121;
    const double half = extent_.half, from = extent_.middle - (1 + margin) * half,
                 to = extent_.middle + (1 + margin) * half;
    const double thin = std::min(half, scene.layer_thickness);
    x_ = evenly_spaced(from, to, std::clamp(static_cast<int>((to - from) / (0.125 * thin)) | 1, fewest, most));
    // Deep bonds bear tension far beside the contact.
    const double deep = std::min(finite_thickness(scene), deepest_bond * half), beside = 2 * half + 2 * deep;
    at_bonds_ = evenly_spaced(extent_.middle - half - beside, extent_.middle + half + beside, bond_points);
    const double widest = detail == InteriorField::Detail::surface ? half + beside : 0.5 * (to - from);
    parts_ = layers_inside(scene, fields, std::abs(extent_.middle) + widest, detail);
  }

  InteriorSummary run() {
    for (const LayersInside& part : parts_) {
      add_lines(part);
      if (detail_ == InteriorField::Detail::surface) add_faces(part);
    }
    finish();
    return std::move(s_);
  }

 private:
  void add_lines(const LayersInside& part) {
    const std::vector<WeightedLine> weighted =
        lines_across(part.field, extent_.half, detail_ == InteriorField::Detail::surface ? 6 : 4);
    std::vector<InteriorLine> lines;
    for (const WeightedLine& line : weighted) lines.push_back(line.line);
    const InteriorFields fields = part.field.at(x_, lines, InteriorField::Wanted::strains);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto column = static_cast<Index>(i);
      const double cycle =
          amplitude(fields.strain_x.col(column) - fields.strain_z.col(column), fields.shear_strain.col(column));
      s_.lines.push_back({part.on_body, lines[i].layer, part.height_of(lines[i]), weighted[i].weight,
                          fields.line_loss(column), cycle});
      take_peak(part, lines[i], largest_of(x_, shear_strains(fields, column)));
    }
  }

  /// Both faces of each layer: bonds, and strains that are the largest there.
  void add_faces(const LayersInside& part) {
    std::vector<InteriorLine> lines;
    const LayeredMedium& medium = part.field.medium();
    for (std::size_t layer = 0; layer < medium.size(); ++layer) {
      lines.push_back({layer, layer == 0 ? shallowest_ : 0});
      if (std::isfinite(medium[layer].thickness)) lines.push_back({layer, medium[layer].thickness});
    }
    const InteriorFields fields = part.field.at(at_bonds_, lines);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto column = static_cast<Index>(i);
      take_peak(part, lines[i], largest_of(at_bonds_, shear_strains(fields, column)));
      if (lines[i].depth < part.field.medium()[lines[i].layer].thickness) continue;
      const Largest shear = largest_of(at_bonds_, fields.tau_xz.col(column).abs());
      const Largest tension = largest_of(at_bonds_, fields.sigma_z.col(column));
      s_.bonds.push_back({part.on_body, lines[i].layer, part.height_of(lines[i]), shear.value, shear.place,
                          std::max(tension.value, 0.0), tension.place});
    }
  }

  void take_peak(const LayersInside& part, const InteriorLine& line, const Largest& found) {
    if (!(found.value > peak_.value) || part.field.depth_of(line) < shallowest_) return;
    peak_ = found;
    peak_part_ = &part;
    peak_line_ = line;
  }

  /// Around the largest strain on lines and points, on finer ones.
  void sharpen_peak() {
    constexpr int passes = 4, points = 9, lines_tried = 9;
    const LayersInside& part = *peak_part_;
    const double thickness = part.field.medium()[peak_line_.layer].thickness;
    double along = 2 * (x_[1] - x_[0]), down = std::min(0.25 * extent_.half, 0.25 * thickness);
    for (int pass = 0; pass < passes; ++pass, along /= 3, down /= 3) {
      const std::vector<double> x = evenly_spaced(peak_.place - along, peak_.place + along, points);
      std::vector<InteriorLine> lines;
      for (const double depth :
           evenly_spaced(std::max(peak_line_.depth - down, peak_line_.layer == 0 ? shallowest_ : 0.0),
                         std::min(peak_line_.depth + down, thickness), lines_tried))
        lines.push_back({peak_line_.layer, depth});
      const InteriorFields fields = part.field.at(x, lines, InteriorField::Wanted::strains);
      for (std::size_t i = 0; i < lines.size(); ++i)
        take_peak(part, lines[i], largest_of(x, shear_strains(fields, static_cast<Index>(i))));
    }
  }

  void finish() {
    double weights = 0, thickness = 0, by_thickness = 0;
    for (const LineOfFlow& line : s_.lines) {
      if (s_.layers.empty() || s_.layers.back().layer != line.layer || s_.layers.back().on_body != line.on_body)
        s_.layers.push_back({line.on_body, line.layer, 0, 0, 0});
      s_.layers.back().loss += line.thickness * line.loss;
      s_.loss += line.thickness * line.loss;
      if (std::abs(line.z) < shallowest_) continue;
      s_.layers.back().peak_strain_amplitude = std::max(s_.layers.back().peak_strain_amplitude, line.strain_amplitude);
      s_.peak_strain_amplitude = std::max(s_.peak_strain_amplitude, line.strain_amplitude);
    }
    for (LayerLoss& layer : s_.layers) layer.strain_amplitude = mean_amplitude(layer);
    for (const LayerLoss& layer : s_.layers) {
      const double lost = std::abs(layer.loss);
      weights += lost;
      s_.strain_amplitude += lost * layer.strain_amplitude;
      thickness += 1;
      by_thickness += layer.strain_amplitude;
    }
    s_.strain_amplitude = weights > 0 ? s_.strain_amplitude / weights : by_thickness / thickness;
    if (detail_ == InteriorField::Detail::surface && peak_part_) sharpen_peak();
    s_.peak_shear_strain = peak_.value;
    s_.half_length = extent_.half;
    s_.peak_x = peak_.place;
    s_.peak_z = peak_part_ ? peak_part_->height_of(peak_line_) + 0.0 : 0;  // no negative zero
  }

  /// By the loss of its lines; of an elastic layer by their strain energy, about as the amplitude squared.
  double mean_amplitude(const LayerLoss& layer) const {
    double lost = 0, sum = 0, squares = 0, cubes = 0;
    for (const LineOfFlow& line : s_.lines) {
      if (line.layer != layer.layer || line.on_body != layer.on_body) continue;
      const double a = line.strain_amplitude;
      lost += line.thickness * std::abs(line.loss);
      sum += line.thickness * std::abs(line.loss) * a;
      squares += line.thickness * a * a;
      cubes += line.thickness * a * a * a;
    }
    return lost > 0 ? sum / lost : squares > 0 ? cubes / squares : 0;
  }

  InteriorField::Detail detail_;
  Extent extent_;
  double shallowest_;                         // above which strains are those of the edges of a grid's cells [m]
  static constexpr double deepest_bond = 10;  // in half-lengths, whose tension is looked for as far as it is deep
  static constexpr int bond_points = 401;
  std::vector<double> x_, at_bonds_;
  std::vector<LayersInside> parts_;
  InteriorSummary s_;
  Largest peak_;
  const LayersInside* peak_part_ = nullptr;
  InteriorLine peak_line_;
};

}  // namespace

std::vector<LayersInside> layers_inside(const RollingScene& scene, const SurfaceFields& fields, double reach,
                                        InteriorField::Detail detail) {
  std::vector<LayersInside> parts;
  parts.push_back({false, InteriorField(foundation_of(scene), scene.speed, 1, fields, reach, detail)});
  if (!scene.coating_layers.empty())
    parts.push_back({true, InteriorField(coating_of(scene), scene.speed, flow_of_coating(scene), mirrored_shear(fields),
                                         reach, detail)});
  return parts;
}

InteriorSummary interior_summary(const RollingScene& scene, const SurfaceFields& fields, InteriorField::Detail detail) {
  return Summary(scene, fields, detail).run();
}

void add_interior(const RollingScene& scene, RollingSolution& solution) {
  const InteriorSummary s =
      interior_summary(solved_scene(scene, solution), solution.fields, InteriorField::Detail::surface);
  solution.peak_shear_strain = s.peak_shear_strain;
  solution.peak_shear_strain_x = s.peak_x;
  solution.peak_shear_strain_z = s.peak_z;
  solution.strain_amplitude = s.strain_amplitude;
  solution.peak_strain_amplitude = s.peak_strain_amplitude;
  solution.interior_loss = s.loss;
  if (s.bonds.empty()) return;
  solution.bond_shear = solution.bond_tension = 0;
  for (const Bond& bond : s.bonds) {
    solution.bond_shear = std::max(solution.bond_shear, bond.shear);
    solution.bond_tension = std::max(solution.bond_tension, bond.tension);
  }
}

std::vector<InteriorSection> interior_sections(const RollingScene& scene, const SurfaceFields& fields) {
  constexpr double sideways = 3, down = 4;  // in half-lengths
  constexpr int columns = 281, rows = 40;
  const Extent extent = extent_of(fields);
  const double from = extent.middle - sideways * extent.half, to = extent.middle + sideways * extent.half;
  std::vector<InteriorSection> sections;
  for (const LayersInside& part :
       layers_inside(scene, fields, std::max(std::abs(from), std::abs(to)), InteriorField::Detail::surface)) {
    InteriorSection section{part.on_body, evenly_spaced(from, to, columns), {}, {}, {}};
    std::vector<InteriorLine> lines;
    double above = 0;
    for (std::size_t layer = 0; layer < part.field.medium().size() && above < down * extent.half; ++layer) {
      const double thickness = std::min(part.field.medium()[layer].thickness, down * extent.half - above);
      for (const double share : evenly_spaced(0, 1, rows)) {
        lines.push_back({layer, thickness * (layer == 0 ? std::pow(share, 1.5) : share)});
        section.z.push_back(part.height_of(lines.back()));
        section.layer.push_back(layer);
      }
      above += thickness;
    }
    section.fields = part.field.at(section.x, lines, InteriorField::Wanted::density);
    if (part.on_body)
      for (Eigen::ArrayXXd* const odd : {&section.fields.w, &section.fields.tau_xz, &section.fields.shear_strain})
        *odd = -*odd;
    sections.push_back(std::move(section));
  }
  return sections;
}

RollingScene solved_scene(const RollingScene& scene, const RollingSolution& solution) {
  RollingScene solved = scene;
  if (std::isfinite(solution.rotation_ratio)) solved.coating_flow = solution.rotation_ratio;
  std::vector<MaterialInputs*> layers{&solved};
  for (BondedLayer& layer : solved.lower_layers) layers.push_back(&layer);
  for (BondedLayer& layer : solved.coating_layers) layers.push_back(&layer);
  for (std::size_t i = 0; i < std::min(layers.size(), solution.moduli_factors.size()); ++i) {
    layers[i]->rest_factor = solution.moduli_factors[i][0];
    layers[i]->relaxation_factor = solution.moduli_factors[i][1];
    layers[i]->payne_drop = 0;
    layers[i]->payne_loss_peak = 1;
    layers[i]->sweep_strains.clear();
    layers[i]->sweep_storage_moduli.clear();
    layers[i]->sweep_loss_moduli.clear();
  }
  return solved;
}

}  // namespace rollres
