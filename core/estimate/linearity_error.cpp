#include "core/estimate/linearity_error.hpp"

#include <cmath>
#include <complex>
#include <string_view>

#include "core/material/material.hpp"
#include "core/model/scene_rules.hpp"

namespace rollres {

namespace {

struct Term {
  double factor;
  std::string_view variables;
};

constexpr Term terms[] = {
    {-0.204, ""},   {3.554, "AU"},  {-2.987, "UC"},  {-4.791, "ATT"},  {6.847, "AS"},  {-3.757, "AAU"},
    {-2.713, "S"},  {-1.734, "TM"}, {-5.039, "AKS"}, {-15.890, "TSS"}, {2.215, "AUT"}, {0.515, "AAA"},
    {1.427, "UUS"}, {2.558, "ATM"}, {20.318, "CCS"}, {-0.809, "MS"},
};
/// Standard deviation of what the formula misses, over d/H.
constexpr double scatter_by_strain = 0.15;

/// Ranges of the pairs that the factors were fitted to.
constexpr double least_ratio = 0.1, largest_ratio = 7, largest_strain = 0.33, least_poisson = 0.35,
                 largest_friction = 0.8, largest_frictional_share = 0.3, least_lever_with_friction = 0.01;

bool of_a_fitted_kind(const ContactModel& model) {
  return model.dimension == 2 && model.foundation.size() == 1 && model.coating.empty() &&
         std::isfinite(model.top().layer_thickness) && model.load && !model.period && model.adhesion_threshold == 0 &&
         model.kinematics != Kinematics::printed && !model.inertia &&
         (model.drive == Drive::top_force || model.drive == Drive::free);
}

}  // namespace

std::optional<LinearityError> linearity_error(const ContactModel& model, const RollingSolution& linear) {
  if (!of_a_fitted_kind(model) || linear.method == Method::finite_strain) return {};
  const double half = 0.5 * (linear.leading_edge - linear.trailing_edge), omega = model.speed / half;
  const double ratio = half / model.top().layer_thickness, strain = linear.approach / model.top().layer_thickness;
  const double friction = model.friction_coefficient, incompressible = 1 - 2 * model.top().poisson_ratio;
  const double share = friction > 0 ? linear.frictional_loss / (linear.rolling_resistance * model.speed) : 0;
  const double lever = linear.rolling_resistance * model.radius / (linear.load * half);
  if (!(ratio >= least_ratio && ratio <= largest_ratio && strain <= largest_strain &&
        share <= largest_frictional_share && model.top().poisson_ratio >= least_poisson &&
        friction <= largest_friction && lever > 0 && (friction == 0 || lever >= least_lever_with_friction)))
    return {};
  const CreepSpectrum& creep = model.top().creep;
  const auto modulus = [&](double at) { return 1.0 / creep(at); };
  constexpr double step = 1.01;
  const double slope = std::log(modulus(omega * step).imag() / modulus(omega / step).imag()) / (2 * std::log(step));
  const double loss = modulus(omega).imag() / modulus(omega).real();
  if (!(loss > 0) || !std::isfinite(slope)) return {};

  const auto variable = [&](char name) {
    switch (name) {
      case 'A':
        return ratio / (1 + ratio);
      case 'U':
        return 0.5 * (1 + slope);
      case 'T':
        return loss / (1 + loss);
      case 'M':
        return friction / (0.1 + friction);
      case 'C':
        return incompressible;
      case 'K':
        return incompressible * ratio * ratio / (0.3 + incompressible * ratio * ratio);
      default:
        return strain;
    }
  };
  double sum = 0;
  for (const Term& term : terms) {
    double product = term.factor;
    for (const char name : term.variables) product *= variable(name);
    sum += product;
  }
  const double value = std::expm1(strain * sum);
  return LinearityError{value, scatter_by_strain * strain * (1 + value)};
}

}  // namespace rollres
