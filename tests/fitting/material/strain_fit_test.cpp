#include "fitting/material/strain_fit.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/material/strain_softening.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

MaterialInputs filled_rubber() {
  MaterialInputs layer;
  layer.payne_drop = 0.6;
  layer.payne_strain = 0.02;
  layer.payne_exponent = 0.55;
  layer.payne_loss_peak = 1.5;
  return layer;
}

/// A sweep from 0.02 to 40 % of a rubber of 5 and 0.5 MPa.
std::vector<MeasuredStrain> sweep(const MaterialInputs& layer, double noise, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<MeasuredStrain> data;
  for (double strain = 2e-4; strain < 0.5; strain *= 1.6) {
    const Softening softening = softening_at(layer, strain);
    const double storage = 5e6 * softening.storage * (1 + noise * normal(random)),
                 loss = 5e5 * softening.loss * (1 + noise * normal(random));
    const double deviation = noise > 0 ? noise : 1;
    data.push_back({strain, storage, loss, deviation * storage, deviation * loss});
  }
  return data;
}

}  // namespace

TEST_CASE("a strain sweep gives back the parameters of Kraus's model", "[fitting][material_fit]") {
  const StrainFit found = fit_strain_sweep(sweep(filled_rubber(), 0), false);
  CHECK(found.layer.payne_drop == Approx(0.6).epsilon(1e-5));
  CHECK(found.layer.payne_strain.value() == Approx(0.02).epsilon(1e-5));
  CHECK(found.layer.payne_exponent == Approx(0.55).epsilon(1e-5));
  CHECK(found.layer.payne_loss_peak == Approx(1.5).epsilon(1e-5));
  CHECK(found.moduli(1e-9).storage == Approx(5e6).epsilon(1e-5));
  CHECK(found.moduli(0.02).storage == Approx(5e6 * 0.7).epsilon(1e-5));
  CHECK(found.moduli(0.02).loss == Approx(5e5 * 1.5).epsilon(1e-5));
  std::vector<MeasuredStrain> three = sweep(filled_rubber(), 0);
  three.resize(3);
  CHECK_THAT(message_of([&] { fit_strain_sweep(three, false); }),
             Catch::Contains("needs moduli at four strains at least; the sweep has 3"));
}

TEST_CASE("a sweep that ends before half of the drop says so", "[fitting][material_fit]") {
  std::vector<MeasuredStrain> data = sweep(filled_rubber(), 0.001);
  std::erase_if(data, [](const MeasuredStrain& row) { return row.amplitude > 0.01; });
  const StrainFit found = fit_strain_sweep(data, true);
  CHECK(found.report.status < FitStatus::good);
  const auto& warnings = found.report.warnings;
  const bool told = std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("payne_strain lies above all strains of the sweep") != std::string::npos;
  });
  CHECK(told == (found.layer.payne_strain.value() > data.back().amplitude));
}

TEST_CASE("intervals of Kraus's parameters hold the truth as often as they say", "[fitting][material_fit]") {
  const std::vector<double> truth{5e6, 5e5, 0.6, 0.02, 0.55, 1.5};
  std::vector<int> held(truth.size());
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const StrainFit found = fit_strain_sweep(sweep(filled_rubber(), 0.02, seed), true, {.profiles = false});
    for (std::size_t j = 0; j < truth.size(); ++j) {
      const ConfidenceInterval& interval = found.report.parameters[j].linear;
      held[j] += interval.lowest <= truth[j] && interval.highest >= truth[j];
    }
  }
  for (const int count : held) CHECK(count >= 88);  // three deviations of the binomial distribution below 95
}
