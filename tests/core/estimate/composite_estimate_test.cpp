#include "core/estimate/composite_estimate.hpp"

#include <cmath>

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

TEST_CASE("in slow motion waves take the power of a half-space as the squares of Bessel functions say",
          "[core][composite_estimate]") {
  RollingScene scene = two_layers(Indenter::cylinder, infinite);
  scene.lower_layers.clear();
  scene.material = MaterialModel::zener;
  scene.stiffening = 1;
  scene.creep_time = 1e-6;
  constexpr double a = 2e-3;
  const auto band = loss_band(scene, a);
  REQUIRE(band);
  // Im c ~ 1/k * k and phi = 2 J1(z)/z: up to z, int J1^2/z dz = (1 - J0^2 - J1^2)/2; the estimate's waves end at 40.
  const auto taken = [](double z) { return 1 - std::pow(::j0(z), 2) - std::pow(::j1(z), 2); };
  const auto z = [&](double frequency) { return 2 * M_PI * frequency * a / scene.speed; };
  CHECK(taken(z(band->lowest)) == Approx(0.1 * taken(40)).epsilon(0.03));
  CHECK(taken(z(band->highest)) == Approx(0.9 * taken(40)).epsilon(0.01));
  scene.material = MaterialModel::elastic;
  CHECK_FALSE(loss_band(scene, a));
}

TEST_CASE("in slow motion the frequencies of the losses rise with the speed, under a sphere too",
          "[core][composite_estimate]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    RollingScene scene = two_layers(indenter, 0.01);
    for (MaterialInputs* const layer :
         {static_cast<MaterialInputs*>(&scene), static_cast<MaterialInputs*>(&scene.lower_layers[0])}) {
      layer->material = MaterialModel::zener;
      layer->stiffening = 1;
      layer->creep_time = 1e-9;
    }
    const auto slow = loss_band(scene, 2e-3);
    scene.speed *= 8;
    const auto fast = loss_band(scene, 2e-3);
    REQUIRE((slow && fast));
    CHECK(fast->lowest == Approx(8 * slow->lowest).epsilon(1e-6));
    CHECK(fast->highest == Approx(8 * slow->highest).epsilon(1e-6));
    CHECK(slow->lowest < slow->highest);
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
