#include "studies/run/ended_points.hpp"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "studies/run/sweep.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

/// A study of 300 speeds, of which five end the program, one of them by a stack that overflows.
Study study_with_crashes() {
  Study study;
  study.name = "crashes";
  study.base = plain_scene(1.0);
  Axis axis;
  axis.key = "speed";
  for (int i = 1; i <= 300; ++i) axis.values.push_back(i);
  study.axes.push_back(axis);
  return study;
}

int deeper(volatile const int* above) {
  volatile int here[4096] = {*above};
  return here[0] < 0 ? 0 : deeper(here) + here[1];
}

RollingSolution crashing(const RollingScene& scene) {
  const int number = static_cast<int>(scene.speed);
  if (number == 120) deeper(&number);
  if (number % 60 == 0) ::raise(SIGSEGV);
  return closed_form(scene);
}

/// Status of a process of its own that runs the sweep.
int run_apart(const std::filesystem::path& database) {
  const pid_t child = ::fork();
  if (child == 0) {
    SweepOptions options;
    options.jobs = 1;
    run_sweep(study_with_crashes(), crashing, database, options);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

}  // namespace

TEST_CASE("a point that ends the program is failed at the next start and does not end it again",
          "[studies][ended_points]") {
  const TemporaryDirectory folder;
  const auto database = folder / "a.db";
  int starts = 0, status = 0;
  do {
    status = run_apart(database);
    ++starts;
  } while (WIFSIGNALED(status) && starts < 20);
  CHECK(WIFEXITED(status));
  CHECK(starts == 6);  // one for each of the five that end it
  ResultStore store(database, Access::read);
  const auto summary = store.study("crashes");
  REQUIRE(summary);
  CHECK(summary->answered == 300);
  CHECK(summary->failed == 5);
  CHECK(store.failures("crashes").front().reason == "ended the program (signal 11)");
  CHECK(ended_points(database).empty());
}
