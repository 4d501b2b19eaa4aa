#include "core/material/material_functions.hpp"

#include <cmath>

#include "core/material/free_series.hpp"
#include "core/material/relative_rows.hpp"
#include "core/material/smooth_spectrum.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

double creep_compliance(const CreepSpectrum& creep, double time) {
  double sum = creep.instantaneous;
  for (const CreepSpectrum::Term& term : creep.terms) sum -= term.compliance * std::expm1(-time / term.time);
  return sum;
}

double relaxation_modulus(const RelaxationSpectrum& relaxation, double time) {
  double sum = relaxation.instantaneous;
  for (const RelaxationSpectrum::Term& term : relaxation.terms) sum += term.modulus * std::expm1(-time / term.time);
  return sum;
}

double loss_tangent(const CreepSpectrum& creep, double omega) {
  const std::complex<double> compliance = creep(omega);
  return -compliance.imag() / compliance.real();
}

double slow_loss_time(const CreepSpectrum& creep) {
  double sum = 0;
  for (const CreepSpectrum::Term& term : creep.terms) sum += term.compliance * term.time;
  return sum / creep.at_rest();
}

std::vector<double> angular_frequencies(const CreepSpectrum& creep, int per_decade) {
  const double longest = creep.terms.empty() ? 1 : creep.terms.back().time;
  const double shortest = creep.terms.empty() ? 1 : creep.terms.front().time;
  const int count = checked_count(std::ceil((std::log10(longest / shortest) + 2) * per_decade), "frequencies");
  std::vector<double> all;
  for (int i = 0; i <= count; ++i) all.push_back(0.1 / longest * std::pow(100 * longest / shortest, 1.0 * i / count));
  return all;
}

std::vector<LossPeak> loss_peaks(const CreepSpectrum& creep) {
  constexpr int per_decade = 40, halvings = 50;
  std::vector<LossPeak> peaks;
  if (creep.terms.empty()) return peaks;
  const std::vector<double> omega = angular_frequencies(creep, per_decade);
  std::vector<double> tangent;
  for (const double one : omega) tangent.push_back(loss_tangent(creep, one));
  for (std::size_t i = 1; i + 1 < omega.size(); ++i) {
    if (!(tangent[i] > tangent[i - 1] && tangent[i] >= tangent[i + 1])) continue;
    double low = omega[i - 1], high = omega[i + 1];
    for (int step = 0; step < halvings; ++step) {  // ternary search
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      if (loss_tangent(creep, a) < loss_tangent(creep, b))
        low = a;
      else
        high = b;
    }
    peaks.push_back({0.5 * (low + high), loss_tangent(creep, 0.5 * (low + high))});
  }
  return peaks;
}

namespace {

/// Few retardation times or a smooth spectrum, whichever the rows are more likely on. Without the advantage that few
/// terms have in a master curve: rows by few terms that noise suggests would show that curve's fit no others.
CreepSpectrum likelier_creep(const std::vector<double>& times, const std::vector<double>& compliances) {
  const RelativeRows rows = RelativeRows::of_creep(times, compliances);
  const SpectrumFit smooth = smooth_spectrum(rows), few = free_series(rows, smooth.evidence);
  const PronySeries found = ordered(few.evidence > smooth.evidence ? few.series : smooth.series);
  CreepSpectrum creep{found.static_modulus, {}};
  for (const PronySeries::Term& term : found.terms) creep.terms.push_back({term.modulus, term.time});
  return creep;
}

}  // namespace

std::vector<double> relaxation_of_creep(const std::vector<double>& times, const std::vector<double>& compliances) {
  const CreepSpectrum creep = likelier_creep(times, compliances);
  const RelaxationSpectrum relaxation = relaxation_spectrum(creep);
  std::vector<double> moduli;
  for (std::size_t row = 0; row < times.size(); ++row)
    moduli.push_back(relaxation_modulus(relaxation, times[row]) * creep_compliance(creep, times[row]) /
                     compliances[row]);
  return moduli;
}

}  // namespace rollres
