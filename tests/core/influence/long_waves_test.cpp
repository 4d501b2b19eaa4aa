#include "core/influence/long_waves.hpp"

#include <cmath>
#include <complex>

#include "core/influence/influence.hpp"
#include "core/surface/layer_compliance.hpp"
#include "tests/catch.hpp"
#include "tests/core/converged.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

constexpr double thickness = 1e-3;

/// A layer that keeps its volume under a body of a large radius, with a memory of a millimetre or without any.
RollingScene thin_layer(Indenter indenter, bool remembers) {
  RollingScene scene = plain_scene();
  scene.indenter = indenter;
  scene.radius = 1;
  scene.layer_thickness = thickness;
  scene.poisson_ratio = 0.5;
  scene.static_shear_modulus = 1e6;
  scene.material = remembers ? MaterialModel::zener : MaterialModel::elastic;
  scene.stiffening = remembers ? 1 : 0;
  scene.creep_time = remembers ? 0.02 : 0;
  scene.speed = 0.05;
  scene.friction_coefficient = 0;
  scene.drive = Drive::top_force;
  scene.inertia = Inertia::off;
  scene.load.reset();
  scene.approach = 1e-4;
  scene.tolerance.reset();
  scene.method = Method::newton;
  return scene;
}

/// Displacement of the nodes under a wave along the motion, or across it, over its pressure [m/Pa].
std::complex<double> met(const InfluenceTable& table, double wave, double cell, double area, bool across) {
  std::complex<double> sum = 0;
  for (int row = 0; row <= table.reach_y(); ++row)
    for (int column = -table.reach_x(); column <= table.reach_x(); ++column) {
      const double images = row > 0 ? 2 : 1, value = table.ww[static_cast<std::size_t>(table.index(column, row))];
      const std::complex<double> phase = across ? std::cos(wave * cell * row) : std::polar(1.0, -wave * cell * column);
      sum += images * value * area * phase;
    }
  return sum;
}

/// Of the layer as it is [m/Pa]: 1/(2 k G) (sinh 2q - 2q)/(cosh 2q + 1 + 2 q^2), q = k H.
std::complex<double> closed(const RollingScene& scene, double wave, bool across) {
  const double q = wave * thickness;
  const std::complex<double> iw(0, across ? 0 : -wave * scene.speed * scene.creep_time);
  // At -kV, the frequency at which a material passes under a wave that stands in the body's frame.
  const double f = scene.stiffening;
  const std::complex<double> modulus = *scene.static_shear_modulus * (1.0 + f * iw / (1.0 + f + iw));
  return (std::sinh(2 * q) - 2 * q) / (std::cosh(2 * q) + 1 + 2 * q * q) / (2 * wave * modulus);
}

}  // namespace

TEST_CASE("long waves meet a thin layer on coarse cells as they meet it anywhere", "[core][influence]") {
  // Without the correction they miss 2 % with cells of the thickness, 12 % with twice that, and with memories half of
  // it.
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere})
    for (const bool remembers : {false, true})
      for (const double cells_of : {1.0, 2.0, 5.0}) {
        const RollingScene scene = thin_layer(indenter, remembers);
        const bool sphere = indenter == Indenter::sphere;
        const double cell = cells_of * thickness, wave = 0.1 / cell;
        SurfaceGrid grid;
        grid.spacing_x = cell;
        grid.spacing_y = sphere ? cell : 1;
        grid.columns = remembers ? 120 : 25;  // what the memory leaves has to fade
        grid.rows = sphere ? grid.columns : 1;
        const InfluenceTable table = influence_table(ContactModel(scene), grid);
        CAPTURE(sphere, remembers, cells_of);
        const std::complex<double> wanted = closed(scene, wave, false);
        const std::complex<double> found = met(table, wave, cell, grid.cell_area(), false);
        CAPTURE(found / wanted, table.steps);
        CHECK(std::abs(found - wanted) < (remembers ? 2e-2 : 4e-3) * std::abs(wanted));
        CHECK(table.steps > 0.01);
        // Those across go on along the motion: of an elastic layer that is all the same.
        if (sphere && !remembers)
          CHECK(std::abs(met(table, wave, cell, grid.cell_area(), true) - wanted) < 4e-3 * std::abs(wanted));
      }
}

TEST_CASE("grids that resolve the thickness keep their coefficients", "[core][influence]") {
  for (const double poisson_ratio : {0.5, 0.3})
    for (const double depth : {3e-4, 3e-3, 1.0, double(INFINITY)}) {
      RollingScene scene = thin_layer(Indenter::sphere, true);
      scene.poisson_ratio = poisson_ratio;
      scene.layer_thickness = depth;
      SurfaceGrid grid;
      grid.spacing_x = grid.spacing_y = 1e-4;
      grid.columns = grid.rows = 20;
      const LongWaveCorrection correction(SteadySurface({depth, poisson_ratio}, {1e-6, {{1e-6, 0.02}}}, 0.05), grid);
      InfluenceTable table(20, 20);
      correction.add_to(table);
      CAPTURE(poisson_ratio, depth);
      CHECK(table.ww == InfluenceTable(20, 20).ww);
    }
}

TEST_CASE("a body on a thin layer bears its load on cells as long as the layer is thick", "[core][influence]") {
  // A grid that resolves the thickness is the witness.
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    RollingScene scene = thin_layer(indenter, false);
    const auto load = [&](double cells_of) {
      scene.spacing = cells_of * thickness;
      return converged(scene).load;
    };
    const double fine = load(indenter == Indenter::sphere ? 0.33 : 0.1);
    CAPTURE(indenter);
    CHECK(load(1) == Approx(fine).epsilon(5e-3));    // 3 % without the correction
    CHECK(load(2) == Approx(fine).epsilon(1.5e-2));  // 11 %
  }
}
