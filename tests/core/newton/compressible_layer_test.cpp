/// Bodies on compressible layers: Poisson's ratio below one half.

#include <cmath>

#include "core/derivatives/objective.hpp"
#include "core/estimate/contact_estimate.hpp"
#include "core/model/scene_rules.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/infinite.hpp"

using namespace rollres;

namespace {

RollingScene elastic_scene(Indenter indenter, const Layer& layer) {
  RollingScene scene;
  scene.indenter = indenter;
  scene.radius = 1;
  scene.layer_thickness = layer.thickness;
  scene.poisson_ratio = layer.poisson_ratio;
  scene.material = MaterialModel::elastic;
  scene.static_shear_modulus = 1e6;
  scene.speed = 1;
  return scene;
}

}  // namespace

TEST_CASE("a sphere on a compressible half-space has Hertz's contact", "[core][compressible_layer]") {
  for (const double nu : {0.0, 0.3}) {
    RollingScene scene = elastic_scene(Indenter::sphere, {infinite, nu});
    const double a = 0.005, modulus = 2e6 / (1 - nu);  // E* = 2 G/(1 - nu)
    scene.load = 4 * modulus * a * a * a / 3;
    scene.spacing = a / 20;
    const RollingSolution s = solve(scene);
    INFO("nu = " << nu);
    REQUIRE(s.status == Status::converged);
    // As for the incompressible half-space: the grid's second order.
    CHECK(s.approach == Approx(a * a).epsilon(0.03 / 400 + a * a));
    CHECK(s.peak_pressure == Approx(2 * modulus * a / M_PI).epsilon(0.1 / 400 + a * a));
  }
}

TEST_CASE("a thin compressible layer is a foundation of modulus 2 G (1 - nu)/(1 - 2 nu)",
          "[core][compressible_layer]") {
  // Johnson (1985), section 5.8: P = pi K a^4/(4 R H) for a sphere, 2 K a^3/(3 R H) for a cylinder, d = a^2/2R.
  const double a = 0.01, thickness = a / 60, nu = 0.2, foundation = 2e6 * (1 - nu) / (1 - 2 * nu);
  for (const Indenter indenter : {Indenter::sphere, Indenter::cylinder}) {
    const bool sphere = indenter == Indenter::sphere;
    RollingScene scene = elastic_scene(indenter, {thickness, nu});
    scene.approach = a * a / 2;
    scene.spacing = a / (sphere ? 30 : 200);
    const RollingSolution s = solve(scene);
    INFO(name_of(indenter));
    REQUIRE(s.status == Status::converged);
    const double limit = foundation / thickness * (sphere ? M_PI * std::pow(a, 4) / 4 : 2 * std::pow(a, 3) / 3);
    CHECK(s.load == Approx(limit).epsilon(4 * thickness / a));  // the edge's width, about H on either side
    CHECK(s.peak_pressure == Approx(foundation / thickness * a * a / 2).epsilon(0.01));
  }
}

TEST_CASE("the resistance is continuous as a layer becomes incompressible", "[core][compressible_layer]") {
  for (const RollingScene& paper : {paper_cylinder(), paper_sphere()}) {
    const RollingSolution limit = solve(paper);
    double last = 0;
    for (const double missing : {1e-3, 1e-4, 1e-5}) {
      RollingScene scene = paper;
      scene.poisson_ratio = 0.5 - missing;
      const RollingSolution s = solve(scene);
      INFO(name_of(paper.indenter) << ", nu = 1/2 - " << missing);
      REQUIRE(s.status == Status::converged);
      CHECK(s.law_violation < 1e-8);
      CHECK(s.energy_residual < 2 * limit.energy_residual);
      // Softer by about 5 (1 - 2 nu) in a contact about as wide as the layer is thick, in proportion.
      const double change = s.rolling_resistance / limit.rolling_resistance - 1;
      CHECK(change > 0);
      CHECK(change < 10 * missing);
      if (last != 0) CHECK(change == Approx(0.1 * last).epsilon(0.1));
      last = change;
    }
  }
}

TEST_CASE("with friction on a compressible layer every law of contact holds and the power balances",
          "[core][compressible_layer]") {
  for (RollingScene scene : {paper_cylinder(), paper_sphere()})
    for (const double nu : {0.0, 0.3, 0.45}) {
      scene.poisson_ratio = nu;
      const RollingSolution s = solve(scene);
      INFO(name_of(scene.indenter) << ", nu = " << nu);
      REQUIRE(s.status == Status::converged);
      CHECK(s.law_violation < 1e-8);
      CHECK(s.energy_residual < 5e-3);
    }
}

TEST_CASE("the estimate of a contact on a compressible layer is within a fifth", "[core][compressible_layer]") {
  for (const Indenter indenter : {Indenter::sphere, Indenter::cylinder})
    for (const double nu : {0.0, 0.3, 0.45, 0.49})
      for (const double thickness : {0.03, 0.005, 0.001, 0.0003}) {
        RollingScene scene = elastic_scene(indenter, {thickness, nu});
        scene.load = indenter == Indenter::sphere ? 5.0 : 500.0;
        const ContactEstimate estimate = elastic_contact_from_load(dimension_of(indenter), 1, {thickness, nu},
                                                                   *scene.static_shear_modulus, *scene.load);
        scene.spacing = estimate.half_width / 20;
        const RollingSolution s = solve(scene);
        INFO(name_of(indenter) << ", nu = " << nu << ", H = " << thickness << ", a = " << estimate.half_width);
        REQUIRE(s.status == Status::converged);
        const double found = indenter == Indenter::sphere ? std::sqrt(s.contact_area / M_PI) : 0.5 * s.contact_area;
        CHECK(estimate.half_width == Approx(found).epsilon(0.2));
        const ContactEstimate back =
            elastic_contact_from_approach(dimension_of(indenter), 1, {thickness, nu}, 1e6, estimate.approach);
        CHECK(back.half_width == Approx(estimate.half_width).epsilon(1e-9));
      }
}

TEST_CASE("where compressibility under a coating varies one method solves all points", "[core][compressible_layer]") {
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  scene.poisson_ratio = 0.4;
  scene.coating_layers.resize(1);
  static_cast<MaterialInputs&>(scene.coating_layers[0]) = scene;
  scene.coating_layers[0].layer_thickness = 1e-3;
  const Objective f = objective(scene, {{"poisson_ratio"}}, "rolling_resistance", solve);
  const std::vector<double> end{0.5};
  CHECK(resolved_method(scene_at(f, end)) == Method::newton);
}
