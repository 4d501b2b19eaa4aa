#include "core/contact_estimate.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "tests/catch.hpp"

using namespace rollres;
using std::numbers::pi;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double R = 0.1, G = 0.8e6;

}  // namespace

TEST_CASE("the estimate reproduces tabulated contacts on an elastic bonded layer", "[core][contact_estimate]") {
  struct Row {
    double alpha, sphere_load, sphere_flatness, cylinder_load, cylinder_approach;
  };
  // Dense numerical solutions; the last column is known to 1e-3 only.
  constexpr std::array<Row, 7> rows{{{0.1, 5.33761, 1.08018, 1.01022, 1.2738},
                                     {0.3, 5.43854, 1.25871, 1.09106, 0.78789},
                                     {0.5, 5.75417, 1.43627, 1.24748, 0.60903},
                                     {1, 7.52267, 1.78758, 1.90330, 0.43831},
                                     {2, 13.8566, 2.19827, 4.04782, 0.33225},
                                     {5, 53.0469, 2.78455, 18.2833, 0.24707},
                                     {20, 1195.77, 3.52642, 482.233, 0.18996}}};
  const double H = 0.004;
  for (const Row& row : rows) {
    CAPTURE(row.alpha);
    const double a = row.alpha * H;
    const double sphere_load = row.sphere_load * G * a * a * a / R, sphere_approach = a * a / (R * row.sphere_flatness);
    const double line_load = row.cylinder_load * pi * G * a * a / R, line_approach = row.cylinder_approach * a * a / R;
    const auto sphere = elastic_contact_from_load(Indenter::sphere, R, H, G, sphere_load);
    CHECK(sphere.half_width == Approx(a).epsilon(1e-10));
    CHECK(sphere.approach == Approx(sphere_approach).epsilon(1e-10));
    const auto cylinder = elastic_contact_from_load(Indenter::cylinder, R, H, G, line_load);
    CHECK(cylinder.half_width == Approx(a).epsilon(1e-10));
    CHECK(cylinder.approach == Approx(line_approach).epsilon(1e-10));
  }
}

TEST_CASE("load and approach give the same estimated contact", "[core][contact_estimate]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    double previous_width = 0, previous_approach = 0;
    for (double load = 1e-9; load < 1e12; load *= 1.7) {
      CAPTURE(static_cast<int>(indenter), load);
      const auto from_load = elastic_contact_from_load(indenter, R, 0.01, G, load);
      const auto from_approach = elastic_contact_from_approach(indenter, R, 0.01, G, from_load.approach);
      CHECK(from_approach.half_width == Approx(from_load.half_width).epsilon(1e-9));
      CHECK(from_approach.load == Approx(load).epsilon(1e-8));
      CHECK(from_load.half_width > previous_width);
      CHECK(from_load.approach > previous_approach);
      previous_width = from_load.half_width;
      previous_approach = from_load.approach;
    }
  }
}

TEST_CASE("on a thick layer the estimate becomes Hertz's contact", "[core][contact_estimate]") {
  const double P = 3.0;
  const double sphere_radius = std::cbrt(3 * P * R / (16 * G)), half_width = std::sqrt(P * R / (pi * G));
  for (const double thickness : {1e3, 1e6, infinite}) {  // the layer's effect on d is of order a/H, below 1e-6
    const auto sphere = elastic_contact_from_load(Indenter::sphere, R, thickness, G, P);
    CHECK(sphere.half_width == Approx(sphere_radius).epsilon(1e-6));
    CHECK(sphere.approach == Approx(sphere_radius * sphere_radius / R).epsilon(1e-5));
    const auto inverse = elastic_contact_from_approach(Indenter::sphere, R, thickness, G, sphere.approach);
    CHECK(inverse.load == Approx(P).epsilon(1e-9));
    const auto cylinder = elastic_contact_from_load(Indenter::cylinder, R, thickness, G, P);
    CHECK(cylinder.half_width == Approx(half_width).epsilon(1e-6));
    CHECK(std::isnan(cylinder.approach) == std::isinf(thickness));
  }
}

TEST_CASE("on a thick layer the estimated approach of a cylinder grows with the logarithm of the thickness",
          "[core][contact_estimate]") {
  // Deflection under Hertz's pressure far from the base: d R / a^2 = (1/2) ln(2 H/a) + 1/4 + (C - gamma)/2 with
  // C = int_0^inf [S(h) - h^2/(1+h^2)] dh/h, S = (sinh 2h - 2h)/(cosh 2h + 1 + 2 h^2); midpoint rule in ln h.
  double C = 0;
  const double step = 0.01;
  for (double s = -14 + step / 2; s < 14; s += step) {
    const double h = std::exp(s), e = std::exp(-2 * h);
    const double S =
        h < 1e-3 ? 2 * h * h * h / 3 : ((1 - e * e) / 2 - 2 * h * e) / ((1 + e * e) / 2 + (1 + 2 * h * h) * e);
    C += step * (S - h * h / (1 + h * h));
  }
  const double alpha = 1e-4, a = alpha * 0.5, P = pi * G * a * a / R;
  const double expected = std::log(2 / alpha) / 2 + 0.25 + (C - std::numbers::egamma) / 2;
  const auto contact = elastic_contact_from_load(Indenter::cylinder, R, 0.5, G, P);
  CHECK(contact.approach * R / (a * a) == Approx(expected).epsilon(0.01));  // the accuracy promised
}

TEST_CASE("on a thin layer the estimate approaches the lubrication limit", "[core][contact_estimate]") {
  const double H = 1e-3, alpha = 1e5, a = alpha * H;  // corrections of order 1.5 H/a, raised to the sixth power at most
  const double sphere_load = pi * G * std::pow(a, 6) / (32 * R * H * H * H);
  const auto sphere = elastic_contact_from_load(Indenter::sphere, R, H, G, sphere_load);
  CHECK(sphere.half_width == Approx(a).epsilon(1e-4));
  CHECK(sphere.approach == Approx(a * a / (4 * R)).epsilon(2e-4));
  const double line_load = 2 * G * std::pow(a, 5) / (15 * R * H * H * H);
  const auto cylinder = elastic_contact_from_load(Indenter::cylinder, R, H, G, line_load);
  CHECK(cylinder.half_width == Approx(a).epsilon(1e-4));
  CHECK(cylinder.approach == Approx(a * a / (6 * R)).epsilon(2e-4));
}

TEST_CASE("the estimate refuses what is not positive and says which", "[core][contact_estimate]") {
  const auto message = [](auto call) {
    try {
      call();
    } catch (const std::invalid_argument& refusal) {
      return std::string(refusal.what());
    }
    return std::string();
  };
  CHECK(message([] { elastic_contact_from_load(Indenter::sphere, -1, 1, 1, 1); }).rfind("radius", 0) == 0);
  CHECK(message([] { elastic_contact_from_load(Indenter::sphere, 1, 0, 1, 1); }).rfind("layer_thickness", 0) == 0);
  CHECK(message([] { elastic_contact_from_load(Indenter::sphere, 1, 1, infinite, 1); }).rfind("shear_modulus", 0) == 0);
  CHECK(message([] { elastic_contact_from_load(Indenter::sphere, 1, 1, 1, std::nan("")); }).rfind("load", 0) == 0);
  CHECK(message([] { elastic_contact_from_approach(Indenter::cylinder, 1, infinite, 1, 1); }).rfind("approach", 0) ==
        0);
}
