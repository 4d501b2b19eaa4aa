#include "fitting/fit/noise_fit.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"

using namespace rollres;

namespace {

const NoiseTerm level{"noise_level", false, std::vector<bool>(400, true)};
const NoiseTerm part{"relative_noise", true, std::vector<bool>(400, true)};

/// Squares of 400 residuals of the given noise, and what they belong to: predictions over two decades.
struct Drawn {
  Eigen::VectorXd squares{400}, predictions{400};

  Drawn(double level_of, double part_of) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    for (Eigen::Index i = 0; i < 400; ++i) {
      predictions[i] = std::pow(10, 2.0 * static_cast<double>(i) / 399);
      squares[i] = std::pow(normal(random), 2) * (level_of * level_of + std::pow(part_of * predictions[i], 2));
    }
  }
};

}  // namespace

TEST_CASE("one term of the noise is the root of the mean square", "[fitting][noise]") {
  const Drawn drawn(0.5, 0);
  const auto noise = likely_noise(drawn.squares, drawn.predictions, {level});
  CHECK(noise[0].value == Approx(std::sqrt(drawn.squares.mean())).epsilon(1e-9));
  // Of a normal sample's standard deviation: 1/sqrt(2 n) of it.
  CHECK(noise[0].standard_error == Approx(noise[0].value / std::sqrt(800)).epsilon(1e-6));
}

TEST_CASE("a level and a part of the noise are told apart by values of many sizes, within their errors",
          "[fitting][noise]") {
  const Drawn drawn(0.5, 0.03);
  const auto noise = likely_noise(drawn.squares, drawn.predictions, {level, part});
  CHECK(std::abs(noise[0].value - 0.5) < 3 * noise[0].standard_error);
  CHECK(std::abs(noise[1].value - 0.03) < 3 * noise[1].standard_error);
  CHECK(noise[0].standard_error < 0.1);
  CHECK(noise[1].standard_error < 0.005);
}

TEST_CASE("a fit finds material and noise together, of each data set its own", "[fitting][noise]") {
  // Relative noise of 2 % in one set, a level of 40 N/m in the other.
  std::vector<MeasuredScene> scenes;
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal;
  for (const MeasuredScene& row : measured(quick_resistance, spread_speeds(0.003, 3, 24), {1e4, 3e4})) {
    scenes.push_back(row);
    scenes.back().set = *row.scene.load == 1e4 ? "light" : "heavy";
    double& value = scenes.back().measured.value;
    value += (scenes.back().set == "light" ? 0.02 * value : 40) * normal(random);
  }
  NoiseTerm light{"relative_noise (light)", true, {}}, heavy{"noise_level (heavy)", false, {}};
  for (const MeasuredScene& row : scenes) {
    light.acts.push_back(row.set == "light");
    heavy.acts.push_back(row.set == "heavy");
  }
  const FitProblem problem = resistance_problem(scenes, zener_inputs(), quick_resistance);
  const FitReport report = fit_with_noise(problem, {light, heavy}, {});
  INFO(name_of(report.status) << ": " << report.reason);
  CHECK(report.status >= FitStatus::usable_with_warnings);
  const double truth[] = {1e6, 2, 0.1};
  for (std::size_t j = 0; j < 3; ++j)
    CHECK(std::abs(report.parameters[j].value - truth[j]) < 3 * report.parameters[j].standard_error);
  REQUIRE(report.noise_terms.size() == 2);
  CHECK(std::abs(report.noise_terms[0].value - 0.02) < 3 * report.noise_terms[0].standard_error);
  CHECK(std::abs(report.noise_terms[1].value - 40) < 3 * report.noise_terms[1].standard_error);
  // The weights are those of the noise: errors need no scale.
  CHECK(report.reduced_chi_squared == Approx(1).epsilon(0.05));
  SECTION("a datum that no term acts on is refused") {
    CHECK_THROWS_WITH(fit_with_noise(problem, {light}, {}), Catch::Contains("no term of the noise"));
  }
}
