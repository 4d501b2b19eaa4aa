#include "core/edge/contact_edge.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/convolution/influence_operator.hpp"
#include "core/newton/contact_problem.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/edge/edge_circle.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/source_directory.hpp"

using namespace rollres;

namespace {

/// Fourth difference across rows over 16 and the largest value, at nodes that stick with their neighbours: the quantile
/// of 95 % and the largest.
struct Alternation {
  double usual = 0, largest = 0;
};

Alternation alternation(const SurfaceFields& fields, const std::vector<double>& shear) {
  const SurfaceGrid& grid = fields.grid;
  double peak = 0;
  for (const double value : shear) peak = std::max(peak, std::abs(value));
  std::vector<double> found;
  for (int row = 2; row + 2 < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      double sum = 0;
      bool sticks = true;
      constexpr double weights[] = {1, -4, 6, -4, 1};
      for (int k = -2; k <= 2; ++k) {
        const auto at = static_cast<std::size_t>(grid.index(column, row + k));
        sticks = sticks && fields.zone[at] == Zone::stick;
        sum += weights[k + 2] * shear[at];
      }
      if (sticks) found.push_back(std::abs(sum) / (16 * peak));
    }
  std::sort(found.begin(), found.end());
  return {found[found.size() * 95 / 100], found.back()};
}

}  // namespace

TEST_CASE("with its edge an elliptical shear on a half-space moves the surface as Johnson says, up to the edge",
          "[core][contact_edge]") {
  // Johnson (1985), eqs. 3.91: u = pi q0/(32 G a) (4 (2 - nu) a^2 - (4 - 3 nu) x^2 - (4 - nu) y^2), v = pi q0/(32 G a)
  // 2 nu x y under q0 sqrt(1 - r^2/a^2) along x.
  for (const double nu : {0.5, 0.2}) {
    RollingScene scene = on_half_space(nu);
    scene.friction_coefficient = 1;
    const Circle circle(1e-3);
    const SurfaceGrid& half = circle.half;
    Vector shear = Vector::Zero(half.size());
    std::vector<char> in_contact(static_cast<std::size_t>(half.size()));
    for (int row = 0; row < half.rows; ++row)
      for (int column = 0; column < half.columns; ++column) {
        const Eigen::Index i = half.index(column, row);
        shear(i) = circle.mean(column, row) / circle.radius;
        in_contact[static_cast<std::size_t>(i)] = shear(i) > 0;
      }
    const InfluenceOperator influence(scene, influence_table(scene, mirrored(half)), half, true);
    const Vector none = Vector::Zero(half.size());
    const Displacements moved = influence.apply(none, shear, none);
    const double a = half.spacing_x, scale = M_PI / (32 * circle.radius * a);
    Vector even_x = none, even_y = none;
    const auto slip_at = [&](int column, int row, const Vector& u) {
      const Eigen::Index at = static_cast<Eigen::Index>(row) * (half.columns + 1) + column;
      return (u(at + 1) - u(at)) / a;
    };
    for (int row = 0; row < half.rows; ++row)
      for (int column = 0; column < half.columns; ++column) {
        even_x(half.index(column, row)) = slip_at(column, row, moved.u);
        even_y(half.index(column, row)) = slip_at(column, row, moved.v);
      }
    Vector x = even_x, y = even_y;
    EdgeSlip(scene, half, circle.curve(), in_contact).add(shear, none, x, y);
    double worst = 0, worst_even = 0;
    for (int row = 0; row < half.rows; ++row)
      for (int column = 0; column < half.columns; ++column) {
        const Eigen::Index i = half.index(column, row);
        const double from_centre = half.x(column) + 0.5 * a - circle.centre * a;
        // At the leading edge, and not where the edge hardly leans to the motion.
        if (!in_contact[static_cast<std::size_t>(i)] || from_centre < 0.3 * circle.radius * a) continue;
        const double slope_u = -2 * scale * (4 - 3 * nu) * from_centre, slope_v = 2 * scale * nu * half.y(row);
        worst = std::max({worst, std::abs(x(i) - slope_u), std::abs(y(i) - slope_v)});
        worst_even = std::max({worst_even, std::abs(even_x(i) - slope_u), std::abs(even_y(i) - slope_v)});
      }
    CAPTURE(nu, worst, worst_even);
    CHECK(worst < 0.2 * worst_even);
  }
}

