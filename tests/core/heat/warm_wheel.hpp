#pragma once

#include <cmath>

#include "core/material/prony_series.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

/// A polyurethane of 12 MPa whose tan delta is near 0.1 over eight decades: J* = [0.52 + 0.06 sum 1/(1 + i w t)]/12
/// MPa, t from 0.1 us to 1 s, as relaxation times and moduli.
inline void make_polyurethane(rollres::MaterialInputs& layer) {
  rollres::CreepSpectrum creep{0.52 / 12e6, {}};
  for (int power = -7; power <= 0; ++power) creep.terms.push_back({0.06 / 12e6, std::pow(10.0, power)});
  const rollres::RelaxationSpectrum relaxation = rollres::relaxation_spectrum(creep);
  layer.material = rollres::MaterialModel::prony;
  layer.static_shear_modulus = 1 / creep.at_rest();
  layer.relaxation_times.clear();
  layer.relaxation_moduli.clear();
  for (const auto& term : relaxation.terms) {
    layer.relaxation_times.push_back(term.time);
    layer.relaxation_moduli.push_back(term.modulus);
  }
}

/// A wheel of 100 mm with 12 mm of it on an insulated core, on a hard floor that takes no heat.
inline rollres::RollingScene warm_wheel() {
  rollres::RollingScene scene;
  scene.radius = 0.05;
  scene.layer_thickness = 0.02;
  scene.material = rollres::MaterialModel::elastic;
  scene.static_young_modulus = 210e9;
  scene.coating_layers.resize(1);
  scene.coating_layers[0].layer_thickness = 0.012;
  make_polyurethane(scene.coating_layers[0]);
  scene.inertia = rollres::Inertia::off;
  scene.speed = 1.5;
  scene.load = 40e3;
  scene.drive = rollres::Drive::free;
  scene.heat = rollres::Heat::on;
  scene.thermal_conductivity = 0.19;
  scene.heat_capacity = 2.16e6;
  scene.surface_heat_transfer = 20;
  scene.ambient_temperature = 293.15;
  return scene;
}
