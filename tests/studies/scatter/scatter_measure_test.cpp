#include "studies/scatter/scatter_measure.hpp"

#include <cmath>
#include <numeric>

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

TEST_CASE("a measure of scatter is what its words say", "[studies][scatter][scatter_measure]") {
  std::vector<double> values(99);
  std::iota(values.begin(), values.end(), 1.0);
  const double deviation = std::sqrt(825.0);  // of 1 to n: n (n + 1) / 12
  CHECK(ScatterMeasure()(values) == Approx(50));
  CHECK(ScatterMeasure("mean")(values) == Approx(50));
  CHECK(ScatterMeasure("mean + 2 sd")(values) == Approx(50 + 2 * deviation));
  CHECK(ScatterMeasure("mean-1.5sigma")(values) == Approx(50 - 1.5 * deviation));
  CHECK(ScatterMeasure("sd")(values) == Approx(deviation));
  CHECK(ScatterMeasure("P50")(values) == Approx(50));
  CHECK(ScatterMeasure("P90")(values) == Approx(89.6).margin(0.05));  // 99 * 0.9 + 1 / 2
  CHECK(ScatterMeasure("mean + 2 sd")({3}) == 3);
}

TEST_CASE("other words for a measure of scatter are refused", "[studies][scatter][scatter_measure]") {
  for (const char* const wrong : {"", "median", "P0", "P100", "P", "mean + sd", "mean * 2 sd", "mean + 1.2.3 sd", "90"})
    CHECK(message_of([&] { ScatterMeasure measure(wrong); }) ==
          std::string(wrong) + ": must be \"mean\", \"mean + 2 sd\", \"mean - 2 sd\", \"sd\" or \"P90\"");
}
