#include "core/reference/reference_hunter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "core/numerics/bracketed_root.hpp"
#include "core/reference/reference_solutions.hpp"
#include "tests/catch.hpp"

using namespace rollres;
using std::numbers::pi;

namespace {

constexpr double R = 0.05, P = 2e4, G0 = 1.3e6, V = 0.7;

double rubbery_half_width() { return hertz_line(R, P, G0).half_width; }

/// Cylinder for which V tau over the rubbery half-width is `ratio`.
HunterLine at_ratio(double ratio, double stiffening) {
  return hunter_line(R, P, G0, stiffening, ratio * rubbery_half_width() / V, V);
}

/// R_r R / (P a0)
double scaled_resistance(double ratio, double stiffening) {
  return at_ratio(ratio, stiffening).rolling_resistance * R / (P * rubbery_half_width());
}

struct Moments {
  double load, moment;  // int p dx, int p x dx
};

/// Trapezoidal rule in the angle: converges fast for a pressure with square-root ends.
Moments moments(const HunterLine& line) {
  constexpr int intervals = 2000;
  Moments sum{0, 0};
  for (int k = 1; k < intervals; ++k) {
    const double angle = pi * k / intervals, x = line.centre + line.half_width * std::cos(angle);
    const double force = line.pressure(x) * std::sin(angle) * line.half_width * pi / intervals;
    sum.load += force;
    sum.moment += force * x;
  }
  return sum;
}

}  // namespace

TEST_CASE("Hunter's rolling resistance has the values of the closed form to six digits", "[core][reference]") {
  constexpr std::array<std::pair<double, double>, 6> rows{
      {{0.1, 0.046258}, {0.3, 0.116896}, {1, 0.196843}, {3, 0.151414}, {10, 0.075388}, {100, 0.013294}}};
  for (const auto& [ratio, value] : rows) {
    CAPTURE(ratio);
    CHECK(std::abs(scaled_resistance(ratio, 1) - value) <= 0.5e-6);  // all digits printed
  }
}

TEST_CASE("Hunter's rolling resistance peaks where the half-width and the creep length are alike",
          "[core][reference]") {
  struct Peak {
    double stiffening;
    double scanned_ratio, scanned_value;  // the largest of a scan over T/a0, both rounded to the digits shown
    double ratio, value;                  // the maximum itself
  };
  for (const Peak& peak : {Peak{1, 1.10, 0.1973, 1.0870, 0.19729}, Peak{9, 1.37, 0.4829, 1.3497, 0.48302},
                           Peak{99, 1.63, 0.6016, 1.6432, 0.60157}}) {
    CAPTURE(peak.stiffening);
    double nearest = 1;  // distance of the scanned value from the curve within the rounding of its place
    for (double offset = -0.005; offset <= 0.005; offset += 1e-4)
      nearest = std::min(
          nearest, std::abs(scaled_resistance(peak.scanned_ratio + offset, peak.stiffening) - peak.scanned_value));
    CHECK(nearest <= 0.5e-4);

    const auto slope = [&](double ratio) {
      return scaled_resistance(ratio * 1.0001, peak.stiffening) - scaled_resistance(ratio / 1.0001, peak.stiffening);
    };
    const double ratio = bracketed_root(slope, 0.5, 4);
    CHECK(std::abs(ratio - peak.ratio) <= 1e-4);
    CHECK(std::abs(scaled_resistance(ratio, peak.stiffening) - peak.value) <= 1e-5);
    CHECK(peak.value >= peak.scanned_value - 0.5e-4);
  }
}

