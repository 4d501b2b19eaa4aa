#include "studies/run/sweep.hpp"

#include <algorithm>
#include <condition_variable>
#include <csignal>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/model/scene_rules.hpp"
#include "core/numerics/parallel.hpp"
#include "core/numerics/threads.hpp"
#include "db/rows/point_states.hpp"
#include "studies/run/ended_points.hpp"
#include "studies/run/result_writer.hpp"
#include "studies/run/shared_contacts.hpp"
#include "studies/run/work_list.hpp"
#include "studies/study/predicted_cost.hpp"

namespace rollres {

namespace {

/// What the threads of one sweep share.
struct Run {
  const std::atomic<bool>* stop_from_outside = nullptr;
  std::atomic<bool> broken = false;
  std::atomic<std::size_t> solved = 0, failed = 0;
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t started = 0, ended = 0;
  std::exception_ptr first_error;

  bool asked_to_stop() const { return stop_from_outside && stop_from_outside->load(); }

  void fail(std::exception_ptr error) {
    const std::lock_guard lock(mutex);
    if (!first_error) first_error = std::move(error);
    broken = true;
  }
};

bool is_wanted_again(const StoredAnswer& answer, const SweepOptions& options) {
  const bool converged = answer.status == Status::converged;
  return is_retried(options.retry, answer.status) ||
         (converged && options.fields == Fields::kept && !answer.has_fields);
}

/// Answers as they were at the start that are to be solved again, by their keys: any change is the new answer.
std::unordered_map<std::string, StoredAnswer> wanted_again(ResultStore& reader, const std::vector<std::string>& keys,
                                                           const SweepOptions& options) {
  std::unordered_map<std::string, StoredAnswer> old;
  if (options.retry == Retry::nothing && options.fields == Fields::dropped) return old;
  for (const std::string& key : keys)
    if (const auto answer = reader.find_answer(key); answer && is_wanted_again(*answer, options))
      old.emplace(key, *answer);
  return old;
}

/// The points that this process works on.
struct Part {
  std::vector<std::size_t> points;  ///< their places in the plan
  std::vector<std::string> keys;
};

/// Solves one point and hands its answer to `store`.
template <class Store>
void work_on(Run& run, std::size_t point, const StudyPlan& plan, const Part& part, const Evaluate& evaluate,
             Fields fields, const Store& store) {
  const PointInWork in_work(part.keys[point]);
  Evaluation answer{part.keys[point], plan.scene(part.points[point]), {}};
  answer.solution = evaluate_safely(evaluate, answer.scene, fields);
  if (answer.solution.status != Status::converged) ++run.failed;
  store(std::move(answer));
  ++run.solved;
}

void work(Run& run, WorkList& list, const StudyPlan& plan, const Part& part, const Evaluate& evaluate, Fields fields,
          ResultWriter& writer, int cores) {
  limit_threads(cores);
  try {
    while (!run.broken && !run.asked_to_stop()) {
      const std::optional<std::size_t> next = list.next();
      if (!next) break;
      work_on(run, *next, plan, part, evaluate, fields, [&](Evaluation&& answer) { writer.add(std::move(answer)); });
    }
  } catch (...) {
    run.fail(std::current_exception());
  }
  const std::lock_guard lock(run.mutex);
  ++run.ended;
  run.changed.notify_one();
}

/// Stores points at which an earlier start ended as failed, so that this one goes on to the others. Which point it was
/// that took the memory is not known when several were in work: each is tried once more. Returns those.
std::vector<std::string> store_ended_points(ResultStore& store, const std::filesystem::path& database,
                                            const std::vector<std::string>& keys, const StudyPlan& plan) {
  const std::vector<EndedPoint> ended = ended_points(database);
  std::vector<EndedPoint> kept;
  std::vector<std::string> again;
  for (const EndedPoint& point : ended) {
    const auto place = std::find(keys.begin(), keys.end(), point.key);
    const auto times = count_if(ended, [&](const auto& one) { return one.key == point.key; });
    const bool out_of_memory = point.signal == SIGKILL;
    if (place == keys.end() || (out_of_memory && times == 1)) kept.push_back(point);
    if (place == keys.end()) continue;
    if (out_of_memory && times == 1) {
      again.push_back(point.key);
      continue;
    }
    Evaluation answer{point.key, plan.scene(static_cast<std::size_t>(place - keys.begin())), {}};
    answer.solution.method = resolved_method(answer.scene);
    answer.solution.reason = "ended the program (signal " + std::to_string(point.signal) +
                             (out_of_memory ? ": the system had no memory left)" : ")");
    store.save({&answer, 1});
  }
  if (!ended.empty()) keep_ended_points(database, kept);
  return again;
}

/// The points of one shard.
Part part_of(const StudyPlan& plan, std::vector<std::string> keys, const Shard& shard) {
  Part part{std::vector<std::size_t>(keys.size()), std::move(keys)};
  std::iota(part.points.begin(), part.points.end(), std::size_t{0});
  if (shard.count == 1) return part;
  const std::vector<int> shards = shards_of_points(part.keys, predicted_seconds(plan), shard.count);
  std::size_t kept = 0;
  for (std::size_t point = 0; point < shards.size(); ++point) {
    if (shards[point] != shard.index) continue;
    part.points[kept] = point;
    std::swap(part.keys[kept++], part.keys[point]);
  }
  part.points.resize(kept);
  part.keys.resize(kept);
  return part;
}

std::size_t count(const std::vector<PointState>& states, Answer answer) {
  return static_cast<std::size_t>(count_if(states, [&](const PointState& state) { return state.answer == answer; }));
}

}  // namespace

SweepReport run_sweep(const Study& study, const Evaluate& solve_one, const std::filesystem::path& database,
                      const SweepOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };

