#include "studies/run/shared_recall.hpp"

#include <utility>

#include "studies/run/evaluate.hpp"

namespace rollres {

SharedRecall::SharedRecall(const std::filesystem::path& database, Evaluate evaluate)
    : evaluate_(std::move(evaluate)), writing_(database), reading_(database, Access::read) {
  writer_ = std::make_unique<ResultWriter>(
      writing_, std::chrono::milliseconds(50), [] {},
      [this](std::exception_ptr error) {
        const std::lock_guard lock(mutex_);
        store_error_ = std::move(error);
      });
}

SharedRecall::~SharedRecall() = default;

RollingSolution SharedRecall::operator()(const RollingScene& scene) {
  const std::string key = evaluation_key(scene);
  {
    std::unique_lock lock(mutex_);
    if (store_error_) std::rethrow_exception(store_error_);
    const auto [place, fresh] = answers_.try_emplace(key);
    if (!fresh) {
      answered_.wait(lock, [&] { return answers_.find(key) == answers_.end() || answers_.at(key).solution; });
      if (const auto known = answers_.find(key); known != answers_.end()) return *known->second.solution;
    }
  }
  std::optional<RollingSolution> stored;
  try {
    const std::lock_guard lock(reading_mutex_);
    stored = reading_.solution(key);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    answers_.erase(key);
    answered_.notify_all();
    throw;
  }
  const RollingSolution solution = stored ? *stored : evaluate_safely(evaluate_, scene);
  if (!stored) writer_->add({key, scene, solution});
  const std::lock_guard lock(mutex_);
  ++(stored ? recalled_ : solved_);
  answers_[key].solution = solution;
  answered_.notify_all();
  return solution;
}

void SharedRecall::finish() {
  writer_.reset();
  const std::lock_guard lock(mutex_);
  if (store_error_) std::rethrow_exception(store_error_);
}

std::size_t SharedRecall::solved() const {
  const std::lock_guard lock(mutex_);
  return solved_;
}

std::size_t SharedRecall::recalled() const {
  const std::lock_guard lock(mutex_);
  return recalled_;
}

}  // namespace rollres
