#include "studies/charts/study_chart.hpp"

#include <cmath>

#include "studies/run/sweep.hpp"
#include "studies/stored/study_rows.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/study_points.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers study_definition, shown_study and resistance_error, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

/// Solved by the closed form of plain_scene.hpp: a resistance of load/200 at its peak, which lies at 1 m/s.
Study speed_and_load() {
  return {.name = "speed and load",
          .base = plain_scene(),
          .axes = {{.key = "load", .values = {1e4, 2e4}},
                   {.key = "speed", .values = {0.01, 0.1, 1, 10}, .logarithmic = true}}};
}

ResultStore stored(const TemporaryDirectory& scratch, Study study, const Evaluate& evaluate = closed_form,
                   const std::string& definition = "") {
  study.definition = definition;
  run_sweep(study, evaluate, scratch / "results.db");
  return ResultStore(scratch / "results.db", Access::read);
}

}  // namespace

TEST_CASE("a chart says what was filtered and what is fixed", "[studies][chart]") {
  const TemporaryDirectory scratch;
  ResultStore store = stored(scratch, speed_and_load());
  const std::string all = stored_chart(store, {}).request.subtitle;
  CHECK_THAT(all, Contains("R = ") && Contains("H = ") && Contains("μ = "));
  CHECK_THAT(all, !Contains("P = ") && !Contains("V = "));
  const std::string one = stored_chart(store, {.filters = {{"load", Comparison::equal, "1e4"}}}).request.subtitle;
  CHECK(one == "load = 10 kN/m, " + all);
}

TEST_CASE("a chart names the thickness of every layer that all points have alike", "[studies][chart]") {
  const TemporaryDirectory scratch;
  Study study = speed_and_load();
  BondedLayer further;
  static_cast<MaterialInputs&>(further) = study.base;
  further.layer_thickness = 0.03;
  study.base.lower_layers = {further};
  further.layer_thickness = 0.002;
  study.base.coating_layers = {further};
  ResultStore store = stored(scratch, study);
  CHECK_THAT(stored_chart(store, {}).request.subtitle,
             Contains("H of lower layer [0] = 30 mm") && Contains("H of coating [0] = 2 mm"));
}

TEST_CASE("curves of names stand in the order of the study, those of numbers by size", "[studies][chart]") {
  const TemporaryDirectory scratch;
  Study study = speed_and_load();
  study.axes.front().values = {2e4, 1e4};
  study.axes.insert(study.axes.begin(), Axis{.key = "drive", .texts = {"top_force", "free"}});
  ResultStore store = stored(scratch, study);
  const ChartRequest request = stored_chart(store, {}).request;
  REQUIRE(request.families.size() == 2);
  for (const ChartFamily& family : request.families)
    CHECK(family.labels == (family.labels.front() == "top_force" ? std::vector<std::string>{"top_force", "free"}
                                                                 : std::vector<std::string>{"10 kN/m", "20 kN/m"}));
  CHECK(request.curves.front().label == "top_force, P = 10 kN/m");
}

TEST_CASE("the contact of a metre of a cylinder has a length, that of a sphere an area", "[studies][chart]") {
  for (const auto& [indenter, name] :
       {std::pair(Indenter::cylinder, "contact length"), std::pair(Indenter::sphere, "contact area")}) {
    const TemporaryDirectory scratch;
    Study study = speed_and_load();
    study.base.indenter = indenter;
    ResultStore store = stored(scratch, study, [](const RollingScene& scene) {
      RollingSolution solution = closed_form(scene);
      solution.contact_area = 2e-3;
      return solution;
    });
    StudyChartOptions options;
    options.y = "contact_area";
    CHECK(stored_chart(store, options).request.y.name == name);
  }
}

