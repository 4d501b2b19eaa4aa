// Covers finite_newton, finite_surface, mesh_level too.

#include "core/finite_strain/finite_strain_contact.hpp"

#include <cmath>

#include "core/model/scene_rules.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/source_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

RollingScene finite_cylinder(double load, double friction) {
  RollingScene scene = with_method(paper_cylinder(), Method::finite_strain);
  scene.spacing.reset();
  scene.kinematics = Kinematics::consistent;
  scene.load = load;
  scene.friction_coefficient = friction;
  return scene;
}

RollingSolution answered(RollingScene scene) {
  scene.time_limit = patience(60);
  const RollingSolution solution = solve(scene);
  INFO(solution.reason << solution.model);
  REQUIRE(solution.status == Status::converged);
  CHECK(solution.method == Method::finite_strain);
  CHECK(solution.law_violation < 1e-8);
  CHECK(solution.energy_residual < 1e-3);
  return solution;
}

double relative(double value, double expected) { return std::abs(value / expected - 1); }

/// A covered cylinder on a rigid base.
RollingScene covered_roller(double radius, double thickness, double modulus) {
  RollingScene scene;
  scene.method = Method::finite_strain;
  scene.radius = radius;
  scene.layer_thickness = 0.01;
  scene.static_shear_modulus = 1e12;
  scene.inertia = Inertia::off;
  scene.speed = 1;
  BondedLayer cover;
  cover.layer_thickness = thickness;
  cover.static_shear_modulus = modulus;
  scene.coating_layers = {cover};
  return scene;
}

RollingScene viscoelastic_roller(double radius, double friction) {
  RollingScene scene = covered_roller(radius, 8e-3, 2e6);
  scene.coating_layers[0].material = MaterialModel::zener;
  scene.coating_layers[0].stiffening = 1.5;
  scene.coating_layers[0].creep_time = 5e-3;
  scene.load = 1 / radius;
  scene.friction_coefficient = friction;
  return scene;
}

}  // namespace

TEST_CASE("a cylinder at finite strain has the numbers of an independent program", "[core][finite]") {
  // Computed with a program of its own in Python, to 1e-3: paper_cylinder without friction.
  struct Row {
    double load, resistance, approach, contact, peak;
  };
  for (const Row& row :
       {Row{20e3, 372.87, 0.3709e-3, 7.447e-3, 3.5245e6}, Row{60e3, 1902.5, 0.6929e-3, 11.024e-3, 7.4206e6}}) {
    const RollingSolution solution = answered(finite_cylinder(row.load, 0));
    CHECK(relative(solution.rolling_resistance, row.resistance) < 1e-3);
    CHECK(relative(solution.approach, row.approach) < 1e-3);
    CHECK(relative(solution.contact_area, row.contact) < 1e-3);
    CHECK(relative(solution.peak_pressure, row.peak) < 1e-3);
    CHECK(solution.error_estimate < 1e-3);
  }
}

TEST_CASE("finite strain has edges and peaks as exactly as the resistance", "[core][finite][long]") {
  // The reference is the spectral method, at strains of 0.1 % and 1 %. With as many cells as the resistance alone
  // needs, the thin layer's contact is 0.8 % short and the peak of the quickly relaxing layer 5 % low.
  RollingScene thin = finite_cylinder(1000, 0);
  thin.radius = 8;
  thin.stiffening = 0.05;
  thin.creep_time = 2;
  RollingScene quick = finite_cylinder(1000, 0);
  quick.stiffening = 4;
  quick.creep_time = 0.03;
  for (RollingScene scene : {thin, quick}) {
    const RollingSolution finite = answered(scene);
    CHECK(finite.warnings.empty());
    scene.method = Method::spectral;
    const RollingSolution linear = solve(scene);
    CHECK(relative(finite.contact_area, linear.contact_area) < 6e-3);
    CHECK(relative(finite.peak_pressure, linear.peak_pressure) < 6e-3);
  }
}

