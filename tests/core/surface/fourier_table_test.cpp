#include "core/surface/fourier_table.hpp"

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("a Fourier table has the functions of known transforms, on either side and at any distance",
          "[core][fourier_table]") {
  // Re int_0^inf e^{-2k} e^{ikx} dk = 2/(4 + x^2), with i in front -x/(4 + x^2), with k (4 - x^2)/(4 + x^2)^2.
  const auto components = GENERATE(3, 4);
  const FourierTable table(2, components, 0.01, [=](double k, std::span<std::complex<double>> values) {
    const double f = std::exp(-2 * k);
    const std::complex<double> i(0, 1);
    const std::array<std::complex<double>, 8> all{f, i * f, k * f, 3.0 * f, -f, 2.0 * f, i * k * f, -3.0 * f};
    for (int function = 0; function < 2; ++function)
      std::copy_n(all.begin() + 4 * function, components, values.begin() + components * function);
  });
  for (const double x : {0.0, 0.7, -0.7, 1.2, -4.0, 17.0, -31.0, 70.0, 100.0, 150.0, -250.0, 420.0, -1000.0}) {
    const double square = 4 + x * x, even = 2 / square, odd = -x / square;
    const LayerSlopes first = table(0, x), second = table(1, x);
    // Over thin layers what is far away is a difference of nearly 0: no digit may be lost there.
    constexpr double margin = 1e-14;
    INFO("x = " << x);
    CHECK(first[layer_slope::normal] == Approx(even).margin(margin));
    CHECK(first[layer_slope::tangential] == Approx(odd).margin(margin));
    CHECK(first[layer_slope::cross] == Approx((4 - x * x) / (square * square)).margin(margin));
    CHECK(second[layer_slope::normal] == Approx(-even).margin(margin));
    CHECK(second[layer_slope::tangential] == Approx(2 * even).margin(margin));
    CHECK(second[layer_slope::cross] == Approx(-4 * x / (square * square)).margin(margin));
    const double hoop = components == 4 ? 3 * even : 0;
    CHECK(first[layer_slope::hoop] == Approx(hoop).margin(margin));
    CHECK(second[layer_slope::hoop] == Approx(-hoop).margin(margin));
  }
}
