#pragma once

/// What friction can give at most, with continuous edges: the whole contact sliding one way.

#include <optional>

#include "core/spectral/spectral_system.hpp"

namespace rollres {

/// The friction coefficient at which sliding just gives the traction that the scene's drive asks for, if the scene's
/// own does not suffice; absent if it does, or if that could not be found out.
/// @param contact edges to start from
std::optional<double> friction_needed(const SpectralProblem& problem, const Interval& contact);

}  // namespace rollres