TEST_CASE("a stored study is charted along its longest axis with one curve for each value of the other",
          "[studies][chart]") {
  const TemporaryDirectory scratch;
  ResultStore store = stored(scratch, speed_and_load());
  const StoredChart chart = stored_chart(store, {});
  const ChartRequest& request = chart.request;

  CHECK(chart.points == 8);
  CHECK(chart.unanswered == 0);
  CHECK(chart.missing == 0);
  CHECK(request.title == "speed and load");
  CHECK(request.x.name == "speed");
  CHECK(request.x.symbol == "V");
  CHECK(request.x.unit == "m/s");
  CHECK(request.x.logarithmic);  // three decades
  CHECK(request.y.name == "rolling resistance");
  CHECK(request.y.symbol == "R_r");
  CHECK(request.y.unit == "N/m");
  CHECK(request.family.symbol == "P");
  REQUIRE(request.curves.size() == 2);
  CHECK(request.curves[0].label == "10 kN/m");
  CHECK(request.curves[1].label == "20 kN/m");
  REQUIRE(request.curves[1].points.size() == 4);
  CHECK(request.curves[1].points[2].x == 1);
  CHECK(request.curves[1].points[2].y == Approx(100).epsilon(1e-12));  // 0.01 P V / (1 + V²)
  CHECK(peak(request.curves[1]) == 2);
  CHECK_THAT(request.comment, Contains("radius = 100 mm") && Contains("static_shear_modulus = 1 MPa"));
  CHECK_THAT(request.comment, !Contains("speed = ") && !Contains("load = "));
}

TEST_CASE("the units of a chart of a sphere are those of forces", "[studies][chart]") {
  const TemporaryDirectory scratch;
  Study study = speed_and_load();
  study.base.indenter = Indenter::sphere;
  ResultStore store = stored(scratch, study);
  const ChartRequest request = stored_chart(store, {}).request;
  CHECK(request.y.unit == "N");
  CHECK(request.curves[0].label == "10 kN");
}

TEST_CASE("the values of a family have one unit where that is read easily of all of them", "[studies][chart]") {
  const auto labels = [](std::vector<double> speeds) {
    const TemporaryDirectory scratch;
    Study study = speed_and_load();
    study.axes = {{.key = "load", .values = {1e4, 2e4}}, {.key = "speed", .values = std::move(speeds)}};
    ResultStore store = stored(scratch, study);
    std::vector<std::string> all;
    for (const ChartCurve& curve : stored_chart(store, {.x = "load"}).request.curves) all.push_back(curve.label);
    return all;
  };
  CHECK(labels({0.7937, 1.2599}) == std::vector<std::string>{"0.7937 m/s", "1.2599 m/s"});
  CHECK(labels({0.01, 10}) == std::vector<std::string>{"10 mm/s", "10 m/s"});
}

TEST_CASE("the study file's own chart and spacing come before the defaults, and wishes before both",
          "[studies][chart]") {
  const TemporaryDirectory scratch;
  ResultStore store = stored(scratch, speed_and_load(), closed_form,
                             R"({"axes": {"load": {"from": 1, "to": 2, "points": 2, "spacing": "logarithmic"}},
                                 "chart": {"x": "load", "y": "rolling_resistance_coefficient", "family": "speed"}})");
  const ChartRequest own = stored_chart(store, {}).request;
  CHECK(own.x.name == "load");
  CHECK(own.x.unit == "kN/m");
  CHECK(own.x.logarithmic);
  CHECK(own.y.name == "rolling resistance coefficient");
  CHECK(own.y.unit.empty());
  REQUIRE(own.curves.size() == 4);
  CHECK(own.curves[0].label == "10 mm/s");
  CHECK(own.curves[0].points.size() == 2);

  const ChartRequest wished = stored_chart(store, {.x = "speed", .y = "rolling_resistance"}).request;
  CHECK(wished.curves.size() == 2);
  CHECK(wished.family.name == "load");
}

TEST_CASE("a point without an answer is a gap with a sign and one not computed a gap without", "[studies][chart]") {
  const TemporaryDirectory scratch;
  const Evaluate failing = [](const RollingScene& scene) {
    if (scene.speed == 1 && scene.load == 2e4) throw std::runtime_error("no");
    return closed_form(scene);
  };
  Study study = speed_and_load();
  stored(scratch, study, failing);
  ResultStore writer(scratch / "results.db");
  study.axes[1].values.push_back(100);  // the study is asked for one more speed, at which nothing is computed
  std::vector<std::string> keys;
  for (const RollingScene& scene : points(study)) keys.push_back(evaluation_key(scene));
  writer.start_study({study.name, {"load", "speed"}, ""}, keys);
  RollingScene scene = plain_scene(100, 1e4);
  writer.save(std::vector<Evaluation>{{evaluation_key(scene), scene, closed_form(scene)}});

  const StoredChart chart = stored_chart(writer, {});
  CHECK(chart.points == 9);
  CHECK(chart.unanswered == 1);
  CHECK(chart.missing == 1);
  const auto& points_20 = chart.request.curves.at(1).points;
  REQUIRE(points_20.size() == 5);
  CHECK_FALSE(points_20[2].converged);
  CHECK(std::isnan(points_20[2].y));
  CHECK(points_20[2].x == 1);
  CHECK(points_20[4].converged);
  CHECK(std::isnan(points_20[4].y));
}

