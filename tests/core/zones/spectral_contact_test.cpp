// Covers spectral_problem, spectral_system, spectral_sources, spectral_memory, spectral_field, added_slopes,
// surface_panels, spectral_solution, spectral_friction_limit,
// pattern_refinement, spectral_accuracy and spectral_work, too.

#include "core/zones/spectral_contact.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/model/scene_rules.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/core/zones/spectral_scenes.hpp"

using namespace rollres;

namespace {

bool says_missed(const RollingSolution& solution) {
  const std::vector<std::string>& warnings = solution.warnings;
  return std::any_of(warnings.begin(), warnings.end(),
                     [](const std::string& warning) { return warning.find("was not reached") != std::string::npos; });
}

}  // namespace

TEST_CASE("the cylinder of Zehil and Gavin has the resistance of two independent programs", "[core][spectral]") {
  const RollingSolution rolling = spectral(gridless_cylinder(0.2));
  CHECK(rolling.rolling_resistance == Approx(357.1785671916).epsilon(1e-9));
  CHECK(rolling.rotation_ratio == Approx(1.040730611).epsilon(1e-9));
  CHECK(rolling.trailing_edge == Approx(-3.482414e-3).epsilon(1e-6));
  CHECK(rolling.leading_edge == Approx(3.993285e-3).epsilon(1e-6));
  CHECK(rolling.energy_residual < 1e-8);
  CHECK(rolling.error_estimate < 1e-8);
  const RollingSolution smooth = spectral(gridless_cylinder(0));
  CHECK(smooth.rolling_resistance == Approx(370.2717666).epsilon(1e-9));
  CHECK(smooth.energy_residual < 1e-8);
}

TEST_CASE("the estimate itself meets a tolerance, also with a given rotation and compressible layers",
          "[core][spectral][long]") {
  RollingScene scene = gridless_cylinder(0.2);
  scene.drive = Drive::rotation;
  scene.poisson_ratio = 0.3;
  for (const double rotation : {1.002, 1.05})
    for (const double tolerance : {1e-5, 1e-6, 1e-9}) {
      scene.rotation_ratio = rotation;
      scene.tolerance = tolerance;
      const RollingSolution solution = spectral(scene);
      CHECK(solution.error_estimate <= tolerance);
      CHECK(!says_missed(solution));
    }
}

TEST_CASE("a tolerance beyond what rounding allows is answered with the best, and warned of", "[core][spectral]") {
  RollingScene scene = gridless_cylinder(0.2);
  scene.drive = Drive::rotation;
  scene.rotation_ratio = 0.99;
  scene.poisson_ratio = 0.3;
  scene.tolerance = 1e-9;
  const RollingSolution reached = spectral(scene);
  scene.tolerance = 1e-12;
  const RollingSolution best = spectral(scene);
  CHECK(best.error_estimate < 1e-9);
  CHECK(best.rolling_resistance == Approx(reached.rolling_resistance).epsilon(1e-9));
  CHECK(says_missed(best));
}

TEST_CASE("a wanted error is kept, and the estimate is not below the error", "[core][spectral]") {
  for (const double tolerance : {1e-4, 1e-6, 1e-10}) {
    RollingScene scene = gridless_cylinder(0.2);
    scene.tolerance = tolerance;
    const RollingSolution solution = spectral(scene);
    CHECK(solution.error_estimate <= tolerance);
    CHECK(std::abs(solution.rolling_resistance / 357.1785671916 - 1) < tolerance);
  }
}

TEST_CASE("a spectral solution obeys the power balance with every drive", "[core][spectral]") {
  for (const Drive drive : {Drive::top_force, Drive::torque, Drive::free, Drive::rotation})
    for (const double thickness : {0.005, 0.0015, 0.1}) {
      RollingScene scene = gridless_cylinder(0.3);
      scene.layer_thickness = thickness;
      scene.drive = drive;
      if (drive == Drive::torque) scene.driving_torque = 30;
      if (drive == Drive::rotation) scene.rotation_ratio = 0;
      const RollingSolution solution = spectral(scene);
      CAPTURE(name_of(drive), thickness);
      CHECK(solution.energy_residual < 1e-8);
      if (drive == Drive::torque) CHECK(solution.driving_torque == Approx(30).epsilon(1e-9));
      if (drive == Drive::free) CHECK(std::abs(solution.driving_torque) < 1e-9 * *scene.load * scene.radius);
      if (drive == Drive::top_force)
        CHECK(solution.driving_torque == Approx(solution.driving_force * scene.radius).epsilon(1e-8));
    }
}

