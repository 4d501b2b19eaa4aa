#include "core/numerics/solution_limits.hpp"

#include <cmath>

#include "core/numerics/bracketed_root.hpp"
#include "core/solve/rolling_contact.hpp"
#include "core/surface/scene_rules.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;
using Catch::Contains;

TEST_CASE("numbers that are no counts are refused where they become one", "[core][limits]") {
  CHECK(checked_count(7.0, "cells") == 7);
  CHECK(checked_count(-3.2, "cells") == -3);
  for (const double value : std::initializer_list<double>{NAN, INFINITY, -INFINITY, 3e9, -1e300})
    CHECK_THROWS_WITH(checked_count(value, "cells"), Contains("cells: "));
}

TEST_CASE("limits hold while they live, and those before them afterwards", "[core][limits]") {
  const SolutionLimits outer(1e6);
  {
    const SolutionLimits inner(1e3, 0.0);
    CHECK_THROWS_WITH(require_memory(2e3, "a table"), Contains("a table: about 2e-06 GB"));
    CHECK_THROWS_AS(require_time(), BeyondLimits);
  }
  CHECK_NOTHROW(require_memory(2e3, "a table"));
  CHECK_NOTHROW(require_time());
  CHECK_THROWS_AS(require_memory(NAN, "a table"), BeyondLimits);
}

TEST_CASE("without a change of sign there is no root to answer with", "[core][limits]") {
  CHECK_THROWS_AS(bracketed_root([](double x) { return 1 + x * x; }, -1.0, 1.0), std::domain_error);
  CHECK_THROWS_AS(bracketed_root([](double) { return NAN; }, -1.0, 1.0), std::domain_error);
}

TEST_CASE("a sphere whose contact a large adhesion threshold leaves empty has an answer or a reason",
          "[core][limits]") {
  RollingScene scene = paper_sphere();
  scene.spacing.reset();
  scene.adhesion_threshold = 5e6;
  const RollingSolution solution = solve(scene);
  CHECK((solution.status == Status::converged || !solution.reason.empty()));
}

TEST_CASE("a scene that needs more memory than its limit names what to change", "[core][limits]") {
  for (RollingScene scene : {paper_cylinder(), paper_sphere()}) {
    scene.spacing = 1e-11;
    const RollingSolution solution = solve(scene);
    CHECK(solution.status == Status::not_converged);
    CHECK_THAT(solution.reason, Contains("nodes of 1e-11 m") && Contains("GB"));
  }
  RollingScene scene = paper_cylinder();
  scene.memory_limit = 1e4;
  CHECK_THAT(solve(scene).reason, Contains("nodes of 0.00025 m"));
}

TEST_CASE("a solution that needs longer than its limit of time says so, by every method", "[core][limits]") {
  for (const Method method : {Method::newton, Method::newton_dense, Method::active_set, Method::spectral}) {
    RollingScene scene = paper_cylinder();
    if (method == Method::spectral) scene.spacing.reset();
    scene.method = method;
    scene.time_limit = 1e-9;
    const RollingSolution solution = solve(scene);
    CHECK(solution.status == Status::not_converged);
    CHECK_THAT(solution.reason, Contains("time_limit"));
    CHECK(solution.method == method);
  }
}

TEST_CASE("a tolerance ends with the best answer within the time", "[core][limits]") {
  RollingScene scene = with_method(paper_cylinder(), Method::newton);
  scene.spacing.reset();
  scene.tolerance = 1e-9;
  scene.time_limit = 1.0;
  const RollingSolution solution = solve(scene);
  REQUIRE(solution.status == Status::converged);
  REQUIRE(!solution.warnings.empty());
  CHECK_THAT(solution.warnings.front(), Contains("was not reached"));
}

TEST_CASE("sizes that no contact has are refused with the range", "[core][limits]") {
  const auto first = [](auto change) {
    RollingScene scene = paper_cylinder();
    change(scene);
    const std::vector<std::string> broken = check(scene);
    return broken.empty() ? std::string() : broken.front();
  };
  CHECK(first([](RollingScene& s) { s.radius = 1e20; }) == "radius = 1e+20: size must be from 1e-11 to 1e+07 m");
  CHECK(first([](RollingScene& s) { s.spacing = 1e-12; }) == "spacing = 1e-12: size must be from 1e-11 to 1e+07 m");
  CHECK(first([](RollingScene& s) { s.load = 1e300; }) == "load = 1e+300: size must be from 1e-25 to 1e+20 N");
  CHECK(first([](RollingScene& s) { s.creep_time = 0; }).empty());
}

TEST_CASE("a contact on one node is no answer", "[core][limits]") {
  RollingScene scene = paper_cylinder();
  scene.spacing = 4e-3;
  scene.load = 1;
  const RollingSolution solution = solve(scene);
  CHECK(solution.status == Status::not_converged);
  CHECK_THAT(solution.reason, Contains("nodes") || Contains("power"));
}
