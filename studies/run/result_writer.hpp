#pragma once

/// The one thread that writes: takes answers from the threads that solve, and stores them in groups.

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
  using Save = std::function<void(const std::vector<Evaluation>&)>;

  /// Stores answers as soon as they come, but leaves at least `grouping` between two transactions.
  /// @param save  stores a group in one transaction; if it throws, nothing is stored afterwards
  explicit ResultWriter(Save save, std::chrono::milliseconds grouping = std::chrono::milliseconds(50));
  /// Stores what is left.
  ~ResultWriter();

  /// @throws what `save` threw, here and below
  void add(Evaluation evaluation);
  /// Waits until all that was added is stored.
  void flush();

 private:
  void run();

  Save save_;
  std::chrono::milliseconds grouping_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Evaluation> waiting_;
  std::exception_ptr failure_;
  bool saving_ = false, hurried_ = false, ending_ = false;
  std::thread thread_;
};

}  // namespace rollres
