#include "core/estimate/composite_estimate.hpp"

#include "tests/catch.hpp"
#include "tests/infinite.hpp"

using namespace rollres;

namespace {

/// A layer of 1 MPa on another of the same.
RollingScene two_layers(Indenter indenter, double thickness) {
  RollingScene scene;
  scene.indenter = indenter;
  scene.radius = 0.1;
  scene.layer_thickness = thickness / 2;
  scene.static_shear_modulus = 1e6;
  scene.material = MaterialModel::elastic;
  scene.speed = 1;
  scene.load = indenter == Indenter::sphere ? 20 : 2000;
  BondedLayer below;
  static_cast<MaterialInputs&>(below) = scene;
  below.layer_thickness = thickness / 2;
  scene.lower_layers = {below};
  return scene;
}

}  // namespace

TEST_CASE("on layers that make a half-space the estimate is Hertz's contact", "[core][composite_estimate]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    RollingScene scene = two_layers(indenter, 0.01);
    scene.lower_layers.front().layer_thickness = infinite;
    const ContactEstimate hertz =
        elastic_contact_from_load(dimension_of(indenter), scene.radius, Layer(infinite), 1e6, *scene.load);
    CHECK(composite_estimate(scene).half_width == Approx(hertz.half_width).epsilon(2e-3));
  }
}

TEST_CASE("on bonded layers of one material the estimate is that of their thickness within 30 %",
          "[core][composite_estimate]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere})
    for (const double thickness : {0.002, 0.01, 0.05}) {
      const RollingScene scene = two_layers(indenter, thickness);
      const ContactEstimate one =
          elastic_contact_from_load(dimension_of(indenter), scene.radius, Layer(thickness), 1e6, *scene.load);
      INFO("thickness " << thickness);
      CHECK(composite_estimate(scene).half_width == Approx(one.half_width).epsilon(0.3));
    }
}

TEST_CASE("Hertz's pressure on an elastic half-space has the compliance of the closed form and no loss",
          "[core][composite_estimate]") {
  RollingScene scene = two_layers(Indenter::sphere, 0.01);
  scene.lower_layers.front().layer_thickness = infinite;
  const double a = 2e-3;
  // int p w dA/P^2 = 3 (1 - nu)/(10 G a), as w falls with (2 a^2 - r^2) and the mean of r^2 under p is 2 a^2/5.
  const HertzResponse response = hertz_response(scene, a);
  const double mean_displacement = 0.3 * (1 - 0.5) / (1e6 * a);
  CHECK(response.compliance == Approx(mean_displacement).epsilon(2e-3));
  CHECK(response.slope == Approx(-mean_displacement / a).epsilon(5e-3));
  CHECK(response.loss == Approx(0).margin(1e-12));
}
