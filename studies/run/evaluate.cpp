#include "studies/run/evaluate.hpp"

#include <chrono>
#include <cmath>
#include <exception>
#include <utility>

#include "core/surface/scene_rules.hpp"

namespace rollres {

RollingSolution evaluate_safely(const Evaluate& evaluate, const RollingScene& scene, Fields fields) noexcept {
  const auto begin = std::chrono::steady_clock::now();
  RollingSolution solution;
  try {
    solution = evaluate(scene);
  } catch (const std::exception& error) {
    solution = {};
    solution.method = resolved_method(scene);
    solution.reason = error.what();
  } catch (...) {
    solution = {};
    solution.method = resolved_method(scene);
    solution.reason = "an unknown error";
  }
  if (fields == Fields::dropped) solution.fields = {};
  if (std::isnan(solution.seconds))
    solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return solution;
}

Evaluate recalling(ResultStore& store, Evaluate evaluate) {
  return [&store, evaluate = std::move(evaluate)](const RollingScene& scene) {
    const std::string key = evaluation_key(scene);
    if (auto stored = store.solution(key)) return std::move(*stored);
    const Evaluation answer{key, scene, evaluate_safely(evaluate, scene)};
    store.save({&answer, 1});
    return answer.solution;
  };
}

}  // namespace rollres
