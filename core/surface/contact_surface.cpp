#include "core/surface/contact_surface.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

/// Wavenumber times thickness that stands for 0.
constexpr double long_wave = 1e-4;
/// Share of the tolerance that inertia may take: its effect on the resistance is about rho V^2/G.
constexpr double inertia_share = 0.1;
/// What inertia may take whatever the tolerance, which is one of computing: below it a warning would say nothing
/// either.
constexpr double always_negligible_inertia = 1e-3;

/// Speed of Rayleigh waves over that of shear waves, squared (Viktorov 1967): 0.912 for nu = 1/2.
double rayleigh_square(double poisson_ratio) {
  return std::pow((0.87 + 1.12 * poisson_ratio) / (1 + poisson_ratio), 2);
}

/// rho V^2/G0 over that of Rayleigh waves, of one layer.
double rayleigh_number(const MaterialInputs& material, double density, double speed) {
  return density * speed * speed / (static_modulus(material) * rayleigh_square(material.poisson_ratio));
}

MediumLayer medium_layer(const MaterialInputs& material, double thickness, double density) {
  return {thickness, material.poisson_ratio, density, creep_spectrum(material)};
}

/// Of a coating, with the inertia at V that it has at R Omega [kg/m3].
double density_in_flow(const RollingScene& scene, const BondedLayer& coating) {
  const double flow = flow_of_coating(scene);
  return coating.layer_density * flow * flow;
}

/// All layers under (or on) the body with their densities.
LayeredMedium all_under(const RollingScene& scene) {
  LayeredMedium medium{medium_layer(scene, scene.layer_thickness, scene.layer_density)};
  for (const BondedLayer& layer : scene.lower_layers)
    medium.push_back(medium_layer(layer, layer.layer_thickness, layer.layer_density));
  return medium;
}

LayeredMedium all_on(const RollingScene& scene) {
  LayeredMedium medium;
  for (const BondedLayer& layer : scene.coating_layers)
    medium.push_back(
        {layer.layer_thickness, layer.poisson_ratio, density_in_flow(scene, layer), creep_in_flow(scene, layer)});
  return medium;
}

/// Of the surface and that of the body: the cross terms are opposite.
SurfaceCompliance together(const SurfaceCompliance& below, const SurfaceCompliance& body) {
  return {below.normal + body.normal, below.longitudinal + body.longitudinal, below.cross - body.cross,
          below.transverse + body.transverse};
}

bool coating_remembers(const RollingScene& scene) {
  return std::any_of(scene.coating_layers.begin(), scene.coating_layers.end(), [](const BondedLayer& layer) {
    const CreepSpectrum creep = creep_spectrum(layer);
    return std::any_of(creep.terms.begin(), creep.terms.end(),
                       [](const CreepSpectrum::Term& term) { return term.compliance > 0 && term.time > 0; });
  });
}

/// As the scene's model has it.
LayeredMedium modelled(const RollingScene& scene, LayeredMedium medium, const MemoryRange& told_apart) {
  const bool inertia = inertia_included(scene);
  for (MediumLayer& layer : medium) {
    if (!inertia) layer.density = 0;
    layer.material = lumped(layer.material, told_apart);
  }
  return medium;
}

}  // namespace

double flow_of_coating(const RollingScene& scene) {
  if (scene.coating_flow) return *scene.coating_flow;
  return scene.drive == Drive::rotation ? scene.rotation_ratio.value_or(1) : 1;
}

bool coating_flow_counts(const RollingScene& scene) {
  return !scene.coating_layers.empty() && (inertia_included(scene) || coating_remembers(scene));
}

bool coating_remembers_ahead(const RollingScene& scene) {
  return flow_of_coating(scene) < 0 && coating_remembers(scene);
}

CreepSpectrum creep_in_flow(const RollingScene& scene, const BondedLayer& coating) {
  CreepSpectrum spectrum = creep_spectrum(coating);
  const double flow = std::abs(flow_of_coating(scene));
  if (flow == 0) return {.instantaneous = spectrum.at_rest(), .terms = {}};
  for (CreepSpectrum::Term& term : spectrum.terms) term.time *= flow;
  return spectrum;
}

double rayleigh_number(const RollingScene& scene) {
  double largest = rayleigh_number(scene, scene.layer_density, scene.speed);
  for (const BondedLayer& layer : scene.lower_layers)
    largest = std::max(largest, rayleigh_number(layer, layer.layer_density, scene.speed));
  for (const BondedLayer& layer : scene.coating_layers)
    largest = std::max(largest, rayleigh_number(layer, density_in_flow(scene, layer), scene.speed));
  return largest;
}