TEST_CASE("three axes give a curve for every combination of two, and a filter takes some of them", "[studies][chart]") {
  const TemporaryDirectory scratch;
  Study study = speed_and_load();
  study.axes.push_back({.key = "friction_coefficient", .values = {0.1, 0.2, 0.3}});
  ResultStore store = stored(scratch, study);
  const ChartRequest all = stored_chart(store, {}).request;
  REQUIRE(all.curves.size() == 6);
  CHECK(all.curves[1].label == "P = 10 kN/m, μ = 0.2");
  // The longer family by colour, the other by dash and mark.
  REQUIRE(all.families.size() == 2);
  CHECK(all.families[0].axis.symbol == "μ");
  CHECK(all.families[0].labels == std::vector<std::string>{"0.1", "0.2", "0.3"});
  CHECK(all.families[1].labels == std::vector<std::string>{"10 kN/m", "20 kN/m"});
  CHECK(all.curves[1].place == std::array<std::size_t, 2>{1, 0});
  CHECK(all.curves[5].place == std::array<std::size_t, 2>{2, 1});
  const ChartRequest some = stored_chart(store, {.filters = {parse_filter("friction_coefficient=0.2")}}).request;
  CHECK(some.curves.size() == 2);
  CHECK(some.curves[1].label == "20 kN/m");
  const ChartRequest friction = stored_chart(store, {.x = "friction_coefficient"}).request;
  CHECK(friction.curves.size() == 8);
  CHECK_FALSE(friction.x.logarithmic);
}

TEST_CASE("an output along x is joined in the order of the longest axis", "[studies][chart]") {
  const TemporaryDirectory scratch;
  ResultStore store = stored(scratch, speed_and_load());
  const ChartRequest request = stored_chart(store, {.x = "rolling_resistance_coefficient"}).request;
  REQUIRE(request.curves.size() == 2);
  const auto& points = request.curves[0].points;
  REQUIRE(points.size() == 4);
  CHECK(points[1].x == Approx(0.1 * 0.01 / 1.01).epsilon(1e-12));
  CHECK(points[2].x == Approx(0.005).epsilon(1e-12));
  CHECK(points[3].x == Approx(10 * 0.01 / 101).epsilon(1e-12));
}

TEST_CASE("a study of methods has one curve for each, by its name", "[studies][chart]") {
  const TemporaryDirectory scratch;
  Study study = speed_and_load();
  study.axes[0] = {.key = "method", .texts = {"newton", "active_set"}};
  ResultStore store = stored(scratch, study);
  const ChartRequest request = stored_chart(store, {}).request;
  REQUIRE(request.curves.size() == 2);
  CHECK(request.curves[0].label == "newton");
  CHECK(request.curves[1].label == "active_set");
}

TEST_CASE("what varies together with x needs no curves of its own, unless x does not tell it", "[studies][chart]") {
  const TemporaryDirectory scratch;
  Study study{.name = "zip",
              .base = plain_scene(),
              .axes = {{.key = "load", .values = {1e4, 2e4}},
                       {.key = "speed", .values = {1, 2, 3, 4}, .group = "run"},
                       {.key = "friction_coefficient", .values = {0.1, 0.2, 0.1, 0.2}, .group = "run"}}};
  ResultStore store = stored(scratch, study, closed_form,
                             R"({"axes": {"load": [], "run": {"zip": {"speed": [], "friction_coefficient": []}}}})");
  const ChartRequest along_speed = stored_chart(store, {}).request;
  CHECK(along_speed.x.name == "speed");
  CHECK(along_speed.lines);
  REQUIRE(along_speed.curves.size() == 2);
  CHECK(along_speed.curves[0].points.size() == 4);
  CHECK(along_speed.family.name == "load");
  const ChartRequest by_friction = stored_chart(store, {.x = "speed", .family = "friction_coefficient"}).request;
  CHECK(by_friction.curves.size() == 4);
  const ChartRequest along_friction = stored_chart(store, {.x = "friction_coefficient"}).request;
  REQUIRE(along_friction.curves.size() == 8);  // four speeds, two loads
  CHECK(along_friction.curves[0].label == "P = 10 kN/m, V = 1 m/s");
}

