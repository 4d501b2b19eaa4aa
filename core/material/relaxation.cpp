#include "core/material/relaxation.hpp"

#include "core/material/prony_series.hpp"

namespace rollres {

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
