#include "core/edge/contact_outline.hpp"

#include <cmath>
#include <limits>

#include "core/reference/reference_solutions.hpp"
#include "tests/core/converged.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

constexpr double modulus = 3e6;

/// An elastic half-space without friction, under a load so small that a circle is a parabola.
RollingScene hertz_scene(Indenter indenter, double load) {
  RollingScene scene;
  scene.indenter = indenter;
  scene.radius = 0.02;
  scene.layer_thickness = std::numeric_limits<double>::infinity();
  scene.material = MaterialModel::elastic;
  scene.static_shear_modulus = modulus;
  scene.speed = 1;
  scene.load = load;
  scene.method = Method::newton;
  return scene;
}

/// The paper's cylinder without friction, at a speed.
RollingScene smooth_cylinder(double speed) {
  RollingScene scene = frictionless(paper_cylinder());
  scene.kinematics = Kinematics::consistent;
  scene.speed = speed;
  return scene;
}

}  // namespace

// Nodes alone tell an edge to half a cell; the tolerances are those by which the rule was fitted, twice its median.
TEST_CASE("the length and the largest pressure of a Hertz line are found between the nodes of coarse grids",
          "[core][contact_outline]") {
  RollingScene scene = hertz_scene(Indenter::cylinder, 10);
  const HertzLine exact = hertz_line(scene.radius, 10, modulus);
  for (const double cells : {6.1, 6.5, 6.9, 9.3, 12.7, 20.0, 30.4}) {
    scene.spacing = exact.half_width / cells;
    const RollingSolution s = converged(scene);
    INFO(cells << " cells on the half-length");
    CHECK(std::abs(s.leading_edge - exact.half_width) < 0.04 * *scene.spacing);
    CHECK(s.trailing_edge == Approx(-s.leading_edge));
    CHECK(std::abs(s.contact_area - 2 * exact.half_width) < s.contact_area_error);
    CHECK(s.contact_area_error < 0.3 * *scene.spacing);
    CHECK(std::abs(s.peak_pressure - exact.peak_pressure) < std::min(s.peak_pressure_error, 3e-3 * s.peak_pressure));
    CHECK(std::isnan(s.half_width));
  }
}

TEST_CASE("the half-width and the area of Hertz's circle are found between the nodes of coarse grids",
          "[core][contact_outline]") {
  RollingScene scene = hertz_scene(Indenter::sphere, 1e-4);
  const HertzSphere exact = hertz_sphere(scene.radius, 1e-4, modulus);
  const double area = M_PI * exact.half_width * exact.half_width;
  for (const double cells : {5.7, 6.4, 7.3, 9.1, 12.2}) {
    scene.spacing = exact.half_width / cells;
    const RollingSolution s = converged(scene);
    INFO(cells << " cells on the radius");
    for (const double edge : {s.leading_edge, -s.trailing_edge, s.half_width})
      CHECK(std::abs(edge - exact.half_width) < std::min(s.edge_error, 0.1 * *scene.spacing));
    CHECK(std::abs(s.contact_area - area) < std::min(s.contact_area_error, 0.01 * area));
    CHECK(std::abs(s.peak_pressure - exact.peak_pressure) < s.peak_pressure_error);
  }
}

// Memories from a twentieth of a cell to twelve cells long bend the pressure where its edge is read from.
TEST_CASE("on a viscoelastic layer the edges and the peak lie within their stated errors of continuous ones",
          "[core][contact_outline]") {
  for (const double speed : {5e-5, 2e-4, 8e-4, 3e-3, 12e-3, 0.05, 1.0}) {
    RollingScene scene = smooth_cylinder(speed);
    const RollingSolution s = converged(scene);
    scene.spacing.reset();
    const RollingSolution exact = converged(scene);
    INFO("speed " << speed);
    CHECK(std::abs(s.leading_edge - exact.leading_edge) < s.edge_error);
    CHECK(std::abs(s.trailing_edge - exact.trailing_edge) < s.edge_error);
    CHECK(std::abs(s.contact_area - exact.contact_area) < s.contact_area_error);
    CHECK(std::abs(s.peak_pressure - exact.peak_pressure) < s.peak_pressure_error);
    CHECK(s.contact_area_error < 0.03 * s.contact_area);  // nodes alone: 1.4 of 31 cells
    CHECK(std::isnan(exact.edge_error));
  }
}

TEST_CASE("pressures that end in a peak of one cell say that edges and the largest pressure are open",
          "[core][contact_outline]") {
  SurfaceGrid grid;
  grid.spacing_x = 1e-3;
  grid.spacing_y = 1;
  grid.columns = 40;
  grid.rows = 1;
  Vector pressure = Vector::Zero(grid.columns);
  for (int i = 5; i <= 34; ++i) pressure(i) = 1e6 * std::sqrt((i - 4.7) * (34.3 - i)) / 14.8;
  const RollingScene scene = smooth_cylinder(1);
  const ContactOutline even = contact_outline(scene, grid, pressure);
  CHECK(even.peak_error < 0.02 * even.peak);
  pressure(34) = 0.6e6;  // some 2.5 times what its neighbour leads to expect
  const ContactOutline open = contact_outline(scene, grid, pressure);
  CHECK(open.edge_error > 0.5 * grid.spacing_x);
  CHECK(open.area_error > 0.5 * grid.spacing_x);
  CHECK(open.peak_error > 0.5 * even.peak);
}

TEST_CASE("contacts as the paper prints them, or that adhere, are those of their nodes", "[core][contact_outline]") {
  RollingScene scene = paper_cylinder();
  scene.method = Method::newton;
  RollingScene sticky = frictionless(scene);
  sticky.kinematics = Kinematics::consistent;
  sticky.adhesion_threshold = 1e4;
  for (const RollingScene& one : {scene, sticky}) {
    const RollingSolution s = converged(one);
    for (const double edge : {s.leading_edge, s.trailing_edge})
      CHECK(std::abs(std::remainder(edge, *one.spacing)) < 1e-12);
    CHECK(s.contact_area == Approx(s.contact_nodes * *one.spacing));
    CHECK(s.edge_error == Approx(*one.spacing));
  }
}
