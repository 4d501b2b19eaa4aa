#pragma once

/// Fits materials to measured storage and loss moduli, at several temperatures with the shift fitted at the same time.

#include <complex>
#include <functional>
#include <optional>
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

/// Relaxation times of a Prony series: in even steps of their logarithm, or fitted with their moduli.
enum class SeriesTimes { even, free };
template <>
struct ChoiceNames<SeriesTimes> {
  static constexpr std::array<std::string_view, 2> names{"even", "free"};
};
/// Factors b_T of the moduli beside free shifts, one for each temperature: where AICc asks for them, always, or never.
enum class VerticalShift { automatic, free, none };
template <>
struct ChoiceNames<VerticalShift> {
  static constexpr std::array<std::string_view, 3> names{"auto", "free", "none"};
};

inline constexpr int most_free_terms = 10, usual_free_terms = 5;

struct MaterialFitOptions {
  MaterialForm form = MaterialForm::prony;
  int terms = 0;                          ///< of a Prony series; 0: as many as the data ask for (automatic_series)
  std::optional<SeriesTimes> times = {};  ///< default: free for up to usual_free_terms that are asked for, else even
  TemperatureShift shift = {};            ///< its law, its reference, and where its constants start
  bool free_shifts = false;  ///< one log10 a_T for each temperature: the law is a table, of steps_of_temperature
  VerticalShift vertical = VerticalShift::automatic;  ///< beside free shifts
  bool deviations_known = false;
  FitOptions options = {};
};

struct MaterialFit {
  FitReport report;       ///< its values: storage and loss in turn
  FractionalZener zener;  ///< what was fitted, order 1 for the Zener solid
  PronySeries prony;      ///< or this
  TemperatureShift shift;
  std::vector<std::string> notes = {};  ///< on how many terms there are
  /// G*(omega) [Pa] at a temperature [K].
  std::complex<double> modulus(double angular_frequency, double temperature) const;
  /// Standard errors of its parts by the errors of the parameters; NaN if those are not known [Pa].
  std::complex<double> modulus_error(double angular_frequency, double temperature) const;
  /// G* of other parameters.
  std::function<std::complex<double>(const FitPoint&, double angular_frequency, double temperature)> modulus_at = {};
};

/// A shift with constants to start from, whose pole lies below the coldest data.
TemperatureShift usual_constants(TemperatureShift shift, const std::vector<MeasuredModulus>& data);

/// The moduli of a Prony series of even times (even_series.hpp) are linear unknowns that may be 0: their intervals are
/// those of the slopes, cut off at 0, and only the constants of a shift have profiles. Those constants start where the
/// moduli of least squares at every shift leave the least misfit.
/// Free shifts are fitted without b_T and with them (vertical_shifts.hpp). The b_T of a given table of shifts count as
/// applied: data are moduli times b_T.
/// @throws std::invalid_argument if the data are too few, or the free terms too many
MaterialFit fit_material(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options);

}  // namespace rollres
