#pragma once

/// The density of the power lost along a line of flow, from the stresses along it.
///
/// For a spectrum of creep J = J_inf + sum C_m/(1 + i omega tau_m) as springs and dashpots, with y_m the memory mean of
/// the stress over T_m = V tau_m and E(sigma) = G epsilon(sigma) : sigma: sum_m C_m/tau_m E(sigma - y_m).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/material/material.hpp"

namespace rollres {

/// Whether a material loses anything; what does not loses no rounding either.
inline bool creeps(const CreepSpectrum& material) {
  return std::any_of(material.terms.begin(), material.terms.end(),
                     [](const CreepSpectrum::Term& term) { return term.compliance > 0; });
}

/// @param stress (component, point), points evenly spaced in the order in which material passes them, linear between
/// @param ahead  memory means of the stress at the first point, one column a term   @param step between points [m]
/// @param distortion E of a column
/// @return [W/m3] at each point
template <class Distortion>
Eigen::ArrayXd flow_loss(const Eigen::ArrayXXd& stress, const Eigen::ArrayXXd& ahead, const CreepSpectrum& material,
                         double step, double speed, Distortion distortion) {
  Eigen::ArrayXd density = Eigen::ArrayXd::Zero(stress.cols());
  for (std::size_t m = 0; m < material.terms.size(); ++m) {
    const auto& [compliance, time] = material.terms[m];
    if (!(compliance > 0 && time > 0)) continue;
    const double length = speed * time, kept = std::exp(-step / length);
    Eigen::ArrayXd mean = ahead.col(static_cast<Eigen::Index>(m));
    for (Eigen::Index i = 0; i < stress.cols(); ++i) {
      if (i > 0) {
        const Eigen::ArrayXd slope = (stress.col(i - 1) - stress.col(i)) / step;
        mean = kept * (mean - stress.col(i - 1) - length * slope) + stress.col(i) + length * slope;
      }
      density(i) += compliance / time * distortion(Eigen::ArrayXd(stress.col(i) - mean));
    }
  }
  return density;
}

}  // namespace rollres
