#include "core/numerics/bracketed_root.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("a bracketed root is found to the last bits, however the function bends", "[core][bracketed_root]") {
  CHECK(bracketed_root([](double x) { return x * x - 2; }, 0, 2) == Approx(std::sqrt(2.0)).epsilon(1e-15));
  CHECK(bracketed_root([](double x) { return 2 - x * x; }, 0, 2) == Approx(std::sqrt(2.0)).epsilon(1e-15));
  CHECK(bracketed_root([](double x) { return std::exp(x) - 5; }, -500, 500) == Approx(std::log(5.0)).epsilon(1e-14));
  CHECK(bracketed_root([](double x) { return std::pow(x, 21) - 1e-21; }, 0, 10) == Approx(0.1).epsilon(1e-13));
  CHECK(bracketed_root([](double x) { return x < 0.3 ? -1.0 : 1.0; }, 0, 1) == Approx(0.3).epsilon(1e-14));
  CHECK(bracketed_root([](double x) { return x - 3; }, 3, 7) == 3);
  CHECK(bracketed_root([](double x) { return x - 7; }, 3, 7) == 7);
}

TEST_CASE("a smooth root takes few evaluations", "[core][bracketed_root]") {
  int evaluations = 0;
  bracketed_root([&](double x) { return ++evaluations, x * x * x + x - 5; }, 0, 3);
  CHECK(evaluations < 20);
}

TEST_CASE("an end where the function is tiny is not taken for the root", "[core][bracketed_root]") {
  for (double tiny = 1e-8; tiny > 1e-300; tiny *= 1e-8) {
    CAPTURE(tiny);
    const auto function = [&](double x) { return (1 - x) * (x - 0.3) + tiny * x; };
    CHECK(bracketed_root(function, 0, 1) == Approx(0.3).epsilon(3e-8));
    CHECK(bracketed_root([&](double x) { return -function(-x); }, -1, 0) == Approx(-0.3).epsilon(3e-8));
  }
}
