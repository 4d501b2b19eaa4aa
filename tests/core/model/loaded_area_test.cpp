#include <cmath>
#include <random>

#include "core/model/loaded_area.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

constexpr double half_length = 0.03, half_width = 0.05;

/// Pressure over its mean, as the header has it.
double pressure(const LoadedArea& area, double x, double y) {
  const double u = x / half_length, v = y / half_width;
  if (area.shape == PressureShape::rectangle) {
    if (std::abs(u) > 1 || std::abs(v) > 1) return 0;
    return area.distribution == PressureDistribution::uniform ? 1 : 4 / M_PI * std::sqrt(1 - u * u);
  }
  const double left = 1 - u * u - v * v;
  if (left < 0) return 0;
  return area.distribution == PressureDistribution::uniform ? 1 : 1.5 * std::sqrt(left);
}

}  // namespace

TEST_CASE("parts of a given pressure are those that sums over many points give, and all parts are the load",
          "[core][given_pressure]") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-1.2, 1.2);
  for (const PressureShape shape : {PressureShape::ellipse, PressureShape::rectangle})
    for (const PressureDistribution distribution : {PressureDistribution::uniform, PressureDistribution::hertz}) {
      const LoadedArea area{shape, distribution, half_length, half_width, 0};
      CHECK(area.share(-1, 1, -1, 1) == Approx(1).epsilon(1e-14));
      CHECK(area.share(0, 1, 0, 1) == Approx(0.25).epsilon(1e-14));
      for (int i = 0; i < 10; ++i) {
        double x0 = half_length * place(random), x1 = half_length * place(random);
        double y0 = half_width * place(random), y1 = half_width * place(random);
        if (x0 > x1) std::swap(x0, x1);
        if (y0 > y1) std::swap(y0, y1);
        constexpr int points = 400;
        double sum = 0;
        for (int column = 0; column < points; ++column)
          for (int row = 0; row < points; ++row)
            sum += pressure(area, x0 + (x1 - x0) * (column + 0.5) / points, y0 + (y1 - y0) * (row + 0.5) / points);
        sum *= (x1 - x0) * (y1 - y0) / (points * points * area.area());
        CHECK(area.share(x0, x1, y0, y1) == Approx(sum).margin(2e-3));
      }
      // The cell under the middle has the largest pressure.
      constexpr double cell = 1e-4;
      CHECK(area.share(-cell, cell, -cell, cell) * area.area() / (4 * cell * cell) ==
            Approx(area.peak_factor()).epsilon(1e-4));
    }
}
