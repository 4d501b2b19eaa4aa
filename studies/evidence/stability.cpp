#include "studies/evidence/stability.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "studies/evidence/power_law.hpp"
#include "studies/evidence/stability_scene.hpp"
#include "studies/run/forked_work.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// All trials of a plan, cylinders and spheres in even mixture, so that the time left can be told.
std::vector<Trial> planned(const StabilityPlan& plan) {
  std::vector<Trial> trials;
  std::size_t cylinder = 0, sphere = 0;
  while (cylinder < plan.cylinders || sphere < plan.spheres) {
    const bool next_is_sphere =
        cylinder == plan.cylinders || (sphere < plan.spheres && sphere * plan.cylinders < cylinder * plan.spheres);
    Trial trial;
    trial.number = next_is_sphere ? sphere++ : cylinder++;
    trial.scene = stability_scene(next_is_sphere ? Indenter::sphere : Indenter::cylinder, plan.seed, trial.number);
    for (const Method method : plan.methods) {
      if (method == Method::spectral && next_is_sphere) continue;
      Trial& added = trials.emplace_back(trial);
      added.scene.method = method;
      added.scene.time_limit = plan.time_limit;
      if (!on_grid(method)) added.scene.spacing.reset();
    }
  }
  return trials;
}

}  // namespace

StabilityReport run_stability(const StabilityPlan& plan, const Evaluate& evaluate) {
  const auto begin = std::chrono::steady_clock::now();
  auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  std::vector<Trial> trials = planned(plan);
  std::vector<char> ended(trials.size(), 0);
  ForkedWork work{.pieces = trials.size(), .jobs = plan.jobs, .time_limit = plan.time_limit};
  work.stop = plan.stop;
  work.report = plan.report;
  work.work = [&](std::size_t piece) {
    const Trial trial = judge(evaluate, trials[piece].scene, trials[piece].number);
    Packer pack;
    pack(trial.numbers);
    pack(trial.reason);
    return pack.bytes;
  };
  work.done = [&](const PieceEnd& end) {
    Trial& trial = trials[end.piece];
    if (end.out_of_time) {
      trial.numbers.outcome = Outcome::not_converged;
      trial.numbers.seconds = end.seconds;
      trial.reason = "no answer within " + short_number(plan.time_limit) + " s";
    } else if (!end.death.empty()) {
      trial.reason = end.death;
    } else {
      Unpacker unpack{end.answer};
      unpack(trial.numbers);
      unpack(trial.reason);
    }
    ended[end.piece] = 1;
    if (plan.on_trial) plan.on_trial(trial);
    return !is_failure(trial.numbers.outcome);
  };
  run_forked(work);

  StabilityReport report;
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (ended[i]) report.trials.push_back(std::move(trials[i]));
  std::stable_sort(report.trials.begin(), report.trials.end(), [](const Trial& a, const Trial& b) {
    return a.scene.indenter != b.scene.indenter ? a.scene.indenter < b.scene.indenter : a.number < b.number;
  });
  report.interrupted = report.trials.size() < trials.size();
  report.seconds = seconds();
  return report;
}

std::size_t StabilityCount::trials() const {
  std::size_t sum = 0;
  for (const std::size_t count : of) sum += count;
  return sum;
}

std::vector<StabilityCount> counts(const std::vector<Trial>& trials) {
  std::vector<StabilityCount> all;
  for (std::size_t indenter = 0; indenter < ChoiceNames<Indenter>::names.size(); ++indenter)
    for (std::size_t method = 0; method < ChoiceNames<Method>::names.size(); ++method) {
      StabilityCount count{static_cast<Method>(method), static_cast<Indenter>(indenter)};
      std::vector<double> times;
      for (const Trial& trial : trials) {
        if (trial.scene.method != count.method || trial.scene.indenter != count.indenter) continue;
        ++count.of[static_cast<std::size_t>(trial.numbers.outcome)];
        if (std::isfinite(trial.numbers.seconds)) times.push_back(trial.numbers.seconds);
      }
      if (count.trials() == 0) continue;
      count.median_seconds = quantile(times, 0.5);
      count.seconds_95 = quantile(times, 0.95);
      count.longest_seconds = quantile(times, 1);
      all.push_back(count);
    }
  return all;
}

}  // namespace rollres