TEST_CASE("an approach leads back to the load that leads to it", "[core][spectral]") {
  for (const double friction : {0.0, 0.2}) {
    RollingScene scene = gridless_cylinder(friction);
    const RollingSolution loaded = spectral(scene);
    scene.load.reset();
    scene.approach = loaded.approach;
    const RollingSolution approached = spectral(scene);
    CHECK(approached.load == Approx(20e3).epsilon(1e-8));
    CHECK(approached.rolling_resistance == Approx(loaded.rolling_resistance).epsilon(1e-8));
  }
}

TEST_CASE("a spectrum of memories from far below the contact to far beyond it obeys all laws", "[core][spectral]") {
  const double compliance = 1 / 6e6;
  const CreepSpectrum spectrum{
      compliance,
      {{0.2 * compliance, 1e-4}, {0.3 * compliance, 0.01}, {0.5 * compliance, 0.4}, {0.4 * compliance, 50}}};
  for (const double thickness : {0.005, static_cast<double>(INFINITY)})
    for (const double friction : {0.0, 0.3}) {
      RollingScene scene = gridless_cylinder(friction);
      scene.layer_thickness = thickness;
      const SpectralOutcome outcome = solve_spectral(scene, spectrum);
      INFO(outcome.reason);
      REQUIRE(outcome.solution);
      CHECK(outcome.solution->law_violation < 1e-8);
      CHECK(outcome.solution->energy_residual < 1e-7);
    }
}

TEST_CASE("one memory split into two nearly equal ones is one memory", "[core][spectral]") {
  const RollingScene scene = gridless_cylinder(0.2);
  const double compliance = 1 / 6e6;
  const CreepSpectrum split{compliance, {{0.5 * compliance, 0.25 * (1 - 1e-4)}, {0.5 * compliance, 0.25 * (1 + 1e-4)}}};
  const SpectralOutcome outcome = solve_spectral(scene, split);
  REQUIRE(outcome.solution);
  // Second order in the difference of the times.
  CHECK(outcome.solution->rolling_resistance == Approx(357.1785671916).epsilon(1e-7));
}

TEST_CASE("a memory far longer than the passage leaves the approach as it is", "[core][spectral]") {
  RollingScene scene = gridless_cylinder(0);
  scene.material = MaterialModel::prony;
  scene.static_shear_modulus = 0.8e6;
  scene.relaxation_times = {2e-6, 1e-4, 4};  // the first far below the contact
  scene.relaxation_moduli = {8e6, 4e6, 0.2e6};
  const RollingSolution without = spectral(scene);
  scene.static_shear_modulus = 0.2e6;
  scene.relaxation_times.push_back(1e9);
  scene.relaxation_moduli.push_back(0.6e6);
  const RollingSolution with = spectral(scene);
  // It relaxes by 1e-11 over the layer's reach of a decimetre.
  CHECK(with.approach == Approx(without.approach).epsilon(1e-9));
}

TEST_CASE("the largest pressure is known to what is said where it stands in the boundary layer of short memories",
          "[core][spectral]") {
  RollingScene scene;
  scene.radius = 8.82e-3;
  scene.layer_thickness = static_cast<double>(INFINITY);
  scene.material = MaterialModel::fractional_zener;
  scene.static_shear_modulus = 4.02e6;
  scene.stiffening = 558.1;
  scene.creep_time = 1.137e-3;
  scene.fractional_order = 0.5877;
  scene.speed = 0.1384;
  scene.load = 79.48;
  scene.friction_coefficient = 0;
  const RollingScene whole = scene;
  BondedLayer lower;
  static_cast<MaterialInputs&>(lower) = scene;
  lower.layer_thickness = static_cast<double>(INFINITY);
  scene.layer_thickness = 117.16e-6;
  scene.lower_layers = {lower};
  // Of two layers fewer memories count as too short to matter.
  const double known = spectral(scene).peak_pressure;
  for (const double tolerance : {1e-3, 1e-4, 1e-6}) {
    for (RollingScene other : {whole, scene}) {
      other.tolerance = tolerance;
      const RollingSolution solution = spectral(other);
      CAPTURE(tolerance, solution.peak_pressure, solution.peak_pressure_error);
      CHECK(std::abs(solution.peak_pressure - known) < solution.peak_pressure_error);
      // 6e-5 where short memories leave the loss as it is, 6e-4 where they are elastic.
      if (tolerance == 1e-6) CHECK(solution.peak_pressure == Approx(known).epsilon(2e-4));
    }
  }
}

