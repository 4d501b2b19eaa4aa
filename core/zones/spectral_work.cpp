#include "core/zones/spectral_work.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

namespace {

constexpr double per_memory_of_rings = 0.01;  // of what an evaluation takes without

}  // namespace

double work_of(const SpectralProblem& problem, const SlipPattern& pattern, int order) {
  if (problem.graded(pattern.shear)) {
    const double nodes = order * (1 + 2.5 * static_cast<double>(pattern.sticks())) / 100;
    return 0.6 * nodes * nodes * (nodes + 1);
  }
  const double unknowns = order * (1 + static_cast<double>(pattern.sticks())) / 100;
  // A ring's curvature has all its memories.
  const double memories =
      problem.curved(pattern.shear) ? 1 + per_memory_of_rings * static_cast<double>(problem.terms()) : 1;
  return memories * (pattern.one_direction() ? 1.5 : 8) * unknowns * (unknowns + 0.5);
}

double work_of_check(const SpectralProblem& problem, const SlipPattern& pattern, int order, double half_length) {
  double rate = 0;
  for (const double length : problem.relaxation_length) rate = std::max(rate, half_length / length);
  return 2 * work_of(problem, pattern, order) + std::min(0.3 * std::sqrt(rate), 150.0);
}

}  // namespace rollres
