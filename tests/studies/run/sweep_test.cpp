#include "studies/run/sweep.hpp"
#include "db/rows/schema.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>
#include <thread>

#include "studies/run/evaluate.hpp"
#include "studies/run/stop_signal.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/stored_rows.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers point_states, too.

using namespace rollres;

namespace {

using std::chrono::milliseconds;

Study study_of(int speeds, int loads = 2, const std::string& name = "speed and load") {
  Study study{.name = name, .base = plain_scene(), .axes = {{"speed"}, {"load"}}};
  for (int i = 0; i < speeds; ++i) study.axes[0].values.push_back(0.1 * (i + 1));
  for (int i = 0; i < loads; ++i) study.axes[1].values.push_back(1e4 * (i + 1));
  study.base.speed = study.axes[0].values.front();
  study.base.load = study.axes[1].values.front();
  return study;
}

/// A closed form that fails, throws and takes its time as a solver does.
Evaluate moody(milliseconds duration) {
  return [duration](const RollingScene& scene) {
    std::this_thread::sleep_for(duration);
    RollingSolution solution = closed_form(scene);
    const int tenths = static_cast<int>(std::lround(10 * scene.speed));
    if (tenths % 10 == 7) {
      solution.status = Status::no_steady_state;
      solution.reason = "needs more friction";
    }
    if (tenths % 10 == 9) throw std::runtime_error("singular matrix");
    if (tenths % 50 == 33) throw 33;
    return solution;
  };
}

constexpr auto rows = stored_rows;

int count(const std::filesystem::path& file, const std::string& query) {
  SQLite::Database plain(file.string());
  return plain.execAndGet(query).getInt();
}

/// Runs `work` in a process of its own; 0 unless it throws.
template <class Work>
pid_t in_child(Work&& work) {
  const pid_t child = fork();
  if (child != 0) return child;
  try {
    work();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "child: %s\n", error.what());
    _exit(1);
  }
  _exit(0);
}

int wait_for(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

}  // namespace

TEST_CASE("a sweep answers every point, and run again it solves nothing", "[studies][sweep]") {
  const TemporaryDirectory folder;
  std::atomic<int> calls = 0;
  const Evaluate counted = [&](const RollingScene& scene) {
    ++calls;
    return closed_form(scene);
  };
  const SweepReport first = run_sweep(study_of(50), counted, folder.path / "a.db", {.jobs = 4});
  CHECK(first.study.points == 100);
  CHECK(first.study.answered == 100);
  CHECK(first.study.failed == 0);
  CHECK(first.solved == 100);
  CHECK(first.recalled == 0);
  CHECK_FALSE(first.interrupted);
  CHECK(calls == 100);
  const SweepReport again = run_sweep(study_of(50), counted, folder.path / "a.db");
  CHECK(again.recalled == 100);
  CHECK(again.solved == 0);
  CHECK(calls == 100);
  const SweepReport longer = run_sweep(study_of(60, 2, "longer"), counted, folder.path / "a.db");
  CHECK(longer.recalled == 100);
  CHECK(longer.solved == 20);
  CHECK(calls == 120);
  CHECK(count(folder.path / "a.db", "SELECT count(*) FROM evaluation") == 120);
}

TEST_CASE("a failed point is a row with its reason, also where the solver throws", "[studies][sweep]") {
  const TemporaryDirectory folder;
  const SweepReport report = run_sweep(study_of(50, 1), moody(milliseconds(0)), folder.path / "a.db", {.jobs = 3});
  CHECK(report.study.answered == 50);
  CHECK(report.study.failed == 11);
  ResultStore store(folder.path / "a.db", Access::read);
  const std::vector<Failure> failures = store.failures("speed and load");
  REQUIRE(failures.size() == 3);
  CHECK(failures[0].status == "no_steady_state");
  CHECK(failures[0].reason == "needs more friction");
  CHECK(failures[0].points == 5);
  CHECK(failures[1].status == "not_converged");
  CHECK(failures[1].reason == "singular matrix");
  CHECK(failures[2].reason == "an unknown error");
  CHECK(run_sweep(study_of(50, 1), moody(milliseconds(0)), folder.path / "a.db").solved == 0);
}

TEST_CASE("the table does not depend on the number of threads", "[studies][sweep]") {
  const TemporaryDirectory folder;
  for (const int jobs : {1, 8})
    run_sweep(study_of(100), moody(milliseconds(0)), folder.path / std::to_string(jobs), {.jobs = jobs});
  CHECK(rows(folder.path / "1", "speed and load").size() == 200);
  CHECK(rows(folder.path / "1", "speed and load") == rows(folder.path / "8", "speed and load"));
}

