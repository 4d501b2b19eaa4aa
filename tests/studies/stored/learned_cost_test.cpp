#include "studies/stored/learned_cost.hpp"

#include <fstream>

#include "studies/stored/study_rows.hpp"
#include "studies/study/predicted_cost.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

/// Rows of scenes that took so many times what is predicted.
void store_rows(const std::filesystem::path& database, double times, double friction, int rows) {
  ResultStore store(database);
  for (int i = 0; i < rows; ++i) {
    RollingScene scene = plain_scene(1 + 0.01 * i);
    scene.friction_coefficient = friction;
    RollingSolution solution = closed_form(scene);
    solution.seconds = times * predicted_seconds(scene);
    const Evaluation evaluation{evaluation_key(scene), scene, solution};
    store.save({&evaluation, 1});
  }
}

/// A study of 100 speeds that has no point in common with these rows.
Study fresh_study() {
  Study study{.name = "fresh", .base = plain_scene(), .axes = {{.key = "speed"}}};
  for (int i = 0; i < 100; ++i) study.axes.front().values.push_back(3 + 0.01 * i);
  return study;
}

}  // namespace

TEST_CASE("a study is predicted from what stored solutions of its kind took", "[studies][stored][learned_cost]") {
  const TemporaryDirectory folder;
  const std::vector<std::filesystem::path> database{folder / "results.db"};
  const double plain = study_status(fresh_study(), {}, 1).seconds_left;
  CHECK(plain == Approx(100 * predicted_seconds(plain_scene(3))));
  store_rows(database.front(), 20, 0.3, 12);  // another study on this machine
  store_rows(database.front(), 0.1, 0, 30);   // of another kind
  const StudyStatus status = study_status(fresh_study(), database, 1);
  CHECK(status.missing == 100);
  CHECK(status.seconds_left == Approx(20 * plain));
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
