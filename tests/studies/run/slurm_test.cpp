#include "db/rows/result_store.hpp"
#include "studies/program/commands.hpp"
#include "studies/run/slurm_scripts.hpp"
#include "studies/text/words.hpp"
#include "tests/catch.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/one_node_slurm.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/stored_rows.hpp"
#include "tests/studies/with_variable.hpp"

using namespace rollres;

namespace {

const char* const both_bodies = R"({"study": "both bodies", "scene":
  {"indenter": "sphere", "radius": "2 cm", "layer_thickness": "5 mm", "static_shear_modulus": "3 MPa", "stiffening": 1,
   "creep_time": "0.25 s", "speed": "5 cm/s", "load": 300, "friction_coefficient": 0.2, "spacing": "0.25 mm"},
  "axes": {"indenter": ["sphere", "cylinder"], "load": [1200, 2000],
           "speed": {"from": "1 mm/s", "to": "10 m/s", "points": 3, "spacing": "logarithmic"}}})";

/// Some tenths of a second for each point.
const char* const slow = R"({"study": "slow", "scene":
  {"indenter": "sphere", "radius": "2 cm", "layer_thickness": "5 mm", "static_shear_modulus": "3 MPa", "stiffening": 1,
   "creep_time": "0.25 s", "speed": "5 cm/s", "load": 150, "friction_coefficient": 0.2, "spacing": "0.08 mm"},
  "axes": {"speed": {"from": "1 cm/s", "to": "1 m/s", "points": 7, "spacing": "logarithmic"}}})";

std::size_t answered(const std::filesystem::path& file, const std::string& study) {
  if (!std::filesystem::exists(file)) return 0;
  return static_cast<std::size_t>(ResultStore(file, Access::read).study(study).value_or(StudySummary{}).answered);
}

}  // namespace

TEST_CASE("a word of the shell is what it was, whatever stands in it", "[studies][slurm]") {
  for (const std::string text : {"plain", "two words", "it's", "$HOME `ls` \"quoted\" \\n *"})
    CHECK(run_shell("printf %s " + shell_word(text)).out == text);
}

TEST_CASE("a Slurm array gives the table of one process, resubmits what is missing, and saves what is solved in time",
          "[studies][slurm][long]") {
  const TemporaryDirectory folder;
  OneNodeSlurm cluster;
  if (!cluster.trouble.empty()) {
    WARN("skipped: " << cluster.trouble);
    return;
  }
  std::filesystem::create_directories(folder / "a scratch");
  const WithVariable scratch_folder("TMPDIR", folder / "a scratch");
  const auto database = folder / "all results.db", jobs = folder / "jobs of it";
  const std::string submit = "sh " + shell_word((jobs / "submit.sh").string());
  const auto write_scripts = [&](const std::filesystem::path& study, const std::string& tasks) {
    std::filesystem::remove_all(jobs);
    return run_rollres({"slurm", study.string(), "--tasks", tasks, "--throttle", "2", "--time", "10", "--db",
                        database.string(), "--out", jobs.string(), "--program", rollres_program()},
                       solve)
        .status;
  };

  const auto study = folder.write("study.json", both_bodies);
  REQUIRE(run_rollres({"sweep", study.string(), "--db", (folder / "alone.db").string()}, solve).status == 0);
  const auto alone = stored_rows(folder / "alone.db", "both bodies");
  REQUIRE(alone.size() == 12);
  REQUIRE(write_scripts(study, "4") == 0);
  const ShellRun first = run_shell(submit);
  CAPTURE(first.out);
  REQUIRE(first.out.starts_with("submitted shards 1-4 as job "));
  CHECK(run_shell(submit).out.starts_with("still in the queue"));
  REQUIRE(cluster.wait_until_empty(patience(30)));
  CAPTURE(run_shell("cat " + shell_word(jobs.string()) + "/logs/*").out);
  REQUIRE(std::filesystem::exists(database));
  CHECK(stored_rows(database, "both bodies") == alone);
  const ShellRun complete = run_shell(submit);
  CHECK(complete.status == 0);
  CHECK(complete.out.find("0 missing") != std::string::npos);

  std::filesystem::remove(jobs / "shards" / "3.db");
  std::filesystem::remove(database);
  CHECK(run_shell(submit).out.starts_with("submitted shards 3 as job "));
  REQUIRE(cluster.wait_until_empty(patience(30)));
  CHECK(stored_rows(database, "both bodies") == alone);

  REQUIRE(write_scripts(folder.write("slow.json", slow), "1") == 0);
  REQUIRE(run_shell(submit).status == 0);
  const auto solving = [&] {
    for (const auto& scratch : std::filesystem::directory_iterator(folder / "a scratch"))
      if (answered(scratch.path() / "shard.db", "slow") >= 2) return true;
    return false;
  };
  REQUIRE(cluster.within(20, [&] {
    try {
      return solving();
    } catch (const std::exception&) {
      return false;
    }
  }));
  run_shell("scancel --batch --signal=TERM $(cut -d, -f1 " + shell_word((jobs / "jobs").string()) + ")");
  REQUIRE(cluster.wait_until_empty(patience(30)));
  const std::size_t saved = answered(jobs / "shards" / "1.db", "slow");
  CHECK(saved >= 2);
  CHECK(saved < 7);
  CHECK(answered(database, "slow") == saved);
  CHECK(std::filesystem::is_empty(folder / "a scratch"));
  CHECK(run_shell(submit).out.starts_with("submitted shards 1 as job "));
  REQUIRE(cluster.wait_until_empty(patience(60)));
  CHECK(answered(database, "slow") == 7);
}
