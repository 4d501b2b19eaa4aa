#include "fitting/fit/resistance_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <mutex>

#include "fitting/fit/closed_form_start.hpp"
#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"

// Covers fit_problem, descent, fit_report, fit_status and fit_errors, too.

using namespace rollres;

namespace {

/// Rough values, the same for the same scene: a relative noise of deviation 1e-3, another one for each draw.
Evaluate noisy_resistance(int draw) {
  return [draw](const RollingScene& scene) {
    RollingSolution solution = quick_resistance(scene);
    double scattered = std::sin(1e7 * solution.rolling_resistance + 0.37 * draw) * 43758.5453;
    scattered -= std::floor(scattered);
    solution.rolling_resistance *= 1 + 1e-3 * std::sqrt(12.0) * (scattered - 0.5);
    return solution;
  };
}

FitProblem known(FitProblem problem) {
  problem.deviations_known = true;
  return problem;
}

double error_of(const FitReport& report, std::size_t parameter, double truth) {
  return std::abs(report.parameters[parameter].value / truth - 1);
}

/// Fixed data: Hunter's resistances of R = 0.1 m, G0 = 1 MPa, f = 2, tau = 0.1 s with errors of 2 %, rounded.
std::vector<MeasuredScene> fixed_data() {
  struct Row {
    double speed, load, resistance, deviation;
  };
  constexpr Row rows[] = {{0.02, 10000, 123.4, 2.47}, {0.05, 10000, 273.57, 5.44}, {0.1, 10000, 428.27, 8.61},
                          {0.2, 10000, 510.07, 10.4}, {0.5, 10000, 404.5, 8.16},   {1, 10000, 273.65, 5.58},
                          {2, 10000, 176.86, 3.53},   {0.02, 40000, 527.18, 10.3}, {0.05, 40000, 1197.3, 24.2},
                          {0.1, 40000, 2148.6, 43.5}, {0.2, 40000, 3478.8, 68.9},  {0.5, 40000, 4119.3, 81.8},
                          {1, 40000, 3272.6, 65.3},   {2, 40000, 2192, 44.7}};
  std::vector<MeasuredScene> scenes;
  for (const Row& row : rows)
    scenes.push_back({half_space_scene(row.speed, row.load), {row.resistance, row.deviation, "row"}});
  return scenes;
}

}  // namespace

TEST_CASE("errors, correlations and intervals agree with lmfit on the same residuals", "[fitting][resistance_fit]") {
  // lmfit 1.1.0 (scipy 1.10.1): Hunter's equations with scipy's Bessel functions, parameters G0, f, tau, leastsq;
  // scale_covar False and True; conf_interval for the profiles of the scaled fit, and for the unscaled one the roots
  // of chi squared's rise of 3.8415 by brentq.
  FitProblem problem = resistance_problem(fixed_data(), zener_inputs(), hunter_resistance);
  const double values[] = {997672.3, 1.9752460, 0.10084480};

  SECTION("known deviations are absolute") {
    const FitReport report = fit(known(problem));
    CHECK(report.chi_squared == Approx(4.5899594).epsilon(1e-5));
    CHECK(report.degrees == 11);
    const double errors[] = {160479.8, 0.3631970, 0.006799967};
    for (std::size_t j = 0; j < 3; ++j) {
      CHECK(report.parameters[j].value == Approx(values[j]).epsilon(1e-3));
      CHECK(report.parameters[j].standard_error == Approx(errors[j]).epsilon(0.01));
    }
    CHECK(report.errors.correlations(0, 1) == Approx(0.9976098).epsilon(1e-3));
    CHECK(report.errors.correlations(0, 2) == Approx(-0.9924298).epsilon(1e-3));
    CHECK(report.errors.correlations(1, 2) == Approx(-0.9913880).epsilon(1e-3));
    const double lowest[] = {705484.63, 1.3731040, 0.089393894}, highest[] = {1340496.2, 2.8589335, 0.11703329};
    for (std::size_t j = 0; j < 3; ++j) {
      CHECK(report.parameters[j].profile.interval.lowest == Approx(lowest[j]).epsilon(0.01));
      CHECK(report.parameters[j].profile.interval.highest == Approx(highest[j]).epsilon(0.01));
    }
  }
  SECTION("unknown ones are scaled by the reduced chi squared") {
    const FitReport report = fit(problem);
    CHECK(report.reduced_chi_squared == Approx(0.41726904).epsilon(1e-5));
    CHECK(std::isnan(report.p_value));
    const double errors[] = {103664.1, 0.2346121, 0.004392532};
    const double lowest[] = {780913.9, 1.518333, 0.09218917}, highest[] = {1240941.2, 2.577753, 0.1119601};
    for (std::size_t j = 0; j < 3; ++j) {
      CHECK(report.parameters[j].standard_error == Approx(errors[j]).epsilon(0.01));
      CHECK(report.parameters[j].profile.interval.lowest == Approx(lowest[j]).epsilon(0.01));
      CHECK(report.parameters[j].profile.interval.highest == Approx(highest[j]).epsilon(0.01));
    }
  }
}

