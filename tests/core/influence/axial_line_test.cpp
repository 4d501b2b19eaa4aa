#include "core/influence/axial_line.hpp"

#include <cmath>

#include "core/numerics/quadrature.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// A line force along the axle moves a layer of unit modulus by ln coth(pi |x|/4H)/pi, the transform of tanh(kH)/k;
/// means over the cell, finely summed but for the logarithm.
double mean_over_cell(double x, double cell, double thickness) {
  constexpr int parts = 400;
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double s = std::abs(x + cell * ((i + 0.5) / parts - 0.5));
    sum += std::log(s / (thickness * std::tanh(0.25 * M_PI * s / thickness))) / parts;
  }
  const auto integral = [](double t) { return t == 0 ? 0 : t * std::log(std::abs(t)) - t; };
  const double logarithm = (integral(x + 0.5 * cell) - integral(x - 0.5 * cell)) / cell;
  return (sum - (logarithm - std::log(thickness))) / M_PI;
}

RollingScene scene_of(double thickness, double stiffening, double memory) {
  RollingScene scene;
  scene.radius = 0.1;
  scene.layer_thickness = thickness;
  scene.static_shear_modulus = 2e6;
  scene.material = stiffening > 0 ? MaterialModel::zener : MaterialModel::elastic;
  scene.stiffening = stiffening;
  scene.speed = 0.5;
  scene.creep_time = memory / scene.speed;
  scene.load = 1000;
  scene.friction_coefficient = 0.3;
  scene.inertia = Inertia::off;
  scene.drive = Drive::free;
  scene.skew_angle = 1e-6;
  return scene;
}

}  // namespace

TEST_CASE("shear along the axle moves a layer as the closed form says, with any memory", "[core][axial_line]") {
  const double thickness = 5e-3, cell = 4e-4;
  constexpr int reach = 30;
  SurfaceGrid grid;
  grid.spacing_x = cell;
  grid.spacing_y = 1;
  grid.columns = reach;
  grid.rows = 1;
  for (const double memory : {0.0, 1e-4, 3e-3, 0.1}) {
    CAPTURE(memory);
    const double stiffening = memory > 0 ? 1.5 : 0, modulus = 2e6;
    const ContactModel model(scene_of(thickness, stiffening, memory));
    const std::vector<double> found = axial_coefficients(model, grid, reach);
    REQUIRE(found.size() == 2 * reach + 1);
    // The layer at rest yields by 1/G0, at once by 1/(G0 (1 + f)).
    const double at_once = 1 / (modulus * (1 + stiffening)), later = 1 / modulus - at_once;
    for (int column = -reach; column <= reach; column += 5) {
      const double x = column * cell;
      double expected = at_once * mean_over_cell(x, cell, thickness);
      if (memory > 0) {
        const QuadratureRule gauss = gauss_legendre(60);
        // Panels end where the loaded cell does.
        std::vector<double> borders{0, 0.2 * memory, memory, 4 * memory, 12 * memory, 36 * memory};
        for (const double edge : {-x - 0.5 * cell, -x, -x + 0.5 * cell})
          if (edge > 0 && edge < 36 * memory) borders.push_back(edge);
        std::sort(borders.begin(), borders.end());
        for (std::size_t i = 1; i < borders.size(); ++i)
          for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
            const double width = borders[i] - borders[i - 1], s = borders[i - 1] + width * gauss.nodes[q];
            expected += later * width * gauss.weights[q] * std::exp(-s / memory) / memory *
                        mean_over_cell(x + s, cell, thickness);
          }
      }
      CAPTURE(column);
      CHECK(found[static_cast<std::size_t>(column + reach)] == Approx(expected).epsilon(1e-5).margin(1e-9 / modulus));
    }
  }
}
