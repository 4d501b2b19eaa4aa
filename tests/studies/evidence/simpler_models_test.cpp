#include "studies/evidence/simpler_models.hpp"

#include <algorithm>
#include <cmath>

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

Evaluate solver() {
  return [](const RollingScene& scene) { return solve(scene); };
}

double answer_of(const std::vector<SimplerModel>& models, const std::string& name) {
  const auto found = std::find_if(models.begin(), models.end(), [&](const auto& model) { return model.name == name; });
  INFO(name);
  REQUIRE(found != models.end());
  return found->rolling_resistance;
}

std::vector<SimplerModel> models_beside(const RollingScene& scene, RollingSolution& solution) {
  solution = solve(scene);
  REQUIRE(solution.status == Status::converged);
  return simpler_models(scene, solution, solver());
}

}  // namespace

TEST_CASE("simpler models are right where their assumptions hold", "[studies][simpler_models]") {
  RollingScene scene = plain_scene(1, 100);  // of a small slope, as the closed forms have it
  scene.friction_coefficient = 0;
  RollingSolution solution;

  scene.layer_thickness = INFINITY;
  auto models = models_beside(scene, solution);
  CHECK(answer_of(models, "Hunter's half-space") == Approx(solution.rolling_resistance).epsilon(1e-4));

  scene.layer_thickness = 0.01;
  scene.speed = 1e-5;
  models = models_beside(scene, solution);
  CHECK(answer_of(models, "the limit of slow rolling") == Approx(solution.rolling_resistance).epsilon(1e-3));
  CHECK(answer_of(models, "a half-space of the first layer") == Approx(solution.rolling_resistance).epsilon(1e-3));

  scene.speed = 1000;
  scene.inertia = Inertia::off;
  models = models_beside(scene, solution);
  CHECK(answer_of(models, "the limit of fast rolling") == Approx(solution.rolling_resistance).epsilon(1e-2));
}

TEST_CASE("each part of a model has the model without it beside it", "[studies][simpler_models]") {
  RollingScene scene = plain_scene();
  scene.tolerance = 0.02;
  BondedLayer hard;
  static_cast<MaterialInputs&>(hard) = scene;
  hard.layer_thickness = 0.05;
  hard.static_shear_modulus = 1e9;
  scene.lower_layers = {hard};
  BondedLayer coating = hard;
  coating.layer_thickness = 0.002;
  scene.coating_layers = {coating};
  RollingSolution solution;
  const auto models = models_beside(scene, solution);
  for (const std::string name :
       {"without friction", "the first layer on a rigid base", "a half-space of the first layer", "without coating"})
    CHECK(std::isfinite(answer_of(models, name)));
  CHECK(answer_of(models, "without coating") == Approx(solution.rolling_resistance).epsilon(0.02));
  const std::string text = simpler_models_text(scene, solution, models);
  CHECK(text.find("within the tolerance") != std::string::npos);
  CHECK(text.find("a half-space of the first layer") != std::string::npos);
}

TEST_CASE("what bends a cover is not told as what inertia changes", "[studies][simpler_models]") {
  // With inertia a cover is flat: both answers would differ by the bend.
  RollingScene wheel = plain_scene();
  wheel.layer_thickness = INFINITY;
  wheel.material = MaterialModel::elastic;
  wheel.static_shear_modulus = 1e10;
  BondedLayer cover;
  static_cast<MaterialInputs&>(cover) = plain_scene();
  cover.layer_thickness = 0.2 * wheel.radius;
  wheel.coating_layers = {cover};
  const auto named = [&](Inertia inertia, const std::string& name) {
    wheel.inertia = inertia;
    RollingSolution solution;
    const auto models = models_beside(wheel, solution);
    return std::count_if(models.begin(), models.end(), [&](const auto& model) { return model.name == name; });
  };
  CHECK(named(Inertia::off, "with inertia") == 0);
  CHECK(named(Inertia::on, "without inertia") == 0);
  CHECK(named(Inertia::on, "the ring without inertia") == 1);
  wheel = plain_scene();
  CHECK(named(Inertia::off, "with inertia") == 1);
  CHECK(named(Inertia::on, "without inertia") == 1);
}

TEST_CASE("beside finite strain stands the theory of small strains, and no model that the method has not",
          "[studies][simpler_models][long]") {
  RollingScene scene = plain_scene(1, 100);
  scene.method = Method::finite_strain;
  RollingSolution solution;
  auto models = models_beside(scene, solution);
  CHECK(answer_of(models, "small strains") == Approx(solution.rolling_resistance).epsilon(2e-3));
  CHECK(answer_of(models, "the limit of fast rolling") > 0);
  const auto is_half_space = [](const auto& model) { return model.name == "a half-space of the first layer"; };
  CHECK(std::none_of(models.begin(), models.end(), is_half_space));
  scene.yeoh_second = 0.1;  // which small strains do not feel
  models = models_beside(scene, solution);
  CHECK(std::none_of(models.begin(), models.end(), [](const auto& model) { return model.name == "small strains"; }));
}
