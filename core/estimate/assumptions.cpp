#include "core/estimate/assumptions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/estimate/composite_estimate.hpp"
#include "core/estimate/linearity_error.hpp"
#include "core/material/strain_softening.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"

namespace rollres {

namespace {

constexpr std::string_view rigid = "rigid body and base", no_inertia = "no inertia", recovered_ring = "recovered ring",
                           straight_passage = "straight passage", linear_materials = "linear materials",
                           plane_strain = "plane strain";
constexpr std::array<std::string_view, 10> names{
    small_strains,    rigid,           no_inertia,       flat_coating, recovered_ring,
    straight_passage, one_temperature, linear_materials, no_heat,      plane_strain};

/// Steel: G [Pa], nu.
constexpr double steel_modulus = 81e9, steel_poisson = 0.3;
/// Density times specific heat of rubber [J/(m3 K)].
constexpr double heat_of_rubber = 2e6;
/// Below it a change is told as what it cannot exceed, by the size of its cause, and not computed.
constexpr double hardly_any = 1e-3;

ModelLayer steel_half_space() {
  BondedLayer steel;
  steel.layer_thickness = INFINITY;
  steel.layer_density = 0;
  steel.material = MaterialModel::elastic;
  steel.static_shear_modulus = steel_modulus;
  steel.poisson_ratio = steel_poisson;
  return ModelLayer(steel);
}

class Assumptions {
 public:
  Assumptions(const ContactModel& model, const RollingSolution& solution)
      : model_(model), solution_(solution), half_(half_length(solution)) {}

  std::vector<Assumption> run() {
    if (solution_.method != Method::finite_strain) strains();
    body_and_base();
    if (!model_.inertia) inertia();
    if (!model_.coating.empty() && !model_.ring()) coating();
    if (model_.ring()) turns();
    if (model_.pivot != 0) passage();
    inputs();
    return std::move(all_);
  }

 private:
  /// Adds what R_r of the second model differs by from that of the first.
  void compare(std::string_view name, std::string rests_on, const ContactModel& with, const ContactModel& without) {
    const auto [change, scatter] = ResistanceChange(with, half_)(without);
    if (std::isfinite(change))
      all_.push_back({name, std::move(rests_on), change, scatter});
    else
      all_.push_back({name, std::move(rests_on), {}, 0, "the layers lose nothing"});
  }

  void strains() {
    const double strain = strain_number(model_, solution_);
    const std::string rests_on = model_.loaded           ? message_text<2>("deflection over half the load's length = ",
                                                                 solution_.peak_deflection / model_.loaded->half_length)
                                 : std::isfinite(strain) ? message_text<2>("d/H = ", strain)
                                                         : message_text<2>("a/R = ", half_ / model_.radius);
    const std::optional<LinearityError> error = linearity_error(model_, solution_);
    if (error)
      all_.push_back({small_strains, rests_on, error->value, error->scatter});
    else
      all_.push_back({small_strains, rests_on, {}, 0, "its kind was not compared with solutions at finite strain"});
  }

  /// The yield of two half-spaces of steel, at a wavenumber of one over the half-width, beside that of the surface.
  double share_of_steel() const {
    const double steel = 2 * (1 - steel_poisson) / steel_modulus * half_;
    const SteadySurface surface = steady_surface(model_);
    return steel / std::abs(surface(surface.moduli(1 / half_), 1 / half_, 0).normal);
  }

  void body_and_base() {
    const std::string rests_on = "as if of steel, G = 81 GPa";
    if (const double share = share_of_steel(); share < hardly_any) {
      all_.push_back({rigid, rests_on, 0.0, share});
      return;
    }
    ContactModel yielding = model_;
    const ModelLayer steel = steel_half_space();
    if (has_rigid_base(yielding)) yielding.foundation.push_back(steel);
    if (model_.loaded) {
      if (!has_rigid_base(model_)) return;  // nothing is rigid
    } else if (yielding.coating.empty()) {
      yielding.coating.push_back(steel);
    } else {  // the core of rings is rigid: the foundation's half-space yields for it
      ModelLayer& base = yielding.foundation.back();
      base.creep.instantaneous += steel.creep.instantaneous * (1 - steel.poisson_ratio) / (1 - base.poisson_ratio);
    }
    compare(rigid, rests_on, model_, yielding);
  }

  void inertia() {
    const double number = inertia_number(model_, solution_);
    const std::string rests_on = message_text<2>("ρV²/|G| = ", number);
    if (number < hardly_any) {
      all_.push_back({no_inertia, rests_on, 0.0, number});
    } else if (rayleigh_number(model_) >= 1 || layers_carry_slower_waves(model_)) {
      all_.push_back({no_inertia, rests_on, {}, 0, "the body is faster than waves on the layers"});
    } else {
      // With inertia a coating is flat: so is the one that it is compared with.
      ContactModel light = model_;
      light.bend_coating(INFINITY);
      ContactModel heavy = light;
      heavy.inertia = true;
      compare(no_inertia, rests_on, light, heavy);
    }
  }

