#include <cmath>

#include "core/material/material_functions.hpp"
#include "core/solve/rolling_contact.hpp"
#include "core/zones/spectral_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/core/rubber.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

/// The scene's Zener solid as a Prony series of one term, and as a fractional one of order 1.
RollingScene as_prony(RollingScene scene) {
  scene.material = MaterialModel::prony;
  scene.relaxation_times = {scene.creep_time / (1 + scene.stiffening)};
  scene.relaxation_moduli = {*scene.static_shear_modulus * scene.stiffening};
  return scene;
}
RollingScene as_fractional(RollingScene scene) {
  scene.material = MaterialModel::fractional_zener;
  scene.fractional_order = 1;
  return scene;
}

MaterialInputs wide_prony() {
  MaterialInputs layer;
  layer.material = MaterialModel::prony;
  layer.static_shear_modulus = 2e6;
  for (int j = 0; j < 9; ++j) {
    layer.relaxation_times.push_back(std::pow(10.0, j - 6));
    layer.relaxation_moduli.push_back(5e5);
  }
  return layer;
}

MaterialInputs fractional() {
  MaterialInputs layer;
  layer.material = MaterialModel::fractional_zener;
  layer.static_shear_modulus = 2e6;
  layer.stiffening = 9;
  layer.creep_time = 0.01;
  layer.fractional_order = 0.6;
  return layer;
}

RollingScene small_sphere() {
  RollingScene scene = paper_sphere();
  scene.spacing = 0.7e-3;
  return scene;
}

}  // namespace

TEST_CASE("a Zener solid, a one-term Prony series and a fractional Zener solid of order 1 roll alike by every method",
          "[core][material]") {
  RollingScene smooth = paper_cylinder();
  smooth.spacing.reset();
  RollingScene periodic = paper_cylinder();
  periodic.period = 0.2;
  for (const RollingScene& scene :
       {smooth, with_method(paper_cylinder(), Method::newton), with_method(paper_cylinder(), Method::newton_dense),
        with_method(paper_cylinder(), Method::active_set), periodic, small_sphere()}) {
    CAPTURE(name_of(scene.method), name_of(scene.indenter));
    const double zener = solve(scene).rolling_resistance;
    CHECK(solve(as_fractional(scene)).rolling_resistance == zener);
    CHECK(solve(as_prony(scene)).rolling_resistance == Approx(zener).epsilon(1e-10));
  }
}

TEST_CASE("energy is kept, and the route named, with every material", "[core][material]") {
  RollingScene cylinder = paper_cylinder();
  cylinder.spacing.reset();
  for (const MaterialInputs& layer : {wide_prony(), fractional(), filled_rubber()})
    for (const RollingScene& scene : {cylinder, paper_sphere()}) {
      const RollingSolution solution = solve(with_material(scene, layer));
      CAPTURE(name_of(layer.material), name_of(scene.indenter), solution.model);
      REQUIRE(solution.status == Status::converged);
      CHECK(solution.energy_residual < 1e-2);
      CHECK(solution.law_violation < 1e-8);
      CHECK_THAT(solution.model, Contains(material_route(layer)));
    }
}

TEST_CASE("continuous edges and a grid agree on a material of many terms", "[core][material]") {
  for (const MaterialInputs& layer : {wide_prony(), fractional(), filled_rubber()}) {
    RollingScene scene = with_material(frictionless(paper_cylinder()), layer);
    scene.spacing.reset();
    const double exact = solve(scene).rolling_resistance;
    scene.spacing = 0.05e-3;
    scene.method = Method::newton;
    // First order in the spacing at the edges: 2e-3 with 140 nodes along the contact.
    CHECK(solve(scene).rolling_resistance == Approx(exact).epsilon(3e-3));
  }
}

TEST_CASE("at small speeds R_r/P is V τ'/R, whatever the material", "[core][material]") {
  for (const MaterialInputs& layer : {wide_prony(), filled_rubber()}) {
    RollingScene scene = with_material(frictionless(paper_cylinder()), layer);
    scene.spacing.reset();
    scene.load = 1e3;  // (a/R)^2 = 0.005: the limit is that of a parabola
    scene.speed = 1e-8;
    const RollingSolution solution = solve(scene);
    CAPTURE(name_of(layer.material));
    CHECK(solution.rolling_resistance_coefficient ==
          Approx(scene.speed * slow_loss_time(creep_spectrum(layer)) / scene.radius).epsilon(5e-3));
  }
}

TEST_CASE("a colder layer is a faster one", "[core][material]") {
  RollingScene scene = with_material(paper_cylinder(), filled_rubber());
  scene.reference_temperature = 293.15;
  scene.wlf_c1 = 4.41;
  scene.wlf_c2 = 137.64;
  RollingScene cold = scene;
  cold.temperature = 253.15;
  scene.speed *= std::pow(10, 4.41 * 40 / (137.64 - 40));
  CHECK(solve(cold).rolling_resistance == Approx(solve(scene).rolling_resistance).epsilon(1e-9));
}

TEST_CASE("terms of a memory far shorter than the contact leave no trace in the rolling resistance",
          "[core][material]") {
  RollingScene scene = with_material(frictionless(paper_cylinder()), wide_prony());
  scene.spacing.reset();
  const double few = solve(scene).rolling_resistance;
  for (const double time : {1e-12, 3e-12, 1e-11}) {
    scene.relaxation_times.push_back(time);
    scene.relaxation_moduli.push_back(3e5);
  }
  // The longest of them holds V τ/l = 1e-10, and 5 % of the modulus.
  CHECK(solve(scene).rolling_resistance == Approx(few).epsilon(1e-8));
}
