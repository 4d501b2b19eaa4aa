#include <cmath>
#include <fstream>

#include "studies/charts/scatter_chart.hpp"
#include "studies/charts/study_chart.hpp"
#include "studies/stored/scatter_report.hpp"
#include "studies/stored/scatter_results.hpp"
#include "studies/text/strict_json.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

/// A resistance that is linear in modulus and load: exact in its mean, its deviation and its quantiles.
RollingSolution linear(const RollingScene& scene) {
  RollingSolution solution = closed_form(scene);
  solution.rolling_resistance = scene.speed * (1e-4 * *scene.static_shear_modulus + 0.01 * *scene.load);
  solution.peak_pressure = *scene.static_shear_modulus;
  return solution;
}

/// The same without an answer where the modulus is above 1.2 MPa.
RollingSolution failing(const RollingScene& scene) {
  RollingSolution solution = linear(scene);
  if (*scene.static_shear_modulus < 1.2e6) return solution;
  solution.status = Status::not_converged;
  solution.reason = "too stiff";
  return solution;
}

struct Files {
  TemporaryDirectory directory;
  std::string study = (directory.path / "study.json").string(), database = (directory.path / "results.db").string();

  explicit Files(const std::string& axes = "") {
    std::ofstream(study) << R"({"study": "s", "scene": {"indenter": "cylinder", "radius": "10 cm",
      "layer_thickness": "1 cm", "layer_density": 1000, "static_shear_modulus": "1 MPa", "stiffening": 2,
      "creep_time": "0.1 s", "speed": 1, "load": "10 kN/m", "friction_coefficient": 0.3, "drive": "top_force"},)"
                         << axes << R"(
      "uncertain": {"static_shear_modulus": {"normal": "10 %"}, "load": {"normal": "5 %"}, "points": 512,
                    "correlation": [["static_shear_modulus", "load", 0.6]],
                    "probability": ["peak_pressure > 1.1 MPa"]}})";
  }
  ProgramRun run(std::vector<std::string> words, const Evaluate& evaluate = linear) const {
    words.insert(words.begin(), {"scatter", study, "--db", database});
    return run_rollres(words, evaluate);
  }
};

}  // namespace

TEST_CASE("scatter of a linear case is that of its closed form", "[studies][command_scatter]") {
  const Files files;
  const ProgramRun run = files.run({"--json"});
  REQUIRE(run.status == 0);
  const Json json = parse_object(run.out, "output");
  CHECK(json["solved"] == 512);
  const Json& place = json["places"][0];
  const Json& found = place["outputs"][0];
  // R = 100 N/m (1 + 0.1 z1) + 100 N/m (1 + 0.05 z2): variance 10^2 + 5^2 + 2 0.6 10 5 = 185
  const double deviation = std::sqrt(185.0), z = 1.2815515655446004;
  const auto check = [](const Json& estimate, double exact, double widest) {
    CHECK(std::abs(estimate["value"].get<double>() - exact) <= estimate["error"].get<double>());
    CHECK(estimate["error"].get<double>() < widest);
  };
  check(found["mean"], 200, 0.1);
  check(found["standard_deviation"], deviation, 0.3);
  check(found["P10"], 200 - z * deviation, 1.5);
  check(found["P50"], 200, 1);
  check(found["P90"], 200 + z * deviation, 1.5);
  check(place["probabilities"][0], 0.15865525393145705, 0.02);  // Phi(-1)
  CHECK(files.run({"--json"}).out.find("\"recalled\": 512") != std::string::npos);
}

TEST_CASE("formulas of a study scatter as its outputs do", "[studies][command_scatter]") {
  const Files files(R"("compute": ["rolling_resistance", {"per_load": "rolling_resistance / load"}],)");
  const ProgramRun all = files.run({"--json"}), one = files.run({"--output", "2 * per_load", "--json"});
  REQUIRE(all.status == 0);
  REQUIRE(one.status == 0);
  const Json outputs = Json::parse(all.out)["places"][0]["outputs"],
             doubled = Json::parse(one.out)["places"][0]["outputs"];
  REQUIRE(outputs.size() == 2);
  CHECK(outputs[1]["output"] == "per_load");
  CHECK(doubled[0]["mean"]["value"].get<double>() ==
        Approx(2 * outputs[1]["mean"]["value"].get<double>()).epsilon(1e-12));
  const ProgramRun inside = files.run({"--output", "bond_shear"});
  CHECK(inside.status == 2);
  CHECK_THAT(inside.err, Catch::Contains("--output: bond_shear is not computed: interior = on computes it"));
}

