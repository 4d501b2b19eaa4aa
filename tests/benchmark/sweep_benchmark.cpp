#include <benchmark/benchmark.h>

#include <cmath>

#include "core/numerics/recently_made.hpp"
#include "studies/run/sweep.hpp"
#include "tests/benchmark/scenes.hpp"
#include "tests/studies/temporary_directory.hpp"

namespace rollres {

namespace {

/// 60 speeds from 1 mm/s to 10 m/s and 3 loads of the paper's sphere on the paper's grid, solved on all cores and
/// stored.
void sweep_sphere(benchmark::State& state) {
  constexpr int speeds = 60;
  Study study{.name = "sphere", .base = timed::paper_sphere(0.25e-3), .axes = {{"load", {75, 150, 300}}, {"speed"}}};
  for (int i = 0; i < speeds; ++i) study.axes[1].values.push_back(1e-3 * std::pow(1e4, i / (speeds - 1.0)));
  study.base.load = study.axes[0].values.front();
  study.base.speed = study.axes[1].values.front();
  std::int64_t failed = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const TemporaryDirectory folder;
    forget_kernels();
    state.ResumeTiming();
    failed = run_sweep(study, solve, folder / "sweep.db").study.failed;
  }
  state.counters["failed"] = static_cast<double>(failed);
}
BENCHMARK(sweep_sphere)->Iterations(1)->UseRealTime()->Unit(benchmark::kSecond);

}  // namespace

}  // namespace rollres
