#include "core/interior/sphere_inside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/interior/interior_lines.hpp"
#include "core/interior/layers_inside.hpp"
#include "core/numerics/quadrature.hpp"

namespace rollres {

using Eigen::ArrayXXd;
using Eigen::Index;
using Detail = InteriorField::Detail;
using Wanted = VolumeField::Wanted;

namespace {

using Side = LayersInside<VolumeField>;

/// Of a contact that is its own mirror image along its longest row and column, those nearest to its middle; of another
/// what its largest pressures of all columns and rows reach.
struct SphereExtent {
  Extent x, y;
  bool mirrored;

  explicit SphereExtent(const SurfaceFields& fields) : mirrored(is_mirror_image(fields)) {
    const SurfaceGrid& grid = fields.grid;
    const auto pressure = [&](int i, int j) { return fields.pressure[static_cast<std::size_t>(grid.index(i, j))]; };
    const auto in_row = [&](int j) { return [&, j](int i) { return pressure(i, j); }; };
    const auto in_column = [&](int i) { return [&, i](int j) { return pressure(i, j); }; };
    const auto along_x = [&](const auto& p) { return extent_of_row(p, grid.columns, grid.x(0), grid.spacing_x); };
    const auto along_y = [&](const auto& p) { return extent_of_row(p, grid.rows, grid.y(0), grid.spacing_y); };
    if (mirrored) {
      x = along_x(in_row(nearest(0, grid.y(0), grid.spacing_y, grid.rows)));
      if (std::isfinite(x.middle))
        y = {0, along_y(in_column(nearest(x.middle, grid.x(0), grid.spacing_x, grid.columns))).half};
    } else {
      x = along_x([&](int i) { return largest_of_nodes(in_column(i), grid.rows); });
      y = along_y([&](int j) { return largest_of_nodes(in_row(j), grid.columns); });
    }
    if (!std::isfinite(x.middle)) throw std::domain_error("the fields hold no contact to look into");
  }

 private:
  static int nearest(double place, double first, double spacing, int count) {
    return std::clamp(static_cast<int>(std::lround((place - first) / spacing)), 0, count - 1);
  }
  static double largest_of_nodes(const auto& pressure, int count) {
    double largest = 0;
    for (int node = 0; node < count; ++node) largest = std::max(largest, pressure(node));
    return largest;
  }
};

/// States of all lines of flow, whose distances are sqrt(2 e : e): of each coordinate (point, place).
std::array<ArrayXXd, 5> states_of(const VolumeFields& f) {
  const ArrayXXd &x = f.strain_of(Component::x), &y = f.strain_of(Component::y), &z = f.strain_of(Component::z);
  return {x - z, (2 * y - x - z) / std::sqrt(3.0), f.strain_of(Component::xz), f.strain_of(Component::yz),
          f.strain_of(Component::xy)};
}

class SphereSummary {
 public:
  SphereSummary(const ContactModel& model, const SurfaceFields& fields, Detail detail)
      : detail_(detail),
        extent_(fields),
        sides_(layers_inside<VolumeField>(model, fields, detail)),
        shallowest_(0.5 * fields.grid.spacing_x) {
    constexpr int most = 451;
    const double half = extent_.x.half;
    x_ = places_along(extent_.x, std::min(half, model.top().layer_thickness), detail, most);
    add_ys(0, extent_.y.half, detail == Detail::surface ? 8 : 6);
    add_ys(extent_.y.half, 2 * extent_.y.half, 4);
    add_ys(2 * extent_.y.half, 4 * extent_.y.half, 3);
    // Where strains are the largest; it stands for no width.
    y_.push_back(extent_.y.middle);
    width_.push_back(0);
    beside_ = beside_at_bonds(half, finite_thickness(model));
  }

  InteriorSummary run() {
    for (const Side& side : sides_) {
      add_lines(side);
      if (detail_ == Detail::surface) add_faces(side);
    }
    constexpr double of_points = 5e-4;  // what amplitudes between points along x are larger
    add_totals(s_, sums_, of_points);
    if (detail_ == Detail::surface && peak_side_) sharpen_peak();
    s_.half_length = extent_.x.half;
    if (peak_side_) {
      s_.peak_x = peak_x_;
      s_.peak_y = peak_y_;
      s_.peak_z = peak_side_->height_of(peak_line_) + 0.0;  // no negative zero
    }
    return std::move(s_);
  }

 private:
  /// @param from, to distances from the contact's middle [m]
  void add_ys(double from, double to, int count) {
    const QuadratureRule& rule = gauss_rule(count);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double beside = from + (to - from) * rule.nodes[i], width = (to - from) * rule.weights[i];
      if (extent_.mirrored) {
        y_.push_back(beside);
        width_.push_back(2 * width);
        continue;
      }
      for (const double y : {extent_.y.middle - beside, extent_.y.middle + beside}) {
        y_.push_back(y);
        width_.push_back(width);
      }
    }
  }

  /// Of lines of flow beside the contact's middle, on both sides where they differ.
  std::vector<double> ys_around(double middle, double reach, int count) const {
    if (extent_.mirrored) return evenly_spaced(std::max(middle - reach, 0.0), middle + reach, count);
    return evenly_spaced(middle - reach, middle + reach, count);
  }

