#pragma once

/// The half-space next to the contact in steady passage with inertia: its compliance as a sum of what answers at once
/// and of retarded parts.

#include <Eigen/Core>
#include <vector>

namespace rollres {

struct MediumLayer;

/// One memory of a half-space in steady passage with inertia: k c_ww, k c_ll and k c_x are sums of compliances/(1 + s
/// T), s = -i times the wavenumber along the motion.
struct HalfSpaceTerm {
  double length;               // T [m]; 0: at once
  Eigen::Array3d compliances;  // [1/Pa]
};

/// The half-space of a layer's material, to 1e-11 of its compliances; none if waves are about as slow as the body, or
/// times of creep coincide.
std::vector<HalfSpaceTerm> half_space_terms(const MediumLayer& layer, double speed);

/// A function of s as at_once + sum weights/(1 + s lengths).
struct RetardedSum {
  Eigen::Array3d at_once;
  std::vector<double> lengths;
  std::vector<Eigen::Array3d> weights;

  void add(double rate, const Eigen::Array3d& part) {  // part/(s - rate)
    lengths.push_back(-1 / rate);
    weights.push_back(-part / rate);
  }
};

/// 2 k c_ww/D, 2 k c_ll/D and k c_x/D of (S28), of unit modulus.
/// @param instantaneous, compliances  of the shear compliance, over 2 (1 - nu) [1/Pa]
/// @param lengths  ascending, V times the times of its terms [m]
RetardedSum half_space_ratios(const MediumLayer& layer, double speed, double instantaneous,
                              const std::vector<double>& lengths, const std::vector<double>& compliances);

}  // namespace rollres
