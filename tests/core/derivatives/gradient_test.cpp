// Covers calibration, too.

#include "core/derivatives/gradient.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/reference/reference_hunter.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/core/scattered.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

template <class Function>
Evaluate as_resistance(Function function) {
  return [function](const RollingScene& scene) {
    RollingSolution solution;
    solution.rolling_resistance = function(scene);
    solution.status = Status::converged;
    return solution;
  };
}

/// A function of the speed alone, and its derivative.
double hill(double speed) { return 3 * speed / (1 + speed * speed) + 0.5 * std::pow(speed, 1.3); }
double hill_slope(double speed) {
  const double square = 1 + speed * speed;
  return 3 * (2 - square) / (square * square) + 0.65 * std::pow(speed, 0.3);
}

Objective of_speed(const Evaluate& evaluate, double speed = 1.7, std::optional<double> lowest = {},
                   std::optional<double> highest = {}, std::optional<bool> logarithmic = {}) {
  return objective(plain_scene(speed), {{"speed", lowest, highest, logarithmic}}, "rolling_resistance", evaluate);
}

InputGradient slope_of(const Objective& f, int order = 4) {
  const std::vector<double> point = base_point(f);
  return gradient(f, point, calibrate(f, point), {.order = order}).inputs.front();
}

double hunter(const RollingScene& scene) {
  return hunter_line(scene.radius, *scene.load, *scene.static_shear_modulus, scene.stiffening, scene.creep_time,
                     scene.speed)
      .rolling_resistance;
}

}  // namespace

TEST_CASE("on a half-space without friction Poisson's ratio acts through G/(1 - nu)", "[core][gradient]") {
  RollingScene base = paper_cylinder();
  base.layer_thickness = std::numeric_limits<double>::infinity();
  base.friction_coefficient = 0;
  base.spacing.reset();
  for (const double nu : {0.3, 0.5}) {
    CAPTURE(nu);
    base.poisson_ratio = nu;
    const Objective f = objective(base, {{"poisson_ratio"}, {"static_shear_modulus"}}, "rolling_resistance", solve);
    const Gradient found = gradient(f, base_point(f), calibrate(f, base_point(f)));
    const InputGradient &by_ratio = found.inputs[0], &by_modulus = found.inputs[1];
    CHECK(by_ratio.elasticity == Approx(nu / (1 - nu) * by_modulus.elasticity).epsilon(1e-6));
    CHECK(by_ratio.error() * nu < 1e-6 * std::abs(by_ratio.elasticity * found.centre.value));
  }
}

TEST_CASE("the gradient of Hunter's rolling resistance obeys dimensional analysis", "[core][gradient]") {
  RollingScene base = paper_cylinder();
  base.layer_thickness = std::numeric_limits<double>::infinity();
  for (const double speed : {0.001, 0.05, 1.0}) {
    base.speed = speed;
    const Objective f =
        objective(base, {{"load"}, {"speed"}, {"radius"}, {"static_shear_modulus"}, {"creep_time"}, {"stiffening"}},
                  "rolling_resistance", as_resistance(hunter));
    const std::vector<double> point = base_point(f);
    const Calibration calibration = calibrate(f, point);
    for (const int order : {2, 4}) {
      const Gradient answer = gradient(f, point, calibration, {.order = order});
      const auto e = [&](std::size_t i) { return answer.inputs[i].elasticity; };
      // rounding 2e-16 to the power 2/3 and 4/5, times ten
      const double tolerance = order == 2 ? 4e-10 : 3e-12;
      CHECK(e(1) == Approx(e(4)).margin(tolerance));             // only V τ matters
      CHECK(e(0) + e(3) == Approx(1).margin(tolerance));         // stresses by G0
      CHECK(e(0) + e(1) + e(2) == Approx(1).margin(tolerance));  // lengths by R
    }
  }
}

TEST_CASE("a power law has its exponent as elasticity at any scale", "[core][gradient]") {
  for (const double speed : {1e-6, 1.0, 1e8}) {
    const InputGradient slope = slope_of(
        of_speed(as_resistance([](const RollingScene& scene) { return 1e-4 * std::pow(scene.speed, 1.5); }), speed));
    CHECK(slope.elasticity == Approx(1.5).epsilon(1e-11));
    CHECK(slope.derivative == Approx(1.5e-4 * std::sqrt(speed)).epsilon(1e-11));
  }
}

