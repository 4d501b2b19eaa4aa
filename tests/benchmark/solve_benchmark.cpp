#include <benchmark/benchmark.h>

#include "core/numerics/recently_made.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/benchmark/scenes.hpp"

namespace rollres {

namespace {

/// Solves as a program that has solved nothing before, but for what it keeps of FFTW's plans and of the processor's
/// caches; `keep_kernel`: as one that knows the layer and the spacing.
void time_solve(benchmark::State& state, const RollingScene& scene, bool keep_kernel) {
  RollingSolution solution;
  for (auto _ : state) {
    if (!keep_kernel) {
      state.PauseTiming();
      forget_kernels();
      state.ResumeTiming();
    }
    solution = solve(scene);
  }
  if (solution.status != Status::converged) state.SkipWithError(solution.reason.c_str());
  state.counters["nodes"] = solution.contact_nodes;
  state.counters["R_r"] = solution.rolling_resistance;
  state.counters["violation"] = solution.law_violation;
}

double spacing_of(const benchmark::State& state) { return 1e-9 * static_cast<double>(state.range(0)); }

void solve_sphere(benchmark::State& state) { time_solve(state, timed::paper_sphere(spacing_of(state)), false); }
void solve_sphere_known_kernel(benchmark::State& state) {
  time_solve(state, timed::paper_sphere(spacing_of(state)), true);
}
/// 939, 3,728, 14,919 and 59,590 nodes.
BENCHMARK(solve_sphere)
    ->ArgName("spacing_nm")
    ->Arg(250'000)
    ->Arg(125'000)
    ->Arg(62'500)
    ->Arg(31'250)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(solve_sphere_known_kernel)->ArgName("spacing_nm")->Arg(250'000)->UseRealTime()->Unit(benchmark::kMillisecond);

/// About 200,000 nodes without friction.
void solve_frictionless(benchmark::State& state) {
  RollingScene scene = timed::paper_sphere(spacing_of(state));
  scene.friction_coefficient = 0;
  time_solve(state, scene, false);
}
BENCHMARK(solve_frictionless)->ArgName("spacing_nm")->Arg(17'060)->UseRealTime()->Unit(benchmark::kMillisecond);

/// About 29,000 nodes: CONTACT takes 197 s for an elastic sphere on a half-space under a given force.
void solve_elastic_force_given(benchmark::State& state) {
  time_solve(state, timed::elastic_sphere(static_cast<double>(state.range(0))), false);
}
BENCHMARK(solve_elastic_force_given)
    ->ArgName("nodes_per_radius")
    ->Arg(18)
    ->Arg(48)
    ->Arg(96)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace rollres
