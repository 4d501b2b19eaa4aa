#pragma once

/// Random scenes over twelve decades, and what an answer to one must hold.

#include <cstdint>
#include <string>

#include "core/solve/rolling_contact.hpp"

namespace rollres {

/// A scene that `check` accepts, a function of its seed alone. Every input of `visit_inputs` is changed in some scenes:
/// a number to one within six decades of what an ordinary scene has, seldom to an end of its range, a choice to any
/// name, an optional input comes or goes, and there are up to two further layers above and below.
RollingScene random_scene(std::uint64_t seed);

/// What an answer claims without right; empty if nothing.
std::string what_is_wrong(const RollingScene& scene, const RollingSolution& solution);

}  // namespace rollres
