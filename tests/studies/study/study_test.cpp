#include "studies/study/study.hpp"

#include <cmath>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/study_points.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers study_scene, too.

using namespace rollres;

namespace {

const std::filesystem::path examples = source_directory() / "studies/examples";

RollingScene some_scene() {
  RollingScene scene;
  scene.radius = 0.02;
  scene.layer_thickness = 0.005;
  scene.static_shear_modulus = 3e6;
  scene.speed = 0.05;
  scene.load = 2e4;
  return scene;
}

}  // namespace

TEST_CASE("the example studies hold the points they promise", "[studies][study]") {
  const Study study = read_study(examples / "speed_resistance.json");
  const auto scenes = points(study);
  REQUIRE(scenes.size() == 180);
  CHECK(scenes.front().speed == 0.001);
  CHECK(scenes[59].speed == 10);
  CHECK(scenes.front().load == 10e3);
  CHECK(scenes[60].load == 20e3);
  CHECK(scenes.back().load == 40e3);
  // logarithmic: the same ratio from each speed to the next, up to rounding of pow
  for (std::size_t i = 1; i < 60; ++i)
    CHECK(scenes[i].speed / scenes[i - 1].speed == Approx(std::pow(1e4, 1.0 / 59)).epsilon(1e-13));
  REQUIRE(study.charts.size() == 1);
  CHECK(study.charts[0].x == "speed");
  CHECK(study.charts[0].y == "rolling_resistance");
  CHECK(study.charts[0].family == "load");

  const auto spheres = points(read_study(examples / "speed_resistance_sphere.json"));
  CHECK(spheres.size() >= 12);
  for (const RollingScene& scene : spheres) CHECK(scene.indenter == Indenter::sphere);
}

TEST_CASE("axes keep the order of the file and the last one varies fastest", "[studies][study]") {
  const TemporaryDirectory directory;
  directory.write("scene.json", R"({"radius": 0.02, "layer_thickness": 0.005, "static_shear_modulus": 3e6,
                                    "stiffening": 1, "creep_time": 0.25, "tolerance": 0.01, "load": 2e4})");
  const auto file = directory.write("study.json", R"({"study": "three axes", "scene": "scene.json", "comment": "no",
    "set": {"spacing": "0.25 mm"},
    "axes": {"speed": {"from": "1 m/s", "to": "7.2 km/h", "points": 3}, "method": ["active_set", "newton"],
             "approach": ["0.1 mm", 2e-4]}})");
  const Study study = read_study(file);
  CHECK(study.name == "three axes");
  REQUIRE(study.axes.size() == 3);
  CHECK(study.axes[0].key == "speed");
  CHECK(study.axes[0].values == std::vector<double>{1, 1.5, 2});
  CHECK_FALSE(study.axes[0].logarithmic);
  CHECK(study.axes[1].texts == std::vector<std::string>{"active_set", "newton"});
  CHECK(study.axes[2].values == std::vector<double>{1e-4, 2e-4});

  const auto scenes = points(study);
  REQUIRE(scenes.size() == 12);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    CHECK(scenes[i].speed == study.axes[0].values[i / 4]);
    CHECK(scenes[i].method == (i / 2 % 2 == 0 ? Method::active_set : Method::newton));
    CHECK(scenes[i].approach == study.axes[2].values[i % 2]);
    CHECK_FALSE(scenes[i].load.has_value());       // replaced by the axis approach
    CHECK_FALSE(scenes[i].tolerance.has_value());  // replaced by set
    CHECK(scenes[i].spacing == 0.00025);
  }
}

TEST_CASE("an axis of drives keeps for each drive what belongs to it", "[studies][study]") {
  const TemporaryDirectory directory;
  const auto file = directory.write("study.json", R"({"study": "drives", "scene": {"radius": 0.02, "speed": 0.05,
    "layer_thickness": "infinite", "static_shear_modulus": 3e6, "material": "elastic", "load": 2e4,
    "friction_coefficient": 0.2, "drive": "torque", "driving_torque": "3 N"}, "axes": {"drive": ["free", "torque", "top_force"]}})");
  const auto scenes = points(read_study(file));
  REQUIRE(scenes.size() == 3);
  CHECK_FALSE(scenes[0].driving_torque.has_value());
  CHECK(scenes[1].driving_torque == 3);
  CHECK_FALSE(scenes[2].driving_torque.has_value());
}