TEST_CASE("exact data of Hunter's cylinder give back its material", "[fitting][resistance_fit]") {
  const auto scenes = measured(hunter_resistance, spread_speeds(0.003, 3, 8), {1e4, 3e4});
  const FitReport report = fit(resistance_problem(scenes, zener_inputs(), hunter_resistance), {.profiles = false});
  CHECK(error_of(report, 0, 1e6) < 1e-3);
  CHECK(error_of(report, 1, 2) < 1e-3);
  CHECK(error_of(report, 2, 0.1) < 1e-3);
}

TEST_CASE("moduli of a Prony series are fitted to resistances, as smooth as is asked", "[fitting][resistance_fit]") {
  RollingScene solid = half_space_scene(1, 1e4);
  solid.material = MaterialModel::prony;
  solid.relaxation_times = {0.003, 0.03, 0.3};
  solid.relaxation_moduli = {1e6, 2.5e6, 1.5e6};
  std::vector<MeasuredScene> scenes;
  for (const double speed : spread_speeds(0.005, 20, 14)) {
    solid.speed = speed;
    const double exact = quick_resistance(solid).rolling_resistance;
    scenes.push_back({solid, {exact, 0.01 * exact, "row"}});
    scenes.back().scene.relaxation_moduli.assign(3, 2e6);  // where the fit starts
  }
  std::vector<FittedInput> inputs{{{"static_shear_modulus"}, 2e6}};
  for (const char* const key : {"relaxation_moduli[0]", "relaxation_moduli[1]", "relaxation_moduli[2]"})
    inputs.push_back({{key}});
  const FitReport exact = fit(known(resistance_problem(scenes, inputs, quick_resistance)), {.profiles = false});
  CHECK(error_of(exact, 0, 1e6) < 1e-3);
  for (std::size_t j = 0; j < 3; ++j) CHECK(error_of(exact, 1 + j, solid.relaxation_moduli[j]) < 1e-3);

  const auto roughness = [&](double smooth) {
    inputs[2].smooth = inputs[3].smooth = smooth;
    const FitReport report = fit(known(resistance_problem(scenes, inputs, quick_resistance)), {.profiles = false});
    CHECK(report.values.size() == scenes.size() + 2);
    return std::log(report.parameters[2].value / report.parameters[1].value);
  };
  const double drawn = std::log(2.5);
  CHECK(roughness(100) == Approx(drawn).epsilon(1e-3));  // says nothing
  const double some = roughness(0.1);
  CHECK(some < 0.99 * drawn);
  CHECK(some > 0);
  CHECK(std::abs(roughness(1e-4)) < 1e-2);  // leaves no room
}

TEST_CASE("a fit without starts begins at closed forms", "[fitting][resistance_fit]") {
  const auto scenes = measured(hunter_resistance, spread_speeds(0.003, 3, 8), {1e4, 3e4});
  for (const MeasuredScene& row : scenes) {
    const double ratio = estimated_resistance(row.scene) / row.measured.value;
    CHECK(ratio > 0.4);
    CHECK(ratio < 2.5);
  }
  const auto started = with_closed_form_starts(scenes, {{{"static_shear_modulus"}}, {{"stiffening"}}, {{"creep_time"}}},
                                               "rolling_resistance");
  CHECK(std::abs(std::log(*started[2].start / 0.1)) < 1);
  const FitReport report = fit(resistance_problem(scenes, started, hunter_resistance), {.profiles = false});
  CHECK(error_of(report, 2, 0.1) < 1e-3);
}

