#include "core/newton/surface_window.hpp"

#include <cmath>

#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

std::size_t node_at(const SurfaceGrid& grid, double x, double y = 0) {
  const int column = static_cast<int>(std::lround((x - grid.x(0)) / grid.spacing_x));
  const int row = grid.rows == 1 ? 0 : static_cast<int>(std::lround((y - grid.y(0)) / grid.spacing_y));
  return static_cast<std::size_t>(grid.index(column, row));
}

double largest_size(const std::vector<double>& values) {
  double size = 0;
  for (const double value : values) size = std::max(size, std::abs(value));
  return size;
}

}  // namespace

TEST_CASE("the surface around a contact continues the surface under it", "[core][surface]") {
  for (const RollingScene& scene : {paper_cylinder(), with_method(paper_cylinder(), Method::active_set), paper_sphere(),
                                    frictionless(paper_sphere())}) {
    const RollingSolution solution = solve(scene);
    const SurfaceFields wide = surface_around(scene, solution, 1.5), &own = solution.fields;
    CHECK(wide.grid.x(0) < solution.trailing_edge - 5e-3);
    CHECK(wide.grid.x(wide.grid.columns - 1) > solution.leading_edge + 5e-3);
    CHECK(wide.w.size() == static_cast<std::size_t>(wide.grid.size()));
    double worst = 0;
    for (int row = 0; row < own.grid.rows; ++row)
      for (int column = 0; column < own.grid.columns; ++column) {
        const auto from = static_cast<std::size_t>(own.grid.index(column, row));
        const std::size_t to = node_at(wide.grid, own.grid.x(column), own.grid.y(row));
        for (const auto field : {&SurfaceFields::w, &SurfaceFields::u, &SurfaceFields::v})
          if (!(own.*field).empty())
            worst = std::max(worst, std::abs((own.*field)[from] - (wide.*field)[to]) / largest_size(own.*field));
        CHECK(own.pressure[from] == wide.pressure[to]);
        CHECK(own.zone[from] == wide.zone[to]);
      }
    CHECK(worst < 1e-9);  // the kernels of either window are quadratures of their own
  }
}

TEST_CASE("an incompressible layer rises around a cylinder by as much as it sinks under it", "[core][surface]") {
  const RollingScene scene = paper_cylinder();
  // 150 mm to either side: thirty thicknesses, twelve times the way during the creep time.
  const SurfaceFields wide = surface_around(scene, solve(scene), 40);
  double sum = 0, sum_of_sizes = 0;
  for (const double w : wide.w) sum += w, sum_of_sizes += std::abs(w);
  CHECK(wide.grid.columns > 1200);
  CHECK(std::abs(sum) < 1e-4 * sum_of_sizes);
}

TEST_CASE("of a periodic train the surface is shown over half a period at most", "[core][surface]") {
  RollingScene scene = paper_cylinder();
  scene.period = 0.03;
  const RollingSolution solution = solve(scene);
  const SurfaceFields wide = surface_around(scene, solution, 1.5);
  CHECK(wide.grid.columns <= 60);
  CHECK(wide.grid.columns >= 57);
  const double left = wide.w.front(), under = wide.w[node_at(wide.grid, 0)];
  CHECK(under == Approx(-solution.approach).epsilon(1e-6));
  CHECK(left > 0);
}

TEST_CASE("a cylinder's surface outside the contact is the same by continuous edges and on a fine grid",
          "[core][surface]") {
  RollingScene scene = paper_cylinder();
  scene.spacing = 0.02e-3;
  const RollingSolution fine = solve(scene);
  scene.spacing.reset();
  const RollingSolution smooth = solve(scene);
  REQUIRE(smooth.method == Method::spectral);
  const SurfaceFields on_grid = surface_around(scene, fine, 1.6), exact = surface_around(scene, smooth, 1.6);
  CHECK(exact.grid.x(0) < -8.9e-3);
  CHECK(exact.grid.x(exact.grid.columns - 1) > 9.3e-3);
  for (int i = 0; i < exact.grid.columns; ++i) {
    const double x = exact.grid.x(i);
    const std::size_t near = node_at(on_grid.grid, x), here = static_cast<std::size_t>(i);
    CAPTURE(x);
    // Half a cell apart at most, on slopes up to 0.2.
    CHECK(exact.w[here] == Approx(on_grid.w[near]).margin(1e-2 * smooth.approach));
    CHECK(exact.u[here] == Approx(on_grid.u[near]).margin(1e-2 * smooth.approach));
  }
}

TEST_CASE("the surface under the sticking part of a rolling sphere moves straight backwards", "[core][surface]") {
  for (const Method method : {Method::newton, Method::active_set}) {
    RollingScene scene = with_method(paper_sphere(), method);
    if (method == Method::active_set) scene.spacing = 0.5e-3;
    const RollingSolution solution = solve(scene);
    const SurfaceFields wide = surface_around(scene, solution, 1);
    const SurfaceVelocity velocity = surface_velocity(scene, wide);
    for (int row = 0; row < wide.grid.rows; ++row)
      for (int column = 0; column < wide.grid.columns; ++column) {
        const auto node = static_cast<std::size_t>(wide.grid.index(column, row));
        if (wide.zone[node] != Zone::stick) continue;
        const double y = wide.grid.y(row), radius = std::sqrt(1 - y * y / (scene.radius * scene.radius));
        CHECK(velocity.x[node] == Approx(-scene.speed * (solution.rotation_ratio * radius - 1)).epsilon(1e-6));
        CHECK(std::abs(velocity.y[node]) < 1e-8 * scene.speed);
      }
  }
}
