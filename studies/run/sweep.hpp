#pragma once

/// Runs all points of a study. Threads solve; one more thread stores each answer as it comes.
///
/// What the store has is not solved again, so a study that was stopped, even by `kill -9`, is finished by starting it
/// again, and several processes may work on one study in one database. Answers that come faster than twenty times a
/// second are stored in groups: no more than about 0.1 s of them can be lost.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>

#include "core/solve/rolling_contact.hpp"
#include "db/rows/result_store.hpp"
#include "studies/run/evaluate.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/retry.hpp"
#include "studies/stored/study_redefinition.hpp"
#include "studies/study/shards.hpp"
#include "studies/study/study.hpp"

namespace rollres {

struct SweepOptions {
  int jobs = 0;                                           ///< threads that solve; 0: one for each core
  const std::atomic<bool>* stop = nullptr;                ///< set from outside: finish the points in work, then return
  std::function<void(const SweepProgress&)> report = {};  ///< called ten times a second by the calling thread
  std::function<void()> ready = {};                       ///< called once, when only solving is left to do
  std::chrono::milliseconds grouping{50};                 ///< least time between two transactions
  Shard shard = {};                                       ///< solve this part; the study is recorded whole
  Retry retry = Retry::nothing;
  bool replace = false;  ///< the definition of a study of the same name whose points would leave it
  std::function<void(const Redefinition&)> redefined = {};  ///< called before that happens
  Fields fields = Fields::dropped;  ///< kept: stored too; a point that converged without them is solved again
};

struct SweepReport {
  StudySummary study;        ///< as it is stored now
  std::size_t dropped = 0;   ///< combinations that constraints leave out of the study
  std::size_t points = 0;    ///< of the shard; all, if there is one shard
  std::size_t answered = 0;  ///< of these, now; failed ones included
  std::size_t failed = 0;
  std::size_t recalled = 0;  ///< points of the shard whose answer was there at the start and was good enough
  std::size_t solved = 0;    ///< evaluations solved by this process
  bool interrupted = false;  ///< stopped before all points were answered
  double seconds = 0;
};

/// @param evaluate  called by several threads at once; an exception of it becomes the reason of a failed point
/// @throws std::invalid_argument naming the point and the rule, or a study of this name that is defined otherwise,
/// before any point is solved
/// @throws std::runtime_error if the database fails; what was stored before stays
SweepReport run_sweep(const Study& study, const Evaluate& evaluate, const std::filesystem::path& database,
                      const SweepOptions& options = {});

}  // namespace rollres
