/// What is left out of a model for a tolerance's sake, against the full model.

#include "core/solve/resolve.hpp"

#include <cmath>
#include <random>

#include "core/model/contact_surface.hpp"
#include "core/solve/model_answer.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/infinite.hpp"

using namespace rollres;

namespace {

BondedLayer elastic_layer(double thickness, double modulus, double poisson_ratio) {
  BondedLayer layer;
  layer.layer_thickness = thickness;
  layer.material = MaterialModel::elastic;
  layer.static_shear_modulus = modulus;
  layer.poisson_ratio = poisson_ratio;
  return layer;
}

void make_rubber(MaterialInputs& layer) {
  layer.static_shear_modulus = 1e6;
  layer.stiffening = 3;
  layer.creep_time = 5e-3;
}

/// 10 mm of rubber on 100 mm of concrete on soil.
RollingScene rubber_mat(Indenter indenter) {
  RollingScene scene;
  scene.indenter = indenter;
  scene.radius = 0.05;
  make_rubber(scene);
  scene.layer_thickness = 0.01;
  scene.lower_layers = {elastic_layer(0.1, 12.5e9, 0.2), elastic_layer(infinite, 4e7, 0.3)};
  scene.load = indenter == Indenter::sphere ? 20 : 3000;
  scene.friction_coefficient = 0.5;
  scene.drive = Drive::free;
  scene.speed = 0.2;
  scene.tolerance = 1e-2;
  return scene;
}

/// A rubber tyre on concrete.
RollingScene rubber_tyre() {
  RollingScene scene;
  scene.radius = 0.05;
  static_cast<MaterialInputs&>(scene) = elastic_layer(0, 12.5e9, 0.2);
  scene.layer_thickness = infinite;
  BondedLayer tyre;
  make_rubber(tyre);
  tyre.layer_thickness = 0.012;
  scene.coating_layers = {tyre};
  scene.load = 8000;
  scene.friction_coefficient = 0.5;
  scene.drive = Drive::free;
  scene.speed = 0.2;
  scene.tolerance = 1e-3;
  return scene;
}

ContactModel without_tolerance(ContactModel model) {
  model.tolerance.reset();
  model.asked_tolerance.reset();
  model.left_out = 0;
  model.choose_method();
  return model;
}

/// Relative change of the resistance, both models by the same method.
double change_of_resistance(ContactModel full, ContactModel simpler, double spacing = 0) {
  for (ContactModel* const model : {&full, &simpler}) {
    *model = without_tolerance(*model);
    if (spacing > 0) model->spacing = spacing;
    model->choose_method();
  }
  const RollingSolution with = solve_model(full), without = solve_model(simpler);
  REQUIRE(with.status == Status::converged);
  REQUIRE(without.status == Status::converged);
  REQUIRE(with.method == without.method);
  return std::abs(without.rolling_resistance / with.rolling_resistance - 1);
}

}  // namespace

TEST_CASE("a hard floor under a mat is taken as rigid where the tolerance allows it", "[core][resolve]") {
  RollingScene scene = rubber_mat(Indenter::cylinder);
  const ContactModel choice = resolve(scene);
  REQUIRE(choice.decisions.size() == 1);
  CHECK(choice.decisions[0].find("what lies below the first layer taken as rigid, which changes R_r by ") == 0);
  CHECK(choice.foundation.size() == 1);
  CHECK(*choice.tolerance == Approx(1e-2 - choice.left_out));
  const double change = change_of_resistance(scene, choice);
  CHECK(change < choice.left_out);
  CHECK(change > 0.1 * choice.left_out);  // the estimate is one

  const RollingSolution solution = solve(scene);
  CHECK(solution.error_estimate > choice.left_out);
  CHECK(solution.model.find(choice.decisions[0]) != std::string::npos);

  scene.tolerance = 1e-5;
  CHECK(resolve(scene).decisions.empty());
  scene.tolerance.reset();
  CHECK(resolve(scene).decisions.empty());
}

TEST_CASE("a half-space taken as rigid gives a cylinder no approach that the scene has not", "[core][resolve]") {
  const RollingScene scene = rubber_mat(Indenter::cylinder);
  REQUIRE(resolve(scene).foundation.size() == 1);
  const RollingSolution solution = solve(scene);
  REQUIRE(solution.status == Status::converged);
  CHECK(std::isnan(solution.approach));
  CHECK(solution.model.find("no approach") != std::string::npos);
}

