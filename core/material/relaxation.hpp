#pragma once

/// The relaxation spectrum that belongs to a creep spectrum: its inverse in the Laplace domain.

#include <vector>

#include "core/material/material.hpp"

namespace rollres {

/// G*(omega) = instantaneous - sum_j modulus_j / (1 + i omega time_j).
struct RelaxationSpectrum {
  struct Term {
    double modulus;  // [Pa], > 0
    double time;     // relaxation time [s]
  };
  double instantaneous = 0;  // G'(infinity) [Pa]
  std::vector<Term> terms;   // one just below each retardation time
};

/// @param creep with positive times, all different, ascending, and positive compliances
RelaxationSpectrum relaxation_spectrum(const CreepSpectrum& creep);

}  // namespace rollres