TEST_CASE("the points of a sample of several inputs are marks without lines and without peaks", "[studies][chart]") {
  const TemporaryDirectory scratch;
  Study study{.name = "sample",
              .base = plain_scene(),
              .axes = {{.key = "load", .values = {1e4, 2e4}},
                       {.key = "speed", .values = {1, 3, 2, 4}, .group = "sample"},
                       {.key = "radius", .values = {0.1, 0.2, 0.4, 0.3}, .group = "sample"}}};
  ResultStore store = stored(scratch, study, closed_form, R"({"axes": {"load": []}, "sample": {"ranges": {
    "speed": {"from": 1, "to": 5}, "radius": {"from": 0.1, "to": 1, "spacing": "logarithmic"}}}})");
  const ChartRequest request = stored_chart(store, {.x = "radius"}).request;
  CHECK(request.x.logarithmic);
  CHECK_FALSE(request.lines);
  REQUIRE(request.curves.size() == 2);
  CHECK(request.curves[0].points.size() == 4);
  const std::string script = chart_script(request, chart_files("a"));
  CHECK_THAT(script, !Contains("with lines") && Contains("with points") && !Contains("linespoints"));
  CHECK_FALSE(stored_chart(store, {.x = "rolling_resistance_coefficient"}).request.lines);
  const ChartRequest along_load = stored_chart(store, {.x = "load"}).request;
  CHECK(along_load.lines);
  CHECK(along_load.curves.size() == 4);
}

TEST_CASE("a study's charts are asked for by name or number", "[studies][chart]") {
  const TemporaryDirectory scratch;
  ResultStore store = stored(scratch, speed_and_load(), closed_form,
                             R"({"charts": [{"x": "speed"}, {"name": "by load", "x": "load"}]})");
  CHECK(stored_charts(store, "") == std::vector<std::string>{"1", "by load"});
  CHECK(stored_chart(store, {}).request.x.name == "speed");
  CHECK(stored_chart(store, {.chart = "1"}).request.x.name == "speed");
  CHECK(stored_chart(store, {.chart = "2"}).request.x.name == "load");
  CHECK(stored_chart(store, {.chart = "by load"}).request.x.name == "load");
  CHECK_THAT(message_of([&] { stored_chart(store, {.chart = "3"}); }),
             Contains("speed and load: chart = 3: must be one of 1, by load"));
}

TEST_CASE("a chart that cannot be made names what is wrong and the nearest known name", "[studies][chart]") {
  const TemporaryDirectory scratch;
  ResultStore store = stored(scratch, speed_and_load());
  const auto refused = [&](const StudyChartOptions& options) {
    CHECK_THROWS_AS(stored_chart(store, options), std::invalid_argument);
    return message_of([&] { stored_chart(store, options); });
  };
  CHECK_THAT(refused({.study = "sped and load"}), Contains("results.db") && Contains("speed and load"));
  CHECK_THAT(refused({.x = "sped"}), Contains("x = sped") && Contains("speed"));
  CHECK_THAT(refused({.y = "rolling_resistence"}), Contains("rolling_resistance"));
  CHECK_THAT(refused({.y = "status"}), Contains("must be a number"));
  CHECK_THAT(refused({.x = "speed", .family = "speed"}), Contains("must differ from x"));
  CHECK_THAT(refused({.filters = {parse_filter("speed>1000")}}), Contains("no point matches"));

  Study many = speed_and_load();
  many.name = "many";
  for (int i = 3; i <= 40; ++i) many.axes[0].values.push_back(1e4 * i);
  many.axes[1].values.assign({0.1, 1});
  for (int i = 2; i <= 60; ++i) many.axes[1].values.push_back(i);
  ResultStore both = stored(scratch, many);
  CHECK_THAT(message_of([&] { stored_chart(both, {}); }), Contains("--study") && Contains("many, speed and load"));
  CHECK_THAT(message_of([&] { stored_chart(both, {.study = "many"}); }), Contains("40 curves") && Contains("--where"));

  ResultStore empty(scratch / "empty.db");
  CHECK_THAT(message_of([&] { stored_chart(empty, {}); }), Contains("holds no study"));
}

