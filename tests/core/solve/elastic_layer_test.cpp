/// Frictionless contact on an elastic bonded layer, from thick to thin.

#include <cmath>

#include "core/reference/reference_solutions.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

constexpr double G = 1e6, R = 1, a = 0.01;  // [Pa], [m], [m]

RollingScene elastic(Indenter indenter, const ElasticLayerRow& row, int nodes_in_half) {
  RollingScene scene;
  scene.indenter = indenter;
  scene.material = MaterialModel::elastic;
  scene.radius = R;
  scene.layer_thickness = a / row.width_ratio;
  scene.static_shear_modulus = G;
  scene.speed = 1;
  scene.spacing = a / nodes_in_half;
  return scene;
}

/// Half-width from the cells in contact.
double half_width(const RollingSolution& s) {
  return s.fields.v.empty() ? 0.5 * s.contact_area : std::sqrt(s.contact_area / M_PI);
}

}  // namespace

TEST_CASE("a cylinder on an elastic layer has the tabulated load and approach", "[core][elastic_layer]") {
  for (const ElasticLayerRow& row : elastic_layer_table) {
    RollingScene scene = elastic(Indenter::cylinder, row, 200);
    const double load = row.cylinder_load * M_PI * G * a * a / R, approach = row.cylinder_approach * a * a / R;
    INFO("a/H = " << row.width_ratio);
    scene.load = load;
    const RollingSolution pressed = solve(scene);
    REQUIRE(pressed.status == Status::converged);
    CHECK(pressed.law_violation < 1e-8);
    CHECK(half_width(pressed) == Approx(a).epsilon(0.01));
    CHECK(pressed.approach == Approx(approach).epsilon(0.003));  // the table is known to 1e-3, the edge to a cell
    CHECK(std::abs(pressed.rolling_resistance_coefficient) < 1e-10 * a);
    scene.load.reset();
    scene.approach = approach;
    CHECK(solve(scene).load == Approx(load).epsilon(0.01));  // load grows up to five times as fast as the half-width
  }
}

TEST_CASE("a sphere on an elastic layer has the tabulated load and approach", "[core][elastic_layer]") {
  for (const ElasticLayerRow& row : elastic_layer_table) {
    RollingScene scene = elastic(Indenter::sphere, row, row.width_ratio < 10 ? 24 : 40);  // two cells through the layer
    const double load = row.sphere_load * G * a * a * a / R, approach = a * a / R / row.sphere_flatness;
    INFO("a/H = " << row.width_ratio);
    scene.load = load;
    const RollingSolution pressed = solve(scene);
    REQUIRE(pressed.status == Status::converged);
    CHECK(pressed.law_violation < 1e-8);
    CHECK(half_width(pressed) == Approx(a).epsilon(0.01));
    CHECK(pressed.approach == Approx(approach).epsilon(0.003));
    scene.load.reset();
    scene.approach = approach;
    CHECK(solve(scene).load == Approx(load).epsilon(0.01));
  }
}

TEST_CASE("the pressure on a thin layer becomes that of a lubrication film", "[core][elastic_layer]") {
  // p = p0 (1 - (x/a)^2)^2 is approached slowly: at a/H = 20 the load is still 42 % above P = 2 G a^5/(15 R H^3), and
  // each doubling of a/H about halves the excess.
  double excess = 0.42;
  for (const double width_ratio : {40.0, 80.0}) {
    ElasticLayerRow row{};
    row.width_ratio = width_ratio;
    RollingScene scene = elastic(Indenter::cylinder, row, 200);
    const double H = scene.layer_thickness;
    scene.approach = a * a / 6 / R;
    const RollingSolution s = solve(scene);
    REQUIRE(s.status == Status::converged);
    const double width = half_width(s), limit = 2 * G * std::pow(width, 5) / (15 * R * H * H * H);
    INFO("a/H = " << width_ratio);
    CHECK(s.load / limit - 1 > 0.4 * excess);
    CHECK(s.load / limit - 1 < 0.6 * excess);
    excess = s.load / limit - 1;
  }
}