TEST_CASE("speeds on one flank of the peak do not identify the material", "[fitting][resistance_fit]") {
  // Far below the peak the resistance is P V tau f/(1 + f)/R, whatever G0 is.
  const auto scenes = measured(quick_resistance, spread_speeds(1e-4, 1e-3, 8), {1e4}, 0.02);
  const FitReport report = fit(known(resistance_problem(scenes, zener_inputs(), quick_resistance)));
  INFO(report.reason);
  CHECK(name_of(report.status) == "NOT IDENTIFIED");
  CHECK_THAT(report.reason, Catch::Contains("static_shear_modulus"));
  CHECK(std::any_of(report.parameters.begin(), report.parameters.end(), [](const FittedParameter& fitted) {
    return fitted.profile.interval.open() && fitted.linear.open() &&
           fitted.flag.find("not bounded") != std::string::npos;
  }));
}

TEST_CASE("a step far below the model's noise is never called a success", "[fitting][resistance_fit]") {
  const auto scenes = measured(quick_resistance, spread_speeds(0.003, 3, 8), {1e4, 3e4}, 0.02);
  const FitReport forced =
      fit(known(resistance_problem(scenes, zener_inputs(), noisy_resistance(0), {.step = 1e-8})), {.profiles = false});
  CHECK(name_of(forced.status) == "NOT CONVERGED");
  CHECK_THAT(forced.reason, Catch::Contains("are noise") && Catch::Contains("1e-08"));
}

TEST_CASE("steps of its own carry a fit over the model's noise, and a place that noise holds it at is no success",
          "[fitting][resistance_fit]") {
  const auto scenes = measured(quick_resistance, spread_speeds(0.003, 3, 8), {1e4, 3e4}, 0.02);
  const FitReport smooth =
      fit(known(resistance_problem(scenes, zener_inputs(), quick_resistance)), {.profiles = false});
  // Which scenes are asked, and so their noise, hangs on the last digits: of 100 draws 99 were usable.
  int usable = 0;
  for (int draw = 0; draw < 8; ++draw) {
    const FitReport own =
        fit(known(resistance_problem(scenes, zener_inputs(), noisy_resistance(draw))), {.profiles = false});
    INFO("draw " << draw << ": " << own.reason);
    CHECK(own.noise > 3e-4);
    if (own.status < FitStatus::usable_with_warnings) continue;
    ++usable;
    CHECK(own.parameters[0].step > 1e-3);
    for (std::size_t j = 0; j < 3; ++j)
      CHECK(std::abs(own.parameters[j].value - smooth.parameters[j].value) < 3 * smooth.parameters[j].standard_error);
  }
  CHECK(usable >= 5);
}

TEST_CASE("a fit that ends where it started says so", "[fitting][resistance_fit]") {
  auto inputs = zener_inputs();
  inputs[0].start = 1e6, inputs[1].start = 2, inputs[2].start = 0.1;
  const auto scenes = measured(quick_resistance, spread_speeds(0.003, 3, 8), {1e4, 3e4});
  const FitProblem problem = known(resistance_problem(scenes, inputs, quick_resistance));
  const FitReport report = fit(problem, {.profiles = false});
  CHECK(name_of(report.status) == "DID NOT MOVE");
  CHECK_THAT(report.reason, Catch::Contains("where it started"));
  CHECK(fit(problem, {.starts = 3, .profiles = false}).status >= FitStatus::usable_with_warnings);
}

