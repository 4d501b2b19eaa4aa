#include "core/model/roller_body.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

std::array<double, 3> axle_of(double skew, double camber) {
  return {-std::sin(skew) * std::cos(camber), std::cos(skew) * std::cos(camber), std::sin(camber)};
}

}  // namespace

TEST_CASE("a crown's surface lies at its radius from the axle", "[core][roller_body]") {
  constexpr double radius = 0.02, transverse = 0.07;
  for (const Crown crown : {Crown::circle, Crown::ellipse})
    for (const double camber : {0.0, 0.1, -0.5}) {
      const std::array<double, 3> axle = axle_of(0.2, camber);
      const RollerBody body({radius, transverse, crown}, axle);
      for (const auto& [x, y] : {std::pair{1e-3, 2e-3}, std::pair{-4e-3, 1e-3}, std::pair{0.0, -6e-3}}) {
        const double h = body.depth(x, y), along = axle[0] * x + axle[1] * y - axle[2] * h;
        const double away = std::sqrt(x * x + y * y + h * h - along * along);
        const double rho = crown == Crown::circle
                               ? radius - transverse + std::sqrt(transverse * transverse - along * along)
                               : radius * std::sqrt(1 - along * along / (radius * transverse));
        CHECK(away == Approx(rho).epsilon(1e-12));
      }
    }
}

TEST_CASE("a crown's lowest point and slopes are those of its depth", "[core][roller_body]") {
  constexpr double step = 1e-6;
  for (const Crown crown : {Crown::circle, Crown::ellipse})
    for (const double transverse : {0.012, 0.07}) {
      const RollerBody body({0.02, transverse, crown}, axle_of(-0.3, 0.25));
      const RollerBody::Place& lowest = body.lowest();
      CHECK(body.depth(lowest.x, lowest.y) == Approx(lowest.depth).epsilon(1e-13));
      CHECK(std::abs(body.profile(lowest.x, lowest.y)) < 1e-15);
      const double x = lowest.x + 1e-3, y = lowest.y - 2e-3;
      CHECK(body.profile(x, y) > 0);
      const auto [b_x, b_y] = body.slopes(x, y);
      CHECK(b_x == Approx(-(body.depth(x + step, y) - body.depth(x - step, y)) / (2 * step)).epsilon(1e-7));
      CHECK(b_y == Approx(-(body.depth(x, y + step) - body.depth(x, y - step)) / (2 * step)).epsilon(1e-7));
    }
}

TEST_CASE("without camber a crown's height has no cancellation", "[core][roller_body]") {
  for (const Crown crown : {Crown::circle, Crown::ellipse}) {
    const RollerBody body({0.02, 0.07, crown}, axle_of(0, 0));
    CHECK(body.profile(1e-9, 0) == Approx(0.5e-18 / 0.02).epsilon(1e-9));
    CHECK(body.profile(0, 1e-9) == Approx(0.5e-18 / 0.07).epsilon(1e-9));
    CHECK_FALSE(body.covers(0.03, 0));
    CHECK(body.covers(0.01, 0.01));
  }
}

TEST_CASE("a profile that follows a crown is that crown under skew and camber", "[core][roller_body]") {
  constexpr double radius = 0.02, transverse = 0.07, reach = 0.03;
  std::vector<double> places, heights;
  for (int i = -300; i <= 300; ++i) {
    const double y = reach * i / 300;
    places.push_back(y);
    heights.push_back(y * y / (transverse + std::sqrt(transverse * transverse - y * y)));
  }
  const std::array<double, 3> axle = axle_of(0.2, -0.1);
  const RollerBody wanted({radius, transverse, Crown::circle}, axle), found({radius, places, heights}, axle);
  CHECK(found.lowest().depth == Approx(wanted.lowest().depth).epsilon(1e-8));
  CHECK(found.lowest().y == Approx(wanted.lowest().y).epsilon(1e-4));
  for (const auto& [x, y] : {std::pair{1e-3, 2e-3}, std::pair{-4e-3, 1e-3}, std::pair{0.0, 9e-3}}) {
    CHECK(found.depth(x, y) == Approx(wanted.depth(x, y)).epsilon(1e-7));
    CHECK(found.slopes(x, y)[0] == Approx(wanted.slopes(x, y)[0]).margin(1e-5));
    CHECK(found.slopes(x, y)[1] == Approx(wanted.slopes(x, y)[1]).margin(1e-4));
  }
  CHECK_FALSE(found.covers(0, 1.2 * reach));
}
