#include "core/material/material_functions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/material/master_curve.hpp"
#include "core/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/core/rubber.hpp"

using namespace rollres;

namespace {

const PronySeries three_terms{1e6, {{1e6, 1e-3}, {2e6, 5e-2}, {7e5, 2}}};

struct DrawnTest {
  std::vector<double> times, relaxation, creep;  // [s], G(t) [Pa], J(t) [1/Pa]
};

/// From 0.1 ms to 100 s, with a relative noise.
DrawnTest drawn(double noise, std::uint64_t draw) {
  std::mt19937_64 generator(draw);
  std::normal_distribution<double> normal(1, noise > 0 ? noise : 1e-300);
  const CreepSpectrum creep = creep_spectrum(three_terms);
  DrawnTest test;
  for (int i = 0; i <= 36; ++i) {
    test.times.push_back(1e-4 * std::pow(10, i / 6.0));
    test.relaxation.push_back(normal(generator) * relaxation_modulus(three_terms, test.times.back()));
    test.creep.push_back(normal(generator) * creep_compliance(creep, test.times.back()));
  }
  return test;
}

MaterialInputs relaxation_curve(const std::vector<double>& times, const std::vector<double>& moduli) {
  MaterialInputs layer;
  layer.material = MaterialModel::relaxation_curve;
  layer.relaxation_times = times;
  layer.relaxation_moduli = moduli;
  return layer;
}

double farthest(const MaterialInputs& layer) {
  double most = 0;
  for (double omega = 0.03; omega < 3e3; omega *= 1.5) {
    const auto truth = complex_modulus(three_terms, omega), found = complex_modulus(layer, omega);
    most = std::max({most, std::abs(found.real() / truth.real() - 1), std::abs(found.imag() / truth.imag() - 1)});
  }
  return most;
}

/// The paper's cylinder on a Prony solid that is still to be given.
RollingScene without_friction() {
  RollingScene solid = paper_cylinder();
  solid.friction_coefficient = 0;
  solid.spacing.reset();
  solid.inertia = Inertia::off;
  solid.material = MaterialModel::prony;
  return solid;
}

}  // namespace

TEST_CASE("exact rows of relaxation or of creep give a Prony solid's storage and loss back inside their band",
          "[core][material]") {
  const DrawnTest test = drawn(0, 0);
  // Relaxation is linear in the series' moduli and loses nothing; creep goes through G(t) J(t) of times that move.
  CHECK(farthest(relaxation_curve(test.times, test.relaxation)) < 1e-4);
  CHECK(farthest(relaxation_curve(test.times, relaxation_of_creep(test.times, test.creep))) < 1e-4);
}

TEST_CASE("the modulus of a power law's creep is sin(pi n)/(pi n) over its compliance", "[core][material]") {
  // Fails where compliances are inverted row by row: 1/J is 11 % to 57 % above G.
  for (const double n : {0.25, 0.5}) {
    std::vector<double> times, creep;
    for (int i = 0; i <= 60; ++i) {
      times.push_back(std::pow(10, i / 10.0));
      creep.push_back(1e-6 * std::pow(times.back(), n));
    }
    const std::vector<double> moduli = relaxation_of_creep(times, creep);
    const double factor = std::sin(std::numbers::pi * n) / (std::numbers::pi * n);
    for (std::size_t i = 25; i < times.size(); ++i)  // before them no row says how it began
      CHECK(moduli[i] * creep[i] == Approx(factor).epsilon(0.02));
  }
}

TEST_CASE("rolling on noisy rows of relaxation and of creep costs what it does on the solid, within the stated error",
          "[core][material][rolling_contact]") {
  RollingScene solid = without_friction();
  solid.static_shear_modulus = three_terms.static_modulus;
  for (const PronySeries::Term& term : three_terms.terms) {
    solid.relaxation_times.push_back(term.time);
    solid.relaxation_moduli.push_back(term.modulus);
  }
  int outside = 0, all = 0;
  for (const double speed : {0.01, 0.1, 1.0}) {
    solid.speed = speed;
    const double truth = solve(solid).rolling_resistance;
    for (std::uint64_t draw = 1; draw <= 10; ++draw) {
      const DrawnTest test = drawn(0.02, draw);
      for (const auto& moduli : {test.relaxation, relaxation_of_creep(test.times, test.creep)}) {
        MaterialInputs layer = relaxation_curve(test.times, moduli);
        layer.poisson_ratio = solid.poisson_ratio;
        const RollingSolution found = solve(with_material(solid, layer));
        REQUIRE(found.status == Status::converged);
        const double missed = std::abs(found.rolling_resistance - truth) / truth;
        CAPTURE(speed, draw, missed, found.rolling_resistance_error / truth);
        CHECK(found.rolling_resistance_error < 0.5 * truth);
        CHECK(missed < 2 * found.rolling_resistance_error / truth);
        outside += missed * truth > found.rolling_resistance_error;
        ++all;
      }
    }
  }
  CAPTURE(outside, all);
  CHECK(outside <= 3);  // of 60
}

TEST_CASE("rolling on exact rows of creep of few-term solids costs what it does on them, within the stated error",
          "[core][material][rolling_contact]") {
  // Fails where retardation times stay on even ones: 7 of 20 lie outside, one 0.6 % off.
  std::mt19937_64 generator(1);
  const auto evenly = [&](double from, double to) {
    return std::pow(10, std::uniform_real_distribution<double>(from, to)(generator));
  };
  RollingScene solid = without_friction();
  solid.static_shear_modulus = 1e6;
  solid.load = 3e3;
  int outside = 0;
  double farthest_error = 0;
  for (int draw = 0; draw < 20; ++draw) {
    PronySeries series{1e6, {}};
    for (int term = 0; term < 1 + draw % 5; ++term) {
      const double time = evenly(-4.5, -0.5);
      series.terms.push_back({evenly(5, 6.7), time});
    }
    series = ordered(series);
    solid.speed = evenly(-1, 1);
    const int per_decade = draw % 2 == 0 ? 5 : 10;
    const CreepSpectrum creep = creep_spectrum(series);
    std::vector<double> times, compliances;
    for (int i = 0; i <= 7 * per_decade; ++i) {
      times.push_back(1e-6 * std::pow(10, static_cast<double>(i) / per_decade));
      compliances.push_back(creep_compliance(creep, times.back()));
    }
    solid.relaxation_times.clear();
    solid.relaxation_moduli.clear();
    for (const PronySeries::Term& term : series.terms) {
      solid.relaxation_times.push_back(term.time);
      solid.relaxation_moduli.push_back(term.modulus);
    }
    const double truth = solve(solid).rolling_resistance;
    MaterialInputs layer = relaxation_curve(times, relaxation_of_creep(times, compliances));
    layer.poisson_ratio = solid.poisson_ratio;
    const RollingSolution found = solve(with_material(solid, layer));
    REQUIRE(found.status == Status::converged);
    const double missed = std::abs(found.rolling_resistance - truth);
    outside += missed > found.rolling_resistance_error;
    farthest_error = std::max(farthest_error, missed / truth);
  }
  CAPTURE(outside, farthest_error);
  CHECK(outside <= 2);
  CHECK(farthest_error < 2e-3);
}
