#include "core/model/heat_rules.hpp"

#include <functional>

#include "core/messages/message_text.hpp"
#include "core/model/scene_rules.hpp"
#include "tests/core/heat/warm_wheel.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

std::string broken_by(const std::function<void(RollingScene&)>& change) {
  RollingScene scene = warm_wheel();
  change(scene);
  return joined(check(scene), "; ");
}

}  // namespace

TEST_CASE("a wheel whose heat has a way out breaks no rule, and without heat none of these holds", "[core][heat]") {
  CHECK(broken_by([](RollingScene&) {}) == "");
  CHECK(broken_by([](RollingScene& s) {
          s.heat = Heat::off;
          s.thermal_conductivity.reset();
          s.turn_length = 1;
        }) == "");
}

TEST_CASE("each rule of heat is told by the input that breaks it", "[core][heat]") {
  const auto check_rule = [](const std::string& line, const std::function<void(RollingScene&)>& change) {
    CHECK_THAT(broken_by(change), Contains(line));
  };
  check_rule("heat = on: not of a sphere", [](RollingScene& s) { s.indenter = Indenter::sphere; });
  check_rule("heat = on: not with a period", [](RollingScene& s) { s.period = 0.2; });
  check_rule("heat = on: not with method \"finite_strain\"", [](RollingScene& s) { s.method = Method::finite_strain; });
  check_rule("heat = on: only with kinematics \"consistent\"",
             [](RollingScene& s) { s.kinematics = Kinematics::printed; });
  check_rule("rotation_ratio = 0: must be > 0 with heat", [](RollingScene& s) {
    s.drive = Drive::rotation;
    s.rotation_ratio = 0;
  });
  check_rule("turn_length = 1: only of a belt", [](RollingScene& s) { s.turn_length = 1; });
  check_rule("turn_length is missing", [](RollingScene& s) { s.coating_layers.clear(); });
  check_rule("layer_thickness = \"infinite\": must be finite with heat", [](RollingScene& s) {
    s.coating_layers.clear();
    s.layer_thickness = INFINITY;
  });
  check_rule("thermal_conductivity is missing", [](RollingScene& s) { s.thermal_conductivity.reset(); });
  check_rule("surface_heat_transfer is missing", [](RollingScene& s) { s.surface_heat_transfer.reset(); });
  check_rule("ambient_temperature is missing", [](RollingScene& s) { s.ambient_temperature.reset(); });
  check_rule("heat_capacity is missing: a ground_effusivity needs it", [](RollingScene& s) {
    s.ground_effusivity = 1000;
    s.heat_capacity.reset();
  });
  check_rule("ground_temperature = 280: needs a ground_effusivity > 0",
             [](RollingScene& s) { s.ground_temperature = 280; });
  check_rule("core_heat_transfer = 5: not with core \"insulated\"", [](RollingScene& s) {
    s.core = CoreHeat::insulated;
    s.core_heat_transfer = 5;
  });
  check_rule("surface_heat_transfer = 0: heat has no way out", [](RollingScene& s) { s.surface_heat_transfer = 0; });
}

TEST_CASE("the laws of shift are asked at the temperatures around, and none is given of the warmed layers",
          "[core][heat]") {
  const auto with_wlf = [](RollingScene& s) -> MaterialInputs& {
    MaterialInputs& cover = s.coating_layers[0];
    cover.wlf_c1 = 8.86;
    cover.wlf_c2 = 101.6;
    return cover;
  };
  CHECK_THAT(broken_by(with_wlf), Contains("coating_layers[0].reference_temperature is missing"));
  CHECK_THAT(broken_by([&](RollingScene& s) {
               with_wlf(s).reference_temperature = 293.15;
               s.ambient_temperature = 190;
             }),
             Contains("ambient_temperature = 190: must be above reference_temperature - wlf_c2"));
  CHECK_THAT(broken_by([&](RollingScene& s) {
               with_wlf(s).reference_temperature = 293.15;
               s.core_temperature = 191;
             }),
             Contains("core_temperature = 191: must be above"));
  CHECK_THAT(broken_by([&](RollingScene& s) {
               MaterialInputs& cover = with_wlf(s);
               cover.reference_temperature = 293.15;
               cover.temperature = 300;
             }),
             Contains("coating_layers[0].temperature = 300: not with heat \"on\""));
  CHECK_THAT(broken_by([&](RollingScene& s) {
               with_wlf(s).reference_temperature = 293.15;
               s.temperature = 303.15;
             }),
             Contains("temperature = 303.15: has no effect without a shift law") &&
                 Contains("; coating_layers[0] has one: heat = on finds its temperature from ambient_temperature"));
}
