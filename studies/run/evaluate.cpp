#include "studies/run/evaluate.hpp"

#include <chrono>
#include <cmath>
#include <exception>

#include "core/model/scene_rules.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

RollingSolution evaluate_safely(const Evaluate& evaluate, const RollingScene& scene, Fields fields) {
  const auto begin = std::chrono::steady_clock::now();
  RollingSolution solution;
  try {
    solution = evaluate(scene);
  } catch (const Interrupted&) {
    throw;
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

}  // namespace rollres
