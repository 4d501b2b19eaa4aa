#include "core/interior/cylinder_inside.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/interior/interior_summary.hpp"
#include "core/interior/layers_inside.hpp"

namespace rollres {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

namespace {

using Part = LayersInside<InteriorField>;

Extent extent_of(const SurfaceFields& fields) {
  const SurfaceTractions tractions(fields, 0);  // refuses fields without a contact
  const SurfaceGrid& grid = fields.grid;
  if (fields.panels.empty())
    return extent_of_row([&](int i) { return fields.pressure[static_cast<std::size_t>(i)]; }, grid.columns, grid.x(0),
                         grid.spacing_x);
  return {0.5 * (tractions.from() + tractions.to()), 0.5 * (tractions.to() - tractions.from())};
}

/// States of lines of flow: epsilon_x - epsilon_z and gamma_xz, of a skewed cylinder gamma_yz and gamma_xy, too.
std::vector<ArrayXXd> states_in_plane(const VolumeFields& f) {
  std::vector<ArrayXXd> states{f.strain_of(Component::x) - f.strain_of(Component::z), f.strain_of(Component::xz)};
  for (const Component c : {Component::yz, Component::xy})
    if (f.strain_of(c).size() > 0) states.push_back(f.strain_of(c));
  return states;
}

class CylinderSummary {
 public:
  CylinderSummary(const ContactModel& model, const SurfaceFields& fields, InteriorField::Detail detail)
      : detail_(detail),
        extent_(extent_of(fields)),
        shallowest_(fields.panels.empty() ? 0.5 * fields.grid.spacing_x : 0) {
    constexpr int most = 901;
    const double half = extent_.half, beside = beside_at_bonds(half, finite_thickness(model));
    x_ = places_along(extent_, std::min(half, model.top().layer_thickness), detail, most);
    at_bonds_ = evenly_spaced(extent_.middle - half - beside, extent_.middle + half + beside, bond_points);
    const double widest = detail == InteriorField::Detail::surface ? half + beside : 0.5 * (x_.back() - x_.front());
    parts_ = layers_inside<InteriorField>(model, fields, std::abs(extent_.middle) + widest, detail);
  }

  InteriorSummary run() {
    for (const Part& part : parts_) {
      add_lines(part);
      if (detail_ == InteriorField::Detail::surface) add_faces(part);
    }
    finish();
    return std::move(s_);
  }

 private:
  void add_lines(const Part& part) {
    const int per_panel = detail_ == InteriorField::Detail::surface ? 6 : 4;
    const std::vector<WeightedLine> weighted =
        lines_across(part.field.medium(), part.field.speed(), extent_.half, per_panel);
    std::vector<InteriorLine> lines;
    for (const WeightedLine& line : weighted) lines.push_back(line.line);
    const VolumeFields fields = part.field.at(x_, lines, InteriorField::Wanted::strains);
    const std::vector<ArrayXXd> states = states_in_plane(fields);
    const ArrayXXd shear_strains = largest_shear_strain(fields);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto column = static_cast<Index>(i);
      const double cycle = amplitude_of(at_place(states, column));
      s_.lines.push_back({part.on_body, lines[i].layer, part.height_of(lines[i]), weighted[i].weight,
                          fields.line_loss(column), cycle, cycle * cycle});
      take_peak(part, lines[i], largest_of(x_, shear_strains.col(column)));
    }
    add_lines_between(part, weighted, per_panel, states, fields.line_loss);
  }

