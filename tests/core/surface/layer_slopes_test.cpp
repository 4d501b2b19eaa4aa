#include "core/surface/layer_slopes.hpp"

#include <cmath>

#include "core/influence/elastic_kernel.hpp"
#include "core/numerics/quadrature.hpp"
#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("slopes of a layer are the derivatives of its displacements", "[core][layer_slopes]") {
  const double thickness = 0.004;
  for (const double r : {0.01, 0.7, 1.3, 4.0, 10.0, 25.0, 40.0})
    for (const double sign : {1.0, -1.0}) {
      const double x = sign * r * thickness, step = 1e-4 * thickness;
      const LayerSlopes slope = layer_slope_correction(x, thickness);
      const LayerSlopes difference =
          (layer_displacement_correction(x + step, thickness) - layer_displacement_correction(x - step, thickness)) /
          (2 * step);
      // Second order in the step, and rounding over the step.
      CAPTURE(x);
      CHECK((slope - difference).head<3>().abs().maxCoeff() < 1e-7 / thickness);
    }
}

TEST_CASE("displacements of a layer under a line force are those under a narrow cell", "[core][layer_slopes]") {
  const double thickness = 0.004, cell = 1e-3 * thickness;
  const ElasticKernel kernel(2, thickness, cell, 1);
  for (const double r : {0.1, 0.7, 2.0, 9.0, 28.0}) {
    const double x = r * thickness;
    const LayerSlopes smooth = layer_displacement_correction(x, thickness);
    const Coefficients whole = kernel(x, 0);
    // The cell's average differs by cell^2/24 of the second derivative; the cell's tables end at 30 H, at 2e-10.
    CHECK(smooth(0) - std::log(x) / (2 * M_PI) == Approx(whole(coefficient::ww)).margin(1e-6));
    CHECK(smooth(1) - std::log(x) / (2 * M_PI) == Approx(whole(coefficient::uu)).margin(1e-6));
    CHECK(smooth(2) == Approx(whole(coefficient::uw)).margin(1e-6));
  }
}

TEST_CASE("the mean of a layer's slopes over a memory is their integral", "[core][layer_slopes]") {
  const double thickness = 0.004;
  const QuadratureRule rule = gauss_legendre(16);
  for (const double length : {0.001 * thickness, 0.3 * thickness, 5 * thickness, 1e4 * thickness}) {
    const LayerMemory memory(thickness, length);
    for (const double r : {-20.0, -1.0, 0.0, 0.4, 8.0, 47.0}) {
      const double x = r * thickness;
      LayerSlopes sum = LayerSlopes::Zero();
      // Panels that widen, up to where the exponential ends.
      for (double start = 0, width = 0.2 * std::min(length, thickness); start < 45 * length;
           start += width, width *= 1.2)
        for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
          const double s = start + width * rule.nodes[q];
          sum += width * rule.weights[q] * std::exp(-s / length) / length * layer_slope_correction(x + s, thickness);
        }
      CAPTURE(length, r);
      CHECK((memory(x) - sum).head<3>().abs().maxCoeff() < 1e-10 * (1 + thickness / length) / thickness);
    }
  }
}