TEST_CASE("Hunter's pressure bends the viscoelastic surface to the cylinder's shape", "[core][reference]") {
  // Slope of the surface of a Zener half-space passed by p, compliance [1 + f/(1 + i omega tau)]/[(1 + f) G0]:
  // int p(x') [1/(x - x') + f E(x - x')] dx' = 2 pi G0 (1 + f) x/R, E(u) = -(1/T) exp(u/T) Ei(-u/T).
  constexpr int nodes = 4000;
  for (const auto& [stiffening, ratio] : {std::pair{1.0, 0.3}, {1.0, 3.0}, {9.0, 1.0}, {99.0, 10.0}}) {
    CAPTURE(stiffening, ratio);
    const auto line = at_ratio(ratio, stiffening);
    for (const int place :
         {600, 1700, 2000, 2900, 3800}) {  // midway between nodes: the principal value comes by itself
      const double x = line.centre + line.half_width * std::cos(pi * (place + 0.5) / nodes), T = line.creep_length;
      double sum = 0;
      for (int k = 1; k < nodes; ++k) {
        const double angle = pi * k / nodes, other = line.centre + line.half_width * std::cos(angle), u = x - other;
        const double kernel = 1 / u - stiffening / T * std::exp(u / T) * std::expint(-u / T);
        sum += line.pressure(other) * kernel * std::sin(angle) * line.half_width * pi / nodes;
      }
      const double scale = 2 * pi * G0 * (1 + stiffening) * line.half_width / R;
      CHECK(std::abs(sum / scale - x / line.half_width) < 2e-3);  // f p l ln2 pi/(T nodes): the logarithm at u = 0
    }
  }
}

TEST_CASE("Hunter's peak pressure agrees with CONTACT on viscoelastic cylinders", "[core][reference]") {
  // After Wang and Knothe (1993): E0* = 952.5 MPa, f = 1, R = 50 mm, 600 N/mm, 1 m/s. CONTACT's grid has 80 elements.
  constexpr std::array<std::pair<double, double>, 4> rows{{{0, 60.32}, {0.009, 78.74}, {0.045, 84.72}, {2.0, 85.31}}};
  for (const auto& [creep_time, pressure] : rows) {
    CAPTURE(creep_time);
    const auto line = hunter_line(0.05, 600e3, 952.5e6 / 4, 1, creep_time, 1);
    CHECK(line.peak_pressure == Approx(pressure * 1e6).epsilon(1e-3));  // the element's width over l, squared: 6e-4
  }
}

TEST_CASE("Hunter's pressure carries the load and its moment is the rolling resistance", "[core][reference]") {
  for (const double stiffening : {0.0, 0.3, 9.0, 99.0}) {
    for (const double ratio : {0.02, 0.3, 1.0, 10.0, 1e3, 1e4}) {
      CAPTURE(stiffening, ratio);
      const auto line = at_ratio(ratio, stiffening);
      const double width = rubbery_half_width();
      const auto [load, moment] = moments(line);
      CHECK(load == Approx(P).epsilon(1e-6));
      CHECK(std::abs(moment / R - line.rolling_resistance) <= 1e-6 * P * width / R);
      CHECK(std::abs(line.pressure(line.trailing_edge() + 1e-9 * width)) <= 1e-3 * line.peak_pressure);
    }
  }
}

TEST_CASE("without stiffening or creep Hunter's cylinder is Hertz's", "[core][reference]") {
  const auto hertz = hertz_line(R, P, G0);
  for (const auto& line : {hunter_line(R, P, G0, 0, 0.1, V), hunter_line(R, P, G0, 3, 0, V)}) {
    CHECK(line.half_width == Approx(hertz.half_width).epsilon(1e-13));
    CHECK(line.centre == 0);
    CHECK(line.rolling_resistance == 0);
    CHECK(line.peak_pressure == Approx(hertz.peak_pressure).epsilon(1e-12));
    CHECK(line.pressure(0.4 * hertz.half_width) == Approx(hertz.pressure(0.4 * hertz.half_width)).epsilon(1e-12));
  }
}

