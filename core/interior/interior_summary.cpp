#include "core/interior/interior_summary.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/interior/cylinder_inside.hpp"
#include "core/interior/sphere_inside.hpp"

namespace rollres {

void add_totals(InteriorSummary& s, const std::vector<CycleSums>& between, double missed) {
  constexpr double left = 0.5;  // of what lines between those of Gauss's rule change in the mean
  std::vector<CycleSums> on_lines;
  for (const LineOfFlow& line : s.lines) {
    if (s.layers.empty() || s.layers.back().layer != line.layer || s.layers.back().on_body != line.on_body) {
      s.layers.push_back({line.on_body, line.layer, 0, 0, 0, 0});
      on_lines.emplace_back();
    }
    s.layers.back().loss += line.thickness * line.loss;
    s.loss += line.thickness * line.loss;
    on_lines.back().add(line.thickness, line.loss, line.energy, line.strain_amplitude);
  }
  double weights = 0, plain = 0;
  for (std::size_t i = 0; i < s.layers.size(); ++i) {
    LayerLoss& layer = s.layers[i];
    layer.strain_amplitude = between[i].mean();
    layer.amplitude_error =
        left * std::abs(on_lines[i].mean() - layer.strain_amplitude) + missed * layer.strain_amplitude;
    layer.peak_strain_amplitude = between[i].peak;
    s.peak_strain_amplitude = std::max(s.peak_strain_amplitude, layer.peak_strain_amplitude);
    const double lost = std::abs(layer.loss);
    weights += lost;
    s.strain_amplitude += lost * layer.strain_amplitude;
    plain += layer.strain_amplitude;
  }
  s.strain_amplitude = weights > 0 ? s.strain_amplitude / weights : plain / static_cast<double>(s.layers.size());
}

/// Of the strains' deviator e with J2 = e : e/2 and J3 = det e, whose principal values are 2 sqrt(J2/3) cos(theta + 2
/// pi i/3), cos(3 theta) = sqrt(27) J3/(2 J2^1.5): their largest difference is 2 sqrt(J2) sin(theta + pi/3).
Eigen::ArrayXXd largest_shear_strain(const VolumeFields& f) {
  const Eigen::ArrayXXd& x = f.strain_of(Component::x);
  if (f.strain_of(Component::y).size() == 0 && f.strain_of(Component::yz).size() == 0)
    return ((x - f.strain_of(Component::z)).square() + f.strain_of(Component::xz).square()).sqrt();
  const auto of = [&](Component c) {
    const Eigen::ArrayXXd& strain = f.strain_of(c);
    return strain.size() > 0 ? strain : Eigen::ArrayXXd::Zero(x.rows(), x.cols()).eval();
  };
  const Eigen::ArrayXXd y = of(Component::y);
  const Eigen::ArrayXXd& z = f.strain_of(Component::z);
  const Eigen::ArrayXXd yz = 0.5 * of(Component::yz), xz = 0.5 * of(Component::xz), xy = 0.5 * of(Component::xy);
  const Eigen::ArrayXXd mean = (x + y + z) / 3, ex = x - mean, ey = y - mean, ez = z - mean;
  const Eigen::ArrayXXd j2 = 0.5 * (ex.square() + ey.square() + ez.square()) + yz.square() + xz.square() + xy.square();
  const Eigen::ArrayXXd j3 = ex * (ey * ez - yz.square()) - xy * (xy * ez - yz * xz) + xz * (xy * yz - ey * xz);
  const Eigen::ArrayXXd cosine = (j2 > 0).select(std::sqrt(6.75) * j3 / (j2 * j2.sqrt()), 0.0).max(-1.0).min(1.0);
  return 2 * j2.sqrt() * (cosine.acos() / 3 + M_PI / 3).sin();
}

Eigen::ArrayXXd shear_on_bond(const VolumeFields& f) {
  if (f.stress_of(Component::yz).size() == 0) return f.stress_of(Component::xz).abs();
  return (f.stress_of(Component::xz).square() + f.stress_of(Component::yz).square()).sqrt();
}

void turn_upwards(InteriorSection& section) {
  VolumeFields& f = section.fields;
  if (!section.on_body) return;
  f.w = -f.w;
  for (const Component c : {Component::yz, Component::xz}) {
    f.stress_of(c) = -f.stress_of(c);
    f.strain_of(c) = -f.strain_of(c);
  }
}

namespace {

struct LayersOfScene {
  explicit LayersOfScene(const ContactModel& model)
      : under(layers_of_scene(model.foundation)), on_body(layers_of_scene(model.coating)) {}
  std::size_t place(bool of_body, std::size_t layer) const { return (of_body ? on_body : under)[layer]; }
  bool ends(bool of_body, std::size_t layer) const {
    const std::vector<std::size_t>& places = of_body ? on_body : under;
    return layer + 1 == places.size() || places[layer + 1] != places[layer];
  }
  std::vector<std::size_t> under, on_body;
};

/// Two sublayers as one.
LayerLoss joined(const LayerLoss& a, const LayerLoss& b) {
  const double lost = std::abs(a.loss) + std::abs(b.loss), share = lost > 0 ? std::abs(a.loss) / lost : 0.5;
  const auto mean = [&](double of_a, double of_b) { return share * of_a + (1 - share) * of_b; };
  return {a.on_body,
          a.layer,
          a.loss + b.loss,
          mean(a.strain_amplitude, b.strain_amplitude),
          mean(a.amplitude_error, b.amplitude_error),
          std::max(a.peak_strain_amplitude, b.peak_strain_amplitude)};
}

/// Counts layers as the scene does.
InteriorSummary with_layers_of_scene(const ContactModel& model, InteriorSummary s) {
  const LayersOfScene of_scene(model);
  std::erase_if(s.bonds, [&](const Bond& bond) { return !of_scene.ends(bond.on_body, bond.layer); });
  for (Bond& bond : s.bonds) bond.layer = of_scene.place(bond.on_body, bond.layer);
  for (LineOfFlow& line : s.lines) line.layer = of_scene.place(line.on_body, line.layer);
  std::vector<LayerLoss> layers;
  for (LayerLoss& layer : s.layers) {
    layer.layer = of_scene.place(layer.on_body, layer.layer);
    if (!layers.empty() && layers.back().on_body == layer.on_body && layers.back().layer == layer.layer)
      layers.back() = joined(layers.back(), layer);
    else
      layers.push_back(layer);
  }
  s.layers = std::move(layers);
  return s;
}

}  // namespace

InteriorSummary interior_summary(const ContactModel& model, const SurfaceFields& fields, InteriorField::Detail detail) {
  return model.dimension == 3 ? sphere_summary(model, fields, detail) : cylinder_summary(model, fields, detail);
}

InteriorSummary inside_of_answer(const ContactModel& model, const RollingSolution& solution) {
  const ContactModel solved = model.with_answer(solution);
  return with_layers_of_scene(solved, interior_summary(solved, solution.fields, InteriorField::Detail::surface));
}

std::vector<InteriorSection> interior_sections(const ContactModel& model, const SurfaceFields& fields) {
  std::vector<InteriorSection> sections =
      model.dimension == 3 ? sphere_sections(model, fields) : cylinder_sections(model, fields);
  const LayersOfScene of_scene(model);
  for (InteriorSection& section : sections)
    for (std::size_t& layer : section.layer) layer = of_scene.place(section.on_body, layer);
  return sections;
}

void add_interior(const ContactModel& model, RollingSolution& solution) {
  const InteriorSummary s = inside_of_answer(model, solution);
  solution.peak_shear_strain = s.peak_shear_strain;
  solution.peak_shear_strain_x = s.peak_x;
  if (model.dimension == 3) solution.peak_shear_strain_y = s.peak_y;
  solution.peak_shear_strain_z = s.peak_z;
  // Where moduli depend on it, the amplitude is the one that they were found with.
  if (!std::isfinite(solution.strain_amplitude)) {
    solution.strain_amplitude = s.strain_amplitude;
    solution.peak_strain_amplitude = s.peak_strain_amplitude;
  }
  solution.interior_loss = s.loss;
  if (s.bonds.empty()) return;
  solution.bond_shear = solution.bond_tension = 0;
  solution.bond_shears.assign(model.foundation.size() + model.coating.size(), 0);  // a half-space ends nowhere
  solution.bond_tensions = solution.bond_shears;
  for (const Bond& bond : s.bonds) {
    const std::size_t place = bond.layer + (bond.on_body ? model.foundation.size() : 0);
    solution.bond_shears[place] = bond.shear;
    solution.bond_tensions[place] = bond.tension;
  }
  solution.bond_shear = *std::max_element(solution.bond_shears.begin(), solution.bond_shears.end());
  solution.bond_tension = *std::max_element(solution.bond_tensions.begin(), solution.bond_tensions.end());
}

}  // namespace rollres
