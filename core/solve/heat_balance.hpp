#pragma once

/// Layers that the heat of rolling warms: the scene at the temperature that its own loss makes.
///
/// A solution at one temperature of the warmed layers has a loss with depth (heat/loss_with_depth.hpp), and that a
/// temperature with depth (heat/temperature_profile.hpp), whose mean by the loss is to be the one assumed: all such
/// temperatures are looked for (heat/steady_temperatures.hpp), with the loss under Hertz's pressure as the estimate.
/// One linear material stands for each layer, at this one temperature; all have the same conductivity. The answer is
/// that of the lowest state, which warming from cold reaches. Materials without a law of shift need one solution.
///
/// With `thermal_sublayers` each warmed layer is cut into as many, each as warm as its middle. At a mean temperature
/// that is not steady they are as warm as the profile would be if the power lost were so many times as much that its
/// mean is that temperature: bounded by the surroundings and the mean, and the profile itself where it is steady. They
/// and the profile that they make are brought together by Anderson's mixing.

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
WarmedDepth warmed_depth(const RollingScene& scene, const ContactModel& solved, const RollingSolution& solution,
                         LossDetail detail = LossDetail::full);

/// @param scene obeys `check`, with heat
/// @param solve_isothermal  of its model at given temperatures, per metre of a cylinder's length
/// @return per metre; no_steady_state where at any temperature more is lost than leaves; what `solve_isothermal` found
/// where that has no answer
RollingSolution solve_with_heat(const RollingScene& scene,
                                const std::function<RollingSolution(const ContactModel&)>& solve_isothermal);

}  // namespace rollres
