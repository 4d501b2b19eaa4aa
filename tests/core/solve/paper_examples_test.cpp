// Covers grid_solution too.
/// The examples of Zehil and Gavin (2013), sections 5.1 and 5.2, and what finer grids make of them.

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

constexpr Method newton_methods[] = {Method::newton, Method::newton_dense};

/// Positions of slipping nodes along a cylinder's contact [m].
std::vector<double> slipping(const RollingSolution& solution) {
  std::vector<double> positions;
  for (int i = 0; i < solution.fields.grid.size(); ++i)
    if (solution.fields.zone[static_cast<std::size_t>(i)] == Zone::slip) positions.push_back(solution.fields.grid.x(i));
  return positions;
}

double height_at(const RollingSolution& solution, double x) {
  const SurfaceGrid& grid = solution.fields.grid;
  const int column = static_cast<int>(std::lround((x - grid.x(0)) / grid.spacing_x));
  const int row = solution.fields.v.empty() ? 0 : -grid.first_row;
  return solution.fields.w[static_cast<std::size_t>(grid.index(column, row))];
}

}  // namespace

TEST_CASE("the paper's cylinder rolls as printed", "[core][paper]") {
  for (const Method method : newton_methods) {
    const RollingSolution s = solve(with_method(paper_cylinder(), method));
    INFO(name_of(method));
    REQUIRE(s.status == Status::converged);
    CHECK(s.law_violation < 1e-8);
    CHECK(s.energy_residual < 5e-3);
    CHECK(s.contact_nodes == 31);
    CHECK(s.trailing_edge == Approx(-3.5e-3));
    CHECK(s.leading_edge == Approx(4e-3));
    // One node slips at the leading edge, three at the trailing edge.
    const std::vector<double> slip = slipping(s);
    REQUIRE(slip.size() == 4);
    CHECK(s.slip_nodes == 4);
    CHECK(slip[0] == Approx(-3.5e-3));
    CHECK(slip[2] == Approx(-3e-3));
    CHECK(slip[3] == Approx(4e-3));
    CHECK(s.mean_pressure == Approx(2.58e6).epsilon(0.002));  // three printed digits
    // An independent dense program, to the digits it printed
    CHECK(s.peak_pressure == Approx(3.48e6).epsilon(0.001));
    CHECK(s.approach == Approx(0.3698e-3).epsilon(1e-4));
    CHECK(s.rotation_ratio == Approx(1.04054).margin(1e-5));
    CHECK(s.rolling_resistance == Approx(357.5).epsilon(1e-3));
    CHECK(s.driving_force == Approx(175.2).epsilon(1e-3));
    CHECK(s.driving_torque == Approx(s.driving_force * 0.02).epsilon(1e-9));
    CHECK(height_at(s, 4e-3) == Approx(0.034e-3).margin(0.5e-6));
    CHECK(height_at(s, -3.5e-3) == Approx(-0.061e-3).margin(0.5e-6));
  }
}

TEST_CASE("the paper's sphere rolls as printed", "[core][paper][long]") {
  for (const Method method : newton_methods) {
    const RollingSolution s = solve(with_method(paper_sphere(), method));
    INFO(name_of(method));
    REQUIRE(s.status == Status::converged);
    CHECK(s.law_violation < 1e-8);
    CHECK(s.energy_residual < 5e-3);
    CHECK(std::abs(s.contact_nodes - 939) <= 3);
    CHECK(s.trailing_edge == Approx(-3.75e-3));
    CHECK(s.leading_edge == Approx(4.25e-3));
    CHECK(s.mean_pressure == Approx(2.556e6).epsilon(0.005));
    CHECK(s.peak_pressure == Approx(3.944e6).epsilon(0.001));
    CHECK(height_at(s, -3.75e-3) == Approx(-0.2219e-3).margin(0.1e-6));
    CHECK(height_at(s, 4.25e-3) == Approx(-0.1198e-3).margin(0.1e-6));
    CHECK(s.approach == Approx(0.5766e-3).epsilon(2e-4));
    CHECK(s.rotation_ratio == Approx(1.02351).margin(1e-5));
    CHECK(s.rolling_resistance == Approx(3.0992).epsilon(5e-4));
    CHECK(s.driving_force == Approx(1.5316).epsilon(5e-4));
    CHECK(s.peak_shear_y == Approx(0.343e6).epsilon(0.02));
    CHECK(std::abs(s.slip_nodes - 191) <= 6);  // three rings of symmetric pairs, as for the contact nodes
  }
}

