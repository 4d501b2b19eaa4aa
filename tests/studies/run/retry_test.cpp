#include <SQLiteCpp/SQLiteCpp.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "studies/run/sweep.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

/// Ten speeds, 0.1 to 1.
Study ten_speeds() {
  Study study{.name = "ten speeds", .base = plain_scene(0.1), .axes = {{"speed"}}};
  for (int i = 1; i <= 10; ++i) study.axes[0].values.push_back(0.1 * i);
  return study;
}

int tenths(const RollingScene& scene) { return static_cast<int>(std::lround(10 * scene.speed)); }

/// The third and fourth point do not converge, the seventh has no steady state.
RollingSolution fails_at_three(const RollingScene& scene) {
  const int point = tenths(scene);
  if (point == 3 || point == 4) throw std::runtime_error("singular matrix");
  RollingSolution solution = closed_form(scene);
  if (point == 7) solution.status = Status::no_steady_state;
  return solution;
}

RollingSolution with_fields(const RollingScene& scene) {
  RollingSolution solution = fails_at_three(scene);
  solution.fields.grid = {.spacing_x = 0.1, .spacing_y = 1, .columns = 2, .rows = 1};
  solution.fields.w = {scene.speed, 0};
  solution.fields.zone = {Zone::stick, Zone::free};
  return solution;
}

struct Counted {
  Evaluate evaluate;
  std::atomic<int> calls = 0;
  Evaluate counting() {
    return [this](const RollingScene& scene) {
      ++calls;
      return evaluate(scene);
    };
  }
};

std::string one_text(const std::filesystem::path& file, const std::string& query) {
  SQLite::Database plain(file.string());
  return plain.execAndGet(query).getString();
}

}  // namespace

TEST_CASE("a retry solves the points it names again and no others, and they keep their numbers and keys",
          "[studies][retry]") {
  const TemporaryDirectory folder;
  const auto file = folder / "a.db";
  run_sweep(ten_speeds(), fails_at_three, file);
  const std::string keys = one_text(file, "SELECT group_concat(id || key) FROM evaluation");
  struct Expected {
    Retry retry;
    int solved;
  };
  for (const auto& [retry, solved] : {Expected{Retry::nothing, 0}, Expected{Retry::not_converged, 2},
                                      Expected{Retry::failed, 3}, Expected{Retry::all, 10}}) {
    Counted again{fails_at_three};
    const SweepReport report = run_sweep(ten_speeds(), again.counting(), file, {.jobs = 3, .retry = retry});
    CHECK(again.calls == solved);
    CHECK(report.solved == static_cast<std::size_t>(solved));
    CHECK(report.recalled == static_cast<std::size_t>(10 - solved));
    CHECK(report.study.answered == 10);
    CHECK(report.study.failed == 3);
  }
  const SweepReport mended = run_sweep(ten_speeds(), closed_form, file, {.retry = Retry::failed});
  CHECK(mended.solved == 3);
  CHECK(mended.study.failed == 0);
  CHECK(one_text(file, "SELECT group_concat(id || key) FROM evaluation") == keys);
  CHECK(run_sweep(ten_speeds(), closed_form, file, {.retry = Retry::failed}).solved == 0);
}

TEST_CASE("a retry that fails leaves what converged", "[studies][retry]") {
  const TemporaryDirectory folder;
  run_sweep(ten_speeds(), closed_form, folder / "a.db");
  const SweepReport report = run_sweep(ten_speeds(), fails_at_three, folder / "a.db", {.retry = Retry::all});
  CHECK(report.solved == 10);
  CHECK(report.study.failed == 0);
}

TEST_CASE("a retry killed at any moment has every point answered, by its old or its new answer", "[studies][retry]") {
  const TemporaryDirectory folder;
  const auto file = folder / "a.db";
  run_sweep(ten_speeds(), fails_at_three, file);
  for (int moment = 1; moment <= 8; ++moment) {
    const pid_t child = fork();
    if (child == 0) {
      try {
        run_sweep(ten_speeds(),
                  [](const RollingScene& scene) {
                    std::this_thread::sleep_for(std::chrono::milliseconds(2));
                    return fails_at_three(scene);
                  },
                  file, {.jobs = 1, .grouping = std::chrono::milliseconds(0), .retry = Retry::all});
      } catch (...) {
        _exit(1);
      }
      _exit(0);
    }
    usleep(static_cast<useconds_t>(4000 * moment));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const auto study = ResultStore(file, Access::read).study("ten speeds");
    REQUIRE(study);
    CHECK(study->answered == 10);
    CHECK(study->failed == 3);
  }
  CHECK(one_text(file, "PRAGMA integrity_check") == "ok");
}

TEST_CASE("fields are stored on request, also for points that were stored without them", "[studies][retry]") {
  const TemporaryDirectory folder;
  const auto file = folder / "a.db";
  Counted plain{with_fields}, full{with_fields};
  run_sweep(ten_speeds(), plain.counting(), file);
  CHECK(one_text(file, "SELECT count(*) FROM fields") == "0");
  const std::string answers =
      "SELECT group_concat(id || key || created || coalesce(rolling_resistance, '')) "
      "FROM evaluation";
  const std::string before = one_text(file, answers);
  const SweepReport report = run_sweep(ten_speeds(), full.counting(), file, {.fields = Fields::kept});
  CHECK(full.calls == 7);  // those that converged
  CHECK(report.recalled == 3);
  CHECK(one_text(file, "SELECT count(*) FROM fields") == "7");
  CHECK(one_text(file, answers) == before);
  CHECK(run_sweep(ten_speeds(), full.counting(), file, {.fields = Fields::kept}).solved == 0);
  ResultStore store(file, Access::read);
  CHECK(store.find_fields(evaluation_key(plain_scene(0.5)))->w[0] == 0.5);
}
