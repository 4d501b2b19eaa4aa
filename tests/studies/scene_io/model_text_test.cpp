#include "studies/scene_io/model_text.hpp"

#include "core/solve/rolling_contact.hpp"
#include "studies/text/strict_json.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/infinite.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

TEST_CASE("the model of a scene is told before it is solved, by the method that then solves it", "[studies][model]") {
  RollingScene scene = plain_scene();
  scene.tolerance = 1e-3;
  const std::string text = model_text(scene);
  CHECK(text.find("model\n  body     rigid cylinder, per metre of its length, R = ") == 0);
  const RollingSolution solution = solve(scene);
  CHECK_THAT(text, Contains("\n  method   " + std::string(name_of(solution.method)) + ": "));
  CHECK_THAT(text, Contains("tolerance 0.001 of R_r: 0 taken by simplifications, 0.001 left for numbers"));

  scene.speed = -1;
  CHECK_THROWS_WITH(model_text(scene), Contains("speed = -1: must be > 0"));
}

TEST_CASE("of a cylinder with a width the model tells loads, torques and the reason of a refusal in N and N m",
          "[studies][model][width]") {
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  scene.tolerance = 1e-6;
  scene.drive = Drive::torque;
  scene.driving_torque = 1e5;
  CHECK_THAT(model_text(scene), Contains("load 2e+04 N/m") && Contains("drive torque 1e+05 N m/m"));
  CHECK_THAT(solve(scene).reason, Contains("1e+05 N m/m, and "));
  scene.width = 0.1;
  scene.load = 2000;
  scene.driving_torque = 1e4;
  CHECK_THAT(model_text(scene), Contains("rigid cylinder, 0.1 m wide, ") && Contains("load 2000 N,") &&
                                    Contains("drive torque 1e+04 N m,"));
  CHECK_THAT(solve(scene).reason, Contains("1e+04 N m, and ") && !Contains("N m/m"));
}

TEST_CASE("programs read a model under the names of the source", "[studies][model]") {
  RollingScene scene = plain_scene(0.5);
  BondedLayer ground;
  ground.layer_thickness = infinite;
  ground.material = MaterialModel::elastic;
  ground.static_shear_modulus = 1e13;
  scene.lower_layers = {ground};
  Json model = Json::parse(model_json(scene));
  REQUIRE(model["foundation"].size() == 2);
  CHECK(model["foundation"][0]["layer_thickness"] == scene.layer_thickness);
  CHECK(model["foundation"][1]["layer_thickness"] == "infinite");
  CHECK(model["rigid_base"] == false);
  CHECK(model["asked_tolerance"].is_null());
  CHECK(model["decisions"].empty());

  scene.tolerance = 1e-2;
  model = Json::parse(model_json(scene));
  CHECK(model["foundation"].size() == 1);
  CHECK(model["rigid_base"] == true);
  CHECK(model["decisions"].size() == 1);
  CHECK(model["tolerance"].get<double>() + model["left_out"].get<double>() == Approx(1e-2).epsilon(1e-12));
}
