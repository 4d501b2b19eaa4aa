#include "studies/figures/material_chart.hpp"

#include <algorithm>
#include <complex>

#include "studies/drawing/chart_frame.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

/// A Zener solid as a table from 0.1 to 10 Hz; its spectrum reaches beyond.
RollingScene with_table() {
  RollingScene scene = plain_scene();
  scene.material = MaterialModel::master_curve;
  scene.listed_moduli = ListedModuli::shear;
  for (const double frequency : {0.1, 0.3, 1.0, 3.0, 10.0}) {
    const std::complex<double> turns(0, 6.283185307179586 * frequency * 0.01);
    const std::complex<double> modulus = 1e6 + 2e6 * turns / (1.0 + turns);
    scene.frequencies.push_back(frequency);
    scene.storage_moduli.push_back(modulus.real());
    scene.loss_moduli.push_back(modulus.imag());
  }
  scene.static_shear_modulus = scene.stiffening = scene.creep_time = 0;
  return scene;
}

double least(const ChartCurve& curve) { return curve.points.front().x; }
double most(const ChartCurve& curve) { return curve.points.back().x; }

std::vector<ChartCurve> extrapolated(const ChartRequest& chart) {
  std::vector<ChartCurve> found;
  std::copy_if(chart.curves.begin(), chart.curves.end(), std::back_inserter(found),
               [](const ChartCurve& curve) { return curve.extrapolated; });
  return found;
}

}  // namespace

TEST_CASE("moduli are dashed beyond the rows of a table and go on where the rows end", "[studies][material]") {
  const ChartRequest chart = moduli_chart(with_table(), "rubber");
  for (const std::size_t i : {0U, 1U}) {
    CHECK(least(chart.curves[i]) == 0.1);
    CHECK(most(chart.curves[i]) == 10);
  }
  const std::vector<ChartCurve> beyond = extrapolated(chart);
  REQUIRE(beyond.size() >= 2);
  for (const ChartCurve& curve : beyond) {
    CHECK((most(curve) == 0.1 || least(curve) == 10));
    CHECK(curve.like.has_value());
  }
  CHECK_THAT(chart_script(chart, chart_files("rubber")), Contains("extrapolated") && Contains("dt (10,6)"));
}

TEST_CASE("the rows stand at the frequencies where they act at the temperature", "[studies][material]") {
  RollingScene scene = with_table();
  scene.reference_temperature = 293.15;
  scene.temperature = 303.15;
  scene.wlf_c1 = 10;
  scene.wlf_c2 = 90;  // log10 a = -10·10/100
  const ChartRequest chart = moduli_chart(scene, "rubber");
  CHECK_FALSE(chart.curves.back().line);
  CHECK(least(chart.curves.back()) == Approx(1.0).epsilon(1e-12));
  CHECK(most(chart.curves.front()) == Approx(100.0).epsilon(1e-12));
}

TEST_CASE("creep is dashed at times that no row of the table saw", "[studies][material]") {
  const std::vector<ChartCurve> beyond = extrapolated(creep_chart(with_table(), "rubber"));
  REQUIRE(beyond.size() >= 2);
  const double shortest = 1 / (6.283185307179586 * 10), longest = 100 * shortest;
  for (const ChartCurve& curve : beyond)
    for (const ChartPoint& point : curve.points)
      CHECK((point.x <= shortest * (1 + 1e-12) || point.x >= longest * (1 - 1e-12)));
}

TEST_CASE("nothing of a law is extrapolated", "[studies][material]") {
  CHECK(extrapolated(moduli_chart(plain_scene(), "law")).empty());
  CHECK(extrapolated(creep_chart(plain_scene(), "law")).empty());
  CHECK(moduli_chart(plain_scene(), "law").subtitle.empty());
}
