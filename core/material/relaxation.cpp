#include "core/material/relaxation.hpp"

#include <cmath>

#include "core/numerics/bracketed_root.hpp"

namespace rollres {

RelaxationSpectrum relaxation_spectrum(const CreepSpectrum& creep) {
  RelaxationSpectrum relaxation{.instantaneous = 1 / creep.instantaneous, .terms = {}};
  // With s = -1/theta the compliance has its poles at theta = tau_m and one zero below each. Written with
  // u = tau_m / theta - 1 for the pole above the zero, u has all its digits even when zero and pole nearly coincide.
  for (std::size_t m = 0; m < creep.terms.size(); ++m) {
    const double pole = creep.terms[m].time, pole_below = m > 0 ? creep.terms[m - 1].time : 0;
    // f(u) = u J(-(1 + u)/tau_m), without its pole; positive for a large u, negative at 0.
    const auto compliance_times_u = [&](double u) {
      double sum = creep.instantaneous;
      for (std::size_t k = 0; k < creep.terms.size(); ++k)
        if (k != m) sum += creep.terms[k].compliance / (1 - creep.terms[k].time * (1 + u) / pole);
      return u * sum - creep.terms[m].compliance;
    };
    // At the pole below, tau_k (1 + u) = tau_m: there the sum tends to +infinity from this side.
    double u;
    if (creep.terms.size() == 1) {
      u = creep.terms[m].compliance / creep.instantaneous;
    } else if (m == 0) {
      double high = creep.terms[0].compliance / creep.instantaneous;
      while (compliance_times_u(high) < 0) high *= 2;
      u = bracketed_root(compliance_times_u, 0, high);
    } else {
      const double limit = pole / pole_below - 1;
      u = bracketed_root([&](double v) { return (limit - v) * compliance_times_u(v); }, 0, limit * (1 - 1e-15));
    }
    const double time = pole / (1 + u);
    double slope = 0;  // - J'(s) / theta at the zero
    for (std::size_t k = 0; k < creep.terms.size(); ++k) {
      const double distance = k == m ? u : creep.terms[k].time * (1 + u) / pole - 1;
      slope += creep.terms[k].compliance * creep.terms[k].time / time / (distance * distance);
    }
    relaxation.terms.push_back({1 / slope, time});
  }
  return relaxation;
}

}  // namespace rollres
