#pragma once

/// Shifts that are free at each temperature, as raw data of dynamic mechanical analysis have them: a_T is no law but a
/// table, found together with the material.

#include <string>
#include <vector>

#include "fitting/fit/measured_terms.hpp"
#include "fitting/material/material_fit.hpp"

namespace rollres {

/// The temperatures that the rows were measured at, each the mean of rows that are no more than 1 K apart [K].
/// @throws std::invalid_argument naming the row if the temperatures do not stand in steps
std::vector<double> steps_of_temperature(const std::vector<MeasuredModulus>& data);

/// A table of shifts to start from, the one that lets a Prony series meet the data best: of WLF's law, of Arrhenius',
/// or of what joins each temperature to its neighbour by the least squares of log G' and log G".
/// @param options  their shift has a table of the temperatures
TemperatureShift start_of_free_shifts(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options);

/// That the steps of log10 a_T, and of log10 b_T if the table has them, from one temperature to the next change little:
/// by three tenths of the mean step, and by 0.02 (standard deviations). Rows that tell a shift are far surer of it;
/// where they leave it open, a spectrum with gaps would let steps of nothing and of several decades take turns.
/// @param deviation  of the rows, in theirs   @param parameter  the first of the shift
std::vector<KnownBefore> even_steps(const TemperatureShift& shift, double deviation, std::size_t parameter = 0);

/// A law fitted to a table of shifts.
struct LawThrough {
  std::string name;  ///< "WLF"
  TemperatureShift shift;
  std::string constants;  ///< "wlf_c1 = 17.4, wlf_c2 = 51.6 K"
  double missed;          ///< of the table [decades], rms
  /// "WLF through the shifts (wlf_c1 = 17.4, wlf_c2 = 51.6 K) misses them by 0.08 decades (rms)"
  std::string in_words() const;
};
/// WLF, Arrhenius and VFT through the table, as far as its rows are enough.
std::vector<LawThrough> laws_through(const TemperatureShift& shift);

/// How far the loss angles of neighbouring temperatures differ at the same |G*| (van Gurp and Palmen, 1998, Rheol.
/// Bull. 67, 5), whatever the shifts of frequency.
struct SuperpositionTest {
  double rms = 0;         ///< of the differences [deg]; NaN: nowhere the same |G*|
  double mean_angle = 0;  ///< of those angles [deg]
  double between = 0;     ///< about what interpolation between rows misses an angle by (rms) [deg]
  int pairs = 0;          ///< of neighbouring temperatures
  int untested = 0;       ///< of these, without a common |G*|
  bool holds() const;
  std::string in_words() const;
};

/// The rows with their moduli times the b_T of a shift, if it has them.
std::vector<MeasuredModulus> times_vertical_shifts(std::vector<MeasuredModulus> data, const TemperatureShift& shift);
SuperpositionTest superposition_test(const std::vector<MeasuredModulus>& data, const std::vector<double>& temperatures);

/// Names the neighbouring temperatures whose reduced frequencies do not overlap: nothing measured joins them. Empty if
/// all do.
std::string without_overlap(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift);

}  // namespace rollres