TEST_CASE("slow and fast, Hunter's cylinder meets the rubbery and the glassy limit", "[core][reference]") {
  for (const double stiffening : {0.5, 9.0, 99.0}) {
    CAPTURE(stiffening);
    const double tau = 1e-6 * rubbery_half_width() / V;
    const auto slow = hunter_line(R, P, G0, stiffening, tau, V);
    // next order: T/a0
    CHECK(slow.rolling_resistance ==
          Approx(slow_rolling_resistance(P, R, V, slow_loss_time(stiffening, tau))).epsilon(1e-5));
    CHECK(slow.peak_pressure == Approx(hertz_line(R, P, G0).peak_pressure).epsilon(1e-5));

    const auto fast = at_ratio(1e6, stiffening);
    const auto glassy = hertz_line(R, P, G0 * (1 + stiffening));
    // Small arguments of the Bessel functions in Hunter's formulae; next order: (1+f) l/T, times a logarithm.
    const double l = glassy.half_width, T = fast.creep_length;
    const double expected = P / R * stiffening * l * l / T * ((std::log(2 * T / l) - std::numbers::egamma) / 2 + 0.125);
    CHECK(fast.half_width == Approx(l).epsilon(1e-3));
    CHECK(fast.rolling_resistance == Approx(expected).epsilon(1e-3));
    CHECK(fast.peak_pressure == Approx(glassy.peak_pressure).epsilon(1e-3));
  }
}

TEST_CASE("Hunter's solution stays finite and smooth over ten decades of speed", "[core][reference]") {
  for (const double stiffening : {1.0, 99.0}) {
    double previous_peak = hertz_line(R, P, G0).peak_pressure, previous_slope = 1;
    const double step = 1.1;
    double previous = std::log(scaled_resistance(1e-5 / step, stiffening));
    for (double ratio = 1e-5; ratio < 1e5; ratio *= step) {
      CAPTURE(stiffening, ratio);
      const auto line = at_ratio(ratio, stiffening);
      const double value = std::log(line.rolling_resistance * R / (P * rubbery_half_width()));
      const double slope = (value - previous) / std::log(step);  // from 1 (slow) to -1 (fast), never a jump
      CHECK(std::abs(slope - previous_slope) < 0.1);
      CHECK(slope > -1.0);
      CHECK(slope < 1.0 + 1e-6);
      CHECK(std::abs(std::log(line.peak_pressure / previous_peak)) < 0.1);
      CHECK(line.peak_pressure <= hertz_line(R, P, G0 * (1 + stiffening)).peak_pressure * 1.01);  // skew adds 0.5 %
      previous = value;
      previous_slope = slope;
      previous_peak = line.peak_pressure;
    }
  }
}

TEST_CASE("a stiffening layer meets Hunter's cylinder with a spike at the leading edge", "[core][reference]") {
  // T_r is far below the half-width, so the spike is thin; p between l - c T_r and l over a fine, uniform search.
  const auto line = at_ratio(0.05, 99);
  double highest = 0, place = 0;
  for (double distance = 0; distance < 20; distance += 1e-3) {
    const double x = line.leading_edge() - distance * line.relaxation_length, p = line.pressure(x);
    if (p > highest) highest = p, place = distance;
  }
  CHECK(place < 5);
  CHECK(line.peak_pressure == Approx(highest).epsilon(1e-6));
  CHECK(highest > 1.1 * line.pressure(line.centre));
}

TEST_CASE("Hunter's solution refuses arguments outside their range", "[core][reference]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(hunter_line(0, P, G0, 1, 1, V), Catch::StartsWith("radius"));
  CHECK_THROWS_WITH(hunter_line(R, nan, G0, 1, 1, V), Catch::StartsWith("load"));
  CHECK_THROWS_WITH(hunter_line(R, P, G0, -0.1, 1, V), Catch::StartsWith("stiffening"));
  CHECK_THROWS_WITH(hunter_line(R, P, G0, 1, -1, V), Catch::StartsWith("creep_time"));
  CHECK_THROWS_WITH(hunter_line(R, P, G0, 1, 1, 0), Catch::StartsWith("speed"));
}
