#pragma once

/// Where the search for edges and borders begins.

#include <optional>

#include "core/zones/spectral_search.hpp"

namespace rollres {

constexpr std::size_t most_sticks = 4;  ///< patterns with more of them are left to grids

struct PatternStart {
  SlipPattern pattern;
  SpectralEdges edges;
};

/// Coefficients that resolve a layer, for a first try (core/spectral/README.md, (S26)).
/// @param shear whether there is friction
int first_order(const SpectralProblem& problem, const SpectralEdges& edges, double tolerance, bool shear);

/// Half the width of the strip in which graded points' functions are analytic, over that without layers.
double free_strip(const SpectralProblem& problem, const Interval& contact);

/// Order of graded points from which the next one makes the resistance err by so much of load times half-width over
/// radius, as met with.
int graded_order(const SpectralProblem& problem, const Interval& contact, double accuracy);

/// The contact without friction, roughly. With long steps of the stiffening if need be.
std::optional<SpectralState> frictionless_start(const SpectralProblem& problem);

/// Stick up to the leading edge: the direction of the slip behind it and its border, for given edges of contact.
std::optional<PatternStart> one_border_start(const SpectralProblem& problem, const Interval& contact);

/// The zones that a grid of this spacing has; none if they are too many, or slip turns round without stick between.
std::optional<PatternStart> pattern_on_grid(const ContactModel& model, double spacing);

}  // namespace rollres
