#include "studies/evidence/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "studies/scene_io/scene_file.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers power_law, accuracy_reference and accuracy_table, too.

using namespace rollres;

namespace {

RollingScene example_scene(const std::string& name) { return read_scene(example(name + ".json")); }

constexpr double exact = 357.0, length = 7.5e-3;

/// A scene that only the methods on a grid solve.
RollingScene periodic_cylinder() {
  RollingScene scene = example_scene("paper_cylinder");
  scene.period = 0.2;
  return scene;
}

/// A method whose answer is `coefficient * spacing^order` too large and takes `seconds_per_node * nodes^growth`.
struct Law {
  double coefficient, order, seconds_per_node, growth;

  int nodes(double spacing) const { return static_cast<int>(std::lround(length / spacing)); }
  double seconds(double spacing) const { return seconds_per_node * std::pow(nodes(spacing), growth); }
  double resistance(double spacing) const { return exact * (1 + coefficient * std::pow(spacing / 1e-3, order)); }
};

const std::map<Method, Law> laws{{Method::newton, {0.02, 2, 1e-4, 1.2}},
                                 {Method::newton_dense, {0.02, 2, 1e-5, 2.5}},
                                 {Method::active_set, {0.05, 1, 1e-3, 1.5}}};

/// Measures by the laws, and keeps count.
struct LawfulMeasure {
  int calls = 0, stopped = 0;
  double longest = 0;  // of solutions that were started [s]

  Measurement operator()(const RollingScene& scene, double limit) {
    const Law& law = laws.at(scene.method);
    const double spacing = scene.spacing.value();
    Measurement measured;
    measured.seconds = measured.processor_seconds = law.seconds(spacing);
    measured.solution = closed_form(scene);
    measured.solution.rolling_resistance = law.resistance(spacing);
    measured.solution.contact_nodes = law.nodes(spacing);
    measured.solution.law_violation = 1e-12;
    measured.peak_memory = 1e6;
    ++calls;
    longest = std::max(longest, measured.seconds);
    if (measured.seconds > limit) {
      ++stopped;
      measured.stopped = true;
      measured.failure = "stopped at the limit";
    }
    return measured;
  }
};

const AccuracyOptions unlimited{.repeats = 1, .seconds_limit = 1e9};

AccuracyReport measured_by_laws(AccuracyOptions options = {}) {
  options.repeats = 1;
  return measure_accuracy("scene", periodic_cylinder(), options, LawfulMeasure());
}

AccuracyTrend trend_of(const AccuracyReport& report, Method method) {
  return *std::find_if(report.trends.begin(), report.trends.end(),
                       [&](const AccuracyTrend& trend) { return trend.method == method; });
}

}  // namespace

TEST_CASE("the usual spacings hold the scene's own and go from 8 to 500 nodes in 2D, to 130 in 3D",
          "[studies][accuracy]") {
  const std::vector<double> cylinder = usual_spacings(example_scene("paper_cylinder"));
  REQUIRE(cylinder.size() == 13);
  CHECK(cylinder.front() == 1e-3);
  CHECK(cylinder[4] == 0.25e-3);
  CHECK(cylinder[5] == 176.8e-6);
  CHECK(cylinder.back() == 1e-3 / 64);
  const std::vector<double> sphere = usual_spacings(example_scene("paper_sphere"));
  REQUIRE(sphere.size() == 9);
  CHECK(sphere.front() == 1e-3);
  CHECK(sphere.back() == 0.0625e-3);
  RollingScene free_of_grid = example_scene("paper_cylinder");
  free_of_grid.spacing.reset();
  CHECK(usual_spacings(free_of_grid).size() == 13);
}

