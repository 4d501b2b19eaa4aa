#include "core/solve/model_choice.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/composite_estimate.hpp"
#include "core/estimate/grid_choice.hpp"
#include "core/material/material.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/indenter_shape.hpp"
#include "core/model/scene_rules.hpp"

namespace rollres {

namespace {

/// What all simplifications may take of the tolerance together.
constexpr double share_of_tolerance = 0.2;
/// Changes that full solutions show stay below so many times the estimate.
constexpr double caution = 3;

double relative_change(double full, double simpler) { return full == simpler ? 0 : std::abs(simpler / full - 1); }

class Simplification {
 public:
  explicit Simplification(const RollingScene& scene) : choice_{scene, {}, 0} {}

  ModelChoice run() {
    RollingScene& scene = choice_.scene;
    if (!scene.tolerance || !is_composite(scene)) return std::move(choice_);
    allowed_ = share_of_tolerance * *scene.tolerance;
    half_width_ = std::min(estimate_contact(scene).half_width, scene.radius);
    full_ = hertz_response(scene, half_width_);
    leave_inertia_out();
    cut(&RollingScene::lower_layers);
    cut(&RollingScene::coating_layers);
    take_as_incompressible();
    *scene.tolerance -= choice_.left_out;
    return std::move(choice_);
  }

 private:
  /// Of the simpler surface's answer to the pressure; the compliance counts where the approach is defined.
  double largest_change(const RollingScene& simpler) const {
    const HertzResponse answer = hertz_response(simpler, half_width_);
    const RollingScene& scene = choice_.scene;
    const bool approach = dimensions(scene) == 3 || std::isfinite(total_thickness(scene));
    return std::max({approach ? relative_change(full_.compliance, answer.compliance) : 0,
                     relative_change(full_.slope, answer.slope), relative_change(full_.loss, answer.loss)});
  }

  bool take(const RollingScene& simpler, double change, const std::string& decision) {
    if (!(change <= allowed_ - choice_.left_out)) return false;
    choice_.scene = simpler;
    choice_.left_out += change;
    choice_.decisions.push_back(decision + message_text(", which changes R_r by ", change, " at most (estimate)"));
    return true;
  }

  void leave_inertia_out() {
    if (!inertia_included(choice_.scene) || choice_.scene.inertia == Inertia::on) return;
    RollingScene simpler = choice_.scene;
    simpler.inertia = Inertia::off;
    take(simpler, caution * largest_change(simpler), "inertia left out");
  }

  /// Rigid instead of some of the layers, the farthest from the contact.
  void cut(BondedLayers RollingScene::*list) {
    const std::size_t count = (choice_.scene.*list).size();
    const bool on_body = list == &RollingScene::coating_layers;
    for (std::size_t keep = 0; keep < count; ++keep) {
      RollingScene simpler = choice_.scene;
      (simpler.*list).resize(keep);
      const double change = caution * largest_change(simpler);
      const auto first = [&](std::size_t layers, const std::string& one, const std::string& several) {
        return layers == 1 ? one : message_text(layers, " ", several);
      };
      const std::string beyond = !on_body    ? "what lies below the first " + first(keep + 1, "layer", "layers")
                                 : keep == 0 ? "the body's coating"
                                             : "what lies inside the first " + first(keep, "coating", "coatings");
      if (take(simpler, change, beyond + " taken as rigid")) return;
    }
  }

  /// A hard elastic surface against a soft one moves sideways under pressure by so little that its Poisson's ratio may
  /// be 1/2, its normal compliance kept: then the edges of the contact have no oscillations.
  void take_as_incompressible() {
    const RollingScene& scene = choice_.scene;
    if (dimensions(scene) == 3 || scene.period || scene.friction_coefficient == 0 || scene.spacing ||
        scene.coating_layers.empty() || inertia_included(scene))
      return;
    const auto compressible = [](const MaterialInputs& m) { return m.poisson_ratio < 0.5; };
    const auto incompressible = [](MaterialInputs& m) {
      m.static_shear_modulus = static_modulus(m) / (2 * (1 - m.poisson_ratio));
      m.static_young_modulus.reset();
      m.temperature.reset();
      m.rest_factor = 1;
      m.poisson_ratio = 0.5;
    };
    RollingScene simpler = scene;
    for (MaterialInputs* const top :
         {static_cast<MaterialInputs*>(&simpler), static_cast<MaterialInputs*>(&simpler.coating_layers.front())}) {
      if (!compressible(*top)) continue;
      if (top->material != MaterialModel::elastic) return;
      incompressible(*top);
    }
    if (!spectral_applies(simpler) || spectral_applies(scene)) return;
    const SteadySurface surface(scene);
    const SurfaceCompliance c = surface.half_spaces(surface.moduli(1 / half_width_));
    const double sideways = std::abs(c.cross) / std::abs(c.normal);
    // Where the drive asks for it friction may be far more than what the resistance is made of.
    const bool driven = scene.drive == Drive::torque || scene.drive == Drive::rotation;
    const double load = scene.load.value_or(-half_width_ / (2 * scene.radius * full_.slope));
    const double lever = half_width_ / scene.radius, share = std::min(load * full_.loss / lever, 1.0);
    const double leverage = driven ? std::max(1.0, scene.friction_coefficient / share) : 1;
    const double change = std::max(leverage * sideways, largest_change(simpler));
    take(simpler, change, "the hard surface taken as incompressible, its normal compliance kept");
  }

  ModelChoice choice_;
  double allowed_ = 0, half_width_ = 0;
  HertzResponse full_{};
};

}  // namespace

ModelChoice choose_model(const RollingScene& scene) { return Simplification(scene).run(); }

}  // namespace rollres
