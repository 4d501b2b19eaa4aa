#include "studies/run/stored_evaluations.hpp"

#include <unordered_set>
#include <utility>

#include "studies/run/evaluate.hpp"

namespace rollres {

/// Where answers are kept: one thread writes, the others read, each through a connection of its own.
struct StoredEvaluations::Store {
  explicit Store(const std::filesystem::path& database) : writing(database), reading(database, Access::read) {}

  void start(const StudyRecord& record, const StudyStart& how) {
    const std::optional<Redefinition> redefined = start_again(writing, record, {}, how.replace);
    if (redefined && how.redefined) how.redefined(*redefined);
    study = record.name;
    std::vector<std::string> known, known_variants;
    if (writing.definition(study) == record.definition) {
      known = writing.points(study);
      known_variants = writing.variants(study);
    }
    started = writing.start_study(record, known, known_variants);
    points.insert(known.begin(), known.end());
  }

  void add_point(const std::string& key) {
    const std::lock_guard lock(mutex);
    if (study.empty() || !points.insert(key).second) return;
    new_points.push_back(key);
    new_variants.push_back(variant);
  }

  void add_new_points() {
    std::vector<std::string> keys, variants;
    {
      const std::lock_guard lock(mutex);
      keys.swap(new_points);
      variants.swap(new_variants);
    }
    if (!keys.empty()) writing.add_points(study, keys, variants);
  }

  void save(const std::vector<Evaluation>& answers) {
    const std::lock_guard lock(writing_mutex);
    if (!answers.empty()) writing.save(answers, existing);
    add_new_points();
  }

  void flush() {
    writer.flush();
    save({});  // points that were recalled, behind the last that was solved
    if (study.empty()) return;
    const std::lock_guard lock(writing_mutex);
    writing.require_study(started, study, std::vector<std::string>(points.begin(), points.end()));
  }

  ResultStore writing, reading;
  Existing existing = Existing::kept;
  std::mutex writing_mutex, mutex;  // of `writing`; of `reading` and all below
  std::int64_t started = 0;
  std::string study, variant;                         // variant: of new points
  std::unordered_set<std::string> points;             // of the study
  std::vector<std::string> new_points, new_variants;  // to become such
  ResultWriter writer{[this](const std::vector<Evaluation>& answers) { save(answers); }};
};

StoredEvaluations::StoredEvaluations(Evaluate evaluate, const std::atomic<bool>* stop)
    : evaluate_(std::move(evaluate)), stop_(stop) {}

StoredEvaluations::StoredEvaluations(Evaluate evaluate, const std::filesystem::path& database, Retry retry)
    : evaluate_(std::move(evaluate)), retry_(retry), store_(std::make_unique<Store>(database)) {
  if (retry != Retry::nothing) store_->existing = Existing::replaced;
}

StoredEvaluations::StoredEvaluations(Evaluate evaluate, const std::filesystem::path& database, const StudyRecord& study,
                                     const std::atomic<bool>* stop, const StudyStart& start)
    : evaluate_(std::move(evaluate)), stop_(stop), store_(std::make_unique<Store>(database)) {
  store_->start(study, start);
}

StoredEvaluations::~StoredEvaluations() {
  try {
    flush();
  } catch (...) {  // a destructor that ends the program would lose more
  }
}

std::optional<RollingSolution> StoredEvaluations::recalled(const std::string& key) {
  if (!store_ || retry_ == Retry::all) return std::nullopt;
  const std::lock_guard lock(store_->mutex);
  std::optional<RollingSolution> answer = store_->reading.solution(key);
  if (answer && is_retried(retry_, answer->status)) answer.reset();
  return answer;
}

RollingSolution StoredEvaluations::operator()(const RollingScene& scene) {
  const std::string key = evaluation_key(scene);
  std::unique_lock lock(mutex_);
  for (;;) {
    const auto [place, fresh] = answers_.try_emplace(key);
    if (fresh) break;
    if (place->second) return *place->second;
    answered_.wait(lock);
  }
  lock.unlock();
  std::optional<RollingSolution> answer;
  bool known = false;
  try {
    answer = recalled(key);
    known = answer.has_value();
    if (!known && stop_ && stop_->load()) throw Interrupted();
    if (!known) answer = evaluate_safely(evaluate_, scene);
    if (store_) store_->add_point(key);
    if (store_ && !known) store_->writer.add({key, scene, *answer});
  } catch (...) {
    lock.lock();
    answers_.erase(key);
    answered_.notify_all();
    throw;
  }
  lock.lock();
  ++(known ? count_.recalled : count_.solved);
  if (answer->status != Status::converged) ++count_.failed;
  answers_[key] = answer;
  answered_.notify_all();
  return *answer;
}

void StoredEvaluations::be_of_variant(const std::string& variant) {
  if (!store_) return;
  const std::lock_guard lock(store_->mutex);
  store_->variant = variant;
}

void StoredEvaluations::flush() {
  if (store_) store_->flush();
}

void StoredEvaluations::forget() {
  const std::lock_guard lock(mutex_);
  std::erase_if(answers_, [](const auto& one) { return one.second.has_value(); });
}

EvaluationCount StoredEvaluations::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

Evaluate until_stopped(StoredEvaluations& stored, const std::atomic<bool>& stop) {
  return [&](const RollingScene& scene) {
    if (stop) throw Interrupted();
    const Interruptible interruptible([&] { return stop.load(); });
    return stored(scene);
  };
}

}  // namespace rollres
