#include "core/numerics/quadrature.hpp"

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("what a layer adds is transformed to all digits at every distance of a panel", "[core][wavenumber_rule]") {
  // int_0^inf e^{-2k} cos(k r) dk = 2/(4 + r^2), and with k e^{-2k} its derivative (4 - r^2)/(4 + r^2)^2.
  const std::vector<double> borders = distance_panels(100);
  CHECK(borders.front() == 0);
  CHECK(borders.back() >= 100);
  for (std::size_t panel = 0; panel + 1 < borders.size(); ++panel) {
    const WavenumberRule rule(0.1, 18, borders[panel], borders[panel + 1]);
    for (const double share : {0.0, 0.4, 1.0}) {
      const double r = borders[panel] + share * (borders[panel + 1] - borders[panel]), square = 4 + r * r;
      double flat = 0, rising = 0;
      for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
        const double k = rule.nodes[q], wave = rule.weights[q] * std::exp(-2 * k) * std::cos(k * r);
        flat += wave;
        rising += k * wave;
      }
      INFO("distance " << r);
      CHECK(flat == Approx(2 / square).margin(1e-13));
      CHECK(rising == Approx((4 - r * r) / (square * square)).margin(1e-13));
    }
  }
}
