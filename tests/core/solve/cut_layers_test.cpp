/// A layer that is cut into two bonded ones of its own material is the same layer: memories of any length, long waves
/// and the surface far away must all cancel.

#include <cmath>
#include <complex>
#include <vector>

#include "core/material/fractional_zener.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/converged.hpp"
#include "tests/infinite.hpp"

using namespace rollres;

namespace {

constexpr double rest = 9.388e6;  // [Pa]

/// A Prony series with a term in each decade from 1e-8 to 1e8 s.
MaterialInputs prony_over_decades() {
  MaterialInputs material;
  material.material = MaterialModel::prony;
  material.static_shear_modulus = rest;
  for (int decade = -8; decade <= 8; ++decade) {
    material.relaxation_times.push_back(std::pow(10.0, decade));
    material.relaxation_moduli.push_back(0.7 * rest);
  }
  return material;
}

MaterialInputs fractional(double order) {
  MaterialInputs material;
  material.material = MaterialModel::fractional_zener;
  material.static_shear_modulus = rest;
  material.stiffening = 12.58;
  material.creep_time = 0.1236;
  material.fractional_order = order;
  return material;
}

/// A table of 49 rows of a fractional solid, over 12 decades.
MaterialInputs master_curve() {
  MaterialInputs material;
  material.material = MaterialModel::master_curve;
  for (int row = 0; row < 49; ++row) {
    const double frequency = std::pow(10.0, -6 + 0.25 * row);
    const std::complex<double> modulus =
        complex_modulus(FractionalZener{rest, 12.58, 0.1236, 0.45}, 2 * M_PI * frequency);
    material.frequencies.push_back(frequency);
    material.storage_moduli.push_back(modulus.real());
    material.loss_moduli.push_back(modulus.imag());
  }
  return material;
}

std::vector<MaterialInputs> every_material() {
  MaterialInputs elastic;
  elastic.material = MaterialModel::elastic;
  elastic.static_shear_modulus = rest;
  MaterialInputs zener = fractional(1);
  zener.material = MaterialModel::zener;
  return {elastic, zener, prony_over_decades(), fractional(0.5791), fractional(0.3), master_curve()};
}

RollingScene cylinder_on(const MaterialInputs& material, double poisson_ratio) {
  RollingScene scene;
  static_cast<MaterialInputs&>(scene) = material;
  scene.poisson_ratio = poisson_ratio;
  scene.radius = 20.33e-3;
  scene.layer_thickness = 1.448e-3;
  scene.speed = 0.2862;
  scene.load = 6615;
  scene.inertia = Inertia::off;
  return scene;
}

RollingScene cut(RollingScene scene, double share) {
  BondedLayer lower;
  static_cast<MaterialInputs&>(lower) = scene;
  lower.layer_thickness = (1 - share) * scene.layer_thickness;
  scene.layer_thickness *= share;
  scene.lower_layers = {lower};
  return scene;
}

/// An elastic layer resists with nothing, to so much of the load times the contact's part of the radius.
constexpr double nothing = 1e-7;

/// Solutions of a scene and of the one whose layer is cut, with the load given and with the approach that it brings.
void check_cut(const RollingScene& scene, double accuracy) {
  const RollingSolution whole = converged(scene), two = converged(cut(scene, 0.37));
  const double rounding = nothing * whole.load * whole.leading_edge / scene.radius;
  const auto resistance = [&](const RollingSolution& expected) {
    return Approx(expected.rolling_resistance).epsilon(accuracy).margin(rounding);
  };
  CHECK(two.rolling_resistance == resistance(whole));
  CHECK(two.approach == Approx(whole.approach).epsilon(accuracy));
  RollingScene sunk = scene;
  sunk.load.reset();
  sunk.approach = whole.approach;
  const RollingSolution again = converged(sunk), again_two = converged(cut(sunk, 0.37));
  CHECK(again.load == Approx(whole.load).epsilon(accuracy));
  CHECK(again_two.load == Approx(again.load).epsilon(accuracy));
  CHECK(again_two.rolling_resistance == resistance(again));
  // The edge of a sphere's contact is corrected where a load is given.
  if (scene.indenter == Indenter::cylinder) CHECK(again.rolling_resistance == resistance(whole));
}

}  // namespace

