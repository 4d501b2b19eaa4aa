#include "core/material/material_scale.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

// Covers shift_table and material_scale in scenes.

using namespace rollres;

namespace {

constexpr double at_reference = 293.15, colder = 258.15;
const TemperatureShift wlf{.law = ShiftLaw::wlf, .reference = at_reference, .c1 = 8.86, .c2 = 101.6};

void rubber(MaterialInputs& layer, double modulus, double time) {
  layer.static_shear_modulus = modulus;
  layer.stiffening = 4;
  layer.creep_time = time;
  layer.reference_temperature = at_reference;
  layer.temperature = colder;
}

void by_law(MaterialInputs& layer) {
  layer.wlf_c1 = wlf.c1;
  layer.wlf_c2 = wlf.c2;
}

/// @param rows  temperatures of a table that WLF gives
void by_table(MaterialInputs& layer, const std::vector<double>& rows) {
  for (const double temperature : rows) {
    layer.shift_temperatures.push_back(temperature);
    layer.shift_factors.push_back(shift_factor(wlf, temperature));
  }
}

/// A cylinder with a cover on two layers, or a sphere on one, all of rubbers in the cold.
template <class Shift>
RollingScene cold_scene(Indenter indenter, const Shift& shift) {
  RollingScene scene = plain_scene(1, indenter == Indenter::cylinder ? 5e3 : 50);
  scene.indenter = indenter;
  scene.radius = 0.05;
  scene.layer_thickness = 0.01;
  scene.friction_coefficient = 0;
  rubber(scene, 2e6, 1e-5);
  shift(static_cast<MaterialInputs&>(scene));
  if (indenter == Indenter::sphere) {
    scene.spacing = 1e-3;
    return scene;
  }
  BondedLayer lower;
  lower.layer_thickness = 0.02;
  rubber(lower, 4e6, 1e-6);
  shift(lower);
  scene.lower_layers = {lower};
  BondedLayer cover;
  cover.layer_thickness = 0.005;
  rubber(cover, 8e6, 3e-6);
  shift(cover);
  scene.coating_layers = {cover};
  return scene;
}

}  // namespace

TEST_CASE("scenes whose layers and covers shift by a table of WLF's have the answers of WLF, at its rows and between",
          "[core][solve][material]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    CAPTURE(indenter);
    const RollingSolution law = solve(cold_scene(indenter, by_law));
    REQUIRE(law.status == Status::converged);
    for (const std::vector<double>& rows :
         {std::vector<double>{at_reference, colder, 330}, std::vector<double>{250, 270, 290, 310}}) {
      const RollingSolution table = solve(cold_scene(indenter, [&](MaterialInputs& layer) { by_table(layer, rows); }));
      REQUIRE(table.status == Status::converged);
      CHECK(table.rolling_resistance == Approx(law.rolling_resistance).epsilon(1e-9));
      CHECK(table.approach == Approx(law.approach).epsilon(1e-9));
    }
  }
}

TEST_CASE("b_T divides all moduli of a scene: under a load divided by it the contact is the same",
          "[core][solve][material]") {
  // b G* is the material at the reference: with P/b the pressures are those of P over b, the displacements the same.
  constexpr double b = 1.25;
  RollingScene plain = cold_scene(Indenter::cylinder, by_law), shifted = plain;
  const auto add = [&](MaterialInputs& layer) {
    layer.shift_temperatures = {250, colder, at_reference};
    layer.modulus_shifts = {2 * b, 2 * b, 2};
  };
  add(shifted);
  add(shifted.lower_layers.front());
  add(shifted.coating_layers.front());
  *shifted.load /= b;
  const RollingSolution one = solve(plain), other = solve(shifted);
  REQUIRE(other.status == Status::converged);
  CHECK(other.approach == Approx(one.approach).epsilon(1e-9));
  CHECK(b * other.rolling_resistance == Approx(one.rolling_resistance).epsilon(1e-9));
}
