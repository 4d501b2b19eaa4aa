#pragma once

/// A cheap estimate of the contact on a composite surface (`ContactModel::composite`): Hertz's pressure, its width the
/// one of least potential energy.
///
/// With the pressure's transform P phi(k a), phi(z) = 2 J1(z)/z for a cylinder and 3 j1(z)/z for a sphere, and the
/// compliance c(k) = |c_ww(k)| at the frequency k V, the energy under a load P is
///   E(a) = P^2 A(a)/2 + P a^2/(n R),  A(a) = 1/pi int c phi^2 dk (n = 8)  or  1/2pi int c phi^2 k dk (n = 5):
/// dE/da = 0 gives P = -2 a/(n' R A'(a)), n' = 4 or 5/2, and the approach is P A + a^2/(n R). Exact on a half-space,
/// within about 30 % for a thin layer.

#include <cmath>
#include <optional>

#include "core/estimate/contact_estimate.hpp"
#include "core/model/contact_model.hpp"

namespace rollres {

ContactEstimate composite_estimate(const ContactModel& model);

/// The same of a contact of this half-width [m], whatever presses it.
ContactEstimate contact_of_width(const ContactModel& model, double half_width);

/// How a surface answers that pressure: A, A' and what it takes of the power, R_r = P^2 loss without friction. By it
/// two surfaces are compared at one half-width (solve/resolve.hpp).
struct HertzResponse {
  double compliance, slope;  ///< A [m/N], A' [1/N]; of a cylinder [m2/N], [m/N]
  double loss;               ///< 1/pi int Im c_ww phi^2 k dk or 1/(4 pi^2) int Im c_ww phi^2 k_x dk_x dk_y
};
HertzResponse hertz_response(const ContactModel& model, double half_width);

/// Frequencies at which waves take that power from all layers: slower ones take a tenth of it, faster ones a
/// tenth [Hz]. Nothing of layers that take none.
struct LossBand {
  double lowest, highest;
};
std::optional<LossBand> loss_band(const ContactModel& model, double half_width);

/// What another model of the same scene changes R_r by, by that answer: R_r = P^2 loss at the half-width where the load
/// (or the approach) is the one given, which moves from the contact's by
///   ln a' - ln a = (ln q(a) - ln q'(a))/(d ln q/d ln a),  q the load or the approach.
/// To first order in the change; friction is left out. Of both parts, that at one half-width and that by its move, a
/// quarter is taken as uncertain, which counts where they cancel.
class ResistanceChange {
 public:
  struct Change {
    double value;  ///< R_r of the other model over the model's, minus 1; NaN where there is none, as of elastic layers
    double scatter;  ///< of that
  };

  /// @param half_width  of the model's own contact [m]
  ResistanceChange(const ContactModel& model, double half_width);
  Change operator()(const ContactModel& other) const;

 private:
  struct Logarithms {
    double given, resistance;  // ln q, ln R_r
  };
  Logarithms at(const ContactModel& model, double half_width) const;

  double half_width_;
  bool load_given_;
  Logarithms own_;
  double power_ = NAN;  // d ln R_r/d ln q
};

/// Relative error of R_r by what the tables of its master curves leave open (OpenSpectrum), not exceeded in 95 % of
/// all tables: by the derivatives of that answer, also through the half-width, with respect to the spectra. 0 without
/// a master curve.
double spectrum_error(const ContactModel& model, double half_width);

}  // namespace rollres
