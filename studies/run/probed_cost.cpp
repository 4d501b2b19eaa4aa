#include "studies/run/probed_cost.hpp"

#include <algorithm>
#include <chrono>
#include <set>

#include "studies/run/evaluate.hpp"

namespace rollres {

namespace {

/// The number with the binary digits of `index` behind the point, in reverse (van der Corput, 1935).
double reversed(std::size_t index) {
  double value = 0, digit = 0.5;
  for (; index > 0; index /= 2, digit /= 2) value += static_cast<double>(index % 2) * digit;
  return value;
}

}  // namespace

ProbedCost probed_cost(const Study& study, const Evaluate& evaluate, double budget) {
  constexpr std::size_t most = 48;
  constexpr double longest = 10;  // [s]
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  };
  const StudyPlan plan(study);
  const auto begin = Clock::now();
  ProbedCost cost;
  std::set<std::size_t> seen;
  double seconds = 0, first = 0;
  for (std::size_t i = 0; i < 2 * most && cost.points < most && since(begin) < budget; ++i) {
    constexpr double middle = 1.0 / 3;  // of no axis that is halved
    const double part = reversed(i) + middle;
    const auto point = static_cast<std::size_t>((part < 1 ? part : part - 1) * static_cast<double>(plan.size()));
    if (point >= plan.size() || !seen.insert(point).second) continue;
    RollingScene scene = plan.scene(point);
    scene.time_limit = std::min(scene.time_limit.value_or(longest), longest);
    const auto start = Clock::now();
    evaluate_safely(evaluate, scene);
    first = cost.points == 0 ? since(start) : first;
    seconds += since(start);
    ++cost.points;
  }
  // The first bears what is done once for all.
  if (cost.points > 1) cost.seconds_each = (seconds - first) / static_cast<double>(cost.points - 1);
  if (cost.points == 1) cost.seconds_each = seconds;
  return cost;
}

}  // namespace rollres
