#include "studies/run/result_writer.hpp"

#include <utility>

namespace rollres {

ResultWriter::ResultWriter(Save save, std::chrono::milliseconds grouping)
    : save_(std::move(save)), grouping_(grouping), thread_([this] { run(); }) {}

ResultWriter::~ResultWriter() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ResultWriter::add(Evaluation evaluation) {
  {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    waiting_.push_back(std::move(evaluation));
  }
  changed_.notify_all();
}

void ResultWriter::flush() {
  std::unique_lock lock(mutex_);
  hurried_ = true;
  changed_.notify_all();
  changed_.wait(lock, [&] { return failure_ || (waiting_.empty() && !saving_); });
  hurried_ = false;
  if (failure_) std::rethrow_exception(failure_);
}

void ResultWriter::run() {
  std::unique_lock lock(mutex_);
  auto earliest = std::chrono::steady_clock::now();
  while (!failure_) {
    changed_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
    changed_.wait_until(lock, earliest, [&] { return ending_ || hurried_; });
    if (waiting_.empty()) return;
    std::vector<Evaluation> group;
    group.swap(waiting_);
    saving_ = true;
    lock.unlock();
    earliest = std::chrono::steady_clock::now() + grouping_;
    std::exception_ptr failure;
    try {
      save_(group);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    failure_ = failure;
    saving_ = false;
    changed_.notify_all();
  }
}

}  // namespace rollres
