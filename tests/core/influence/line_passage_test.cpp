#include "core/influence/line_passage.hpp"

#include <algorithm>
#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// A soft layer that forgets within a few of its thicknesses on a harder one.
RollingScene two_layers() {
  RollingScene scene;
  scene.radius = 0.05;
  scene.layer_thickness = 0.003;
  scene.static_shear_modulus = 1e6;
  scene.stiffening = 2;
  scene.creep_time = 0.004;
  scene.speed = 1;
  scene.load = 1000;
  scene.friction_coefficient = 0.3;
  BondedLayer below;
  static_cast<MaterialInputs&>(below) = scene;
  below.static_shear_modulus = 4e6;
  below.creep_time = 0.001;
  below.layer_thickness = 0.002;
  scene.lower_layers = {below};
  return scene;
}

SurfaceGrid line(double spacing, int columns) {
  SurfaceGrid grid;
  grid.spacing_x = spacing;
  grid.spacing_y = 1;
  grid.columns = columns;
  grid.rows = 1;
  return grid;
}

}  // namespace

TEST_CASE("a single passage over two layers under a cylinder is a train of bodies far apart", "[core][line_passage]") {
  const SurfaceGrid grid = line(0.5e-3, 30);
  for (const bool inertia : {false, true}) {
    RollingScene scene = two_layers();
    if (inertia) scene.inertia = Inertia::on;
    const InfluenceTable passage = line_passage_table(scene, grid, grid.columns);
    constexpr int columns = 801, aliases = 60;
    scene.period = columns * grid.spacing_x;  // 80 thicknesses: the rigid base has ended all by then
    // Aliases alternate in sign and fall with their square, so the mean of two sums errs by the cube.
    scene.series_terms = aliases * columns + (columns - 1) / 2;
    const InfluenceTable last = influence_table(scene, grid);
    scene.series_terms -= columns;
    const InfluenceTable before = influence_table(scene, grid);
    for (const auto component : {&InfluenceTable::ww, &InfluenceTable::uu, &InfluenceTable::uw}) {
      double largest = 0, difference = 0;
      for (std::size_t i = 0; i < (passage.*component).size(); ++i) {
        const double train = 0.5 * ((last.*component)[i] + (before.*component)[i]);
        largest = std::max(largest, std::abs(train));
        difference = std::max(difference, std::abs((passage.*component)[i] - train));
      }
      INFO("inertia " << inertia);
      CHECK(difference < 1e-6 * largest);
    }
  }
}
