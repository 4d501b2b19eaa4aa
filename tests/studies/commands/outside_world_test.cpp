#include <SQLiteCpp/SQLiteCpp.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

#include "db/rows/result_store.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

/// A database of a study of so many points in a folder of its own.
class World {
 public:
  explicit World(int points = 6) { write_study(points); }
  void write_study(int points) const {
    std::string speeds;
    for (int i = 1; i <= points; ++i) speeds += (i > 1 ? ", " : "") + std::to_string(i);
    folder.write("study.json", R"({"study": "speeds", "scene": {"indenter": "cylinder", "radius": 0.1,
      "layer_thickness": 0.01, "static_shear_modulus": 1e6, "stiffening": 2, "creep_time": 0.1,
      "friction_coefficient": 0.3, "speed": 1, "load": 1e4}, "axes": {"speed": [)" +
                                   speeds + "]}}");
  }
  std::string file() const { return (folder / "a.db").string(); }
  std::string study() const { return (folder / "study.json").string(); }
  ProgramRun sweep() const { return run_rollres({"sweep", study(), "--db", file()}, closed_form); }
  int files_beside() const {
    return static_cast<int>(std::filesystem::exists(file() + "-wal")) +
           static_cast<int>(std::filesystem::exists(file() + "-shm"));
  }

  /// Every command that reads the database, and what it is to print.
  std::vector<std::vector<std::string>> readings() const {
    return {{"list", "--db", file()},
            {"show", "speeds", "--db", file()},
            {"show", "1", "--db", file()},
            {"query", "--db", file(), "speed>2", "--sort=-rolling_resistance", "--limit", "2"},
            {"query", "--db", file(), "--aggregate", "count"},
            {"query", "--db", file(), "--sql", "SELECT * FROM resistance"},
            {"compare", "speeds", "speeds", "--db", file()}};
  }

  TemporaryDirectory folder;
};

/// What a child without root's rights that runs `work` returns.
template <class Work>
int without_rights(Work&& work) {
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && seteuid(65534) != 0) _exit(99);
    _exit(work());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 98;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word + " ";
  return text;
}

}  // namespace

TEST_CASE("no command leaves the log or its index beside the database", "[studies][outside_world]") {
  const World world;
  CHECK(world.sweep().status == 0);
  CHECK(world.files_beside() == 0);
  for (const auto& words : world.readings()) {
    INFO(joined(words));
    CHECK(run_rollres(words, closed_form).status == 0);
    CHECK(world.files_beside() == 0);
  }
}

TEST_CASE("reading needs no right to write: neither the file nor its folder changes", "[studies][outside_world]") {
  const World world;
  world.sweep();
  const std::string before = file_text(world.file());
  struct Rights {
    mode_t file, folder;
  };
  for (const Rights rights : {Rights{0444, 0555}, Rights{0666, 0555}}) {
    chmod(world.file().c_str(), rights.file);
    chmod(world.folder.path.c_str(), rights.folder);
    const int wrong = without_rights([&] {
      int number = 0;
      for (const auto& words : world.readings()) {
        ++number;
        const ProgramRun run = run_rollres(words, closed_form);
        if (run.status != 0 || run.out.empty()) {
          std::fprintf(stderr, "%s\n%s", joined(words).c_str(), run.err.c_str());
          return number;
        }
      }
      const ProgramRun refused = world.sweep();
      return refused.status == ExitStatus::failure && refused.err.starts_with("rollres: " + world.file() + ": ") ? 0
                                                                                                                 : 97;
    });
    CHECK(wrong == 0);
    chmod(world.folder.path.c_str(), 0755);
    CHECK(file_text(world.file()) == before);
    CHECK(world.files_beside() == 0);
  }
}

