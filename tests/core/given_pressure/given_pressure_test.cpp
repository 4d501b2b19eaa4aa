// Covers loss_by_waves, too.

// A given pressure without a body: closed forms of the half-space, the resistance by two routes, and relations.

#include <cmath>

#include "core/model/scene_rules.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

constexpr double radius = 0.05, modulus = 1e6, load = 500, mean = load / (M_PI * radius * radius);
constexpr PressureShape shapes[] = {PressureShape::ellipse, PressureShape::rectangle};
constexpr PressureDistribution distributions[] = {PressureDistribution::uniform, PressureDistribution::hertz};

RollingScene pressed() {
  RollingScene scene;
  scene.indenter = Indenter::pressure;
  scene.radius = radius;
  scene.load = load;
  scene.speed = 2;
  scene.layer_thickness = 0.03;
  scene.poisson_ratio = 0.45;
  scene.static_shear_modulus = modulus;
  scene.stiffening = 1;
  scene.creep_time = 0.02;
  return scene;
}

RollingScene on_elastic_half_space() {
  RollingScene scene = pressed();
  scene.material = MaterialModel::elastic;
  scene.layer_thickness = INFINITY;
  return scene;
}

BondedLayer as_layer(const RollingScene& scene, double thickness) {
  BondedLayer layer;
  static_cast<MaterialInputs&>(layer) = scene;
  layer.layer_thickness = thickness;
  layer.layer_density = scene.layer_density;
  return layer;
}

/// That of a scene which must have one.
RollingSolution converged(const RollingScene& scene) {
  RollingSolution solution = solve(scene);
  INFO(solution.reason);
  REQUIRE(solution.status == Status::converged);
  return solution;
}

/// Three layers, the last one infinitely thick.
RollingScene on_three_layers() {
  RollingScene scene = pressed();
  RollingScene softer = scene;
  softer.static_shear_modulus = 0.3e6;
  softer.creep_time = 0.005;
  scene.lower_layers = {as_layer(softer, 0.05), as_layer(on_elastic_half_space(), INFINITY)};
  return scene;
}

}  // namespace

TEST_CASE("a disc of pressure dents an elastic half-space as Boussinesq and Hertz say", "[core][given_pressure]") {
  RollingScene scene = on_elastic_half_space();
  scene.deflection_places_x = {radius, 0, 3 * radius};
  scene.deflection_places_y = {0, -radius, 4 * radius};
  const double yield = (1 - scene.poisson_ratio) / (2 * modulus);  // (1 - nu^2)/E
  const double far = load * yield / (M_PI * 5 * radius);  // of a point load; the disc's next term is a^2/(8 r^2)

  const RollingSolution uniform = converged(scene);
  CHECK(uniform.deflection == Approx(2 * yield * mean * radius).epsilon(2e-5));
  CHECK(uniform.deflections[0] == Approx(4 / M_PI * yield * mean * radius).epsilon(1e-4));
  CHECK(std::abs(uniform.deflections[0] - 4 / M_PI * yield * mean * radius) < uniform.deflection_error);
  CHECK(uniform.deflections[1] == Approx(uniform.deflections[0]).epsilon(1e-6));
  CHECK(uniform.deflections[2] == Approx(far * (1 + 1.0 / 200)).epsilon(2e-4));
  CHECK(std::abs(uniform.deflection - 2 * yield * mean * radius) < uniform.deflection_error);
  CHECK(uniform.peak_deflection == Approx(uniform.deflection).epsilon(1e-6));
  CHECK(std::abs(uniform.rolling_resistance) < 1e-12 * load);
  CHECK(uniform.peak_pressure == Approx(mean));

  scene.pressure_distribution = PressureDistribution::hertz;
  const RollingSolution hertz = converged(scene);
  CHECK(hertz.deflection == Approx(0.75 * M_PI * yield * mean * radius).epsilon(1e-4));
  CHECK(hertz.deflections[0] == Approx(0.375 * M_PI * yield * mean * radius).epsilon(1e-3));
  CHECK(std::abs(hertz.deflections[0] - 0.375 * M_PI * yield * mean * radius) < hertz.deflection_error);
  CHECK(std::abs(hertz.deflection - 0.75 * M_PI * yield * mean * radius) < hertz.deflection_error);
  CHECK(hertz.peak_pressure == Approx(1.5 * mean));
}

