#include <algorithm>

#include "studies/text/strict_json.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/stored_rows.hpp"
#include "tests/studies/temporary_directory.hpp"
#include "tests/studies/with_variable.hpp"

// Covers export_study, standalone_study, command_merge, command_status and command_slurm, too.

using namespace rollres;
namespace {

/// A study of 20 points whose scene is a file of its own.
struct Shards {
  TemporaryDirectory folder;
  std::string study;

  Shards() {
    folder.write("scene.json", R"({"indenter": "cylinder", "radius": "10 cm", "layer_thickness": "infinite",
      "static_shear_modulus": "1 MPa", "stiffening": 2, "creep_time": 0.1, "friction_coefficient": 0.3, "speed": 1,
      "load": 1})");
    study = folder
                .write("study.json", R"({"study": "speeds", "scene": "scene.json",
      "axes": {"speed": {"from": 1, "to": 10, "points": 10}, "load": ["10 kN/m", "20 kN/m"]}})")
                .string();
  }
  std::string file(const std::string& name) const { return (folder / name).string(); }
  ProgramRun run(const std::vector<std::string>& words) const { return run_rollres(words, closed_form); }
  ProgramRun shard(int index) const {
    const std::string number = std::to_string(index);
    return run({"sweep", study, "--shard", number + "/3", "--db", file("shard-" + number)});
  }
};

}  // namespace

TEST_CASE("shards, status and merge go together on the command line", "[studies][commands]") {
  const Shards shards;
  const ProgramRun one = shards.shard(1);
  CHECK(one.status == 0);
  CHECK(one.out.starts_with("speeds, shard 1/3: 7 of 7 points in "));
  CHECK(shards.shard(3).status == 0);
  const ProgramRun status = shards.run({"status", shards.study, "--db", shards.file("shard-1"), "--db",
                                        shards.file("shard-2"), "--db", shards.file("shard-3"), "--shards", "3"});
  CHECK(status.status == ExitStatus::no_answer);
  CHECK(status.err == shards.file("shard-2") + ": no such file, counted as empty\n");
  CHECK(status.out.starts_with("speeds: 13 of 20 points answered, 0 of them failed; 7 missing, about "));
  CHECK(status.out.ends_with("shards with points missing: 2 of 3\n"));
  CHECK(shards.run({"status", shards.study, "--shards", "3", "--array"}).out == "1-3\n");

  const std::vector<std::string> merge{"merge", shards.file("shard-1"), shards.file("shard-2"), shards.file("shard-3"),
                                       "--db",  shards.file("all")};
  const ProgramRun lacking = shards.run(merge);
  CHECK(lacking.status == ExitStatus::failure);
  CHECK(lacking.err == "rollres: " + shards.file("shard-2") + ": no such file\n");
  CHECK(lacking.out.find("13 evaluations in 2 of 3 databases: 13 new, 0 replaced") != std::string::npos);
  CHECK(shards.shard(2).status == 0);
  CHECK(shards.run(merge).out.find("20 evaluations in 3 of 3 databases: 7 new, 0 replaced, 13 there already, 0 in "
                                   "conflict") != std::string::npos);
  const ProgramRun complete = shards.run({"status", shards.study, "--db", shards.file("all"), "--json"});
  CHECK(complete.status == 0);
  CHECK(Json::parse(complete.out)["converged"] == 20);
  CHECK(Json::parse(complete.out)["missing"] == 0);
}

TEST_CASE("a sweep takes its shard from a queue and says so", "[studies][commands]") {
  const Shards shards;
  std::vector<std::string> words{"sweep", shards.study, "--shard", "auto/3", "--db", shards.file("shard")};
  const WithVariable task("PBS_ARRAY_INDEX", "2");
  const ProgramRun one = shards.run(words);
  CHECK(one.status == 0);
  CHECK(one.err == "shard 2/3 by PBS_ARRAY_INDEX = 2\n");
  CHECK(one.out.starts_with("speeds, shard 2/3: 7 of 7 points in "));
  words.push_back("--json");
  CHECK(Json::parse(shards.run(words).out)["shard"] == "2/3");
  const WithVariable outside("PBS_ARRAY_INDEX", "4");
  const ProgramRun refused = shards.run(words);
  CHECK(refused.status == ExitStatus::wrong_input);
  CHECK(refused.err == "rollres: shard = auto/3: PBS_ARRAY_INDEX = 4: must be from 1 to 3\n");
}

