#include "core/model/contact_surface.hpp"

#include <algorithm>
#include <cmath>

#include "core/messages/message_text.hpp"

namespace rollres {

namespace {

/// As motion meets it, with the inertia that it has.
MediumLayer medium_layer(const ModelLayer& layer) {
  return {layer.layer_thickness, layer.poisson_ratio, layer.layer_density, layer.creep, layer.ring_radius};
}

/// All layers under (or on) the body with their densities.
LayeredMedium all_under(const ContactModel& model) {
  LayeredMedium medium;
  for (const ModelLayer& layer : model.foundation) medium.push_back(medium_layer(layer));
  return medium;
}

/// With the inertia at V that they have at R Omega.
LayeredMedium all_on(const ContactModel& model) {
  LayeredMedium medium;
  for (const ModelLayer& layer : model.coating) {
    medium.push_back(medium_layer(layer));
    medium.back().density *= model.flow * model.flow;
    medium.back().material = creep_in_flow(model, layer);
  }
  return medium;
}

bool coating_remembers(const ContactModel& model) {
  return std::any_of(model.coating.begin(), model.coating.end(), [](const ModelLayer& layer) {
    return std::any_of(layer.creep.terms.begin(), layer.creep.terms.end(),
                       [](const CreepSpectrum::Term& term) { return term.compliance > 0 && term.time > 0; });
  });
}

/// As the model has it.
LayeredMedium modelled(const ContactModel& model, LayeredMedium medium, const MemoryRange& told_apart) {
  for (MediumLayer& layer : medium) {
    if (!model.inertia) layer.density = 0;
    layer.material = lumped(layer.material, told_apart);
  }
  return medium;
}

}  // namespace

bool coating_flow_counts(const ContactModel& model) {
  return !model.coating.empty() && (model.inertia || coating_remembers(model));
}

bool coating_remembers_ahead(const ContactModel& model) { return model.flow < 0 && coating_remembers(model); }

CreepSpectrum creep_in_flow(const ContactModel& model, const ModelLayer& coating) {
  CreepSpectrum spectrum = coating.creep;
  const double flow = std::abs(model.flow);
  if (flow == 0) return {.instantaneous = spectrum.at_rest(), .terms = {}};
  for (CreepSpectrum::Term& term : spectrum.terms) term.time *= flow;
  return spectrum;
}

bool layers_carry_slower_waves(const ContactModel& model) {
  return carries_slower_waves(all_under(model), model.speed) || carries_slower_waves(all_on(model), model.speed);
}

LayeredMedium foundation_of(const ContactModel& model, const MemoryRange& told_apart) {
  return modelled(model, all_under(model), told_apart);
}

LayeredMedium coating_of(const ContactModel& model, const MemoryRange& told_apart) {
  return modelled(model, all_on(model), told_apart);
}

SteadySurface steady_surface(const ContactModel& model, const MemoryRange& told_apart) {
  if (!model.composite()) return {model.layer(), lumped(model.top().creep, told_apart), model.speed};
  return {{foundation_of(model, told_apart), coating_of(model, told_apart), model.flow < 0}, model.speed};
}

ContactModel coating_alone(const ContactModel& model) {
  ContactModel alone = model;
  const double flow = std::abs(model.flow);
  alone.foundation = std::move(alone.coating);
  alone.coating.clear();
  alone.estimate.reset();
  alone.coating_share.reset();
  if (flow == 0)
    for (ModelLayer& layer : alone.foundation) {
      layer.creep = {.instantaneous = layer.creep.at_rest(), .terms = {}};
      layer.layer_density = 0;
    }
  else
    alone.speed *= flow;
  return alone;
}

ContactModel foundation_alone(const ContactModel& model) {
  ContactModel alone = model;
  alone.coating.clear();
  alone.estimate.reset();
  alone.coating_share.reset();
  return alone;
}

bool has_elastic_foundation(const ContactModel& model) {
  return std::all_of(model.foundation.begin(), model.foundation.end(),
                     [](const ModelLayer& layer) { return layer.creep.terms.empty(); });
}

double share_of_coating(const ContactModel& model, double half_width) {
  if (model.coating.empty()) return 0;
  const auto yields = [&](const LayeredMedium& medium) {
    return std::abs(surface_compliance(medium, 1 / half_width, 1, model.speed).normal);
  };
  const double coating = yields(coating_of(model)), foundation = yields(foundation_of(model));
  return coating / (coating + foundation);
}

double left_after_turn(const ContactModel& model) {
  if (!model.ring()) return 0;
  constexpr double elastic_decay = 0.74;  // of an incompressible layer, over a thickness (surface/layer_slopes.hpp)
  const std::vector<ModelLayer>& rings = model.coating.empty() ? model.foundation : model.coating;
  const double turn = 2 * M_PI * model.radius;
  double thickness = 0, most = 0;
  for (const ModelLayer& ring : rings) thickness += ring.layer_thickness;
  for (const ModelLayer& ring : rings) {
    const CreepSpectrum creep = model.coating.empty() ? ring.creep : creep_in_flow(model, ring);
    // A long memory sees the ring's longest waves, under pressure at constant volume (H k)^3 of it.
    const double power = ring.poisson_ratio == 0.5 && model.friction_coefficient == 0 ? 3 : 1;
    double left = 0;
    for (const CreepSpectrum::Term& term : creep.terms)
      if (const double length = model.speed * term.time; length > 0)
        // e^(-turn/length) of the last one, the square of it of the one before, ...
        left += term.compliance / creep.at_rest() * std::pow(std::min(1.0, thickness / length), power) /
                std::expm1(turn / length);
    most = std::max(most, left);
  }
  return std::max(std::exp(-elastic_decay * turn / thickness), most);
}

bool feels_earlier_turns(const ContactModel& model) {
  constexpr double least = 1e-8, part_of_tolerance = 0.03;
  return left_after_turn(model) > std::max(least, part_of_tolerance * model.asked_tolerance.value_or(0));
}

SteadySurface ring_alone(const ContactModel& model) {
  ContactModel alone = model.coating.empty() ? model : coating_alone(model);
  // What is displaced in the mean grows with the memory. One of so many radii is as good as unending at whole
  // harmonics, to 1e-8, and leaves half of the digits.
  const double longest = 1e8 * alone.radius / alone.speed;
  for (ModelLayer& layer : alone.foundation)
    for (CreepSpectrum::Term& term : layer.creep.terms) term.time = std::min(term.time, longest);
  return steady_surface(alone);
}

double total_thickness(const ContactModel& model) {
  double sum = 0;
  for (const ModelLayer* const layer : model.layers()) sum += layer->layer_thickness;
  return sum;
}

double finite_thickness(const ContactModel& model) {
  return finite_thickness(all_under(model)) + finite_thickness(all_on(model));
}

bool has_rigid_base(const ContactModel& model) { return std::isfinite(model.foundation.back().layer_thickness); }

double nearest_interface(const ContactModel& model) {
  return std::min(model.top().layer_thickness,
                  model.coating.empty() ? INFINITY : model.coating.front().layer_thickness);
}

CreepSpectrum near_spectrum(const ContactModel& model, const MemoryRange& told_apart) {
  CreepSpectrum sum;
  const auto add = [&](const ModelLayer& layer, const CreepSpectrum& all) {
    const double share = 2 * (1 - layer.poisson_ratio);
    const CreepSpectrum spectrum = lumped(all, told_apart);
    sum.instantaneous += share * spectrum.instantaneous;
    for (const CreepSpectrum::Term& term : spectrum.terms) sum.terms.push_back({share * term.compliance, term.time});
  };
  add(model.top(), model.top().creep);
  if (model.coating.empty()) return sum;
  add(model.coating.front(), creep_in_flow(model, model.coating.front()));
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

std::string coating_in_words(const ContactModel& model) {
  if (model.coating.empty()) return {};
  const std::string share = message_text<4>("H/R = ", model.coating_thickness() / model.radius);
  if (!model.ring())
    return "the coating is taken as flat, " + share +
           (model.dimension == 3 ? ": a sphere's is"
            : model.inertia      ? ": with inertia it is"
                                 : ": the core is not felt");
  return "the coating is a ring on the core, " + share +
         (feels_earlier_turns(model)
              ? message_text<4>(", with earlier turns, of which about ", left_after_turn(model), " is left")
              : ", recovered when it comes round again");
}

std::string surface_in_words(const ContactModel& model) {
  const bool half_space = !has_rigid_base(model);
  const std::size_t layers = layers_of_scene(model.foundation).back() + (half_space ? 0 : 1);
  std::string text = layers == 0   ? ""
                     : layers == 1 ? "one layer bonded to "
                                   : std::to_string(layers) + " layers bonded to each other and to ";
  text += half_space ? "a half-space" : "a rigid base";
  if (model.loaded) return text;
  if (model.coating.empty()) return text + ", rigid body";
  const std::size_t coats = layers_of_scene(model.coating).back() + 1;
  return text + ", rigid body with " + (coats == 1 ? "a coating" : std::to_string(coats) + " coatings");
}

}  // namespace rollres
