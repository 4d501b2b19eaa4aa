#pragma once

/// What a cylinder's scene is to the method with continuous contact edges, whatever its contact.

#include <vector>

#include "core/layer_slopes.hpp"
#include "core/relaxation.hpp"
#include "core/scene.hpp"

namespace rollres {

/// Lengths in m, moduli in Pa. A memory of length T = V tau is int_0^inf e^{-s/T}/T (.)(x + s) ds, written R_T; with
/// the elastic slope g of a layer of unit modulus the slope of the surface is w' = [J_inf + sum_m C_m R_{T_m}] g, and
/// g = [G_inf - sum_j g_j R_{rho_j}] w' (creep and relaxation, core/relaxation.hpp).
struct SpectralProblem {
  /// @param creep the layer's material; the scene's own is not looked at
  /// @param half_width a rough one: memories below 1e-6 of it are joined, and those below 1e-9 are elastic [m]
  SpectralProblem(const RollingScene& scene, const CreepSpectrum& creep, double half_width);

  double profile(double x) const;  // height of the body's lower surface above its lowest point [m]
  double slope(double x) const;    // its derivative [1]
  double cosine(double x) const;   // height of the axis above the surface over R [1]

  RollingScene scene;
  double radius, thickness;
  double glassy, rubbery;                                     // G_inf, G0 [Pa]
  double left_out;                                            // loss of the memories that count as elastic [1]
  double rubbery_compliance;                                  // J_inf + sum C [1/Pa]
  double glassy_compliance;                                   // J_inf [1/Pa]
  std::vector<double> creep_length, creep_compliance;         // T_m, C_m
  std::vector<double> relaxation_length, relaxation_modulus;  // rho_j, g_j
  Eigen::MatrixXd memory_factor;      // [j, m]: C_m T_m/(T_m - rho_j), so that R_{rho_j} w' = sum_m factor R_{T_m} g
  std::vector<LayerMemory> memories;  // one for each T_m; none for a half-space

  bool layered() const;
  Eigen::Index terms() const { return static_cast<Eigen::Index>(creep_length.size()); }
};

}  // namespace rollres
