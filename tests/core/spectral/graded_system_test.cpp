// Covers graded_grid, graded_slopes and graded_tractions too.

#include "core/spectral/graded_system.hpp"

#include <cmath>

#include "core/model/contact_surface.hpp"
#include "core/solve/rolling_contact.hpp"
#include "core/zones/spectral_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

RollingScene layer_with(double poisson_ratio) {
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  scene.poisson_ratio = poisson_ratio;
  scene.tolerance = 1e-6;
  return scene;
}

RollingSolution answer_of(const RollingScene& scene) {
  const RollingSolution solution = solve(scene);
  INFO(solution.reason << solution.model);
  REQUIRE(solution.method == Method::spectral);
  REQUIRE(solution.status == Status::converged);
  return solution;
}

}  // namespace

TEST_CASE("a graded grid integrates and differentiates tractions of any exponents", "[core][graded_system]") {
  const SlipPattern pattern{.shear = true, .slips = {1, -1}};
  const SpectralEdges edges{{-1, 2}, {{0.25, 1.5}}};
  for (const double power : {0.3, 0.5, 0.61}) {
    const GradedGrid grid(pattern, edges, 60);
    REQUIRE(grid.zones().size() == 3);
    double area = 0;
    for (Eigen::Index j = 0; j < grid.size(); ++j) {
      const double x = grid.nodes()[static_cast<std::size_t>(j)].x();
      area += grid.weight()(j) * std::pow((x + 1) / 3, power) * std::pow((2 - x) / 3, 1 - power);
    }
    // 3 times Euler's B(1 + power, 2 - power); what lies beyond the last nodes is 1e-9 of it.
    CHECK(area == Approx(3 * std::tgamma(1 + power) * std::tgamma(2 - power) / 2).epsilon(1e-8));
  }
}

TEST_CASE("a cylinder sliding on a compressible half-space has unequal exponents at its edges",
          "[core][graded_system]") {
  for (const double poisson_ratio : {0.0, 0.3, 0.45}) {
    RollingScene scene = layer_with(poisson_ratio);
    scene.layer_thickness = INFINITY;
    scene.material = MaterialModel::elastic;
    scene.friction_coefficient = 0.5;
    scene.drive = Drive::rotation;
    scene.rotation_ratio = 0;  // locked: the shear pulls the surface forward
    scene.load = 1e-9;         // a contact so short that the circle is a parabola, and shear has no lever arm
    scene.tolerance = 1e-8;
    const RollingSolution solution = answer_of(scene);
    // p = (x - x-)^(1/2 + t) (x+ - x)^(1/2 - t), tan(pi t) = -mu (1 - 2 nu)/(2 (1 - nu)); the rigid slope x/R asks for
    // a centre at 2 t half-lengths (Johnson 1985, section 2.8, for a rigid body).
    const double t = -std::atan(0.5 * (1 - 2 * poisson_ratio) / (2 * (1 - poisson_ratio))) / M_PI;
    const double half = 0.5 * (solution.leading_edge - solution.trailing_edge);
    const double centre = 0.5 * (solution.leading_edge + solution.trailing_edge);
    CHECK(centre / half == Approx(2 * t).epsilon(1e-7));
    const double load =
        M_PI * *scene.static_shear_modulus * half * half * (1 - 4 * t * t) / (2 * (1 - poisson_ratio) * scene.radius);
    CHECK(*scene.load == Approx(load).epsilon(1e-7));
  }
}

TEST_CASE("graded points have one solution, by factors of their own and by those of edges nearby",
          "[core][graded_system]") {
  RollingScene scene = layer_with(0.3);
  SECTION("compressible layer") {}
  SECTION("half-space") { scene.layer_thickness = INFINITY; }
  SECTION("inertia, which retards slopes") {
    scene.inertia = Inertia::on;
    scene.speed = 5;
    scene.creep_time = 0.01;
  }
  SECTION("rotation is given") {
    scene.drive = Drive::rotation;
    scene.rotation_ratio = 1.01;
  }
  SECTION("a layer thinner than so few points resolve") { scene.layer_thickness = 3e-4; }
  const SpectralProblem problem(scene, near_spectrum(scene), 4e-3);
  const SlipPattern pattern{.shear = true, .slips = {1, -1, 1}};
  const auto edges = [](double moved) {
    return SpectralEdges{{-3.5e-3, 4e-3 + moved}, {{-3.3e-3, -3.2e-3}, {-1e-3, 3.9e-3 - moved}}};
  };
  NearbySystems nearby;
  for (const int order : {20, 40}) {
    solve_graded(problem, pattern, edges(0), {order, order}, nearby);
    const int factorised = nearby.factorised();
    for (const double moved : {1e-9, 1e-6}) {
      NearbySystems own;
      const SpectralState expected = solve_graded(problem, pattern, edges(moved), {order, order}, own);
      const SpectralState state = solve_graded(problem, pattern, edges(moved), {order, order}, nearby);
      constexpr double close = 1e-9;
      const double peak = expected.graded->pressure.cwiseAbs().maxCoeff();
      CHECK((state.graded->pressure - expected.graded->pressure).cwiseAbs().maxCoeff() < close * peak);
      CHECK((state.graded->shear - expected.graded->shear).cwiseAbs().maxCoeff() < close * peak);
      CHECK((state.residuals - expected.residuals).cwiseAbs().maxCoeff() < close);
      CHECK(state.rotation_ratio == Approx(expected.rotation_ratio).epsilon(close));
    }
    CHECK(nearby.factorised() == factorised);
    solve_graded(problem, pattern, edges(1e-3), {order, order}, nearby);  // which is not near
    CHECK(nearby.factorised() == factorised + 1);
  }
}