TEST_CASE("the order of an error and the growth of a cost are found again", "[studies][accuracy]") {
  const AccuracyReport report = measured_by_laws(unlimited);
  REQUIRE(report.points.size() == 3 * 13);
  // A pure power law is extrapolated to within rounding: about 1e-12 in the error, 1e-6 of the smallest one.
  CHECK(report.reference.extrapolated);
  CHECK(report.reference.rolling_resistance == Approx(exact).epsilon(1e-11));
  for (const auto& [method, law] : laws) {
    CAPTURE(name_of(method));
    const AccuracyTrend trend = trend_of(report, method);
    CHECK(trend.order == Approx(law.order).epsilon(1e-5));
    CHECK(trend.order_deviation < 1e-5);
    CHECK(trend.growth == Approx(law.growth).epsilon(1e-9));
  }
  for (const AccuracyPoint& point : report.points) {
    const Law& law = laws.at(point.method);
    CHECK(point.error == Approx(law.resistance(point.spacing) / exact - 1).epsilon(1e-6));
    CHECK(point.seconds == law.seconds(point.spacing));
  }
}

TEST_CASE("an error that scatters is not extrapolated: the reference is the finest Newton answer",
          "[studies][accuracy]") {
  const auto scattered = [](double spacing) {
    return exact * (1 + 1e-3 * spacing / 1e-3 * std::sin(1e4 * std::log(spacing)));
  };
  LawfulMeasure lawful;
  const Measure measure = [&](const RollingScene& scene, double limit) {
    Measurement measured = lawful(scene, limit);
    measured.solution.rolling_resistance = scattered(*scene.spacing);
    return measured;
  };
  const AccuracyReport report = measure_accuracy("scene", periodic_cylinder(), unlimited, measure);
  const AccuracyReference& reference = report.reference;
  CHECK_FALSE(reference.extrapolated);
  CHECK(reference.method == Method::newton);
  CHECK(reference.spacing <= 0.5 * report.points.back().spacing);
  CHECK(reference.rolling_resistance == scattered(reference.spacing));
  CHECK(reference.uncertainty == Approx(std::abs(scattered(2 * reference.spacing) / scattered(reference.spacing) - 1)));
  for (const ChartCurve& curve : accuracy_chart(report).curves) {
    CHECK(curve.points.size() == 13);
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      CHECK(curve.points[i].y >= reference.uncertainty);
      CHECK(curve.points[i].y >= std::abs(report.points[i].error));
      CHECK((i == 0 || curve.points[i].y <= curve.points[i - 1].y));
    }
  }
}

TEST_CASE("where the Newton method fails the dense one is the reference, and the failure is told",
          "[studies][accuracy]") {
  LawfulMeasure lawful;
  const Measure measure = [&](const RollingScene& scene, double limit) {
    Measurement measured = lawful(scene, limit);
    if (scene.method == Method::newton && *scene.spacing < 0.2e-3) {
      measured.solution.status = Status::not_converged;
      measured.solution.reason = "stopped after 3 iterations";
    }
    if (scene.method == Method::active_set && *scene.spacing < 0.6e-3) {
      measured = {};
      measured.failure = "crashed: SIGSEGV";
    }
    return measured;
  };
  const AccuracyReport report = measure_accuracy("scene", periodic_cylinder(), unlimited, measure);
  CHECK(report.reference.method == Method::newton_dense);
  for (const AccuracyPoint& point : report.points) {
    const bool failed = (point.method == Method::newton && point.spacing < 0.2e-3) ||
                        (point.method == Method::active_set && point.spacing < 0.6e-3);
    CHECK((point.status == AccuracyStatus::converged) == !failed);
    CHECK(std::isfinite(point.error) == !failed);
  }
  const std::string text = accuracy_text(report, false);
  CHECK_THAT(text, Catch::Contains("newton at 176.8 µm: not_converged: stopped after 3 iterations"));
  CHECK_THAT(text, Catch::Contains("active_set at 500 µm: failed: crashed: SIGSEGV"));
}