TEST_CASE("a scatter is told in words, with its errors and its distributions", "[studies][command_scatter]") {
  const Files files(R"("axes": {"speed": [1, 2]},)");
  const ProgramRun run = files.run({"--quantiles", "2.5,97.5", "--output", "rolling_resistance / load"});
  REQUIRE(run.status == 0);
  CHECK(run.out.find("s: 8 x 64 points (sobol, seed 1) at each of 2 places\n"
                     "  static_shear_modulus: normal, mean 1 MPa, standard deviation 100 kPa\n"
                     "  load: normal, mean 10 kN/m, standard deviation 500 N/m\n"
                     "  static_shear_modulus and load: correlation 0.6\n") == 0);
  CHECK(run.out.find("rolling_resistance / load\n  speed  mean") != std::string::npos);
  CHECK(run.out.find("P2.5") != std::string::npos);
  CHECK(run.out.find("probability [%]\n  speed  peak_pressure > 1.1 MPa\n  1 m/s  15.") != std::string::npos);
}

TEST_CASE("points without an answer are counted, and the numbers said to be of the others",
          "[studies][command_scatter]") {
  const Files files;
  const ProgramRun run = files.run({}, failing);
  CHECK(run.status == 1);
  const int failed = std::stoi(run.err);
  CHECK(failed ==
        Approx(512 * 0.022750131948179195).margin(4.3));  // Phi(-2); three standard deviations of a stratified count
  CHECK(run.err.find(" of 512 points have no answer; the numbers are of the others") != std::string::npos);
  CHECK(run.err.find(std::to_string(failed) + " x too stiff") != std::string::npos);
  CHECK(run.out.find("without\n") != std::string::npos);
}

TEST_CASE("a study whose inputs scatter is drawn with bands, a histogram and a cumulative distribution",
          "[studies][command_scatter]") {
  const Files files(R"("axes": {"speed": [1, 2, 3]},)");
  REQUIRE(files.run({}).status == 0);
  ResultStore store(files.database, Access::read);
  const ChartRequest bands = stored_chart(store, {}).request;
  CHECK(bands.areas == "P10 to P90, line: median");
  REQUIRE(bands.curves.size() == 1);
  REQUIRE(bands.curves[0].points.size() == 3);
  const double deviation = std::sqrt(185.0), z = 1.2815515655446004;
  for (const ChartPoint& point : bands.curves[0].points) {
    CHECK(point.y == Approx(200 * point.x).epsilon(0.005));
    CHECK(point.low == Approx((200 - z * deviation) * point.x).epsilon(0.01));
    CHECK(point.high == Approx((200 + z * deviation) * point.x).epsilon(0.01));
  }
  const ChartRequest cloud = stored_chart(store, {.x = "peak_pressure"}).request;
  CHECK_FALSE(cloud.lines);

  const ScatterPicture picture{"s", {.name = "number"}, "N", {"a"}, {{{1000, 2000}, {3000, 4000}}}, ""};
  const ChartRequest cumulative = cumulative_chart(picture), histogram = histogram_chart(picture);
  CHECK(cumulative.x.unit == "kN");
  CHECK(cumulative.curves[0].points[1].x == 2);
  CHECK(cumulative.curves[0].points[1].y == 37.5);
  CHECK(histogram.curves[0].points.front().y == 0);
  double area = 0;
  for (std::size_t i = 1; i + 1 < histogram.curves[0].points.size(); i += 2) area += histogram.curves[0].points[i].y;
  CHECK(area == Approx(100));
}

TEST_CASE("a number and its error share their last digit", "[studies][scatter_report]") {
  CHECK(with_error({401.1234, 0.314}) == "401.12 ± 0.31");
  CHECK(with_error({430.3, 13}) == "430 ± 13");
  CHECK(with_error({12345, 678}) == "12350 ± 680");
  CHECK(with_error({50, 3.5}) == "50.0 ± 3.5");
  CHECK(with_error({2e6, 1e4}, 1e6) == "2.000 ± 0.010");
  CHECK(with_error({2, std::nan("")}) == "2");
  CHECK(with_error({std::nan(""), 1}) == "-");
  CHECK(quantile_name(0.025) == "P2.5");
}

TEST_CASE("a study without uncertain inputs is no scatter, and wrong words are refused", "[studies][command_scatter]") {
  const Files files;
  const std::string plain = (source_directory() / "studies/examples/conveyor_belt.json").string();
  const ProgramRun run = run_rollres({"scatter", plain, "--db", files.database}, linear);
  CHECK(run.status == 2);
  CHECK(run.err.find("conveyor_belt.json: uncertain is missing: no input of this study scatters") != std::string::npos);
  CHECK(files.run({"--quantiles", "0"}).err.find("--quantiles = 0: must be numbers between 0 and 100") !=
        std::string::npos);
  CHECK(files.run({"--output", "rolling_resistence"}).err.find("did you mean rolling_resistance?") !=
        std::string::npos);
  CHECK(files.run({"--probability", "load"}).status == 2);
}

TEST_CASE("the example of a scatter is solved in full", "[studies][command_scatter]") {
  const Files files;
  const std::string example = (source_directory() / "studies/examples/rubber_scatter.json").string();
  const ProgramRun run = run_rollres({"scatter", example, "--db", files.database, "--json"}, closed_form);
  REQUIRE(run.status == 0);
  CHECK(parse_object(run.out, "output")["points"] == 7 * 64);
}