TEST_CASE("a rectangle of pressure dents an elastic half-space as Love says", "[core][given_pressure]") {
  RollingScene scene = on_elastic_half_space();
  scene.pressure_shape = PressureShape::rectangle;
  scene.transverse_radius = 3 * radius;
  scene.deflection_places_x = {radius};
  scene.deflection_places_y = {3 * radius};
  const double yield = (1 - scene.poisson_ratio) / (2 * modulus), pressure = load / (12 * radius * radius);
  const auto corner = [&](double a, double b) {
    const double c = std::hypot(a, b);
    return yield * pressure / M_PI * (a * std::log((b + c) / a) + b * std::log((a + c) / b));
  };
  const RollingSolution found = converged(scene);
  CHECK(found.deflection == Approx(4 * corner(radius, 3 * radius)).epsilon(2e-5));
  CHECK(found.deflections[0] == Approx(corner(2 * radius, 6 * radius)).epsilon(1e-4));
  CHECK(found.contact_area == Approx(12 * radius * radius));
}

// The sum over the cells of the grid knows the surface by its influence coefficients, the waves by its compliances.
// With a wrong sign of a cross term, or a wrong transform, they part by tens of per cent.
TEST_CASE("the resistance of a given pressure wave by wave is that of the sum over its cells",
          "[core][given_pressure]") {
  for (const RollingScene& layers : {pressed(), on_three_layers()})
    for (const PressureShape shape : shapes)
      for (const PressureDistribution distribution : distributions)
        for (const double traction : {0.0, 0.6, -0.6}) {
          RollingScene scene = layers;
          scene.pressure_shape = shape;
          scene.pressure_distribution = distribution;
          scene.transverse_radius = 0.6 * radius;
          scene.traction_coefficient = traction;
          const RollingSolution found = converged(scene);
          CAPTURE(name_of(shape), name_of(distribution), traction, scene.lower_layers.size());
          CHECK(found.rolling_resistance > 0);
          CHECK(found.energy_residual < 5e-3);
          CHECK(found.error_estimate < 2e-6);
        }
}

TEST_CASE("with finer cells both routes to the resistance tend together", "[core][given_pressure]") {
  RollingScene scene = pressed();
  scene.spacing = 2 * radius / 31;
  const double coarse = converged(scene).energy_residual;
  scene.spacing = 2 * radius / 127;
  CHECK(converged(scene).energy_residual < 0.3 * coarse);
}

TEST_CASE("Hertz's pressure that is given loses in slow motion what a sphere loses that makes it",
          "[core][given_pressure]") {
  RollingScene sphere = pressed();
  sphere.indenter = Indenter::sphere;
  sphere.layer_thickness = INFINITY;
  sphere.load = 20;
  sphere.creep_time = 1e-6;
  sphere.tolerance = 1e-3;
  sphere.inertia = Inertia::off;
  const RollingSolution rolled = converged(sphere);
  RollingScene given = sphere;
  given.indenter = Indenter::pressure;
  given.pressure_distribution = PressureDistribution::hertz;
  given.radius = std::sqrt(rolled.contact_area / M_PI);
  const RollingSolution found = converged(given);
  CHECK(found.rolling_resistance == Approx(rolled.rolling_resistance).epsilon(5e-3));
  CHECK(found.deflection == Approx(rolled.approach).epsilon(2e-3));
  CHECK(found.peak_pressure == Approx(rolled.peak_pressure).epsilon(5e-3));
}

TEST_CASE("under a given pressure a layer cut in two, other units and both sides of the path change nothing",
          "[core][given_pressure]") {
  RollingScene scene = pressed();
  scene.traction_coefficient = 0.3;
  scene.deflection_places_x = {-0.08, -0.08};
  scene.deflection_places_y = {0.07, -0.07};
  const RollingSolution whole = converged(scene);
  CHECK(whole.deflections[0] == whole.deflections[1]);

  RollingScene cut = scene;
  cut.layer_thickness = 0.01;
  cut.lower_layers = {as_layer(scene, 0.02)};
  const RollingSolution other = converged(cut);
  CHECK(other.rolling_resistance == Approx(whole.rolling_resistance).epsilon(2e-6));
  CHECK(other.deflection == Approx(whole.deflection).epsilon(1e-5));
  CHECK(other.deflections[0] == Approx(whole.deflections[0]).epsilon(1e-5));

  RollingScene larger = scene;  // lengths 10 times, pressures twice
  for (double* const length :
       {&larger.radius, &larger.layer_thickness, &larger.speed, &larger.deflection_places_x[0],
        &larger.deflection_places_x[1], &larger.deflection_places_y[0], &larger.deflection_places_y[1]})
    *length *= 10;
  *larger.load *= 200;
  *larger.static_shear_modulus *= 2;
  const RollingSolution scaled = converged(larger);
  CHECK(scaled.rolling_resistance == Approx(200 * whole.rolling_resistance).epsilon(1e-9));
  CHECK(scaled.deflections[0] == Approx(10 * whole.deflections[0]).epsilon(1e-9));
}

