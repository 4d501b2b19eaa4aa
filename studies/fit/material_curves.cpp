#include "studies/fit/material_curves.hpp"

#include <algorithm>
#include <cmath>

#include "fitting/errors/statistics.hpp"
#include "studies/fit/fit_keys.hpp"

namespace rollres {

FitCurves modulus_curves(const MaterialFile& file, const MaterialFit& found) {
  FitCurves curves{{.name = "reduced angular frequency", .symbol = "ω", .unit = "rad/s", .logarithmic = true},
                   {.name = "shear modulus", .unit = "Pa", .logarithmic = true},
                   {{.label = "storage"}, {.label = "loss"}}};
  std::vector<double> reduced;
  for (const MeasuredModulus& row : file.data)
    reduced.push_back(row.angular_frequency * shift_factor(found.shift, row.temperature));
  const auto [lowest, highest] = std::minmax_element(reduced.begin(), reduced.end());
  constexpr int pieces = 120;
  const double quantile = two_sided_quantile(confidence, found.report.deviations_known ? 0 : found.report.degrees);
  const auto add = [&](FitCurve& curve, double omega, double modulus, double error) {
    curve.x.push_back(omega);
    curve.value.push_back(modulus);
    curve.band.push_back(std::isfinite(error) ? quantile * error : 0);
  };
  auto &storage = curves.curves[0], &loss = curves.curves[1];
  for (std::size_t i = 0; i < reduced.size(); ++i) {
    storage.data.push_back(2 * i);
    loss.data.push_back(2 * i + 1);
  }
  storage.data_x = loss.data_x = reduced;
  for (int i = 0; i <= pieces; ++i) {
    const double omega = *lowest * std::pow(*highest / *lowest, static_cast<double>(i) / pieces);
    const std::complex<double> modulus = found.modulus(omega, found.shift.reference),
                               error = found.modulus_error(omega, found.shift.reference);
    add(storage, omega, modulus.real(), error.real());
    add(loss, omega, modulus.imag(), error.imag());
  }
  return curves;
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
  const auto [lowest, highest] = std::minmax_element(curve.data_x.begin(), curve.data_x.end());
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
  FitCurves curves{{.name = "shear strain amplitude", .symbol = "γ", .unit = "1", .logarithmic = true},
                   {.name = "modulus", .unit = "Pa", .logarithmic = true},
                   {{.label = "storage"}, {.label = "loss"}}};
  auto &storage = curves.curves[0], &loss = curves.curves[1];
  double lowest = file.data.front().amplitude, highest = lowest;
  for (std::size_t i = 0; i < file.data.size(); ++i) {
    lowest = std::min(lowest, file.data[i].amplitude);
    highest = std::max(highest, file.data[i].amplitude);
    storage.data_x.push_back(file.data[i].amplitude);
    storage.data.push_back(2 * i);
    loss.data.push_back(2 * i + 1);
  }
  loss.data_x = storage.data_x;
  constexpr int pieces = 60;
  const double quantile = two_sided_quantile(confidence, found.report.deviations_known ? 0 : found.report.degrees);
  const auto add = [&](FitCurve& curve, double strain, double modulus, double error) {
    curve.x.push_back(strain);
    curve.value.push_back(modulus);
    curve.band.push_back(std::isfinite(error) ? quantile * error : 0);
  };
  for (int i = 0; i <= pieces; ++i) {
    const double strain = lowest * std::pow(highest / lowest, static_cast<double>(i) / pieces);
    const SweepModuli moduli = found.moduli(strain);
    add(storage, strain, moduli.storage, moduli.storage_error);
    add(loss, strain, moduli.loss, moduli.loss_error);
  }
  return curves;
}

}  // namespace rollres
