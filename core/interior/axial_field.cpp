#include "core/interior/axial_field.hpp"

#include <array>
#include <cmath>

#include "core/interior/flow_loss.hpp"
#include "core/interior/interior_field.hpp"
#include "core/interior/surface_tractions.hpp"
#include "core/interior/transverse_response.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

using complex = std::complex<double>;
using Eigen::ArrayXcd;
using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

namespace {

/// R ln(R/r) below a ring's face, the depth itself below a flat one [m].
double flat_depth(const LayeredMedium& medium, double depth) {
  return FaceDepth::of(medium.front().radius, depth).decay;
}

LayeredMedium flattened(LayeredMedium medium) {
  const LayeredMedium rings = medium;
  double above = 0;
  for (MediumLayer& layer : medium) {
    const double below = above + layer.thickness;
    if (std::isfinite(layer.thickness)) layer.thickness = flat_depth(rings, below) - flat_depth(rings, above);
    layer.radius = INFINITY;
    above = below;
  }
  return medium;
}

}  // namespace

AxialField::AxialField(const LayeredMedium& medium, double speed, double flow, const SurfaceFields& fields,
                       InteriorWaves waves)
    : medium_(medium), flat_(flattened(medium)), speed_(speed), flow_(flow), waves_(std::move(waves)) {
  const SurfaceGrid& grid = fields.grid;
  traction_ = ArrayXcd::Zero(waves_.k.size());
  for (int i = 0; i < grid.columns; ++i) {
    const double shear = fields.shear_y[static_cast<std::size_t>(i)];
    if (shear == 0) continue;
    traction_.real() += shear * (waves_.k * grid.x(i)).cos();
    traction_.imag() -= shear * (waves_.k * grid.x(i)).sin();
  }
  const ArrayXd half = 0.5 * grid.spacing_x * waves_.k;
  traction_ *= (grid.spacing_x * half.sin() / half).cast<complex>();
  for (const MediumLayer& layer : medium_)
    compliance_.push_back(waves_.k.unaryExpr([&](double k) { return layer.material(-k * speed_); }));
}

std::vector<AxialField::Line> AxialField::waves_on(const std::vector<InteriorLine>& lines, ArrayXd& line_loss) const {
  const Index waves = waves_.k.size();
  std::vector<Line> all;
  for (const InteriorLine& line : lines) {
    const double depth = depth_of(medium_, line), face = depth - line.depth;
    all.push_back({line.layer, flat_depth(medium_, depth) - flat_depth(medium_, face),
                   1 / (1 - depth / medium_.front().radius), ArrayXcd(waves), ArrayXcd(waves), ArrayXcd(waves)});
  }
  for (Index wave = 0; wave < waves; ++wave) {
    require_time();
    const double k = waves_.k(wave);
    std::vector<complex> moduli;
    for (const ArrayXcd& compliance : compliance_) moduli.push_back(1.0 / compliance(wave));
    const TransverseResponse response(flat_, moduli, k, speed_, traction_(wave));
    for (std::size_t i = 0; i < all.size(); ++i) {
      Line& line = all[i];
      const TransverseResponse::State at = response.at(line.layer, line.flat_depth);
      line.xy(wave) = line.stretch * at.along;
      line.yz(wave) = line.stretch * at.across_z;
      line.v(wave) = at.u;
      if (!creeps(medium_[line.layer].material)) continue;
      // A line is the shorter the deeper it lies in a ring.
      const double lost = (std::norm(line.xy(wave)) + std::norm(line.yz(wave))) / line.stretch;
      line_loss(static_cast<Index>(i)) +=
          waves_.weight(wave) / M_PI * flow_ * speed_ * k * compliance_[line.layer](wave).imag() * lost;
    }
  }
  return all;
}

void AxialField::add_to(VolumeFields& f, const std::vector<double>& x, const std::vector<InteriorLine>& lines) const {
  const std::vector<Line> all = waves_on(lines, f.line_loss);
  const auto points = static_cast<Index>(x.size()), count = static_cast<Index>(lines.size()), waves = waves_.k.size();
  const Component sheared[] = {Component::xy, Component::yz};
  for (const Component c : sheared) f.stress_of(c) = f.strain_of(c) = ArrayXXd::Zero(points, count);
  f.v = ArrayXXd::Zero(points, count);
  if (points == 0) return;
  const ArrayXd places = Eigen::Map<const ArrayXd>(x.data(), points);
  const ArrayXXd phase = (places.matrix() * waves_.k.matrix().transpose()).array();
  const Eigen::MatrixXd cosine = phase.cos().matrix(), sine = phase.sin().matrix();
  const ArrayXd weight =
      waves_.weight / M_PI * waves_.k.unaryExpr([&](double k) { return faded(k, waves_.k(waves - 1)); });
  const bool at_rest_far_away = std::isfinite(medium_.back().thickness);
  for (Index column = 0; column < count; ++column) {
    require_time();
    const Line& line = all[static_cast<std::size_t>(column)];
    const auto sum = [&](const ArrayXcd& amplitudes) -> ArrayXd {
      return cosine * (weight * amplitudes.real()).matrix() - sine * (weight * amplitudes.imag()).matrix();
    };
    for (const Component c : sheared) {
      const ArrayXcd& stress = c == Component::xy ? line.xy : line.yz;
      f.stress_of(c).col(column) = sum(stress);
      f.strain_of(c).col(column) = sum(compliance_[line.layer] * stress);
    }
    if (at_rest_far_away) f.v.col(column) = sum(line.v);
    if (f.loss_density.size() > 0 && points > 1) add_density(f, places, column, line);
  }
}

void AxialField::add_density(VolumeFields& f, const ArrayXd& x, Index column, const Line& line) const {
  const CreepSpectrum& material = medium_[line.layer].material;
  ArrayXXd stress(2, x.size()), ahead = ArrayXXd::Zero(2, std::ssize(material.terms));
  stress << f.stress_of(Component::xy).col(column).transpose(), f.stress_of(Component::yz).col(column).transpose();
  for (Index wave = 0; wave < waves_.k.size(); ++wave) {
    const double k = waves_.k(wave);
    add_memories(ahead, material, k, speed_, waves_.weight(wave) / M_PI * std::polar(1.0, k * first_passed(x, speed_)),
                 std::array{line.xy(wave), line.yz(wave)});
  }
  f.loss_density.col(column) += density_on_line(stress, ahead, material, x(1) - x(0), speed_, flow_,
                                                [](const ArrayXd& tau) { return tau.square().sum(); });
}

}  // namespace rollres