TEST_CASE("an answer that violates a law of contact is no reference", "[studies][accuracy]") {
  LawfulMeasure lawful;
  const Measure measure = [&](const RollingScene& scene, double limit) {
    Measurement measured = lawful(scene, limit);
    measured.solution.law_violation = 1e-3;
    return measured;
  };
  const AccuracyReport report = measure_accuracy("scene", periodic_cylinder(), {}, measure);
  CHECK_FALSE(report.reference.found());
  CHECK(accuracy_chart(report).curves.empty());
  CHECK_THAT(accuracy_text(report, false), Catch::Contains("no answer can be trusted"));
}

TEST_CASE("no solution is started that its growth says will take longer than the limit", "[studies][accuracy]") {
  AccuracyOptions options;
  options.repeats = 1;
  options.seconds_limit = 3;
  LawfulMeasure lawful;
  const AccuracyReport report = measure_accuracy("scene", periodic_cylinder(), options, std::ref(lawful));
  CHECK(lawful.stopped == 0);
  CHECK(lawful.longest <= options.seconds_limit);
  for (const AccuracyPoint& point : report.points) {
    CAPTURE(name_of(point.method), point.spacing, point.reason);
    const bool in_time = laws.at(point.method).seconds(point.spacing) <= options.seconds_limit;
    CHECK((point.status == AccuracyStatus::converged) == in_time);
    CHECK((point.status == AccuracyStatus::skipped) == !in_time);
    CHECK(point.reason.empty() == in_time);
  }
}

TEST_CASE("a solution that runs into the limit unforeseen ends its method alone", "[studies][accuracy]") {
  LawfulMeasure lawful;
  int late = 0;
  const Measure measure = [&](const RollingScene& scene, double limit) {
    Measurement measured = lawful(scene, limit);
    if (scene.method == Method::active_set && *scene.spacing < 0.4e-3) {
      ++late;
      measured = {};
      measured.stopped = true;
      measured.failure = "stopped at the limit";
    }
    return measured;
  };
  const AccuracyReport report = measure_accuracy("scene", periodic_cylinder(), unlimited, measure);
  CHECK(late == 1);
  for (const AccuracyPoint& point : report.points)
    CHECK((point.status == AccuracyStatus::skipped) == (point.method == Method::active_set && point.spacing < 0.4e-3));
}

TEST_CASE("the time of a solution is the median of its repeats, which end with the limit", "[studies][accuracy]") {
  AccuracyOptions options{.methods = {Method::newton}, .spacings = {1e-3}, .repeats = 3};
  std::vector<double> times{1, 9, 2};
  std::size_t calls = 0;
  const Measure measure = [&](const RollingScene& scene, double limit) {
    Measurement measured = LawfulMeasure()(scene, limit);
    if (*scene.spacing == 1e-3) measured.seconds = times.at(calls++ % times.size());
    return measured;
  };
  const RollingScene scene = periodic_cylinder();
  CHECK(measure_accuracy("scene", scene, options, measure).points.at(0).seconds == 2);
  calls = 0;
  options.seconds_limit = 10;
  const AccuracyPoint ended = measure_accuracy("scene", scene, options, measure).points.at(0);
  CHECK(ended.repeats == 2);
  CHECK(ended.seconds == 5);
}

TEST_CASE("rows and tables hold every method at every spacing", "[studies][accuracy]") {
  AccuracyOptions options;
  options.levels = 4;
  const AccuracyReport report = measured_by_laws(options);
  const Table rows = accuracy_rows({report, report});
  REQUIRE(rows.rows.size() == 2 * 3 * 4);
  for (const auto& row : rows.rows) CHECK(row.size() == rows.columns.size());

  std::istringstream lines(accuracy_text(report, true));
  std::string line;
  int table_lines = 0;
  while (std::getline(lines, line))
    if (line.starts_with("|")) {
      CHECK(std::count(line.begin(), line.end(), '|') == 2 + 3 * 3 + 1);
      ++table_lines;
    }
  CHECK(table_lines == 2 + 4);
  REQUIRE(accuracy_chart(report).curves.size() == 3);
  for (const ChartCurve& curve : accuracy_chart(report).curves) CHECK(curve.points.size() == 4);
}

