#include "core/model/indenter_shape.hpp"

#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

TEST_CASE("the profile of the body is its arc, and the slope its derivative", "[core][indenter_shape]") {
  for (const RollingScene& scene : {paper_cylinder(), paper_sphere()}) {
    const IndenterShape shape(scene);
    const double radius = scene.radius, y = ContactModel(scene).dimension == 3 ? 0.3 * radius : 0, step = 1e-5 * radius;
    for (const double part : {-0.8, -0.1, 0.0, 0.4}) {
      const double x = part * radius;
      CHECK(shape.covers(x, y));
      CHECK(radius - shape.profile(x, y) == Approx(std::sqrt(radius * radius - x * x - y * y)).epsilon(1e-14));
      const double difference = (shape.profile(x + step, y) - shape.profile(x - step, y)) / (2 * step);
      CHECK(shape.slope(x, y) == Approx(difference).margin(1e-8));
    }
    CHECK_FALSE(shape.covers(radius, y));
  }
}

TEST_CASE("tractions on a cylinder's arc are turned, not changed, by their lever arms", "[core][indenter_shape]") {
  const IndenterShape shape(paper_cylinder());
  const double x = 0.6 * shape.radius(), pressure = 3, shear = -2;
  const double load = shape.load(x)(pressure, shear), force = shape.driving_force(x)(pressure, shear);
  CHECK(load * load + force * force == Approx(pressure * pressure + shear * shear).epsilon(1e-14));
  // Their moment about the axis, by components on the arc at (x, -q).
  CHECK(shape.torque(x)(pressure, shear) ==
        Approx(load * x - force * shape.height(x)).epsilon(1e-13).margin(1e-15 * shape.radius()));
}

TEST_CASE("what the lever arms leave unbalanced falls with the square of the slope", "[core][indenter_shape]") {
  for (const RollingScene& scene : {paper_cylinder(), paper_sphere()}) {
    const IndenterShape shape(scene);
    const auto at = [&](double x) { return shape.unbalanced_power(1, x); };
    for (const double x : {0.2 * scene.radius, 0.1 * scene.radius}) {
      // Under pressure the third power of x, under shear the second; the next terms are two powers higher.
      CHECK(at(x).of_pressure / at(0.5 * x).of_pressure == Approx(8).epsilon(0.05));
      CHECK(at(x).of_shear_x / at(0.5 * x).of_shear_x == Approx(4).epsilon(0.05));
    }
  }
}
