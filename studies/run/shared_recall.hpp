#pragma once

/// Solving through the store from several threads: what was solved once, ever or just now, is recalled.

#include <condition_variable>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/solve/rolling_contact.hpp"
#include "db/rows/result_store.hpp"
#include "studies/run/result_writer.hpp"

namespace rollres {

/// Threads that want the same scene at the same time wait for one solution of it, so that a second run recalls exactly
/// what the first one saw. Answers are stored by a thread of their own, in groups.
class SharedRecall {
 public:
  /// @param evaluate called by several threads at once
  SharedRecall(const std::filesystem::path& database, Evaluate evaluate);
  /// Stores what is left.
  ~SharedRecall();

  /// The answer without its fields; an exception of `evaluate` becomes an answer that is not converged.
  /// @throws std::runtime_error if the store fails
  RollingSolution operator()(const RollingScene& scene);

  /// Waits until everything is stored. @throws std::runtime_error if the store failed
  void finish();

  std::size_t solved() const;
  std::size_t recalled() const;  ///< distinct scenes that the store had

 private:
  struct Answer {
    std::optional<RollingSolution> solution;  // empty while a thread looks for it
  };

  Evaluate evaluate_;
  ResultStore writing_, reading_;
  std::mutex reading_mutex_;
  mutable std::mutex mutex_;
  std::condition_variable answered_;
  std::map<std::string, Answer, std::less<>> answers_;
  std::size_t solved_ = 0, recalled_ = 0;
  std::exception_ptr store_error_;
  std::unique_ptr<ResultWriter> writer_;
};

}  // namespace rollres
