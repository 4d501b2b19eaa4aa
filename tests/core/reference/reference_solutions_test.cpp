#include "core/reference/reference_solutions.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/catch.hpp"
#include "tests/core/elastic_layer_contact.hpp"

using namespace rollres;
using std::numbers::pi;

namespace {

constexpr double R = 0.08, P = 350.0, G = 0.9e6, H = 0.006;

/// int_0^end f dx by the midpoint rule
template <class Function>
double integral(Function f, double end, int intervals) {
  double sum = 0;
  for (int i = 0; i < intervals; ++i) sum += f(end * (i + 0.5) / intervals);
  return sum * end / intervals;
}

}  // namespace

TEST_CASE("Hertz's pressures carry the load and match Johnson's formulae", "[core][reference]") {
  const auto line = hertz_line(R, P, G);
  CHECK(pi * G * line.half_width * line.half_width == Approx(P * R).epsilon(1e-14));
  CHECK(2 * integral([&](double x) { return line.pressure(x); }, line.half_width, 20000) == Approx(P).epsilon(1e-6));
  CHECK(line.pressure(0) == line.peak_pressure);
  CHECK(line.pressure(1.01 * line.half_width) == 0);
  // Slope of an elliptic pressure: 2 p0/(E* a) x = x/R with E* = 4 G
  CHECK(line.peak_pressure / (2 * G * line.half_width) == Approx(1 / R).epsilon(1e-14));

  const auto sphere = hertz_sphere(R, P, G);
  const auto ring = [&](double r) { return 2 * pi * r * sphere.pressure(r); };
  CHECK(integral(ring, sphere.half_width, 20000) == Approx(P).epsilon(1e-6));
  CHECK(integral([&](double r) { return r * r * ring(r); }, sphere.half_width, 20000) / P ==
        Approx(sphere.mean_square_position()).epsilon(1e-6));
  CHECK(sphere.approach == Approx(pi * sphere.half_width * sphere.peak_pressure / (2 * 4 * G)).epsilon(1e-14));
  CHECK(sphere.approach == Approx(sphere.half_width * sphere.half_width / R).epsilon(1e-14));
}

TEST_CASE("the thin layer's pressures carry the load and obey the lubrication equation", "[core][reference]") {
  const auto line = thin_layer_line(R, H, P, G);
  const auto sphere = thin_layer_sphere(R, H, P, G);
  const double a = line.half_width, b = sphere.half_width;
  CHECK(2 * G * std::pow(a, 5) / (15 * R * H * H * H) == Approx(P).epsilon(1e-13));
  CHECK(pi * G * std::pow(b, 6) / (32 * R * H * H * H) == Approx(P).epsilon(1e-13));
  CHECK(line.peak_pressure == Approx(G * std::pow(a, 4) / (8 * R * H * H * H)).epsilon(1e-13));
  CHECK(2 * integral([&](double x) { return line.pressure(x); }, a, 4000) == Approx(P).epsilon(1e-6));
  CHECK(2 * integral([&](double x) { return x * x * line.pressure(x); }, a, 4000) / P ==
        Approx(line.mean_square_position).epsilon(1e-6));
  const auto ring = [&](double r) { return 2 * pi * r * sphere.pressure(r); };
  CHECK(integral(ring, b, 4000) == Approx(P).epsilon(1e-6));
  CHECK(integral([&](double r) { return r * r * ring(r); }, b, 4000) / P ==
        Approx(sphere.mean_square_position).epsilon(1e-6));
  for (const double s : {0.1, 0.45, 0.8}) {
    const double h = 1e-3;  // differences of a fourth-degree polynomial: error of order h^2
    const auto second = [&](const auto& contact, double x, double step) {
      return (contact.pressure(x + step) - 2 * contact.pressure(x) + contact.pressure(x - step)) / (step * step);
    };
    const double x = s * a, r = s * b, mobility = H * H * H / (3 * G);
    CHECK(-mobility * second(line, x, h * a) == Approx(line.approach - x * x / (2 * R)).margin(1e-5 * line.approach));
    const double slope = (sphere.pressure(r + h * b) - sphere.pressure(r - h * b)) / (2 * h * b);
    CHECK(-mobility * (second(sphere, r, h * b) + slope / r) ==
          Approx(sphere.approach - r * r / (2 * R)).margin(1e-5 * sphere.approach));
  }
}

