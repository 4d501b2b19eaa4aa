#include "core/spectral/zoned_system.hpp"

#include "core/model/contact_surface.hpp"
#include "core/spectral/graded_system.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

/// Fails if memories, slopes, drive or state meet one of the two kinds of unknowns otherwise than the other.
void check_same(const SpectralState& chebyshev, const SpectralState& graded) {
  constexpr double close = 2e-6;
  CHECK(graded.load == Approx(chebyshev.load).epsilon(close));
  CHECK(graded.approach == Approx(chebyshev.approach).epsilon(close));
  CHECK(graded.rotation_ratio == Approx(chebyshev.rotation_ratio).epsilon(close));
  CHECK(graded.driving_torque == Approx(chebyshev.driving_torque).margin(close * chebyshev.load * 0.02));
  CHECK(graded.driving_force == Approx(chebyshev.driving_force).margin(close * chebyshev.load));
  REQUIRE(graded.edge_means.size() == chebyshev.edge_means.size());
  for (Eigen::Index m = 0; m < graded.edge_means.size(); ++m)
    CHECK(graded.edge_means(m) == Approx(chebyshev.edge_means(m)).epsilon(close));
}

}  // namespace

TEST_CASE("densities and graded points give one state inside the same edges", "[core][zoned_system]") {
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  // The edges of the wheel that a force at its top pulls; elsewhere the tractions lack a bounded end, in both alike.
  const SlipPattern pattern{.shear = true, .slips = {-1, 0}};
  const SpectralEdges edges{{-3.482414e-3, 3.993285e-3}, {{-1e-3, 3.993285e-3}}};
  const auto states_agree = [&] {
    const SpectralProblem problem(scene, near_spectrum(scene), 4e-3);
    NearbySystems nearby;
    check_same(solve_inside(problem, pattern, edges, {40, 40}),
               solve_graded(problem, pattern, edges, {80, 80}, nearby));
  };
  SECTION("pulled at its top") { states_agree(); }
  SECTION("turned") {
    scene.drive = Drive::rotation;
    scene.rotation_ratio = 1.04;
    states_agree();
  }
  SECTION("under a torque") {
    scene.drive = Drive::torque;
    scene.driving_torque = 20;
    states_agree();
  }
}
