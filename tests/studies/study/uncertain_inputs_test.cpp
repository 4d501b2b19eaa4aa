#include "studies/study/uncertain_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "db/rows/fit_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/text/strict_json.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/study_points.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers trusted_fit, too.

using namespace rollres;

namespace {

const std::string scene =
    R"({"indenter": "cylinder", "radius": "10 cm", "layer_thickness": "1 cm", "layer_density": 1000,
  "static_shear_modulus": "3 MPa", "stiffening": 2, "creep_time": "0.25 s", "speed": 1, "load": "10 kN/m",
  "friction_coefficient": 0.3, "drive": "top_force"})";

/// A study with this under "uncertain".
Study scattering_study(const std::string& uncertain, const std::string& more = "") {
  const TemporaryDirectory directory;
  const auto file = directory.path / "study.json";
  std::ofstream(file) << R"({"study": "s", "scene": )" << scene << more << R"(, "uncertain": {)" << uncertain << "}}";
  return read_study(file);
}

std::string scatter_refusal(const std::string& uncertain, const std::string& more = "") {
  const std::string message = message_of([&] { StudyPlan{scattering_study(uncertain, more)}; });
  const std::size_t place = message.find("uncertain: ");
  return place == std::string::npos ? message : message.substr(place + 11);
}

double distributed(const std::string& distribution, double probability,
                   const std::string& key = "static_shear_modulus") {
  const Study study = scattering_study('"' + key + R"(": {)" + distribution + "}");
  return quantile(study.uncertain.inputs.at(0).own(), probability);
}

}  // namespace

TEST_CASE("uncertain inputs have the distributions that the file writes", "[studies][uncertain_inputs]") {
  const double z = 1.2815515655446004;  // normal quantile at 0.9
  CHECK(distributed(R"("normal": ["3 MPa", "10 %"])", 0.9) == Approx(3e6 + z * 3e5));
  CHECK(distributed(R"("normal": ["3 MPa", "200 kPa"])", 0.9) == Approx(3e6 + z * 2e5));
  CHECK(distributed(R"("normal": [3e6, 2e5])", 0.9) == Approx(3e6 + z * 2e5));
  CHECK(distributed(R"("normal": "5 %")", 0.9) == Approx(3e6 * (1 + z * 0.05)));
  CHECK(distributed(R"("lognormal": ["2 MPa", "20 %"])", 0.9) == Approx(2e6 * std::exp(z * 0.2)));
  CHECK(distributed(R"("lognormal": ["20 %"])", 0.9) == Approx(3e6 * std::exp(z * 0.2)));
  CHECK(distributed(R"("uniform": ["2 MPa", "4 MPa"])", 0.9) == Approx(3.8e6));
  CHECK(distributed(R"("uniform": ["-10 %", "10 %"])", 0.9) == Approx(3e6 * 1.08));
  CHECK(distributed(R"("loguniform": ["1 MPa", "100 MPa"])", 0.5) == Approx(1e7));
  CHECK(distributed(R"("triangular": ["2 MPa", "3 MPa", "4 MPa"])", 0.5) == Approx(3e6));
  CHECK(distributed(R"("uniform": [0.1, 0.3])", 0.5, "friction_coefficient") == Approx(0.2));
}

TEST_CASE("points of a study are those of its distributions at every place of its axes",
          "[studies][uncertain_inputs]") {
  const Study study = scattering_study(
      R"("static_shear_modulus": {"normal": ["3 MPa", "10 %"]}, "creep_time": {"lognormal": "20 %"},
         "correlation": [["creep_time", "static_shear_modulus", 0.7]], "points": 256, "seed": 4)",
      R"(, "axes": {"speed": [1, 2]})");
  const auto scenes = points(study);
  REQUIRE(scenes.size() == 512);
  double mean = 0, both = 0;
  for (std::size_t i = 0; i < 256; ++i) {
    CHECK(scenes[i].speed == 1);
    CHECK(scenes[256 + i].speed == 2);
    CHECK(scenes[i].static_shear_modulus == scenes[256 + i].static_shear_modulus);
    const double g = (*scenes[i].static_shear_modulus - 3e6) / 3e5, t = std::log(scenes[i].creep_time / 0.25) / 0.2;
    mean += g / 256;
    both += g * t / 256;
  }
  CHECK(mean == Approx(0).margin(0.02));  // plain draws: 0.06
  CHECK(both == Approx(0.7).margin(0.05));
  CHECK(StudyPlan(study).combination(300) == 300);
}