// The inside knows the tractions alone: strains and stresses at all depths, integrated over the layers.
TEST_CASE("what a given pressure loses inside the layers is its resistance", "[core][given_pressure]") {
  for (const PressureDistribution distribution : distributions)
    for (const double traction : {0.0, 0.6}) {
      RollingScene scene = pressed();
      scene.pressure_distribution = distribution;
      scene.traction_coefficient = traction;
      scene.transverse_radius = 1.5 * radius;
      scene.interior = Interior::on;
      const RollingSolution found = converged(scene);
      CAPTURE(name_of(distribution), traction);
      CHECK(found.interior_loss == Approx(found.viscous_loss).epsilon(1e-2));
      CHECK(found.peak_shear_strain > 0);
      CHECK(found.bond_shear > 0);
    }
}

TEST_CASE("moduli that fall with the strain make a given pressure sink deeper, and small strains leave them",
          "[core][given_pressure]") {
  RollingScene scene = pressed();
  const RollingSolution linear = converged(scene);
  scene.payne_drop = 0.5;
  scene.payne_strain = 0.002;
  const RollingSolution soft = converged(scene);
  CHECK(soft.softening < 0.9);
  // Half of the modulus at most, and a loss that grows as the square of the dent.
  CHECK(soft.peak_deflection > 1.05 * linear.peak_deflection);
  CHECK(soft.peak_deflection < 2 * linear.peak_deflection);
  scene.payne_strain = 100;
  CHECK(converged(scene).rolling_resistance == Approx(linear.rolling_resistance).epsilon(1e-3));
}

// 150 mm of 3 GPa on 600 mm of 200 MPa on a half-space of 40 MPa under a disc of 300 mm and 1.1 MPa. The numbers are
// Hankel integrals of a transfer-matrix solution by another program.
TEST_CASE("three elastic layers under a disc of pressure sink as Hankel's integral says", "[core][given_pressure]") {
  RollingScene scene = on_elastic_half_space();
  scene.radius = 0.15;
  scene.load = 1.1e6 * M_PI * 0.15 * 0.15;
  const auto layer = [&](double thickness, double young, double poisson) {
    RollingScene material = scene;
    material.static_shear_modulus = young / (2 * (1 + poisson));
    material.poisson_ratio = poisson;
    return as_layer(material, thickness);
  };
  scene.lower_layers = {layer(0.6, 200e6, 0.35), layer(INFINITY, 40e6, 0.4)};
  static_cast<MaterialInputs&>(scene) = layer(0.15, 3e9, 0.3);
  scene.layer_thickness = 0.15;
  scene.deflection_places_x = {1, 0, -0.05};
  scene.deflection_places_y = {0.3, 0.3, 0.3};
  const RollingSolution found = converged(scene);
  CHECK(found.deflections[0] == Approx(0.452496e-3).epsilon(5e-5));
  CHECK(found.deflections[1] == Approx(0.809526e-3).epsilon(5e-5));
  CHECK(found.deflections[2] == Approx(0.806065e-3).epsilon(5e-5));
}

TEST_CASE("a given pressure refuses what belongs to a body, by name", "[core][given_pressure]") {
  const auto refused = [](auto change) {
    RollingScene scene = pressed();
    change(scene);
    const std::vector<std::string> broken = check(scene);
    return broken.empty() ? std::string() : broken.front();
  };
  using Catch::Matchers::StartsWith;
  CHECK(refused([](RollingScene&) {}).empty());
  CHECK_THAT(refused([](RollingScene& s) { s.friction_coefficient = 0.1; }),
             StartsWith("friction_coefficient = 0.1: "));
  CHECK_THAT(refused([](RollingScene& s) { s.method = Method::newton; }), StartsWith("method = newton: "));
  CHECK_THAT(refused([](RollingScene& s) { s.skew_angle = 0.1; }), StartsWith("skew_angle = 5.7296 deg: "));
  CHECK_THAT(refused([](RollingScene& s) { s.spacing = 0.04; }), StartsWith("spacing = 0.04: "));
  CHECK_THAT(refused([](RollingScene& s) { s.coating_layers.emplace_back(as_layer(s, 0.001)); }),
             StartsWith("coating_layers: "));
  CHECK_THAT(refused([](RollingScene& s) { s.deflection_places_x = {1}; }), StartsWith("deflection_places_y: "));
  CHECK_THAT(refused([](RollingScene& s) { s.heat = Heat::on; }), StartsWith("heat = on: "));
  CHECK_THAT(refused([](RollingScene& s) { s.period = 1; }), StartsWith("period: "));
  CHECK_THAT(refused([](RollingScene& s) { s.indenter = Indenter::sphere, s.traction_coefficient = 0.1; }),
             StartsWith("traction_coefficient = 0.1: only with indenter"));
  CHECK_THAT(refused([](RollingScene& s) { s.indenter = Indenter::sphere, s.method = Method::convolution; }),
             StartsWith("method = convolution: only with indenter"));
}