TEST_CASE("a hard floor under a mat is rigid for a ball as well", "[core][resolve]") {
  RollingScene scene = rubber_mat(Indenter::sphere);
  scene.lower_layers[1].static_shear_modulus = 4e8;
  const ContactModel choice = resolve(scene);
  CHECK(choice.foundation.size() == 1);
  CHECK(change_of_resistance(scene, choice, 0.3e-3) < choice.left_out);
}

TEST_CASE("a hard surface may be incompressible where the soft one yields", "[core][resolve]") {
  for (const Drive drive : {Drive::free, Drive::top_force, Drive::torque}) {
    CAPTURE(name_of(drive));
    RollingScene scene = rubber_tyre();
    scene.drive = drive;
    if (drive == Drive::torque) scene.driving_torque = 0.1 * *scene.load * scene.radius;
    if (drive == Drive::torque) scene.tolerance = 1e-2;
    const ContactModel choice = resolve(scene);
    REQUIRE(choice.decisions.size() == 1);
    CHECK(choice.top().poisson_ratio == 0.5);
    CHECK(change_of_resistance(scene, choice, 0.2e-3) < choice.left_out);
    const RollingSolution solution = solve(scene);
    CHECK(solution.method == Method::spectral);
    CHECK(solution.error_estimate < *scene.tolerance);
  }
}

TEST_CASE("a hard core of a coating is taken as the body's, and layers that matter are kept", "[core][resolve]") {
  RollingScene scene = rubber_tyre();
  scene.coating_layers.push_back(elastic_layer(0.01, 8e10, 0.3));
  CHECK(resolve(scene).coating.size() == 1);

  RollingScene soft = rubber_mat(Indenter::cylinder);
  make_rubber(soft.lower_layers[0]);
  soft.lower_layers[0].poisson_ratio = 0.5;
  soft.lower_layers[0].layer_thickness = 0.02;
  soft.lower_layers[1].static_shear_modulus = 12.5e9;
  CHECK(resolve(soft).foundation.size() == 2);
  CHECK(change_of_resistance(soft, resolve(soft)) < resolve(soft).left_out);
}

TEST_CASE("layers left out of random scenes change the resistance by less than is said", "[core][resolve][long]") {
  std::mt19937_64 random(20);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<double>(0, 1)(random));
  };
  int simplified = 0;
  for (int i = 0; i < 40; ++i) {
    RollingScene scene = rubber_mat(Indenter::cylinder);
    scene.radius = between(0.01, 0.2);
    scene.layer_thickness = between(2e-3, 0.1);
    scene.static_shear_modulus = between(3e5, 1e7);
    scene.stiffening = between(0.05, 30);
    scene.creep_time = between(1e-4, 1);
    scene.speed = between(1e-3, 5);
    scene.inertia = Inertia::off;
    scene.friction_coefficient = i % 2 == 0 ? 0 : between(0.05, 0.8);
    scene.lower_layers = {elastic_layer(between(0.01, 0.3), between(3e7, 3e11), 0.3),
                          elastic_layer(infinite, between(3e7, 3e11), 0.2)};
    scene.load = *scene.static_shear_modulus * scene.radius * between(1e-3, 3e-2);
    scene.tolerance = i % 3 == 0 ? 1e-2 : 1e-3;
    const ContactModel choice = resolve(scene);
    if (choice.decisions.empty()) continue;
    CAPTURE(i, choice.left_out);
    CHECK(choice.left_out < 0.2 * *scene.tolerance);
    const auto on_grid = [](const ContactModel& model) { return solve_model(model).method != Method::spectral; };
    // A grid's own error is larger.
    if (on_grid(without_tolerance(scene)) || on_grid(without_tolerance(choice))) continue;
    ++simplified;
    CHECK(change_of_resistance(scene, choice) < choice.left_out);
  }
  CHECK(simplified > 15);
}

TEST_CASE("inertia is left out where it matters less than the tolerance, and by what is said", "[core][resolve]") {
  RollingScene scene = rubber_mat(Indenter::cylinder);
  scene.lower_layers.clear();
  for (const double speed : {1.1, 1.2}) {
    scene.speed = speed;
    CAPTURE(speed);
    REQUIRE(ContactModel(scene).inertia);  // as rho V^2 / G0 alone would have it
    const ContactModel choice = resolve(scene);
    REQUIRE(choice.decisions.size() == 1);
    CHECK(choice.decisions[0].find("inertia left out, which changes R_r by ") == 0);
    RollingScene with = scene;
    with.inertia = Inertia::on;
    CHECK(change_of_resistance(with, choice, 0.1e-3) < choice.left_out);
  }
  scene.speed = 8;
  CHECK(resolve(scene).decisions.empty());
}
