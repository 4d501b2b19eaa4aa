#pragma once

/// One scene of many. Every scene is solved from nothing, not from a neighbour's answer, although that takes a fifth
/// less time on a sphere's grid: its answer is then the same to the last bit whatever was solved before it, by how many
/// threads, processes and machines, and after how many interruptions.

#include "core/solve/rolling_contact.hpp"

namespace rollres {

enum class Fields { dropped, kept };

/// `evaluate(scene)`, without its fields unless they are asked for. An exception becomes an answer with status
/// not_converged and its message as the reason, so that one bad point never ends a study.
/// @throws Interrupted if somebody wished to stop: that is no answer
RollingSolution evaluate_safely(const Evaluate& evaluate, const RollingScene& scene, Fields fields = Fields::dropped);

}  // namespace rollres