TEST_CASE("a row that the contact just touches has no slip without bound", "[core][contact_edge]") {
  Circle circle(1e-4);
  RollingScene scene;
  scene.layer_thickness = INFINITY;
  scene.static_shear_modulus = 1e6;
  scene.poisson_ratio = 0.5;
  double usual = 0;
  for (const double touched : {0.8, 0.1, 1e-2, 1e-4, 1e-6}) {
    circle.radius = 12.5 + touched;  // into the cells of row 13
    std::vector<char> in_contact(static_cast<std::size_t>(circle.half.size()), 0);
    Vector shear = Vector::Zero(circle.half.size()), none = shear, slip_x = none, slip_y = none;
    for (int row = 0; row <= 13; ++row)
      for (int column = 0; column < circle.half.columns; ++column) {
        const Eigen::Index i = circle.half.index(column, row);
        if (circle.level(circle.half.first_column + column, row) < (row == 13 ? -13 : 0)) continue;
        in_contact[static_cast<std::size_t>(i)] = 1;
        shear(i) = 1;
      }
    EdgeSlip(scene, circle.half, circle.curve(), in_contact).add(shear, none, slip_x, slip_y);
    INFO(touched << ": " << slip_x.cwiseAbs().maxCoeff());
    if (usual == 0) usual = slip_x.cwiseAbs().maxCoeff();
    CHECK(slip_x.cwiseAbs().maxCoeff() < 10 * usual);
  }
}

TEST_CASE("the shear of a sphere does not alternate from row to row", "[core][contact_edge]") {
  RollingScene scene = paper_sphere();
  const RollingSolution printed = solve(scene);
  scene.kinematics = Kinematics::consistent;
  const RollingSolution coarse = solve(scene);
  *scene.spacing /= 2;
  const RollingSolution fine = solve(scene);
  for (const RollingSolution* one : {&printed, &coarse, &fine}) {
    REQUIRE(one->status == Status::converged);
    CHECK(one->law_violation < 1e-8);
  }
  const auto along = [](const RollingSolution& s) { return alternation(s.fields, s.fields.shear_x); };
  const auto aside = [](const RollingSolution& s) { return alternation(s.fields, s.fields.shear_y); };
  CHECK(along(printed).usual > 0.03);  // even cells
  CHECK(along(coarse).usual < 4e-3);
  CHECK(along(coarse).largest < 15e-3);
  CHECK(aside(coarse).usual < 4e-3);
  CHECK(aside(coarse).largest < 15e-3);
  CHECK(along(fine).usual < 2e-3);
  CHECK(aside(fine).usual < 4e-3);
}

TEST_CASE("a sphere's edge in its cells keeps the laws of contact on every layer and under every drive",
          "[core][contact_edge][long]") {
  RollingScene plain = paper_sphere();
  plain.kinematics = Kinematics::consistent;
  plain.spacing = 0.4e-3;
  std::vector<RollingScene> scenes;
  const auto add = [&](const auto& change) { change(scenes.emplace_back(plain)); };
  add([](RollingScene& s) { s.drive = Drive::free; });
  add([](RollingScene& s) {
    s.drive = Drive::rotation;
    s.rotation_ratio = 0.9;
  });
  add([](RollingScene& s) {
    s.drive = Drive::torque;
    s.driving_torque = 0.2;
  });
  add([](RollingScene& s) { s.poisson_ratio = 0.3; });
  add([](RollingScene& s) {
    BondedLayer coating;
    coating.static_shear_modulus = 20e6;
    coating.layer_thickness = 2e-3;
    s.coating_layers.push_back(coating);
  });
  scenes.resize(static_cast<std::size_t>(thinned(static_cast<int>(scenes.size()))));
  for (RollingScene& scene : scenes) {
    scene.time_limit = patience(60);
    const RollingSolution s = solve(scene);
    CAPTURE(name_of(scene.drive), scene.poisson_ratio, s.reason);
    REQUIRE(s.status == Status::converged);
    CHECK(s.law_violation < 1e-8);
    RollingScene dense = scene;
    dense.method = Method::newton_dense;
    CHECK(solve(dense).rolling_resistance == Approx(s.rolling_resistance).epsilon(1e-7));
  }
}
