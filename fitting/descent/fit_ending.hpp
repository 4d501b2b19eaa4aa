#pragma once

/// When a fit ends before its least misfit: at a wish from outside, after so many solutions, after so much time.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <limits>
#include <mutex>
#include <string>

namespace rollres {

struct FitLimits {
  std::size_t solutions = std::numeric_limits<std::size_t>::max();  ///< predictions of single values
  double seconds = std::numeric_limits<double>::infinity();         ///< of wall time
};

/// Asked before every solution, by several threads at once. Once over, a fit stays so.
class FitEnding {
 public:
  /// @param stop  set from outside: a wish to end, or null
  void begin(const std::atomic<bool>* stop, const FitLimits& limits) {
    const std::lock_guard lock(mutex_);
    stop_ = stop;
    limits_ = limits;
    begin_ = std::chrono::steady_clock::now();
    solutions_ = 0;
    over_ = false;
    why_.clear();
  }

  /// Whether the fit is over.
  bool reached() {
    if (over_) return true;
    const std::lock_guard lock(mutex_);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    if (stop_ && stop_->load())
      why_ = "interrupted";
    else if (solutions_ >= limits_.solutions)
      why_ = "solutions_limit = " + std::to_string(limits_.solutions) + " is reached";
    else if (seconds > limits_.seconds)
      why_ = "the time_limit is reached";
    else
      return false;
    over_ = true;
    return true;
  }

  void count_solution() { ++solutions_; }
  /// Since the fit began.
  std::size_t solutions() const { return solutions_; }

  /// For descents and threads that only look.
  const std::atomic<bool>& over() const { return over_; }

  std::string why() const {
    const std::lock_guard lock(mutex_);
    return why_;
  }

 private:
  mutable std::mutex mutex_;
  const std::atomic<bool>* stop_ = nullptr;
  FitLimits limits_;
  std::chrono::steady_clock::time_point begin_;
  std::atomic<std::size_t> solutions_ = 0;
  std::atomic<bool> over_ = false;
  std::string why_;
};

}  // namespace rollres