TEST_CASE("a wrong point is found before the first one is solved or stored", "[studies][sweep]") {
  const TemporaryDirectory folder;
  Study study = study_of(3);
  study.axes[0].values.back() = -1;
  bool called = false;
  const std::string message = message_of([&] {
    run_sweep(
        study,
        [&](const RollingScene& scene) {
          called = true;
          return closed_form(scene);
        },
        folder.path / "a.db");
  });
  CHECK(message.find("speed = -1") != std::string::npos);
  CHECK_FALSE(called);
  CHECK_FALSE(std::filesystem::exists(folder.path / "a.db"));
}

TEST_CASE("a sweep killed at any moment and started again has each point once and none lost", "[studies][sweep]") {
  const TemporaryDirectory folder;
  const Study study = study_of(150);
  run_sweep(study, moody(milliseconds(0)), folder.path / "undisturbed");
  const auto file = folder.path / "killed";
  std::mt19937 random(20130501);
  std::uniform_int_distribution<int> moment(0, 40000);
  int before = 0;
  for (int kill_number = 0; kill_number < 12; ++kill_number) {
    const pid_t child =
        in_child([&] { run_sweep(study, moody(milliseconds(1)), file, {.jobs = 2, .grouping = milliseconds(3)}); });
    usleep(static_cast<useconds_t>(moment(random)));
    kill(child, SIGKILL);
    wait_for(child);
    if (!std::filesystem::exists(file) || std::filesystem::file_size(file) == 0) continue;
    const int now = message_of([&] { open_database(file, Access::read); }) == "nothing"
                        ? count(file, "SELECT count(*) FROM evaluation")
                        : 0;
    CHECK(now >= before);
    before = now;
  }
  const SweepReport last = run_sweep(study, moody(milliseconds(0)), file);
  CHECK(last.solved == 300 - static_cast<std::size_t>(before));
  CHECK(last.study.answered == 300);
  CHECK(rows(file, study.name) == rows(folder.path / "undisturbed", study.name));
  CHECK(count(file, "SELECT count(*) FROM evaluation") == 300);
  SQLite::Database plain(file.string());
  CHECK(plain.execAndGet("PRAGMA integrity_check").getString() == "ok");
}

TEST_CASE("each answer is stored while the next point is being solved", "[studies][sweep]") {
  const TemporaryDirectory folder;
  const auto file = folder.path / "a.db";
  int solved = 0;
  bool stored_in_time = true;
  const Evaluate patient = [&](const RollingScene& scene) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (solved > 0 && count(file, "SELECT count(*) FROM evaluation") < solved && stored_in_time) {
      std::this_thread::sleep_for(milliseconds(1));
      stored_in_time = std::chrono::steady_clock::now() < deadline;
    }
    ++solved;
    return closed_form(scene);
  };
  CHECK(run_sweep(study_of(5), patient, file, {.jobs = 1}).solved == 10);
  CHECK(stored_in_time);
}

TEST_CASE("after a stop signal is waited for, signals are whose they were", "[studies][sweep]") {
  std::signal(SIGTERM, SIG_IGN);
  { const StopSignal stop; }
  CHECK(std::signal(SIGTERM, SIG_DFL) == SIG_IGN);
}

TEST_CASE("a stop signal that comes twice at once is one, and another one later ends the program", "[studies][sweep]") {
  const pid_t child = in_child([] {
    const StopSignal stop;
    std::raise(SIGINT);
    std::raise(SIGINT);  // as timeout sends it: to the process, and to its group
    if (!StopSignal::requested()) _exit(3);
    std::this_thread::sleep_for(milliseconds(400));
    std::raise(SIGINT);
    _exit(4);
  });
  const int status = wait_for(child);
  REQUIRE(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGINT);
}

TEST_CASE("a stop signal ends a sweep after the points in work, and the next run does the rest", "[studies][sweep]") {
  const TemporaryDirectory folder;
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto file = folder.path / std::to_string(signal);
    int pipe_ends[2];
    REQUIRE(pipe(pipe_ends) == 0);
    const pid_t child = in_child([&] {
      const StopSignal stop;
      std::atomic<int> solved = 0;
      const SweepReport report = run_sweep(study_of(50),
                                           [&](const RollingScene& scene) {
                                             std::this_thread::sleep_for(milliseconds(2));
                                             if (++solved == 10 && write(pipe_ends[1], "x", 1) != 1) _exit(2);
                                             return closed_form(scene);
                                           },
                                           file, {.jobs = 2, .stop = &stop.requested()});
      const bool clean = report.interrupted && report.solved == static_cast<std::size_t>(solved) &&
                         report.study.answered == solved && solved < 100;
      if (!clean) _exit(3);
    });
    char letter = 0;
    REQUIRE(read(pipe_ends[0], &letter, 1) == 1);
    kill(child, signal);
    const int status = wait_for(child);
    close(pipe_ends[0]);
    close(pipe_ends[1]);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    const SweepReport rest = run_sweep(study_of(50), closed_form, file);
    CHECK(rest.recalled >= 10);
    CHECK(rest.recalled + rest.solved == 100);
  }
}

