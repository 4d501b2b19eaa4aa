#include "core/material/prony_series.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "core/messages/message_text.hpp"
#include "core/numerics/bracketed_root.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

std::complex<double> complex_modulus(const PronySeries& series, double omega) {
  std::complex<double> modulus = series.static_modulus;
  for (const PronySeries::Term& term : series.terms) {
    const std::complex<double> turn(0, omega * term.time);
    modulus += term.modulus * turn / (1.0 + turn);
  }
  return modulus;
}

double relaxation_modulus(const PronySeries& series, double time) {
  double sum = series.static_modulus;
  for (const PronySeries::Term& term : series.terms) sum += term.modulus * std::exp(-time / term.time);
  return sum;
}

PronySeries ordered(PronySeries series) {
  std::sort(series.terms.begin(), series.terms.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  std::vector<PronySeries::Term> terms;
  for (const PronySeries::Term& term : series.terms) {
    if (term.modulus == 0) continue;
    if (!terms.empty() && terms.back().time == term.time)
      terms.back().modulus += term.modulus;
    else
      terms.push_back(term);
  }
  series.terms = std::move(terms);
  return series;
}

namespace {

/// Where the modulus vanishes above the time of a term.
double zero_of(const std::optional<double>& found, const PronySeries::Term& term, double static_modulus) {
  if (!found || !std::isfinite(*found))
    throw std::domain_error(
        message_text<6>("relaxation_moduli: no time of creep was found above the relaxation time of ", term.time,
                        " s, since its modulus, ", term.modulus, " Pa, is too far from that at rest, ", static_modulus,
                        " Pa; leave out the terms that do not count"));
  return *found;
}

}  // namespace

CreepSpectrum creep_spectrum(const PronySeries& series) {
  const std::vector<PronySeries::Term>& terms = series.terms;
  double glassy = series.static_modulus;
  for (const PronySeries::Term& term : terms) glassy += term.modulus;
  CreepSpectrum creep{.instantaneous = 1 / glassy, .terms = {}};
  // With s = -1/lambda the modulus has its poles at lambda = time_j and one zero above each. Written with
  // u = lambda / time_j - 1 for the pole below the zero, u has all its digits even when zero and pole nearly coincide.
  for (std::size_t j = 0; j < terms.size(); ++j) {
    require_time();
    const double pole = terms[j].time;
    // G(lambda) without this pole and the next one.
    const auto others = [&](double u) {
      double sum = series.static_modulus;
      for (std::size_t k = 0; k < terms.size(); ++k)
        if (k != j && k != j + 1) sum -= terms[k].modulus * terms[k].time / (pole * (1 + u) - terms[k].time);
      return sum;
    };
    // u G(lambda), negative at 0 and positive for a large u.
    const auto modulus_times_u = [&](double u) { return u * others(u) - terms[j].modulus; };
    double u;
    double to_next = INFINITY;  // u at the next pole
    if (terms.size() == 1) {
      u = zero_of(terms[j].modulus / series.static_modulus, terms[j], series.static_modulus);
    } else if (j + 1 == terms.size()) {
      double high = terms[j].modulus / series.static_modulus;
      while (modulus_times_u(high) < 0) high *= 2;
      u = zero_of(root_between(modulus_times_u, 0, high), terms[j], series.static_modulus);
    } else {
      to_next = (terms[j + 1].time - pole) / pole;
      const double next = terms[j + 1].modulus * terms[j + 1].time / pole;
      // Times (to_next - u), the next pole's term apart: times that nearly coincide lose no digits.
      const auto without_poles = [&](double v) {
        return (to_next - v) * (v * others(v) - terms[j].modulus) + v * next;
      };
      u = zero_of(root_between(without_poles, 0, to_next), terms[j], series.static_modulus);
    }
    const double time = pole * (1 + u);
    double slope = 0;  // lambda dG/ds at the zero
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const double distance = k == j ? u * pole : k == j + 1 ? (u - to_next) * pole : time - terms[k].time;
      slope += terms[k].modulus * (terms[k].time / distance) * (time / distance);
    }
    creep.terms.push_back({1 / slope, time});
  }
  return creep;
}

RelaxationSpectrum relaxation_spectrum(const CreepSpectrum& creep) {
  RelaxationSpectrum relaxation{.instantaneous = 1 / creep.instantaneous, .terms = {}};
  if (creep.terms.empty()) return relaxation;
  // By 1/(1 + i omega tau) = i omega'/tau / (1 + i omega'/tau) at omega' = -1/omega, the compliance over omega' is a
  // Prony series of the times 1/tau, and its inverse has the times 1/theta; both here times the longest tau.
  const double longest = creep.terms.back().time;
  PronySeries mirrored{creep.instantaneous, {}};
  for (auto term = creep.terms.rbegin(); term != creep.terms.rend(); ++term)
    mirrored.terms.push_back({term->compliance, longest / term->time});
  const CreepSpectrum inverse = creep_spectrum(mirrored);
  for (auto term = inverse.terms.rbegin(); term != inverse.terms.rend(); ++term)
    relaxation.terms.push_back({term->compliance, longest / term->time});
  return relaxation;
}

}  // namespace rollres