TEST_CASE("the integral equations of contact on the elastic layer have the tabulated solutions", "[core][reference]") {
  for (const auto& row : elastic_layer_table) {
    CAPTURE(row.width_ratio);
    const bool thin = row.width_ratio > 5;
    const auto sphere = testing::layer_contact_sphere(row.width_ratio, thin ? 80 : 40);
    CHECK(sphere.load == Approx(row.sphere_load).epsilon(5e-6));  // the digits shown
    CHECK(1 / sphere.approach == Approx(row.sphere_flatness).epsilon(5e-6));
    if (thin) continue;  // wants 150 nodes and a second
    const auto cylinder = testing::layer_contact_line(row.width_ratio, 40);
    CHECK(cylinder.load / pi == Approx(row.cylinder_load).epsilon(5e-6));
    CHECK(cylinder.approach == Approx(row.cylinder_approach).epsilon(5e-6));
  }
}

TEST_CASE("the elastic layer's table agrees with dense solutions by another program", "[core][reference]") {
  struct Row {
    double sphere_load, sphere_flatness, cylinder_load, cylinder_approach;
  };
  constexpr std::array<Row, 7> rows{{{5.33761, 1.08018, 1.01022, 1.2738},
                                     {5.43854, 1.25871, 1.09106, 0.78789},
                                     {5.75417, 1.43627, 1.24748, 0.60903},
                                     {7.52267, 1.78758, 1.90330, 0.43831},
                                     {13.8566, 2.19827, 4.04782, 0.33225},
                                     {53.0469, 2.78455, 18.2833, 0.24707},
                                     {1195.77, 3.52642, 482.233, 0.18996}}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CAPTURE(elastic_layer_table[i].width_ratio);
    CHECK(elastic_layer_table[i].sphere_load == Approx(rows[i].sphere_load).epsilon(1e-5));
    CHECK(elastic_layer_table[i].sphere_flatness == Approx(rows[i].sphere_flatness).epsilon(1e-5));
    CHECK(elastic_layer_table[i].cylinder_load == Approx(rows[i].cylinder_load).epsilon(1e-5));
    CHECK(elastic_layer_table[i].cylinder_approach == Approx(rows[i].cylinder_approach).epsilon(1.5e-3));
  }
}

TEST_CASE("the elastic layer's table tends to Hertz and, slowly, to the thin layer", "[core][reference]") {
  const auto& thick = elastic_layer_table.front();
  const auto& thin = elastic_layer_table.back();
  CHECK(thick.sphere_load == Approx(16.0 / 3).epsilon(1e-3));
  CHECK(thick.cylinder_load == Approx(1).epsilon(0.011));
  const double cube = std::pow(thin.width_ratio, 3);
  CHECK(thin.sphere_load / (pi / 32 * cube) == Approx(1.52).epsilon(0.005));
  CHECK(pi * thin.cylinder_load / (2.0 / 15 * cube) == Approx(1.42).epsilon(0.005));
  // Both excesses are those of a contact wider by the same 1.45 H.
  CHECK(std::pow(thin.sphere_load / (pi / 32 * cube), 1.0 / 6) ==
        Approx(std::pow(pi * thin.cylinder_load / (2.0 / 15 * cube), 0.2)).epsilon(1e-3));
}

TEST_CASE("slow and fast losses follow the Zener modulus at both ends of the spectrum", "[core][reference]") {
  const double f = 4, tau = 0.02;
  const auto loss_over_storage = [&](double omega) {  // G* = G0 (1+f)(1+i w t)/((1+f)+i w t)
    const double w = omega * tau;
    return w * f / ((1 + f) + w * w);
  };
  CHECK(slow_loss_time(f, tau) == Approx(loss_over_storage(1e-4) / 1e-4).epsilon(1e-9));
  CHECK(fast_loss_time(f, tau) == Approx(1 / (loss_over_storage(1e9) * 1e9)).epsilon(1e-9));
  CHECK(slow_rolling_resistance(P, R, 0.3, slow_loss_time(f, tau)) == Approx(P * 0.3 * 0.016 / R).epsilon(1e-14));
  CHECK(std::isinf(fast_loss_time(0, tau)));
}

