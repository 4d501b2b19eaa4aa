#include "studies/run/stored_evaluations.hpp"

#include <chrono>
#include <thread>

#include "db/rows/schema.hpp"
#include "db/rows/study_upkeep.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

// result_writer and evaluate, too.

// Covers result_writer, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

RollingScene scene_at(double speed) {
  RollingScene scene = plain_scene();
  scene.speed = speed;
  return scene;
}

}  // namespace

TEST_CASE("threads that ask for one scene at a time wait for one solution of it", "[studies][stored_evaluations]") {
  const TemporaryDirectory folder;
  std::atomic<int> solved = 0;
  StoredEvaluations evaluations(
      [&](const RollingScene& scene) {
        ++solved;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return closed_form(scene);
      },
      folder / "results.db");
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < 4; ++thread)
      threads.emplace_back([&] {
        for (const double speed : {0.1, 0.2})
          CHECK(evaluations(scene_at(speed)).rolling_resistance == closed_form(scene_at(speed)).rolling_resistance);
      });
  }
  CHECK(solved == 2);
  CHECK(evaluations.count().solved == 2);
  evaluations.flush();
  ResultStore store(folder / "results.db", Access::read);
  for (const double speed : {0.1, 0.2}) CHECK(store.contains(evaluation_key(scene_at(speed))));
}

TEST_CASE("what is stored is recalled, counted once, and becomes a point of the study that asks for it",
          "[studies][stored_evaluations]") {
  const TemporaryDirectory folder;
  const std::filesystem::path file = folder / "results.db";
  const Evaluate moody = [](const RollingScene& scene) {
    if (scene.speed > 0.25) throw std::runtime_error("too fast");
    return closed_form(scene);
  };
  {
    StoredEvaluations evaluations(moody, file, {"first", {"speed"}, "{}"});
    for (const double speed : {0.1, 0.2, 0.3, 0.1}) evaluations(scene_at(speed));
    CHECK(evaluations.count().solved == 3);
    CHECK(evaluations.count().failed == 1);
  }
  StoredEvaluations again([](const RollingScene&) -> RollingSolution { throw std::logic_error("is not asked for"); },
                          file, {"second", {"speed"}, "{}"});
  CHECK(again(scene_at(0.2)).rolling_resistance == closed_form(scene_at(0.2)).rolling_resistance);
  CHECK_THAT(again(scene_at(0.3)).reason, Contains("too fast"));
  CHECK(again.count().recalled == 2);
  CHECK(again.count().failed == 1);
  again.flush();
  ResultStore store(file, Access::read);
  CHECK(store.points("first").size() == 3);
  CHECK(store.points("second") ==
        std::vector<std::string>{evaluation_key(scene_at(0.2)), evaluation_key(scene_at(0.3))});
}

TEST_CASE("a wish to stop interrupts what is not stored, and only that", "[studies][stored_evaluations]") {
  const TemporaryDirectory folder;
  std::atomic<bool> stop = false;
  StoredEvaluations evaluations(closed_form, folder / "results.db", {"study", {}, "{}"}, &stop);
  evaluations(scene_at(0.1));
  stop = true;
  CHECK(evaluations(scene_at(0.1)).status == Status::converged);
  CHECK_THROWS_AS(evaluations(scene_at(0.2)), Interrupted);
  CHECK_THROWS_AS(evaluations(scene_at(0.2)), Interrupted);  // the next one that asks does not wait for ever
}

TEST_CASE("a writer that fails tells those who add and those who wait", "[studies][stored_evaluations]") {
  ResultWriter writer([](const std::vector<Evaluation>&) { throw std::runtime_error("disk full"); });
  writer.add({});
  CHECK_THROWS_WITH(writer.flush(), "disk full");
  CHECK_THROWS_WITH(writer.add({}), "disk full");
}

TEST_CASE("an answer that was forgotten is recalled from the store", "[studies][stored_evaluations]") {
  const TemporaryDirectory folder;
  int solved = 0;
  StoredEvaluations evaluations(
      [&](const RollingScene& scene) {
        ++solved;
        return closed_form(scene);
      },
      folder / "results.db");
  for (int time = 0; time < 2; ++time) {
    CHECK(evaluations(scene_at(0.1)).rolling_resistance == closed_form(scene_at(0.1)).rolling_resistance);
    evaluations.flush();
    evaluations.forget();
  }
  CHECK(solved == 1);
  CHECK(evaluations.count().recalled == 1);
}

TEST_CASE("a study that stands there defined otherwise is replaced only where that is asked for",
          "[studies][stored_evaluations]") {
  const TemporaryDirectory folder;
  const std::filesystem::path file = folder / "results.db";
  {
    StoredEvaluations evaluations(closed_form, file, {"study", {"speed"}, R"({"scene": {"radius": 1}})"});
    evaluations(scene_at(0.1));
  }
  const StudyRecord other{"study", {"speed"}, R"({"scene": {"radius": 2}})"};
  CHECK_THAT(message_of([&] { StoredEvaluations(closed_form, file, other); }),
             Contains("study = study: is there already, defined otherwise: scene.radius 1 -> 2"));
  CHECK(ResultStore(file, Access::read).points("study").size() == 1);
  std::string told;
  StoredEvaluations evaluations(closed_form, file, other, nullptr,
                                {true, [&](const Redefinition& redefined) { told = redefined.in_words(); }});
  CHECK(told == "scene.radius 1 -> 2; 1 point of it leaves the study, their rows stay");
  CHECK(ResultStore(file, Access::read).points("study").empty());
}

TEST_CASE("what did not converge is solved again where that is asked for", "[studies][stored_evaluations]") {
  const TemporaryDirectory folder;
  int solved = 0;
  const auto answer = [&](Retry retry, Status status) {
    StoredEvaluations evaluations(
        [&](const RollingScene& scene) {
          ++solved;
          RollingSolution solution = closed_form(scene);
          solution.status = status;
          return solution;
        },
        folder / "results.db", retry);
    return evaluations(scene_at(0.1)).status;
  };
  CHECK(answer(Retry::nothing, Status::not_converged) == Status::not_converged);
  CHECK(answer(Retry::nothing, Status::converged) == Status::not_converged);
  CHECK(answer(Retry::failed, Status::converged) == Status::converged);
  CHECK(solved == 2);
  CHECK(answer(Retry::failed, Status::not_converged) == Status::converged);
  CHECK(solved == 2);
}

TEST_CASE("a study of points that are added one by one and is deleted meanwhile is told",
          "[studies][stored_evaluations]") {
  const TemporaryDirectory folder;
  StoredEvaluations evaluations(closed_form, folder / "results.db", StudyRecord{"mine", {}, "{}"});
  evaluations(scene_at(0.1));
  evaluations.flush();
  delete_study(open_database(folder / "results.db", Access::write), "mine");
  evaluations(scene_at(0.2));
  CHECK_THROWS_WITH(evaluations.flush(), Contains("study = mine: was deleted by another process"));
}