  void add_lines(const Side& side) {
    const int per_panel = detail_ == Detail::surface ? 6 : 4;
    const std::vector<WeightedLine> weighted =
        lines_across(side.field.medium(), side.field.speed(), extent_.x.half, per_panel);
    std::vector<InteriorLine> lines;
    for (const WeightedLine& line : weighted) lines.push_back(line.line);
    const VolumeFields fields = side.field.at(x_, y_, lines, Wanted::strains);
    const std::array<ArrayXXd, 5> states = states_of(fields);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      CycleSums sums;
      for (std::size_t y = 0; y < y_.size(); ++y) {
        const auto place = static_cast<Index>(i * y_.size() + y);
        const double cycle = amplitude_of(at_place(states, place));
        sums.add(width_[y], fields.line_loss(place), cycle * cycle, cycle);
      }
      s_.lines.push_back({side.on_body, lines[i].layer, side.height_of(lines[i]), weighted[i].weight,
                          fields.plane_loss(static_cast<Index>(i)), sums.mean(), sums.energy});
    }
    add_lines_between(side, weighted, per_panel, states, fields);
    if (detail_ == Detail::surface) take_peak(side, lines, x_, y_, fields);
  }

  /// @param states of each coordinate (point, place)   @param fields of Gauss's lines
  void add_lines_between(const Side& side, const std::vector<WeightedLine>& weighted, int per_panel,
                         const std::array<ArrayXXd, 5>& states, const VolumeFields& fields) {
    constexpr int lines_in_panel = 9;
    const LinesBetween between(per_panel, lines_in_panel);
    const auto in_panel = static_cast<std::size_t>(per_panel), ys = y_.size();
    const std::size_t layers_before = sums_.size();
    sums_.resize(layers_before + side.field.medium().size());
    const double shallowest = std::max(shallowest_, weighted.front().line.depth);
    for (std::size_t first = 0; first < weighted.size(); first += in_panel) {
      const std::vector<WeightedLine> lines = between.lines(std::span(weighted).subspan(first, in_panel));
      // Of a panel's lines at one y.
      const auto at_y = [&](const auto& values, std::size_t y) {
        ArrayXXd of_panel(values.rows(), per_panel);
        for (std::size_t i = 0; i < in_panel; ++i)
          of_panel.col(static_cast<Index>(i)) = values.col(static_cast<Index>((first + i) * ys + y));
        return between(of_panel);
      };
      std::vector<CycleSums> of_line(lines.size());
      for (std::size_t y = 0; y < ys; ++y) {
        const Eigen::MatrixXd losses = at_y(fields.line_loss.transpose(), y);
        std::array<Eigen::MatrixXd, 5> moved;
        for (std::size_t c = 0; c < moved.size(); ++c) moved[c] = at_y(states[c], y);
        for (std::size_t i = 0; i < lines.size(); ++i) {
          const auto column = static_cast<Index>(i);
          const double cycle = amplitude_of(at_place(moved, column));
          of_line[i].add(width_[y], losses(column), cycle * cycle, cycle);
          of_line[i].peak = std::max(of_line[i].peak, cycle);
        }
      }
      const Eigen::MatrixXd losses =
          between(fields.plane_loss.segment(static_cast<Index>(first), per_panel).transpose());
      CycleSums& sums = sums_[layers_before + lines.front().line.layer];
      for (std::size_t i = 0; i < lines.size(); ++i) {
        sums.add(lines[i].weight, losses(static_cast<Index>(i)), of_line[i].energy, of_line[i].mean());
        if (side.field.depth_of(lines[i].line) >= shallowest) sums.peak = std::max(sums.peak, of_line[i].peak);
      }
    }
  }

  /// Both faces of each layer: bonds, and strains that are the largest there.
  void add_faces(const Side& side) {
    const LayeredMedium& medium = side.field.medium();
    for (std::size_t layer = 0; layer < medium.size(); ++layer) {
      std::vector<InteriorLine> faces;
      if (layer > 0) faces.push_back({layer, 0});
      if (std::isfinite(medium[layer].thickness)) faces.push_back({layer, medium[layer].thickness});
      for (const InteriorLine& face : faces) add_face(side, face);
    }
  }

  void add_face(const Side& side, const InteriorLine& face) {
    constexpr int along = 241, across = 41;
    const double reach = extent_.x.half + beside_;
    const std::vector<double> x = evenly_spaced(extent_.x.middle - reach, extent_.x.middle + reach, along);
    const std::vector<double> y =
        ys_around(extent_.y.middle, extent_.y.half + beside_, extent_.mirrored ? across : 2 * across - 1);
    const VolumeFields fields = side.field.at(x, y, {face}, Wanted::all);
    take_peak(side, {face}, x, y, fields);
    if (face.depth < side.field.medium()[face.layer].thickness) return;
    Bond bond{side.on_body, face.layer, side.height_of(face)};
    const ArrayXXd sheared = shear_on_bond(fields);
    for (Index place = 0; place < static_cast<Index>(y.size()); ++place) {
      const Largest shear = largest_of(x, sheared.col(place));
      const Largest tension = largest_of(x, fields.stress_of(Component::z).col(place));
      const double at = y[static_cast<std::size_t>(place)];
      if (shear.value > bond.shear) {
        bond.shear = shear.value;
        bond.shear_x = shear.place;
        bond.shear_y = at;
      }
      if (tension.value > bond.tension) {
        bond.tension = tension.value;
        bond.tension_x = tension.place;
        bond.tension_y = at;
      }
    }
    s_.bonds.push_back(bond);
  }