TEST_CASE("fast rolling loses the elastic work of the glassy contact once in the loss time", "[core][reference]") {
  const double V = 40, time = 0.01;
  const auto half_space = hertz_sphere(R, P, G);
  const auto line = thin_layer_line(R, H, P, G);
  const auto sphere = thin_layer_sphere(R, H, P, G);
  const double unit = P / (R * V * time);
  CHECK(fast_rolling_resistance(P, half_space.approach, half_space.mean_square_position(), R, V, time) ==
        Approx(0.8 * unit * half_space.half_width * half_space.half_width).epsilon(1e-13));
  CHECK(fast_rolling_resistance(P, line.approach, line.mean_square_position, R, V, time) ==
        Approx(2.0 / 21 * unit * line.half_width * line.half_width).epsilon(1e-13));
  CHECK(fast_rolling_resistance(P, sphere.approach, sphere.mean_square_position, R, V, time) ==
        Approx(0.125 * unit * sphere.half_width * sphere.half_width).epsilon(1e-13));
}

TEST_CASE("the coefficients of a small constant loss are Parseval sums over the elastic pressure",
          "[core][reference]") {
  const auto c = constant_loss_coefficients();
  // Dimensionless: a = R = 1. Transforms: Hertz pi p0 J1(k)/k and 2 pi p0 j1(k)/k; thin layer through J_5/2 and J_3.
  const double end = 1000;
  const int n = 20000;
  const auto J = [](double order, double k) { return std::cyl_bessel_j(order, k); };
  const auto square = [](double v) { return v * v; };
  {  // P = pi G, p0 = 2 G; (1/pi) int k |p|^2/(2 G k) dk over P; tails like k^-3 or k^-2
    const double sum = integral([&](double k) { return square(J(1, k) / k); }, end, n);
    CHECK(c.half_space_cylinder == Approx(pi * square(2.0) / (2 * pi) * sum).epsilon(1e-5));
  }
  {  // P = 16 G/3, p0 = 3 P/2 pi; int |kx| d2k = 4 int k^2 dk
    const auto j1 = [](double k) { return (std::sin(k) / k - std::cos(k)) / k; };
    const double p0 = 8 / pi;
    const double sum = integral([&](double k) { return square(2 * pi * p0 * j1(k) / k) * k; }, end, 10 * n);
    CHECK(c.half_space_sphere == Approx(4 / square(2 * pi) / 2 * sum / (16.0 / 3)).epsilon(1e-5));
  }
  {  // p = K (1-x^2)^2, K = G/8H^3, P = 16 K/15, C = k^2 H^3/3G
    const double sum = integral(
        [&](double k) { return k * k * k * square(2 * std::sqrt(pi) * std::pow(2 / k, 2.5) * J(2.5, k)); }, end, n);
    CHECK(c.thin_layer_cylinder == Approx(sum / pi / 3 / 8 * 15 / 16).epsilon(1e-5));
  }
  {  // K = 3 G/32 H^3, P = pi K/3
    const double sum = integral([&](double k) { return square(k * k * 16 * pi * J(3, k) / (k * k * k)); }, end, n);
    CHECK(c.thin_layer_sphere == Approx(4 / square(2 * pi) / 3 * sum * 3 / 32 * 3 / pi).epsilon(1e-5));
  }
}

TEST_CASE("Carter's cylinder: CONTACT's example has 0.024 % creepage at 64 % of the friction", "[core][reference]") {
  // G 82 GPa, nu 0.28: an incompressible half-space of the same plane-strain modulus 2 G/(1 - nu) halved for two
  // bodies; only a = 1 mm, R = 500 mm, mu = 0.3 and a'/a = 0.6 enter the creepage.
  const double modulus = 82e9 / (1 - 0.28) / 4, radius = 0.5, a = 1e-3;
  const double load = pi * modulus * a * a / radius, torque = 0.64 * 0.3 * load * radius;
  const auto line = carter_line(radius, load, modulus, 0.3, torque);
  CHECK(line.half_width == Approx(a).epsilon(1e-13));
  CHECK(line.stick_half_width == Approx(0.6 * a).epsilon(1e-13));
  CHECK(line.creepage == Approx(0.00024).epsilon(1e-12));
}

TEST_CASE("Carter's cylinder agrees with CONTACT at 60 % of the friction", "[core][reference]") {
  // 600 N/mm, R = 50 mm, E* = 952.5 MPa, spacing 0.16 mm: 80 elements in contact, 51 stick, creepage 0.01378.
  const double load = 600e3;
  const auto line = carter_line(0.05, load, 952.5e6 / 4, 0.3, 0.6 * 0.3 * load * 0.05);
  CHECK(std::abs(2 * line.half_width / 0.16e-3 - 80) < 1);
  CHECK(std::abs(2 * line.stick_half_width / 0.16e-3 - 51) < 1.5);  // an element at either end
  CHECK(line.creepage == Approx(0.01378).epsilon(0.015));           // the stick zone is one element in 51 wider
}

