#include "studies/evidence/verification_heat.hpp"

#include <cmath>
#include <numbers>

#include "core/heat/temperature_profile.hpp"
#include "core/material/prony_series.hpp"
#include "core/numerics/quadrature.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres::verification {

namespace {

constexpr double air = 293.15, cover = 0.012, conductivity = 0.19, wheel_radius = 0.05, transfer = 20;

/// A slab of one metre of belt, or the ring of the wheel, on an insulated core.
HeatPath path_of(bool ring) {
  HeatPath path;
  path.thickness = cover;
  path.turn = ring ? 2 * std::numbers::pi * wheel_radius : 1;
  if (ring) path.radius = wheel_radius;
  path.conductivity = conductivity;
  path.air = {transfer * path.turn, air};
  path.ground.temperature = path.core.temperature = air;
  return path;
}

/// One panel, of a loss that grows with a power of the depth.
std::vector<LossPanel> growing_loss(double scale, int power) {
  LossPanel panel{0, cover, {}};
  for (const double node : gauss_rule(6).nodes) panel.loss.push_back(scale * std::pow(cover * node, power));
  return {panel};
}

void check_conduction(Checks& checks) {
  const char *source = "conduction, closed forms", *why = "rounding";
  const double heating = 6e4, growth = 1e7, ring_loss = 1.5e4;
  const TemperatureProfile even(path_of(false), growing_loss(heating, 0), 0);
  checks.add({"slab, evenly heated: bond over air", source, "K",
              heating * cover / transfer + heating * cover * cover / (2 * conductivity), even.bond() - air, 1e-10,
              why});
  const TemperatureProfile linear(path_of(false), growing_loss(growth, 1), 0);
  checks.add({"slab, heated in proportion to the depth: bond over face", source, "K",
              growth * std::pow(cover, 3) / (3 * conductivity), linear.bond() - linear.face(), 1e-10, why});
  const TemperatureProfile ring(path_of(true), growing_loss(ring_loss, 0), 0);
  checks.add({"ring that loses as much at each depth: bond over face", source, "K",
              ring_loss / (2 * std::numbers::pi * conductivity) *
                  (cover + (wheel_radius - cover) * std::log(1 - cover / wheel_radius)),
              ring.bond() - ring.face(), 1e-10, "Gauss's rule for the logarithm"});
  HeatPath cooled = path_of(false);
  cooled.core = {50, 300};
  const double friction = 300, inwards = 1 / (cover / conductivity + 1 / cooled.core.conductance);
  const TemperatureProfile rubbed(cooled, growing_loss(0, 0), friction);
  checks.add({"friction's heat between air and core: to the core", source, "W/m",
              inwards * (friction + transfer * (air - 300)) / (transfer + inwards), rubbed.to_core(), 1e-10, why});
}

RollingScene wheel_scene() {
  RollingScene scene;
  scene.radius = wheel_radius;
  scene.layer_thickness = 0.02;
  scene.material = MaterialModel::elastic;
  scene.static_young_modulus = 210e9;
  scene.coating_layers.resize(1);
  scene.coating_layers[0].layer_thickness = cover;
  scene.inertia = Inertia::on;  // with it a cover is flat, as the prototype's
  scene.speed = 1.5;
  scene.load = 40e3;
  scene.drive = Drive::free;
  scene.heat = Heat::on;
  scene.thermal_conductivity = conductivity;
  scene.heat_capacity = 2.16e6;
  scene.surface_heat_transfer = transfer;
  scene.ambient_temperature = air;
  return scene;
}

/// J* = [0.52 + 0.06 sum 1/(1 + i w t)]/12 MPa, t from 0.1 us to 1 s.
void make_prototype_material(BondedLayer& layer) {
  CreepSpectrum creep{0.52 / 12e6, {}};
  for (int power = -7; power <= 0; ++power) creep.terms.push_back({0.06 / 12e6, std::pow(10.0, power)});
  layer.material = MaterialModel::prony;
  layer.static_shear_modulus = 1 / creep.at_rest();
  for (const RelaxationSpectrum::Term& term : relaxation_spectrum(creep).terms) {
    layer.relaxation_times.push_back(term.time);
    layer.relaxation_moduli.push_back(term.modulus);
  }
}

void check_wheel(Checks& checks) {
  struct Row {
    const char* name;
    double transfer, core, ground, face, bond;
  };
  constexpr double concrete = 1960;  // its effusivity, by which h_c is 230 W/m2K
  for (const Row& row :
       {Row{"h = 10", 10, 0, 0, 64, 82}, Row{"h = 20", 20, 0, 0, 32, 50}, Row{"h = 30", 30, 0, 0, 21, 40},
        Row{"core 50 W/m2K", 20, 50, 0, 15, 9}, Row{"cold floor", 20, 0, concrete, 2.5, 21}}) {
    RollingScene scene = wheel_scene();
    make_prototype_material(scene.coating_layers[0]);
    scene.surface_heat_transfer = row.transfer;
    if (row.core > 0) scene.core_heat_transfer = row.core;
    scene.ground_effusivity = row.ground;
    const RollingSolution s = checks.solve(scene);
    const std::string wheel = std::string("polyurethane wheel, ") + row.name;
    const char* digits = "whole kelvins";
    checks.add({wheel + ": face over air", "prototype of heat", "K", row.face, s.surface_temperature - air,
                std::min(1.0, 0.2 * row.face) / row.face, digits});
    checks.add({wheel + ": bond over air", "prototype of heat", "K", row.bond, s.bond_temperature - air, 1 / row.bond,
                digits});
  }
}

void check_states(Checks& checks) {
  for (const auto& [ambient, states] : {std::pair{273.15, 1}, {253.15, 3}}) {
    RollingScene scene = wheel_scene();
    scene.inertia = Inertia::off;
    BondedLayer& layer = scene.coating_layers[0];
    layer.static_shear_modulus = 12e6;
    layer.stiffening = 2;
    layer.creep_time = 2e-3;
    layer.reference_temperature = air;
    layer.wlf_c1 = 8.86;
    layer.wlf_c2 = 101.6;
    scene.ambient_temperature = ambient;
    const RollingSolution s = checks.solve(scene);
    const bool answered = !s.temperatures.empty();
    checks.add({"narrow peak of loss in air of " + short_number(ambient - 273.15) + " °C: steady states",
                "prototype of heat", "1", static_cast<double>(states),
                answered ? static_cast<double>(s.temperatures.size()) : NAN, 0, "a count"});
  }
}

}  // namespace

void check_heat(Checks& checks) {
  check_conduction(checks);
  check_wheel(checks);
  check_states(checks);
}

}  // namespace rollres::verification
