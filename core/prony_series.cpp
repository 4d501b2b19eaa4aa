#include "core/prony_series.hpp"

namespace rollres {

std::complex<double> complex_modulus(const PronySeries& series, double omega) {
  std::complex<double> modulus = series.static_modulus;
  for (const PronySeries::Term& term : series.terms) {
    const std::complex<double> turn(0, omega * term.time);
    modulus += term.modulus * turn / (1.0 + turn);
  }
  return modulus;
}

}  // namespace rollres
