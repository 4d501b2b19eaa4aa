#include "core/estimate/composite_estimate.hpp"

#include "tests/catch.hpp"
#include "tests/infinite.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

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

TEST_CASE("the estimate on several layers is the same in other units of length", "[core][composite_estimate]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    const RollingScene scene = two_layers(indenter, 0.01);
    RollingScene other = scene;
    constexpr double length = 32;
    other.radius *= length;
    other.layer_thickness *= length;
    other.lower_layers.front().layer_thickness *= length;
    *other.load *= indenter == Indenter::sphere ? length * length : length;
    // A search that ends where a logarithm of metres is known to 1e-3 differs by 5e-5.
    CHECK(composite_estimate(other).half_width == Approx(length * composite_estimate(scene).half_width).epsilon(1e-10));
  }
}

TEST_CASE("where no contact answers the load or the approach, the estimates name it", "[core][contact_estimate]") {
  CHECK_THROWS_WITH(elastic_contact_from_load(2, 1e200, Layer(1e-60), 1e6, 1e200),
                    Contains("load = 1e+200: no contact"));
  CHECK_THROWS_WITH(elastic_contact_from_approach(3, 1e200, Layer(1e-60), 1e6, 1e200),
                    Contains("approach = 1e+200: no contact"));
  RollingScene scene = two_layers(Indenter::cylinder, 0.01);
  scene.load = 1e-200;
  CHECK_THROWS_WITH(composite_estimate(scene), Contains("load = 1e-200: no contact"));
}
