#include "core/solve/rolling_contact.hpp"

#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

RollingScene coarse_sphere() {
  RollingScene scene = paper_sphere();
  scene.spacing = 0.4e-3;
  return scene;
}

}  // namespace

TEST_CASE("scenes solved one after the other have the answers of scenes solved alone", "[core][rolling_solver]") {
  RollingSolver solver;
  RollingScene scene = coarse_sphere();
  int solved = 0;
  const auto check = [&] {
    const RollingSolution in_turn = solver.solve(scene), alone = solve(scene);
    ++solved;
    REQUIRE(in_turn.status == Status::converged);
    CHECK(in_turn.contact_nodes == alone.contact_nodes);
    CHECK(in_turn.slip_nodes == alone.slip_nodes);
    // Both hold every law to 2e-10 of the largest pressure; R_r is a tenth of a per cent of P.
    CHECK(in_turn.rolling_resistance == Approx(alone.rolling_resistance).epsilon(1e-7));
    CHECK(in_turn.law_violation < 1e-8);
  };
  for (int step = 0; step < 3; ++step, scene.speed *= 1.2) check();
  for (int step = 0; step < 2; ++step, *scene.load *= 1.02) check();
  for (int step = 0; step < 2; ++step, scene.friction_coefficient *= 0.8) check();
  CHECK(solver.reused() == solved - 1);
}

TEST_CASE("a solution from the one before estimates its error as one from scratch does", "[core][rolling_solver]") {
  RollingSolver solver;
  RollingScene scene = coarse_sphere();
  solver.solve(scene);
  scene.speed *= 1.1;
  const RollingSolution in_turn = solver.solve(scene), alone = solve(scene);
  REQUIRE(solver.reused() == 1);
  // From scratch half the change before the last one may count as well.
  CHECK(in_turn.error_estimate <= alone.error_estimate * (1 + 1e-6));
  CHECK(in_turn.error_estimate > 0);
}

TEST_CASE("a scene unlike the one before is solved from scratch", "[core][rolling_solver]") {
  RollingSolver solver;
  RollingScene scene = coarse_sphere();
  solver.solve(scene);
  *scene.load *= 3;
  CHECK(solver.solve(scene).contact_nodes == solve(scene).contact_nodes);
  scene.friction_coefficient = 0;
  CHECK(solver.solve(scene).status == Status::converged);
  scene = paper_cylinder();
  CHECK(solver.solve(scene).contact_nodes == 31);
  CHECK(solver.reused() == 0);
}

TEST_CASE("a refusal after a solution is a refusal all the same, and the next scene has its answer",
          "[core][rolling_solver]") {
  RollingSolver solver;
  RollingScene scene = coarse_sphere();
  REQUIRE(solver.solve(scene).status == Status::converged);
  RollingScene slippery = scene;
  slippery.friction_coefficient = 0.005;
  CHECK(solver.solve(slippery).status == Status::no_steady_state);
  CHECK(solver.solve(scene).status == Status::converged);
}
