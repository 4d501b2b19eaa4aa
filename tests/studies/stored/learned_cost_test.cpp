#include "studies/stored/learned_cost.hpp"

#include <fstream>

#include "studies/stored/study_rows.hpp"
#include "studies/study/predicted_cost.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

/// Rows of the study below that took so many times what is predicted.
void store_rows(const std::filesystem::path& database, double times, int rows) {
  ResultStore store(database);
  for (int i = 0; i < rows; ++i) {
    const RollingScene scene = plain_scene(3 + 0.01 * i);
    RollingSolution solution = closed_form(scene);
    solution.seconds = times * predicted_seconds(scene);
    const Evaluation evaluation{evaluation_key(scene), scene, solution};
    store.save({&evaluation, 1});
  }
}

Study hundred_speeds() {
  Study study{.name = "fresh", .base = plain_scene(), .axes = {{.key = "speed"}}};
  for (int i = 0; i < 100; ++i) study.axes.front().values.push_back(3 + 0.01 * i);
  return study;
}

}  // namespace

TEST_CASE("what is missing of a study is predicted from what its stored points took",
          "[studies][stored][learned_cost]") {
  const TemporaryDirectory folder;
  const std::vector<std::filesystem::path> database{folder / "results.db"};
  const double each = predicted_seconds(plain_scene(3.5));
  const StudyStatus fresh = study_status(hundred_speeds(), {}, 1);
  CHECK(fresh.seconds_left == Approx(100 * each));
  CHECK(fresh.unlearned == 100);
  CHECK(fresh.seconds_unlearned == Approx(fresh.seconds_left));
  store_rows(database.front(), 20, 5);
  CHECK(study_status(hundred_speeds(), database, 1).unlearned == 95);
  store_rows(database.front(), 20, 12);
  const StudyStatus status = study_status(hundred_speeds(), database, 1);
  CHECK(status.missing == 88);
  CHECK(status.unlearned == 0);
  CHECK(status.seconds_left == Approx(20 * 88 * each));
}

TEST_CASE("kinds of scenes are learned apart, and all together while one is rare", "[studies][stored][learned_cost]") {
  LearnedCost learned;
  CHECK(learned.ratio(3) == 1);
  for (std::size_t i = 0; i < LearnedCost::enough; ++i) learned.add(3, 1, 2);
  CHECK(learned.knows(3));
  CHECK(learned.ratio(3) == 2);
  learned.add(4, 8, 80);
  CHECK_FALSE(learned.knows(4));
  CHECK(learned.ratio(4) == Approx((16 + 80.0) / 16));
  learned.add(4, 1, std::nan(""));  // not told
  CHECK(learned.ratio(4) == Approx((16 + 80.0) / 16));
  RollingScene other = plain_scene();
  other.friction_coefficient = 0;
  CHECK(cost_kind(other) != cost_kind(plain_scene()));
}