TEST_CASE("what cannot scatter so is refused with its place, value and rule", "[studies][uncertain_inputs]") {
  const auto of_modulus = [](const std::string& text) {
    return scatter_refusal(R"("static_shear_modulus": {)" + text + "}");
  };
  CHECK(
      of_modulus(R"("normal": ["3 MPa", "60 %"])") ==
      R"(static_shear_modulus: normal = ["3 MPa","60 %"]: 4.78 % of its weight is outside its range (must be > 0): take )"
      R"(another distribution, or "truncated": true to cut it off there)");
  CHECK(of_modulus(R"("normal": ["3 MPa", "60 %"], "truncated": true)") == "nothing");
  CHECK(of_modulus(R"("normal": ["3 mm", "10 %"])") ==
        R"(static_shear_modulus: static_shear_modulus = "3 mm": must have a unit of stress (Pa))");
  CHECK(of_modulus(R"("normal": ["3 MPa"])") ==
        R"(static_shear_modulus: normal = ["3 MPa"]: must be [mean, standard deviation], or a share as in "10 %")");
  CHECK(
      of_modulus(R"("lognormal": ["3 MPa", "1 MPa"])") ==
      R"(static_shear_modulus: lognormal = "1 MPa": the standard deviation of the logarithm has no unit: 0.1 or 10 %)");
  CHECK(of_modulus(R"("uniform": ["3 MPa", "2 MPa"])").ends_with("the second number must be larger than the first"));
  CHECK(
      of_modulus(R"("gamma": [1, 2])") ==
      R"(static_shear_modulus: gamma = [1,2]: unknown key; known are normal, lognormal, uniform, loguniform, triangular, truncated)");
  CHECK(of_modulus(R"("normal": "5 %", "uniform": [1, 2])")
            .ends_with("must be an object with one of normal, lognormal, "
                       "uniform, loguniform, triangular"));
  CHECK(scatter_refusal(R"("static_shear_modulu": {"normal": "5 %"})") ==
        R"(static_shear_modulu = {"normal":"5 %"}: unknown key; did you mean static_shear_modulus?)");
  CHECK(scatter_refusal(R"("friction_coefficient": {"uniform": ["10 %", "20 %"]})")
            .ends_with("has no unit: write its values as plain numbers, 0.1 for 10 %"));
  CHECK(scatter_refusal(R"("method": "sobol")").ends_with("must have at least one input"));
  const std::string one = R"("load": {"normal": "5 %"}, )";
  CHECK(scatter_refusal(one + R"("points": 33)") ==
        R"(points = 33: must be a multiple of the 8 scramblings: 40, or give other "scramblings")");
  CHECK(scatter_refusal(one + R"("correlation": [["load", "speed", 0.5]])") ==
        R"(correlation = ["load","speed",0.5]: speed is none of the uncertain inputs)");
  CHECK(scatter_refusal(one + R"("speed": {"normal": "1 %"}, "correlation": [["load", "speed", 1]])") ==
        R"(correlation = ["load","speed",1]: must lie between -1 and 1)");
  CHECK(scatter_refusal(one + R"("probability": ["peak_pressure > 3 mm"])") ==
        R"(probability: 3 mm: must have a unit of stress (Pa) for peak_pressure)");
  CHECK(
      scatter_refusal(R"("load": {"normal": "5 %"})", R"(, "axes": {"load": [1e4, 2e4]})").ends_with("varies already"));
  CHECK(scatter_refusal(R"("load": {"normal": "5 %"})", R"(, "axes": {"indenter": ["cylinder"]})")
            .ends_with("cannot be an axis where inputs are uncertain"));
}

TEST_CASE("the parameters of a stored fit scatter by its covariance", "[studies][uncertain_inputs]") {
  const TemporaryDirectory directory;
  FitRecord fit{.name = "rubber",
                .kind = "resistance",
                .definition = "{}",
                .data_digest = "d",
                .status = "USABLE",
                .reason = {},
                .warnings = {},
                .weakest_direction = {},
                .chi_squared = 1,
                .reduced_chi_squared = 1,
                .p_value = 1,
                .rms = 1,
                .runs_p_value = 1,
                .condition = 1,
                .noise = 0,
                .seconds = 1,
                .parameters = {},
                .correlations = {{"static_shear_modulus", "creep_time", -0.9}},
                .data = {},
                .profiles = {},
                .curves = {},
                .inputs = {}};
  fit.parameters.push_back({.name = "static_shear_modulus", .unit = "Pa", .value = 3e6, .standard_error = 3e5});
  fit.parameters.push_back({.name = "creep_time", .unit = "s", .value = 0.25, .standard_error = 0.01});
  fit.parameters.push_back({.name = "stiffening", .unit = "1", .value = 2, .standard_error = 0.1});
  const auto database = directory.path / "fits.db";
  save_fit(open_database(database, Access::write), fit);

  const auto file = directory.path / "study.json";
  std::ofstream(file) << R"({"study": "s", "scene": )" << scene
                      << R"(, "uncertain": {"fit": {"name": "rubber", "db": "fits.db"}, "points": 32}})";
  const Study study = read_study(file);
  REQUIRE(study.uncertain.inputs.size() == 3);
  CHECK(
      in_words(study.uncertain, Indenter::cylinder) ==
      std::vector<std::string>{"static_shear_modulus: lognormal, median 3 MPa, standard deviation of the logarithm 0.1",
                               "creep_time: lognormal, median 250 ms, standard deviation of the logarithm 0.04",
                               "stiffening: normal, mean 2, standard deviation 0.1",
                               "static_shear_modulus and creep_time: correlation -0.9"});
  // What is stored needs the fit no more.
  CHECK(study.definition.find("fits.db") == std::string::npos);
  CHECK(study.definition.find("lognormal") != std::string::npos);

  fit.status = "NOT IDENTIFIED";
  save_fit(open_database(database, Access::write), fit);
  CHECK(message_of([&] {
          read_study(file);
        }).ends_with("uncertain: fit rubber: its status is NOT IDENTIFIED: its errors tell nothing"));
}

TEST_CASE("a standard deviation without a unit is refused where it looks like mm or MPa",
          "[studies][uncertain_inputs]") {
  CHECK(
      scatter_refusal(R"("layer_thickness": {"normal": ["12 mm", 2]})") ==
      "layer_thickness: layer_thickness = 2: did you mean \"2 mm\"? A number without a unit is in m: write \"2 m\" if "
      "that is meant");
  CHECK(scatter_refusal(R"("static_shear_modulus": {"normal": ["3 MPa", 0.3]})").find("did you mean \"0.3 MPa\"?") !=
        std::string::npos);
  CHECK(scatter_refusal(R"("layer_thickness": {"normal": ["12 mm", 0.002]})") == "nothing");
}
