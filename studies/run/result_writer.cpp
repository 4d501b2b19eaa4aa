#include "studies/run/result_writer.hpp"

#include <utility>

namespace rollres {

ResultWriter::ResultWriter(ResultStore& store, std::chrono::milliseconds grouping, std::function<void()> met_another,
                           std::function<void(std::exception_ptr)> failed, Existing existing)
    : store_(store),
      grouping_(grouping),
      met_another_(std::move(met_another)),
      failed_(std::move(failed)),
      existing_(existing),
      thread_([this] { run(); }) {}

ResultWriter::~ResultWriter() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void ResultWriter::add(Evaluation evaluation) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(evaluation));
  }
  changed_.notify_one();
}

void ResultWriter::run() {
  try {
    auto earliest = std::chrono::steady_clock::now();
    for (;;) {
      std::vector<Evaluation> group;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
        changed_.wait_until(lock, earliest, [&] { return ending_; });
        if (waiting_.empty()) return;
        group.swap(waiting_);
      }
      earliest = std::chrono::steady_clock::now() + grouping_;
      if (store_.save(group, existing_) < group.size()) met_another_();
    }
  } catch (...) {
    failed_(std::current_exception());
  }
}

}  // namespace rollres
