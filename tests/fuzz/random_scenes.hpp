#pragma once

/// Random scenes over twelve decades, and what an answer to one must hold.

#include <cstdint>
#include <map>
#include <string>

#include "core/solve/rolling_contact.hpp"

namespace rollres {

/// A scene that `check` accepts, a function of its seed alone. Every input of `visit_inputs` is changed in some scenes:
/// a number to one within six decades of what an ordinary scene has (in a third of the scenes within a factor of 6),
/// seldom to an end of its range, a choice to any name, an optional input comes or goes, and there are further layers
/// above and below. A quarter of the scenes have materials with memories over up to 16 decades
/// (studies/evidence/random_material.hpp). Where a rule is broken, one of the inputs that its message names is changed
/// again.
RollingScene random_scene(std::uint64_t seed);

/// Of each input, and each name of each choice, whether the scene, or how many of its further layers, have it otherwise
/// than an ordinary one; limits left out.
std::map<std::string, int> drawn_inputs(const RollingScene& scene);

/// What an answer claims without right; empty if nothing.
std::string what_is_wrong(const RollingScene& scene, const RollingSolution& solution);

}  // namespace rollres
