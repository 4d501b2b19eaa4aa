#include "studies/study/study.hpp"

#include "db/rows/result_store.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/study_points.hpp"

using namespace rollres;

namespace {

Condition condition(const std::string& text) { return {text, FormulaNames::inputs, Indenter::cylinder}; }

/// Speeds 1 to 4 and loads 10 to 40 kN/m.
Study four_by_four() {
  return {.name = "four by four",
          .base = plain_scene(),
          .axes = {{.key = "load", .values = {1e4, 2e4, 3e4, 4e4}}, {.key = "speed", .values = {1, 2, 3, 4}}}};
}

}  // namespace

TEST_CASE("constraints drop the points that break them, each counted where it is dropped first", "[studies][study]") {
  Study study = four_by_four();
  study.constraints = {condition("load * speed <= 60000"), condition("speed >= 7.2 km/h")};
  const StudyPlan plan(study);
  REQUIRE(plan.size() == 6);
  for (const RollingScene& scene : points(study)) {
    CHECK(*scene.load * scene.speed <= 6e4);
    CHECK(scene.speed >= 2);
  }
  CHECK(plan.dropped() == std::vector<std::size_t>{6, 4});
  CHECK(plan.all_dropped() == 10);
  CHECK(points(study).size() == 6);
}

TEST_CASE("a point that a constraint drops may break the rules of a scene", "[studies][study]") {
  Study study = four_by_four();
  study.axes[1] = {.key = "spacing", .values = {1e-3, 1}};  // at most a fifth of the radius
  CHECK_THROWS_AS(StudyPlan(study), std::invalid_argument);
  study.constraints = {condition("spacing <= radius / 10")};
  CHECK(StudyPlan(study).size() == 4);
}

TEST_CASE("a constraint that no point meets, or that cannot be decided, is refused", "[studies][study]") {
  Study study = four_by_four();
  study.constraints = {condition("speed > 2"), condition("speed < 3")};
  CHECK(message_of([&] { StudyPlan{study}; }) ==
        "four by four: constraints: no point is left of 16: speed > 2 drops 8, speed < 3 drops 8");
  study.constraints = {condition("approach < 1 mm")};
  CHECK(message_of([&] { StudyPlan{study}; }) ==
        "four by four: axes at load = 10000, speed = 1: approach < 1 mm: cannot be decided, a number in it is absent "
        "from "
        "the scene");
}

TEST_CASE("axes of one group must be of one size", "[studies][study]") {
  Study study = four_by_four();
  for (Axis& axis : study.axes) axis.group = "together";
  CHECK(StudyPlan(study).size() == 4);
  study.axes[1].values.pop_back();
  CHECK(message_of([&] { StudyPlan{study}; }) ==
        "four by four: speed: must have as many values as load, with which it varies together");
}

TEST_CASE("a point's scene is the same by itself and after its neighbours", "[studies][study]") {
  Study study = four_by_four();
  study.base.rotation_ratio = 1.01;  // cleared by the first drive, kept for the second
  study.axes.insert(study.axes.begin() + 1, {.key = "drive", .texts = {"free", "rotation"}});
  study.constraints = {condition("load * speed <= 60000")};
  const StudyPlan plan(study);
  const std::vector<RollingScene> scenes = points(study);
  REQUIRE(plan.size() == scenes.size());
  const std::vector<std::string> keys = plan.keys();
  for (std::size_t point = 0; point < plan.size(); ++point) {
    CHECK(keys[point] == evaluation_key(scenes[point]));
    CHECK(keys[point] == evaluation_key(plan.scene(point)));
    CHECK(scenes[point].rotation_ratio.has_value() == (scenes[point].drive == Drive::rotation));
  }
}
