#pragma once

/// The one thread that writes: takes answers from the threads that solve and stores each group in one transaction.

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "db/rows/result_store.hpp"

namespace rollres {

class ResultWriter {
 public:
  /// Stores answers as soon as they come, but leaves at least `grouping` between two transactions.
  /// @param met_another  called when an answer was stored by another process meanwhile
  /// @param failed       called once if the store fails; nothing is stored afterwards
  /// @param existing     what becomes of answers that are stored already
  ResultWriter(ResultStore& store, std::chrono::milliseconds grouping, std::function<void()> met_another,
               std::function<void(std::exception_ptr)> failed, Existing existing = Existing::kept);
  /// Stores what is left.
  ~ResultWriter();

  void add(Evaluation evaluation);

 private:
  void run();

  ResultStore& store_;
  std::chrono::milliseconds grouping_;
  std::function<void()> met_another_;
  std::function<void(std::exception_ptr)> failed_;
  Existing existing_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Evaluation> waiting_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace rollres
