#pragma once

/// Layers that the heat of rolling warms: the scene at the temperature that its own loss makes.
///
/// A solution at one temperature of the warmed layers has a loss with depth (heat/loss_with_depth.hpp), and that a
/// temperature with depth (heat/temperature_profile.hpp), whose mean by the loss is to be the one assumed: all such
/// temperatures are looked for (heat/steady_temperatures.hpp), with the loss under Hertz's pressure as the estimate.
/// One linear material stands for each layer, at this one temperature; all have the same conductivity. The answer is
/// that of the lowest state, which warming from cold reaches. Materials without a law of shift need one solution.

#include <functional>

#include "core/heat/loss_with_depth.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// What an answer loses with depth, and how warm that makes the layers; per metre of a cylinder's length.
struct WarmedDepth {
  HeatPath path;
  LossWithDepth lost;
  TemperatureProfile profile;
};
/// @param scene obeys `check`, with heat   @param solved with what its answer decided   @param solution per metre
WarmedDepth warmed_depth(const RollingScene& scene, const ContactModel& solved, const RollingSolution& solution);

/// @param scene obeys `check`, with heat
/// @param solve_isothermal  of a scene without heat, per metre of a cylinder's length
/// @return per metre; no_steady_state where at any temperature more is lost than leaves; what `solve_isothermal` found
/// where that has no answer
RollingSolution solve_with_heat(const RollingScene& scene,
                                const std::function<RollingSolution(const RollingScene&)>& solve_isothermal);

}  // namespace rollres