TEST_CASE("compressible layers with friction need no grid", "[core][graded_system]") {
  // Grids of 14,720 and 14,719 nodes, extrapolated by the program to 6e-8 and 1.8e-6.
  const RollingSolution four_zones = answer_of(layer_with(0.3)), leading_slip = answer_of(layer_with(0.45));
  CHECK(four_zones.rolling_resistance == Approx(630.8706145).epsilon(1.5e-6));
  CHECK(leading_slip.rolling_resistance == Approx(444.17577).epsilon(4e-6));
  for (const RollingSolution* solution : {&four_zones, &leading_slip}) {
    CHECK(solution->energy_residual < 1e-4);
    CHECK(solution->law_violation < 1e-5);
    CHECK(solution->error_estimate < 5e-6);
  }
  RollingScene finer = layer_with(0.3);
  finer.tolerance = 1e-8;
  const RollingSolution better = answer_of(finer);
  CHECK(better.rolling_resistance == Approx(630.8706109).epsilon(2e-8));  // of twice the order
  CHECK(std::abs(four_zones.rolling_resistance - better.rolling_resistance) < four_zones.rolling_resistance_error);
}

TEST_CASE("a pattern that is a little wrong at every order is not surer of itself than it may be",
          "[core][graded_system]") {
  // Few points miss a zone near the edge: orders 27 and 30 agree to 3e-7, and are both off by 4e-5.
  RollingScene scene = layer_with(0.11930940092072811);
  scene.kinematics = Kinematics::consistent;
  scene.radius = 0.12156270309941998;
  scene.layer_thickness = 0.08761002481661227;
  scene.static_shear_modulus = 1e6;
  scene.stiffening = 4.831075222941227;
  scene.creep_time = 0.23401457780756435;
  scene.speed = 1.5713961120230298;
  scene.load.reset();
  scene.approach = 7.896129175131898e-05;
  scene.friction_coefficient = 0.8921378750272251;
  scene.inertia = Inertia::off;
  for (const double tolerance : {1e-3, 1e-5}) {
    scene.tolerance = tolerance;
    const RollingSolution solution = answer_of(scene);
    CHECK(solution.error_estimate <= tolerance);
    CHECK(std::abs(solution.rolling_resistance - 0.239582588) < solution.rolling_resistance_error);  // of 484 points
  }
}

TEST_CASE("a nearly incompressible layer rolls as an incompressible one", "[core][graded_system]") {
  RollingScene nearly = layer_with(0.5 - 1e-9);
  nearly.tolerance = 1e-8;
  // The approach of the limit is linear; 357.1785671916 from the incompressible solution.
  CHECK(answer_of(nearly).rolling_resistance == Approx(357.1785671916).epsilon(3e-7));
}

TEST_CASE("inertia below the speed of Rayleigh waves needs no grid", "[core][graded_system]") {
  RollingScene scene = layer_with(0.5);
  scene.inertia = Inertia::on;
  SECTION("and is nothing at low speed") {
    scene.tolerance = 1e-8;
    // rho V^2/G = 8e-7
    CHECK(answer_of(scene).rolling_resistance == Approx(357.1785671916).epsilon(3e-7));
  }
  SECTION("and a tolerance asks for it by itself") {
    scene.inertia = Inertia::automatic;
    scene.speed = 10;
    const RollingSolution rolling = answer_of(scene);
    // With twice the coefficients. A grid gives 2.04319: its half-spaces are expanded to 1e-5.
    CHECK(rolling.rolling_resistance == Approx(2.0431633958).epsilon(1e-6));
    CHECK(std::abs(rolling.rolling_resistance - 2.0431633958) < rolling.rolling_resistance_error);
    scene.inertia = Inertia::off;
    CHECK(std::abs(answer_of(scene).rolling_resistance / rolling.rolling_resistance - 1) > 1e-3);
  }
  SECTION("without friction, and with two layers") {
    scene.friction_coefficient = 0;
    scene.speed = 10;
    CHECK(answer_of(scene).rolling_resistance == Approx(2.1170679986).epsilon(1e-6));
    RollingScene cut = scene;
    cut.layer_thickness = 2e-3;
    BondedLayer rest;
    static_cast<MaterialInputs&>(rest) = scene;
    rest.layer_thickness = 3e-3;
    rest.layer_density = scene.layer_density;
    cut.lower_layers = {rest};
    CHECK(answer_of(cut).rolling_resistance == Approx(2.1170679986).epsilon(2e-6));
    CHECK(answer_of(cut).approach == Approx(answer_of(scene).approach).epsilon(1e-6));
  }
}