TEST_CASE("a parabola in a linear variable is differentiated exactly", "[core][gradient]") {
  const Evaluate parabola = as_resistance([](const RollingScene& scene) { return 2 + std::pow(scene.speed - 1, 2); });
  for (const int order : {2, 4}) {
    const InputGradient slope = slope_of(of_speed(parabola, 1.5, {}, {}, false), order);
    CHECK(slope.derivative == Approx(1).epsilon(1e-14));
    CHECK(slope.error() < 1e-13);
    CHECK(std::abs(slope.derivative - 1) <= slope.error());
  }
}

TEST_CASE("the error of a gradient stays below its estimate under noise of any size", "[core][gradient]") {
  for (const double deviation : {1e-14, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3})
    for (const int order : {2, 4}) {
      constexpr int trials = 50;
      int covered = 0, noise_found = 0;
      double worst = 0;
      for (std::uint64_t seed = 0; seed < trials; ++seed) {
        const Objective f = of_speed(as_resistance([&](const RollingScene& scene) {
          return hill(scene.speed) * (1 + deviation * scatter(scene.speed, seed));
        }));
        const std::vector<double> point = base_point(f);
        const Calibration calibration = calibrate(f, point);
        const double ratio = calibration.inputs[0].size.noise / (deviation * hill(1.7));
        if (ratio > 1.0 / 3 && ratio < 3) ++noise_found;
        const InputGradient slope = gradient(f, point, calibration, {.order = order}).inputs[0];
        const double error = std::abs(slope.derivative - hill_slope(1.7));
        if (error <= slope.error()) ++covered;
        worst = std::max(worst, error / hill_slope(1.7));
      }
      CAPTURE(deviation, order);
      CHECK(noise_found >= 0.8 * trials);  // small samples; where two tables meet, a part is taken for curvature
      CHECK(covered >= 0.85 * trials);     // three deviations of a noise that is known within a factor of 3
      CHECK(worst < 50 * (order == 2 ? std::pow(deviation, 2.0 / 3) : std::pow(deviation, 0.8)) + 100 * deviation);
    }
}

TEST_CASE("jumps of a grid make the step wide", "[core][gradient]") {
  // a sawtooth over a smooth function: inside a tooth the slope is off by height / width = 1 %
  constexpr double height = 3e-4, width = 0.03;
  const double slope = hill_slope(1.7) * 1.7 / hill(1.7);
  for (int phase = 0; phase < 10; ++phase) {
    const Evaluate sawtooth = as_resistance([&](const RollingScene& scene) {
      const double place = std::log(scene.speed) / width + 0.1 * phase;
      return hill(scene.speed) * (1 + height * (place - std::floor(place)));
    });
    const Objective f = of_speed(sawtooth);
    const std::vector<double> point = base_point(f);
    const Calibration calibration = calibrate(f, point);
    const double noise = calibration.inputs[0].size.noise / hill(1.7);
    CHECK(noise > height / std::sqrt(12) / 3);  // the deviation of a sawtooth
    CHECK(noise < height / std::sqrt(12) * 4);
    for (const int order : {2, 4}) {
      const InputGradient answer = gradient(f, point, calibration, {.order = order}).inputs[0];
      CHECK(answer.step > width);
      CHECK(std::abs(answer.elasticity - slope) < answer.error() * 1.7 / hill(1.7));
      CHECK(answer.elasticity == Approx(slope).margin(0.9 * height / width));
    }
  }
}

TEST_CASE("what changes over a small part of an input's size is differentiated with steps of its own size",
          "[core][gradient]") {
  // as creepage does about rolling, and Poisson's ratio under a thin layer
  for (const double width : {0.3, 0.1, 0.01, 1e-3, 1e-4}) {
    CAPTURE(width);
    const Objective f = of_speed(
        as_resistance([&](const RollingScene& scene) { return 2 + std::tanh((scene.speed - 1.7) / width + 0.3); }));
    const InputGradient slope = slope_of(f);
    const double wanted = 1 / (width * std::pow(std::cosh(0.3), 2));
    CHECK(slope.derivative == Approx(wanted).epsilon(1e-5));
    CHECK(std::abs(slope.derivative - wanted) <= slope.error());
    CHECK(slope.error() < 1e-3 * wanted);
  }
}

