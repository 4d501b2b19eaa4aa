#include "core/newton/grid_series.hpp"

#include <Eigen/QR>
#include <cmath>

#include "core/edge/edge_curve.hpp"
#include "core/newton/nested_newton.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

// Covers grid_answer, too.

using namespace rollres;

namespace {

RollingScene gridless_sphere() {
  RollingScene scene = paper_sphere();
  scene.spacing.reset();
  return scene;
}

RollingScene gridless_cylinder() {
  RollingScene scene = paper_cylinder();
  scene.kinematics = Kinematics::consistent;
  scene.method = Method::newton;
  scene.spacing.reset();
  return scene;
}

/// Largest deviation of ln R_r from a polynomial of degree 4, over +10 % of one input in `steps` steps.
double roughness(const RollingScene& given, double RollingScene::*input, int steps) {
  Eigen::MatrixXd powers(steps + 1, 5);
  Eigen::VectorXd logarithm(steps + 1);
  for (int step = 0; step <= steps; ++step) {
    RollingScene scene = given;
    const double t = static_cast<double>(step) / steps;
    scene.*input *= std::pow(1.1, t);
    logarithm(step) = std::log(solve(scene).rolling_resistance);
    for (int power = 0; power < 5; ++power) powers(step, power) = std::pow(2 * t - 1, power);
  }
  return (powers * powers.colPivHouseholderQr().solve(logarithm) - logarithm).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("a sphere's rolling resistance on tied grids is a smooth function of the inputs",
          "[core][grid_series][long]") {
  // A node that enters a fixed grid's contact moves R_r by 1e-4 to 1e-3.
  for (double RollingScene::*const input : std::initializer_list<double RollingScene::*>{
           &RollingScene::speed, &RollingScene::layer_thickness, &RollingScene::friction_coefficient})
    CHECK(roughness(gridless_sphere(), input, 16) < 5e-6);
}

TEST_CASE("so is a cylinder's", "[core][grid_series]") {
  for (double RollingScene::*const input : std::initializer_list<double RollingScene::*>{
           &RollingScene::speed, &RollingScene::layer_thickness, &RollingScene::friction_coefficient})
    CHECK(roughness(gridless_cylinder(), input, 16) < 5e-6);
  RollingScene smooth = gridless_cylinder();
  smooth.friction_coefficient = 0;
  CHECK(roughness(smooth, &RollingScene::layer_thickness, 16) < 1e-9);
}

TEST_CASE("the ends of a cylinder's contact have one place in their cells, which is good for its resistance",
          "[core][grid_series]") {
  RollingScene scene = gridless_cylinder();
  scene.friction_coefficient = 0;
  scene.method = Method::spectral;
  const double exact = solve(scene).rolling_resistance;
  scene.method = Method::newton;
  for (const double cells : {30.0, 60.0}) {
    const NestedOutcome nested = solve_nested(scene, tied_lines(scene, cells));
    REQUIRE(nested.status == Status::converged);
    const ContactLevel& level = nested.finest;
    const SurfaceGrid& grid = level.problem->grid;
    const RowEnds ends = ends_of_rows(grid, level.outcome.unknowns.pressure).front();
    CHECK(std::abs((ends.leading - ends.trailing) / grid.spacing_x / (2 * cells) - 1) < 0.6 / cells);
    const double from_node = (ends.leading - grid.origin_x) / grid.spacing_x;
    CHECK(std::abs(from_node - 0.3) < 0.15);                          // as the grid before told it
    CHECK(level.powers.resistance() == Approx(exact).epsilon(1e-5));  // 1e-4 with the ends anywhere in their cells
  }
}

TEST_CASE("a tied grid has a node at the centre of pressure and its cells on the pressure's half-widths",
          "[core][grid_series]") {
  constexpr double cells = 19.532;
  const RollingScene scene = gridless_sphere();
  const GridSeries series = tied_grids(scene, cells);
  const NestedOutcome nested = solve_nested(scene, series);
  REQUIRE(nested.status == Status::converged);
  const SurfaceGrid& grid = nested.finest.problem->grid;
  const Vector& pressure = nested.finest.outcome.unknowns.pressure;
  double sum = 0, first = 0, second = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const double p = pressure(grid.index(column, row)) * (row > 0 ? 2 : 1);
      sum += p;
      first += p * grid.x(column);
      second += p * grid.y(row) * grid.y(row);
    }
  // The grid follows the pressure on a grid of half as many cells, whose moments are right within 1 %.
  CHECK(std::abs(first / sum - grid.origin_x) < 0.1 * grid.spacing_x);
  CHECK(std::sqrt(5 * second / sum) / grid.spacing_y == Approx(cells).epsilon(0.01));
}

TEST_CASE("a sphere's tolerance is met, and a tighter one takes more nodes", "[core][grid_series]") {
  // R_r of the paper's sphere on 116,433 nodes, tolerance 1e-4
  constexpr double reference = 3.09977;
  int nodes = 0;
  for (const double tolerance : {1e-2, 3e-3, 1e-3}) {
    RollingScene scene = gridless_sphere();
    scene.tolerance = tolerance;
    const RollingSolution solution = solve(scene);
    CHECK(solution.rolling_resistance == Approx(reference).epsilon(tolerance));
    CHECK(solution.error_estimate <= tolerance);
    CHECK(solution.contact_nodes > nodes);
    nodes = solution.contact_nodes;
  }
}
