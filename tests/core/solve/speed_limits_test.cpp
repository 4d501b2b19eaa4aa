/// Slow and fast rolling without friction, and how resistance grows with load.

#include <cmath>

#include "core/reference/reference_solutions.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

/// The paper's bodies under a twentieth of their load, so that geometry is nearly that of a parabola.
RollingScene light(const RollingScene& paper, double layer_thickness, double spacing) {
  RollingScene scene = frictionless(paper);
  scene.layer_thickness = layer_thickness;
  *scene.load /= 20;
  scene.spacing = spacing;
  return scene;
}

struct LimitError {
  double relative;  // of the rolling resistance to its limit
  double nodes_across;
};

LimitError error_to(const RollingSolution& s, double limit) {
  return {s.rolling_resistance / limit - 1, (s.leading_edge - s.trailing_edge) / s.spacing + 1};
}

LimitError slow_error(RollingScene scene, double speed) {
  scene.speed = speed;
  const RollingSolution s = solve(scene);
  REQUIRE(s.status == Status::converged);
  return error_to(
      s, slow_rolling_resistance(*scene.load, scene.radius, speed, slow_loss_time(scene.stiffening, scene.creep_time)));
}

/// The fields of fast motion are elastic with the glassy modulus.
LimitError fast_error(RollingScene scene, double speed) {
  scene.speed = speed;
  const RollingSolution s = solve(scene);
  REQUIRE(s.status == Status::converged);
  RollingScene glassy = scene;
  glassy.material = MaterialModel::elastic;
  *glassy.static_shear_modulus *= 1 + scene.stiffening;
  const RollingSolution elastic = solve(glassy);
  double moment = 0, sum = 0;
  const SurfaceGrid& grid = elastic.fields.grid;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const double x = grid.x(column), y = grid.rows > 1 ? grid.y(row) : 0;
      const double p = elastic.fields.pressure[static_cast<std::size_t>(grid.index(column, row))];
      moment += p * (x * x + y * y);
      sum += p;
    }
  return error_to(s, fast_rolling_resistance(*scene.load, elastic.approach, moment / sum, scene.radius, speed,
                                             fast_loss_time(scene.stiffening, scene.creep_time)));
}

}  // namespace

// In both limits the contact is that of an elastic layer and only its small asymmetry resists. On a grid the set of
// nodes stays symmetric and cannot move by less than a cell: the resistance misses up to a few cells of the contact's
// length, depending on where its edge falls between nodes. The bounds are those of the worst position.

TEST_CASE("slow rolling costs P V tau'/R on any layer, to first order in the spacing", "[core][speed_limits]") {
  for (const double thickness : {0.005, 0.001}) {
    const double speed = 1e-7;  // V tau is far below any spacing
    for (const double spacing : {20e-6, 10e-6, 5e-6, 2.5e-6}) {
      const LimitError error = slow_error(light(paper_cylinder(), thickness, spacing), speed);
      INFO("cylinder, layer of " << thickness << ", " << error.nodes_across << " nodes across");
      CHECK(std::abs(error.relative) < 6 / error.nodes_across);
    }
    for (const double spacing : {200e-6, 100e-6, 50e-6}) {
      const LimitError error = slow_error(light(paper_sphere(), thickness, spacing), speed);
      INFO("sphere, layer of " << thickness << ", " << error.nodes_across << " nodes across");
      CHECK(std::abs(error.relative) < 6 / error.nodes_across);
    }
  }
}

TEST_CASE("fast rolling costs what the glassy contact relaxes under way, to first order in the spacing",
          "[core][speed_limits]") {
  for (const double thickness : {0.005, 0.001}) {
    const double speed = 1e3;  // V tau is 250 m
    for (const double spacing : {20e-6, 10e-6, 5e-6, 2.5e-6}) {
      const LimitError error = fast_error(light(paper_cylinder(), thickness, spacing), speed);
      INFO("cylinder, layer of " << thickness << ", " << error.nodes_across << " nodes across");
      CHECK(std::abs(error.relative) < 3 / error.nodes_across);
    }
    for (const double spacing : {200e-6, 100e-6, 50e-6}) {
      const LimitError error = fast_error(light(paper_sphere(), thickness, spacing), speed);
      INFO("sphere, layer of " << thickness << ", " << error.nodes_across << " nodes across");
      CHECK(std::abs(error.relative) < 3 / error.nodes_across);
    }
  }
}

TEST_CASE("without loss, without friction nothing resists", "[core][speed_limits]") {
  for (const RollingScene& paper : {paper_cylinder(), paper_sphere()}) {
    RollingScene scene = frictionless(paper);
    for (const int kind : {0, 1, 2}) {
      RollingScene lossless = scene;
      if (kind == 0) lossless.stiffening = 0;
      if (kind == 1) lossless.creep_time = 0;
      if (kind == 2) lossless.material = MaterialModel::elastic;
      const RollingSolution s = solve(lossless);
      REQUIRE(s.status == Status::converged);
      CHECK(s.law_violation < 1e-8);
      CHECK(std::abs(s.rolling_resistance_coefficient) < 1e-10);  // the solver's own tolerance, 2e-10 of the pressure
    }
  }
}