TEST_CASE("a spacing that breaks a rule and a scene without losses are refused", "[studies][accuracy]") {
  const RollingScene scene = periodic_cylinder();
  CHECK_THAT(message_of([&] { measure_accuracy("scene", scene, {.spacings = {1.0}}, LawfulMeasure()); }),
             Catch::Contains("scene: spacing = 1: must be at most a fifth of the radius"));
  const Measure lossless = [](const RollingScene& at, double limit) {
    Measurement measured = LawfulMeasure()(at, limit);
    measured.solution.rolling_resistance = 1e-15;
    return measured;
  };
  CHECK_THAT(message_of([&] { measure_accuracy("scene", scene, {}, lossless); }), Catch::Contains("without losses"));
}

TEST_CASE("a cylinder's errors are measured against the spectral method, which has tolerances in place of spacings",
          "[studies][accuracy]") {
  LawfulMeasure lawful;
  const double true_resistance = exact * (1 + 1e-5);
  const Measure measure = [&](const RollingScene& scene, double limit) {
    if (scene.method != Method::spectral) return lawful(scene, limit);
    CHECK_FALSE(scene.spacing);
    Measurement measured;
    measured.seconds = measured.processor_seconds = 1e-3;
    measured.peak_memory = 1e6;
    measured.solution = closed_form(scene);
    measured.solution.method = Method::spectral;
    measured.solution.rolling_resistance = true_resistance * (1 + 0.1 * *scene.tolerance);
    measured.solution.error_estimate = 0.5 * *scene.tolerance;
    measured.solution.contact_nodes = 12;
    measured.solution.law_violation = 1e-10;
    return measured;
  };
  AccuracyOptions options = unlimited;
  options.levels = 3;
  const AccuracyReport report = measure_accuracy("scene", example_scene("paper_cylinder"), options, measure);
  CHECK(report.reference.method == Method::spectral);
  CHECK(report.reference.rolling_resistance == Approx(true_resistance).epsilon(1e-11));
  CHECK(report.reference.uncertainty == 5e-12);
  int by_tolerance = 0;
  for (const AccuracyPoint& point : report.points) {
    if (point.method != Method::spectral) {
      CHECK(point.error == Approx(laws.at(point.method).resistance(point.spacing) / true_resistance - 1).epsilon(1e-6));
      continue;
    }
    ++by_tolerance;
    // Rounding of a quotient near 1
    CHECK(point.error == Approx(0.1 * point.tolerance).margin(2e-12));
  }
  CHECK(by_tolerance == 9);
  CHECK(accuracy_text(report, false).find("tolerance  nodes  spectral: error") != std::string::npos);
  CHECK(accuracy_chart(report).curves.size() == 4);
}

TEST_CASE("where a grid answers in place of the spectral method, it is no reference", "[studies][accuracy]") {
  LawfulMeasure lawful;
  const Measure measure = [&](RollingScene scene, double limit) {
    const bool gridless = scene.method == Method::spectral;
    if (gridless) {
      scene.method = Method::newton;
      scene.spacing = 1e-4;
    }
    Measurement measured = lawful(scene, limit);
    measured.solution.method = scene.method;
    return measured;
  };
  const AccuracyReport report = measure_accuracy("scene", example_scene("paper_cylinder"), unlimited, measure);
  CHECK(report.reference.method == Method::newton);
  const AccuracyPoint& left = *std::find_if(report.points.begin(), report.points.end(), [](const AccuracyPoint& point) {
    return point.method == Method::spectral;
  });
  CHECK(left.status == AccuracyStatus::not_converged);
  CHECK(left.reason == "left to method newton");
}