TEST_CASE("finite strain tends to the linear theory at small loads", "[core][finite][long]") {
  const auto compare = [](RollingScene scene, double bound) {
    INFO(scene.poisson_ratio << ' ' << scene.friction_coefficient);
    const RollingSolution finite = answered(scene);
    scene.method = Method::automatic;
    const RollingSolution linear = solve(scene);
    REQUIRE(linear.status == Status::converged);
    CHECK(relative(finite.rolling_resistance, linear.rolling_resistance) < bound);
    CHECK(relative(finite.approach, linear.approach) < bound);
  };
  // d/H = 1e-3; what is of second order in it and the mesh's error.
  for (const double friction : {0.0, 0.2}) {
    compare(finite_cylinder(60, friction), 1e-3);
    RollingScene prony = finite_cylinder(60, friction);
    prony.material = MaterialModel::prony;
    prony.relaxation_times = {0.004, 0.05, 1};
    prony.relaxation_moduli = {2e6, 1e6, 1.5e6};
    compare(prony, 1e-3);
  }
  RollingScene compressible = finite_cylinder(60, 0);
  compressible.poisson_ratio = 0.45;
  compare(compressible, 1e-3);
  RollingScene layered = finite_cylinder(60, 0);
  layered.layer_thickness = 2e-4;
  layered.lower_layers.push_back({});
  layered.lower_layers[0].static_shear_modulus = 6e6;
  layered.lower_layers[0].stiffening = 0.5;
  layered.lower_layers[0].creep_time = 0.1;
  layered.lower_layers[0].layer_thickness = 3e-3;
  compare(layered, 1e-3);
}

TEST_CASE("an elastic layer at finite strain resists with nothing, whatever its load", "[core][finite][long]") {
  for (const double friction : {0.0, 0.2}) {
    RollingScene scene = finite_cylinder(120e3, friction);
    scene.material = MaterialModel::elastic;
    scene.drive = Drive::free;
    const RollingSolution solution = solve(scene);
    INFO(solution.reason);
    REQUIRE(solution.status == Status::converged);
    const double lever = solution.load * solution.leading_edge / scene.radius;
    // Without friction nothing of it is left but the mesh; with it a little is lost in slip.
    CHECK(std::abs(solution.rolling_resistance) < (friction > 0 ? 3e-3 : 1e-5) * lever);
    CHECK(std::abs(solution.viscous_loss) < 1e-3 * lever * scene.speed);
  }
}

TEST_CASE("Yeoh's layer is stiffer or softer than a neo-Hookean one, and the same at small loads",
          "[core][finite][long]") {
  const auto with_yeoh = [](double load, double friction, double second, double third) {
    RollingScene scene = finite_cylinder(load, friction);
    scene.yeoh_second = second;
    scene.yeoh_third = third;
    return answered(scene);
  };
  const RollingSolution plain = answered(finite_cylinder(60e3, 0));
  const RollingSolution stiffer = with_yeoh(60e3, 0, 0.5, 0.2), softer = with_yeoh(60e3, 0, -0.2, 0.03);
  CHECK(stiffer.approach < 0.99 * plain.approach);
  CHECK(softer.approach > 1.01 * plain.approach);
  CHECK(stiffer.contact_area < plain.contact_area);
  CHECK(softer.contact_area > plain.contact_area);
  CHECK_THAT(stiffer.model, Contains("Yeoh"));
  CHECK_THAT(plain.model, Contains("neo-Hookean"));
  with_yeoh(60e3, 0.3, 0.5, 0.2);  // `answered` balances its power
  // d/H = 1e-3: its terms are of second order in the strain.
  const RollingSolution small = with_yeoh(60, 0, 0.5, 0.2), linear = answered(finite_cylinder(60, 0));
  CHECK(relative(small.rolling_resistance, linear.rolling_resistance) < 1e-4);
  CHECK(relative(small.approach, linear.approach) < 1e-4);
}

TEST_CASE("Yeoh's viscoelastic layer is elastic where it flows slowly or quickly", "[core][finite]") {
  // What it remembers is the same function of the strain: elastic with the modulus at rest, and with the one at once.
  RollingScene scene = finite_cylinder(60e3, 0);
  scene.yeoh_second = 0.5;
  scene.yeoh_third = 0.2;
  RollingScene elastic = scene;
  elastic.material = MaterialModel::elastic;
  for (const double speed : {1e-7, 1e5}) {
    RollingScene flowing = scene;
    flowing.speed = speed;
    RollingScene limit = elastic;
    if (speed > 1) *limit.static_shear_modulus *= 1 + scene.stiffening;
    CHECK(relative(solve(flowing).approach, solve(limit).approach) < 1e-4);
  }
}

