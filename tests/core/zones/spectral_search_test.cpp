// Covers spectral_start, too.

#include "core/zones/spectral_search.hpp"

#include <cmath>

#include "core/model/contact_surface.hpp"
#include "core/zones/spectral_contact.hpp"
#include "tests/core/zones/spectral_scenes.hpp"

using namespace rollres;

TEST_CASE("with little friction the leading edge slips as well, and then stick and slip take turns",
          "[core][spectral]") {
  const double friction[] = {0.12, 0.10, 0.08}, resistance[] = {359.30478, 360.41078, 361.82921};
  for (int i = 0; i < 3; ++i) {
    const RollingSolution solution = spectral(gridless_cylinder(friction[i]));
    CHECK(solution.rolling_resistance == Approx(resistance[i]).epsilon(2e-8));
    CHECK(solution.energy_residual < 1e-8);
  }
  const RollingSolution turns = spectral(gridless_cylinder(0.05));
  RollingScene gridded = gridless_cylinder(0.05);
  gridded.spacing = 0.02e-3;
  // First order in the spacing: 5e-5 at this one.
  CHECK(turns.rolling_resistance == Approx(solve(gridded).rolling_resistance).epsilon(1e-4));
}

TEST_CASE("a short slip at the trailing edge turns round over speeds without a leap", "[core][spectral]") {
  // Between 10.3 and 10.8 mm/s the slip behind the stick shrinks to nothing and comes back the other way.
  const auto resistance = [](double speed) {
    RollingScene scene = gridless_cylinder(0.2);
    scene.kinematics = Kinematics::consistent;
    scene.speed = speed;
    const RollingSolution solution = spectral(scene);
    CHECK(solution.law_violation < 5e-9);
    CHECK(solution.frictional_loss >= 0);
    return solution.rolling_resistance;
  };
  for (const double speed : {0.01035, 0.0105, 0.01065}) {
    // By the cubic through four speeds around it, whose error is of the fourth order in the steps of 3 %, here 5e-7.
    // Without this slip R_r would be 5e-6 to 1.5e-5 off.
    const double step = 0.03 * speed;
    const double between = (4 * (resistance(speed - step) + resistance(speed + step)) -
                            (resistance(speed - 2 * step) + resistance(speed + 2 * step))) /
                           6;
    CHECK(resistance(speed) == Approx(between).epsilon(2e-6));
  }
}

TEST_CASE("a stick between slips in opposite directions is answered, of whatever order", "[core][spectral]") {
  // Nearly elastic cylinders pushed at the top; the middle of the stick was a border of the quadrature and of a check.
  struct {
    double radius, thickness, modulus, stiffening, creep_time, speed, load, friction;
  } const cases[] = {{.radius = 0.04425,
                      .thickness = 0.01051,
                      .modulus = 582400,
                      .stiffening = 0.01278,
                      .creep_time = 2.338,
                      .speed = 4.128,
                      .load = 122.8,
                      .friction = 0.04963},
                     {.radius = 0.026,
                      .thickness = 0.0424,
                      .modulus = 1341000,
                      .stiffening = 0.01438,
                      .creep_time = 8.614,
                      .speed = 1.267,
                      .load = 439.1,
                      .friction = 0.005772}};
  for (const auto& c : cases) {
    RollingScene scene = gridless_cylinder(c.friction);
    scene.radius = c.radius;
    scene.layer_thickness = c.thickness;
    scene.static_shear_modulus = c.modulus;
    scene.stiffening = c.stiffening;
    scene.creep_time = c.creep_time;
    scene.speed = c.speed;
    scene.load = c.load;
    const RollingSolution solution = solve(scene);
    CAPTURE(c.radius, solution.model);
    REQUIRE(solution.method == Method::spectral);
    CHECK(solution.law_violation < 1e-8);
    RollingScene gridded = scene;
    gridded.spacing = (solution.leading_edge - solution.trailing_edge) / 600;
    // The grid's own error: 0.5 % where R_r is so small a difference
    CHECK(solve(gridded).rolling_resistance == Approx(solution.rolling_resistance).epsilon(0.01));
  }
}

TEST_CASE("slip that turns round at the trailing edge is found without a grid", "[core][spectral]") {
  RollingScene scene;
  scene.indenter = Indenter::cylinder;
  scene.radius = 0.02937;
  scene.layer_thickness = INFINITY;
  scene.static_shear_modulus = 1.109e6;
  scene.stiffening = 0.6353;
  scene.creep_time = 0.1096;
  scene.speed = 0.7387;
  scene.friction_coefficient = 0.05921;
  scene.load = 13630;
  const RollingSolution found = spectral(scene);
  CHECK(found.energy_residual < 1e-8);
  scene.method = Method::newton;
  const RollingSolution gridded = solve(scene);
  CHECK(found.rolling_resistance == Approx(gridded.rolling_resistance).epsilon(gridded.error_estimate));
}

namespace {

/// A coated cylinder on the paper's layer, without its memory.
RollingScene coated_cylinder(double friction, double speed, double load) {
  RollingScene scene = gridless_cylinder(friction);
  scene.kinematics = Kinematics::consistent;
  scene.stiffening = 0;
  scene.speed = speed;
  scene.load = load;
  BondedLayer coating;
  coating.layer_thickness = 6e-3;
  coating.static_shear_modulus = 2e6;
  coating.stiffening = 1.5;
  coating.creep_time = 0.02;
  scene.coating_layers = {coating};
  return scene;
}

}  // namespace

TEST_CASE("zones of much the same scene lead to the same answer for a fraction of the work", "[core][spectral]") {
  const ContactModel model(coated_cylinder(0.01, 0.05, 4e3)), other = model.with_flow(1.004);
  const SpectralOutcome first = solve_spectral(model);
  REQUIRE(first.solution);
  REQUIRE(first.zones);
  const SpectralOutcome fresh = solve_spectral(other), near = solve_spectral(other, first.zones);
  REQUIRE(fresh.solution);
  REQUIRE(near.solution);
  CHECK(near.solution->rolling_resistance == Approx(fresh.solution->rolling_resistance).epsilon(1e-8));
  CHECK(near.solution->rolling_resistance != Approx(first.solution->rolling_resistance).epsilon(1e-8));
  CHECK(near.solution->rotation_ratio == Approx(fresh.solution->rotation_ratio).epsilon(1e-9));
  CHECK(2 * near.solution->iterations < fresh.solution->iterations);
}

TEST_CASE("zones of another scene that do not fit are left for those that do", "[core][spectral]") {
  const SpectralOutcome much = solve_spectral(coated_cylinder(0.5, 0.5, 1.2e4));
  const RollingScene scene = coated_cylinder(0.01, 0.05, 4e3);
  const SpectralOutcome fresh = solve_spectral(scene), near = solve_spectral(scene, much.zones);
  REQUIRE(fresh.solution);
  REQUIRE(near.solution);
  REQUIRE(fresh.zones->pattern.slips != much.zones->pattern.slips);
  CHECK(near.solution->rolling_resistance == Approx(fresh.solution->rolling_resistance).epsilon(1e-8));
}

TEST_CASE("a search for zones that leads away ends soon", "[core][spectral]") {
  const RollingScene scene = coated_cylinder(0.05, 0.03, 1.2e4);
  const SpectralProblem problem(scene, near_spectrum(scene), 5e-3);
  EdgeSearch search(problem, {.shear = true, .slips = {1, -1}});
  CHECK_FALSE(search.find({{-0.0049396, 0.0054536}, {{-0.0048812, -0.0046745}}}, {8, 8}, 1e-9));
  CHECK(search.evaluations() < 80);
}