bool layers_carry_slower_waves(const RollingScene& scene) {
  return carries_slower_waves(all_under(scene), scene.speed) || carries_slower_waves(all_on(scene), scene.speed);
}

double negligible_inertia(const RollingScene& scene) {
  return std::max(inertia_share * scene.tolerance.value_or(0), always_negligible_inertia);
}

bool inertia_included(const RollingScene& scene) {
  if (scene.inertia != Inertia::automatic) return scene.inertia == Inertia::on;
  // Method spectral, asked for, has none of coatings.
  if (!scene.tolerance || (scene.method == Method::spectral && !scene.coating_layers.empty())) return false;
  const double number = rayleigh_number(scene);
  return number > negligible_inertia(scene) && number < 1;
}

bool is_composite(const RollingScene& scene) {
  return !scene.lower_layers.empty() || !scene.coating_layers.empty() || inertia_included(scene);
}

LayeredMedium foundation_of(const RollingScene& scene, const MemoryRange& told_apart) {
  return modelled(scene, all_under(scene), told_apart);
}

LayeredMedium coating_of(const RollingScene& scene, const MemoryRange& told_apart) {
  return modelled(scene, all_on(scene), told_apart);
}

RollingScene coating_alone(const RollingScene& scene) {
  RollingScene alone = scene;
  const double flow = std::abs(flow_of_coating(scene));
  BondedLayers layers = scene.coating_layers;
  if (flow == 0)
    for (BondedLayer& layer : layers) {
      BondedLayer resting;
      resting.material = MaterialModel::elastic;
      resting.static_shear_modulus = 1 / creep_spectrum(layer).at_rest();
      resting.poisson_ratio = layer.poisson_ratio;
      resting.layer_thickness = layer.layer_thickness;
      resting.layer_density = 0;
      layer = resting;
    }
  static_cast<MaterialInputs&>(alone) = layers.front();
  alone.layer_thickness = layers.front().layer_thickness;
  alone.layer_density = layers.front().layer_density;
  alone.lower_layers.assign(layers.begin() + 1, layers.end());
  alone.coating_layers.clear();
  alone.coating_flow.reset();
  alone.inertia = inertia_included(scene) ? Inertia::on : Inertia::off;
  if (flow > 0) alone.speed *= flow;
  return alone;
}

double share_of_coating(const RollingScene& scene, double half_width) {
  if (scene.coating_layers.empty()) return 0;
  const auto yields = [&](const LayeredMedium& medium) {
    return std::abs(surface_compliance(medium, 1 / half_width, 1, scene.speed).normal);
  };
  const double coating = yields(coating_of(scene)), foundation = yields(foundation_of(scene));
  return coating / (coating + foundation);
}

double total_thickness(const RollingScene& scene) {
  double sum = scene.layer_thickness;
  for (const BondedLayer& layer : scene.lower_layers) sum += layer.layer_thickness;
  for (const BondedLayer& layer : scene.coating_layers) sum += layer.layer_thickness;
  return sum;
}

double finite_thickness(const RollingScene& scene) {
  return finite_thickness(all_under(scene)) + finite_thickness(all_on(scene));
}

bool has_rigid_base(const RollingScene& scene) {
  return std::isfinite(scene.lower_layers.empty() ? scene.layer_thickness : scene.lower_layers.back().layer_thickness);
}

double nearest_interface(const RollingScene& scene) {
  return std::min(scene.layer_thickness,
                  scene.coating_layers.empty() ? INFINITY : scene.coating_layers.front().layer_thickness);
}

