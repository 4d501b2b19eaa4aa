#pragma once

/// How many scenes a fit evaluated, and which had no answer. May be written by several threads at once.

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

namespace rollres {

class EvaluationLog {
 public:
  struct Failure {
    std::string reason;
    std::string first_place;  ///< the measurement, "data.csv, line 7"
    std::size_t count = 0;
  };

  void answered() {
    const std::lock_guard lock(mutex_);
    ++evaluations_;
  }
  void failed(const std::string& place, const std::string& reason) {
    const std::lock_guard lock(mutex_);
    ++evaluations_;
    ++failures_;
    for (Failure& known : reasons_)
      if (known.reason == reason) {
        ++known.count;
        return;
      }
    if (reasons_.size() < most_reasons) reasons_.push_back({reason, place, 1});
  }

  std::size_t evaluations() const { return locked(evaluations_); }
  std::size_t failures() const { return locked(failures_); }
  std::vector<Failure> reasons() const { return locked(reasons_); }  ///< the first few that differ

 private:
  static constexpr std::size_t most_reasons = 8;

  template <class Value>
  Value locked(const Value& value) const {
    const std::lock_guard lock(mutex_);
    return value;
  }

  mutable std::mutex mutex_;
  std::size_t evaluations_ = 0, failures_ = 0;
  std::vector<Failure> reasons_;
};

}  // namespace rollres
