#include "core/heat/heat_path.hpp"

#include <numbers>

#include "tests/core/heat/warm_wheel.hpp"

// Covers warmed_layers, too.

using namespace rollres;
using std::numbers::pi;

TEST_CASE("heat passes a ring by the logarithm of its radii and a belt by its thickness", "[core][heat]") {
  const RollingScene wheel = warm_wheel();
  const HeatPath ring = heat_path(wheel, 0.01);
  CHECK(ring.thickness == Approx(0.012));
  CHECK(ring.turn == Approx(2 * pi * 0.05));
  CHECK(ring.resistance(0.012) == Approx(std::log(50 / 38.0) / (2 * pi * 0.19)));
  CHECK(ring.air.conductance == Approx(20 * 2 * pi * 0.05));
  CHECK(ring.core.conductance == 0);

  RollingScene belt = plain_scene();
  belt.heat = Heat::on;
  belt.thermal_conductivity = 0.2;
  belt.turn_length = 40;
  belt.surface_heat_transfer = 15;
  belt.ambient_temperature = 293;
  belt.core_heat_transfer = 10;
  const HeatPath slab = heat_path(belt, 0.01);
  CHECK(slab.resistance(0.01) == Approx(0.01 / (0.2 * 40)));
  CHECK(slab.core.conductance == Approx(10 * 40));
  CHECK(slab.core.temperature == 293);
}

TEST_CASE("a core takes heat by its area, at a temperature, or none", "[core][heat]") {
  RollingScene wheel = warm_wheel();
  wheel.core_heat_transfer = 50;
  CHECK(heat_path(wheel, 0.01).core.conductance == Approx(50 * 2 * pi * 0.038));
  CHECK(heat_path(wheel, 0.01).core.temperature == 293.15);
  wheel.core_temperature = 310;
  CHECK(heat_path(wheel, 0.01).core.temperature == 310);
  wheel.core_heat_transfer.reset();
  CHECK(std::isinf(heat_path(wheel, 0.01).core.conductance));
}

// As two half-spaces that are brought together for the time of the contact, once a turn.
TEST_CASE("the ground cools by the effusivities in series, the root of the contact's time and once a turn",
          "[core][heat]") {
  RollingScene wheel = warm_wheel();
  wheel.ground_effusivity = 1500;
  const double contact = 0.007, own = std::sqrt(0.19 * 2.16e6), both = 1 / (1 / own + 1 / 1500.0);
  const double contact_time = contact / 1.5, turn_time = 2 * pi * 0.05 / 1.5;
  const HeatPath path = heat_path(wheel, contact);
  CHECK(path.ground.conductance / path.turn == Approx(2 * both * std::sqrt(contact_time / pi) / turn_time));
  CHECK(path.ground.temperature == 293.15);
  wheel.ground_temperature = 280;
  CHECK(heat_path(wheel, contact).ground.temperature == 280);
}

TEST_CASE("Peclet's, Fourier's and Biot's numbers are those of thickness, diffusivity and turn", "[core][heat]") {
  RollingScene wheel = warm_wheel();
  const HeatNumbers numbers = heat_numbers(wheel, heat_path(wheel, 0.01));
  const double diffusivity = 0.19 / 2.16e6;
  CHECK(numbers.warming_time == Approx(0.012 * 0.012 / diffusivity));
  CHECK(numbers.peclet == Approx(1.5 * 0.012 * 0.012 / (diffusivity * 0.05)));
  CHECK(numbers.fourier == Approx(diffusivity * 2 * pi * 0.05 / 1.5 / (0.012 * 0.012)));
  CHECK(numbers.biot == Approx(20 * 0.012 / 0.19));
  wheel.heat_capacity.reset();
  CHECK(std::isnan(heat_numbers(wheel, heat_path(wheel, 0.01)).peclet));
}
