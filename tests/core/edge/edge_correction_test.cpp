#include "core/edge/edge_correction.hpp"

#include <algorithm>
#include <cmath>

#include "core/newton/grid_series.hpp"
#include "core/newton/nested_newton.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

RollingScene consistent_sphere() {
  RollingScene scene = paper_sphere();
  scene.kinematics = Kinematics::consistent;
  return scene;
}

}  // namespace

TEST_CASE("with the edge inside the cells a sphere's resistance is the same on all grids", "[core][edge_correction]") {
  // A fast sphere: R_r is a thirtieth of the moments of the load's halves, so that even cells err by up to 1 %. The
  // reference is the finest grid of even cells, a = 0.04 mm, 34,000 nodes, whose own error is below 1e-4.
  RollingScene scene = frictionless(consistent_sphere());
  scene.speed = 0.5;
  constexpr double reference = 0.40562;
  double worst_even = 0;
  for (const double spacing : {0.242e-3, 0.22e-3, 0.195e-3, 0.15e-3}) {
    const NestedOutcome found = solve_nested(scene, fixed_grids(scene, spacing));
    REQUIRE(found.status == Status::converged);
    const ContactLevel& level = found.finest;
    CHECK(level.edge.trust > 0.9);
    ContactPowers powers = level.powers;
    worst_even = std::max(worst_even, std::abs(powers.resultants / reference - 1));
    powers.take(level.edge);
    CHECK(powers.resistance() == Approx(reference).epsilon(1e-3));
  }
  CHECK(worst_even > 4e-3);
}

TEST_CASE("the answer has the correction of its edge, and forces and torque that go with it",
          "[core][edge_correction]") {
  const RollingScene scene = consistent_sphere();
  const RollingSolution coarse = solve(scene);
  CHECK(coarse.rolling_resistance == Approx(3.08209).epsilon(1e-4));
  CHECK(coarse.driving_force + coarse.driving_torque / scene.radius * coarse.rotation_ratio ==
        Approx(coarse.rolling_resistance).epsilon(1e-9));
}

TEST_CASE("where there is no edge to find the grid's resistance stands", "[core][edge_correction]") {
  RollingScene given = consistent_sphere();
  given.approach = 0.58e-3;
  given.load.reset();
  RollingScene coarse = consistent_sphere();
  coarse.spacing = 0.5e-3;
  for (const RollingScene& scene : {paper_sphere(), paper_cylinder(), given, coarse}) {
    const NestedOutcome found = solve_nested(scene, fixed_grids(scene, *scene.spacing));
    REQUIRE(found.status == Status::converged);
    CHECK(found.finest.edge.trust == 0);
  }
}
