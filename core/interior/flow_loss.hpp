#pragma once

/// The density of the power lost along a line of flow, from the stresses along it.
///
/// For a spectrum of creep J = J_inf + sum C_m/(1 + i omega tau_m) as springs and dashpots, with y_m the memory mean of
/// the stress over T_m = V tau_m and E(sigma) = G epsilon(sigma) : sigma: sum_m C_m/tau_m E(sigma - y_m).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <span>
#include <vector>

#include "core/material/material.hpp"

namespace rollres {

/// Whether a material loses anything; what does not loses no rounding either.
inline bool creeps(const CreepSpectrum& material) {
  return std::any_of(material.terms.begin(), material.terms.end(),
                     [](const CreepSpectrum::Term& term) { return term.compliance > 0; });
}

/// E(sigma) = G epsilon : sigma = 1/2 [sigma : sigma - nu/(1 + nu) tr^2], of real or of complex stresses x, y, z, yz,
/// xz, xy.
template <class Stresses>
double distortion_of(const Stresses& s, double nu) {
  const auto trace = s[0] + s[1] + s[2];
  double sum = -nu / (1 + nu) * std::norm(trace);
  for (int c = 0; c < 3; ++c) sum += std::norm(s[c]) + 2 * std::norm(s[c + 3]);
  return 0.5 * sum;
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

/// The same on a line with places in ascending order, of either direction of flow.
/// @param stress (component, place)   @param ahead  memory means at the first place that material passes
/// @param speed V, negative where it flows backwards: then it passes the first place first   @param flow speed over V >
/// 0
template <class Distortion>
Eigen::ArrayXd density_on_line(Eigen::ArrayXXd stress, const Eigen::ArrayXXd& ahead, const CreepSpectrum& material,
                               double step, double speed, double flow, Distortion distortion) {
  if (speed > 0) stress = stress.rowwise().reverse().eval();
  const Eigen::ArrayXd density = flow * flow_loss(stress, ahead, material, step, std::abs(speed), distortion);
  return speed > 0 ? Eigen::ArrayXd(density.reverse()) : density;
}

/// Of places in ascending order that which material passes first.
inline double first_passed(const Eigen::ArrayXd& x, double speed) { return speed > 0 ? x(x.size() - 1) : x(0); }

/// Adds a wave's part to the memory means of the stress at a place.
/// @param ahead (component, term)   @param turned its weight times e^{ikx} there   @param stress its amplitudes
inline void add_memories(Eigen::ArrayXXd& ahead, const CreepSpectrum& material, double wavenumber, double speed,
                         std::complex<double> turned, std::span<const std::complex<double>> stress) {
  for (Eigen::Index m = 0; m < ahead.cols(); ++m) {
    const double time = material.terms[static_cast<std::size_t>(m)].time;
    const std::complex<double> mean = turned / std::complex<double>(1, -wavenumber * speed * time);
    for (std::size_t c = 0; c < stress.size(); ++c) ahead(static_cast<Eigen::Index>(c), m) += (mean * stress[c]).real();
  }
}

}  // namespace rollres
