#pragma once

/// Solving through the store by several threads, and perhaps several processes, with an account of what was asked for.

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "core/numerics/solution_limits.hpp"
#include "core/solve/rolling_contact.hpp"
#include "db/rows/result_store.hpp"
#include "studies/run/result_writer.hpp"
#include "studies/run/retry.hpp"
#include "studies/stored/study_redefinition.hpp"

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

/// How a study is started whose name stands in the database already.
struct StudyStart {
  bool replace = false;                                     ///< a definition that differs
  std::function<void(const Redefinition&)> redefined = {};  ///< called before that happens
};

/// Recalls a scene's stored answer, or solves and saves it, without its fields. A repeated question is answered from
/// memory; threads that ask the same at the same time wait for one solution of it, so that a second run recalls exactly
/// what the first one saw. A thread of its own stores answers as they come, those that come faster than twenty times a
/// second in groups.
class StoredEvaluations {
 public:
  /// Evaluates without a store. @param stop set from outside: throws Interrupted in place of the next solution
  explicit StoredEvaluations(Evaluate evaluate, const std::atomic<bool>* stop = nullptr);
  /// @param retry  stored answers that are solved again whenever they are asked for
  StoredEvaluations(Evaluate evaluate, const std::filesystem::path& database, Retry retry = Retry::nothing);
  /// Makes every scene a point of the study, too. Starts it; it keeps its points if it was defined by the same text
  /// before. If it was defined otherwise, it is defined anew where that is asked for.
  /// @throws std::invalid_argument saying what changed and what to do, where it is not (start_again)
  StoredEvaluations(Evaluate evaluate, const std::filesystem::path& database, const StudyRecord& study,
                    const std::atomic<bool>* stop = nullptr, const StudyStart& start = {});

  /// Stores what is left; where that fails, it is lost: call `flush` before.
  ~StoredEvaluations();

  /// An exception of `evaluate` becomes an answer that is not converged.
  /// @throws std::runtime_error if the store failed
  RollingSolution operator()(const RollingScene& scene);

  /// From here on new points of the study are of this variant; of none if it is empty.
  void be_of_variant(const std::string& variant);

  /// Waits until everything is stored. @throws std::runtime_error if the store failed, or has lost the study
  void flush();

  /// Forgets the answers that it has: a question asked again is looked for in the store. After `flush`, it loses none.
  void forget();

  EvaluationCount count() const;

 private:
  struct Store;

  std::optional<RollingSolution> recalled(const std::string& key);

  Evaluate evaluate_;
  Retry retry_ = Retry::nothing;
  const std::atomic<bool>* stop_ = nullptr;
  mutable std::mutex mutex_;
  std::condition_variable answered_;
  std::unordered_map<std::string, std::optional<RollingSolution>> answers_;  // empty while a thread looks for it
  EvaluationCount count_;
  std::unique_ptr<Store> store_;
};

/// Answers through the store until an end is wanted.
/// @param stop  throws Interrupted in place of the next answer, and in the midst of a solution
Evaluate until_stopped(StoredEvaluations& stored, const std::atomic<bool>& stop);

}  // namespace rollres
