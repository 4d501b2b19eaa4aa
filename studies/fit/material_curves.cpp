#include "studies/fit/material_curves.hpp"

#include <cmath>

#include "fitting/errors/statistics.hpp"
#include "studies/fit/fit_keys.hpp"

namespace rollres {

namespace {

/// Storage and loss over the places of the data, in even factors, with their bands.
/// @param moduli_at  of a place, with their errors
template <class ModuliAt>
FitCurves curves_of_moduli(const ChartAxis& x, const char* name, const std::vector<double>& places, int pieces,
                           const FitReport& report, const ModuliAt& moduli_at) {
  FitCurves curves{x, {.name = name, .unit = "Pa", .logarithmic = true}, {{.label = "storage"}, {.label = "loss"}}};
  auto &storage = curves.curves[0], &loss = curves.curves[1];
  for (std::size_t i = 0; i < places.size(); ++i) {
    storage.data.push_back(2 * i);
    loss.data.push_back(2 * i + 1);
  }
  storage.data_x = loss.data_x = places;
  const auto [lowest, highest] = minmax_element(places);
  const double quantile = two_sided_quantile(confidence, report.deviations_known ? 0 : report.degrees);
  const auto add = [&](FitCurve& curve, double place, double modulus, double error) {
    curve.x.push_back(place);
    curve.value.push_back(modulus);
    curve.band.push_back(std::isfinite(error) ? quantile * error : 0);
  };
  for (int i = 0; i <= pieces; ++i) {
    const double place = *lowest * std::pow(*highest / *lowest, static_cast<double>(i) / pieces);
    const SweepModuli moduli = moduli_at(place);
    add(storage, place, moduli.storage, moduli.storage_error);
    add(loss, place, moduli.loss, moduli.loss_error);
  }
  return curves;
}

}  // namespace

FitCurves modulus_curves(const MaterialFile& file, const MaterialFit& found) {
  std::vector<double> reduced;
  for (const MeasuredModulus& row : file.data)
    reduced.push_back(row.angular_frequency * shift_factor(found.shift, row.temperature));
  return curves_of_moduli({.name = "reduced angular frequency", .symbol = "ω", .unit = "rad/s", .logarithmic = true},
                          "shear modulus", reduced, 120, found.report, [&](double omega) {
                            const std::complex<double> modulus = found.modulus(omega, found.shift.reference),
                                                       error = found.modulus_error(omega, found.shift.reference);
                            return SweepModuli{modulus.real(), modulus.imag(), error.real(), error.imag()};
                          });
}

FitCurves shift_curves(const ShiftFile& file, const TemperatureShift& shift) {
  FitCurves curves{{.name = "temperature", .symbol = "T", .unit = "K"},
                   {.name = "ln a_T", .unit = "1"},
                   {{.label = std::string(shift_names[static_cast<std::size_t>(file.law.law)])}}};
  FitCurve& curve = curves.curves.front();
  for (std::size_t i = 0; i < file.data.size(); ++i) {
    curve.data_x.push_back(file.data[i].temperature);
    curve.data.push_back(i);
  }
  const auto [lowest, highest] = minmax_element(curve.data_x);
  constexpr int pieces = 60;
  const double one = shift_factor(shift, file.relative_to.value_or(shift.reference));
  for (int i = 0; i <= pieces; ++i) {
    curve.x.push_back(*lowest + (*highest - *lowest) * i / pieces);
    curve.value.push_back(std::log(shift_factor(shift, curve.x.back()) / one));
    curve.band.push_back(0);
  }
  return curves;
}

FitCurves strain_curves(const StrainFile& file, const StrainFit& found) {
  std::vector<double> amplitudes;
  for (const MeasuredStrain& row : file.data) amplitudes.push_back(row.amplitude);
  return curves_of_moduli({.name = "shear strain amplitude", .symbol = "γ", .unit = "1", .logarithmic = true},
                          "modulus", amplitudes, 60, found.report, [&](double strain) { return found.moduli(strain); });
}

}  // namespace rollres
