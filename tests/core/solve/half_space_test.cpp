/// Bodies on a half-space without friction: Hertz, Hunter, and the viscoelastic cylinder of CONTACT's examples.

#include <array>
#include <cmath>

#include "core/reference/reference_solutions.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/infinite.hpp"

using namespace rollres;

namespace {

RollingScene on_half_space(Indenter indenter) {
  RollingScene scene;
  scene.indenter = indenter;
  scene.radius = 1;
  scene.layer_thickness = infinite;
  scene.static_shear_modulus = 1e6;
  scene.speed = 1;
  return scene;
}

/// Largest difference of the pressure to a closed form over its peak, inside `share` of the half-width around `centre`.
template <class Closed>
double pressure_error(const RollingSolution& s, const Closed& closed, double centre, double half_width, double share) {
  const SurfaceGrid& grid = s.fields.grid;
  double worst = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const double x = grid.x(column), y = grid.rows > 1 ? grid.y(row) : 0, r = std::hypot(x - centre, y);
      if (r > share * half_width) continue;
      const double expected = closed.pressure(grid.rows > 1 ? r : x);
      const double got = s.fields.pressure[static_cast<std::size_t>(grid.index(column, row))];
      worst = std::max(worst, std::abs(got - expected) / closed.peak_pressure);
    }
  return worst;
}

/// Cylinder on a Zener half-space whose rubbery half-width is R/100, V tau = `ratio` of it.
RollingScene hunter_scene(double ratio, double stiffening) {
  RollingScene scene = on_half_space(Indenter::cylinder);
  const double half_width = 0.01;
  scene.load = M_PI * *scene.static_shear_modulus * half_width * half_width / scene.radius;
  scene.stiffening = stiffening;
  scene.creep_time = ratio * half_width / scene.speed;
  scene.spacing = half_width / 100;
  return scene;
}

HunterLine closed_form(const RollingScene& s) {
  return hunter_line(s.radius, *s.load, *s.static_shear_modulus, s.stiffening, s.creep_time, s.speed);
}

}  // namespace

TEST_CASE("a rigid cylinder on an elastic half-space has Hertz's half-width and pressure", "[core][half_space]") {
  RollingScene scene = on_half_space(Indenter::cylinder);
  scene.material = MaterialModel::elastic;
  const double a = 0.005;
  scene.load = M_PI * 1e6 * a * a;
  const HertzLine hertz = hertz_line(1, *scene.load, 1e6);
  for (const int nodes : {20, 40, 80, 200}) {
    scene.spacing = a / nodes;
    const RollingSolution s = solve(scene);
    INFO(nodes << " nodes in half the contact");
    REQUIRE(s.status == Status::converged);
    CHECK(s.law_violation < 1e-8);
    // The contact is a whole number of cells.
    CHECK(std::abs(0.5 * s.contact_area - a) <= *scene.spacing);
    // Second order inside, and the body's own curvature: (a/R)^2/8.
    CHECK(s.peak_pressure == Approx(hertz.peak_pressure).epsilon(0.1 / (nodes * nodes) + a * a));
    CHECK(pressure_error(s, hertz, 0, a, 0.8) < 0.3 / (nodes * nodes) + a * a);
    // Nothing is lost in an elastic layer.
    CHECK(std::abs(s.rolling_resistance_coefficient) < 1e-10 * a);
  }
}

TEST_CASE("a rigid sphere on an elastic half-space has Hertz's contact, approach and pressure", "[core][half_space]") {
  RollingScene scene = on_half_space(Indenter::sphere);
  scene.material = MaterialModel::elastic;
  const double a = 0.005;
  scene.load = 16e6 * a * a * a / 3;
  const HertzSphere hertz = hertz_sphere(1, *scene.load, 1e6);
  for (const int nodes : {10, 20}) {
    scene.spacing = a / nodes;
    const RollingSolution s = solve(scene);
    INFO(nodes << " nodes in half the contact");
    REQUIRE(s.status == Status::converged);
    CHECK(s.law_violation < 1e-8);
    CHECK(std::sqrt(s.contact_area / M_PI) == Approx(a).epsilon(0.2 / nodes));  // whole cells
    CHECK(s.approach == Approx(hertz.approach).epsilon(0.03 / (nodes * nodes) + a * a));
    CHECK(s.peak_pressure == Approx(hertz.peak_pressure).epsilon(0.1 / (nodes * nodes) + a * a));
    CHECK(pressure_error(s, hertz, 0, a, 0.8) < 0.3 / (nodes * nodes) + a * a);
  }
}

