#include "studies/charts/live_view.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

const std::string study_text = R"({"study": "watched",
  "scene": {"radius": 0.1, "layer_thickness": "infinite", "static_shear_modulus": 1e6, "material": "elastic"},
  "axes": {"load": ["10 kN/m", "20 kN/m"], "speed": {"from": 0.1, "to": 10, "points": 8, "spacing": "logarithmic"}}})";

RollingSolution fails_when_fast(const RollingScene& scene) {
  if (scene.speed > 9) throw std::runtime_error("singular matrix");
  return closed_form(scene);
}

RollingSolution slow(const RollingScene& scene) {
  std::this_thread::sleep_for(std::chrono::milliseconds(15));
  return fails_when_fast(scene);
}

}  // namespace

TEST_CASE("a view tells how far a study is, what failed, and draws its curves", "[studies][charts][live_view]") {
  const TemporaryDirectory folder;
  const std::string database = folder / "a.db";
  run_rollres({"sweep", folder.write("study.json", study_text).string(), "--db", database}, fails_when_fast);
  ResultStore store(database, Access::read);
  const LiveProgress progress = live_progress(store, "", 2e9);
  CHECK(progress.done());
  CHECK(in_words(progress) == "watched: 16 of 16 answered, 2 failed");
  const std::string view = live_view(store, progress, 60, 24);
  CHECK_THAT(view, Contains("2 x not_converged: singular matrix") && Contains("rolling_resistance [") &&
                       Contains("speed [m/s]") && Contains("a 10 kN/m  b 20 kN/m"));
  LiveProgress early = progress;
  early.study.answered = 4;
  early.rate = 2;
  early.since_last = 1;
  CHECK(in_words(early) == "watched: 4 of 16 answered, 2 failed, 2/s, 6 s left");
  early.rate = 0;
  early.since_last = 75;
  CHECK(in_words(early) == "watched: 4 of 16 answered, 2 failed, the newest 1:15 ago");
}

TEST_CASE("a sweep in another process is followed to its end", "[studies][charts][live_view]") {
  const TemporaryDirectory folder;
  const std::string database = folder / "a.db", study = folder.write("study.json", study_text).string();
  { ResultStore store(database); }
  run_rollres({"sweep", study, "--db", database, "--shard", "1/16"}, fails_when_fast);  // the study stands there
  const pid_t sweep = fork();
  if (sweep == 0) {
    run_rollres({"sweep", study, "--db", database, "--jobs", "1"}, slow);
    _exit(0);
  }
  const ProgramRun followed = run_rollres({"status", "--db", database, "--follow", "--every", "0.02"}, closed_form);
  int status = 0;
  waitpid(sweep, &status, 0);
  CHECK(followed.status == 0);
  CHECK_THAT(followed.out, Contains("of 16 answered, ") && Contains(" left\n"));
  CHECK(followed.out.ends_with("watched: 16 of 16 answered, 2 failed\n"));
  CHECK(std::count(followed.out.begin(), followed.out.end(), '\n') >= 3);
}

TEST_CASE("following needs one database and a study in it", "[studies][charts][live_view]") {
  CHECK(run_rollres({"status", "--follow"}, closed_form).err == "rollres: --follow: needs one --db\n");
  const TemporaryDirectory folder;
  const std::string database = folder / "a.db";
  { ResultStore store(database); }
  CHECK(run_rollres({"status", "--follow", "--db", database}, closed_form).err ==
        "rollres: " + database + ": holds no study\n");
}
