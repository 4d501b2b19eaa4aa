#include "studies/predict/fit_prediction.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "db/rows/schema.hpp"
#include "fitting/errors/statistics.hpp"
#include "fitting/fit/noise_fit.hpp"
#include "studies/fit/fit_record.hpp"
#include "studies/predict/prediction_report.hpp"
#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"
#include "tests/studies/half_space_fit.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers predicted_scenes, prediction_report and fit_predictions, too.

using namespace rollres;
using Catch::Contains;
using nlohmann::json;

namespace {

/// A resistance in proportion to modulus and speed: 50 N/m at 1 MPa and 1 m/s.
RollingSolution straight_line(const RollingScene& scene) {
  RollingSolution solution;
  solution.rolling_resistance = 5e-5 * *scene.static_shear_modulus * scene.speed;
  solution.status = Status::converged;
  return solution;
}

constexpr std::array<double, 8> line_speeds{1, 2, 3, 4, 5, 6, 7, 8};
constexpr std::array<double, 8> line_resistances{71, 118.5, 172, 219, 269, 321.5, 370, 419.5};

/// A fit of the modulus and of an offset to the values above: a straight line through them.
struct LineFit {
  TemporaryDirectory directory;
  std::string database = (directory / "fit.db").string();

  explicit LineFit(const json& parameters = {{"static_shear_modulus", "1.2 MPa"}, {"offset", json::object()}}) {
    std::string table = "speed [m/s],rolling_resistance [N/m]\n";
    for (std::size_t i = 0; i < line_speeds.size(); ++i)
      table += std::to_string(line_speeds[i]) + "," + std::to_string(line_resistances[i]) + "\n";
    directory.write("table.csv", table);
    json fit = half_space_fit();
    fit["fit"] = "line";
    fit["parameters"] = parameters;
    directory.write("fit.json", fit.dump());
    directory.write("asked.csv", "speed [m/s]\n2\n10\n");
  }
  ProgramRun run(const std::string& fit, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"fit", fit, "--db", database};
    words.insert(words.end(), more.begin(), more.end());
    return run_rollres(words, straight_line);
  }
  std::string file(const char* name) const { return (directory / name).string(); }
  json predictions(const std::string& fit, std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--predict", file("asked.csv"), "--json"});
    return json::parse(run(fit, more).out).at("predictions");
  }
};

/// The regression line of the values above, as textbooks have it (Draper and Smith 1998, sections 1.3 and 1.4).
struct Regression {
  double count = 8, mean = 4.5, squares = 42, slope = 0, level = 0, scatter = 0;
  double quantile = two_sided_quantile(0.95, 6);

  Regression() {
    const double mean_value = std::accumulate(line_resistances.begin(), line_resistances.end(), 0.0) / count;
    for (std::size_t i = 0; i < 8; ++i) slope += (line_speeds[i] - mean) * line_resistances[i] / squares;
    level = mean_value - slope * mean;
    for (std::size_t i = 0; i < 8; ++i)
      scatter += std::pow(line_resistances[i] - slope * line_speeds[i] - level, 2) / (count - 2);
    scatter = std::sqrt(scatter);
  }
  double error_of_slope() const { return scatter / std::sqrt(squares); }
  double error_of_line(double speed) const {
    return scatter * std::sqrt(1 / count + std::pow(speed - mean, 2) / squares);
  }
};

}  // namespace

TEST_CASE("predictions of a straight line are those of linear regression, by a fit just made and by a stored one",
          "[studies][fit][predict]") {
  const LineFit fit;
  const Regression line;
  const auto check = [&](const json& found, double speed, double value, double error) {
    CHECK(found["speed"] == speed);
    CHECK(found["value"].get<double>() == Approx(value).epsilon(1e-5));
    CHECK(found["standard_error"].get<double>() == Approx(error).epsilon(1e-3));
    CHECK(found["lowest"].get<double>() == Approx(value - line.quantile * error).epsilon(1e-4));
    CHECK(found["highest"].get<double>() == Approx(value + line.quantile * error).epsilon(1e-4));
  };
  for (const std::string& name : {fit.file("fit.json"), std::string("line")}) {
    const json truth = fit.predictions(name), reading = fit.predictions(name, {"--predict-as", "reading"}),
               next = fit.predictions(name, {"--predict-as", "measurement"});
    for (const std::size_t i : {0, 1}) {
      const double speed = i == 0 ? 2 : 10, error = line.error_of_line(speed);
      check(truth[i], speed, line.slope * speed, line.error_of_slope() * speed);
      check(reading[i], speed, line.slope * speed + line.level, error);
      check(next[i], speed, line.slope * speed + line.level, std::hypot(error, line.scatter));
    }
  }
}

