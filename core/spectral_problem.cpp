#include "core/spectral_problem.hpp"

#include <algorithm>
#include <cmath>

#include "core/lumped_spectrum.hpp"

namespace rollres {

namespace {

/// Ascending, with terms of nearly the same time joined and those too short to matter made elastic.
CreepSpectrum tidied(CreepSpectrum creep, double shortest) {
  std::sort(creep.terms.begin(), creep.terms.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  CreepSpectrum tidy{.instantaneous = creep.instantaneous, .terms = {}};
  for (const CreepSpectrum::Term& term : creep.terms) {
    if (term.time < shortest)
      tidy.instantaneous += term.compliance;
    else if (!tidy.terms.empty() && term.time < (1 + 1e-9) * tidy.terms.back().time)
      tidy.terms.back().compliance += term.compliance;
    else if (term.compliance > 0)
      tidy.terms.push_back(term);
  }
  return tidy;
}

}  // namespace

SpectralProblem::SpectralProblem(const RollingScene& given, const CreepSpectrum& material, double half_width)
    : scene(given), radius(given.radius), thickness(given.layer_thickness) {
  const double largest = std::isinf(thickness) ? half_width : std::max(half_width, thickness);
  const CreepSpectrum creep =
      tidied(lumped_for(material, scene.speed, 1e-3 * half_width, 1e2 * largest), 1e-9 * half_width / scene.speed);
  const RelaxationSpectrum relaxation = relaxation_spectrum(creep);
  glassy = relaxation.instantaneous;
  glassy_compliance = rubbery_compliance = creep.instantaneous;
  for (const CreepSpectrum::Term& term : creep.terms) {
    creep_length.push_back(scene.speed * term.time);
    creep_compliance.push_back(term.compliance);
    rubbery_compliance += term.compliance;
    if (layered()) memories.emplace_back(thickness, creep_length.back());
  }
  rubbery = 1 / rubbery_compliance;
  for (const RelaxationSpectrum::Term& term : relaxation.terms) {
    relaxation_length.push_back(scene.speed * term.time);
    relaxation_modulus.push_back(term.modulus);
  }
  memory_factor.resize(terms(), terms());
  for (Eigen::Index j = 0; j < terms(); ++j)
    for (Eigen::Index m = 0; m < terms(); ++m) {
      const double creep_m = creep_length[static_cast<std::size_t>(m)];
      memory_factor(j, m) = creep_compliance[static_cast<std::size_t>(m)] * creep_m /
                            (creep_m - relaxation_length[static_cast<std::size_t>(j)]);
    }
}

bool SpectralProblem::layered() const { return std::isfinite(thickness); }

double SpectralProblem::cosine(double x) const { return std::sqrt(std::max(1 - x * x / (radius * radius), 1e-4)); }
double SpectralProblem::profile(double x) const { return x * x / (radius * (1 + cosine(x))); }
double SpectralProblem::slope(double x) const { return x / (radius * cosine(x)); }

}  // namespace rollres