TEST_CASE("Yeoh's terms are refused where strains are small, and where the stress would fall", "[core][finite]") {
  const auto only_rule = [](const RollingScene& scene) {
    const std::vector<std::string> broken = check(scene);
    CAPTURE(broken);
    REQUIRE(broken.size() == 1);
    return broken.front();
  };
  RollingScene scene = paper_cylinder();
  scene.yeoh_third = 0.1;
  CHECK_THAT(only_rule(scene), Contains("yeoh_third = 0.1: only with method \"finite_strain\""));
  scene = finite_cylinder(20e3, 0);
  scene.lower_layers.resize(1);
  scene.lower_layers[0].layer_thickness = 1e-3;
  scene.lower_layers[0].static_shear_modulus = 1e6;
  scene.lower_layers[0].yeoh_second = -0.5;
  CHECK_THAT(only_rule(scene), Contains("lower_layers[0].yeoh_second = -0.5: ") && Contains("0.15"));
  scene.lower_layers[0].yeoh_third = 0.16;
  CHECK(check(scene).empty());
  scene.method = Method::automatic;
  CHECK_THAT(only_rule(scene), Contains("lower_layers[0].yeoh_second = -0.5: only with"));
}

TEST_CASE("a rubber-covered roller at finite strain has the nip that others have computed", "[core][finite]") {
  // Two finite element programs in plane strain, neo-Hookean, 70 mm over a core of 35 mm, 28 mm wide, E = 0.275 MPa,
  // nu = 0.475, 380 N: 49 mm and 0.43 MPa, 50.15 mm and 0.433 MPa. The linear theory of flat layers has 48.2 mm, 0.377
  // MPa.
  RollingScene roller = covered_roller(35e-3, 17.5e-3, 0.275e6 / (2 * 1.475));
  roller.coating_layers[0].poisson_ratio = 0.475;
  roller.load = 380 / 28e-3;
  const RollingSolution nip = answered(roller);
  CHECK(nip.contact_area > 49e-3);
  CHECK(nip.contact_area < 50.15e-3);
  CHECK(relative(nip.peak_pressure, 0.4315e6) < 0.015);
  // Elastic, and alike from both sides.
  CHECK(std::abs(nip.rolling_resistance) < 1e-9 * *roller.load);
  CHECK(std::abs(nip.viscous_loss) < 1e-9 * *roller.load);
}

TEST_CASE("a cover at finite strain is a ring of the linear theory at small loads", "[core][finite][long]") {
  // A flat cover would miss it by 1.6e-2 and 1.6e-3.
  for (const double radius : {0.05, 0.5}) {
    const RollingScene roller = viscoelastic_roller(radius, 0);
    RollingScene flat = roller;
    flat.method = Method::spectral;
    const RollingSolution bent = answered(roller), linear = solve(flat);
    CHECK(relative(bent.rolling_resistance, linear.rolling_resistance) < 4e-4);  // the mesh's error
  }
}

TEST_CASE("a cover at finite strain obeys its drive, and its power balances", "[core][finite][long]") {
  const double radius = 0.1;
  RollingScene roller = viscoelastic_roller(radius, 0.3);
  const double load = *roller.load;
  roller.drive = Drive::free;
  const RollingSolution free = answered(roller);
  CHECK(std::abs(free.driving_torque) < 1e-8 * load * radius);
  // Shear rises and falls again at the edge, within the mesh's first cells.
  for (const std::string& warning : free.warnings) CHECK_THAT(warning, StartsWith("peak_shear_x may be off"));
  CHECK(free.rotation_ratio < 1);  // the incompressible cover's surface is stretched in the nip

  roller.drive = Drive::torque;
  roller.driving_torque = 0.1 * load * radius;
  const RollingSolution driven = answered(roller);
  CHECK(relative(driven.driving_torque, *roller.driving_torque) < 1e-8);
  CHECK(driven.rotation_ratio > free.rotation_ratio);
  CHECK(driven.driving_force < 0);

  roller.driving_torque.reset();
  // Locked the cover is at rest: it answers as an elastic one of its modulus at rest, and all of it slides.
  roller.drive = Drive::rotation;
  roller.rotation_ratio = 0;
  const RollingSolution locked = answered(roller);
  CHECK(relative(locked.driving_force, 0.3 * load) < 1e-8);
  CHECK(relative(locked.frictional_loss, 0.3 * load * roller.speed) < 1e-8);
  RollingScene elastic = roller;
  elastic.coating_layers[0].material = MaterialModel::elastic;
  elastic.coating_layers[0].stiffening = 0;
  CHECK(relative(locked.approach, solve(elastic).approach) < 1e-6);
}