TEST_CASE("a scene, the points of a study and rows of a table are predicted alike", "[studies][fit][predict]") {
  const LineFit fit;
  REQUIRE(fit.run(fit.file("fit.json")).status == 0);
  json scene = half_space_fit()["scene"];
  scene["speed"] = 10;
  scene["static_shear_modulus"] = "9 MPa";  // the fit's stands in its place
  const json study{{"study", "s"}, {"scene", scene}, {"axes", {{"speed", {2, 10}}}}};
  scene.erase("static_shear_modulus");
  const std::string scene_file = fit.directory.write("scene.json", scene.dump()).string(),
                    study_file = fit.directory.write("study.json", study.dump()).string();
  const json rows = fit.predictions("line");
  const auto asked = [&](const std::string& file) {
    return json::parse(fit.run("line", {"--predict", file, "--json"}).out).at("predictions");
  };
  CHECK(asked(scene_file)[0]["value"] == rows[1]["value"]);
  CHECK(asked(scene_file)[0]["standard_error"] == rows[1]["standard_error"]);
  REQUIRE(asked(study_file).size() == 2);
  CHECK(asked(study_file)[1]["lowest"] == rows[1]["lowest"]);
  const ProgramRun told = fit.run("line", {"--predict", fit.file("asked.csv")});
  CHECK(told.status == 0);
  CHECK_THAT(told.out, Contains("without offset and scale") && Contains("10 m/s") && Contains("95 %"));
}

TEST_CASE("what cannot be predicted is refused with file, key and rule", "[studies][fit][predict]") {
  const LineFit fit;
  REQUIRE(fit.run(fit.file("fit.json")).status == 0);
  const auto refusal = [&](const std::string& table) {
    const ProgramRun run = fit.run("line", {"--predict", fit.directory.write("asked.csv", table).string()});
    CHECK(run.status == 2);
    return run.err;
  };
  CHECK_THAT(refusal("load [kN/m]\n10\n"), Contains("speed: is missing: it varies between the data"));
  CHECK_THAT(refusal("speed [m/s],static_shear_modulus [MPa]\n1,1\n"), Contains("static_shear_modulus: is fitted"));
  CHECK_THAT(refusal("speed [m/s],loud [kN/m]\n1,1\n"), Contains("loud: unknown column"));
  CHECK_THAT(refusal("speed [m/s],data\n1,rig\n"), Contains("line 2: data = rig: no data set of the fit"));
  CHECK_THAT(refusal("speed [m/s],sigma [%]\n1,2\n"), Contains("sigma: a part needs the measured values"));
  CHECK_THAT(fit.run("lime", {"--predict", fit.file("asked.csv")}).err, Contains("holds no fit of this name"));
}

TEST_CASE("the chart of predictions has the data without offset where true values are predicted",
          "[studies][fit][predict]") {
  const LineFit fit;
  REQUIRE(fit.run(fit.file("fit.json")).status == 0);
  const auto stored = find_fit(open_database(fit.database, Access::read), "line", FitParts::with_data);
  REQUIRE(stored);
  const Regression line;
  for (const PredictedAs as : {PredictedAs::true_value, PredictedAs::reading}) {
    const ChartRequest chart =
        prediction_chart(*stored, predictions_of(*stored, fit.file("asked.csv"), as, "", straight_line));
    REQUIRE(chart.curves.size() == 2);
    CHECK(chart.x.name == "speed");
    CHECK(chart.curves[0].points.size() == 2);
    CHECK(chart.curves[0].points[1].x == 10);
    CHECK(chart.curves[0].points[1].area());
    const double left_out = as == PredictedAs::true_value ? line.level : 0;
    CHECK(chart.curves[1].points[0].y == Approx(71 - left_out).epsilon(1e-4));
  }
}