TEST_CASE("a parameter at its bound is flagged and no scene beyond a bound is evaluated", "[fitting][resistance_fit]") {
  const auto scenes = measured(quick_resistance, spread_speeds(0.003, 3, 8), {1e4, 3e4}, 0.02);
  auto inputs = zener_inputs();
  inputs[1].input.highest = 1.5;
  inputs[2].input.lowest = 0.02;
  std::mutex mutex;
  double highest = 0, lowest = 1;
  const Evaluate watched = [&](const RollingScene& scene) {
    const std::lock_guard lock(mutex);
    highest = std::max(highest, scene.stiffening);
    lowest = std::min(lowest, scene.creep_time);
    return quick_resistance(scene);
  };
  const FitReport report = fit(known(resistance_problem(scenes, inputs, watched)));
  INFO(report.reason);
  CHECK(report.status == FitStatus::usable_with_warnings);
  CHECK(report.parameters[1].value == 1.5);
  CHECK(report.parameters[1].flag == "at its upper bound");
  CHECK(std::isnan(report.parameters[1].standard_error));
  CHECK(report.parameters[1].profile.interval.high == IntervalEnd::open);
  CHECK(highest == 1.5);
  CHECK(lowest >= 0.02);
}

TEST_CASE("scenes without an answer are stepped back from and recorded", "[fitting][resistance_fit]") {
  const auto scenes = measured(quick_resistance, spread_speeds(0.003, 3, 8), {1e4, 3e4}, 0.02);
  const Evaluate fragile = [](const RollingScene& scene) {
    if (scene.stiffening < 2.05) return quick_resistance(scene);
    RollingSolution failed;
    failed.reason = "too stiff";
    return failed;
  };
  const FitProblem problem = known(resistance_problem(scenes, zener_inputs(), fragile));
  const FitReport report = fit(problem);
  CHECK(report.status == FitStatus::not_identified);
  CHECK(report.parameters[1].profile.interval.high == IntervalEnd::open);
  CHECK(report.failures > 0);
  REQUIRE(report.failure_reasons.size() == 1);
  CHECK(report.failure_reasons[0].reason == "too stiff");
  CHECK(report.failure_reasons[0].count == report.failures);

  const Evaluate broken = [](const RollingScene&) { return RollingSolution{}; };
  const FitReport none = fit(resistance_problem(scenes, zener_inputs(), broken));
  CHECK(none.status == FitStatus::not_converged);
  CHECK_THAT(none.reason, Catch::Contains("row 1"));
}

TEST_CASE("an outlier moves a robust fit by no more than its bounded influence", "[fitting][resistance_fit]") {
  // A residual pulls with at most c (Huber) or c/2 (Cauchy, at c), and so moves the parameters by at most that times
  // sqrt(a^T C a) standard errors: a its row of the whitened slopes, C the covariance of the fit without it.
  auto scenes = measured(quick_resistance, spread_speeds(0.003, 3, 10), {1e4, 3e4}, 0.01, 5, 0.01);
  constexpr std::size_t outlier = 4;
  const auto all = [&](const FitReport& report) {
    return Eigen::Vector3d(report.parameters[0].value, report.parameters[1].value, report.parameters[2].value);
  };
  for (const Loss loss : {Loss::none, Loss::huber, Loss::cauchy})
    for (const bool deviations : {true, false}) {
      const auto fitted = [&](const std::vector<MeasuredScene>& rows) {
        FitProblem problem = resistance_problem(rows, zener_inputs(), quick_resistance);
        problem.loss = loss;
        problem.loss_scale = usual_loss_scale(loss);
        problem.deviations_known = deviations;
        return fit(problem, {.profiles = false});
      };
      auto others = scenes, spoilt = scenes;
      others.erase(others.begin() + outlier);
      spoilt[outlier].measured.value *= 1.6;
      const FitReport without = fitted(others), with = fitted(spoilt);
      CHECK(with.largest_residual == outlier);
      const Eigen::Matrix3d covariance = without.errors.covariance / without.errors.scale;
      const Eigen::Vector3d row = with.slopes.derivatives.row(outlier).transpose() / spoilt[outlier].measured.deviation;
      const Eigen::Vector3d moved =
          (all(with).array() / all(without).array())
              .log()
              .matrix()
              .cwiseProduct(Eigen::Vector3d(1, all(without)[1] / without.parameters[1].parameter.variable.size, 1));
      const double distance = std::sqrt(moved.dot(covariance.inverse() * moved));
      const double pull = usual_loss_scale(loss) / (loss == Loss::cauchy ? 2 : 1);
      const double bound = pull * std::sqrt(row.dot(covariance * row));
      CAPTURE(loss, deviations, distance, bound);
      // The weights of the other residuals follow, and the scale of 20 residuals is known to a fifth or so.
      if (loss == Loss::none)
        CHECK(distance > 4 * bound);  // the pull of 60 deviations is not bounded
      else
        CHECK(distance < 1.5 * bound);
    }
}