TEST_CASE("Carter's traction is the driving force, stays within friction and lets the stick zone stick",
          "[core][reference]") {
  const double mu = 0.4, torque = -0.7 * mu * P * R;  // braked
  const auto hertz = hertz_line(R, P, G);
  const auto line = carter_line(R, P, G, mu, torque);
  const double a = line.half_width, b = line.stick_half_width;
  const auto shear = [&](double x) { return line.shear(x); };
  const double force = integral([&](double s) { return shear(s - a); }, 2 * a, 20000);
  CHECK(force == Approx(-torque / R).epsilon(1e-6));
  CHECK(line.creepage < 0);
  CHECK(line.rolling_resistance == Approx(torque / R * line.creepage).epsilon(1e-14));
  CHECK(line.rolling_resistance > 0);
  constexpr int n = 4000;
  for (const int place : {100, 900, 2000, 3300}) {
    const double x = a * std::cos(pi * (place + 0.5) / n);
    CHECK(std::abs(shear(x)) <= mu * hertz.pressure(x) * (1 + 1e-12));
    // du/dx = -(1/2 pi G) PV int tau/(x - x') dx'; slip over V = du/dx - creepage, along the traction where it slips
    double sum = 0;
    for (int k = 1; k < n; ++k) {
      const double angle = pi * k / n, other = a * std::cos(angle);
      sum += shear(other) / (x - other) * a * std::sin(angle) * pi / n;
    }
    const double slip = -sum / (2 * pi * G) - line.creepage;
    if (x > a - 2 * b) {
      CHECK(std::abs(slip) < 1e-2 * std::abs(line.creepage));  // kinks of the traction at the quadrature's order
    } else {
      CHECK(slip * shear(x) > 0);
      CHECK(std::abs(shear(x)) == Approx(mu * hertz.pressure(x)).epsilon(1e-12));
    }
  }
}

TEST_CASE("Carter's creepage for a small force is linear, without loss of digits", "[core][reference]") {
  const double torque = 1e-9 * P * R;
  const auto line = carter_line(R, P, G, 0.5, torque);
  CHECK(line.creepage == Approx(torque / (R * P) * line.half_width / (2 * R)).epsilon(1e-8));
  CHECK(carter_line(R, P, G, 0.5, 0).creepage == 0);
}

TEST_CASE("Kalker's coefficients are the published ones", "[core][reference]") {
  CHECK(kalker_circle(0.5).c11 == 5.20);
  CHECK(kalker_circle(0.5).c22 == 3.98);
  CHECK(kalker_circle(0.5).c23 == 1.63);
  CHECK(kalker_circle(0.25).c11 == 4.12);
  CHECK(kalker_circle(0.25).c22 == 3.67);
  CHECK(kalker_circle(0.25).c23 == 1.47);
  CHECK(kalker_force(2e-3, 1e6, 1e-4) == Approx(2e6 * 4e-6 * 5.20 * 1e-4).epsilon(1e-14));
  CHECK_THROWS_WITH(kalker_circle(0.3), Catch::StartsWith("poisson_ratio"));
}

TEST_CASE("the reference solutions refuse arguments outside their range and name them", "[core][reference]") {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  CHECK_THROWS_WITH(hertz_line(0, P, G), Catch::StartsWith("radius"));
  CHECK_THROWS_WITH(hertz_sphere(R, nan, G), Catch::StartsWith("load"));
  CHECK_THROWS_WITH(thin_layer_line(R, inf, P, G), Catch::StartsWith("layer_thickness"));
  CHECK_THROWS_WITH(thin_layer_sphere(R, H, P, -G), Catch::StartsWith("shear_modulus"));
  CHECK_THROWS_WITH(carter_line(R, P, G, 0, 0), Catch::StartsWith("friction_coefficient"));
  CHECK_THROWS_WITH(carter_line(R, P, G, 0.1, 0.1 * P * R), Catch::StartsWith("torque"));
  CHECK_THROWS_WITH(fast_loss_time(1, 0), Catch::StartsWith("creep_time"));
  CHECK_THROWS_WITH(slow_rolling_resistance(P, R, 0, 1), Catch::StartsWith("speed"));
}
