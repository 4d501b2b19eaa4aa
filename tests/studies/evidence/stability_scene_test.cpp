#include "studies/evidence/stability_scene.hpp"

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/estimate/contact_estimate.hpp"
#include "core/estimate/grid_choice.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/scene_rules.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "tests/catch.hpp"

// Covers random_material, too.

using namespace rollres;

namespace {

/// Whether values lie in a range and reach into the first and the last twentieth of it on a logarithmic scale.
void check_covers(const std::vector<double>& values, double lowest, double highest) {
  std::array<int, 20> parts{};
  for (const double value : values) {
    const double place = std::log(value / lowest) / std::log(highest / lowest);
    REQUIRE(place > -1e-3);
    REQUIRE(place < 1 + 1e-3);
    ++parts[static_cast<std::size_t>(std::min(19.0, std::max(0.0, 20 * place)))];
  }
  // A twentieth of 1000 is 50; a count below 20 has a probability under 1e-6.
  for (const int count : parts) CHECK(count > 20);
}

std::string kind_of_drive(const RollingScene& scene) {
  if (scene.drive != Drive::rotation) return std::string(name_of(scene.drive));
  const double ratio = *scene.rotation_ratio;
  return ratio == 0 ? "locked" : std::abs(ratio - 1) <= 0.3 ? "near rolling" : "sliding";
}

}  // namespace

TEST_CASE("a random scene depends on its seed, its indenter and its number, and on nothing else",
          "[studies][stability]") {
  const std::string scene = scene_json(stability_scene(Indenter::cylinder, 7, 3));
  CHECK(scene_json(stability_scene(Indenter::cylinder, 7, 3)) == scene);
  CHECK(scene_json(stability_scene(Indenter::cylinder, 8, 3)) != scene);
  CHECK(scene_json(stability_scene(Indenter::cylinder, 7, 4)) != scene);
  CHECK(stability_scene(Indenter::sphere, 7, 3).radius != stability_scene(Indenter::cylinder, 7, 3).radius);
}

TEST_CASE("the random scenes of seed 1 begin with the same numbers on every machine", "[studies][stability]") {
  const RollingScene first = stability_scene(Indenter::cylinder, 1, 0, Spectra::zener),
                     second = stability_scene(Indenter::sphere, 1, 1, Spectra::zener);
  CHECK(first.radius == 0.07452);
  CHECK(first.layer_thickness == 0.008413);
  CHECK(first.speed == 0.006367);
  CHECK(first.friction_coefficient == 0.03637);
  CHECK(second.static_shear_modulus == 4235000);
  CHECK(second.stiffening == 0.4125);
  CHECK(second.creep_time == 0.1769);
}

TEST_CASE("random scenes of Zener solids keep the rules, cover their ranges and have every drive",
          "[studies][stability]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    std::map<std::string, std::vector<double>> values;
    std::map<std::string, int> drives;
    for (std::size_t number = 0; number < 1000; ++number) {
      const RollingScene scene = stability_scene(indenter, 1, number, Spectra::zener);
      REQUIRE(check(scene).empty());
      CHECK(scene.indenter == indenter);
      values["radius"].push_back(scene.radius);
      values["layer_thickness"].push_back(scene.layer_thickness);
      values["static_shear_modulus"].push_back(*scene.static_shear_modulus);
      values["stiffening"].push_back(scene.stiffening);
      values["creep_time"].push_back(scene.creep_time);
      values["speed"].push_back(scene.speed);
      values["friction_coefficient"].push_back(scene.friction_coefficient);
      const ContactEstimate rubbery = elastic_contact_from_load(
          dimension_of(indenter), scene.radius, scene.layer_thickness, *scene.static_shear_modulus, *scene.load);
      values["half-width"].push_back(rubbery.half_width / scene.radius);
      values["nodes"].push_back(2 * estimate_contact(scene).half_width / *scene.spacing);
      ++drives[kind_of_drive(scene)];
      if (scene.driving_torque)
        CHECK(std::abs(*scene.driving_torque) <= 1.2005 * scene.friction_coefficient * *scene.load * scene.radius);
    }
    check_covers(values["radius"], 5e-3, 0.2);
    check_covers(values["layer_thickness"], 1e-3, 0.2);
    check_covers(values["static_shear_modulus"], 1e5, 1e8);
    check_covers(values["stiffening"], 0.01, 100);
    check_covers(values["creep_time"], 1e-5, 10);
    check_covers(values["speed"], 1e-4, 30);
    check_covers(values["friction_coefficient"], 0.005, 2);
    check_covers(values["half-width"], 0.01, 1.0 / 3);
    if (indenter == Indenter::cylinder)
      check_covers(values["nodes"], 20, 60);
    else
      check_covers(values["nodes"], 12, 24);
    REQUIRE(drives.size() == 6);
    for (const auto& [drive, count] : drives) {
      INFO(drive);
      CHECK(count > 100);  // a sixth of 1000 is 167
    }
  }
}

TEST_CASE("random scenes with wide spectra keep the rules and have every material, half-spaces and several layers",
          "[studies][stability][long]") {
  std::map<std::string, int> kinds;
  std::size_t most_terms = 0;
  double most_decades = 0;
  for (std::size_t number = 0; number < 150; ++number) {
    const RollingScene scene = stability_scene(Indenter::cylinder, 1, number, Spectra::wide);
    REQUIRE(check(scene).empty());
    ++kinds[std::string(name_of(scene.material))];
    if (!has_rigid_base(scene)) ++kinds["half-space"];
    if (scene.lower_layers.size() > 1) ++kinds["three layers"];
    if (scene.coating_layers.size() > 1) ++kinds["two coatings"];
    if (scene.temperature) ++kinds["temperature"];
    const std::vector<double>& times = scene.relaxation_times;
    most_terms = std::max(most_terms, times.size());
    if (!times.empty()) most_decades = std::max(most_decades, std::log10(times.back() / times.front()));
  }
  // Each is expected in a sixteenth of the scenes at least, 9; the scenes are always the same.
  for (const char* kind : {"elastic", "prony", "fractional_zener", "master_curve", "half-space", "three layers",
                           "two coatings", "temperature"}) {
    INFO(kind);
    CHECK(kinds[kind] >= 4);
  }
  CHECK(most_terms >= 38);
  CHECK(most_decades > 14);
}

TEST_CASE("every second random scene has wide spectra, the others what they have among Zener solids alone",
          "[studies][stability][long]") {
  int zener = 0;
  for (std::size_t number = 0; number < 100; ++number) {
    const std::string both = scene_json(stability_scene(Indenter::sphere, 3, number));
    const bool same = both == scene_json(stability_scene(Indenter::sphere, 3, number, Spectra::zener));
    zener += same;
    if (!same) CHECK(both == scene_json(stability_scene(Indenter::sphere, 3, number, Spectra::wide)));
  }
  CHECK(zener > 30);  // of 100, 50 expected
  CHECK(zener < 70);
}
