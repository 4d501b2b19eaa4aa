#include "core/model/contact_model.hpp"
#include "core/model/motion_rules.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/messages/message_text.hpp"
#include "core/model/scene_rules.hpp"
#include "core/scene/warmed_layers.hpp"

namespace rollres {

namespace {

/// Share of the tolerance that inertia may take: its effect on the resistance is about rho V^2/G.
constexpr double inertia_share = 0.1;
/// What inertia may take whatever the tolerance, which is one of computing: below it a warning would say nothing
/// either.
constexpr double always_negligible_inertia = 1e-3;

/// Thickness of a coating over the radius below which the bending around its core is left out: it changes R_r by less
/// than so much of it (core/surface/ring_compliance.hpp). The first is over the tolerance.
constexpr double flat_share = 0.1, always_flat = 1e-9;

/// Speed of Rayleigh waves over that of shear waves, squared (Viktorov 1967): 0.912 for nu = 1/2.
double rayleigh_square(double poisson_ratio) {
  return std::pow((0.87 + 1.12 * poisson_ratio) / (1 + poisson_ratio), 2);
}

/// rho V^2/G0 over that of Rayleigh waves, of one layer.
double rayleigh_number(const ModelLayer& layer, double density, double speed) {
  return density * speed * speed / (layer.modulus_at_rest * rayleigh_square(layer.poisson_ratio));
}

/// Whether inertia counts by itself: a tolerance is given, it is not negligible by the modulus at rest, and the model
/// has it: below the speed of Rayleigh waves, with a grid.
bool inertia_counts(const ContactModel& model) {
  // Method spectral, asked for, has none of coatings.
  if (!model.asked_tolerance || (model.asked_method == Method::spectral && !model.coating.empty())) return false;
  const double number = rayleigh_number(model);
  // With inertia a cylinder's coating is flat: of both, what is about to matter more is part of the model.
  const bool bends_more = model.dimension == 2 && model.coating_thickness() > number * model.radius;
  return number > negligible_inertia(model) && number < 1 && !bends_more;
}

/// Of a cylinder whose width is given, a load or torque as the model has it: per metre.
std::optional<double> per_metre(std::optional<double> of_body, const RollingScene& scene) {
  if (of_body && scene.width) *of_body /= *scene.width;
  return of_body;
}

std::optional<LoadedArea> loaded_area(const RollingScene& scene) {
  if (scene.indenter != Indenter::pressure) return std::nullopt;
  return LoadedArea{scene.pressure_shape, scene.pressure_distribution, scene.radius,
                    scene.transverse_radius.value_or(scene.radius), scene.traction_coefficient};
}

std::vector<std::array<double, 2>> deflection_places_of(const RollingScene& scene) {
  std::vector<std::array<double, 2>> places;
  for (std::size_t i = 0; i < std::min(scene.deflection_places_x.size(), scene.deflection_places_y.size()); ++i)
    places.push_back({scene.deflection_places_x[i], scene.deflection_places_y[i]});
  return places;
}

BondedLayer first_layer(const RollingScene& scene) {
  BondedLayer layer;
  static_cast<MaterialInputs&>(layer) = scene;
  layer.layer_thickness = scene.layer_thickness;
  layer.layer_density = scene.layer_density;
  return layer;
}

}  // namespace

ModelLayer::ModelLayer(BondedLayer inputs, const SofteningFactors& factors) : BondedLayer(std::move(inputs)) {
  take_material(factors);
}

void ModelLayer::take_material(const SofteningFactors& factors) {
  creep = creep_spectrum(*this, factors);
  modulus_at_rest = static_modulus(*this, factors);
}

std::vector<std::size_t> layers_of_scene(const std::vector<ModelLayer>& layers) {
  std::vector<std::size_t> places;
  for (const ModelLayer& layer : layers)
    places.push_back(places.empty() ? 0 : places.back() + (layer.continues ? 0 : 1));
  return places;
}

ContactModel::ContactModel(const RollingScene& scene)
    : indenter(scene.indenter),
      dimension(dimension_of(scene.indenter)),
      radius(scene.radius),
      outline(outline_of(scene)),
      loaded(loaded_area(scene)),
      deflection_places(deflection_places_of(scene)),
      width(scene.width),
      kinematics(scene.kinematics),
      speed(scene.speed),
      skew(0),
      camber(scene.camber_angle),
      pivot(scene.pivot),
      side_force(scene.lateral_force ? scene.lateral_force : per_metre(scene.axial_force, scene)),
      load(per_metre(scene.load, scene)),
      approach(scene.approach),
      friction_coefficient(scene.friction_coefficient),
      traction_limit(scene.traction_limit),
      adhesion_threshold(scene.adhesion_threshold),
      drive(scene.drive),
      driving_torque(per_metre(scene.driving_torque, scene)),
      rotation_ratio(scene.rotation_ratio),
      flow(scene.drive == Drive::rotation ? scene.rotation_ratio.value_or(1) : 1),
      inertia(scene.inertia == Inertia::on),
      inertia_automatic(scene.inertia == Inertia::automatic),
      period(scene.period),
      series_terms(scene.series_terms),
      asked_method(scene.method),
      spacing(scene.spacing),
      tolerance(scene.tolerance),
      asked_tolerance(scene.tolerance),
      slip_stencil(scene.slip_stencil),
      slip_threshold(scene.slip_threshold),
      resticking(scene.resticking),
      slip_rule(scene.slip_rule) {
  foundation.emplace_back(first_layer(scene));
  for (const BondedLayer& layer : scene.lower_layers) foundation.emplace_back(layer);
  for (const BondedLayer& layer : scene.coating_layers) coating.emplace_back(layer);
  half_space = std::isinf(foundation.back().layer_thickness);
  if (scene.skew_angle) turn_axle(std::tan(*scene.skew_angle));
  if (scene.heat == Heat::on && scene.ambient_temperature)
    warm(std::vector<double>(warmed().size(), *scene.ambient_temperature));
  decide();
}

void ContactModel::decide() {
  if (inertia_automatic) inertia = inertia_counts(*this);
  bend_coating(std::max(flat_share * asked_tolerance.value_or(0), always_flat));
  estimate.reset();
  coating_share.reset();
  choose_method();
}

void ContactModel::bend_coating(double least) {
  const bool bent = dimension == 2 && !inertia && coating_thickness() > least * radius;
  double face = radius;
  for (ModelLayer& layer : coating) {
    layer.ring_radius = bent ? face : INFINITY;
    face -= layer.layer_thickness;
  }
}

double ContactModel::coating_thickness() const {
  double thickness = 0;
  for (const ModelLayer& layer : coating) thickness += layer.layer_thickness;
  return thickness;
}

void ContactModel::choose_method() {
  method = loaded                                        ? Method::convolution
           : asked_method != Method::automatic           ? asked_method
           : !spacing && spectral_refusal(*this).empty() ? Method::spectral
                                                         : Method::newton;
}

std::vector<const ModelLayer*> ContactModel::layers() const {
  std::vector<const ModelLayer*> all;
  for (const ModelLayer& layer : foundation) all.push_back(&layer);
  for (const ModelLayer& layer : coating) all.push_back(&layer);
  return all;
}

std::array<double, 3> ContactModel::axle() const {
  const double cosine = 1 / std::hypot(1, skew);
  return {-skew * cosine * std::cos(camber), cosine * std::cos(camber), std::sin(camber)};
}

ContactModel ContactModel::with_skew(double tangent) const {
  ContactModel other = *this;
  other.turn_axle(tangent);
  other.decide();
  return other;
}

void ContactModel::turn_axle(double tangent) {
  const double longer = std::hypot(1, tangent) / std::hypot(1, skew);
  skew = tangent;
  if (dimension == 3) return;  // whose frame stays that of the travel
  speed /= longer;
  if (rotation_ratio) *rotation_ratio *= longer;
  if (drive == Drive::rotation) flow *= longer;
}

ContactModel ContactModel::with_flow(double ratio) const {
  ContactModel other = *this;
  other.flow = ratio;
  other.decide();
  return other;
}

ContactModel ContactModel::with_softening(const std::vector<SofteningFactors>& factors) const {
  ContactModel other = *this;
  std::size_t place = 0;
  for (std::vector<ModelLayer>* const layers : {&other.foundation, &other.coating})
    for (ModelLayer& layer : *layers)
      if (place < factors.size()) layer.take_material(factors[place++]);
  other.decide();
  return other;
}

void ContactModel::warm(const std::vector<double>& temperatures) {
  std::vector<ModelLayer>& layers = coating.empty() ? foundation : coating;
  const std::size_t in_each = temperatures.size() / layers.size();
  if (in_each == 0 || in_each * layers.size() != temperatures.size())
    throw std::invalid_argument(message_text("sublayer_temperatures: ", temperatures.size(),
                                             " numbers are not as many for each of ", layers.size(), " layers"));
  const BondedLayers cut = in_sublayers(BondedLayers(layers.begin(), layers.end()), temperatures);
  layers.clear();
  for (const BondedLayer& sublayer : cut) {
    layers.emplace_back(sublayer);
    layers.back().continues = (layers.size() - 1) % in_each > 0;
  }
}

ContactModel ContactModel::with_temperatures(const std::vector<double>& temperatures) const {
  ContactModel other = *this;
  other.warm(temperatures);
  other.decide();
  return other;
}

ContactModel ContactModel::with_answer(const RollingSolution& solution) const {
  std::vector<SofteningFactors> factors;
  for (const std::array<double, 2>& of_layer : solution.moduli_factors) factors.push_back({of_layer[0], of_layer[1]});
  ContactModel softened = *this;
  if (!solution.sublayer_temperatures.empty())
    softened.warm(solution.sublayer_temperatures);
  else if (std::isfinite(solution.mean_temperature))
    softened.warm(std::vector<double>(warmed().size(), solution.mean_temperature));
  softened = softened.with_softening(factors);
  if ((side_force || skew != 0) && std::isfinite(solution.skew_angle))
    softened = softened.with_skew(std::tan(solution.skew_angle));
  if (!std::isfinite(solution.rotation_ratio)) return softened;
  return softened.with_flow(solution.rotation_ratio * (skewed() ? std::hypot(1, softened.skew) : 1));
}

double rayleigh_number(const ContactModel& model) {
  double largest = 0;
  for (const ModelLayer& layer : model.foundation)
    largest = std::max(largest, rayleigh_number(layer, layer.layer_density, model.speed));
  for (const ModelLayer& layer : model.coating)
    largest = std::max(largest, rayleigh_number(layer, layer.layer_density * model.flow * model.flow, model.speed));
  return largest;
}

double negligible_inertia(const ContactModel& model) {
  return std::max(inertia_share * model.asked_tolerance.value_or(0), always_negligible_inertia);
}

}  // namespace rollres