TEST_CASE("what scatters by a fit with offset and noise are the inputs of the scene alone, as they are known",
          "[studies][fit][predict][scatter]") {
  const LineFit fit({{"static_shear_modulus", "1.2 MPa"}, {"offset", json::object()}, {"noise_level", json::object()}});
  REQUIRE(fit.run(fit.file("fit.json")).status == 0);
  json study{{"study", "s"}, {"scene", half_space_fit()["scene"]}};
  study["scene"]["speed"] = 10;
  study["uncertain"] = {{"fit", {{"name", "line"}, {"db", "fit.db"}}}, {"points", 512}};
  const std::string file = fit.directory.write("study.json", study.dump()).string();
  const ProgramRun run =
      run_rollres({"scatter", file, "--db", (fit.directory / "s.db").string(), "--json"}, straight_line);
  REQUIRE(run.status == 0);
  const json found = json::parse(run.out)["places"][0]["outputs"][0];
  const Regression line;
  CHECK(found["mean"]["value"].get<double>() == Approx(10 * line.slope).epsilon(1e-3));
  CHECK(found["standard_deviation"]["value"].get<double>() == Approx(10 * line.error_of_slope()).epsilon(0.02));
}

TEST_CASE("of 200 draws with an offset, 93 to 97 % of true values, readings and measurements lie within 95 %",
          "[studies][fit][predict][coverage]") {
  // Noise of a level and a part, both fitted, or given. 12 scenes each, inside and outside the data.
  const bool fitted = GENERATE(true, false);
  constexpr double offset = 20, level = 2, part = 0.02;
  constexpr int draws = 200;
  FitFile file;
  file.name = "drawn";
  file.definition = R"({"data": "rig.csv"})";
  file.scenes = measured(quick_resistance, spread_speeds(0.01, 2, 12), {5e3, 1e4, 2e4});
  file.inputs = zener_inputs();
  const double truths[] = {1e6, 2, 0.1};
  for (std::size_t j = 0; j < 3; ++j) file.inputs[j].start = truths[j];
  file.inputs.push_back({{"offset"}});
  file.deviations_known = !fitted;
  file.options = {.profiles = false};
  if (fitted) file.noise = {{"noise_level", ""}, {"relative_noise", ""}};
  std::vector<AskedScene> asked;
  for (const double load : {3e3, 1.5e4, 4e4})
    for (const double speed : {0.005, 0.1, 1.0, 4.0}) {
      asked.push_back({.scene = {half_space_scene(speed, load), {}, "rig"}});
      const double reading = quick_resistance(asked.back().scene.scene).rolling_resistance + offset;
      if (!fitted) asked.back().deviation = std::hypot(level, part * reading);
    }
  std::vector<double> exact;
  for (MeasuredScene& row : file.scenes) {
    row.set = "rig";
    row.output = file.output;
    exact.push_back(row.measured.value + offset);
  }
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  int held[3] = {}, all = 0;
  for (int draw = 0; draw < draws; ++draw) {
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double deviation = std::hypot(level, part * exact[i]);
      file.scenes[i].measured.value = exact[i] + deviation * normal(random);
      file.scenes[i].measured.deviation = fitted ? 1 : deviation;
    }
    const FitReport report = fit(problem_of(file, quick_resistance, 1), file);
    REQUIRE(report.status >= FitStatus::usable_with_warnings);
    const FitRecord record = with_report(begun_fit(file), report, file.body());
    for (const PredictedAs as : {PredictedAs::true_value, PredictedAs::reading, PredictedAs::measurement}) {
      const std::vector<PredictedScene> found = predicted(record, file.output, asked, as, quick_resistance, 1);
      for (std::size_t i = 0; i < asked.size(); ++i) {
        double value = quick_resistance(asked[i].scene.scene).rolling_resistance;
        if (as != PredictedAs::true_value) value += offset;
        if (as == PredictedAs::measurement) value += std::hypot(level, part * value) * normal(random);
        held[static_cast<int>(as)] += value > found[i].lowest && value < found[i].highest;
        all += as == PredictedAs::true_value;
      }
    }
  }
  for (const int count : held) {
    CHECK(count > 0.93 * all);
    CHECK(count < 0.97 * all);
  }
}