TEST_CASE("steps belong to the scale of Poisson's ratio, creepage, temperature and torque", "[core][gradient]") {
  RollingScene scene = plain_scene();
  scene.friction_coefficient = 0.2;
  scene.temperature = scene.reference_temperature = 300;
  scene.wlf_c1 = 10;
  scene.wlf_c2 = 100;
  scene.poisson_ratio = 0.45;
  scene.drive = Drive::rotation;
  scene.rotation_ratio = 1.02;
  const Objective f = objective(scene, {{"temperature"}, {"poisson_ratio"}, {"rotation_ratio"}}, "rolling_resistance",
                                as_resistance([](const RollingScene&) { return 1.0; }));
  CHECK(f.variables[0].own_length == Approx(10));
  CHECK(f.variables[1].own_length == Approx(0.05));
  CHECK(f.variables[2].own_length == Approx(0.02));
  const Gradient found = gradient(f, base_point(f), calibrate(f, base_point(f)));
  for (std::size_t i = 0; i < 3; ++i)  // at most a tenth of it, but for rounding
    CHECK(found.inputs[i].step * f.variables[i].size <= 0.1001 * *f.variables[i].own_length);
  scene.drive = Drive::torque;
  scene.driving_torque = 0;
  CHECK(variables_of(scene, {{"driving_torque"}})[0].own_length == Approx(0.2 * 0.2 * *scene.load * scene.radius));
}

TEST_CASE("the error of the solutions is part of a gradient's, and largest tractions have a larger one",
          "[core][gradient]") {
  const auto error_of = [](double error, std::string_view output) {
    return slope_of(objective(plain_scene(1.7), {{"speed"}}, output, [error](const RollingScene& scene) {
      RollingSolution solution;
      solution.rolling_resistance = solution.peak_pressure = hill(scene.speed);
      solution.error_estimate = error;
      solution.status = Status::converged;
      return solution;
    }));
  };
  const InputGradient rough = error_of(1e-3, "rolling_resistance"), fine = error_of(1e-12, "rolling_resistance");
  const double slope = hill_slope(1.7);
  CHECK(rough.solution_error > 0.1e-3 * std::abs(slope));
  CHECK(rough.solution_error < 1e-2 * std::abs(hill(1.7)));
  CHECK(fine.error() < 1e-8 * std::abs(slope));
  CHECK(error_of(1e-8, "peak_pressure").solution_error > 100 * error_of(1e-8, "rolling_resistance").solution_error);
}

TEST_CASE("points known much worse than the centre are avoided, for they may be another method's", "[core][gradient]") {
  const auto poor_from = [](double edge, double until) {
    return of_speed([=](const RollingScene& scene) {
      const bool poor = scene.speed > edge && scene.speed <= until;
      RollingSolution solution;
      solution.rolling_resistance = hill(scene.speed) * (poor ? 1 + 2e-5 : 1);
      solution.error_estimate = poor ? 2e-5 : 1e-9;
      solution.status = Status::converged;
      return solution;
    });
  };
  const InputGradient beside = slope_of(poor_from(1.7, 1e3));
  CHECK(beside.scheme == Scheme::backward);
  CHECK(beside.failures.empty());
  CHECK(beside.derivative == Approx(hill_slope(1.7)).epsilon(1e-6));
  CHECK(std::abs(beside.derivative - hill_slope(1.7)) <= beside.error());
  // where there are no others they are better than nothing
  const Objective lonely = of_speed([](const RollingScene& scene) {
    RollingSolution solution;
    solution.rolling_resistance = hill(scene.speed);
    solution.error_estimate = scene.speed == 1.7 ? 1e-9 : 1e-3;
    solution.status = Status::converged;
    return solution;
  });
  CHECK(slope_of(lonely).derivative == Approx(hill_slope(1.7)).epsilon(1e-3));
}

