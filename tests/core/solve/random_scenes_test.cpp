// Covers contact_laws, law_rows, krylov_operator too.
/// Random scenes over the ranges that a study may ask for: every one is answered, and both linear algebras agree.

#include <cmath>
#include <limits>
#include <random>

#include "core/estimate/contact_estimate.hpp"
#include "core/material/material.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// Uniform numbers that are the same on every machine (std::uniform_real_distribution is not).
class Dice {
 public:
  explicit Dice(unsigned seed) : generator_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  double log_between(double low, double high) { return low * std::pow(high / low, between(0, 1)); }

 private:
  std::mt19937_64 generator_;
};

/// Load under which an elastic layer of the modulus at this speed has a contact of this half-width.
double load_for(const RollingScene& scene, double half_width) {
  const double modulus = std::abs(complex_modulus(scene, scene.speed / half_width));
  double low = 1e-12 * modulus * half_width, high = 1e12 * modulus * half_width;
  for (int step = 0; step < 100; ++step) {
    const double middle = std::sqrt(low * high);
    const auto estimate =
        elastic_contact_from_load(dimension_of(scene.indenter), scene.radius, scene.layer_thickness, modulus, middle);
    (estimate.half_width < half_width ? low : high) = middle;
  }
  return low;
}

RollingScene random_scene(Indenter indenter, unsigned seed, double nodes_in_half) {
  Dice dice(seed);
  RollingScene scene;
  scene.indenter = indenter;
  scene.radius = dice.log_between(5e-3, 0.2);
  scene.layer_thickness = dice.log_between(1e-3, 0.2);
  if (dice.between(0, 1) < 0.05) scene.layer_thickness = std::numeric_limits<double>::infinity();
  scene.static_shear_modulus = dice.log_between(1e5, 1e8);
  scene.stiffening = dice.log_between(0.01, 100);
  scene.creep_time = dice.log_between(1e-5, 10);
  scene.speed = dice.log_between(1e-4, 30);
  scene.friction_coefficient = dice.between(0, 1) < 0.1 ? 0 : dice.log_between(0.005, 2);
  const double half_width = dice.log_between(scene.radius / 100, scene.radius / 3);
  scene.spacing = half_width / nodes_in_half;
  scene.load = load_for(scene, half_width);
  scene.drive = static_cast<Drive>(static_cast<int>(dice.between(0, 4)));
  const double share = dice.between(-0.95, 0.95);
  const double ratio = dice.between(0, 1) < 0.7 ? dice.between(0.9, 1.1) : dice.between(-1, 3);
  if (scene.drive == Drive::torque)
    scene.driving_torque = share * scene.friction_coefficient * *scene.load * scene.radius;
  if (scene.drive == Drive::rotation) scene.rotation_ratio = ratio;
  return scene;
}

/// Checks that a scene is answered, and that the answer balances. @returns whether it was refused
bool check_answer(const RollingScene& scene, const RollingSolution& s) {
  if (s.status == Status::no_steady_state) {
    // A refusal must be one: friction too small by a coefficient that is stated.
    CHECK(scene.friction_coefficient > 0);
    CHECK(scene.drive != Drive::rotation);
    CHECK(s.friction_needed > scene.friction_coefficient);
    CHECK(std::isfinite(s.friction_needed));
    CHECK_FALSE(s.reason.empty());
    return true;
  }
  INFO(s.reason);
  CHECK(s.status == Status::converged);
  CHECK(s.law_violation < 1e-8);
  CHECK(s.load == Approx(*scene.load).epsilon(1e-8));
  // What the edges take between nodes falls like the 3/2 power of the spacing (`solve` puts it into the estimate).
  const double length = s.leading_edge - s.trailing_edge;
  const double lever = *scene.load * std::max(std::abs(s.leading_edge), std::abs(s.trailing_edge)) / scene.radius;
  const double edges = lever / std::abs(s.rolling_resistance) * std::pow(2 * s.spacing / length, 1.5);
  CHECK(s.energy_residual <= std::max({0.01, s.error_estimate, edges}));
  CHECK(s.frictional_loss >= -1e-8 * std::abs(s.load * scene.speed));
  return false;
}

void check_same_answer(const RollingSolution& a, const RollingSolution& b) {
  CHECK(a.status == b.status);
  if (a.status != Status::converged || b.status != Status::converged) return;
  // Both hold all laws to 2e-10 of the largest pressure; forces are measured by the load, as the resistance may vanish.
  CHECK(a.contact_nodes == b.contact_nodes);
  CHECK(std::abs(a.rolling_resistance - b.rolling_resistance) <
        1e-8 * (std::abs(a.load) + std::abs(a.rolling_resistance)));
  CHECK(a.peak_pressure == Approx(b.peak_pressure).epsilon(1e-8));
  if (!std::isnan(a.approach)) CHECK(a.approach == Approx(b.approach).epsilon(1e-8));
  if (!std::isnan(a.rotation_ratio)) CHECK(a.rotation_ratio == Approx(b.rotation_ratio).epsilon(1e-8));
}

}  // namespace

TEST_CASE("a hundred random cylinders roll with every law held, or are refused with the friction they need",
          "[core][random]") {
  int refused = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const RollingScene scene = random_scene(Indenter::cylinder, seed, 40);
    INFO("seed " << seed);
    refused += check_answer(scene, solve(scene));
  }
  CHECK(refused < 15);  // few of these scenes ask for more than friction gives
}

TEST_CASE("random spheres roll with every law held, or are refused with the friction they need", "[core][random]") {
  int refused = 0;
  for (unsigned seed = 201; seed <= 215; ++seed) {
    const RollingScene scene = random_scene(Indenter::sphere, seed, 8);
    INFO("seed " << seed);
    refused += check_answer(scene, solve(scene));
  }
  CHECK(refused < 5);
}

TEST_CASE("Krylov iteration and factorisation find the same contact", "[core][random][long]") {
  // More unknowns than method newton factorises.
  for (unsigned seed = 301; seed <= 312; ++seed) {
    RollingScene scene = random_scene(Indenter::cylinder, seed, 160);
    INFO("cylinder, seed " << seed);
    const RollingSolution iterated = solve(scene);
    scene.method = Method::newton_dense;
    check_same_answer(iterated, solve(scene));
  }
  for (unsigned seed = 401; seed <= 408; ++seed) {
    RollingScene scene = random_scene(Indenter::sphere, seed, 9);
    INFO("sphere, seed " << seed);
    const RollingSolution iterated = solve(scene);
    scene.method = Method::newton_dense;
    check_same_answer(iterated, solve(scene));
  }
}

TEST_CASE("friction that a refusal asks for is enough, and a little less is not", "[core][random]") {
  int refusals = 0;
  for (unsigned seed = 501; refusals < 3 && seed < 560; ++seed) {
    RollingScene scene = random_scene(Indenter::cylinder, seed, 20);
    if (scene.drive == Drive::rotation || scene.friction_coefficient == 0) continue;
    if (scene.drive == Drive::torque) *scene.driving_torque *= 1.3;
    const RollingSolution s = solve(scene);
    if (s.status != Status::no_steady_state) continue;
    ++refusals;
    INFO("seed " << seed << ", needs " << s.friction_needed);
    scene.friction_coefficient = 1.002 * s.friction_needed;
    CHECK(solve(scene).status == Status::converged);
    scene.friction_coefficient = 0.998 * s.friction_needed;
    CHECK(solve(scene).status == Status::no_steady_state);
  }
  CHECK(refusals == 3);
}
