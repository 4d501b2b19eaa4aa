#include "studies/scene_io/doubtful_number.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/solve/rolling_contact.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/study/study.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/study_points.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

const std::string plain = R"({"radius": "20 mm", "layer_thickness": "5 mm", "speed": 1, "load": 1e4,
  "static_shear_modulus": 3e6, "stiffening": 1, "creep_time": 0.1})";

std::string refusal(const std::vector<std::string>& set) {
  return message_of([&] { parse_scene(plain, "text", set); });
}

}  // namespace

TEST_CASE("a bare length above 1 m is refused, and passes with its unit", "[studies][scene_io]") {
  CHECK(refusal({"layer_thickness=6"}) ==
        "--set: layer_thickness = 6: did you mean \"6 mm\"? A number without a unit is in m: write \"6 m\" if that is "
        "meant");
  CHECK_THAT(refusal({"radius=50"}), Contains("did you mean \"50 mm\"?"));
  CHECK(parse_scene(plain, "text", {"radius=5 m"}).radius == 5);
  CHECK(parse_scene(plain, "text", {"radius=1"}).radius == 1);
  CHECK(std::isinf(parse_scene(plain, "text", {"layer_thickness=infinite"}).layer_thickness));
  const std::string coated = R"("coating_layers": [{"layer_thickness": 12, "static_shear_modulus": 1e6,
    "stiffening": 1, "creep_time": 1}])";
  CHECK_THAT(message_of([&] { parse_scene(plain.substr(0, plain.size() - 1) + ", " + coated + "}", "text"); }),
             Contains("coating_layers[0].layer_thickness = 12: did you mean \"12 mm\"?"));
}

TEST_CASE("a bare modulus below 1 kPa or above 1 TPa is refused, of a list by its largest", "[studies][scene_io]") {
  CHECK(refusal({"static_shear_modulus=3"}) ==
        "--set: static_shear_modulus = 3: did you mean \"3 MPa\"? A number without a unit is in Pa: write \"3 Pa\" if "
        "that is meant");
  CHECK_THAT(refusal({"static_young_modulus=2e12"}),
             Contains("is above 1 TPa. A number without a unit is in Pa: write \"2e+12 Pa\" if that is meant"));
  CHECK(parse_scene(plain, "text", {"static_shear_modulus=500 Pa"}).static_shear_modulus.value() == 500);
  const auto series = [](const std::string& moduli) {
    return refusal({"material=prony", "relaxation_times=[1, 2]", "relaxation_moduli=" + moduli});
  };
  CHECK(series("[2e6, 10]") == "nothing");
  CHECK(series("[0, 0]") == "nothing");
  CHECK(series(R"(["3 Pa", "0.4 Pa"])") == "nothing");
  CHECK_THAT(series("[0.4, 3]"), Contains("relaxation_moduli[1] = 3: did you mean \"3 MPa\"?"));
  CHECK(refusal({"adhesion_threshold=10"}) == "nothing");  // a stress, and no modulus
  // Of a strain sweep only ratios count.
  CHECK(refusal({"sweep_strains=[0.001, 0.1]", "sweep_storage_moduli=[1, 0.5]", "sweep_loss_moduli=[0.1, 0.2]"}) ==
        "nothing");
}

TEST_CASE("a bare temperature that looks like degrees Celsius is refused", "[studies][scene_io]") {
  const std::vector<std::string> shift{"reference_temperature=293.15", "wlf_c1=8.86", "wlf_c2=101.6"};
  const auto at = [&](const std::string& temperature) {
    std::vector<std::string> set = shift;
    set.push_back("temperature=" + temperature);
    return refusal(set);
  };
  CHECK(at("40") ==
        "--set: temperature = 40: did you mean \"40 degC\"? A number without a unit is in K: write \"40 K\" "
        "if that is meant");
  CHECK_THAT(at("-20"), Contains("did you mean \"-20 degC\"?"));
  CHECK(at("313.15") == "nothing");
  CHECK(at("40 degC") == "nothing");
  CHECK_THAT(at("-20 K"), Contains("must be > 0"));
  CHECK_THAT(refusal({"temperature=40 degC", "reference_temperature=300", "shift_temperatures=[20, 300, 400]",
                      "shift_factors=[3, 1, 0.1]"}),
             Contains("shift_temperatures[0] = 20: did you mean \"20 degC\"?"));
}

TEST_CASE("a bare angle that looks like degrees, and a bare molar energy like kJ/mol, are refused",
          "[studies][scene_io]") {
  CHECK(refusal({"skew_angle=5"}) ==
        "--set: skew_angle = 5: did you mean \"5 deg\"? A number without a unit is in rad: write \"5 rad\" if that is "
        "meant");
  CHECK_THAT(refusal({"skew_angle=-0.5"}), Contains("did you mean \"-0.5 deg\"?"));
  CHECK_THAT(refusal({"skew_angle=100 deg"}), Contains("must be from -1.4 to 1.4 rad"));
  CHECK(parse_scene(plain, "text", {"skew_angle=0.1"}).skew_angle == 0.1);
  CHECK(parse_scene(plain, "text", {"skew_angle=0.5 rad"}).skew_angle == 0.5);
  const std::vector<std::string> shift{"temperature=40 degC", "reference_temperature=20 degC"};
  const auto with_energy = [&](const std::string& energy) {
    std::vector<std::string> set = shift;
    set.push_back("activation_energy=" + energy);
    return refusal(set);
  };
  CHECK_THAT(with_energy("50"), Contains("activation_energy = 50: did you mean \"50 kJ/mol\"?"));
  CHECK(with_energy("5e4") == "nothing");
  CHECK(with_energy("50 kJ/mol") == "nothing");
  CHECK(with_energy("50 J/mol") == "nothing");
}

