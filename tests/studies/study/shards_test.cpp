#include "studies/study/shards.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "db/merge/merge.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/run/sweep.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/study/predicted_cost.hpp"
#include "studies/text/words.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/shell.hpp"
#include "tests/studies/stored_rows.hpp"
#include "tests/studies/temporary_directory.hpp"
#include "tests/studies/with_variable.hpp"

using namespace rollres;

namespace {

/// Quick cylinders and spheres on grids from coarse to fine: seconds from 1e-3 to 10.
std::vector<RollingScene> mixed_scenes(int count) {
  std::mt19937 random(20130501);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<RollingScene> scenes;
  for (int i = 0; i < count; ++i) {
    RollingScene scene = plain_scene(0.1 + i, 1e2);
    if (i % 3 > 0) scene.indenter = Indenter::sphere;
    if (i % 3 > 1) scene.spacing = 1e-4 * std::pow(10, part(random));
    scenes.push_back(scene);
  }
  return scenes;
}

std::vector<std::string> keys_of(const std::vector<RollingScene>& scenes) {
  std::vector<std::string> keys;
  for (const RollingScene& scene : scenes) keys.push_back(evaluation_key(scene));
  return keys;
}

std::vector<double> seconds_of(const std::vector<RollingScene>& scenes) {
  std::vector<double> seconds;
  for (const RollingScene& scene : scenes) seconds.push_back(predicted_seconds(scene));
  return seconds;
}

}  // namespace

TEST_CASE("shards hold every point once and are balanced to a third of the best", "[studies][shards]") {
  const std::vector<RollingScene> scenes = mixed_scenes(500);
  const std::vector<std::string> keys = keys_of(scenes);
  double all = 0, longest_point = 0;
  for (const RollingScene& scene : scenes) {
    all += predicted_seconds(scene);
    longest_point = std::max(longest_point, predicted_seconds(scene));
  }
  for (const int count : {1, 2, 16, 100}) {
    const std::vector<int> shards = shards_of_points(keys, seconds_of(scenes), count);
    CHECK(shards == shards_of_points(keys, seconds_of(scenes), count));
    REQUIRE(shards.size() == scenes.size());
    std::vector<double> load(static_cast<std::size_t>(count), 0.0);
    for (std::size_t i = 0; i < shards.size(); ++i) {
      REQUIRE(shards[i] >= 1);
      REQUIRE(shards[i] <= count);
      load[static_cast<std::size_t>(shards[i]) - 1] += predicted_seconds(scenes[i]);
    }
    // Costs are rounded to two digits, by no more than 5 %.
    const double best = std::max(all / count, longest_point);
    CHECK(*std::max_element(load.begin(), load.end()) <= 1.05 * 4 / 3 * best);
  }
}

TEST_CASE("points of one key share a shard, and more shards than points leave some empty", "[studies][shards]") {
  std::vector<RollingScene> scenes = mixed_scenes(10);
  scenes.insert(scenes.end(), scenes.begin(), scenes.begin() + 10);
  const std::vector<int> shards = shards_of_points(keys_of(scenes), seconds_of(scenes), 64);
  CHECK(std::equal(shards.begin(), shards.begin() + 10, shards.begin() + 10));
  CHECK(std::set<int>(shards.begin(), shards.end()).size() == 10);
}

TEST_CASE("a shard is named I/N, and numbers are listed as Slurm lists them", "[studies][shards]") {
  CHECK(parse_shard("3/16").index == 3);
  CHECK(parse_shard("3/16").count == 16);
  for (const char* const wrong : {"", "3", "0/3", "4/3", "a/3", "1/3x", "-1/3", "1/100001"})
    CHECK_THROWS_AS(parse_shard(wrong), std::invalid_argument);
  CHECK(array_list(std::vector<int>{}).empty());
  CHECK(array_list(std::vector<int>{3, 7, 8, 9, 11, 12, 14}) == "3,7-9,11,12,14");
}

namespace {

/// No task of a queue, whatever runs the tests.
struct NoQueue {
  WithVariable slurm{"SLURM_ARRAY_TASK_ID", ""}, pbs{"PBS_ARRAY_INDEX", ""}, sge{"SGE_TASK_ID", ""},
      lsf{"LSB_JOBINDEX", ""}, oar{"OAR_ARRAY_INDEX", ""}, kubernetes{"JOB_COMPLETION_INDEX", ""},
      aws{"AWS_BATCH_JOB_ARRAY_INDEX", ""};
};

}  // namespace