TEST_CASE("a cylinder on a viscoelastic half-space rolls as Hunter says", "[core][half_space]") {
  // R_r R/(P a0) for f = 1, printed to five digits.
  struct Row {
    double ratio, resistance;
  };
  for (const auto& [ratio, resistance] :
       {Row{0.1, 0.046258}, {0.3, 0.116896}, {1, 0.196843}, {3, 0.151414}, {10, 0.075388}, {100, 0.013294}}) {
    const RollingScene scene = hunter_scene(ratio, 1);
    const HunterLine hunter = closed_form(scene);
    const RollingSolution s = solve(scene);
    INFO("V tau/a0 = " << ratio);
    REQUIRE(s.status == Status::converged);
    CHECK(s.law_violation < 1e-8);
    // At 200 nodes across, the jumps of the edge: a few 1e-3.
    CHECK(s.rolling_resistance_coefficient * scene.radius / 0.01 == Approx(resistance).epsilon(0.005));
    CHECK(s.rolling_resistance == Approx(hunter.rolling_resistance).epsilon(0.005));
    CHECK(std::abs(s.leading_edge - hunter.leading_edge()) < 1.5 * *scene.spacing);
    CHECK(std::abs(s.trailing_edge - hunter.trailing_edge()) < 1.5 * *scene.spacing);
    CHECK(s.peak_pressure == Approx(hunter.peak_pressure).epsilon(0.005));
    // Near the leading edge the pressure's slope is large: 2 nodes of 200.
    CHECK(pressure_error(s, hunter, hunter.centre, hunter.half_width, 0.8) < 0.02);
  }
}

TEST_CASE("a layer of thirty contact lengths is a half-space for a cylinder of short memory", "[core][half_space]") {
  for (const double ratio : {0.3, 1.0, 3.0}) {
    RollingScene scene = hunter_scene(ratio, 1);
    scene.layer_thickness = 30 * 2 * 0.01;
    const RollingSolution s = solve(scene);
    INFO("V tau/a0 = " << ratio);
    REQUIRE(s.status == Status::converged);
    CHECK(s.law_violation < 1e-8);
    CHECK(s.rolling_resistance == Approx(closed_form(scene).rolling_resistance).epsilon(0.01));
  }
}

TEST_CASE("the resistance of a stiffening half-space peaks where Hunter's does", "[core][half_space]") {
  struct Peak {
    double stiffening, ratio, resistance;
  };
  for (const auto& [stiffening, ratio, resistance] : {Peak{1, 1.10, 0.1973}, {9, 1.37, 0.4829}, {99, 1.63, 0.6016}}) {
    const auto scaled = [&](double at) {
      return solve(hunter_scene(at, stiffening)).rolling_resistance_coefficient / 0.01;
    };
    INFO("f = " << stiffening);
    CHECK(scaled(ratio) == Approx(resistance).epsilon(0.005));  // as above
    CHECK(scaled(0.5 * ratio) < scaled(ratio));
    CHECK(scaled(2 * ratio) < scaled(ratio));
  }
}

TEST_CASE("a viscoelastic cylinder has the largest pressures that CONTACT prints", "[core][half_space]") {
  // visc_cylindr after Wang and Knothe (1993): E0* = 952.5 MPa = 4 G0, f = 1, R = 50 mm, 600 N/mm, V = 1 m/s.
  RollingScene scene = on_half_space(Indenter::cylinder);
  scene.radius = 0.05;
  scene.static_shear_modulus = 952.5e6 / 4;
  scene.stiffening = 1;
  scene.load = 600e3;
  scene.spacing = 0.04e-3;
  struct Row {
    double creep_time, pressure;
  };
  for (const auto& [creep_time, pressure] : {Row{0, 60.32e6}, {0.009, 78.74e6}, {0.045, 84.72e6}, {2.0, 85.31e6}}) {
    scene.creep_time = creep_time;
    const RollingSolution s = solve(scene);
    INFO("creep time " << creep_time);
    REQUIRE(s.status == Status::converged);
    // CONTACT's body is a parabola; the circle's curvature adds (a/R)^2/8 = 0.2 %.
    CHECK(s.peak_pressure == Approx(pressure).epsilon(0.003));
  }
}
