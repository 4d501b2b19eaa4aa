#include "core/reference/reference_rollers.hpp"

#include <cmath>
#include <numbers>

#include "core/reference/reference_solutions.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

// Bentall and Johnson's rollers as in CONTACT's example: kappa = 0.2877.
constexpr double roller_radius = 0.025, roller_load = 16201.9, roller_modulus = 15059.0866e6, roller_ratio = 0.41600128;
constexpr double draw = (1 - 2 * roller_ratio) / (2 * roller_modulus);               // K/G
constexpr double spread = (1 - roller_ratio) / (std::numbers::pi * roller_modulus);  // (1 - nu)/(pi G)

/// PV int f(s)/(x - s) ds over (-a, a), the singularity subtracted; s = a tanh y resolves the ends.
template <class Function>
double principal_value(Function f, double a, double x) {
  constexpr int points = 20001;
  constexpr double reach = 20, step = 2 * reach / points;
  const double here = f(x);
  double sum = here * std::log((a + x) / (a - x));
  for (int i = 0; i < points; ++i) {
    const double y = -reach + (i + 0.5) * step, s = a * std::tanh(y), share = 1 / std::cosh(y);
    if (std::abs(x - s) > 1e-9 * a) sum += (f(s) - here) / (x - s) * a * share * share * step;
  }
  return sum;
}

}  // namespace

TEST_CASE("a roller without slip obeys the equations of the half-space, carries its load and no force",
          "[core][reference]") {
  const NoSlipLine line = no_slip_line(roller_radius, roller_load, roller_modulus, roller_ratio);
  const auto p = [&](double x) { return line.pressure(x); };
  const auto q = [&](double x) { return line.shear(x); };
  CHECK(line.creepage == Approx(3.6727e-4).epsilon(0.00005 / 3.6727));  // five digits
  for (const double place : {-0.9, -0.5, 0.1, 0.77}) {
    const double x = place * line.half_width;
    INFO("x/a = " << place);
    CHECK(-draw * p(x) - spread * principal_value(q, line.half_width, x) == Approx(-line.creepage).epsilon(1e-8));
    CHECK(draw * q(x) - spread * principal_value(p, line.half_width, x) == Approx(-x / roller_radius).epsilon(1e-8));
  }
  double force = 0, load = 0;
  constexpr int points = 20000;
  for (int i = 0; i < points; ++i) {
    const double angle = std::numbers::pi * (i + 0.5) / points, x = line.half_width * std::cos(angle);
    const double weight = line.half_width * std::sin(angle) * std::numbers::pi / points;
    load += p(x) * weight;
    force += q(x) * weight;
  }
  CHECK(load == Approx(roller_load).epsilon(1e-8));
  CHECK(std::abs(force) < 1e-10 * roller_load);
}

TEST_CASE("a roller in full slip creeps and loses what Hertz's pressure draws in", "[core][reference]") {
  const double mu = 1e-4;
  const FullSlipLine line = full_slip_line(roller_radius, roller_load, roller_modulus, roller_ratio, mu);
  // Only (1 - nu)/G enters Hertz's contact: 1/(2 G) where incompressible.
  const HertzLine hertz = hertz_line(roller_radius, roller_load, roller_modulus / (2 * (1 - roller_ratio)));
  CHECK(line.half_width == Approx(hertz.half_width).epsilon(1e-14));
  constexpr int points = 100000;
  const double step = 2 * hertz.half_width / points;
  double force = 0, loss = 0;
  int misplaced = 0;
  for (int i = 0; i < points; ++i) {
    const double x = -hertz.half_width + (i + 0.5) * step, p = hertz.pressure(x);
    const double slip = line.creepage - draw * p;
    force += (slip > 0 ? p : -p) * step;
    loss += mu * p * std::abs(slip) * step;
    misplaced += (slip > 0) != (std::abs(x) > line.reversal);
  }
  CHECK(misplaced == 0);
  CHECK(std::abs(force) < 1e-4 * roller_load);  // one point of the rule where the slip turns
  CHECK(line.rolling_resistance == Approx(loss).epsilon(1e-6));
  const double kappa = 0.2876675;
  CHECK(line.creepage == Approx(0.457386 * kappa * hertz.half_width / roller_radius).epsilon(2e-6));
  CHECK(line.rolling_resistance ==
        Approx(0.123922 * mu * roller_load * kappa * hertz.half_width / (2 * roller_radius)).epsilon(4e-6));
}

TEST_CASE("an incompressible roller does not creep, and rollers outside their range are refused by name",
          "[core][reference]") {
  const NoSlipLine line = no_slip_line(roller_radius, roller_load, roller_modulus, 0.5);
  const HertzLine hertz = hertz_line(roller_radius, roller_load, roller_modulus);
  CHECK(line.creepage == 0);
  CHECK(line.half_width == Approx(hertz.half_width).epsilon(1e-14));
  CHECK(line.mid_pressure == Approx(hertz.peak_pressure).epsilon(1e-14));
  CHECK_THROWS_WITH(no_slip_line(1, 1, 1, 0.6), Catch::StartsWith("poisson_ratio"));
  CHECK_THROWS_WITH(full_slip_line(1, 1, 1, 0.5, 0.1), Catch::StartsWith("poisson_ratio"));
  CHECK_THROWS_WITH(full_slip_line(1, 1, 1, 0.3, 0), Catch::StartsWith("friction_coefficient"));
}
