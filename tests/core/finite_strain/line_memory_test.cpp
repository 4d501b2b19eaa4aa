#include "core/finite_strain/line_memory.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("the memory of a quadratic is exact in cells of any length", "[core][finite]") {
  // r' T + r = S with S = 2 - s + 3 s^2, by s in cells of length 1: r = S - T S' + T^2 S" + (r_in - that at 0)
  // e^(-s/T).
  for (const double length : {1e-6, 0.03, 1.0, 1.9999, 2.0001, 30.0, 1e4}) {
    const double t = 1 / length, inflow = 0.7;
    const auto source = [](double s) { return 2 - s + 3 * s * s; };
    const auto steady = [&](double s) { return source(s) - t * (6 * s - 1) + 6 * t * t; };
    const auto mean = [&](double s) { return steady(s) + (inflow - steady(0)) * std::exp(-s / t); };
    // The closed form cancels digits where t is large: then by its series.
    const auto expected = [&](double s) { return length < 1e-3 ? inflow + (2 - inflow) * s * length : mean(s); };
    const CellMemory memory = cell_memory(length);
    const Eigen::Vector3d values(source(gauss_places[0]), source(gauss_places[1]), source(gauss_places[2]));
    INFO(length);
    const double close = length < 1e-3 ? 3 * length : 1e-10;  // terms the series leaves out; rounding times t^2
    for (int i = 0; i < 3; ++i)
      CHECK(std::abs(memory.decay(i) * inflow + memory.weight.row(i).dot(values) - expected(gauss_places[i])) < close);
    CHECK(std::abs(memory.through * inflow + memory.out.dot(values) - expected(1)) < close);
  }
}
