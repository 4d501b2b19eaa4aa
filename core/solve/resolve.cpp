#include "core/solve/resolve.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/composite_estimate.hpp"
#include "core/estimate/grid_choice.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"
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
  explicit Simplification(const ContactModel& full) : model_(full) {}

  ContactModel run() {
    if (!model_.tolerance || !model_.composite()) return std::move(model_);
    allowed_ = share_of_tolerance * *model_.tolerance;
    model_.estimate = estimate_contact(model_);
    half_width_ = std::min(model_.estimate->half_width, model_.radius);
    full_ = hertz_response(model_, half_width_);
    leave_inertia_out();
    cut(&ContactModel::foundation, 1);
    cut(&ContactModel::coating, 0);
    take_as_incompressible();
    *model_.tolerance -= model_.left_out;
    return std::move(model_);
  }

 private:
  /// Of the simpler surface's answer to the pressure; the compliance counts where the approach is defined.
  double largest_change(const ContactModel& simpler) const {
    const HertzResponse answer = hertz_response(simpler, half_width_);
    const bool approach = model_.dimension == 3 || std::isfinite(total_thickness(model_));
    return std::max({approach ? relative_change(full_.compliance, answer.compliance) : 0,
                     relative_change(full_.slope, answer.slope), relative_change(full_.loss, answer.loss)});
  }

  bool take(ContactModel simpler, double change, const std::string& decision) {
    if (!(change <= allowed_ - model_.left_out)) return false;
    model_ = std::move(simpler);
    model_.estimate.reset();
    model_.choose_method();
    model_.left_out += change;
    model_.decisions.push_back(decision + message_text(", which changes R_r by ", change, " at most (estimate)"));
    return true;
  }

  void leave_inertia_out() {
    if (!model_.inertia || !model_.inertia_automatic) return;
    ContactModel simpler = model_;
    simpler.inertia = simpler.inertia_automatic = false;
    take(simpler, caution * largest_change(simpler), "inertia left out");
  }

  /// Rigid instead of some of the layers, the farthest from the contact. @param least of them that stay
  void cut(std::vector<ModelLayer> ContactModel::*list, std::size_t least) {
    const std::size_t count = (model_.*list).size();
    const bool on_body = list == &ContactModel::coating;
    const bool sublayers = std::any_of((model_.*list).begin(), (model_.*list).end(),
                                       [](const ModelLayer& layer) { return layer.continues; });
    for (std::size_t keep = least; keep < count; ++keep) {
      ContactModel simpler = model_;
      (simpler.*list).erase((simpler.*list).begin() + static_cast<std::ptrdiff_t>(keep), (simpler.*list).end());
      const double change = caution * largest_change(simpler);
      const auto first = [&](const std::string& one, const std::string& several) {
        return keep == 1 ? one : message_text(keep, " ", several);
      };
      const std::string beyond = keep == 0 ? "the body's coating"
                                           : (on_body ? "what lies inside the first " : "what lies below the first ") +
                                                 (sublayers ? first("sublayer", "sublayers")
                                                  : on_body ? first("coating", "coatings")
                                                            : first("layer", "layers"));
      if (take(std::move(simpler), change, beyond + " taken as rigid")) return;
    }
  }

  /// A hard elastic surface against a soft one moves sideways under pressure by so little that its Poisson's ratio may
  /// be 1/2, its normal compliance kept: then the edges of the contact have no oscillations.
  void take_as_incompressible() {
    const ContactModel& model = model_;
    if (model.dimension == 3 || model.period || model.friction_coefficient == 0 || model.spacing ||
        model.coating.empty() || model.inertia)
      return;
    ContactModel simpler = model;
    for (ModelLayer* const top : {&simpler.foundation.front(), &simpler.coating.front()}) {
      if (!(top->poisson_ratio < 0.5)) continue;
      if (top->material != MaterialModel::elastic) return;
      top->static_shear_modulus = top->modulus_at_rest / (2 * (1 - top->poisson_ratio));
      top->static_young_modulus.reset();
      top->temperature.reset();
      top->poisson_ratio = 0.5;
      top->take_material();
    }
    if (!spectral_refusal(simpler).empty() || spectral_refusal(model).empty()) return;
    const SteadySurface surface = steady_surface(model);
    const SurfaceCompliance c = surface.half_spaces(surface.moduli(1 / half_width_));
    const double sideways = std::abs(c.cross) / std::abs(c.normal);
    // Where the drive asks for it friction may be far more than what the resistance is made of.
    const bool driven = model.drive == Drive::torque || model.drive == Drive::rotation;
    const double load = model.load.value_or(-half_width_ / (2 * model.radius * full_.slope));
    const double lever = half_width_ / model.radius, share = std::min(load * full_.loss / lever, 1.0);
    const double leverage = driven ? std::max(1.0, model.friction_coefficient / share) : 1;
    constexpr double of_rings = 2;  // full solutions change by up to 1.7 times the sideways share
    const double change = std::max(of_rings * leverage * sideways, largest_change(simpler));
    take(simpler, change, "the hard surface taken as incompressible, its normal compliance kept");
  }

  ContactModel model_;
  double allowed_ = 0, half_width_ = 0;
  HertzResponse full_{};
};

}  // namespace

ContactModel resolve(const RollingScene& scene) { return simplified(ContactModel(scene)); }

ContactModel simplified(const ContactModel& full) {
  ContactModel model = Simplification(full).run();
  model.estimate = estimate_contact(model);
  model.coating_share = share_of_coating(model);
  return model;
}

}  // namespace rollres
