#include "core/estimate/linearity_error.hpp"

#include <cmath>
#include <complex>

#include "core/estimate/composite_estimate.hpp"
#include "core/estimate/grid_choice.hpp"
#include "core/material/material.hpp"
#include "core/model/contact_surface.hpp"

namespace rollres {

namespace {

/// b of the header, what shear on a ring adds, over (a/R)(R_r/P), and the standard deviation of what they miss of ln
/// R_r, over d/H.
struct StrainFactors {
  double thick_above_peak, thick_below_peak, thin_above_peak, thin_below_peak, compressible, lossy, sheared_ring,
      scatter;
};
constexpr StrainFactors under_load{-0.38, 0.23, 0.25, 1.62, -3.29, -0.60, 0.51, 0.20};
constexpr StrainFactors under_approach{0.36, 0.29, -0.09, 1.66, -3.64, 2.13, -1.01, 0.30};
/// Standard deviation on half-spaces, over a/R.
constexpr double scatter_on_half_space = 0.08;

/// Ranges of the pairs that the factors were fitted to.
constexpr double least_ratio = 0.02, largest_ratio = 7, largest_strain = 0.33, largest_slope = 0.6,
                 least_poisson = 0.35, largest_friction = 0.8, largest_frictional_share = 0.3,
                 least_lever_with_friction = 0.01;
/// Of the whole, of what the contact yields; the rest is rigid.
constexpr double rigid_but_for = 0.99;

/// Sublayers of one layer of the scene as one with the material of the middle; nothing of several layers.
std::optional<ModelLayer> as_one(const std::vector<ModelLayer>& layers) {
  if (layers_of_scene(layers).back() > 0) return std::nullopt;
  ModelLayer one = layers[layers.size() / 2];
  one.layer_thickness *= static_cast<double>(layers.size());
  return one;
}

/// The only layer that yields: the one under the body or, on a foundation that is rigid beside it, the coating.
std::optional<ModelLayer> only_layer(const ContactModel& model, double half) {
  if (model.coating.empty()) return as_one(model.foundation);
  return model.ring() && share_of_coating(model, half) > rigid_but_for ? as_one(model.coating) : std::nullopt;
}

bool of_a_fitted_kind(const ContactModel& model) {
  return model.dimension == 2 && !model.period && model.adhesion_threshold == 0 &&
         model.kinematics != Kinematics::printed && !model.inertia && model.friction_coefficient <= largest_friction &&
         (model.drive == Drive::top_force || model.drive == Drive::free);
}

/// Enough of the resistance is the layer's own.
bool resists_by_its_loss(const ContactModel& model, const RollingSolution& linear, double half) {
  const double lever = linear.rolling_resistance * model.radius / (linear.load * half);
  if (model.friction_coefficient == 0) return lever > 0;
  const double share = linear.frictional_loss / (linear.rolling_resistance * model.speed);
  return lever >= least_lever_with_friction && share <= largest_frictional_share;
}

LinearityError relative(double logarithm, double scatter) {
  const double value = std::expm1(logarithm);
  return {value, scatter * (1 + value)};
}

}  // namespace

std::optional<LinearityError> linearity_error(const ContactModel& model, const RollingSolution& linear) {
  if (model.loaded || !of_a_fitted_kind(model) || linear.method == Method::finite_strain) return {};
  const double half = 0.5 * (linear.leading_edge - linear.trailing_edge);
  const std::optional<ModelLayer> layer = only_layer(model, half);
  if (!layer || layer->poisson_ratio < least_poisson || !resists_by_its_loss(model, linear, half)) return {};
  if (std::isinf(layer->layer_thickness)) {
    const double slope = half / model.radius;
    if (!(slope <= largest_slope)) return {};
    return relative(0, scatter_on_half_space * slope);
  }
  // On a half-space that is rigid beside it a layer or a coating has an approach that the scene has not.
  const double approach = std::isfinite(linear.approach)
                              ? linear.approach
                              : contact_of_width(model.coating.empty() ? model : coating_alone(model), half).approach;
  const double omega = model.speed / half, ratio = half / layer->layer_thickness;
  const double strain = approach / layer->layer_thickness;
  if (!(ratio >= least_ratio && ratio <= largest_ratio && strain <= largest_strain)) return {};
  const auto modulus = [&](double at) { return 1.0 / layer->creep(at); };
  constexpr double step = 1.01;
  const double power = std::log(modulus(omega * step).imag() / modulus(omega / step).imag()) / (2 * std::log(step));
  const double loss = modulus(omega).imag() / modulus(omega).real();
  if (!(loss > 0) || !std::isfinite(power)) return {};

  const StrainFactors& b = model.load ? under_load : under_approach;
  const double thin = ratio / (1 + ratio), below = 0.5 * (1 + power);
  const double between_limits = (1 - thin) * ((1 - below) * b.thick_above_peak + below * b.thick_below_peak) +
                                thin * ((1 - below) * b.thin_above_peak + below * b.thin_below_peak);
  const double all =
      between_limits + b.compressible * below * (1 - 2 * layer->poisson_ratio) + b.lossy * loss / (1 + loss);
  const bool sheared = model.ring() && model.friction_coefficient > 0;
  const double of_shear = sheared ? b.sheared_ring * half / model.radius * linear.rolling_resistance / linear.load : 0;
  return relative(strain * all + of_shear, strain * b.scatter);
}

double strain_number(const ContactModel& model, const RollingSolution& solution) {
  const std::optional<ModelLayer> layer = only_layer(model, 0.5 * (solution.leading_edge - solution.trailing_edge));
  const double thickness = layer ? layer->layer_thickness : total_thickness(model);
  return std::isfinite(thickness) ? (model.loaded ? solution.peak_deflection : solution.approach) / thickness : NAN;
}

}  // namespace rollres