  /// @param states, losses of Gauss's lines
  void add_lines_between(const Part& part, const std::vector<WeightedLine>& weighted, int per_panel,
                         const std::vector<ArrayXXd>& states, const ArrayXd& losses) {
    constexpr int in_panel = 17;
    const LinesBetween between(per_panel, in_panel);
    const std::size_t layers_before = sums_.size();
    sums_.resize(layers_before + part.field.medium().size());
    const double shallowest = std::max(shallowest_, weighted.front().line.depth);
    for (Index first = 0; first < losses.size(); first += per_panel) {
      const std::vector<WeightedLine> lines = between.lines(
          std::span(weighted).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(per_panel)));
      const auto of_panel = [&](const ArrayXXd& values) { return between(values.middleCols(first, per_panel)); };
      std::vector<Eigen::MatrixXd> moved;
      for (const ArrayXXd& state : states) moved.push_back(of_panel(state));
      const Eigen::MatrixXd lost = of_panel(losses.transpose());
      CycleSums& sums = sums_[layers_before + lines.front().line.layer];
      for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto column = static_cast<Index>(i);
        const double cycle = amplitude_between_points(at_place(moved, column));
        sums.add(lines[i].weight, lost(column), cycle * cycle, cycle);
        if (part.field.depth_of(lines[i].line) >= shallowest) sums.peak = std::max(sums.peak, cycle);
      }
    }
  }

  /// Both faces of each layer: bonds, and strains that are the largest there.
  void add_faces(const Part& part) {
    std::vector<InteriorLine> lines;
    const LayeredMedium& medium = part.field.medium();
    for (std::size_t layer = 0; layer < medium.size(); ++layer) {
      lines.push_back({layer, layer == 0 ? shallowest_ : 0});
      if (std::isfinite(medium[layer].thickness)) lines.push_back({layer, medium[layer].thickness});
    }
    const VolumeFields fields = part.field.at(at_bonds_, lines);
    const ArrayXXd shear_strains = largest_shear_strain(fields), sheared = shear_on_bond(fields);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto column = static_cast<Index>(i);
      take_peak(part, lines[i], largest_of(at_bonds_, shear_strains.col(column)));
      if (lines[i].depth < part.field.medium()[lines[i].layer].thickness) continue;
      const Largest shear = largest_of(at_bonds_, sheared.col(column));
      const Largest tension = largest_of(at_bonds_, fields.stress_of(Component::z).col(column));
      s_.bonds.push_back({part.on_body, lines[i].layer, part.height_of(lines[i]), shear.value, shear.place, 0,
                          std::max(tension.value, 0.0), tension.place, 0});
    }
  }

  void take_peak(const Part& part, const InteriorLine& line, const Largest& found) {
    if (!(found.value > peak_.value) || part.field.depth_of(line) < shallowest_) return;
    peak_ = found;
    peak_part_ = &part;
    peak_line_ = line;
  }

  /// Around the largest strain on lines and points, on finer ones.
  void sharpen_peak() {
    constexpr int passes = 4, points = 9;
    const Part& part = *peak_part_;
    const double thickness = part.field.medium()[peak_line_.layer].thickness;
    double along = 2 * (x_[1] - x_[0]), down = std::min(0.25 * extent_.half, 0.25 * thickness);
    for (int pass = 0; pass < passes; ++pass, along /= 3, down /= 3) {
      const std::vector<double> x = evenly_spaced(peak_.place - along, peak_.place + along, points);
      const std::vector<InteriorLine> lines = lines_around(peak_line_, part.field.medium(), down, shallowest_);
      const ArrayXXd shear_strains = largest_shear_strain(part.field.at(x, lines, InteriorField::Wanted::strains));
      for (std::size_t i = 0; i < lines.size(); ++i)
        take_peak(part, lines[i], largest_of(x, shear_strains.col(static_cast<Index>(i))));
    }
  }

  void finish() {
    add_totals(s_, sums_);
    if (detail_ == InteriorField::Detail::surface && peak_part_) sharpen_peak();
    s_.peak_shear_strain = peak_.value;
    s_.half_length = extent_.half;
    s_.peak_x = peak_.place;
    s_.peak_z = peak_part_ ? peak_part_->height_of(peak_line_) + 0.0 : 0;  // no negative zero
  }

  InteriorField::Detail detail_;
  Extent extent_;
  double shallowest_;  // above which strains are those of the edges of a grid's cells [m]
  static constexpr int bond_points = 401;
  std::vector<double> x_, at_bonds_;
  std::vector<Part> parts_;
  std::vector<CycleSums> sums_;  // of each layer
  InteriorSummary s_;
  Largest peak_;
  const Part* peak_part_ = nullptr;
  InteriorLine peak_line_;
};

}  // namespace

InteriorSummary cylinder_summary(const ContactModel& model, const SurfaceFields& fields, InteriorField::Detail detail) {
  return CylinderSummary(model, fields, detail).run();
}

std::vector<InteriorSection> cylinder_sections(const ContactModel& model, const SurfaceFields& fields) {
  constexpr double sideways = 3;  // in half-lengths
  constexpr int columns = 281;
  const Extent extent = extent_of(fields);
  const double from = extent.middle - sideways * extent.half, to = extent.middle + sideways * extent.half;
  std::vector<InteriorSection> sections;
  for (const Part& part : layers_inside<InteriorField>(model, fields, std::max(std::abs(from), std::abs(to)),
                                                       InteriorField::Detail::surface)) {
    const SectionRows rows = section_rows(part.field.medium(), part.on_body, extent.half);
    InteriorSection section{part.on_body, evenly_spaced(from, to, columns), {0}, rows.z, rows.layer, {}};
    section.fields = part.field.at(section.x, rows.lines, InteriorField::Wanted::density);
    turn_upwards(section);
    sections.push_back(std::move(section));
  }
  return sections;
}

}  // namespace rollres