TEST_CASE("the paper's sphere slips in a crescent at the back, thicker at the sides", "[core][paper]") {
  const RollingSolution s = solve(paper_sphere());
  const SurfaceGrid& grid = s.fields.grid;
  // Slipping nodes from the trailing edge on, row by row; all but a few at the front stand at the back.
  const auto thickness_of_row = [&](int row) {
    int count = 0;
    for (int column = 0; column < grid.columns; ++column)
      count += grid.x(column) < 0 && s.fields.zone[static_cast<std::size_t>(grid.index(column, row))] == Zone::slip;
    return count;
  };
  const int middle = -grid.first_row;
  const int sides = static_cast<int>(std::lround(0.6 * s.half_width / grid.spacing_y));
  CHECK(thickness_of_row(middle) >= 1);
  CHECK(thickness_of_row(middle + sides) > thickness_of_row(middle));
  CHECK(thickness_of_row(middle + sides) == thickness_of_row(middle - sides));
}

TEST_CASE("without friction the paper's bodies resist as an independent program says", "[core][paper]") {
  for (const Method method : newton_methods) {
    const RollingSolution cylinder = solve(frictionless(with_method(paper_cylinder(), method)));
    CHECK(cylinder.rolling_resistance == Approx(371.2).epsilon(5e-4));  // on the same grid, four printed digits
    CHECK(cylinder.law_violation < 1e-8);
    CHECK(cylinder.energy_residual < 5e-3);
    const RollingSolution sphere = solve(frictionless(with_method(paper_sphere(), method)));
    CHECK(sphere.rolling_resistance == Approx(3.026).epsilon(5e-4));
    CHECK(sphere.law_violation < 1e-8);
    CHECK(sphere.energy_residual < 5e-3);
  }
}

TEST_CASE("the cylinder's resistance converges to the solution with continuous edges", "[core][paper][long]") {
  // Exact: Chebyshev expansions with unknown edges. The edges' jumps make single errors irregular; their envelope falls
  // like the spacing with friction (forward differences) and like its square without.
  for (const Method method : newton_methods) {
    for (const int refinement : {2, 4, 6, 8, 11, 16}) {
      RollingScene scene = with_method(paper_cylinder(), method);
      *scene.spacing /= refinement;
      INFO(name_of(method) << ", spacing " << *scene.spacing);
      const RollingSolution rough = solve(scene), smooth = solve(frictionless(scene));
      CHECK(rough.status == Status::converged);
      CHECK(rough.rolling_resistance == Approx(357.1785671916).epsilon(1.1e-3 / refinement));
      CHECK(std::abs(rough.rotation_ratio - 1.040730611) < 6.5e-4 / refinement);
      CHECK(smooth.rolling_resistance == Approx(370.2717666).epsilon(6e-3 / (refinement * refinement)));
    }
    RollingScene scene = with_method(paper_cylinder(), method);
    *scene.spacing /= 16;
    const RollingSolution finest = solve(scene);
    REQUIRE(finest.status == Status::converged);
    // Edges and the border of the stick zone lie within a spacing or two of the exact ones.
    CHECK(std::abs(finest.trailing_edge + 3.482414e-3) < 1.5 * *scene.spacing);
    CHECK(std::abs(finest.leading_edge - 3.993285e-3) < 1.5 * *scene.spacing);
    double last_slip = -1;
    for (const double x : slipping(finest))
      if (x < 0) last_slip = x;
    CHECK(std::abs(last_slip + 2.854717e-3) < 2 * *scene.spacing);
  }
}

TEST_CASE("less friction on the cylinder lets more of it slip, with the resistance of the exact solution",
          "[core][paper]") {
  struct Row {
    double friction, resistance;
  };
  for (const auto& [friction, resistance] : {Row{0.12, 359.30478}, {0.10, 360.41078}, {0.08, 361.82921}}) {
    RollingScene scene = with_method(paper_cylinder(), Method::newton_dense);
    scene.friction_coefficient = friction;
    *scene.spacing /= 12;
    CHECK(solve(scene).rolling_resistance == Approx(resistance).epsilon(1.1e-3 / 12));  // as above
  }
}

TEST_CASE("the sphere's resistance settles under refinement", "[core][paper]") {
  RollingScene scene = paper_sphere();
  *scene.spacing /= 2;
  const RollingSolution finer = solve(scene);
  REQUIRE(finer.status == Status::converged);
  CHECK(std::abs(finer.contact_nodes - 3728) <= 6);
  CHECK(finer.law_violation < 1e-8);
  // 3.098 by an independent program on a refined grid, whose spacing is not known: half a unit in the last digit and
  // the jumps of the edge at 3,728 nodes, 5e-4.
  CHECK(finer.rolling_resistance == Approx(3.098).epsilon(7e-4));
}