TEST_CASE("friction at finite strain obeys the drive, and braking balances its power", "[core][finite][long]") {
  const RollingSolution top = answered(finite_cylinder(20e3, 0.2));
  CHECK(std::abs(top.driving_torque / 0.02 - top.driving_force) < 1e-8 * top.load);
  RollingScene scene = finite_cylinder(20e3, 0.2);
  scene.drive = Drive::torque;
  scene.driving_torque = -60;
  const RollingSolution braked = answered(scene);
  CHECK(relative(braked.driving_torque, -60) < 1e-9);
  CHECK(braked.rotation_ratio < top.rotation_ratio);
  CHECK(braked.frictional_loss > 0.1 * braked.rolling_resistance * scene.speed);
  // The same state, its rotation given.
  scene.drive = Drive::rotation;
  scene.driving_torque.reset();
  scene.rotation_ratio = braked.rotation_ratio;
  const RollingSolution turned = answered(scene);
  CHECK(relative(turned.driving_torque, -60) < 2e-3);  // of the meshes
  scene.rotation_ratio = 0;
  const RollingSolution locked = answered(scene);
  CHECK(locked.slip_nodes == locked.contact_nodes);
  CHECK(relative(locked.driving_torque, -0.2 * 20e3 * 0.02) < 0.2);
}

TEST_CASE("loads and approaches agree, up to a third of the layer", "[core][finite][long]") {
  for (const double share : {0.1, 0.3}) {
    RollingScene scene = finite_cylinder(1, 0);
    scene.load.reset();
    scene.approach = share * scene.layer_thickness;
    const RollingSolution pressed = answered(scene);
    scene.load = pressed.load;
    scene.approach.reset();
    const RollingSolution loaded = answered(scene);
    CHECK(relative(loaded.approach, pressed.approach) < 1e-4);
    CHECK(relative(loaded.rolling_resistance, pressed.rolling_resistance) < 1e-3);
  }
}

TEST_CASE("finite strain has fields that add up to the load", "[core][finite]") {
  const RollingSolution solution = answered(finite_cylinder(20e3, 0.2));
  const SurfaceFields& fields = solution.fields;
  double load = 0, largest = 0;
  for (std::size_t i = 0; i < fields.pressure.size(); ++i) {
    load += fields.pressure[i] * fields.grid.spacing_x;
    largest = std::max(largest, fields.pressure[i]);
    CHECK(std::abs(fields.shear_x[i]) <= 0.2 * fields.pressure[i] + 0.02 * solution.peak_pressure);
    CHECK((fields.pressure[i] > 0) == (fields.zone[i] != Zone::free));
  }
  CHECK(relative(load, 20e3) < 0.1);  // by undeformed length; the surface is stretched
  CHECK(relative(largest, solution.peak_pressure) < 0.01);
}

TEST_CASE("fields at finite strain end where the mesh of a thin layer ends", "[core][finite]") {
  RollingScene thin = finite_cylinder(0, 0.2);
  thin.radius = 100;
  thin.layer_thickness = 5e-3;
  thin.load.reset();
  thin.approach = 40e-6;
  const RollingSolution solution = answered(thin);
  const SurfaceFields& fields = solution.fields;
  // The mesh goes ten thicknesses and half a contact beyond the edges; two half-widths are more.
  const double half = 0.5 * solution.contact_area, beyond = 10 * thin.layer_thickness + half;
  REQUIRE(2 * half > beyond);
  const double first = fields.grid.first_column * fields.grid.spacing_x,
               last = first + (fields.grid.columns - 1) * fields.grid.spacing_x;
  CHECK(first == Approx(solution.trailing_edge - beyond).margin(fields.grid.spacing_x));
  CHECK(last == Approx(solution.leading_edge + beyond).margin(fields.grid.spacing_x));
  double load = 0;
  for (const double pressure : fields.pressure) load += pressure * fields.grid.spacing_x;
  CHECK(load == Approx(solution.load).epsilon(1e-2));
}