TEST_CASE("rolling resistance has a band as wide as its estimated error, where it can be seen", "[studies][chart]") {
  const TemporaryDirectory scratch;
  double error = 0.1;
  const Evaluate estimated = [&error](const RollingScene& scene) {
    RollingSolution solution = closed_form(scene);
    solution.error_estimate = error;
    return solution;
  };
  ResultStore wide = stored(scratch, speed_and_load(), estimated);
  const ChartRequest request = stored_chart(wide, {}).request;
  CHECK(request.curves[1].points[2].low == Approx(90));
  CHECK(request.curves[1].points[2].high == Approx(110));
  CHECK_THAT(chart_data(request),
             Contains("# column 5, 6: ends of estimated error\n") && Contains("\n1 100 1 1 90 110\n"));
  CHECK_THAT(chart_script(request, chart_files("c")), Contains("with filledcurves") && Contains("'estimated error'"));
  CHECK_FALSE(stored_chart(wide, {.y = "contact_nodes"}).request.curves[1].points[2].area());

  const TemporaryDirectory other;
  error = 1e-8;
  ResultStore narrow = stored(other, speed_and_load(), estimated);
  CHECK_THAT(chart_script(stored_chart(narrow, {}).request, chart_files("c")), !Contains("filledcurves"));
}

TEST_CASE("a formula has the band that the error of the rolling resistance in it makes", "[studies][chart]") {
  const TemporaryDirectory scratch;
  ResultStore store = stored(
      scratch, speed_and_load(),
      [](const RollingScene& scene) {
        RollingSolution solution = closed_form(scene);
        solution.error_estimate = 0.02;
        return solution;
      },
      R"({"compute": {"square": "rolling_resistance^2 * speed", "other": "2 * load"}})");
  StudyChartOptions options;
  options.y = "square";
  const ChartRequest squares = stored_chart(store, options).request;
  CHECK(squares.areas == "estimated error");
  const ChartPoint& point = squares.curves.front().points.front();
  CHECK(point.high / point.y == Approx(1.02 * 1.02));
  CHECK(point.low / point.y == Approx(2 - 1.02 * 1.02));
  options.y = "other";
  CHECK(stored_chart(store, options).request.areas.empty());
}

TEST_CASE("shares of the losses are stacked up to the rolling resistance", "[studies][chart]") {
  const TemporaryDirectory scratch;
  const Evaluate with_losses = [](const RollingScene& scene) {
    RollingSolution solution = closed_form(scene);
    solution.viscous_loss = 0.75 * solution.rolling_resistance * scene.speed;
    solution.frictional_loss = 0.25 * solution.rolling_resistance * scene.speed;
    return solution;
  };
  ResultStore store = stored(scratch, speed_and_load(), with_losses);
  const ChartRequest request =
      stored_chart(store, {.shares = true, .filters = {{"load", Comparison::equal, "2e4"}}}).request;
  REQUIRE(request.curves.size() == 2);
  const ChartPoint &layer = request.curves[0].points[2], &friction = request.curves[1].points[2];
  CHECK(layer.low == 0);
  CHECK(layer.y == Approx(75));
  CHECK(layer.high == layer.y);
  CHECK(friction.low == layer.y);
  CHECK(friction.y == Approx(100));
  CHECK(friction.high == friction.y);
  CHECK_THAT(chart_script(request, chart_files("c")), Contains("filledcurves") && Contains("'lost to friction"));

  CHECK_THAT(message_of([&] { stored_chart(store, {.shares = true}); }), Contains("of one curve, not of 2"));
  CHECK_THAT(message_of([&] { stored_chart(store, {.y = "approach", .shares = true}); }), Contains("y = approach"));
}

TEST_CASE("curves at several temperatures are named in degrees Celsius, differences of temperature in kelvin",
          "[studies][chart]") {
  const QuantityColumn& temperature = *find_quantity_column("temperature");
  CHECK(value_in_words(temperature.quantity, Cell(253.15), "K") == "-20 °C");
  CHECK(value_in_words(temperature.quantity, Cell(295.65), "K") == "22.5 °C");
  CHECK(value_in_words(find_quantity_column("wlf_c2")->quantity, Cell(137.64), "K") == "137.64 K");
}
