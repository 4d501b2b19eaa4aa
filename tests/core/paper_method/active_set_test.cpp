#include "core/paper_method/active_set.hpp"

#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/active_set_scenes.hpp"

// Covers paper_solution, too.

using namespace rollres;
using namespace rollres::test;

TEST_CASE("the paper's algorithm reproduces the paper's cylinder", "[core][active_set]") {
  const Solved cylinder = solve_on(paper_scene(Indenter::cylinder), 7.5e-3);
  const RollingSolution& found = cylinder.solution;
  REQUIRE(cylinder.state.status == Status::converged);
  CHECK(found.contact_nodes == 31);
  CHECK(found.slip_nodes == 4);
  CHECK(found.trailing_edge == Approx(-3.5e-3));
  CHECK(found.leading_edge == Approx(4e-3));
  CHECK(cylinder.state.zone[cylinder.grid.index(16 - cylinder.grid.first_column, 0)] == Zone::slip);
  CHECK(cylinder.state.zone[cylinder.grid.index(15 - cylinder.grid.first_column, 0)] == Zone::stick);
  // Printed or computed independently to the digits given.
  CHECK(found.mean_pressure == Approx(2.58e6).epsilon(2e-3));
  CHECK(found.rotation_ratio == Approx(1.0405).margin(1e-4));
  CHECK(found.approach == Approx(0.3698e-3).epsilon(1e-3));
  CHECK(found.rolling_resistance == Approx(357.5).epsilon(1e-3));
  CHECK(found.driving_force == Approx(175.2).epsilon(1e-3));
  CHECK(found.law_violation < 1e-9);
}

TEST_CASE("the paper's algorithm with projected friction solves the paper's sphere with every node inside all laws",
          "[core][active_set][long]") {
  const Solved sphere = solve_on(paper_scene(Indenter::sphere), 5.5e-3);
  const RollingSolution& found = sphere.solution;
  REQUIRE(sphere.state.status == Status::converged);
  CHECK(found.contact_nodes == 939);
  CHECK(found.slip_nodes == 191);
  CHECK(found.trailing_edge == Approx(-3.75e-3));
  CHECK(found.leading_edge == Approx(4.25e-3));
  CHECK(found.rolling_resistance == Approx(3.099).epsilon(1e-3));
  CHECK(found.mean_pressure == Approx(2.556e6).epsilon(1e-3));
  CHECK(found.rotation_ratio == Approx(1.02351).margin(1e-5));
  CHECK(found.peak_shear_y == Approx(0.343e6).epsilon(5e-3));
  CHECK(found.law_violation < 1e-9);
}

TEST_CASE("without friction the paper's examples resist with 371.2 N/m and 3.026 N", "[core][active_set][long]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    RollingScene scene = paper_scene(indenter);
    scene.friction_coefficient = 0;
    const Solved solved = solve_on(scene, 6e-3);
    REQUIRE(solved.state.status == Status::converged);
    CHECK(std::isnan(solved.state.rotation_ratio));
    CHECK(solved.solution.rolling_resistance == Approx(indenter == Indenter::cylinder ? 371.2 : 3.026).epsilon(1e-3));
    CHECK(solved.solution.law_violation < 1e-9);
  }
}

TEST_CASE("the paper's algorithm and Newton's method give one answer for every drive", "[core][active_set]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere})
    for (const Drive drive : {Drive::top_force, Drive::torque, Drive::free, Drive::rotation})
      for (const bool load_given : {true, false}) {
        RollingScene scene = paper_scene(indenter);
        scene.drive = drive;
        scene.spacing = indenter == Indenter::cylinder ? 0.2e-3 : 0.7e-3;
        if (drive == Drive::torque) scene.driving_torque = 0.05 * scene.radius * *scene.load;
        if (drive == Drive::rotation) scene.rotation_ratio = 1.1;
        if (!load_given) {
          scene.load.reset();
          scene.approach = 0.4e-3;
        }
        CAPTURE(name_of(indenter), name_of(drive), load_given);
        const Solved solved = solve_on(scene, 7e-3);
        REQUIRE(solved.state.status == Status::converged);
        CHECK(solved.solution.law_violation < 1e-8);
        scene.method = Method::newton;
        const RollingSolution newton = solve(scene);
        REQUIRE(newton.status == Status::converged);
        CHECK(solved.solution.contact_nodes == newton.contact_nodes);
        CHECK(solved.solution.slip_nodes == newton.slip_nodes);
        CHECK(solved.solution.rolling_resistance == Approx(newton.rolling_resistance).epsilon(1e-7));
      }
}

TEST_CASE("a locked body slides everywhere and drags with the friction coefficient times its normal forces",
          "[core][active_set]") {
  RollingScene scene = paper_scene(Indenter::sphere);
  scene.drive = Drive::rotation;
  scene.rotation_ratio = 0;
  scene.spacing = 0.7e-3;
  const Solved solved = solve_on(scene, 7e-3);
  REQUIRE(solved.state.status == Status::converged);
  CHECK(solved.solution.slip_nodes == solved.solution.contact_nodes);
  // The layer's own strain turns the slip a little off the x axis.
  CHECK(solved.solution.driving_force == Approx(0.2 * 150).epsilon(1e-2));
  CHECK(solved.solution.driving_force < 0.2 * 150);
}

TEST_CASE("a contact that reaches the border of its grid is not an answer", "[core][active_set]") {
  const RollingScene scene = paper_scene(Indenter::cylinder);
  const SurfaceGrid grid = window(2, *scene.spacing, 3e-3);
  const ContactState state = solve_active_set(scene, influence_table(scene, grid), grid);
  CHECK(state.status == Status::not_converged);
  CHECK(state.reached_border);
  CHECK(state.reason == "the contact reached the border of the grid");
}

TEST_CASE("an adhesive body that rolls with friction obeys every law of contact", "[core][active_set]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    RollingScene scene = paper_scene(indenter);
    scene.adhesion_threshold = 2e6;
    scene.spacing = indenter == Indenter::cylinder ? 0.25e-3 : 0.6e-3;
    const Solved solved = solve_on(scene, 8e-3);
    REQUIRE(solved.state.status == Status::converged);
    CHECK(solved.state.pressure.minCoeff() < 0);
    CHECK(solved.solution.law_violation < 1e-8);
  }
}