TEST_CASE("merge names a conflict, keeps the first result and ends with status 1", "[studies][commands]") {
  const Shards shards;
  shards.shard(1);
  run_rollres({"sweep", shards.study, "--db", shards.file("other")}, [](const RollingScene& scene) {
    RollingSolution solution = closed_form(scene);
    if (scene.speed > 9) solution.rolling_resistance *= 2;
    return solution;
  });
  run_rollres({"sweep", shards.study, "--db", shards.file("all")}, closed_form);
  const auto before = stored_rows(shards.file("all"), "speeds");
  const ProgramRun merged =
      shards.run({"merge", shards.file("shard-1"), shards.file("other"), "--db", shards.file("all")});
  CHECK(merged.status == ExitStatus::no_answer);
  CHECK(merged.out.find("2 in conflict") != std::string::npos);
  CHECK(merged.err.find("rolling_resistance = ") != std::string::npos);
  CHECK(merged.err.find(" is kept\n") != std::string::npos);
  CHECK(stored_rows(shards.file("all"), "speeds") == before);
}

TEST_CASE("an exported study stands alone and can be imported elsewhere, twice with no effect", "[studies][commands]") {
  const Shards shards;
  shards.run({"sweep", shards.study, "--db", shards.file("all")});
  const ProgramRun exported =
      shards.run({"export", "--study", "speeds", "--db", shards.file("all"), "--out", shards.file("out")});
  CHECK(exported.status == 0);
  CHECK(exported.err.empty());
  std::filesystem::remove(shards.folder / "scene.json");
  const auto out = shards.folder / "out";
  CHECK(Json::parse(file_text(out / "study.json"))["scene"]["radius"] == "10 cm");
  const std::string csv = file_text(out / "results.csv");
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 21);
  CHECK(Json::parse(file_text(out / "provenance.json"))["programs"][0]["points"] == 20);
  CHECK(file_text(out / "README.txt").find("results.csv") != std::string::npos);
  for (const char* const changed : {"20 new, 0 replaced, 0 there already", "0 new, 0 replaced, 20 there already"})
    CHECK(shards.run({"import", out.string(), "--db", shards.file("elsewhere")}).out.find(changed) !=
          std::string::npos);
  CHECK(stored_rows(shards.file("elsewhere"), "speeds") == stored_rows(shards.file("all"), "speeds"));
  CHECK(shards.run({"status", (out / "study.json").string(), "--db", shards.file("elsewhere")}).status == 0);

  CHECK(shards.run({"export", "--study", "none", "--db", shards.file("all"), "--out", shards.file("no")}).status ==
        ExitStatus::wrong_input);
  CHECK(shards.run({"import", shards.file("no"), "--db", shards.file("elsewhere")}).status == ExitStatus::failure);
}

TEST_CASE("slurm writes scripts that stand alone and refuses the folder of another study", "[studies][commands]") {
  const Shards shards;
  const std::vector<std::string> words{
      "slurm",   shards.study,  "--tasks", "8",    "--throttle",       "3",     "--time",
      "1:00:00", "--partition", "long",    "--db", shards.file("all"), "--out", shards.file("jobs")};
  const ProgramRun written = shards.run(words);
  CHECK(written.status == 0);
  CHECK(written.out.starts_with("speeds: 20 points, about "));
  const auto jobs = shards.folder / "jobs";
  CHECK(file_text(jobs / "array.sh").find("#SBATCH --time='1:00:00'\n#SBATCH --partition='long'\n") !=
        std::string::npos);
  CHECK(file_text(jobs / "submit.sh").find("--array=\"$missing%3\"") != std::string::npos);
  CHECK(Json::parse(file_text(jobs / "study.json"))["scene"].is_object());
  CHECK(shards.run(words).status == 0);
  shards.folder.write("study.json", R"({"study": "others", "scene": "scene.json", "axes": {"speed": [1, 2]}})");
  const ProgramRun other = shards.run(words);
  CHECK(other.status == ExitStatus::wrong_input);
  CHECK(other.err.find("holds the scripts of another study") != std::string::npos);
  CHECK(shards.run({"slurm", shards.study, "--tasks", "0", "--db", "a", "--out", "b"}).status ==
        ExitStatus::wrong_input);
}
