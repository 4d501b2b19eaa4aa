#pragma once

/// Fits materials to measured storage and loss moduli, at several temperatures with the shift fitted at the same time.

#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "core/material/fractional_zener.hpp"
#include "core/material/material_scale.hpp"
#include "core/material/prony_series.hpp"
#include "fitting/fit/fit.hpp"

namespace rollres {

/// One measured complex modulus in shear.
struct MeasuredModulus {
  double angular_frequency;  ///< [rad/s]
  double temperature;        ///< [K]
  double storage, loss;      ///< [Pa], > 0
  double storage_deviation;  ///< [Pa]; where none is known, what residuals are measured in
  double loss_deviation;     ///< [Pa]
  std::string place = {};
};

enum class MaterialForm { zener, fractional_zener, prony };
template <>
struct ChoiceNames<MaterialForm> {
  static constexpr std::array<std::string_view, 3> names{"zener", "fractional_zener", "prony"};
};

struct MaterialFitOptions {
  MaterialForm form = MaterialForm::prony;
  int terms = 0;                ///< of a Prony series; 0: as many as the data ask for, at most 20
  TemperatureShift shift = {};  ///< its law, its reference, and where its constants start
  bool deviations_known = false;
  FitOptions options = {};
};

struct MaterialFit {
  FitReport report;       ///< its values: storage and loss in turn
  FractionalZener zener;  ///< what was fitted, order 1 for the Zener solid
  PronySeries prony;      ///< or this
  TemperatureShift shift;
  /// G*(omega) [Pa] at a temperature [K].
  std::complex<double> modulus(double angular_frequency, double temperature) const;
  /// Standard errors of its parts by the errors of the parameters; NaN if those are not known [Pa].
  std::complex<double> modulus_error(double angular_frequency, double temperature) const;
  /// G* of other parameters.
  std::function<std::complex<double>(const FitPoint&, double angular_frequency, double temperature)> modulus_at = {};
};

/// A Prony series has relaxation times in even steps of their logarithm over the (shifted) frequencies; moduli that
/// non-negative least squares leave at 0 are left out. Its descent starts 10 % off that solution. As many terms as the
/// data ask for: those of the least corrected information criterion, less the ones that the data then do not tell from
/// 0.
/// @throws std::invalid_argument if the data are too few
MaterialFit fit_material(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options);

}  // namespace rollres
