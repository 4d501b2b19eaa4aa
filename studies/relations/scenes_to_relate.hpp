#pragma once

/// The random scenes that relations are tried on: those of stability_scene.hpp with what these leave out.

#include "core/scene/scene.hpp"
#include "studies/evidence/dice.hpp"

namespace rollres {

/// The scene with a method, load or approach, inertia and kinematics by lot; some turned, profiled or with bounded
/// shear; some with layers that soften with the strain or warm themselves, or at strains that are not small; some a
/// given pressure in place of a body. It may break a rule.
RollingScene scene_to_relate(Dice& dice, RollingScene scene);

/// Of a cylinder's layers: the contact's sagitta over their thickness, or over the half-width where that is less [1].
double strain_estimate(const RollingScene& scene);

/// Without friction nothing else but the load acts on the body.
void leave_friction_out(RollingScene& scene);

/// Layers as warm as the air, and as stiff as at small strains: where the other scene's layers lose or are strained by
/// other amounts.
void leave_heat_out(RollingScene& scene);
void leave_softening_out(RollingScene& scene);

}  // namespace rollres
