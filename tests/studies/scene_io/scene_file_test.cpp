#include "studies/scene_io/scene_file.hpp"
#include "core/model/scene_rules.hpp"

#include <cmath>
#include <stdexcept>

#include "studies/scene_io/scene_inputs.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "tests/catch.hpp"
#include "tests/source_directory.hpp"

// Covers scene_entries, too.

using namespace rollres;

namespace {

const std::string examples = source_directory().string() + "/studies/examples/";
const std::string cylinder = examples + "paper_cylinder.json";
const std::string sphere = examples + "paper_sphere.json";

}  // namespace

TEST_CASE("the paper's cylinder and sphere are read as section 5 prints them", "[studies][scene_file]") {
  for (const std::string& file : {cylinder, sphere}) {
    const RollingScene scene = read_scene(file);
    INFO(file);
    CHECK(scene.radius == 0.02);
    CHECK(scene.layer_thickness == 0.005);
    CHECK(scene.layer_density == 1000);
    CHECK(scene.material == MaterialModel::zener);
    CHECK(scene.static_shear_modulus == 3e6);
    CHECK(scene.stiffening == 1);
    CHECK(scene.creep_time == 0.25);
    CHECK(scene.speed == 0.05);
    CHECK(scene.friction_coefficient == 0.2);
    CHECK(scene.drive == Drive::top_force);
    CHECK(scene.spacing == 0.00025);
    CHECK(check(scene).empty());
  }
  CHECK(read_scene(cylinder).indenter == Indenter::cylinder);
  CHECK(read_scene(cylinder).load == 20e3);
  CHECK(read_scene(sphere).indenter == Indenter::sphere);
  CHECK(read_scene(sphere).load == 150);
}

TEST_CASE("a scene written as JSON reads back as the same scene, whatever its inputs", "[studies][scene_file]") {
  // Two values for every input, found by walking the list: what is added to it is tested too.
  const auto valid = [](const InputKind& kind, int which) -> InputValue {
    if (!kind.choices.empty()) return std::string(which == 0 ? kind.choices.front() : kind.choices.back());
    const Range& range = kind.quantity.range;
    if (kind.layers) {
      BondedLayer plain, full;
      plain.layer_thickness = full.layer_thickness = 1e-3 / 3;
      plain.static_shear_modulus = 0.1 + 0.2;
      plain.stiffening = 1;
      plain.creep_time = 1.0 / 7;
      full.material = MaterialModel::prony;
      full.static_young_modulus = 1e17 / 3;
      full.relaxation_times = {1e-300, 1.0 / 3};
      full.relaxation_moduli = {7, 0.1 + 0.2};
      BondedLayer elastic = plain;  // zeros that a file must name
      elastic.stiffening = elastic.creep_time = 0;
      return which == 0 ? BondedLayers{plain} : BondedLayers{full, elastic};
    }
    if (kind.list) return which == 0 ? std::vector<double>{1.0 / 3} : std::vector<double>{0.1 + 0.2, 1e-300, 7};
    if (kind.whole) return std::ceil(std::isfinite(range.lowest) ? range.lowest + 1 + which : which);
    if (range.infinity_allowed && which == 1) return std::numeric_limits<double>::infinity();
    const double odd = which == 0 ? 1.0 / 3 : 0.1 + 0.2;  // 16 and 17 digits
    return range.contains(odd) ? odd : range.lowest;
  };
  for (const std::string& file : {cylinder, sphere})
    for (const InputKind& kind : input_kinds())
      for (const int which : {0, 1}) {
        RollingScene scene = read_scene(file);
        set_input(scene, kind.quantity.key, valid(kind, which));
        if (!check(scene).empty()) continue;  // what does not go together cannot be read either
        const std::string text = scene_json(scene);
        INFO(text);
        CHECK(scene_json(parse_scene(text, "text")) == text);
      }
}

TEST_CASE("an override replaces an input, in SI or with a unit", "[studies][scene_file]") {
  const RollingScene scene = read_scene(
      cylinder, {"speed=36 km/h", "friction_coefficient=0", "method=active_set", "layer_thickness=infinite"});
  CHECK(scene.speed == 10);
  CHECK(scene.friction_coefficient == 0);
  CHECK(scene.method == Method::active_set);
  CHECK(std::isinf(scene.layer_thickness));
  CHECK(scene.load == 20e3);
}

TEST_CASE("an override takes the place of the input that excludes it", "[studies][scene_file]") {
  const RollingScene pressed = read_scene(cylinder, {"approach=0.3 mm", "tolerance=0.01"});
  CHECK(pressed.approach == 0.0003);
  CHECK_FALSE(pressed.load.has_value());
  CHECK(pressed.tolerance == 0.01);
  CHECK_FALSE(pressed.spacing.has_value());

  const std::string driven = R"({"radius": 0.02, "layer_thickness": 0.005, "static_shear_modulus": 3e6, "stiffening": 1,
    "creep_time": 0.25, "speed": 0.05, "load": 2e4, "friction_coefficient": 0.2, "drive": "torque", "driving_torque": "3 N"})";
  CHECK(parse_scene(driven, "text").driving_torque == 3);
  const RollingScene free = parse_scene(driven, "text", {"drive=free"});
  CHECK(free.drive == Drive::free);
  CHECK_FALSE(free.driving_torque.has_value());
  const RollingScene locked = parse_scene(driven, "text", {"rotation_ratio=0", "drive=rotation"});
  CHECK(locked.rotation_ratio == 0);
  CHECK_FALSE(locked.driving_torque.has_value());

  CHECK_THROWS_WITH(read_scene(cylinder, {"load=1 kN/m", "approach=0.3 mm"}),
                    cylinder + " with --set: approach = 0.0003: give load or approach, not both");
}

TEST_CASE("a cylinder's load given for a sphere is refused by its unit", "[studies][scene_file]") {
  CHECK_THROWS_WITH(read_scene(cylinder, {"indenter=sphere"}),
                    cylinder + ": load = \"20 kN/m\": must have a unit of force (N) for a sphere");
  CHECK(read_scene(cylinder, {"indenter=sphere", "load=150 N"}).load == 150);
}

TEST_CASE("kinematics of deformed nodes are refused with the reason and the alternative", "[studies][scene_file]") {
  CHECK_THROWS_WITH(read_scene(cylinder, {"kinematics=deformed"}),
                    Catch::Contains("kinematics = \"deformed\": must be one of consistent, printed; moving nodes") &&
                        Catch::Contains("method = \"finite_strain\" has exact positions"));
}

TEST_CASE("what cannot be read is the outside world's failure, not wrong input", "[studies][scene_file]") {
  CHECK_THROWS_AS(read_scene("/nowhere/scene.json"), std::runtime_error);
  CHECK_THROWS_WITH(read_scene("/nowhere/scene.json"),
                    "/nowhere/scene.json: cannot be read: No such file or directory");
  CHECK_THROWS_WITH(read_scene("/"), "/: cannot be read: Is a directory");
}
