#include "studies/stored/study_redefinition.hpp"

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers command_upkeep, too.

using namespace rollres;
using Catch::Matchers::Contains;

TEST_CASE("what changed in a study is told by its keys, comments and charts do not count", "[studies][stored]") {
  const std::string former =
      R"({"study": "a", "scene": {"creep_time": "0.1 s", "radius": 1}, "axes": {"speed": [1, 2]}})";
  CHECK(changes_between(former, former).empty());
  CHECK(changes_between(former, R"({"axes": {"speed": [1, 2]}, "scene": {"radius": 1, "creep_time": "0.1 s",
                                    "comment": "c"}, "chart": {"x": "speed"}})")
            .empty());
  CHECK(changes_between(former, R"({"scene": {"creep_time": "0.2 s", "radius": 1}, "axes": {"speed": [1, 2]}})") ==
        R"(scene.creep_time "0.1 s" -> "0.2 s")");
  CHECK(changes_between(former, R"({"scene": {"creep_time": "0.1 s"}, "axes": {"speed": [1, 2, 4]}})") ==
        "axes.speed: 4 added, scene.radius: 1 left out");
  CHECK(changes_between(former, "") == "its file");
}

TEST_CASE("a study of the same name with other points is refused, and replaced where that is asked for",
          "[studies][stored]") {
  const TemporaryDirectory folder;
  const std::string database = (folder / "a.db").string();
  const auto sweep = [&](const std::string& scene, const std::string& speeds, std::vector<std::string> words = {}) {
    const auto file = folder.write("study.json", R"({"study": "belt", "scene": {"indenter": "cylinder", "radius": 0.1,
      "layer_thickness": "infinite", "static_shear_modulus": "1 MPa", "stiffening": 2, "load": 1e4, )" +
                                                     scene + R"(}, "axes": {"speed": [)" + speeds + "]}}");
    words.insert(words.begin(), {"sweep", file.string(), "--db", database});
    return run_rollres(words, closed_form);
  };
  REQUIRE(sweep(R"("creep_time": 0.1)", "1, 2").status == 0);
  CHECK(sweep(R"("creep_time": 0.1)", "1, 2, 3").status == 0);  // all points stay
  const ProgramRun refused = sweep(R"("creep_time": 0.2)", "1, 2");
  CHECK(refused.status == ExitStatus::wrong_input);
  CHECK_THAT(refused.err,
             Contains("creep_time 0.1 -> 0.2") && Contains("3 points of it leave") && Contains("--replace"));
  CHECK(ResultStore(database, Access::read).study("belt")->points == 3);
  const ProgramRun replaced = sweep(R"("creep_time": 0.2)", "1, 2", {"--replace"});
  CHECK(replaced.status == 0);
  CHECK_THAT(replaced.err, Contains("belt: defined anew"));
  CHECK(ResultStore(database, Access::read).study("belt")->points == 2);

  CHECK(run_rollres({"prune", "--db", database}, closed_form).out ==
        database + ": 3 rows belong to no study; --yes deletes\n");
  CHECK(run_rollres({"note", "belt", "a note", "--db", database}, closed_form).status == 0);
  CHECK_THAT(run_rollres({"list", "--db", database}, closed_form).out, Contains("a note"));
  CHECK(run_rollres({"rename", "belt", "cover", "--db", database}, closed_form).status == 0);
  CHECK_THAT(run_rollres({"delete", "covr", "--db", database}, closed_form).err, Contains("did you mean cover?"));
  CHECK(run_rollres({"delete", "cover", "--db", database}, closed_form).status == 0);
  CHECK_THAT(run_rollres({"prune", "--db", database, "--yes"}, closed_form).out, Contains("5 rows belong to no"));
  CHECK_THAT(run_rollres({"prune", "--db", database}, closed_form).out, Contains("0 rows belong"));
}