CreepSpectrum near_spectrum(const RollingScene& scene, const MemoryRange& told_apart) {
  CreepSpectrum sum;
  const auto add = [&](const MaterialInputs& material, const CreepSpectrum& all) {
    const double share = 2 * (1 - material.poisson_ratio);
    const CreepSpectrum spectrum = lumped(all, told_apart);
    sum.instantaneous += share * spectrum.instantaneous;
    for (const CreepSpectrum::Term& term : spectrum.terms) sum.terms.push_back({share * term.compliance, term.time});
  };
  add(scene, creep_spectrum(scene));
  if (scene.coating_layers.empty()) return sum;
  add(scene.coating_layers.front(), creep_in_flow(scene, scene.coating_layers.front()));
  std::sort(sum.terms.begin(), sum.terms.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  std::vector<CreepSpectrum::Term> joined;
  for (const CreepSpectrum::Term& term : sum.terms) {
    if (joined.empty() || joined.back().time < term.time)
      joined.push_back(term);
    else
      joined.back().compliance += term.compliance;
  }
  sum.terms = std::move(joined);
  return sum;
}

std::string surface_in_words(const RollingScene& scene) {
  const bool half_space = !has_rigid_base(scene);
  const std::size_t layers = 1 + scene.lower_layers.size() - (half_space ? 1 : 0);
  std::string text = layers == 0   ? ""
                     : layers == 1 ? "one layer bonded to "
                                   : std::to_string(layers) + " layers bonded to each other and to ";
  text += half_space ? "a half-space" : "a rigid base";
  const std::size_t coats = scene.coating_layers.size();
  if (coats == 0) return text + ", rigid body";
  return text + ", rigid body with " + (coats == 1 ? "a coating" : std::to_string(coats) + " coatings");
}

SteadySurface::SteadySurface(const RollingScene& scene, const MemoryRange& told_apart)
    : composite_(is_composite(scene)),
      backwards_(flow_of_coating(scene) < 0),
      layer_(layer_of(scene)),
      speed_(scene.speed),
      thickness_(total_thickness(scene)),
      material_(lumped(creep_spectrum(scene), told_apart)) {
  if (!composite_) return;
  foundation_ = foundation_of(scene, told_apart);
  coating_ = coating_of(scene, told_apart);
}

SteadySurface::Moduli SteadySurface::moduli(double along) const {
  const double omega = -along * speed_;
  if (!composite_) return {material_(omega), {}, {}};
  return {1, moduli_at(foundation_, omega), moduli_at(coating_, backwards_ ? -omega : omega)};
}

SurfaceCompliance SteadySurface::operator()(const Moduli& moduli, double along, double across) const {
  require_time();
  double k = std::hypot(along, across);
  if (!composite_) {
    const LayerSymbols c = layer_symbols(k, layer_);
    const std::complex<double>& j = moduli.compliance;
    return {j * c.normal, j * c.longitudinal, j * c.cross, j * c.transverse};
  }
  const double wave_speed = k > 0 ? speed_ * along / k : 0;
  if (k == 0) k = long_wave / thickness_;  // the limit, to all digits that matter
  const SurfaceCompliance below = surface_compliance(foundation_, moduli.foundation, k, wave_speed);
  if (coating_.empty()) return below;
  return together(below, surface_compliance(coating_, moduli.coating, k, wave_speed));
}

SurfaceCompliance SteadySurface::half_spaces(const Moduli& moduli) const {
  if (!composite_) {
    const LayerSymbols c = half_space_symbols(layer_.poisson_ratio);
    const std::complex<double>& j = moduli.compliance;
    return {j * c.normal, j * c.longitudinal, j * c.cross, j * c.transverse};
  }
  const SurfaceCompliance below = half_space_compliance(foundation_.front(), moduli.foundation.front(), speed_);
  if (coating_.empty()) return below;
  return together(below, half_space_compliance(coating_.front(), moduli.coating.front(), speed_));
}

SurfaceCompliance SteadySurface::long_waves() const {
  if (!composite_) return std::isinf(layer_.thickness) ? half_spaces(moduli(0)) : SurfaceCompliance{};
  if (std::isfinite(foundation_.back().thickness)) return {};
  return half_space_compliance(foundation_.back(), 1.0 / foundation_.back().material(0), speed_);
}

double SteadySurface::longest_wave() const {
  double softest = INFINITY, hardest = 0, time = 0;
  const auto take = [&](const CreepSpectrum& material) {
    softest = std::min(softest, 1 / material.at_rest());
    hardest = std::max(hardest, 1 / material.at_rest());
    for (const CreepSpectrum::Term& term : material.terms) time = std::max(time, term.time);
  };
  take(material_);
  for (const LayeredMedium* const medium : {&foundation_, &coating_})
    for (const MediumLayer& layer : *medium) take(layer.material);
  const double thickness = composite_ ? finite_thickness(foundation_) + finite_thickness(coating_) : layer_.thickness;
  return std::max((std::isinf(thickness) ? 0 : thickness) * std::cbrt(hardest / softest), speed_ * time);
}

}  // namespace rollres