TEST_CASE("an axis of materials needs what each of them needs", "[studies][study]") {
  const TemporaryDirectory directory;
  const auto file = directory.write("study.json", R"({"study": "materials", "scene": {"radius": 0.02, "speed": 0.05,
    "layer_thickness": "infinite", "static_shear_modulus": 3e6, "material": "elastic", "load": 2e4},
    "axes": {"material": ["elastic", "zener"]}})");
  CHECK_THROWS_WITH(read_study(file),
                    file.string() + ": stiffening is missing: material \"zener\" needs it (a number)");
}

TEST_CASE("a load with a unit cannot be varied over cylinder and sphere", "[studies][study]") {
  const TemporaryDirectory directory;
  const std::string rest = R"("radius": 0.02, "speed": 0.05, "layer_thickness": 0.005, "static_shear_modulus": 3e6,
    "material": "elastic"}, "axes": {"indenter": ["cylinder", "sphere"])";
  const auto file = directory.write("study.json", R"({"study": "s", "scene": {"load": "20 kN/m", )" + rest + "}}");
  CHECK_THROWS_WITH(read_study(file),
                    file.string() + ": scene: load = \"20 kN/m\": must have a unit of force (N) for a sphere");
  const auto axis =
      directory.write("axis.json", R"({"study": "s", "scene": {"load": 1, )" + rest + R"(, "load": [1, "2 N/m"]}})");
  CHECK_THROWS_WITH(read_study(axis),
                    axis.string() + ": axes: load = \"2 N/m\": must have a unit of force (N) for a sphere");
  const auto pressed =
      directory.write("pressed.json", R"({"study": "s", "scene": {"approach": "0.1 mm", )" + rest + "}}");
  CHECK(points(read_study(pressed)).size() == 2);
}

TEST_CASE("a study made in the program has its points checked like one from a file", "[studies][study]") {
  Study study{.name = "made", .base = some_scene(), .axes = {{.key = "speed", .values = {1, 2}}}};
  CHECK(points(study).size() == 2);
  study.axes.push_back({.key = "friction_coefficient", .values = {0.1, -0.2}});
  CHECK_THROWS_WITH(points(study),
                    "made: axes at speed = 1, friction_coefficient = -0.2: friction_coefficient = -0.2: must be >= 0");
  study.axes.back() = {.key = "frictoin", .values = {0.1}};
  CHECK_THROWS_AS(points(study), std::invalid_argument);
  study.axes.clear();
  CHECK(points(study).size() == 1);
}

TEST_CASE("a study whose scene file is not there names that file", "[studies][study]") {
  const TemporaryDirectory directory;
  const auto file = directory.write("study.json", R"({"study": "s", "scene": "gone.json", "axes": {"speed": [1]}})");
  CHECK_THROWS_AS(read_study(file), std::runtime_error);
  CHECK_THROWS_WITH(read_study(file),
                    (directory.path / "gone.json").string() + ": cannot be read: No such file or directory");
}

TEST_CASE("numbers of the inside that no scene of a study computes are refused with the key that computes them",
          "[studies][study]") {
  // Where they were accepted the columns stayed empty.
  const TemporaryDirectory directory;
  const auto read = [&](const std::string& more, const std::string& axes, const std::string& wanted) {
    return read_study(directory.write(
        "study.json", R"({"study": "s", "scene": {"indenter": "cylinder", "radius": "2 cm", "layer_thickness": "5 mm",
          "static_shear_modulus": "3 MPa", "stiffening": 1, "creep_time": 0.25, "load": "20 kN/m",
          "friction_coefficient": 0)" +
                          more + R"(}, "axes": {"speed": [1, 2])" + axes + "}, " + wanted + "}"));
  };
  const std::string formula = R"("compute": ["load", {"share": "bond_shear / peak_pressure"}])";
  CHECK_THROWS_WITH(read("", "", formula),
                    Catch::Contains("compute: bond_shear / peak_pressure: bond_shear is not computed: interior = on"));
  CHECK_THROWS_WITH(read("", "", R"("chart": {"x": "speed", "y": "interior_loss"})"),
                    Catch::Contains("chart: interior_loss is not computed: interior = on"));
  CHECK_NOTHROW(read(R"(, "interior": "on")", "", formula));
  CHECK_NOTHROW(read("", R"(, "interior": ["off", "on"])", formula));
  CHECK_NOTHROW(read("", R"(, "variant": {"a": {"radius": "3 cm"}, "b": {"interior": "on"}})", formula));
  // Moduli that depend on the strain have its amplitude with them.
  const std::string amplitude = R"("compute": ["strain_amplitude"])";
  CHECK_THROWS_AS(read("", "", amplitude), std::invalid_argument);
  CHECK_NOTHROW(read(R"(, "payne_drop": 0.5, "payne_strain": 0.01)", "", amplitude));
}
