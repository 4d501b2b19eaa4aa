#include "core/scene/friction_law.hpp"

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("friction is the projection of traction and slip on Coulomb's disc", "[core][friction_law]") {
  const FrictionLaw law{0.3};
  const FrictionProjection inside = law.project(-2, 0.3, -0.4);  // in tension as under pressure
  CHECK_FALSE(inside.slips());
  CHECK(inside.x() == 0.3);
  CHECK(inside.y() == -0.4);
  const FrictionProjection outside = law.project(2, 3, -4);
  CHECK(outside.slips());
  CHECK(outside.excess() == Approx(5 - 0.6));
  CHECK(outside.x() == Approx(0.6 * 0.6));
  CHECK(outside.y() == Approx(-0.6 * 0.8));
}

TEST_CASE("the linearised law of slip is the derivative of the projection", "[core][friction_law]") {
  const FrictionLaw law{0.3};
  const double pressure = 2, q_x = 0.8, q_y = 0.5, step = 1e-6;
  const FrictionProjection at = law.project(pressure, q_x, q_y);
  const double changes[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // of p, q_x, q_y
  for (const auto& [p, x, y] : changes) {
    const FrictionProjection ahead = law.project(pressure + step * p, q_x + step * x, q_y + step * y);
    const FrictionProjection behind = law.project(pressure - step * p, q_x - step * x, q_y - step * y);
    const auto [row_x, row_y] =
        slip_row(law.slope(pressure), at.direction_x(), at.direction_y(), at.beta(), p, 0.0, 0.0, x, y);
    // Central differences: their error is of the order of step^2.
    CHECK(-row_x == Approx((ahead.x() - behind.x()) / (2 * step)).margin(1e-9));
    CHECK(-row_y == Approx((ahead.y() - behind.y()) / (2 * step)).margin(1e-9));
  }
}

TEST_CASE("a state that breaks no law of friction violates nothing, another by what it breaks",
          "[core][friction_law]") {
  const auto violation = [](Zone zone, double shear_x, double shear_y, double slip_x, double slip_y) {
    return friction_violation(zone, 5, shear_x, shear_y, slip_x, slip_y, 1, 1);
  };
  CHECK(violation(Zone::stick, 3, 3.9, 0, 0).shear < 0);
  CHECK(violation(Zone::stick, 3, 3.9, 0, 0).slip == 0);
  CHECK(violation(Zone::slip, 3, 4, 0.3, 0.4).shear == Approx(0).margin(1e-15));
  CHECK(violation(Zone::slip, 3, 4, 0.3, 0.4).slip == Approx(0).margin(1e-14));
  CHECK(violation(Zone::stick, 6, 0, 0, 0).shear == Approx(1));
  CHECK(violation(Zone::stick, 3, 0, 0.3, 0.4).slip == Approx(0.5));
  CHECK(violation(Zone::slip, 3, 0, 1, 0).shear == Approx(2));
  CHECK(violation(Zone::slip, 3, 4, -3, -4).slip == Approx(10));  // friction against the slip
}