  /// Of a sphere's as of a cylinder's of the same radius.
  void coating() {
    ContactModel as_flat = model_;
    as_flat.dimension = 2;
    as_flat.inertia = false;
    ContactModel ring = as_flat;
    ring.bend_coating(0);
    compare(flat_coating,
            message_text<2>("H/R = ", model_.coating_thickness() / model_.radius,
                            model_.dimension == 3 ? ", as of a cylinder" : ""),
            as_flat, ring);
    // A sphere's bends both ways: of the same size, no more is known.
    if (model_.dimension == 3) all_.back().scatter = std::abs(all_.back().change.value_or(0));
  }

  void turns() {
    const double left = left_after_turn(model_);
    if (!feels_earlier_turns(model_))
      all_.push_back({recovered_ring, message_text<2>("after a turn ", left, " is left"), 0.0, left});
  }

  /// What the paths' curvature adds is odd across the motion, and changes R_r by the square of the angle by which the
  /// layer turns in the contact.
  void passage() {
    const double angle = std::abs(model_.pivot) * 2 * half_;
    all_.push_back(
        {straight_passage, message_text<2>("the layer turns by ", angle, " in the contact"), 0.0, angle * angle});
  }

  void inputs() {
    const std::vector<const ModelLayer*> layers = model_.layers();
    if (!std::all_of(layers.begin(), layers.end(), [](const ModelLayer* layer) { return softens(*layer); })) {
      double softest = 0;
      for (const ModelLayer* const layer : layers)
        softest = std::max(softest, std::abs(layer->creep(model_.speed / half_)));
      constexpr double of_peak = 0.3;  // the largest shear stress under a line contact, over p_0 (Johnson 1985, 4.2)
      tell(linear_materials, message_text<2>("shear strains of about ", of_peak * solution_.peak_pressure * softest));
    }
    const double depth = std::min(2 * half_, finite_thickness(model_) > 0 ? finite_thickness(model_) : INFINITY);
    const double across = model_.dimension == 3 ? 2 * half_ : 1;
    if (const double rise = solution_.viscous_loss / (model_.speed * depth * across * heat_of_rubber); rise > 0)
      tell(no_heat, message_text<2>("one passage warms the layer by about ", rise, " K"));
    if (model_.dimension == 2)
      tell(plane_strain,
           message_text<2>("a cylinder long beside ", 1e3 * std::max(2 * half_, finite_thickness(model_)), " mm"));
  }

  void tell(std::string_view name, std::string rests_on) {
    all_.push_back({name, std::move(rests_on), {}, 0, {}, true});
  }

  const ContactModel& model_;
  const RollingSolution& solution_;
  double half_;
  std::vector<Assumption> all_;
};

}  // namespace

double half_length(const RollingSolution& solution) {
  const double length = solution.leading_edge - solution.trailing_edge;
  return 0.5 * (std::isnan(solution.spacing) ? length : length + solution.spacing);
}

double inertia_number(const ContactModel& model, const RollingSolution& solution) {
  const double frequency = model.speed / half_length(solution), square = model.speed * model.speed;
  double largest = 0;
  const auto take = [&](const std::vector<ModelLayer>& layers, double flow) {
    for (const ModelLayer& layer : layers)
      largest = std::max(largest, layer.layer_density * square * flow * flow * std::abs(layer.creep(frequency * flow)));
  };
  take(model.foundation, 1);
  take(model.coating, model.flow);
  return largest;
}

std::vector<std::string_view> assumption_names() { return {names.begin(), names.end()}; }

std::vector<Assumption> assumptions(const ContactModel& model, const RollingSolution& solution) {
  return Assumptions(model, solution).run();
}

const Assumption* find_assumption(const std::vector<Assumption>& all, std::string_view name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Assumption& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::optional<double> model_error(const std::vector<Assumption>& all) {
  double sum = 0;
  for (const Assumption& assumption : all) {
    if (assumption.of_inputs) continue;
    if (!assumption.change) return {};
    const double most = std::abs(*assumption.change) + assumption.scatter;
    sum += most * most;
  }
  return std::sqrt(sum);
}

double in_percent(double part) {
  const double percent = 100 * part, unit = std::pow(10, std::floor(std::log10(std::abs(percent))) - 1);
  return std::isfinite(unit) && unit > 0 ? unit * std::round(percent / unit) : percent;
}

std::string in_words(const Assumption& assumption) {
  std::string text = message_text(assumption.name, " (", assumption.rests_on, ")");
  if (assumption.of_inputs) return text;
  if (!assumption.change) return text + ": what that costs is not known, " + assumption.why_unknown;
  text += ": without it R_r ";
  if (*assumption.change == 0) return text + message_text("within ", in_percent(assumption.scatter), " %");
  text += message_text(*assumption.change > 0 ? "+" : "", in_percent(*assumption.change), " %");
  return assumption.scatter > 0 ? text + message_text(" +- ", in_percent(assumption.scatter), " %") : text;
}

}  // namespace rollres