TEST_CASE("data sets share parameters and have their own", "[fitting][resistance_fit]") {
  // Two machines whose radius is not known well roll over the same layer.
  auto scenes = measured(quick_resistance, spread_speeds(0.003, 3, 8), {1e4, 3e4});
  for (MeasuredScene& row : scenes) row.set = "small";
  for (MeasuredScene row : std::vector(scenes)) {
    row.scene.radius = 0.15;
    row.measured.value = quick_resistance(row.scene).rolling_resistance;
    row.set = "large";
    scenes.push_back(row);
  }
  std::vector<FittedInput> inputs{{{"creep_time"}, 0.05}, {{"radius"}, 0.12, "small"}, {{"radius"}, 0.12, "large"}};
  const FitReport report = fit(resistance_problem(scenes, inputs, quick_resistance), {.profiles = false});
  CHECK(report.parameters[1].parameter.name == "radius (small)");
  CHECK(error_of(report, 0, 0.1) < 1e-6);
  CHECK(error_of(report, 1, 0.1) < 1e-6);
  CHECK(error_of(report, 2, 0.15) < 1e-6);
}

TEST_CASE("too few measurements, and a start outside its bounds, are refused", "[fitting][resistance_fit]") {
  auto scenes = measured(quick_resistance, {0.1, 1}, {1e4});
  CHECK_THAT(message_of([&] { fit(resistance_problem(scenes, zener_inputs(), quick_resistance)); }),
             Catch::Contains("2 measurements cannot tell 3 parameters"));
  CHECK_THAT(message_of([&] {
               fit_parameters(scenes, {{{"creep_time", 0.2, 1.0}, 0.1}});
             }),
             Catch::Contains("creep_time = 0.1") && Catch::Contains("inside its bounds"));
}

TEST_CASE(
    "the errors of a shift's constants are those of its slopes, though most rows are at the reference temperature",
    "[fitting][resistance_fit]") {
  std::vector<MeasuredScene> rows;
  for (const double temperature : {263.15, 293.15, 293.15, 313.15})
    for (const double speed : {0.02, 0.2, 2.0}) {
      RollingScene scene = half_space_scene(speed, 1e4);
      scene.temperature = temperature;
      scene.reference_temperature = 293.15;
      scene.wlf_c1 = 8.86;
      scene.wlf_c2 = 101.6;
      const double exact = quick_resistance(scene).rolling_resistance;
      rows.push_back({scene, {exact, 0.02 * exact, "row"}});
    }
  const FitProblem problem =
      known(resistance_problem(rows, {{{"wlf_c1"}, 9.0}, {{"wlf_c2"}, 100.0}}, quick_resistance));
  const FitReport report = fit(problem, {.profiles = false});
  CHECK(report.parameters[0].value == Approx(8.86).epsilon(1e-3));
  CHECK(report.parameters[1].value == Approx(101.6).epsilon(1e-3));
  // Slopes by central differences of a step that suits them, and what they say of the errors.
  Eigen::MatrixXd slopes(std::ssize(rows), 2);
  constexpr double step = 1e-4;
  for (Eigen::Index i = 0; i < slopes.rows(); ++i)
    for (Eigen::Index j = 0; j < 2; ++j) {
      const auto at = [&](double part) {
        RollingScene scene = rows[static_cast<std::size_t>(i)].scene;
        (j == 0 ? *scene.wlf_c1 : *scene.wlf_c2) *= 1 + part;
        return quick_resistance(scene).rolling_resistance / rows[static_cast<std::size_t>(i)].measured.deviation;
      };
      slopes(i, j) = (at(step) - at(-step)) / (2 * step);
    }
  const Eigen::MatrixXd covariance = (slopes.transpose() * slopes).inverse();
  for (const std::size_t j : {0U, 1U})
    CHECK(report.parameters[j].relative_error ==
          Approx(std::sqrt(covariance(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(j)))).epsilon(0.03));
}
