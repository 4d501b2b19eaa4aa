#pragma once

/// Which inputs of a scene do nothing in it, so that whoever prints it may leave them out: those of other materials, of
/// a softening that is not asked for, of another method.

#include "core/scene/scene.hpp"

namespace rollres {

/// Whether an input, by its key, counts for nothing in the answer of this scene. Keys of further layers are told by
/// their layer's material.
bool is_idle(const RollingScene& scene, std::string_view key);

}  // namespace rollres
