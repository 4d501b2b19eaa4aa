#include "core/heat/temperature_profile.hpp"

#include <numbers>
#include <random>

#include "core/numerics/quadrature.hpp"
#include "tests/catch.hpp"

using namespace rollres;
using std::numbers::pi;

namespace {

constexpr double thickness = 0.012, conductivity = 0.19, air = 293, length = 2;

HeatPath slab(double surface_heat_transfer) {
  HeatPath path;
  path.thickness = thickness;
  path.turn = length;
  path.conductivity = conductivity;
  path.air = {surface_heat_transfer * length, air};
  path.ground.temperature = path.core.temperature = air;
  return path;
}

/// Panels that widen with the depth, with a loss that depends on it.
template <class Loss>
std::vector<LossPanel> panels_with(const Loss& loss) {
  std::vector<LossPanel> panels;
  const QuadratureRule& rule = gauss_rule(6);
  for (double from = 0, to = thickness / 8; from < thickness; from = to, to *= 2) {
    panels.push_back({from, to, {}});
    for (const double node : rule.nodes) panels.back().loss.push_back(loss(from + (to - from) * node));
  }
  return panels;
}

double heat_out(const TemperatureProfile& profile) {
  return profile.to_air() + profile.to_ground() + profile.to_core();
}

}  // namespace

TEST_CASE("an evenly heated slab on an insulated core is warmer by q H/h at its face and by q H²/2k at its bond",
          "[core][heat]") {
  const double heating = 6e4;  // [W/m3]
  const TemperatureProfile profile(slab(20), panels_with([&](double) { return heating * length; }), 0);
  const double face = air + heating * thickness / 20,
               bond = face + heating * thickness * thickness / (2 * conductivity);
  CHECK(profile.face() == Approx(face).epsilon(1e-13));
  CHECK(profile.bond() == Approx(bond).epsilon(1e-13));
  CHECK(profile.at(0.3 * thickness) ==
        Approx(face + heating / conductivity * 0.3 * thickness * (thickness - 0.15 * thickness)).epsilon(1e-13));
  CHECK(profile.mean() == Approx(face + heating * thickness * thickness / (3 * conductivity)).epsilon(1e-13));
  CHECK(profile.mean_without_loss() == Approx(air).epsilon(1e-14));
  CHECK(profile.peak().depth == thickness);
  CHECK(profile.peak().temperature == profile.bond());
}

TEST_CASE("a heating that grows with the depth warms the bond by c H³/3k over the face", "[core][heat]") {
  const double growth = 1e7;  // [W/m4]
  const TemperatureProfile profile(slab(20), panels_with([&](double depth) { return growth * depth * length; }), 0);
  CHECK(profile.face() - air == Approx(growth * thickness * thickness / 2 / 20).epsilon(1e-12));
  CHECK(profile.bond() - profile.face() == Approx(growth * std::pow(thickness, 3) / (3 * conductivity)).epsilon(1e-12));
}

TEST_CASE("an evenly heated slab between two faces of one temperature is warmest in the middle, by q H²/8k",
          "[core][heat]") {
  const double heating = 6e4;
  HeatPath path = slab(0);
  path.core = {INFINITY, 310};
  path.air = {1e12, 310};
  const TemperatureProfile profile(path, panels_with([&](double) { return heating * length; }), 0);
  CHECK(profile.peak().depth == Approx(0.5 * thickness).epsilon(1e-8));
  CHECK(profile.peak().temperature - 310 ==
        Approx(heating * thickness * thickness / (8 * conductivity)).epsilon(1e-10));
  CHECK(profile.bond() == Approx(310).epsilon(1e-14));
  CHECK(profile.to_core() == Approx(heating * thickness * length / 2).epsilon(1e-9));
}

TEST_CASE("a ring that loses as much at each depth is warmer at its bond by D [H + (R - H) ln(1 - H/R)]/2πk",
          "[core][heat]") {
  const double radius = 0.05, loss = 1.5e4;  // [W/m2]
  HeatPath path = slab(20);
  path.radius = radius;
  path.turn = 2 * pi * radius;
  path.air.conductance = 20 * path.turn;
  const TemperatureProfile profile(path, panels_with([&](double) { return loss; }), 0);
  CHECK(profile.face() - air == Approx(loss * thickness / path.air.conductance).epsilon(1e-12));
  CHECK(profile.bond() - profile.face() ==
        Approx(loss / (2 * pi * conductivity) * (thickness + (radius - thickness) * std::log(1 - thickness / radius)))
            .epsilon(1e-10));
}

TEST_CASE("heat of friction at the face parts between the air and the core by their conductances", "[core][heat]") {
  HeatPath path = slab(20);
  path.core = {50 * length, 300};
  path.ground = {7 * length, 285};
  const double friction = 300;
  const TemperatureProfile profile(path, panels_with([](double) { return 0.0; }), friction);
  const double inwards = 1 / (thickness / (conductivity * length) + 1 / (50 * length));
  const double face = (friction + 20 * length * air + 7 * length * 285 + inwards * 300) / (27 * length + inwards);
  CHECK(profile.face() == Approx(face).epsilon(1e-13));
  CHECK(profile.to_core() == Approx(inwards * (face - 300)).epsilon(1e-12));
  CHECK(profile.to_ground() == Approx(7 * length * (face - 285)).epsilon(1e-12));
  CHECK(profile.mean() == Approx(0.5 * (profile.face() + profile.bond())).epsilon(1e-13));  // by the depth
}

TEST_CASE("what is lost leaves, whatever the losses, the exits and their temperatures", "[core][heat]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    HeatPath path = slab(100 * share(random) + 0.1);
    if (trial % 2 == 0) path.radius = 0.05 * (1 + share(random));
    if (trial % 3 > 0) path.core = {trial % 3 == 1 ? INFINITY : 100 * share(random), 280 + 40 * share(random)};
    path.ground = {300 * share(random), 280 + 40 * share(random)};
    double lost = 50 * share(random);
    const double friction = lost;
    std::vector<LossPanel> panels = panels_with([&](double) { return 2e4 * share(random); });
    for (const LossPanel& panel : panels)
      for (std::size_t i = 0; i < panel.loss.size(); ++i)
        lost += (panel.to - panel.from) * gauss_rule(6).weights[i] * panel.loss[i];
    const TemperatureProfile profile(path, panels, friction);
    CHECK(heat_out(profile) == Approx(lost).epsilon(1e-10));
    // The core's own condition, by the temperature found there.
    if (std::isfinite(path.core.conductance))
      CHECK(std::abs(profile.to_core() - path.core.conductance * (profile.bond() - path.core.temperature)) <=
            1e-9 * lost);
    else
      CHECK(profile.bond() == Approx(path.core.temperature).epsilon(1e-12));
    for (const double depth : {0.0, 0.2, 0.5, 0.9, 1.0})
      CHECK(profile.at(depth * thickness) <= profile.peak().temperature * (1 + 1e-5));
  }
}
