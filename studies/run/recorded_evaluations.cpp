#include "studies/run/recorded_evaluations.hpp"

#include <optional>
#include <utility>

#include "studies/run/evaluate.hpp"

namespace rollres {

namespace {

constexpr std::chrono::milliseconds grouping{50};  // least time between two transactions

}  // namespace

RecordedEvaluations::RecordedEvaluations(Evaluate evaluate, const std::atomic<bool>* stop)
    : evaluate_(std::move(evaluate)), stop_(stop) {}

RecordedEvaluations::RecordedEvaluations(Evaluate evaluate, ResultStore& store, const StudyRecord& study,
                                         const std::atomic<bool>* stop)
    : evaluate_(std::move(evaluate)), store_(&store), study_(study.name), stop_(stop) {
  std::vector<std::string> points;
  if (store.definition(study.name) == study.definition) points = store.points(study.name);
  store.start_study(study, points);
  points_.insert(points.begin(), points.end());
}

RollingSolution RecordedEvaluations::operator()(const RollingScene& scene) {
  const std::string key = evaluation_key(scene);
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = answers_.find(key); known != answers_.end()) return known->second;
  }
  bool recalled = false;
  RollingSolution solution = answer_to(key, scene, recalled);
  const std::lock_guard lock(mutex_);
  if (answers_.emplace(key, solution).second) {
    ++(recalled ? count_.recalled : count_.solved);
    if (solution.status != Status::converged) ++count_.failed;
  }
  return solution;
}

RollingSolution RecordedEvaluations::answer_to(const std::string& key, const RollingScene& scene, bool& recalled) {
  std::optional<RollingSolution> answer;
  if (store_) {
    const std::lock_guard lock(mutex_);
    answer = store_->solution(key);
  }
  recalled = answer.has_value();
  if (!answer) {
    if (stop_ && stop_->load()) throw Interrupted();
    answer = evaluate_safely(evaluate_, scene);
  }
  if (store_) {
    const std::lock_guard lock(mutex_);
    if (!recalled) waiting_.push_back({key, scene, *answer});
    if (points_.insert(key).second) new_points_.push_back(key);
    if (std::chrono::steady_clock::now() - stored_ > grouping) store_waiting();
  }
  return std::move(*answer);
}

void RecordedEvaluations::store_waiting() {
  if (!waiting_.empty()) store_->save(waiting_);
  waiting_.clear();
  if (!new_points_.empty()) store_->add_points(study_, new_points_);
  new_points_.clear();
  stored_ = std::chrono::steady_clock::now();
}

void RecordedEvaluations::flush() {
  const std::lock_guard lock(mutex_);
  if (store_) store_waiting();
}

RecordedEvaluations::~RecordedEvaluations() {
  try {
    flush();
  } catch (...) {  // a destructor that ends the program would lose more
  }
}

EvaluationCount RecordedEvaluations::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

}  // namespace rollres
