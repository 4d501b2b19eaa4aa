#include "core/zones/spectral_accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "core/spectral/graded_system.hpp"
#include "core/zones/spectral_start.hpp"

namespace rollres {

namespace {

/// Where a ring begins to slip its pressure has a power 3/2 of the distance: between points the laws hold to this,
/// times the slope at the edges and the order to the power -5/2. (A braked cover: 0.55 times that, orders 10 to 157.)
/// Without shear short memories leave less: of a cover with a master curve a fifth of this at order 70.
constexpr double of_sheared_rings = 2, of_pressed_rings = 0.1;
/// Few graded points refute right patterns, and tell their own error badly: fewer than this tolerance asks for [1] save
/// little.
constexpr double least_graded_accuracy = 2e-5;
constexpr double default_of_sheared_rings = 1e-6;  // tolerance of a ring that is sheared, where none is given
constexpr double wrong_pattern = 1e-7;             // violation of an inequality that no order mends

/// A rotation that is given hands what the edges lack on to the traction.
double handed_on(Drive drive) { return drive == Drive::rotation ? 2.5 : 1; }

/// The change from one order to the next, times how fast coefficients fall, is often too hopeful: the estimate over it.
double estimate_over_change(Drive drive) { return 3.25 * handed_on(drive); }

/// The error estimate (core/spectral/README.md, (S27)). The laws between the points are taken into account too.
double cautious(double error, double violation, Drive drive) {
  constexpr double rounding = 1e-12;
  return estimate_over_change(drive) * error + handed_on(drive) * (0.65 * std::sqrt(error * violation) + rounding);
}

}  // namespace

double resistance_of(const SpectralState& state, double radius) {
  return state.driving_force + state.driving_torque * state.rotation_ratio / radius;
}

double lever_of(const SpectralState& state, double radius) {
  return state.load * state.edges.contact.half_length() / radius;
}

double scale_of(const SpectralState& state, double radius) {
  constexpr double nothing = 1e-6;  // of the lever
  return std::max(std::abs(resistance_of(state, radius)), nothing * lever_of(state, radius));
}

double relative_tail(const SpectralState& state) {
  const auto part = [](const Eigen::VectorXd& c) { return c.size() > 2 ? c.tail(2).cwiseAbs().maxCoeff() : 0.0; };
  double tail = part(state.pressure.coefficients);
  for (const SpectralDensity& stick : state.sticks) tail += part(stick.coefficients);
  return tail / state.pressure.coefficients.cwiseAbs().maxCoeff();
}

SpectralAccuracy::SpectralAccuracy(const ContactModel& model, const SpectralProblem& problem)
    : model_(model),
      problem_(problem),
      tolerance_(std::max(model.tolerance.value_or(default_spectral_tolerance), smallest_spectral_tolerance)) {
  const bool friction = model.friction_coefficient > 0;
  if (problem_.graded(friction)) tolerance_ = std::min(tolerance_, least_graded_accuracy);
  if (!model.tolerance && model.ring() && friction) tolerance_ = default_of_sheared_rings;
}

double SpectralAccuracy::over_change() const { return estimate_over_change(model_.drive); }

double SpectralAccuracy::wanted_change(bool graded) const {
  if (!model_.tolerance) return largest_change(graded);
  return std::min(largest_change(graded), *model_.tolerance / over_change());
}

double SpectralAccuracy::estimate(const SpectralState& state, const AssessedSpectral& assessed,
                                  const OrderResult& told) const {
  if (!state.graded) {
    const double of_curvature = model_.ring() ? told.lever / told.scale * assessed.violation : 0;
    return cautious(told.error, assessed.violation, model_.drive) + of_curvature;
  }
  constexpr double per_violation = 0.03, usual_share = 0.05;  // of what so many points allow
  const double lever = told.lever / told.scale, of_fields = field_error(told.order);
  double wrong = assessed.wrong_zone > usual_share * of_fields ? assessed.wrong_zone : 0;
  if (assessed.violation > of_fields) wrong = std::max(wrong, assessed.violation);
  // Of 185 random answers at a tolerance of 1e-9, 17 % were off by more than this sum, 4 % by more than 1.5 of it.
  constexpr double covering = 1.5;
  return covering * (cautious(told.error, 0, model_.drive) + usual_error(told.order, lever) +
                     handed_on(model_.drive) * per_violation * wrong * std::sqrt(lever));
}

/// The order that resolves as much without layers: thin ones narrow the strip in which all is analytic.
double SpectralAccuracy::resolving(int order) const {
  constexpr double usual_strip = 0.7;  // of the random scenes by which the errors of graded points are known
  return order * std::min(1.0, free_strip(problem_, {-problem_.half_width, problem_.half_width}) / usual_strip);
}

double SpectralAccuracy::tail(int order) const { return graded_tail(resolving(order)); }
double SpectralAccuracy::field_error(int order) const { return graded_field_error(resolving(order)); }

double SpectralAccuracy::usual_error(int order, double lever) const {
  constexpr double per_tail = 2;
  return per_tail * handed_on(model_.drive) * tail(order) * std::sqrt(lever);
}

bool SpectralAccuracy::misses_tolerance(const SpectralState& state, const AssessedSpectral& assessed,
                                        const OrderResult& told) const {
  return (state.graded || problem_.curved(state.pattern.shear)) && model_.tolerance &&
         estimate(state, assessed, told) > *model_.tolerance;
}

bool SpectralAccuracy::in_its_zones(const SpectralState& state, const AssessedSpectral& assessed, int order) const {
  return assessed.wrong_zone < std::max(wrong_pattern, between_points(state, order));
}

double SpectralAccuracy::between_points(const SpectralState& state, int order) const {
  if (state.graded) return field_error(order);
  if (!problem_.curved(state.pattern.shear)) return 0;
  return (state.pattern.shear ? of_sheared_rings : of_pressed_rings) * state.edges.contact.half_length() /
         model_.radius * std::pow(order, -2.5);
}

double SpectralAccuracy::imposed_violation(const SpectralState& state, const AssessedSpectral& assessed) const {
  return state.graded || problem_.curved(state.pattern.shear) ? assessed.solution.law_violation : assessed.violation;
}

double SpectralAccuracy::refuted_at(int order) const {
  constexpr double times_field_error = 1.5, usual_friction = 0.2;  // of right patterns less, on random scenes
  return times_field_error * field_error(order) * std::max(1.0, usual_friction / model_.friction_coefficient);
}

/// What memories too short to matter leave of the pressure at a place [Pa]. At many lengths rho_1 behind the leading
/// edge, a share x = rho_1/distance, an amplitude Z_1 is answered by a pressure of Z_1 x^(1/2); a change that leaves
/// the loss as it is, as where the shortest memory stands for those below it, by one of x^(3/2).
double SpectralAccuracy::left_by_short_memories(const SpectralState& state, double place) const {
  if (problem_.terms() == 0) return 0;
  const double length = problem_.relaxation_length.front(), share = length / (state.edges.contact.to - place);
  const double amplitude = std::abs(state.pressure.amplitudes(0));
  constexpr double covering = 1.5;  // where the peak is but a few lengths behind the edge
  if (problem_.taken_up) return amplitude * std::min(1.0, covering * std::pow(share, 1.5));
  const double loss = problem_.glassy * problem_.glassy * problem_.made_elastic;
  return amplitude * loss / (problem_.relaxation_modulus.front() * length) * std::min(1.0, std::sqrt(share));
}

double SpectralAccuracy::peak_error(const SpectralState& state, const AssessedSpectral& assessed,
                                    const OrderResult& told) const {
  constexpr double over_resistance = 3;  // of random scenes
  const double share = state.graded ? field_error(told.order) : over_resistance * estimate(state, assessed, told);
  return (share + assessed.violation) * assessed.solution.peak_pressure +
         left_by_short_memories(state, assessed.peak_place);
}

}  // namespace rollres