  const StudyPlan plan(study);
  std::vector<std::string> all_keys = plan.keys();
  StudyRecord record{study.name, {}, study.definition};
  for (const Axis& axis : study.axes) record.axes.push_back(axis.key);

  ResultStore store(database), reader(database, Access::read);
  const std::optional<Redefinition> redefined = start_again(store, record, all_keys, options.replace);
  if (redefined && options.redefined) options.redefined(*redefined);
  const std::int64_t started = store.start_study(record, all_keys, plan.variants());
  const std::vector<std::string> again_alone = store_ended_points(store, database, all_keys, plan);
  const FatalSignalNotes notes(database);
  const Part part = part_of(plan, std::move(all_keys), options.shard);
  const std::vector<std::string>& keys = part.keys;
  const auto old = wanted_again(reader, keys, options);
  std::size_t missing = 0;
  std::vector<bool> known;
  for (const PointState& state : point_states(reader.database(), keys)) {
    if (state.answer == Answer::missing) ++missing;
    known.push_back(state.answer != Answer::missing && !old.contains(keys[known.size()]));
  }

  const bool width_varies = any_of(study.axes, [](const Axis& axis) { return axis.key == "width"; });
  const Evaluate evaluate = width_varies && options.fields == Fields::dropped ? once_for_widths(solve_one) : solve_one;
  Run run;
  run.stop_from_outside = options.stop;
  if (options.ready) options.ready();
  const Existing existing = options.retry == Retry::nothing ? Existing::kept : Existing::replaced;
  for (const std::string& key : again_alone) {
    const auto point = static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin());
    if (point == keys.size() || run.asked_to_stop()) continue;
    if (!known[point])
      work_on(run, point, plan, part, evaluate, options.fields, [&](Evaluation&& answer) {
        store.save({&answer, 1}, existing);
      });
    known[point] = true;
    std::vector<EndedPoint> others = ended_points(database);
    std::erase_if(others, [&](const EndedPoint& other) { return other.key == key; });
    keep_ended_points(database, others);
  }
  WorkList list(keys, known, [&](const std::string& key) {
    const auto answer = reader.find_answer(key);
    const auto was = old.find(key);
    return answer && (was == old.end() || *answer != was->second);
  });
  const std::size_t to_solve = list.open();
  {
    ResultWriter writer(
        [&](const std::vector<Evaluation>& answers) {
          // Those that are there already were stored by another process meanwhile.
          if (store.save(answers, existing) < answers.size()) list.move_away();
        },
        options.grouping);
    std::vector<std::jthread> threads;
    try {
      const std::size_t jobs = jobs_for(options.jobs, to_solve);
      const int cores_each = cores_for_each(jobs);
      for (std::size_t job = 0; job < jobs; ++job) {
        threads.emplace_back([&] { work(run, list, plan, part, evaluate, options.fields, writer, cores_each); });
        const std::lock_guard lock(run.mutex);
        ++run.started;
      }
      std::unique_lock lock(run.mutex);
      while (!run.changed.wait_for(lock, std::chrono::milliseconds(100), [&] { return run.ended == run.started; })) {
        lock.unlock();
        if (options.report)
          options.report({to_solve, run.solved, run.failed, list.open(), seconds(), run.asked_to_stop()});
        lock.lock();
      }
      threads.clear();
      writer.flush();
    } catch (...) {
      run.fail(std::current_exception());
    }
  }
  if (run.first_error) std::rethrow_exception(run.first_error);
  store.database().require_present();  // what is counted below is in the file
  store.require_study(started, study.name, keys);

  SweepReport report;
  report.study = store.study(study.name).value_or(StudySummary{});
  const auto again = count_if(keys, [&](const std::string& key) { return old.contains(key); });
  const std::vector<PointState> states = point_states(reader.database(), keys);
  report.dropped = plan.all_dropped();
  report.points = keys.size();
  report.answered = keys.size() - count(states, Answer::missing);
  report.failed = count(states, Answer::failed);
  report.recalled = keys.size() - missing - static_cast<std::size_t>(again);
  report.solved = run.solved;
  report.interrupted = run.asked_to_stop() && report.answered < report.points;
  report.seconds = seconds();
  return report;
}

}  // namespace rollres
