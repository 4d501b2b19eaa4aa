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

TEST_CASE("the frequencies at which the contact loses its power are shaded and explained", "[studies][material]") {
  const RollingScene scene = plain_scene();
  const auto contact = contact_frequencies(scene);
  REQUIRE((contact && contact->band));
  CHECK(contact->band->lowest < contact->band->highest);
  CHECK_THAT(contact->in_words(), Contains("80 % of the power is lost between "));
  const ChartRequest chart = moduli_chart(scene, "law", contact);
  REQUIRE(chart.range);
  CHECK(chart.range->from == contact->band->lowest);
  CHECK(chart.range->to == contact->band->highest);
  const ChartSpans spans = chart_spans(chart);
  CHECK((spans.x.lowest <= chart.range->from && spans.x.highest >= chart.range->to));
  CHECK_THAT(chart_script(chart, chart_files("law")),
             Contains("set object 1 rectangle from first ") && Contains("where the contact loses 80 % of its power"));
  RollingScene elastic = scene;
  elastic.material = MaterialModel::elastic;
  CHECK_FALSE(moduli_chart(elastic, "law", contact_frequencies(elastic)).range);
}

TEST_CASE("a shift is drawn by its law or between the rows of its table, with the layer's own temperature",
          "[studies][material]") {
  RollingScene scene = plain_scene();
  CHECK_FALSE(shifts_times(scene));
  scene.reference_temperature = 293.15;
  scene.temperature = 303.15;
  scene.wlf_c1 = 10;
  scene.wlf_c2 = 90;  // log10 a = -10·10/100
  REQUIRE(shifts_times(scene));
  const ChartRequest law = shift_chart(scene, "law");
  REQUIRE(law.curves.size() == 2);
  CHECK(law.curves.back().points.front().x == Approx(30));
  CHECK(law.curves.back().points.front().y == Approx(0.1));
  CHECK(least(law.curves.front()) == Approx(-10));
  scene.temperature = 293.15 - 80;  // 10 K above the law's pole: nothing is drawn beyond
  const ChartRequest cold = shift_chart(scene, "law");
  CHECK(least(cold.curves.front()) > 20 - 90);
  CHECK(std::isfinite(cold.curves.front().points.front().y));

  scene.wlf_c1.reset();
  scene.wlf_c2.reset();
  scene.temperature = 298.15;
  scene.shift_temperatures = {283.15, 293.15, 303.15};
  scene.shift_factors = {30, 3, 0.6};
  const ChartRequest table = shift_chart(scene, "table");
  REQUIRE(table.curves.size() == 3);
  const std::vector<ChartPoint>& rows = table.curves[1].points;
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].y == Approx(10));  // over the row of the reference
  CHECK(rows[2].y == Approx(0.2));
  CHECK(least(table.curves.front()) == Approx(10));
  CHECK(most(table.curves.front()) == Approx(30));
}
