#pragma once

/// One scene solved by one method, and what became of it. What the method says of itself is not believed.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/solve/rolling_contact.hpp"
#include "db/queries/table.hpp"

namespace rollres {

/// How a method fared with a scene.
enum class Outcome {
  converged,      ///< with every law of contact held: law_violation < 1e-8
  refused,        ///< no_steady_state, and indeed: it converges with 2 % more friction than it says it needs, and does
                  ///< not with 2 % less; or the other way round where it says that the body digs itself in
  unconfirmed,    ///< no_steady_state, but that is not so, or it does not say how much friction it needs or bears
  not_converged,  ///< no answer, and it says so; or none within the time limit
  wrong,          ///< says converged, but a law of contact is violated or a number of the answer is not finite
  crashed         ///< threw an exception, or ended its process
};
template <>
struct ChoiceNames<Outcome> {
  static constexpr std::array<std::string_view, 6> names{"converged",     "refused", "unconfirmed",
                                                         "not_converged", "wrong",   "crashed"};
};

/// Whether the outcome is one to look into.
inline bool is_failure(Outcome outcome) { return outcome != Outcome::converged && outcome != Outcome::refused; }

/// The numbers of a trial; NaN where there is none.
struct TrialNumbers {
  Outcome outcome = Outcome::crashed;
  double seconds = RollingSolution::absent;  ///< of the solution, without its confirmation [s]
  double law_violation = RollingSolution::absent;
  double energy_residual = RollingSolution::absent;
  double friction_needed = RollingSolution::absent;
  double rolling_resistance = RollingSolution::absent;
  int contact_nodes = 0, slip_nodes = 0, iterations = 0;
};

/// One scene solved by one method.
struct Trial {
  std::size_t number = 0;  ///< of the scene among those of its indenter
  RollingScene scene;      ///< with the method
  TrialNumbers numbers;
  std::string reason;  ///< the method's own, or what is wrong with its answer
};

/// Solves a scene, and where it is refused also with more and with less friction. Never throws.
Trial judge(const Evaluate& evaluate, const RollingScene& scene, std::size_t number = 0) noexcept;

/// Every input of each trial under its key, the outcome, and the numbers.
Table trials_table(const std::vector<Trial>& trials);

/// A scene file that solves the trial's scene again, with its outcome as a comment.
std::string failed_scene_json(const Trial& trial);

/// The name of that file: "newton-cylinder-17.json".
std::string failed_scene_name(const Trial& trial);

}  // namespace rollres
