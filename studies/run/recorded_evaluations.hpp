#pragma once

/// Solving through the store by several threads, with an account of what was asked for.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <vector>

#include "core/solve/rolling_contact.hpp"
#include "db/rows/result_store.hpp"

namespace rollres {

/// Scenes that were asked for, each counted once however often it was.
struct EvaluationCount {
  std::size_t solved = 0;    ///< anew
  std::size_t recalled = 0;  ///< from the store
  std::size_t failed = 0;    ///< of both: without a converged answer

  std::size_t all() const { return solved + recalled; }
  EvaluationCount operator-(const EvaluationCount& earlier) const {
    return {solved - earlier.solved, recalled - earlier.recalled, failed - earlier.failed};
  }
};

/// Thrown out of an evaluation by the wish to stop.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Recalls a scene's stored answer, or solves and saves it, and makes it a point of the study. A repeated question is
/// answered from memory. Answers that come faster than twenty times a second are stored in groups: no more than about
/// 0.1 s of them can be lost. May be called by several threads at once.
class RecordedEvaluations {
 public:
  /// Evaluates without a store. @param stop set from outside: throws Interrupted in place of the next solution
  explicit RecordedEvaluations(Evaluate evaluate, const std::atomic<bool>* stop = nullptr);
  /// Starts the study; it keeps its points if it was defined by the same text before.
  /// @throws std::runtime_error if the store fails, here and in every evaluation
  RecordedEvaluations(Evaluate evaluate, ResultStore& store, const StudyRecord& study,
                      const std::atomic<bool>* stop = nullptr);

  RecordedEvaluations(const RecordedEvaluations&) = delete;
  RecordedEvaluations& operator=(const RecordedEvaluations&) = delete;
  /// Stores what is left; where that fails, it is lost: call `flush` before.
  ~RecordedEvaluations();

  RollingSolution operator()(const RollingScene& scene);

  /// Stores what is left.
  void flush();

  EvaluationCount count() const;

 private:
  RollingSolution answer_to(const std::string& key, const RollingScene& scene, bool& recalled);
  void store_waiting();

  Evaluate evaluate_;
  ResultStore* store_ = nullptr;
  std::string study_ = {};
  const std::atomic<bool>* stop_;
  mutable std::mutex mutex_;
  std::unordered_set<std::string> points_;            // of the study
  std::map<std::string, RollingSolution> answers_{};  // in this run
  std::vector<Evaluation> waiting_;                   // to be saved
  std::vector<std::string> new_points_;               // to become points
  std::chrono::steady_clock::time_point stored_{};    // when something last was
  EvaluationCount count_;
};

}  // namespace rollres