TEST_CASE("derivatives by Poisson's ratio near 1/2, by creepage and by temperature agree with small differences",
          "[core][gradient]") {
  // Each changes an answer over a small part of its own size. The reference: two points beside the scene, so near that
  // what their difference misses is below 1e-4 of the derivative, as twice the distance confirms.
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  scene.layer_thickness = scene.radius / 30;
  scene.poisson_ratio = 0.495;
  scene.temperature = 295;
  scene.reference_temperature = 290;
  scene.wlf_c1 = 17.44;
  scene.wlf_c2 = 51.6;
  scene.approach = solve(scene).approach;
  scene.load.reset();
  scene.drive = Drive::rotation;
  scene.rotation_ratio = 1.003;
  struct Case {
    std::string key;
    double distance;
  };
  for (const Case& by : {Case{"poisson_ratio", 2e-5}, Case{"rotation_ratio", 1e-5}, Case{"temperature", 5e-3}}) {
    const auto value = [&](double distance) {
      RollingScene beside = scene;
      assign_real(beside, by.key, real_input(scene, by.key) + distance);
      return solve(beside).rolling_resistance;
    };
    const auto difference = [&](double distance) { return (value(distance) - value(-distance)) / (2 * distance); };
    const double near = difference(by.distance), far = difference(2 * by.distance);
    CAPTURE(by.key, near, far);
    REQUIRE(std::abs(near - far) < 1e-4 * std::abs(near));
    const InputGradient found = slope_of(objective(scene, {{by.key}}, "rolling_resistance", solve));
    CHECK(found.derivative == Approx(near).epsilon(3e-4));
    CHECK(found.error() < 1e-3 * std::abs(near));
  }
}

TEST_CASE("one jump near the point is not taken for a smooth function", "[core][gradient]") {
  const Objective f = of_speed(
      as_resistance([](const RollingScene& scene) { return hill(scene.speed) * (scene.speed > 1.72 ? 1 + 1e-5 : 1); }));
  const InputGradient slope = slope_of(f);
  CHECK(std::abs(slope.derivative - hill_slope(1.7)) <= slope.error());
  CHECK(slope.derivative == Approx(hill_slope(1.7)).epsilon(1e-3));
}

TEST_CASE("a staircase has its steps as noise, and what depends on nothing the derivative zero", "[core][gradient]") {
  const Objective stairs = of_speed(
      as_resistance([](const RollingScene& scene) { return std::floor(10 * scene.speed); }), 1.7, {}, {}, false);
  const double noise = calibrate(stairs, base_point(stairs)).inputs[0].size.noise;
  CHECK(noise > 0.28);  // the deviation of a staircase from a line is 1 / sqrt(12)
  CHECK(noise <= 1);
  const InputGradient step = slope_of(stairs);
  CHECK(std::abs(step.derivative - 10) <= step.error());
  const InputGradient flat = slope_of(of_speed(as_resistance([](const RollingScene&) { return 7.0; })));
  CHECK(flat.derivative == 0);
  CHECK(flat.error() < 1e-12);
}

TEST_CASE("no point outside the bounds is ever evaluated, and the gradient is as good at a bound", "[core][gradient]") {
  struct Case {
    double at, lowest, highest;
    Scheme scheme;
  };
  for (const bool logarithmic : {false, true})
    for (const Case& box : {Case{1.7, 1.7, 3, Scheme::forward}, Case{1.7, 1, 1.7, Scheme::backward},
                            Case{1.7, 1.7 - 1e-9, 3, Scheme::forward}, Case{1.7, 1.69, 1.71, Scheme::central},
                            Case{1.7, 1.7, 1.7001, Scheme::forward}, Case{1.7, 1.6999, 1.7001, Scheme::central}}) {
      double least = 1.7, most = 1.7;
      const Objective f = of_speed(as_resistance([&](const RollingScene& scene) {
                                     least = std::min(least, scene.speed);
                                     most = std::max(most, scene.speed);
                                     return hill(scene.speed);
                                   }),
                                   box.at, box.lowest, box.highest, logarithmic);
      for (const int order : {2, 4}) {
        const InputGradient slope = slope_of(f, order);
        CAPTURE(logarithmic, box.lowest, box.highest, order);
        CHECK(slope.scheme == box.scheme);
        CHECK(least >= box.lowest);
        CHECK(most <= box.highest);
        CHECK(std::abs(slope.derivative - hill_slope(1.7)) <= slope.error());
        CHECK(slope.derivative == Approx(hill_slope(1.7)).epsilon(1e-8));
      }
    }
  const Objective f = of_speed(closed_form, 1.7, 1.0, 2.0);
  const std::vector<double> outside{2.1};
  CHECK(message_of([&] { calibrate(f, outside); }) == "speed = 2.1: must be inside its bounds");
  CHECK(message_of([&] { gradient(f, outside, {}); }) == "speed = 2.1: must be inside its bounds");
}

