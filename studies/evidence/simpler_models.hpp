#pragma once

/// What each part of a scene's model is worth: the answers of models that leave it out, and of closed forms.

#include "core/solve/rolling_contact.hpp"

namespace rollres {

struct SimplerModel {
  std::string name;           ///< in words: "without friction"
  double rolling_resistance;  ///< [N/m] or [N]; NaN if that model has no answer
  double error_estimate;      ///< of that; 0 for a closed form [1]
  double seconds;             ///< of its solution; 0 for a closed form
};

/// Those that make sense for the scene: small strains beside finite ones, without friction, without inertia or with it,
/// a half-space of the first layer, the first layer on a rigid base, without coating; the limits of slow and fast
/// rolling and Hunter's half-space (reference_solutions.hpp, reference_hunter.hpp), which are without friction.
/// @param solution the scene's own, converged   @param evaluate solves a scene
std::vector<SimplerModel> simpler_models(const RollingScene& scene, const RollingSolution& solution,
                                         const Evaluate& evaluate);

/// As a table for people: each with its distance from the solution, and whether that is within the scene's tolerance.
std::string simpler_models_text(const RollingScene& scene, const RollingSolution& solution,
                                const std::vector<SimplerModel>& models);

}  // namespace rollres
