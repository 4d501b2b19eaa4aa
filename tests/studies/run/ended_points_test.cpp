#include "studies/run/ended_points.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>

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

/// What is noted beside a database after SIGKILL ended a process with a point in work, while the system's count of
/// processes that it ended for want of memory went from 3 to `count`.
std::vector<EndedPoint> noted_after_kill(const char* count) {
  const TemporaryDirectory folder;
  const auto counters = folder / "counters";
  std::ofstream(counters) << "pgfault 7\noom_kill 3\nnuma_hit 9\n";
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);  // who waits for that end becomes a child of this process
  if (::fork() == 0) {
    const FatalSignalNotes notes(folder / "a.db", counters);
    const PointInWork done("earlier"), in_work("now");
    { const PointInWork brief("brief"); }
    std::ofstream(counters) << "pgfault 7\noom_kill " << count << "\nnuma_hit 9\n";
    ::raise(SIGKILL);
  }
  while (::wait(nullptr) > 0) {
  }
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
  return ended_points(folder / "a.db");
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

TEST_CASE(
    "points in work when the system ends the program for want of memory are noted, when a user does so they are not",
    "[studies][ended_points]") {
  CHECK(noted_after_kill("3").empty());
  const std::vector<EndedPoint> noted = noted_after_kill("4");
  REQUIRE(noted.size() == 2);
  CHECK(noted[0].key == "earlier");
  CHECK(noted[1].key == "now");
  CHECK(noted[1].signal == SIGKILL);
}

TEST_CASE("what ended for want of memory is solved alone and first, and failed after the second time",
          "[studies][ended_points]") {
  const TemporaryDirectory folder;
  const auto database = folder / "a.db";
  const Study study = study_with_crashes();
  const std::vector<std::string> keys = StudyPlan(study).keys();
  const std::vector<EndedPoint> noted{
      {keys[69], SIGKILL}, {keys[4], SIGKILL}, {keys[7], SIGKILL}, {keys[4], SIGKILL}, {"of_another_study", SIGKILL}};
  keep_ended_points(database, noted);
  std::atomic<int> at_work = 0, begun = 0;
  std::vector<double> first_speeds(2);
  SweepOptions options;
  options.jobs = 4;
  const auto report = run_sweep(
      study,
      [&](const RollingScene& scene) {
        const int others = at_work++, place = begun++;
        if (place < 2) first_speeds[static_cast<std::size_t>(place)] = scene.speed + 1000 * others;
        const RollingSolution solution = closed_form(scene);
        --at_work;
        return solution;
      },
      database, options);
  CHECK(first_speeds == std::vector<double>{70, 8});
  CHECK(report.solved == 299);
  CHECK(report.failed == 1);
  CHECK(report.answered == 300);
  CHECK(ResultStore(database, Access::read).failures("crashes").front().reason ==
        "ended the program (signal 9: the system had no memory left)");
  const std::vector<EndedPoint> left = ended_points(database);
  REQUIRE(left.size() == 1);
  CHECK(left.front().key == "of_another_study");
}

TEST_CASE("a thread that has solved a point has the stack for signals that it had before", "[studies][ended_points]") {
  stack_t before{}, after{};
  ::sigaltstack(nullptr, &before);
  { const PointInWork in_work("a"); }
  ::sigaltstack(nullptr, &after);
  CHECK(after.ss_sp == before.ss_sp);
  CHECK(after.ss_flags == before.ss_flags);
}
