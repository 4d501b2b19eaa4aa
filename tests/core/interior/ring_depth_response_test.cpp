#include "core/interior/ring_depth_response.hpp"

#include <vector>

#include "core/interior/interior_summary.hpp"
#include "tests/core/converged.hpp"

// Covers ring_waves, too.

using namespace rollres;
using complex = std::complex<double>;

namespace {

MediumLayer ring(double radius, double thickness, double nu) {
  return {thickness, nu, 0, {.instantaneous = 1, .terms = {}}, radius};
}

void check_same(const PlaneStress& a, const PlaneStress& b, double share) {
  CHECK(std::abs(a.x - b.x) < share);
  CHECK(std::abs(a.z - b.z) < share);
  CHECK(std::abs(a.xz - b.xz) < share);
}

const SurfaceTractions::Transforms tractions{complex(1, 0.3), complex(-0.4, 0.7)};

}  // namespace

TEST_CASE("Waves inside a large ring are those of a flat layer", "[core][interior][ring]") {
  constexpr double radius = 1e4, thickness = 0.01;  // differ by H/R = 1e-6
  const std::vector<complex> moduli{{2.0, 0.3}, {5.0, 1.0}};
  for (const double nu : {0.0, 0.3, 0.5})
    for (const double k : {20.0, 150.0, 900.0}) {
      const LayeredMedium rings{ring(radius, thickness, nu), ring(radius - thickness, 0.5 * thickness, 0.2)};
      LayeredMedium flat = rings;
      for (MediumLayer& layer : flat) layer.radius = INFINITY;
      const RingDepthResponse curved(rings, moduli, k, tractions);
      const DepthResponse straight(flat, moduli, k, 0, tractions);
      for (std::size_t layer = 0; layer < 2; ++layer)
        for (const double part : {0.0, 0.35, 1.0}) {
          const double depth = part * flat[layer].thickness;
          const DepthState a = curved.at(layer, depth), b = straight.at(layer, depth);
          check_same(a.stress, b.stress, 3e-5);
          CHECK(std::abs(a.u - b.u) < 3e-5 / k);
          CHECK(std::abs(a.w - b.w) < 3e-5 / k);
        }
    }
}

TEST_CASE("Short waves inside a ring are those of a disc in closed form", "[core][interior][ring]") {
  constexpr double radius = 0.05, k = 2000;
  for (const double nu : {0.2, 0.5}) {
    const LayeredMedium rings{ring(radius, 0.3 * radius, nu)};
    const RingDepthResponse response(rings, std::vector<complex>{{3.0, 1.0}}, k, tractions);
    for (const double depth : {0.0, 1e-4, 1e-3, 5e-3})
      check_same(response.at(0, depth).stress,
                 half_space_wave(k, FaceDepth::of(radius, depth), tractions.pressure, tractions.shear), 1e-10);
  }
}

TEST_CASE("A ring's inside loses what its face takes up", "[core][interior][ring]") {
  RollingScene scene;
  scene.radius = 0.05;
  scene.layer_thickness = INFINITY;
  scene.material = MaterialModel::elastic;
  scene.static_shear_modulus = 1e13;  // hard ground
  scene.load = 8000;
  scene.speed = 1.1;
  BondedLayer cover;
  cover.static_shear_modulus = 2e6;
  cover.stiffening = 1.5;
  cover.creep_time = 5e-3;
  cover.layer_thickness = 0.012;
  scene.coating_layers = {cover};
  const RollingSolution s = converged(scene);
  // What is lost between lines of the inside; a flat coating's inside is 8 % off.
  CHECK(interior_summary(scene, s.fields, InteriorField::Detail::inside).loss == Approx(s.viscous_loss).epsilon(1e-4));
}
