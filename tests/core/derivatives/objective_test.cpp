#include "core/derivatives/objective.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

TEST_CASE("an objective maps named inputs to a named output", "[core][objective]") {
  const RollingScene base = plain_scene(2.0, 1e4);
  const Objective f = objective(base, {{"load"}, {"speed"}}, "rolling_resistance", closed_form);
  CHECK(base_point(f) == std::vector<double>{1e4, 2.0});
  const std::vector<double> point{3e4, 0.5};
  const RollingScene scene = scene_at(f, point);
  CHECK(scene.load == 3e4);
  CHECK(scene.speed == 0.5);
  CHECK(scene.radius == base.radius);
  const ObjectiveValue answer = value_at(f, point);
  CHECK(answer.found());
  CHECK(answer.value == closed_form(scene).rolling_resistance);
}

TEST_CASE("an objective may be what is no output of a solution: then nothing is solved", "[core][objective]") {
  const Evaluate unasked = [](const RollingScene&) -> RollingSolution { throw std::logic_error("solved"); };
  Objective f{plain_scene(), variables_of(plain_scene(), {{"speed"}}), {"square", "", "m2/s2", ""}, unasked};
  f.value_of = [](const RollingScene& scene) { return scene.speed < 3 ? scene.speed * scene.speed : std::nan(""); };
  const ObjectiveValue answer = value_at(f, std::vector{2.0});
  CHECK(answer.found());
  CHECK(answer.value == 4);
  const ObjectiveValue none = value_at(f, std::vector{4.0});
  CHECK_FALSE(none.found());
  CHECK(none.reason == "square: has no value");
}

TEST_CASE("sizes, stresses, times and speeds vary in the logarithm, ratios and zeros do not", "[core][objective]") {
  RollingScene base = plain_scene();
  base.drive = Drive::torque;
  base.driving_torque = 0;
  base.friction_coefficient = 0;
  const auto variables = variables_of(
      base, {{"radius"}, {"load"}, {"creep_time"}, {"stiffening"}, {"friction_coefficient"}, {"driving_torque"}});
  const std::vector<bool> logarithmic{true, true, true, false, false, false};
  for (std::size_t i = 0; i < variables.size(); ++i)
    CHECK((variables[i].scaling == Scaling::logarithmic) == logarithmic[i]);
  CHECK(variables[3].size == base.stiffening);
  CHECK(variables[4].size == 1);
  CHECK(variables[5].size == *base.load * base.radius);
  base.creep_time = 0;
  CHECK(variables_of(base, {{"creep_time"}}).front().scaling == Scaling::linear);
  const InputChoice linear{.key = "radius", .logarithmic = false};
  CHECK(variables_of(base, {linear}).front().scaling == Scaling::linear);
}

TEST_CASE("scaled variables go to and fro, never outside the bounds", "[core][objective]") {
  const RollingScene base = plain_scene();
  for (const Scaling scaling : {Scaling::linear, Scaling::logarithmic, Scaling::reciprocal}) {
    CAPTURE(name_of(scaling));
    Variable variable = variables_of(base, {{"speed", 0.5, 2.0}}).front();
    variable.scaling = scaling;
    CHECK(variable.value(variable.scaled(1.3)) == Approx(1.3).epsilon(1e-15));
    CHECK(variable.scaled_step(0.7, 1.3) == Approx(variable.scaled(1.3) - variable.scaled(0.7)).epsilon(1e-14));
    CHECK(variable.value(variable.scaled(2.0) + 1) == 2.0);
    CHECK(variable.value(variable.scaled(0.5) - 1) == 0.5);
    const double step = 1e-9;  // slope against the quotient of a step, which has 7 digits
    CHECK((1.3 * (1 + step) - 1.3) / variable.scaled_step(1.3, 1.3 * (1 + step)) ==
          Approx(variable.slope(1.3)).epsilon(1e-7));
  }
  const Variable open = variables_of(base, {{"speed"}}).front();
  CHECK(open.lowest > 0);
  CHECK(open.highest == std::numeric_limits<double>::infinity());
}

TEST_CASE("a point without an answer is a value with a reason", "[core][objective]") {
  const auto reason = [](const Evaluate& evaluate, std::string_view output = "rolling_resistance") {
    const Objective f = objective(plain_scene(), {{"speed"}}, output, evaluate);
    const ObjectiveValue answer = value_at(f, base_point(f));
    CHECK_FALSE(answer.found());
    CHECK(std::isnan(answer.value));
    return answer.reason;
  };
  CHECK(reason([](const RollingScene&) -> RollingSolution { throw std::invalid_argument("speed = 1: no"); }) ==
        "speed = 1: no");
  CHECK(reason([](const RollingScene&) {
          RollingSolution stopped;
          stopped.rolling_resistance = 7;
          stopped.reason = "residual 0.1";
          return stopped;
        }) == "residual 0.1");
  CHECK(reason([](const RollingScene&) { return RollingSolution{}; }) == "not_converged");
  CHECK(reason(closed_form, "half_width") == "half_width: absent from the answer");
  const Objective broken = objective(plain_scene(), {{"speed"}}, "rolling_resistance",
                                     [](const RollingScene&) -> RollingSolution { throw std::runtime_error("disk"); });
  CHECK_THROWS_AS(value_at(broken, base_point(broken)), std::runtime_error);
}

TEST_CASE("wrong inputs and outputs of an objective are refused by name", "[core][objective]") {
  const auto refusal = [](const std::vector<InputChoice>& inputs, std::string_view output = "rolling_resistance") {
    return message_of([&] { objective(plain_scene(), inputs, output, closed_form); });
  };
  CHECK(refusal({{"sped"}}) == "sped: unknown input; did you mean speed?");
  CHECK(refusal({{"method"}}) == "method: must be an input that is a real number");
  CHECK(refusal({{"series_terms"}}) == "series_terms: must be an input that is a real number");
  CHECK(refusal({{"approach"}}) == "approach: must be in the scene to be varied");
  CHECK(refusal({{"speed"}, {"speed"}}) == "speed: input given twice");
  CHECK(refusal({{"speed", 1.0, 1.0}}) == "speed = 1: must have room between its bounds");
  CHECK(refusal({{"speed", 2.0}}) == "speed = 1: must be inside its bounds");
  CHECK(refusal({{.key = "rotation_ratio"}}) == "rotation_ratio: must be in the scene to be varied");
  CHECK(refusal({{"speed"}}, "rolling_resistanse") ==
        "rolling_resistanse: unknown output; did you mean rolling_resistance?");
  CHECK(refusal({{"speed"}}, "contact_nodes") == "contact_nodes: must be an output that is a real number");
  RollingScene half_space = plain_scene();
  half_space.layer_thickness = std::numeric_limits<double>::infinity();
  CHECK(message_of([&] { variables_of(half_space, {{"layer_thickness"}}); }) ==
        "layer_thickness = \"infinite\": must be finite to be varied");
  half_space.creep_time = 0;
  CHECK(message_of([&] { variables_of(half_space, {{.key = "creep_time", .logarithmic = true}}); }) ==
        "creep_time = 0: must be > 0 within its bounds to be varied in its logarithm");
}