TEST_CASE("every command refuses a newer, a foreign and a damaged database in one line, and leaves it as it was",
          "[studies][outside_world]") {
  const World world;
  world.sweep();
  const std::string good = file_text(world.file());
  auto commands = world.readings();
  commands.push_back({"sweep", world.study(), "--db", world.file(), "--retry", "all"});
  auto refuses = [&](const std::string& message) {
    const std::string before = file_text(world.file());
    for (const auto& words : commands) {
      INFO(joined(words));
      const ProgramRun run = run_rollres(words, closed_form);
      CHECK(run.status == ExitStatus::failure);
      CHECK(run.out.empty());
      CHECK(run.err.starts_with("rollres: " + world.file() + ": " + message));
      CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
      CHECK(file_text(world.file()) == before);
    }
  };
  SQLite::Database(world.file(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 999");
  refuses("written by a newer version of rollres (schema 999");
  world.folder.write("a.db", good);
  SQLite::Database(world.file(), SQLite::OPEN_READWRITE).exec("PRAGMA application_id = 7");
  refuses("an SQLite database, but not one of rollres");
  world.folder.write("a.db", good.substr(0, 100) + std::string(good.size() - 100, '\x5a'));
  refuses("database disk image is malformed");
  world.folder.write("a.db", good.substr(0, 4096));
  refuses("database disk image is malformed");
  world.folder.write("a.db", std::string(8192, '\0'));
  refuses("file is not a database");
}

TEST_CASE("a full disk ends the sweep with exit status 3, and the next one goes on", "[studies][outside_world]") {
  const World world;
  world.sweep();
  world.write_study(3000);
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{512 * 1024, 512 * 1024};  // no file may grow beyond
    setrlimit(RLIMIT_FSIZE, &small);
    const ProgramRun run = world.sweep();
    const bool clear = run.err.starts_with("rollres: " + world.file() + ": ") &&
                       run.err.find("disk") != std::string::npos && run.out.empty();
    if (!clear) std::fprintf(stderr, "%s", run.err.c_str());
    _exit(clear ? run.status : 99);
  }
  int ended = 0;
  waitpid(child, &ended, 0);
  REQUIRE(WIFEXITED(ended));
  CHECK(WEXITSTATUS(ended) == ExitStatus::failure);
  const auto stored = ResultStore(world.file(), Access::read).study("speeds");
  REQUIRE(stored);
  CHECK(stored->answered >= 6);
  const ProgramRun rest = world.sweep();
  CHECK(rest.status == 0);
  CHECK(rest.out.find("3000 of 3000 points") != std::string::npos);
  CHECK(rest.out.find(std::to_string(stored->answered) + " recalled") != std::string::npos);
}

TEST_CASE("commands that read in a loop, in another process, never disturb a sweep", "[studies][outside_world]") {
  const World world(400);
  { ResultStore created(world.file()); }
  int gate[2];
  REQUIRE(pipe(gate) == 0);
  const pid_t reader = fork();
  if (reader == 0) {
    close(gate[1]);
    const std::vector<std::vector<std::string>> readings{
        {"list", "--db", world.file()},
        {"query", "--db", world.file(), "--limit", "5"},
        {"query", "--db", world.file(), "--aggregate", "count, mean speed", "--by", "status"}};
    fd_set ends;
    timeval none{};
    do {
      for (const auto& words : readings)
        if (const ProgramRun run = run_rollres(words, closed_form); run.status > ExitStatus::no_answer) {
          std::fprintf(stderr, "%s", run.err.c_str());
          _exit(1);
        }
      FD_ZERO(&ends);
      FD_SET(gate[0], &ends);
    } while (select(gate[0] + 1, &ends, nullptr, nullptr, &none) == 0);  // until the other end is closed
    _exit(0);
  }
  close(gate[0]);
  for (int round = 0; round < 5; ++round) {
    const ProgramRun run =
        run_rollres({"sweep", world.study(), "--db", world.file(), "--retry", "all", "--jobs", "2"}, closed_form);
    CHECK(run.status == 0);
    CHECK(run.err.empty());
  }
  close(gate[1]);
  int status = 0;
  waitpid(reader, &status, 0);
  CHECK(status == 0);
}

TEST_CASE("the sqlite3 shell opens the database without this program", "[studies][outside_world]") {
  const World world;
  world.sweep();
  if (std::system("command -v sqlite3 > /dev/null 2>&1") != 0) {
    WARN("the sqlite3 shell is not installed: not tested");
    return;
  }
  const std::string out = (world.folder / "out").string();
  const std::string command =
      "sqlite3 -readonly '" + world.file() +
      "' 'SELECT study, position, speed, rolling_resistance > 0 FROM resistance WHERE speed < 3 "
      "ORDER BY position; PRAGMA integrity_check' > '" +
      out + "' 2>&1";
  CHECK(std::system(command.c_str()) == 0);
  CHECK(file_text(out) == "speeds|1|1.0|1\nspeeds|2|2.0|1\nok\n");
}