TEST_CASE("the resistance is smooth in the scene's numbers, and continuous where zones change", "[core][spectral]") {
  std::vector<double> logarithms;
  for (int i = 0; i < 24; ++i) {
    RollingScene scene = gridless_cylinder(0.2);
    *scene.load *= 1 + 0.1 * i / 199;
    logarithms.push_back(std::log(spectral(scene).rolling_resistance));
  }
  for (std::size_t i = 0; i + 4 < logarithms.size(); ++i) {
    const double* y = &logarithms[i];
    CHECK(std::abs(y[0] - 4 * y[1] + 6 * y[2] - 4 * y[3] + y[4]) < 1e-8);
  }
  // Slip at the leading edge begins between these.
  double last = 0;
  for (double friction = 0.140; friction < 0.1501; friction += 0.001) {
    const double resistance = spectral(gridless_cylinder(friction)).rolling_resistance;
    if (last > 0) CHECK(std::abs(resistance / last - 1) < 2e-4);
    last = resistance;
  }
}

TEST_CASE("a drive that asks for too much is refused with the friction that it needs", "[core][spectral]") {
  RollingScene scene = gridless_cylinder(0.004);
  const RollingSolution refused = solve(scene);
  CHECK(refused.method == Method::spectral);
  CHECK(refused.status == Status::no_steady_state);
  CHECK(refused.friction_needed == Approx(0.009).epsilon(0.05));
  RollingScene gridded = scene;
  gridded.spacing = 0.02e-3;
  CHECK(solve(gridded).friction_needed == Approx(refused.friction_needed).epsilon(0.01));
}

TEST_CASE("what the spectral method does not know is solved on a grid, and the answer says so", "[core][spectral]") {
  RollingScene scene = gridless_cylinder(0);
  scene.adhesion_threshold = 1e4;
  const RollingSolution solution = solve(scene);
  CHECK(solution.method == Method::newton);
  CHECK_THAT(solution.model, Catch::Contains("solved on a grid, not with continuous edges: adhesion"));
}

TEST_CASE("the spectral method is a cylinder's, without a grid or a period", "[core][spectral]") {
  RollingScene scene = with_method(paper_cylinder(), Method::spectral);
  CHECK(check(scene).empty());
  CHECK(solve(scene).warnings ==
        std::vector<std::string>{"spacing = 0.00025 m is not used by method spectral, which has no grid"});
  scene.period = 0.2;
  CHECK(check(scene) == std::vector<std::string>{"period = 0.2: not with method \"spectral\""});
  scene.period.reset();
  scene.indenter = Indenter::sphere;
  CHECK(check(scene) == std::vector<std::string>{"method = spectral: only for a cylinder"});
  scene.method = Method::automatic;
  CHECK(resolved_method(scene) == Method::newton);
  CHECK(resolved_method(paper_cylinder()) == Method::newton);
  CHECK(resolved_method(gridless_cylinder(0.2)) == Method::spectral);
}

TEST_CASE("the fields of a spectral solution are those of a fine grid", "[core][spectral]") {
  RollingScene gridded = gridless_cylinder(0.2);
  gridded.spacing = 0.02e-3;
  const RollingSolution fine = solve(gridded);
  const RollingSolution smooth = spectral(gridless_cylinder(0.2));
  const SurfaceFields &a = smooth.fields, &b = fine.fields;
  for (int i = 0; i < a.grid.columns; ++i) {
    const double x = a.grid.x(i), place = (x - b.grid.x(0)) / b.grid.spacing_x;
    const auto j = static_cast<std::size_t>(place);
    if (place < 0 || j + 1 >= b.w.size()) continue;
    const double part = place - static_cast<double>(j);
    const auto between = [&](const std::vector<double>& values) {
      return (1 - part) * values[j] + part * values[j + 1];
    };
    const auto k = static_cast<std::size_t>(i);
    CAPTURE(x);
    CHECK(a.w[k] == Approx(between(b.w)).margin(1e-2 * smooth.approach));
    CHECK(a.u[k] == Approx(between(b.u)).margin(1e-2 * smooth.approach));
    // The grid's pressure has its root at the edges smeared over a cell.
    CHECK(a.pressure[k] == Approx(between(b.pressure)).margin(0.05 * smooth.peak_pressure));
    CHECK(a.shear_x[k] == Approx(between(b.shear_x)).margin(0.1 * smooth.peak_shear_x));
  }
}