TEST_CASE("beside points without an answer the formula is one-sided, and they are reported", "[core][gradient]") {
  for (const double edge : {1.71, 1.7001, 1.9}) {
    const Evaluate cliff = [edge](const RollingScene& scene) {
      RollingSolution solution;
      solution.rolling_resistance = hill(scene.speed);
      solution.status = scene.speed > edge ? Status::no_steady_state : Status::converged;
      if (scene.speed > edge) solution.reason = "too fast";
      return solution;
    };
    const Objective f = of_speed(cliff);
    const std::vector<double> point = base_point(f);
    const Calibration calibration = calibrate(f, point);
    REQUIRE_FALSE(calibration.inputs[0].failures.empty());
    CHECK(calibration.inputs[0].failures[0].reason == "too fast");
    CHECK(calibration.inputs[0].failures[0].value > edge);
    for (const int order : {2, 4}) {
      const InputGradient slope = gradient(f, point, calibration, {.order = order}).inputs[0];
      CHECK(std::abs(slope.derivative - hill_slope(1.7)) <= slope.error());
      CHECK(slope.derivative == Approx(hill_slope(1.7)).epsilon(1e-8));
    }
  }
}

TEST_CASE("without any answer beside the point there is no derivative, and without one at it no evaluation more",
          "[core][gradient]") {
  const Evaluate lonely = [](const RollingScene& scene) {
    RollingSolution solution;
    solution.rolling_resistance = 1;
    if (scene.speed == 1.7) solution.status = Status::converged;
    return solution;
  };
  const Objective f = of_speed(lonely);
  const std::vector<double> point = base_point(f), elsewhere{1.8};
  const Calibration calibration = calibrate(f, point);
  CHECK(std::isnan(calibration.inputs[0].size.noise));
  const Gradient answer = gradient(f, point, calibration);
  CHECK_FALSE(answer.complete());
  CHECK(answer.inputs[0].scheme == Scheme::none);
  CHECK(std::isnan(answer.inputs[0].derivative));
  CHECK(answer.inputs[0].failures.size() == static_cast<std::size_t>(answer.inputs[0].evaluations));
  CHECK(calibrate(f, elsewhere).inputs[0].evaluations == 0);
  CHECK(gradient(f, elsewhere, calibration).evaluations() == 0);
}

TEST_CASE("a calibration costs 8 evaluations for an input and table, at most 5 tables, a gradient then 2 or 4",
          "[core][gradient]") {
  int calls = 0;
  const Evaluate counted = as_resistance([&](const RollingScene& scene) {
    ++calls;
    return hill(scene.speed) * std::pow(*scene.load, 1.4);
  });
  const Objective f = objective(plain_scene(1.7), {{"speed"}, {"load"}}, "rolling_resistance", counted);
  const std::vector<double> point = base_point(f), elsewhere{1.5, 1.1e4};
  const Calibration calibration = calibrate(f, point);
  CHECK(calls == 1 + calibration.inputs[0].evaluations + calibration.inputs[1].evaluations);
  for (const InputCalibration& input : calibration.inputs) {
    CHECK(input.evaluations % 8 == 0);
    CHECK(input.evaluations <= 40);
  }
  for (const int order : {2, 4}) {
    calls = 0;
    CHECK(gradient(f, point, calibration, {.order = order}).evaluations() == calls);
    CHECK(calls == 2 * order);
    calls = 0;
    const Gradient answer = gradient(f, elsewhere, calibration, {.order = order});
    CHECK(calls == 1 + 2 * order);
    CHECK(answer.inputs[0].elasticity == Approx(hill_slope(1.5) * 1.5 / hill(1.5)).epsilon(1e-9));
    CHECK(answer.inputs[1].elasticity == Approx(1.4).epsilon(1e-9));
  }
}