TEST_CASE("a layer cut in two of one material changes nothing, with continuous edges", "[core][cut_layers]") {
  for (const MaterialInputs& material : every_material())
    for (const double poisson_ratio : {0.3, 0.5}) {
      CAPTURE(name_of(material.material), material.fractional_order, poisson_ratio);
      RollingScene scene = cylinder_on(material, poisson_ratio);
      scene.tolerance = 1e-6;
      check_cut(scene, 1e-6);  // the tolerance
    }
}

TEST_CASE("a layer cut in two of one material changes nothing, on a grid", "[core][cut_layers]") {
  for (const MaterialInputs& material : every_material()) {
    CAPTURE(name_of(material.material), material.fractional_order);
    RollingScene scene = cylinder_on(material, 0.3);
    scene.method = Method::newton;
    scene.spacing = 5e-5;  // the same grid for both: what is left is that of the tables
    check_cut(scene, 1e-6);
  }
}

TEST_CASE("a layer of a fractional solid yields under a grid as under continuous edges", "[core][cut_layers]") {
  const auto approach = [](Method method, double tolerance) {
    RollingScene scene = cylinder_on(fractional(0.5791), 0.3);
    scene.method = method;
    scene.tolerance = tolerance;
    return converged(scene).approach;
  };
  // On its grid the approach is off by a few times the resistance's error.
  CHECK(approach(Method::spectral, 1e-6) == Approx(approach(Method::newton, 1e-4)).epsilon(3e-4));
}

TEST_CASE("a sphere's layer cut in two of one material changes nothing", "[core][cut_layers]") {
  RollingScene scene = cylinder_on(prony_over_decades(), 0.3);
  scene.indenter = Indenter::sphere;
  scene.load = 60;
  scene.spacing = 1e-4;
  check_cut(scene, 1e-6);
}

TEST_CASE("long memories act on a half-space as on a layer a million contacts thick", "[core][cut_layers]") {
  // A spectrum around 1e4 s at a passage of a millisecond: all of the loss is that of long memories, and beyond 1e6
  // times the passage they stand as one.
  MaterialInputs material = fractional(0.8);
  material.creep_time = 1e4;
  RollingScene scene = cylinder_on(material, 0.5);
  scene.speed = 4;
  scene.tolerance = 1e-6;
  scene.layer_thickness = 9e5;
  const double expected = converged(scene).rolling_resistance;
  scene.layer_thickness = infinite;
  CHECK(converged(scene).rolling_resistance == Approx(expected).epsilon(1e-4));  // what so thick a layer lacks
  scene.method = Method::newton;
  scene.tolerance = 1e-3;
  CHECK(converged(scene).rolling_resistance == Approx(expected).epsilon(1e-3));
}

TEST_CASE("a half-space with a spectrum over eight decades answers with inertia and friction", "[core][cut_layers]") {
  RollingScene scene;
  scene.radius = 66.5e-3;
  scene.layer_thickness = infinite;
  scene.layer_density = 1150;
  scene.material = MaterialModel::prony;
  scene.static_shear_modulus = 1e6;
  scene.relaxation_times = {1e-4, 1e-2, 1, 1e2, 1e4};
  scene.relaxation_moduli = std::vector<double>(5, 5e5);
  scene.load = 3000;
  scene.speed = 4;
  scene.tolerance = 1e-3;
  RollingScene thick = scene;
  thick.layer_thickness = 1e5;
  // Each is within its tolerance.
  CHECK(converged(scene).rolling_resistance == Approx(converged(thick).rolling_resistance).epsilon(2e-3));
  scene.friction_coefficient = 0.3;
  scene.drive = Drive::free;
  const RollingSolution free = converged(scene);
  scene.inertia = Inertia::off;
  // Inertia adds about rho V^2/G, here 0.6 %, and friction on an incompressible half-space next to nothing.
  CHECK(free.rolling_resistance == Approx(converged(scene).rolling_resistance).epsilon(0.012));
}