TEST_CASE("the approach of a slow cylinder, whose memories are much shorter than its contact, is that of a fine grid",
          "[core][spectral]") {
  RollingScene scene = gridless_cylinder(0);
  scene.friction_coefficient = 0;
  scene.speed = 1e-4;
  const RollingSolution limit = solve(scene);
  REQUIRE(limit.method == Method::spectral);
  scene.spacing = 0.02e-3;
  CHECK(solve(scene).approach == Approx(limit.approach).epsilon(2e-6));
}

TEST_CASE("on an elastic layer a driven cylinder has the edges and the borders of every law, whichever drive",
          "[core][spectral]") {
  RollingScene scene = gridless_cylinder(0.3);
  scene.material = MaterialModel::elastic;
  scene.method = Method::spectral;
  for (const double traction : {0.0, 0.02, -0.1, 0.2}) {
    scene.drive = Drive::torque;
    scene.driving_torque = traction * *scene.load * scene.radius;
    CAPTURE(traction);
    const RollingSolution driven = spectral(scene);
    CHECK(driven.law_violation < 5e-9);
    CHECK(driven.driving_torque == Approx(*scene.driving_torque).margin(1e-9 * *scene.load * scene.radius));
    // The rotation that it has, as a drive, gives the same torque.
    RollingScene turned = scene;
    turned.drive = Drive::rotation;
    turned.driving_torque.reset();
    turned.rotation_ratio = driven.rotation_ratio;
    if (traction != 0) CHECK(spectral(turned).driving_torque == Approx(driven.driving_torque).epsilon(1e-5));
    RollingScene gridded = scene;
    gridded.method = Method::newton;
    gridded.spacing = 0.02e-3;
    const RollingSolution grid = solve(gridded);
    CHECK(driven.rotation_ratio - 1 == Approx(grid.rotation_ratio - 1).epsilon(5e-3).margin(1e-5));
  }
}

TEST_CASE("memories that a tolerance lets count as elastic cost what is said under layers that differ",
          "[core][spectral][long]") {
  RollingScene scene;
  scene.radius = 0.116;
  scene.layer_thickness = 4.5e-3;
  scene.material = MaterialModel::fractional_zener;
  scene.static_shear_modulus = 17e6;
  scene.stiffening = 0.35;
  scene.creep_time = 0.25e-3;
  scene.fractional_order = 0.33;
  BondedLayer below;
  below.layer_thickness = 4.5e-3;
  below.static_shear_modulus = 77e6;
  below.stiffening = 0.2;
  below.creep_time = 0.5;
  scene.lower_layers = {below};
  scene.speed = 0.13;
  scene.load = 4.3e6;
  scene.drive = Drive::free;
  scene.method = Method::spectral;
  scene.tolerance = 1e-7;  // for which hardly any memory is left out
  const double whole = solve(scene).rolling_resistance;
  for (const double tolerance : {3e-3, 1e-3}) {
    scene.tolerance = tolerance;
    const RollingSolution solution = solve(scene);
    REQUIRE(solution.status == Status::converged);
    CAPTURE(tolerance, solution.error_estimate);
    const double off = std::abs(solution.rolling_resistance / whole - 1);
    CHECK(off > 1e-6);  // some memory was left out
    CHECK(off < solution.error_estimate);
  }
}

// A violation that stays as it is at higher orders refutes its pattern before the work for the next ones is spent.
TEST_CASE("an elastic layer under a driven cylinder, stuck on both sides of a slip, needs no grid", "[core][spectral]") {
  RollingScene scene;
  scene.radius = 0.1;
  scene.layer_thickness = 0.01;
  scene.material = MaterialModel::elastic;
  scene.speed = 1;
  scene.load = 1e5;
  scene.friction_coefficient = 0.3;
  for (const double part : {0.0, 1e-7, 1e-3, 3e-3, 1e-2}) {
    scene.static_shear_modulus = 2.0106e6 * (1 + part);
    const RollingSolution solution = solve(scene);
    CAPTURE(part);
    REQUIRE(solution.status == Status::converged);
    CHECK(solution.method == Method::spectral);
    CHECK(solution.error_estimate < 1e-7);
  }
}
