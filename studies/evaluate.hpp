#pragma once

/// Solving through the store: what was solved once is recalled.

#include "core/rolling_contact.hpp"
#include "db/result_store.hpp"

namespace rollres {

enum class Fields { dropped, kept };

/// `evaluate(scene)`, without its fields unless they are asked for. An exception becomes an answer with status
/// not_converged and its message as the reason, so that one bad point never ends a study.
RollingSolution evaluate_safely(const Evaluate& evaluate, const RollingScene& scene,
                                Fields fields = Fields::dropped) noexcept;

/// Solves with a RollingSolver of the calling thread's own, so that scenes much like the last one start from it.
RollingSolution solve_in_turn(const RollingScene& scene);

/// Recalls a scene's stored answer, or solves and saves it. The store must outlive the result, which is used by one
/// thread at a time; it throws std::runtime_error if the store fails.
Evaluate recalling(ResultStore& store, Evaluate evaluate);

}  // namespace rollres
