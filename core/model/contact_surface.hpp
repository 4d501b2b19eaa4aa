#pragma once

/// What the layers of a model make of its surface: the media that motion meets, and the lengths and spectra that
/// solvers choose their numbers by.
///
/// A coating flows through the contact at R Omega, the foundation at V: at a wavenumber k it answers with the modulus
/// of the frequency -k R Omega, which is that of a material with omega = R Omega/V times as long retardation times at
/// -k V, and, backwards, its conjugate. A locked coating is at rest in the body's frame and answers with G0.

#include <string>

#include "core/material/lumped_spectrum.hpp"
#include "core/model/contact_model.hpp"
#include "core/surface/steady_surface.hpp"

namespace rollres {

/// Whether the answer depends on the speed of the coating through the contact: it has a memory, or inertia that counts.
bool coating_flow_counts(const ContactModel& model);

/// Whether a coating with a memory flows backwards, so that its memory lies ahead of the contact.
bool coating_remembers_ahead(const ContactModel& model);

/// Creep of one of the model's coatings as steady motion at V meets it: its retardation times multiplied by |R
/// Omega/V|.
CreepSpectrum creep_in_flow(const ContactModel& model, const ModelLayer& coating);

/// Whether the layers together carry waves slower than the body although its Rayleigh number is below 1: steady motion
/// with inertia is not modelled there either.
bool layers_carry_slower_waves(const ContactModel& model);

/// The layers under the body and those on it, from the contact away; densities are 0 where inertia is left out. The
/// latter may be none; their creep and density are those that act as much at V, forwards.
/// @param told_apart  of the memories; others are lumped, material by material
LayeredMedium foundation_of(const ContactModel& model, const MemoryRange& told_apart = {});
LayeredMedium coating_of(const ContactModel& model, const MemoryRange& told_apart = {});

/// Compliance of the surface, the coating with it.
SteadySurface steady_surface(const ContactModel& model, const MemoryRange& told_apart = {});

/// The coating as a layer on a rigid base that flows at |R Omega|, which answers as the coating does, but for shear and
/// displacements along the surface, which are opposite. A coating at rest is elastic. @pre there is a coating
ContactModel coating_alone(const ContactModel& model);
/// What lies under the body, under a rigid one. @pre there is a coating
ContactModel foundation_alone(const ContactModel& model);
/// Whether it remembers nothing.
bool has_elastic_foundation(const ContactModel& model);

/// The coating's share of what a contact of this half-width [m] yields under pressure in passage, 0 without one: at a
/// wavenumber of one over the half-width, and at the speed's frequency [1].
double share_of_coating(const ContactModel& model, double half_width);

/// What all earlier turns leave of a ring's displacement when it comes round, over that under the body, roughly: of its
/// elastic part and of its longest memory; 0 without a ring [1].
double left_after_turn(const ContactModel& model);
/// Whether that counts beside the tolerance asked for.
bool feels_earlier_turns(const ContactModel& model);
/// The ring alone on a rigid base, as its turns meet it (surface/earlier_turns.hpp): in the mean over all turns every
/// memory is at rest, so that none are joined. @pre there is a ring
SteadySurface ring_alone(const ContactModel& model);

/// Thickness of all layers under and on the body [m]; infinite over a half-space.
double total_thickness(const ContactModel& model);

/// Thickness of those that are not infinite [m].
double finite_thickness(const ContactModel& model);

/// Whether a rigid base lies below all layers, and not a half-space.
bool has_rigid_base(const ContactModel& model);

/// Distance of the nearest face below the surface or inside the body [m]; infinite where both are half-spaces.
double nearest_interface(const ContactModel& model);

/// Normal compliance that short waves see, of the half-spaces of the two materials next to the contact, as the spectrum
/// of creep in shear of the incompressible half-space that yields as much: sum of 2 (1 - nu)/G*. Without inertia.
CreepSpectrum near_spectrum(const ContactModel& model, const MemoryRange& told_apart = {});

/// What a coating is taken as, in words: a ring, or flat and why; empty without one.
std::string coating_in_words(const ContactModel& model);

/// What bounds the surface, top and bottom, in words: "2 bonded layers on a rigid base, coated rigid body".
std::string surface_in_words(const ContactModel& model);

}  // namespace rollres