TEST_CASE("axes and ranges are read as scenes are", "[studies][scene_io]") {
  const TemporaryDirectory folder;
  const auto axis = [&](const std::string& values) {
    const auto file =
        folder.write("study.json", R"({"study": "s", "scene": )" + plain + R"(, "axes": {)" + values + "}}");
    return message_of([&] { read_study(file); });
  };
  CHECK_THAT(axis(R"("layer_thickness": [3, 6])"), Contains("layer_thickness = 3: did you mean \"3 mm\"?"));
  CHECK_THAT(axis(R"("radius": {"from": "10 mm", "to": 30, "points": 3})"), Contains("30: did you mean \"30 mm\"?"));
  CHECK(axis(R"("radius": {"from": "1 m", "to": "5 m", "points": 3})") == "nothing");
}

TEST_CASE("a scene with doubtful numbers reads back, to the last bit, as the program wrote it", "[studies][scene_io]") {
  RollingScene scene = parse_scene(plain, "text",
                                   {"radius=5 m", "layer_thickness=3 m", "static_shear_modulus=500 Pa",
                                    "temperature=100 K", "reference_temperature=90 K", "wlf_c1=8.86", "wlf_c2=101.6"});
  scene.radius = std::nextafter(5.0, 6.0);  // 16 digits and more
  scene.temperature = 100.00000000000003;
  scene.static_shear_modulus = 1e3 / 3;
  scene.coating_layers.resize(1);
  BondedLayer& coating = scene.coating_layers.front();
  coating.layer_thickness = 1.0 + 1e-15;
  coating.material = MaterialModel::master_curve;
  coating.frequencies = {1, 10};
  coating.storage_moduli = {1e2 / 3, 2e2 / 3};
  coating.loss_moduli = {1, 2};
  const RollingScene again = parse_scene(scene_json(scene), "again");
  CHECK(again.radius == scene.radius);
  CHECK(again.temperature == scene.temperature);
  CHECK(again.static_shear_modulus == scene.static_shear_modulus);
  CHECK(again.coating_layers == scene.coating_layers);
  CHECK(scene_json(again) == scene_json(scene));
}

TEST_CASE("a distribution about a long mean draws points that are read as they were drawn", "[studies][scene_io]") {
  const TemporaryDirectory folder;
  const auto file =
      folder.write("study.json", R"({"study": "s", "scene": )" + plain +
                                     R"(, "uncertain": {"radius": {"normal": ["5 m", "1 %"]}, "points": 8}})");
  const auto scenes = points(read_study(file));
  REQUIRE(scenes.size() == 8);
  for (const RollingScene& scene : scenes) CHECK(scene.radius == Approx(5).epsilon(0.1));
}

TEST_CASE("what is doubtful in the material of a further layer is warned of by its key, as in that of the uppermost",
          "[studies][material]") {
  const double order = 0.6;  // of a spring-pot, whose loss is above its storage
  nlohmann::json frequencies, storage, loss;
  for (int i = 0; i <= 12; ++i) {
    const double frequency = std::pow(10, -2 + 0.5 * i), size = 1e6 * std::pow(frequency, order);
    frequencies.push_back(frequency);
    storage.push_back(2e4 + size * std::cos(0.5 * order * std::numbers::pi));
    loss.push_back(size * std::sin(0.5 * order * std::numbers::pi));
  }
  const nlohmann::json further{{"layer_thickness", "5 mm"},  {"material", "master_curve"}, {"listed_moduli", "shear"},
                               {"frequencies", frequencies}, {"storage_moduli", storage},  {"loss_moduli", loss}};
  nlohmann::json scene{{"radius", "20 mm"}, {"layer_thickness", "5 mm"}, {"static_shear_modulus", "3 MPa"},
                       {"stiffening", 1},   {"creep_time", 0.25},        {"speed", 0.05},
                       {"load", "100 N/m"}};
  const auto doubts = [&] {
    const RollingSolution solution = solve(parse_scene(scene.dump(), "scene", {}));
    REQUIRE(solution.status == Status::converged);
    return std::count_if(solution.warnings.begin(), solution.warnings.end(), [](const std::string& line) {
      return line.starts_with("lower_layers[1]: ") && line.ends_with("are the two swapped?");
    });
  };
  CHECK(doubts() == 0);
  scene["lower_layers"] = {further, further};
  CHECK(doubts() == 1);
}
