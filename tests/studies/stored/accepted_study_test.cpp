#include "studies/stored/accepted_study.hpp"

#include <nlohmann/json.hpp>

#include "db/rows/result_store.hpp"
#include "studies/optimise/design_file.hpp"
#include "studies/run/export_study.hpp"
#include "studies/study/study.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/study_points.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using nlohmann::json;

namespace {

/// As a program wrote it that asked for no units.
json former_study() {
  return {{"study", "former"},
          {"scene",
           {{"radius", 5},
            {"layer_thickness", 3},
            {"material", "master_curve"},
            {"frequencies", {0.1, 1, 10, 100}},
            {"storage_moduli", {400, 500, 600, 700}},
            {"loss_moduli", {40, 50, 60, 70}},
            {"coating_layers",
             json::array({{{"layer_thickness", 1.5}, {"material", "elastic"}, {"static_shear_modulus", 500}}})},
            {"speed", 1},
            {"load", 100}}},
          {"axes", {{"layer_thickness", {2, 3}}, {"radius", {{"from", 4}, {"to", 8}, {"points", 3}}}}},
          {"constraints", {"layer_thickness <= 6", "speed <= 6"}}};
}

}  // namespace

TEST_CASE("a study that an earlier program stored is read again, its numbers as they were", "[studies][study]") {
  const TemporaryDirectory folder;
  const auto former = folder.write("former.json", former_study().dump());
  CHECK(message_of([&] { read_study(former); }) != "nothing");
  const auto now = folder.write("now.json", accepted_study(former_study().dump()));
  const std::vector<RollingScene> scenes = points(read_study(now));
  REQUIRE(scenes.size() == 6);
  CHECK(scenes.back().radius == 8);
  CHECK(scenes.back().layer_thickness == 3);
  CHECK(scenes.back().storage_moduli == std::vector<double>{400, 500, 600, 700});
  CHECK(scenes.back().listed_moduli == ListedModuli::shear);
  CHECK(scenes.back().coating_layers[0].layer_thickness == 1.5);
  CHECK(scenes.back().coating_layers[0].static_shear_modulus == 500);
  const std::string again = accepted_study(accepted_study(former_study().dump()));
  CHECK(again == accepted_study(former_study().dump()));
}

TEST_CASE("an optimisation that an earlier program stored is read again", "[studies][study][optimise]") {
  json study = former_study();
  study.erase("axes");
  study["variables"] = {{"layer_thickness", {{"from", 2}, {"to", 4}, {"start", 3}}}};
  study["minimise"] = "peak_pressure";
  study["constraints"] = {{{"condition", "peak_pressure <= 500"}, {"over", "max"}}};
  study["uncertain"] = {{"radius", {{"normal", {5, 0.1}}}}};
  study["constraints"][0]["scatter"] = "P95";
  const DesignProblem problem = parse_design_problems(accepted_study(study.dump()), "study.json").front();
  CHECK(problem.start[0] == 3);
  CHECK(problem.variables[0].highest == 4);
}

TEST_CASE("what is accepted today stays as it was written, to the last blank", "[studies][study]") {
  const std::string text =
      R"({ "study": "s",  "scene": {"radius": "5 m", "layer_thickness": 0.01}, "axes": {"speed": [1, 2]} })";
  CHECK(accepted_study(text) == text);
  CHECK(accepted_study("no JSON") == "no JSON");
  CHECK(accepted_study("").empty());
}

TEST_CASE("an exported study file is one that can be run", "[studies][export]") {
  const TemporaryDirectory folder;
  {
    ResultStore store(folder / "r.db");
    store.start_study({"former", {"layer_thickness"}, former_study().dump()}, {});
  }
  export_study(folder / "r.db", "former", folder / "out");
  CHECK(points(read_study(folder / "out/study.json")).size() == 6);
}
