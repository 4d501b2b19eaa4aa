#include "studies/study/study_axes.hpp"

#include <cmath>
#include <set>

#include "tests/catch.hpp"
#include "tests/studies/study_points.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

Study study_from(const std::string& varied, const std::string& scene = R"("load": 2e4)") {
  const TemporaryDirectory directory;
  return read_study(directory.write("study.json", R"({"study": "s", "scene": {"radius": 0.02, "speed": 0.05,
    "layer_thickness": 0.005, "static_shear_modulus": 3e6, "stiffening": 1, "creep_time": 0.25, )" +
                                                      scene + "}, " + varied + "}"));
}

}  // namespace

TEST_CASE("zipped inputs vary together and with every combination of the other axes", "[studies][study]") {
  const Study study = study_from(R"("axes": {"speed": [1, 2],
    "layer": {"zip": {"layer_thickness": ["5 mm", "10 mm", "20 mm"], "static_shear_modulus": ["1 MPa", "2 MPa", "1 MPa"],
                      "method": ["newton", "newton", "active_set"]}},
    "friction_coefficient": [0, 0.1]})");
  REQUIRE(study.axes.size() == 5);
  CHECK(study.axes[1].group == "layer");
  CHECK(study.axes[3].group == "layer");
  CHECK(study.axes[4].group.empty());
  const auto scenes = points(study);
  REQUIRE(scenes.size() == 12);
  const std::vector<double> thickness{0.005, 0.010, 0.020}, modulus{1e6, 2e6, 1e6};
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const std::size_t layer = i / 2 % 3;
    CHECK(scenes[i].speed == (i < 6 ? 1 : 2));
    CHECK(scenes[i].layer_thickness == thickness[layer]);
    CHECK(scenes[i].static_shear_modulus == modulus[layer]);
    CHECK(scenes[i].method == (layer == 2 ? Method::active_set : Method::newton));
    CHECK(scenes[i].friction_coefficient == (i % 2 == 0 ? 0 : 0.1));
  }
}

TEST_CASE("bodies that are zipped with their loads each read the load in their own unit", "[studies][study]") {
  const auto scenes = points(
      study_from(R"("axes": {"body": {"zip": {"load": ["20 kN/m", "150 N"], "indenter": ["cylinder", "sphere"]}}})",
                 R"("drive": "free")"));
  REQUIRE(scenes.size() == 2);
  CHECK(scenes[0].indenter == Indenter::cylinder);
  CHECK(scenes[0].load == 20e3);
  CHECK(scenes[1].indenter == Indenter::sphere);
  CHECK(scenes[1].load == 150);
}

TEST_CASE("a zip may hold intervals, and drives with what belongs to them", "[studies][study]") {
  const auto slow = points(study_from(R"("axes": {"path": {"zip": {"speed": {"from": 1, "to": 3, "points": 3},
    "load": {"from": "1 kN/m", "to": "100 kN/m", "points": 3, "spacing": "logarithmic"}}}})"));
  REQUIRE(slow.size() == 3);
  CHECK(slow[1].speed == 2);
  CHECK(*slow[1].load == Approx(10e3).epsilon(1e-14));
  CHECK(slow[2].load == 100e3);

  const auto driven = points(
      study_from(R"("axes": {"how": {"zip": {"drive": ["free", "rotation"], "friction_coefficient": [0, 0.2]}}})",
                 R"("load": 2e4, "drive": "rotation", "rotation_ratio": 1.01)"));
  CHECK_FALSE(driven.at(0).rotation_ratio.has_value());
  CHECK(driven.at(1).rotation_ratio == 1.01);
}

TEST_CASE("a sample fills its ranges, linear or logarithmic, and the same seed gives the same points",
          "[studies][study]") {
  const std::string sample = R"("sample": {"method": "latin_hypercube", "points": 50, "seed": 3,
    "ranges": {"speed": {"from": "1 mm/s", "to": "10 m/s", "spacing": "logarithmic"}, "load": {"from": 3e4, "to": 1e4}}})";
  const Study study = study_from(sample);
  REQUIRE(study.axes.size() == 2);
  CHECK(study.axes[0].logarithmic);
  CHECK(study.axes[0].group == study.axes[1].group);
  std::set<int> parts_of_speed, parts_of_load;
  for (const RollingScene& scene : points(study)) {
    parts_of_speed.insert(static_cast<int>(50 * std::log10(scene.speed / 1e-3) / 4));
    parts_of_load.insert(static_cast<int>(50 * (3e4 - *scene.load) / 2e4));
  }
  CHECK(parts_of_speed.size() == 50);
  CHECK(parts_of_load.size() == 50);
  CHECK(study_from(sample).axes[0].values == study.axes[0].values);
}

TEST_CASE("every point of a sample meets every combination of the axes", "[studies][study]") {
  const auto scenes = points(study_from(R"("axes": {"friction_coefficient": [0, 0.1, 0.2]},
    "sample": {"method": "sobol", "points": 4, "ranges": {"speed": {"from": 1, "to": 3}, "radius": {"from": 0.02, "to": 0.06}}})"));
  REQUIRE(scenes.size() == 12);
  const std::vector<double> speeds{1, 2, 2.5, 1.5}, radii{0.02, 0.04, 0.03, 0.05};
  for (std::size_t i = 0; i < 12; ++i) {
    CHECK(scenes[i].friction_coefficient == 0.1 * static_cast<double>(i / 4));
    CHECK(scenes[i].speed == speeds[i % 4]);
    CHECK(scenes[i].radius == Approx(radii[i % 4]).epsilon(1e-15));
  }
}
