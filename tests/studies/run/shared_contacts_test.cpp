#include "studies/run/shared_contacts.hpp"

#include <atomic>
#include <thread>

#include "studies/run/sweep.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/stored_rows.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

RollingScene of_width(RollingScene scene, double width) {
  *scene.load *= width;
  scene.width = width;
  return scene;
}

Evaluate counting(std::atomic<int>& count, const Evaluate& evaluate) {
  return [&count, evaluate](const RollingScene& scene) {
    ++count;
    return evaluate(scene);
  };
}

}  // namespace

TEST_CASE("cylinders of several widths with one load per metre are solved once, and answered as each by itself",
          "[studies][run][width]") {
  RollingScene plain = frictionless(paper_cylinder());
  plain.spacing.reset();
  std::atomic<int> count = 0;
  const Evaluate shared = once_for_widths(counting(count, solve));
  for (const double width : {0.05, 0.07, 0.3}) {
    const RollingSolution one = shared(of_width(plain, width)), alone = solve(of_width(plain, width));
    CHECK(one.rolling_resistance == Approx(alone.rolling_resistance).epsilon(1e-12));
    CHECK(one.peak_pressure == Approx(alone.peak_pressure).epsilon(1e-12));
    CHECK(one.load == alone.load);
    CHECK(one.warnings == alone.warnings);
  }
  CHECK(count == 1);
  RollingScene heavier = of_width(plain, 0.05);
  *heavier.load *= 2;
  shared(heavier);
  CHECK(count == 2);
  shared(plain);
  shared(plain);  // without a width nothing is kept
  CHECK(count == 4);
}

TEST_CASE("threads that ask for one contact at once wait for the first, and hear of its failure",
          "[studies][run][width]") {
  std::atomic<int> count = 0;
  const Evaluate shared = once_for_widths(counting(count, [](const RollingScene& scene) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (scene.speed > 1) throw std::runtime_error("singular matrix");
    return closed_form(scene);
  }));
  std::atomic<int> failed = 0;
  {
    std::vector<std::jthread> threads;
    for (const double width : {0.1, 0.2, 0.4})
      for (const double speed : {0.5, 2.0})
        threads.emplace_back([&, width, speed] {
          try {
            shared(of_width(plain_scene(speed), width));
          } catch (const std::runtime_error&) {
            ++failed;
          }
        });
  }
  CHECK(count == 2);
  CHECK(failed == 3);
}

TEST_CASE("a sweep over widths at a given approach solves each contact once", "[studies][run][width]") {
  const TemporaryDirectory folder;
  Study study{.name = "widths", .base = plain_scene(), .axes = {{"width"}, {"speed"}}};
  study.base.load.reset();
  study.base.approach = 1e-4;
  study.axes[0].values = {0.05, 0.1, 0.2};
  study.axes[1].values = {0.1, 0.2};
  study.base.width = 0.05;
  std::atomic<int> count = 0;
  const SweepReport report = run_sweep(study, counting(count, closed_form), folder / "w.db", {});
  CHECK(report.solved == 6);
  CHECK(count == 2);
}
