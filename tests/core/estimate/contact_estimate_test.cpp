#include "core/estimate/contact_estimate.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/reference/reference_solutions.hpp"
#include "tests/catch.hpp"
#include "tests/core/elastic_layer_contact.hpp"
#include "tests/infinite.hpp"

using namespace rollres;
using std::numbers::pi;

namespace {

constexpr double R = 0.1, G = 0.8e6;

}  // namespace

TEST_CASE("the estimate reproduces the tabulated contacts on an elastic bonded layer", "[core][contact_estimate]") {
  const double H = 0.004;
  for (const ElasticLayerRow& row : elastic_layer_table) {
    CAPTURE(row.width_ratio);
    const double a = row.width_ratio * H;
    const auto sphere = elastic_contact_from_load(3, R, H, G, row.sphere_load * G * a * a * a / R);
    CHECK(sphere.half_width == Approx(a).epsilon(1e-10));
    CHECK(sphere.approach == Approx(a * a / (R * row.sphere_flatness)).epsilon(1e-10));
    const auto cylinder = elastic_contact_from_load(2, R, H, G, row.cylinder_load * pi * G * a * a / R);
    CHECK(cylinder.half_width == Approx(a).epsilon(1e-10));
    CHECK(cylinder.approach == Approx(row.cylinder_approach * a * a / R).epsilon(1e-10));
  }
}

TEST_CASE("between and beyond tabulated points the estimate is within one per cent", "[core][contact_estimate]") {
  for (const double alpha : {0.02, 0.17, 0.7, 3.2, 7.0}) {
    CAPTURE(alpha);
    const auto line = testing::layer_contact_line(alpha, 40);
    const auto cylinder = elastic_contact_from_load(2, 1, 1 / alpha, 1, line.load);
    CHECK(cylinder.half_width == Approx(1).epsilon(0.01));
    CHECK(cylinder.approach == Approx(line.approach).epsilon(0.01));
  }
  for (const double alpha : {0.02, 0.17, 0.7, 3.2, 7.0, 11.0, 30.0}) {
    CAPTURE(alpha);
    const auto point = testing::layer_contact_sphere(alpha, alpha < 6 ? 24 : alpha < 20 ? 60 : 100);
    const auto sphere = elastic_contact_from_load(3, 1, 1 / alpha, 1, point.load);
    CHECK(sphere.half_width == Approx(1).epsilon(0.01));
    CHECK(sphere.approach == Approx(point.approach).epsilon(0.01));
  }
}

TEST_CASE("load and approach give the same estimated contact", "[core][contact_estimate]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    double previous_width = 0, previous_approach = 0;
    for (double load = 1e-9; load < 1e12; load *= 1.7) {
      CAPTURE(static_cast<int>(indenter), load);
      const auto from_load = elastic_contact_from_load(dimension_of(indenter), R, 0.01, G, load);
      const auto from_approach = elastic_contact_from_approach(dimension_of(indenter), R, 0.01, G, from_load.approach);
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
    const auto sphere = elastic_contact_from_load(3, R, thickness, G, P);
    CHECK(sphere.half_width == Approx(sphere_radius).epsilon(1e-6));
    CHECK(sphere.approach == Approx(sphere_radius * sphere_radius / R).epsilon(1e-5));
    const auto inverse = elastic_contact_from_approach(3, R, thickness, G, sphere.approach);
    CHECK(inverse.load == Approx(P).epsilon(1e-9));
    const auto cylinder = elastic_contact_from_load(2, R, thickness, G, P);
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
  const auto contact = elastic_contact_from_load(2, R, 0.5, G, P);
  CHECK(contact.approach * R / (a * a) == Approx(expected).epsilon(0.01));  // the accuracy promised
}

TEST_CASE("on a thin layer the estimate approaches the lubrication limit", "[core][contact_estimate]") {
  const double H = 1e-3, alpha = 1e5, a = alpha * H;  // corrections of order 1.5 H/a, raised to the sixth power at most
  const double sphere_load = pi * G * std::pow(a, 6) / (32 * R * H * H * H);
  const auto sphere = elastic_contact_from_load(3, R, H, G, sphere_load);
  CHECK(sphere.half_width == Approx(a).epsilon(1e-4));
  CHECK(sphere.approach == Approx(a * a / (4 * R)).epsilon(2e-4));
  const double line_load = 2 * G * std::pow(a, 5) / (15 * R * H * H * H);
  const auto cylinder = elastic_contact_from_load(2, R, H, G, line_load);
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
  CHECK(message([] { elastic_contact_from_load(3, -1, 1, 1, 1); }).rfind("radius", 0) == 0);
  CHECK(message([] { elastic_contact_from_load(3, 1, 0, 1, 1); }).rfind("layer_thickness", 0) == 0);
  CHECK(message([] { elastic_contact_from_load(3, 1, 1, infinite, 1); }).rfind("shear_modulus", 0) == 0);
  CHECK(message([] { elastic_contact_from_load(3, 1, 1, 1, std::nan("")); }).rfind("load", 0) == 0);
  CHECK(message([] { elastic_contact_from_approach(2, 1, infinite, 1, 1); }).rfind("approach", 0) == 0);
}