  void take_peak(const Side& side, const std::vector<InteriorLine>& lines, const std::vector<double>& x,
                 const std::vector<double>& y, const VolumeFields& fields) {
    const ArrayXXd strain = largest_shear_strain(fields);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (side.field.depth_of(lines[i]) < shallowest_) continue;
      for (std::size_t j = 0; j < y.size(); ++j) {
        const Largest found = largest_of(x, strain.col(static_cast<Index>(i * y.size() + j)));
        if (!(found.value > s_.peak_shear_strain)) continue;
        s_.peak_shear_strain = found.value;
        peak_x_ = found.place;
        peak_y_ = y[j];
        peak_side_ = &side;
        peak_line_ = lines[i];
      }
    }
  }

  /// Around the largest strain on lines and points, on finer ones.
  void sharpen_peak() {
    constexpr int passes = 4, points = 9, ys = 7;
    const Side& side = *peak_side_;
    const double thickness = side.field.medium()[peak_line_.layer].thickness;
    double along = 2 * (x_[1] - x_[0]), across = 0.15 * extent_.y.half,
           down = std::min(0.25 * extent_.x.half, 0.25 * thickness);
    for (int pass = 0; pass < passes; ++pass, along /= 3, across /= 3, down /= 3) {
      const std::vector<InteriorLine> lines = lines_around(peak_line_, side.field.medium(), down, shallowest_);
      const std::vector<double> x = evenly_spaced(peak_x_ - along, peak_x_ + along, points);
      const std::vector<double> y = ys_around(peak_y_, across, ys);
      take_peak(side, lines, x, y, side.field.at(x, y, lines, Wanted::strains));
    }
  }

  Detail detail_;
  SphereExtent extent_;
  std::vector<Side> sides_;
  double shallowest_;              // above which strains are those of the grid [m]
  double beside_ = 0;              // the contact, up to where bonds are looked at [m]
  std::vector<double> x_;          // [m]
  std::vector<double> y_, width_;  // of lines of flow, with those at -y of a contact that is its mirror image [m]
  std::vector<CycleSums> sums_;    // of each layer
  InteriorSummary s_;
  const Side* peak_side_ = nullptr;
  InteriorLine peak_line_;
  double peak_x_ = 0, peak_y_ = 0;
};

/// x-z at the contact's middle, y = 0 of one that is its own mirror image.
InteriorSection upright_section(const Side& side, const SphereExtent& extent, const std::vector<double>& x) {
  const SectionRows rows = section_rows(side.field.medium(), side.on_body, extent.x.half);
  InteriorSection section{side.on_body, x, {extent.y.middle}, rows.z, rows.layer, {}};
  section.fields = side.field.at(section.x, section.y, rows.lines, Wanted::density);
  if (!extent.mirrored) return section;
  section.fields.v.resize(0, 0);
  for (const Component odd : {Component::yz, Component::xy}) {
    section.fields.stress_of(odd).resize(0, 0);
    section.fields.strain_of(odd).resize(0, 0);
  }
  return section;
}

}  // namespace

InteriorSummary sphere_summary(const ContactModel& model, const SurfaceFields& fields, Detail detail) {
  return SphereSummary(model, fields, detail).run();
}

std::vector<InteriorSection> sphere_sections(const ContactModel& model, const SurfaceFields& fields) {
  constexpr double sideways = 3;  // in half-lengths
  constexpr int columns = 241, face_columns = 121, face_rows = 81;
  const SphereExtent extent(fields);
  const auto along = [&](const Extent& e, int count) {
    return evenly_spaced(e.middle - sideways * e.half, e.middle + sideways * e.half, count);
  };
  std::vector<InteriorSection> sections;
  for (const Side& side : layers_inside<VolumeField>(model, fields, Detail::surface)) {
    sections.push_back(upright_section(side, extent, along(extent.x, columns)));
    std::vector<InteriorLine> faces{{0, 0}};
    for (std::size_t layer = 0; layer < side.field.medium().size(); ++layer)
      if (std::isfinite(side.field.medium()[layer].thickness))
        faces.push_back({layer, side.field.medium()[layer].thickness});
    for (const InteriorLine& face : faces) {
      InteriorSection section{side.on_body,
                              along(extent.x, face_columns),
                              along(extent.y, face_rows),
                              {side.height_of(face) + 0.0},
                              {face.layer},
                              {}};
      section.fields = side.field.at(section.x, section.y, {face}, Wanted::density);
      sections.push_back(std::move(section));
    }
  }
  for (InteriorSection& section : sections) turn_upwards(section);
  return sections;
}

}  // namespace rollres