TEST_CASE("a queue's variable tells the shard, and shards by each are the rows of one process", "[studies][shards]") {
  const NoQueue nothing_set;
  const TemporaryDirectory folder;
  Study study{.name = "speeds", .base = plain_scene(), .axes = {{"speed"}}};
  for (int i = 0; i < 200; ++i) study.axes[0].values.push_back(0.1 * (i + 1));
  run_sweep(study, closed_form, folder / "alone");
  for (const auto& [name, first] : std::vector<std::pair<std::string, int>>{{"SLURM_ARRAY_TASK_ID", 1},
                                                                            {"PBS_ARRAY_INDEX", 1},
                                                                            {"SGE_TASK_ID", 1},
                                                                            {"LSB_JOBINDEX", 1},
                                                                            {"OAR_ARRAY_INDEX", 1},
                                                                            {"JOB_COMPLETION_INDEX", 0},
                                                                            {"AWS_BATCH_JOB_ARRAY_INDEX", 0}}) {
    INFO(name);
    std::size_t solved = 0;
    const Database all = open_database(folder / name, Access::write);
    for (int task = 0; task < 4; ++task) {
      const std::string value = std::to_string(first + task);
      const WithVariable set(name, value);
      const Shard shard = parse_shard("auto/4");
      CHECK(shard.index == task + 1);
      CHECK(shard.count == 4);
      CHECK(shard.variable == name + " = " + value);
      const auto file = folder / (name + value);
      solved += run_sweep(study, closed_form, file, {.jobs = 1, .shard = shard}).solved;
      CHECK(merge(all, file).conflicts.empty());
    }
    CHECK(solved == 200);
    CHECK(stored_rows(folder / name, study.name) == stored_rows(folder / "alone", study.name));
    for (const int outside : {first - 1, first + 4}) {
      if (name == "LSB_JOBINDEX" && outside == 0) continue;  // no array
      const WithVariable set(name, std::to_string(outside));
      CHECK_THROWS_WITH(parse_shard("auto/4"), "shard = auto/4: " + name + " = " + std::to_string(outside) +
                                                   ": must be from " + std::to_string(first) + " to " +
                                                   std::to_string(first + 3));
    }
    const WithVariable wrong(name, "1x");
    CHECK_THROWS_AS(parse_shard("auto/4"), std::invalid_argument);
  }
}

TEST_CASE("without a queue's index, or with two, a shard is refused", "[studies][shards]") {
  const NoQueue nothing_set;
  CHECK_THROWS_WITH(parse_shard("auto/4"),
                    Catch::Matchers::Contains("no queue tells the index of a task (SLURM_ARRAY_TASK_ID, ") &&
                        Catch::Matchers::EndsWith("submit an array of jobs, or give I/N"));
  for (const char* const wrong : {"auto", "auto/", "auto/0", "auto/x", "auto/100001", "Auto/4"})
    CHECK_THROWS_WITH(parse_shard(wrong), Catch::Matchers::Contains("must be I/N or auto/N"));
  const WithVariable no_array("SGE_TASK_ID", "undefined"), none_either("LSB_JOBINDEX", "0");
  CHECK_THROWS_WITH(parse_shard("auto/4"), Catch::Matchers::Contains("no queue tells"));
  const WithVariable slurm("SLURM_ARRAY_TASK_ID", "3");
  const WithVariable same("JOB_COMPLETION_INDEX", "2");
  CHECK(parse_shard("auto/4").variable == "SLURM_ARRAY_TASK_ID = 3");
  CHECK(parse_shard("4/4").variable.empty());
  const WithVariable other("JOB_COMPLETION_INDEX", "1");
  CHECK_THROWS_WITH(
      parse_shard("auto/4"),
      Catch::Matchers::Contains("SLURM_ARRAY_TASK_ID = 3 and JOB_COMPLETION_INDEX = 1 are different tasks"));
}

