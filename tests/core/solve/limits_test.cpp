#include "core/numerics/solution_limits.hpp"

#include <time.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "core/model/scene_rules.hpp"
#include "core/numerics/bracketed_root.hpp"
#include "core/numerics/chebyshev.hpp"
#include "core/numerics/threads.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/source_directory.hpp"

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
  CHECK(!root_between([](double x) { return 1 + x * x; }, -1.0, 1.0));
  CHECK(!root_between([](double) { return NAN; }, -1.0, 1.0));
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

TEST_CASE("memories of very many retardation times are refused before their matrices are made", "[core][limits]") {
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  scene.method = Method::spectral;
  scene.material = MaterialModel::prony;
  constexpr int terms = 1000;
  for (int i = 0; i < terms; ++i) {
    scene.relaxation_times.push_back(std::pow(10.0, -6 + 8.0 * i / terms));
    scene.relaxation_moduli.push_back(3e6 / terms);
  }
  for (const double bytes : {4e6, 1.2e7, 3e7}) {  // the first matrix, the second, the system
    scene.memory_limit = bytes;
    const RollingSolution solution = solve(scene);
    INFO(bytes << ": " << solution.reason);
    CHECK(solution.status == Status::not_converged);
    CHECK_THAT(solution.reason, Contains("retardation times") && Contains("memory_limit"));
  }
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

TEST_CASE("a tolerance ends with the best answer within the time", "[core][limits][long]") {
  RollingScene scene = with_method(paper_cylinder(), Method::newton);
  scene.spacing.reset();
  scene.tolerance = 1e-9;
  scene.time_limit = 1.0;
  const RollingSolution solution = solve(scene);
  REQUIRE(solution.status == Status::converged);
  REQUIRE(!solution.warnings.empty());
  CHECK_THAT(solution.warnings.front(), Contains("was not reached"));
}

TEST_CASE("a solution ends with Interrupted once it is asked to stop, and only while it may be", "[core][limits]") {
  RollingScene scene = paper_sphere();
  scene.spacing.reset();
  scene.tolerance = 1e-6;
  std::atomic<int> asked = 0;
  {
    const Interruptible interruptible([&] { return ++asked > 2; });
    CHECK_THROWS_AS(solve(scene), Interrupted);
  }
  CHECK(asked == 3);
  CHECK(solve(paper_cylinder()).status == Status::converged);
}

TEST_CASE("an empty scene's broken rules name what is missing and nothing that it has not", "[core][limits]") {
  const std::vector<std::string> broken = check(RollingScene());
  CHECK(broken.size() == 5);
  for (const char* const key : {"radius", "layer_thickness", "speed", "static_shear_modulus", "load"})
    CHECK(std::any_of(broken.begin(), broken.end(),
                      [&](const std::string& line) { return line.starts_with(std::string(key) + " "); }));
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

TEST_CASE("no method calls an answer converged that violates a law of contact", "[core][limits]") {
  int converged = 0;
  for (const Method method : {Method::active_set, Method::newton, Method::newton_dense})
    for (const Kinematics kinematics : {Kinematics::printed, Kinematics::consistent})
      for (const double friction : {0.003, 0.02, 0.1, 2.0})
        for (RollingScene scene : {paper_cylinder(), paper_sphere()}) {
          scene.method = method;
          scene.kinematics = kinematics;
          scene.friction_coefficient = friction;
          scene.spacing = scene.indenter == Indenter::sphere ? 1e-3 : 0.5e-3;
          const RollingSolution solution = solve(scene);
          INFO(name_of(method) << ", " << name_of(kinematics) << ", friction " << friction << ": " << solution.reason);
          if (solution.status == Status::converged)
            CHECK((++converged && solution.law_violation <= 1e-8));
          else
            CHECK(!solution.reason.empty());
        }
  CHECK(converged >= 20);
}

TEST_CASE("a limit of time is one of processor time, of all threads that a solution takes", "[core][limits]") {
  const auto work = [](double seconds) {  // of this thread
    timespec time{};
    const auto now = [&] {
      ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
      return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    };
    for (const double end = now() + seconds; now() < end;) continue;
  };
  const SolutionLimits limits(1e9, 0.5);
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  CHECK_NOTHROW(require_time());
  CHECK_THROWS_AS(require_time(0.6), BeyondLimits);
  share_out(2, 2, [&](int, int) { work(0.3); });
  CHECK_THROWS_WITH(require_time(), Contains("time_limit of 0.5 s of processor time"));
}

TEST_CASE("a factorisation is refused before it begins", "[core][limits]") {
  const SolutionLimits limits(4e9, 60.0);
  CHECK_NOTHROW(require_factorisation(5e3, "a factorisation"));
  CHECK_THROWS_WITH(require_factorisation(3e4, "a factorisation for 30000 nodes"),
                    Contains("30000 nodes: about 14.4 GB"));
  CHECK_THROWS_AS(require_factorisation(NAN, "a factorisation"), BeyondLimits);
}

TEST_CASE("a table of panels of very different widths stays small", "[core][limits]") {
  const std::vector<double> borders{0, 1e-9, 2e-9, 1e-3, 1};
  const ChebyshevTable<1> table(borders, 15, [](double x) { return Eigen::Array<double, 1, 1>(std::exp(x)); });
  for (const double x : {0.0, 0.5e-9, 1.5e-9, 1e-6, 0.5e-3, 2e-3, 0.7, 1.0})
    CHECK(table(x)(0) == Approx(std::exp(x)).epsilon(1e-13));
}

TEST_CASE("a temperature that shifts times beyond all measure is refused, in every layer", "[core][limits]") {
  RollingScene scene = paper_cylinder();
  scene.activation_energy = 1e9;
  scene.reference_temperature = 100;
  scene.temperature = 300;
  scene.lower_layers.push_back({});
  static_cast<MaterialInputs&>(scene.lower_layers[0]) = scene;
  scene.lower_layers[0].layer_thickness = 1;
  const std::vector<std::string> broken = check(scene);
  REQUIRE(broken.size() == 2);
  CHECK_THAT(broken[0], Contains("temperature = 300: multiplies all times by 0, which must be from 1e-30 to 1e+30"));
  CHECK_THAT(broken[1], Contains("lower_layers[0].temperature"));
}

TEST_CASE("layers of two coinciding retardation times, and of very different thickness, need little time and memory",
          "[core][limits]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    RollingScene scene = indenter == Indenter::sphere ? paper_sphere() : paper_cylinder();
    scene.spacing.reset();
    scene.stiffening = 1e-5;
    scene.layer_thickness = 1e-6;
    scene.lower_layers.push_back({});
    static_cast<MaterialInputs&>(scene.lower_layers[0]) = scene;
    scene.lower_layers[0].layer_thickness = 0.8;
    scene.lower_layers[0].static_shear_modulus = 1e9;
    scene.load = 0.04;
    scene.time_limit = patience(5);
    const RollingSolution solution = solve(scene);
    INFO(solution.reason);
    CHECK((solution.status == Status::converged || !solution.reason.empty()));
    CHECK(solution.reason.find("time_limit") == std::string::npos);
  }
}
