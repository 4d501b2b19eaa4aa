#include "studies/evidence/random_accuracy.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/numerics/recently_made.hpp"
#include "studies/evidence/power_law.hpp"
#include "studies/scene_io/cells.hpp"

namespace rollres {

namespace {

using Clock = std::chrono::steady_clock;

/// A scene in all ways to solve it.
struct RandomScene {
  std::size_t number;
  RollingScene scene;
  std::vector<RollingScene> ways;
};

RandomScene random_scene(const RandomAccuracyPlan& plan, Indenter indenter, std::size_t number) {
  RandomScene random{number, stability_scene(indenter, plan.seed, number, plan.spectra), {}};
  random.scene.inertia = Inertia::off;  // errors of computing are wanted, of one model
  random.scene.time_limit = plan.time_limit;
  // Every fourth scene without friction: other ways are taken there.
  if (number % 4 == 3) {
    random.scene.friction_coefficient = 0;
    random.scene.drive = Drive::top_force;
    random.scene.driving_torque.reset();
    random.scene.rotation_ratio.reset();
  }
  const auto add = [&](Method method, std::optional<double> tolerance) {
    RollingScene& scene = random.ways.emplace_back(random.scene);
    scene.method = method;
    scene.tolerance = tolerance;
    if (tolerance) scene.spacing.reset();
  };
  if (dimension_of(indenter) == 2)
    for (const double tolerance : plan.tolerances) add(Method::spectral, tolerance);
  add(Method::newton, {});
  add(Method::active_set, {});
  for (const double tolerance : plan.tolerances) add(Method::newton, tolerance);
  return random;
}

RollingSolution reference_of(const RandomScene& random, double tolerance, const Evaluate& evaluate) {
  RollingScene scene = random.scene;
  scene.spacing.reset();
  scene.tolerance = 1e-10;
  if (dimension_of(scene.indenter) == 2) {
    scene.method = Method::spectral;
    RollingSolution solution = evaluate(scene);
    if (solution.status == Status::converged && solution.method == Method::spectral) return solution;
  }
  scene.method = Method::newton;
  scene.tolerance = tolerance;
  return evaluate(scene);
}

std::vector<JudgedNumbers> judged_ways(const RandomScene& random, double reference_tolerance,
                                       const Evaluate& evaluate) {
  std::vector<JudgedNumbers> judged;
  for (const RollingScene& scene : random.ways) {
    forget_kernels();
    JudgedNumbers& numbers = judged.emplace_back();
    const auto begin = Clock::now();
    const RollingSolution solution = evaluate(scene);
    numbers.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    // A scene that its method leaves to another is not that method's.
    if (solution.method == scene.method) numbers.status = solution.status;
    numbers.contact_nodes = solution.contact_nodes;
    numbers.error_estimate = solution.error_estimate;
    numbers.error = solution.rolling_resistance;  // until there is a reference
  }
  const bool any = any_of(judged, [](const JudgedNumbers& numbers) { return numbers.status == Status::converged; });
  const RollingSolution reference = any ? reference_of(random, reference_tolerance, evaluate) : RollingSolution();
  for (JudgedNumbers& numbers : judged) {
    const bool known = reference.status == Status::converged;
    numbers.error = known ? std::abs(numbers.error / reference.rolling_resistance - 1) : RollingSolution::absent;
    numbers.uncertainty = known ? reference.error_estimate : RollingSolution::absent;
  }
  return judged;
}

double share_of(std::size_t part, std::size_t whole) {
  return whole == 0 ? RollingSolution::absent : static_cast<double>(part) / static_cast<double>(whole);
}

constexpr double certain = 1.0 / 3;  // uncertainty of a reference, of what it judges
constexpr double rounding = 1e-12;   // errors below mean nothing

RandomAccuracyCount count_of(const std::vector<const JudgedSolution*>& way) {
  RandomAccuracyCount count;
  const RollingScene& scene = way.front()->scene;
  count.method = scene.method;
  count.indenter = scene.indenter;
  count.tolerance = scene.tolerance.value_or(RollingSolution::absent);
  std::vector<double> ratios, seconds, nodes;
  std::size_t covered = 0, met = 0, certain_to_tolerance = 0;
  for (const JudgedSolution* one : way) {
    if (one->status != Status::converged) continue;
    ++count.converged;
    seconds.push_back(one->seconds);
    nodes.push_back(one->contact_nodes);
    if (scene.tolerance && one->uncertainty <= certain * *scene.tolerance) {
      ++certain_to_tolerance;
      if (one->error <= *scene.tolerance) ++met;
    }
    const double largest = std::max(one->error, rounding);
    if (!(one->uncertainty <= certain * std::max(largest, one->error_estimate))) continue;
    ++count.judged;
    if (one->error <= one->error_estimate || one->error <= rounding) ++covered;
    ratios.push_back(one->error_estimate / largest);
  }
  count.covered = share_of(covered, count.judged);
  count.median_ratio = quantile(ratios, 0.5);
  count.met = share_of(met, certain_to_tolerance);
  count.median_seconds = quantile(seconds, 0.5);
  count.seconds_95 = quantile(seconds, 0.95);
  count.median_nodes = quantile(nodes, 0.5);
  return count;
}

}  // namespace

RandomAccuracyReport measure_random_accuracy(const RandomAccuracyPlan& plan, const Evaluate& evaluate) {
  std::vector<RandomScene> scenes;
  for (std::size_t i = 0; i < plan.cylinders; ++i) scenes.push_back(random_scene(plan, Indenter::cylinder, i));
  for (std::size_t i = 0; i < plan.spheres; ++i) scenes.push_back(random_scene(plan, Indenter::sphere, i));
  const double reference_tolerance = 0.2 * *min_element(plan.tolerances);
  std::vector<std::vector<JudgedSolution>> judged(scenes.size());
  ForkedWork work = plan.work(scenes.size());
  work.work = [&](std::size_t piece) {
    Packer pack;
    pack(judged_ways(scenes[piece], reference_tolerance, evaluate));
    return pack.bytes;
  };
  work.done = [&](const PieceEnd& end) {
    const RandomScene& random = scenes[end.piece];
    std::vector<JudgedNumbers> numbers;
    if (!end.answer.empty()) Unpacker{end.answer}(numbers);
    numbers.resize(random.ways.size());  // where its process ended before its time
    for (std::size_t way = 0; way < numbers.size(); ++way)
      judged[end.piece].push_back({numbers[way], random.number, random.ways[way]});
    return !end.answer.empty();
  };
  run_forked(work);

  RandomAccuracyReport report;
  for (std::vector<JudgedSolution>& scene : judged) {
    if (scene.empty()) report.interrupted = true;
    report.solutions.insert(report.solutions.end(), scene.begin(), scene.end());
  }
  return report;
}

std::vector<RandomAccuracyCount> counts_of(const std::vector<JudgedSolution>& solutions) {
  const auto same_way = [](const JudgedSolution& a, const JudgedSolution& b) {
    return a.scene.indenter == b.scene.indenter && a.scene.method == b.scene.method &&
           a.scene.tolerance == b.scene.tolerance;
  };
  std::vector<std::vector<const JudgedSolution*>> ways;
  for (const JudgedSolution& one : solutions) {
    const auto known = find_if(ways, [&](const auto& way) { return same_way(*way.front(), one); });
    (known == ways.end() ? ways.emplace_back() : *known).push_back(&one);
  }
  std::vector<RandomAccuracyCount> counts;
  for (const auto& way : ways) counts.push_back(count_of(way));
  return counts;
}

Table random_accuracy_table(const std::vector<RandomAccuracyCount>& counts) {
  return table_of(counts, [](const RandomAccuracyCount& count) {
    return NamedCells{{"indenter", cell_of(count.indenter)},
                      {"method", cell_of(count.method)},
                      {"tolerance", cell_of(count.tolerance)},
                      {"converged", cell_of(count.converged)},
                      {"judged", cell_of(count.judged)},
                      {"error <= estimate", cell_of(count.covered)},
                      {"estimate/error", cell_of(count.median_ratio)},
                      {"tolerance met", cell_of(count.met)},
                      {"median s", cell_of(count.median_seconds)},
                      {"95 % s", cell_of(count.seconds_95)},
                      {"median nodes", cell_of(count.median_nodes)}};
  });
}

Table judged_table(const std::vector<JudgedSolution>& solutions) {
  return table_of(solutions, [](const JudgedSolution& one) {
    NamedCells row = input_cells(one.scene);
    row.insert(row.begin(), {"number", cell_of(one.number)});
    row.insert(row.end(), {{"status", cell_of(one.status)},
                           {"seconds", cell_of(one.seconds)},
                           {"contact_nodes", cell_of(one.contact_nodes)},
                           {"error_estimate", cell_of(one.error_estimate)},
                           {"error", cell_of(one.error)},
                           {"uncertainty", cell_of(one.uncertainty)}});
    return row;
  });
}

}  // namespace rollres
