#pragma once

/// What a cylinder's scene is to the method with continuous contact edges, whatever its contact.

#include <memory>
#include <vector>

#include "core/material/prony_series.hpp"
#include "core/model/indenter_shape.hpp"
#include "core/spectral/slope_correction.hpp"
#include "core/surface/deep_response.hpp"

namespace rollres {

/// Lengths in m, moduli in Pa. With g the elastic slope of a surface of unit modulus the slope of the surface is
/// w' = [J_inf + sum_m C_m R_{T_m}] g, and g = [G_inf - sum_j g_j R_{rho_j}] w', R_T the mean over a memory
/// (core/spectral/README.md, (S3) and (S4)). The spectrum is that of what lies next to the contact; all else is in the
/// corrections to g.
struct SpectralProblem {
  /// @param creep what lies next to the contact, as by near_spectrum (contact_surface.hpp); of a single incompressible
  /// layer it is the material, and the scene's own is not looked at
  /// @param half_width a rough one: memories below 1e-6 of it are joined, and those below 1e-9 are elastic [m]
  SpectralProblem(const ContactModel& model, const CreepSpectrum& creep, double half_width);

  ContactModel model;
  IndenterShape shape;
  double half_width;                                          // the rough one [m]
  double glassy, rubbery;                                     // G_inf, G0 [Pa]
  double left_out;                                            // loss of the memories too short to matter [1]
  bool taken_up;                                              // whether the shortest memory stands for these as well
  double made_elastic;                                        // sum of C T of those for which none does [m/Pa]
  double rubbery_compliance;                                  // J_inf + sum C [1/Pa]
  double glassy_compliance;                                   // J_inf [1/Pa]
  std::vector<double> creep_length, creep_compliance;         // T_m, C_m
  std::vector<double> relaxation_length, relaxation_modulus;  // rho_j, g_j
  Eigen::MatrixXd memory_factor;                              // [j, m]: F_jm of (S5)
  std::shared_ptr<const DeepResponse> deep;                   // what short waves make of tractions
  bool inertia;                                               // of the layers, is part of it
  std::shared_ptr<const SlopeCorrection> correction;          // none for a half-space
  /// With a coating one of the two sides alone: the coating, or without friction the foundation where that remembers
  /// nothing, which costs less. What the coating then yields is the rest: with friction the search for zones needs it
  /// before the slopes are those of the body.
  std::shared_ptr<const SpectralProblem> side;
  bool side_is_coating = true;
  CoatingMoments coating_moments;  // M and N of (S18), as far as they are known [N/m]

  /// Whether pressure and shear, if there is any, are coupled in short waves, or these remember (section 9).
  bool graded(bool shear) const { return inertia || (shear && deep->cross() != 0); }
  /// Whether the surface is curved: the slopes of a ring go with a logarithm, which knows the pressure by its
  /// coefficients alone and not by what short memories add beyond; and where it is sheared, which moves it outwards by
  /// the shear's integral (core/surface/ring_compliance.hpp), the pressure has a power 3/2 of the distance from ends of
  /// sticks, that densities have not.
  bool curved(bool shear) const { return model.ring() && !graded(shear); }
  bool layered() const { return correction != nullptr; }
  Eigen::Index terms() const { return static_cast<Eigen::Index>(creep_length.size()); }
};

}  // namespace rollres
