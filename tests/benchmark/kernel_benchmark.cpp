#include <benchmark/benchmark.h>

#include "core/convolution/influence_operator.hpp"
#include "core/influence/passage_kernel.hpp"
#include "core/material/material.hpp"
#include "tests/benchmark/scenes.hpp"

namespace rollres {

namespace {

/// A speed and a spacing of the paper's sphere: the spacings have about 939 and 14,919 nodes in contact.
void speeds(benchmark::internal::Benchmark* timing) {
  timing->ArgNames({"speed_um_s", "spacing_nm"})->Unit(benchmark::kMillisecond);
  for (const long spacing : {250'000, 62'500})
    for (const long speed : {100, 30'000'000}) timing->Args({speed, spacing});
}

/// Spacings of the paper's sphere with about 939, 3,728, 14,919 and 59,590 nodes in contact.
void spacings(benchmark::internal::Benchmark* timing) {
  timing->ArgName("spacing_nm")->Unit(benchmark::kMillisecond);
  for (const long spacing : {250'000, 125'000, 62'500, 31'250}) timing->Arg(spacing);
}

struct Parts {
  RollingScene scene;
  SurfaceGrid half, whole;
  CreepSpectrum material;

  explicit Parts(double spacing)
      : scene(timed::paper_sphere(spacing)),
        half(timed::grid_of(scene)),
        whole(mirrored(half)),
        material(creep_spectrum(scene)) {}

  PassageKernel kernel() const {
    return {scene.indenter, scene.layer_thickness, whole.spacing_x, whole.spacing_y, whole.columns, whole.rows};
  }
  InfluenceTable table(const PassageKernel& kernel, double speed) const {
    return kernel.table(material, speed, whole.columns, whole.rows);
  }
};

/// Elastic values and coefficients: what the first scene of a layer and a spacing costs.
void kernel_first(benchmark::State& state) {
  const Parts parts(1e-9 * static_cast<double>(state.range(1)));
  for (auto _ : state)
    benchmark::DoNotOptimize(parts.table(parts.kernel(), 1e-6 * static_cast<double>(state.range(0))));
}
BENCHMARK(kernel_first)->Apply(speeds);

/// Coefficients alone: what another speed costs.
void kernel_new_speed(benchmark::State& state) {
  const Parts parts(1e-9 * static_cast<double>(state.range(1)));
  const PassageKernel kernel = parts.kernel();
  for (auto _ : state) benchmark::DoNotOptimize(parts.table(kernel, 1e-6 * static_cast<double>(state.range(0))));
}
BENCHMARK(kernel_new_speed)->Apply(speeds);

/// All displacements from all tractions, once.
void operator_apply(benchmark::State& state) {
  const Parts parts(1e-9 * static_cast<double>(state.range(0)));
  const InfluenceOperator influence(parts.scene, parts.table(parts.kernel(), parts.scene.speed), parts.half, true);
  const Vector traction = Vector::Ones(parts.half.size());
  for (auto _ : state) benchmark::DoNotOptimize(influence.apply(traction, traction, traction));
  state.counters["grid"] = parts.half.size();
}
BENCHMARK(operator_apply)->Apply(spacings);

}  // namespace

}  // namespace rollres
