#include "core/spectral/passage_slopes.hpp"

#include <cmath>

#include "core/model/contact_surface.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

/// Largest difference of slopes, displacements and memories, relative to their values near the force.
double largest_difference(const PassageSlopes& passage, double thickness, const std::vector<double>& lengths) {
  double worst = 0;
  for (const double r : {-47.0, -20.0, -4.0, -0.3, 0.0, 0.5, 1.7, 9.0, 40.0, 70.0}) {
    const double x = r * thickness;
    if (x != 0)
      worst = std::max(
          worst, (passage.displacement(x) - layer_displacement_correction(x, thickness)).head<3>().abs().maxCoeff());
    worst = std::max(worst,
                     thickness * (passage.slope(x) - layer_slope_correction(x, thickness)).head<3>().abs().maxCoeff());
    for (std::size_t m = 0; m < lengths.size(); ++m)
      if (r > -layer_reach)
        worst = std::max(
            worst,
            thickness * (passage.memory(m, x) - LayerMemory(thickness, lengths[m])(x)).head<3>().abs().maxCoeff());
  }
  return worst;
}

}  // namespace

TEST_CASE("a single incompressible layer forgets as its material does: its slopes are elastic at any speed",
          "[core][passage_slopes]") {
  RollingScene scene = plain_scene();
  for (const double speed : {1e-4, 0.1, 30.0}) {
    scene.speed = speed;
    CAPTURE(speed);
    const CreepSpectrum deep = near_spectrum(scene);
    CHECK(largest_difference(PassageSlopes(steady_surface(scene), deep, nearest_interface(scene), true),
                             scene.layer_thickness, {speed * deep.terms[0].time}) < 1e-12);
  }
}

TEST_CASE("a face between two layers of one material is no face", "[core][passage_slopes]") {
  RollingScene scene = plain_scene();
  const double thickness = scene.layer_thickness;
  BondedLayer rest;
  static_cast<MaterialInputs&>(rest) = scene;
  rest.layer_thickness = 0.7 * thickness;
  scene.layer_thickness = 0.3 * thickness;
  scene.lower_layers = {rest};
  const CreepSpectrum deep = near_spectrum(scene);
  const PassageSlopes passage(steady_surface(scene), deep, nearest_interface(scene), true);
  CHECK(passage.depth() == 0.3 * thickness);
  CHECK(largest_difference(passage, thickness, {scene.speed * deep.terms[0].time}) < 1e-12);
}

TEST_CASE("what a buried layer remembers is behind the force only", "[core][passage_slopes]") {
  RollingScene scene = plain_scene();
  BondedLayer lower;
  static_cast<MaterialInputs&>(lower) = scene;
  lower.layer_thickness = 0.01;
  scene.material = MaterialModel::elastic;
  scene.lower_layers = {lower};
  const PassageSlopes passage(steady_surface(scene), near_spectrum(scene), nearest_interface(scene), true);
  // Far ahead the surface is at rest; the half-space's slope -1/(2 pi x) is taken back.
  const double x = 0.6;
  CHECK(passage.slope(x)(0) == Approx(1 / (2 * M_PI * x)).epsilon(1e-9));
  CHECK(passage.displacement(x)(0) == Approx(std::log(x) / (2 * M_PI)).epsilon(1e-9));
  // Behind it the indentation recovers as the buried layer does, over V tau: long beside the layers.
  const auto dent = [&](double distance) { return passage.slope(-distance)(0) + 1 / (2 * M_PI * distance); };
  CHECK(dent(0.3) * dent(0.4) > 0);
  const double length = 0.1 / std::log(std::abs(dent(0.3) / dent(0.4)));
  CHECK(length == Approx(scene.speed * scene.creep_time).epsilon(0.05));
}
