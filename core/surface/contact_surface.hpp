#pragma once

/// Everything that yields in a contact, as one response of the surface: the layers under the body and those on it.
///
/// Tractions on a coating are opposite to those on the foundation, and so are their normals: compliances add, but for
/// the cross terms, which subtract (Johnson 1985, section 5.1, for two half-spaces). A coating is taken as flat, bonded
/// to the rigid core of the body, and to have recovered when it comes round again. It flows through the contact at
/// R Omega, the foundation at V: at a wavenumber k it answers with the modulus of the frequency -k R Omega, which is
/// that of a material with omega = R Omega/V times as long retardation times at -k V, and, backwards, its conjugate. A
/// locked coating is at rest in the body's frame and answers with G0.

#include <string>

#include "core/material/lumped_spectrum.hpp"
#include "core/scene/scene.hpp"
#include "core/surface/layered_medium.hpp"

namespace rollres {

/// Speed at which the coating flows through the contact over V, R Omega/V: the scene's `coating_flow` if it has one,
/// else as its drive gives it, else 1 [1].
double flow_of_coating(const RollingScene& scene);

/// Whether the answer depends on that speed: a coating has a memory, or inertia that counts.
bool coating_flow_counts(const RollingScene& scene);

/// Whether a coating with a memory flows backwards, so that its memory lies ahead of the contact.
bool coating_remembers_ahead(const RollingScene& scene);

/// Creep of one of the scene's coatings as steady motion at V meets it: its retardation times multiplied by |R
/// Omega/V|.
CreepSpectrum creep_in_flow(const RollingScene& scene, const BondedLayer& coating);

/// What rho V^2/G must stay below for steady motion: 1 at the speed of Rayleigh waves on a half-space of the layer at
/// rest, for the layer of the scene that is nearest to it [1].
double rayleigh_number(const RollingScene& scene);

/// Whether the layers together carry waves slower than the body although its Rayleigh number is below 1: steady motion
/// with inertia is not modelled there either.
bool layers_carry_slower_waves(const RollingScene& scene);

/// Whether the layers' inertia is part of the scene's model: asked for, or by itself where a tolerance is given, it is
/// not negligible by the modulus at rest, and the model has it: below the speed of Rayleigh waves, with a grid.
bool inertia_included(const RollingScene& scene);

/// rho V^2/G beyond which inertia would change the resistance by more than a thousandth and more than a tenth of the
/// tolerance given [1].
double negligible_inertia(const RollingScene& scene);

/// Whether the surface is more than one layer of one material without inertia.
bool is_composite(const RollingScene& scene);

/// The layers under the body and those on it, from the contact away; densities are 0 where inertia is left out. The
/// latter may be none; their creep and density are those that act as much at V (`flow_of_coating`), forwards.
/// @param told_apart  of the memories; others are lumped, material by material
LayeredMedium foundation_of(const RollingScene& scene, const MemoryRange& told_apart = {});
LayeredMedium coating_of(const RollingScene& scene, const MemoryRange& told_apart = {});

/// The coating as a layer on a rigid base that flows at |R Omega|, which answers as the coating does, but for shear and
/// displacements along the surface, which are opposite. A coating at rest is elastic. @pre there is a coating
RollingScene coating_alone(const RollingScene& scene);

/// The coating's share of what a contact of this half-width [m] yields under pressure in passage, 0 without one: at a
/// wavenumber of one over the half-width, and at the speed's frequency [1].
double share_of_coating(const RollingScene& scene, double half_width);

/// Thickness of all layers under and on the body [m]; infinite over a half-space.
double total_thickness(const RollingScene& scene);

/// Thickness of those that are not infinite [m].
double finite_thickness(const RollingScene& scene);

/// Whether a rigid base lies below all layers, and not a half-space.
bool has_rigid_base(const RollingScene& scene);

/// Distance of the nearest face below the surface or inside the body [m]; infinite where both are half-spaces.
double nearest_interface(const RollingScene& scene);

/// Normal compliance that short waves see, of the half-spaces of the two materials next to the contact, as the spectrum
/// of creep in shear of the incompressible half-space that yields as much: sum of 2 (1 - nu)/G*. Without inertia.
CreepSpectrum near_spectrum(const RollingScene& scene, const MemoryRange& told_apart = {});

/// What bounds the surface, top and bottom, in words: "2 bonded layers on a rigid base, coated rigid body".
std::string surface_in_words(const RollingScene& scene);

/// Compliance of the surface in steady motion, wavenumber by wavenumber.
class SteadySurface {
 public:
  explicit SteadySurface(const RollingScene& scene, const MemoryRange& told_apart = {});

  /// Moduli for one wavenumber along the motion.
  struct Moduli {
    std::complex<double> compliance;  ///< 1/G* where the surface is one layer
    std::vector<std::complex<double>> foundation, coating;
  };
  Moduli moduli(double along) const;

  /// For wavenumbers (along, across) [1/m], not both 0 over a half-space [m/Pa].
  SurfaceCompliance operator()(const Moduli& moduli, double along, double across) const;

  /// What short waves along the motion see, times their wavenumber: half-spaces of the materials next to the contact
  /// [1/Pa].
  SurfaceCompliance half_spaces(const Moduli& moduli) const;
  /// And what long waves see: the half-space below, at rest, or nothing over a rigid base [1/Pa].
  SurfaceCompliance long_waves() const;

  double speed() const { return speed_; }  ///< [m/s]
  /// Longest of the lengths over which the surface answers: all thicknesses together, bending of a stiff layer on a
  /// soft one, and the memories [m].
  double longest_wave() const;

 private:
  bool composite_, backwards_;
  Layer layer_;
  double speed_, thickness_;
  CreepSpectrum material_;
  LayeredMedium foundation_, coating_;
};

}  // namespace rollres