TEST_CASE("at a fixed ratio of memory to contact the resistance grows with the powers of the load of each geometry",
          "[core][speed_limits]") {
  // R_r ~ P a/R: a ~ P^{1/5} and P^{1/6} on a thin layer, P^{1/2} and P^{1/3} on a half-space.
  const auto exponent = [](RollingScene scene, double a, double width_exponent) {
    scene.material = MaterialModel::zener;
    scene.radius = 1;
    scene.static_shear_modulus = 1e6;
    scene.stiffening = 0.1;
    scene.speed = 1;
    scene.friction_coefficient = 0;
    const double growth = 1.2;
    const auto resistance = [&](double load, double half_width) {
      RollingScene given = scene;
      given.load = load;
      given.creep_time = half_width / scene.speed;
      given.spacing = *scene.spacing * half_width / a;
      const RollingSolution s = solve(given);
      REQUIRE(s.status == Status::converged);
      return s.rolling_resistance;
    };
    const double load = *scene.load;
    return std::log(resistance(load * growth, a * std::pow(growth, width_exponent)) / resistance(load, a)) /
           std::log(growth);
  };
  const double a = 0.01;
  RollingScene line, sphere;
  line.indenter = Indenter::cylinder;
  sphere.indenter = Indenter::sphere;
  line.spacing = a / 150;
  sphere.spacing = a / 24;
  line.layer_thickness = sphere.layer_thickness = INFINITY;
  line.load = M_PI * 1e6 * a * a;
  sphere.load = 16e6 * a * a * a / 3;
  // Similar contacts on similar grids: exact up to the curvature of the body, (a/R)^2.
  CHECK(exponent(line, a, 0.5) == Approx(3. / 2).epsilon(1e-3));
  CHECK(exponent(sphere, a, 1. / 3) == Approx(4. / 3).epsilon(1e-3));
  // a/H = 50, where P ~ (a + b H)^5 with b about 1.5: the exponents stand 1 % above their limits.
  line.layer_thickness = sphere.layer_thickness = a / 50;
  const double H = line.layer_thickness;
  line.load = 1.16 * 2e6 * std::pow(a, 5) / (15 * H * H * H);
  sphere.load = 1.2 * M_PI * 1e6 * std::pow(a, 6) / (32 * H * H * H);
  sphere.spacing = a / 50;
  CHECK(exponent(line, a, 1. / 5) == Approx(6. / 5).epsilon(0.015));
  CHECK(exponent(sphere, a, 1. / 6) == Approx(7. / 6).epsilon(0.015));
}

TEST_CASE("a train has as many waves as its cells need", "[core][period]") {
  // 2000 waves of this period are longer than two cells: the nodes did not tell neighbours apart, and there was no
  // answer.
  RollingScene scene = plain_scene(0.178921197955618, 7222.301156825699);
  scene.radius = 0.021880577943722744;
  scene.layer_thickness = 0.0008747438699317015;
  scene.poisson_ratio = 0.13071605589156693;
  scene.material = MaterialModel::prony;
  scene.static_shear_modulus = 988284.4676928106;
  scene.relaxation_times = {0.009773814637519442, 0.010117365214999872, 0.012436258913859325, 0.02896703927121182};
  scene.relaxation_moduli = {200655.61510504578, 2107249.7339200107, 137463.363878565, 234193.42876834213};
  scene.friction_coefficient = 0;
  scene.inertia = Inertia::on;
  scene.period = 0.2137653075991704;
  const RollingSolution found = solve(scene);
  REQUIRE(found.status == Status::converged);
  scene.series_terms = 20000;
  CHECK(found.rolling_resistance == Approx(solve(scene).rolling_resistance).epsilon(2e-5));
}

TEST_CASE("at 30 m/s a single passage over a memory of 7.5 m is a train of bodies 200 m apart",
          "[core][speed_limits]") {
  RollingScene scene;
  scene.radius = 0.2;
  scene.layer_thickness = 0.05;
  scene.static_shear_modulus = 3e6;
  scene.stiffening = 1;
  scene.creep_time = 0.25;
  scene.speed = 30;
  scene.load = 2e5;
  scene.friction_coefficient = 0.2;
  scene.spacing = 2.5e-3;
  const RollingSolution passage = solve(scene);
  scene.period = 200;
  scene.series_terms = 900000;  // waves down to a tenth of a cell
  const RollingSolution train = solve(scene);
  REQUIRE(passage.status == Status::converged);
  REQUIRE(train.status == Status::converged);
  CHECK(passage.rolling_resistance == Approx(train.rolling_resistance).epsilon(1e-4));
}
