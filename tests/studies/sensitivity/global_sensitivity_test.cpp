#include "studies/sensitivity/global_sensitivity.hpp"

#include <cmath>
#include <numbers>

#include "tests/catch.hpp"

// Covers morris_effects and sobol_indices, too.

using namespace rollres;

namespace {

constexpr double pi = std::numbers::pi;

/// Ishigami and Homma (1990) with a = 7, b = 0.1.
double ishigami(std::span<const double> place) {
  const double x = pi * (2 * place[0] - 1), y = pi * (2 * place[1] - 1), z = pi * (2 * place[2] - 1);
  return std::sin(x) + 7 * std::sin(y) * std::sin(y) + 0.1 * z * z * z * z * std::sin(x);
}

}  // namespace

TEST_CASE("the indices of Sobol' of the Ishigami function are the known ones", "[studies][sensitivity]") {
  const double pi4 = std::pow(pi, 4), pi8 = pi4 * pi4;
  const double first = 0.5 * std::pow(1 + 0.1 * pi4 / 5, 2), second = 49.0 / 8,
               joint = 0.01 * pi8 * (1.0 / 18 - 1.0 / 50);
  const double variance = first + second + joint;
  const SobolIndices found = sobol_indices(ishigami, 3, 4096);
  CHECK(found.evaluations == 4096 * 5);
  CHECK(found.mean == Approx(3.5).epsilon(0.01));
  CHECK(found.variance == Approx(variance).epsilon(0.02));
  const double firsts[] = {first / variance, second / variance, 0};
  const double totals[] = {(first + joint) / variance, second / variance, joint / variance};
  for (std::size_t i = 0; i < 3; ++i) {
    CAPTURE(i);
    CHECK(std::abs(found.first[i].value - firsts[i]) < 0.01);  // quasi-random: far below the bootstrap's error
    CHECK(std::abs(found.total[i].value - totals[i]) < 0.01);
    CHECK(std::abs(found.first[i].value - firsts[i]) < found.first[i].error + 1e-3);
    CHECK(std::abs(found.total[i].value - totals[i]) < found.total[i].error + 1e-3);
    CHECK(found.total[i].error < 0.06);
  }
  const SobolIndices again = sobol_indices(ishigami, 3, 4096, 0, 2);
  CHECK(again.first[1].value == found.first[1].value);
  CHECK(again.first[1].error == found.first[1].error);
}

TEST_CASE("rows with a point that has no value are left out of the indices and counted", "[studies][sensitivity]") {
  const auto torn = [](std::span<const double> place) {
    return place[0] > 0.9 ? std::nan("") : place[0] + 2 * place[1];
  };
  const SobolIndices found = sobol_indices(torn, 2, 512);
  CHECK(found.failed_rows > 0);
  CHECK(found.rows + found.failed_rows == 512);
  const double x = 0.81 / 12, y = 4.0 / 12;
  CHECK(found.total[0].value == Approx(x / (x + y)).margin(0.02));
  CHECK_THROWS_AS(sobol_indices([](auto) { return std::nan(""); }, 2, 64), std::invalid_argument);
  CHECK(sobol_indices([](auto) { return 1.0; }, 2, 64).total[0].value == 0);
}

TEST_CASE("elementary effects of a plane are its slopes, without deviation", "[studies][sensitivity]") {
  const auto plane = [](std::span<const double> place) { return 3 * place[0] - 2 * place[1]; };
  const MorrisEffects found = morris_effects(plane, 3, 10, 7);
  CHECK(found.evaluations == 40);
  const double slopes[] = {3, -2, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(found.inputs[i].mean == Approx(slopes[i]).margin(1e-12));
    CHECK(found.inputs[i].mean_size == Approx(std::abs(slopes[i])).margin(1e-12));
    CHECK(found.inputs[i].deviation == Approx(0).margin(1e-12));
    CHECK(found.inputs[i].effects == 10);
  }
}

TEST_CASE("elementary effects show what bends and what interacts", "[studies][sensitivity]") {
  const MorrisEffects found = morris_effects(ishigami, 3, 200, 1);
  CHECK(found.inputs[2].mean_size > 0);
  CHECK(found.inputs[2].deviation > found.inputs[2].mean_size_error);
  const auto torn = [](std::span<const double> place) { return place[0] > 0.9 ? std::nan("") : place[0]; };
  const MorrisEffects part = morris_effects(torn, 1, 20, 1);
  CHECK(part.failed > 0);
  CHECK(part.inputs[0].effects < 20);
}