TEST_CASE("several threads give the same gradient, and pass an exception on", "[core][gradient]") {
  const Evaluate product =
      as_resistance([](const RollingScene& scene) { return hill(scene.speed) * *scene.load / scene.radius; });
  const std::vector<InputChoice> inputs{{"speed"}, {"load"}, {"radius"}, {"creep_time"}};
  const Objective f = objective(plain_scene(), inputs, "rolling_resistance", product);
  const std::vector<double> point = base_point(f);
  const Gradient one = gradient(f, point, calibrate(f, point, 1), {.jobs = 1});
  const Gradient several = gradient(f, point, calibrate(f, point, 3), {.jobs = 3});
  for (std::size_t i = 0; i < inputs.size(); ++i) CHECK(one.inputs[i].derivative == several.inputs[i].derivative);

  Objective broken = f;
  broken.evaluate = [&](const RollingScene& scene) {
    if (*scene.load != point[1]) throw std::runtime_error("disk full");
    return product(scene);
  };
  CHECK(message_of([&] { calibrate(broken, point, 3); }) == "disk full");
}

TEST_CASE("the gradient of the solver agrees with dimensional analysis within its own error estimate",
          "[core][gradient]") {
  // the same grid follows the scaling, but a step meets other changes of the contact set in one input than in another
  const Objective f = objective(
      paper_cylinder(), {{"load"}, {"static_shear_modulus"}, {"speed"}, {"creep_time"}, {"friction_coefficient"}},
      "rolling_resistance", solve);
  const std::vector<double> point = base_point(f);
  const Gradient answer = gradient(f, point, calibrate(f, point));
  REQUIRE(answer.complete());
  const auto e = [&](std::size_t i) { return answer.inputs[i].elasticity; };
  const auto error = [&](std::size_t i) { return std::abs(answer.inputs[i].error() * point[i] / answer.centre.value); };
  CHECK(std::abs(e(0) + e(1) - 1) < error(0) + error(1));
  CHECK(std::abs(e(2) - e(3)) < error(2) + error(3));
  CHECK(error(0) + error(1) < 0.1);
  CHECK(e(4) < 0);
}

TEST_CASE("without a grid the gradient of a cylinder's resistance is right to 1e-7, of a sphere's to 1e-3",
          "[core][gradient][long]") {
  // From dimensional analysis: R_r/P is a function of P/(G0 R), H/R, V tau/R, f and mu (P/(G0 R^2) for a sphere).
  for (RollingScene scene : {paper_cylinder(), paper_sphere()}) {
    scene.spacing.reset();
    const bool sphere = scene.indenter == Indenter::sphere;
    const double wanted = sphere ? 1e-3 : 1e-7;
    const Objective f = objective(
        scene, {{"load"}, {"static_shear_modulus"}, {"speed"}, {"creep_time"}, {"radius"}, {"layer_thickness"}},
        "rolling_resistance", solve);
    const std::vector<double> point = base_point(f);
    const Gradient answer = gradient(f, point, calibrate(f, point));
    REQUIRE(answer.complete());
    const auto e = [&](std::size_t i) { return answer.inputs[i].elasticity; };
    CAPTURE(sphere, e(0), e(1), e(2), e(3), e(4), e(5));
    CHECK(std::abs(e(0) + e(1) - 1) < wanted);
    CHECK(std::abs(e(2) - e(3)) < wanted);
    CHECK(std::abs((sphere ? 2 : 1) * (e(0) - 1) + e(2) + e(4) + e(5)) < wanted);
    for (std::size_t i = 0; i < point.size(); ++i) {
      const InputGradient& input = answer.inputs[i];
      CHECK((input.truncation_error + input.noise_error) * point[i] / answer.centre.value < wanted);
      // these relations hold on any grid: its own error is counted apart, and is about that of the solution
      CHECK(input.solution_error * point[i] / answer.centre.value <
            1.5 * answer.centre.relative_error * std::max(1.0, std::abs(e(i))));
    }
  }
}