TEST_CASE("two processes on one study and one file store each point once", "[studies][sweep]") {
  const TemporaryDirectory folder;
  const auto file = folder.path / "shared";
  const Study study = study_of(200, 1);
  run_sweep(study, moody(milliseconds(0)), folder.path / "alone");
  int pipe_ends[2];
  REQUIRE(pipe(pipe_ends) == 0);
  std::vector<pid_t> children;
  for (int i = 0; i < 2; ++i)
    children.push_back(in_child([&] {
      const SweepReport report =
          run_sweep(study, moody(milliseconds(3)), file, {.jobs = 2, .grouping = milliseconds(5)});
      if (report.study.answered != 200) _exit(2);
      if (write(pipe_ends[1], &report.solved, sizeof report.solved) < 0) _exit(3);
    }));
  close(pipe_ends[1]);
  for (const pid_t child : children) CHECK(wait_for(child) == 0);
  std::size_t one = 0, two = 0;
  REQUIRE(read(pipe_ends[0], &one, sizeof one) == sizeof one);
  REQUIRE(read(pipe_ends[0], &two, sizeof two) == sizeof two);
  close(pipe_ends[0]);
  CHECK(one + two >= 200);
  CHECK(rows(file, study.name) == rows(folder.path / "alone", study.name));
  CHECK(count(file, "SELECT count(*) FROM evaluation") == 200);
}

TEST_CASE("readers in a loop never make a sweep fail", "[studies][sweep]") {
  const TemporaryDirectory folder;
  const auto file = folder.path / "a.db";
  { ResultStore created(file); }
  std::atomic<bool> done = false;
  std::atomic<int> read = 0;
  std::vector<std::string> trouble;
  std::thread reader([&] {
    while (!done) {
      const std::string message = message_of([&] { run_query(open_database(file, Access::read), {}); });
      if (message != "nothing") trouble.push_back(message);
      ++read;
    }
  });
  const SweepReport report =
      run_sweep(study_of(100), moody(milliseconds(1)), file, {.jobs = 2, .grouping = milliseconds(1)});
  done = true;
  reader.join();
  CHECK(report.study.answered == 200);
  CHECK(read > 0);
  CHECK(trouble == std::vector<std::string>{});
}

TEST_CASE("a full disk ends a sweep with a message, and what was stored stays", "[studies][sweep]") {
  const TemporaryDirectory folder;
  const auto file = folder.path / "a.db";
  const pid_t child = in_child([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{512 * 1024, 512 * 1024};  // no file may grow beyond
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string message =
        message_of([&] { run_sweep(study_of(2000), closed_form, file, {.jobs = 2, .grouping = milliseconds(1)}); });
    if (!message.starts_with(file.string() + ": ") || message.find("disk") == std::string::npos) _exit(2);
  });
  const int status = wait_for(child);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  const SweepReport rest = run_sweep(study_of(2000), closed_form, file);
  CHECK(rest.recalled + rest.solved == 4000);
}

TEST_CASE("a sweep says that it is ready when its points are recorded and none is solved", "[studies][sweep]") {
  const TemporaryDirectory directory;
  const auto file = directory.path / "results.db";
  int told = 0;
  SweepOptions options;
  options.ready = [&] {
    ++told;
    CHECK(count(file, "SELECT count(*) FROM study_point") == 6);
    CHECK(count(file, "SELECT count(*) FROM evaluation") == 0);
  };
  CHECK(run_sweep(study_of(3), moody(milliseconds(0)), file, options).answered == 6);
  CHECK(told == 1);
}

TEST_CASE("a study that another process deletes, renames or defines anew meanwhile is told, its answers are stored",
          "[studies][sweep]") {
  const std::pair<std::string, std::string> changes[] = {
      {"DELETE FROM study", "was deleted by another process"},
      {"UPDATE study SET name = 'theirs'", "was renamed to theirs by another process"},
      {"DELETE FROM study_point WHERE position > 4", "was defined anew, without 2 of its points, by another process"}};
  for (const auto& [change, words] : changes) {
    const TemporaryDirectory folder;
    const std::filesystem::path file = folder / "a.db";
    SweepOptions options;
    options.ready = [&] {
      SQLite::Database other(file.string(), SQLite::OPEN_READWRITE, 10'000);
      other.exec("PRAGMA foreign_keys = ON");
      other.exec(change);
    };
    const std::string message = message_of([&] { run_sweep(study_of(3), closed_form, file, options); });
    CHECK(message.find(file.string() + ": study = speed and load: " + words) == 0);
    CHECK(count(file, "SELECT count(*) FROM evaluation") == 6);
  }
}
