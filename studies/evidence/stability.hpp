#pragma once

/// Which method fails where: every method solves the same random scenes (stability_scene.hpp), and what it says is not
/// believed. Each scene is solved in a child process, so that one that crashes costs itself alone.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/solve/rolling_contact.hpp"
#include "studies/evidence/stability_trial.hpp"
#include "studies/run/progress.hpp"

namespace rollres {

struct StabilityPlan {
  std::size_t cylinders = 0, spheres = 0;  ///< number of scenes
  std::uint64_t seed = 1;
  std::vector<Method> methods;
  int jobs = 0;                                           ///< child processes; 0: one for each core
  double time_limit = 600;                                ///< for one scene [s]
  const std::atomic<bool>* stop = nullptr;                ///< set from outside: return what there is
  std::function<void(const Trial&)> on_trial = {};        ///< called as each comes
  std::function<void(const SweepProgress&)> report = {};  ///< called ten times a second
};

struct StabilityReport {
  std::vector<Trial> trials;  ///< by indenter, number and method
  bool interrupted = false;
  double seconds = 0;
};

/// @throws std::runtime_error if no child process can be started
StabilityReport run_stability(const StabilityPlan& plan, const Evaluate& evaluate);

/// What became of the scenes of one method and one indenter.
struct StabilityCount {
  Method method;
  Indenter indenter;
  std::array<std::size_t, ChoiceNames<Outcome>::names.size()> of{};
  double median_seconds = 0, seconds_95 = 0, longest_seconds = 0;  ///< of trials that did not crash

  std::size_t operator[](Outcome outcome) const { return of[static_cast<std::size_t>(outcome)]; }
  std::size_t trials() const;
};

/// One for each method and indenter that was tried.
std::vector<StabilityCount> counts(const std::vector<Trial>& trials);

}  // namespace rollres
