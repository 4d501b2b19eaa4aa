#include "core/material/creep_rows.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/material/material_functions.hpp"
#include "core/numerics/dense_algebra.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

/// The least squares of relative residuals, at even retardation times from a decade below the rows to one above.
CreepSpectrum nearest_creep(const std::vector<double>& times, const std::vector<double>& compliances) {
  constexpr double per_decade = 8, most = 200;
  const auto [shortest, longest] = std::minmax_element(times.begin(), times.end());
  const double decades = std::log10(*longest / *shortest) + 2;
  const int count = checked_count(std::ceil(std::min(most, per_decade * decades)), "retardation times");
  std::vector<double> retardation;
  for (int j = 0; j <= count; ++j) retardation.push_back(0.1 * *shortest * std::pow(10, decades * j / count));
  const Eigen::Index rows = std::ssize(times);
  const Eigen::Map<const Eigen::ArrayXd> t(times.data(), rows), compliance(compliances.data(), rows);
  Eigen::MatrixXd a(rows, count + 2);
  a.col(0) = 1 / compliance;
  for (int j = 0; j <= count; ++j) a.col(j + 1) = -(-t / retardation[static_cast<std::size_t>(j)]).expm1() / compliance;
  // Any creep at once is a spring; without one the modulus would be infinite at once.
  constexpr double least = 1e-3;
  const double at_once = least * compliance.minCoeff();
  const Eigen::VectorXd found = nonnegative_least_squares(a, (1 - at_once / compliance).matrix());
  CreepSpectrum creep{at_once + found(0), {}};
  for (int j = 0; j <= count; ++j)
    if (found(j + 1) > 0) creep.terms.push_back({found(j + 1), retardation[static_cast<std::size_t>(j)]});
  return creep;
}

}  // namespace

std::vector<double> relaxation_of_creep(const std::vector<double>& times, const std::vector<double>& compliances) {
  const CreepSpectrum creep = nearest_creep(times, compliances);
  const RelaxationSpectrum relaxation = relaxation_spectrum(creep);
  std::vector<double> moduli;
  for (std::size_t row = 0; row < times.size(); ++row)
    moduli.push_back(relaxation_modulus(relaxation, times[row]) * creep_compliance(creep, times[row]) /
                     compliances[row]);
  return moduli;
}

}  // namespace rollres