TEST_CASE("a body ten thousand contacts wide meets small strains: gaps are no differences of its radius",
          "[core][finite]") {
  RollingScene scene = finite_cylinder(0.0139, 0);
  scene.radius = 1.315e-3;
  scene.layer_thickness = 8.04e-9;
  scene.static_shear_modulus = 17.03e6;
  scene.stiffening = 0.78;
  scene.creep_time = 1.1e-6;
  scene.speed = 0.605;
  BondedLayer lower;
  lower.material = MaterialModel::elastic;
  lower.poisson_ratio = 0.48;
  lower.static_shear_modulus = 3.787e6;
  lower.layer_thickness = 13.33e-9;
  scene.lower_layers = {lower};
  const RollingSolution finite = answered(scene), small = solve(with_method(scene, Method::automatic));
  REQUIRE(small.status == Status::converged);
  CHECK(finite.contact_area < 1e-3 * scene.radius);
  CHECK(relative(finite.rolling_resistance, small.rolling_resistance) < 2e-3);
  CHECK(relative(finite.approach, small.approach) < 2e-3);
}

TEST_CASE("a slip zone of few nodes counts in the error of a resistance that is a small difference",
          "[core][finite][long]") {
  RollingScene scene = finite_cylinder(4.41, 0.28);
  scene.radius = 2.865e-3;
  scene.layer_thickness = 27.22e-6;
  scene.static_shear_modulus = 0.8814e6;
  scene.stiffening = 0.2;
  scene.creep_time = 0.583e-6;
  scene.speed = 1.322;
  scene.drive = Drive::torque;
  scene.driving_torque = 3.271e-4;
  scene.inertia = Inertia::off;
  scene.tolerance = 1e-2;
  const RollingSolution rough = answered(scene);
  scene.tolerance = 1e-3;
  scene.time_limit = patience(60);
  const RollingSolution fine = solve(scene);
  REQUIRE(fine.status == Status::converged);
  CHECK(std::abs(rough.rolling_resistance - fine.rolling_resistance) < 2 * rough.rolling_resistance_error);
  CHECK(rough.error_estimate < 1e-2);
}

TEST_CASE("inertia that a tolerance asks for is named by what asks for it", "[core][finite]") {
  RollingScene scene = finite_cylinder(20e3, 0);
  scene.speed = 3;
  scene.tolerance = 1e-3;
  const std::vector<std::string> broken = check(scene);
  REQUIRE(broken.size() == 1);
  CHECK_THAT(broken.front(), Contains("inertia counts for a tolerance of 0.001"));
  scene.inertia = Inertia::off;
  CHECK(check(scene).empty());
}

TEST_CASE("what finite strain does not model is refused in one line", "[core][finite]") {
  const auto refused = [](auto change) {
    RollingScene scene = finite_cylinder(20e3, 0);
    change(scene);
    const std::vector<std::string> broken = check(scene);
    CAPTURE(broken);
    REQUIRE(broken.size() == 1);
    CHECK_THAT(broken.front(), Contains("finite_strain"));
  };
  refused([](RollingScene& s) { s.indenter = Indenter::sphere; });
  refused([](RollingScene& s) { s.layer_thickness = INFINITY; });
  refused([](RollingScene& s) { s.period = 1; });
  refused([](RollingScene& s) { s.adhesion_threshold = 1e3; });
  refused([](RollingScene& s) { s.inertia = Inertia::on; });
  const auto covered = [](double base, double thickness) {
    return [=](RollingScene& s) {
      s.static_shear_modulus = base;
      s.coating_layers.push_back({});
      s.coating_layers[0].static_shear_modulus = 1e6;
      s.coating_layers[0].layer_thickness = thickness;
    };
  };
  refused(covered(3e6, 1e-3));
  refused([&](RollingScene& s) {
    covered(3e12, 1e-3)(s);
    s.drive = Drive::rotation;
    s.rotation_ratio = -1;
  });
}

TEST_CASE("a drive that asks for more than friction has no steady state at finite strain", "[core][finite][long]") {
  const RollingSolution solution = solve(finite_cylinder(20e3, 0.005));
  CHECK(solution.status == Status::no_steady_state);
  CHECK(relative(solution.friction_needed, 372.9 / 40e3) < 0.02);
}

TEST_CASE("a mesh keeps the limits of time and memory", "[core][finite][limits]") {
  RollingScene scene = finite_cylinder(20e3, 0.2);
  scene.time_limit = 1e-9;
  CHECK_THAT(solve(scene).reason, Contains("time_limit"));
  scene.time_limit.reset();
  scene.memory_limit = 1e4;
  CHECK_THAT(solve(scene).reason, Contains("the mesh"));
}