TEST_CASE("shards by GNU parallel, as the guide has them, merge to the table of one process", "[studies][shards]") {
  if (!installed("parallel")) {
    WARN("GNU parallel is not installed");
    return;
  }
  const TemporaryDirectory folder;
  folder.write("study.json", R"({"study": "speeds", "scene": {"radius": "2 cm", "layer_thickness": "5 mm",
    "material": "elastic", "static_shear_modulus": "3 MPa", "speed": 1, "load": "5 kN/m"},
    "axes": {"speed": {"from": "1 m/s", "to": "9 m/s", "points": 9}}})");
  std::filesystem::create_symlink(rollres_program(), folder / "rollres");
  const ShellRun run = run_shell(
      "cd " + shell_word(folder.path.string()) +
      " && export PATH=\"$PWD:$PATH\" HOME=\"$PWD\" && "
      "parallel --will-cite -j 2 rollres sweep study.json --shard {}/3 --jobs 1 --db shard-{}.db ::: $(seq 3) && "
      "rollres merge shard-*.db --db merged.db && rollres sweep study.json --db alone.db");
  INFO(run.out);
  REQUIRE(run.status == 0);
  CHECK(stored_rows(folder / "merged.db", "speeds") == stored_rows(folder / "alone.db", "speeds"));
}

TEST_CASE("the predicted cost grows with the number of nodes and falls without friction", "[studies][shards]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere})
    for (const Method method : {Method::newton, Method::newton_dense, Method::active_set}) {
      RollingScene scene = plain_scene(1, indenter == Indenter::sphere ? 1e2 : 2e4);
      scene.indenter = indenter;
      scene.method = method;
      scene.spacing = 1e-3;
      RollingScene fine = scene, slippery = scene;
      fine.spacing = 1e-4;
      slippery.friction_coefficient = 0;
      CHECK(predicted_seconds(fine) > 2 * predicted_seconds(scene));
      CHECK(predicted_seconds(slippery) < predicted_seconds(scene));
      CHECK(predicted_seconds(slippery) > 0);
    }
  RollingScene scene = plain_scene();
  scene.indenter = Indenter::sphere;
  RollingScene exact = scene;
  exact.tolerance = 1e-4;
  CHECK(predicted_seconds(exact) > predicted_seconds(scene));
}

TEST_CASE("sixteen merged shards are the table of one sweep, and the status knows which are missing",
          "[studies][shards]") {
  const TemporaryDirectory folder;
  Study study{.name = "speed and load", .base = plain_scene(), .axes = {{"speed"}, {"load", {1e4, 2e4}}}};
  for (int i = 0; i < 100; ++i) study.axes[0].values.push_back(0.1 * (i + 1));
  const Evaluate moody = [](const RollingScene& scene) {
    if (scene.speed > 9) throw std::runtime_error("singular matrix");
    return closed_form(scene);
  };
  run_sweep(study, moody, folder / "alone");
  std::vector<std::filesystem::path> files;
  std::size_t solved = 0;
  for (int i = 1; i <= 16; ++i) {
    files.push_back(folder / std::to_string(i));
    const SweepReport report = run_sweep(study, moody, files.back(), {.jobs = 2, .shard = {i, 16}});
    CHECK(report.points == report.solved);
    CHECK(report.answered == report.points);
    CHECK(report.study.points == 200);
    CHECK(run_sweep(study, moody, files.back(), {.jobs = 2, .shard = {i, 16}}).recalled == report.points);
    solved += report.solved;
  }
  CHECK(solved == 200);

  const std::vector<std::filesystem::path> some{files[0], files[3], files[4], files[15]};
  const StudyStatus part = study_status(study, some, 16);
  CHECK(part.missing + part.converged + part.failed == 200);
  CHECK(array_list(part.shards_missing) == "2,3,6-15");
  CHECK(part.seconds_left > 0);
  const StudyStatus whole = study_status(study, files, 16);
  CHECK(whole.missing == 0);
  CHECK(whole.failed == 20);
  CHECK(whole.seconds_left == 0);
  CHECK(whole.shards_missing.empty());
  CHECK(study_status(study, {}, 3).missing == 200);

  const Database all = open_database(folder / "all", Access::write);
  for (const auto& file : files) CHECK(merge(all, file).conflicts.empty());
  CHECK(stored_rows(folder / "all", study.name).size() == 200);
  CHECK(stored_rows(folder / "all", study.name) == stored_rows(folder / "alone", study.name));
}
