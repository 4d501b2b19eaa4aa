/// Coated bodies that turn faster or slower than they roll: the coating flows through the contact at R Omega.

#include <cmath>
#include <complex>

#include "core/model/scene_rules.hpp"
#include "core/solve/model_answer.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/converged.hpp"
#include "tests/infinite.hpp"

using namespace rollres;

namespace {

/// A wheel with a rubber tyre on a hard floor.
RollingScene tyre(double stiffening = 1.5) {
  RollingScene scene;
  scene.radius = 0.05;
  scene.layer_thickness = infinite;
  scene.material = MaterialModel::elastic;
  scene.static_shear_modulus = 10e9;
  scene.speed = 1.1;
  scene.load = 8e3;
  scene.friction_coefficient = 0.5;
  BondedLayer coating;
  coating.layer_thickness = 0.012;
  coating.static_shear_modulus = 2e6;
  coating.stiffening = stiffening;
  coating.creep_time = 5e-3;
  scene.coating_layers = {coating};
  return scene;
}

RollingScene turning(RollingScene scene, double ratio) {
  scene.drive = Drive::rotation;
  scene.rotation_ratio = ratio;
  return scene;
}

/// A tyre of a soft wheel on a viscoelastic layer.
RollingScene soft_tyre_on_layer() {
  RollingScene scene = tyre();
  scene.layer_thickness = 0.01;
  scene.material = MaterialModel::zener;
  scene.static_shear_modulus = 3e6;
  scene.stiffening = 2;
  scene.creep_time = 2e-3;
  return scene;
}

}  // namespace

TEST_CASE("a locked coating answers with its modulus at rest", "[core][coating_flow]") {
  RollingScene scene = turning(tyre(), 0);
  RollingScene at_rest = turning(tyre(0), 0);
  at_rest.kinematics = scene.kinematics = Kinematics::printed;
  const RollingSolution locked = converged(scene), elastic = converged(at_rest);
  CHECK(locked.rolling_resistance == Approx(elastic.rolling_resistance).epsilon(1e-9));
  CHECK(locked.model.find("the body is locked: its coating is at rest") != std::string::npos);
  // On a hard road the pressure is vertical: what draws the body is mu P. The road of 10 GPa yields 1e-4 as much.
  RollingScene consistent = scene;
  consistent.kinematics = Kinematics::consistent;
  const RollingSolution drawn = converged(consistent);
  CHECK(drawn.rolling_resistance == Approx(scene.friction_coefficient * *scene.load).epsilon(1e-4));
  CHECK(drawn.rolling_resistance == Approx(drawn.driving_force).epsilon(1e-12));

  scene.method = Method::newton;
  scene.spacing = 0.025e-3;
  CHECK(converged(scene).rolling_resistance == Approx(locked.rolling_resistance).epsilon(1e-4));
}

TEST_CASE("a coating flowing at RΩ is one of RΩ/V as long memories flowing at V", "[core][coating_flow][long]") {
  const double ratio = GENERATE(0.5, 3.0);
  CAPTURE(ratio);
  // Without friction the rotation acts through the coating's memory alone, and is V/R where it is not given.
  RollingScene given = turning(soft_tyre_on_layer(), ratio);
  given.friction_coefficient = 0;
  RollingScene scaled = soft_tyre_on_layer();
  scaled.friction_coefficient = 0;
  SECTION("a Zener solid") { scaled.coating_layers[0].creep_time *= ratio; }
  SECTION("a fractional one") {
    for (RollingScene* const scene : {&given, &scaled}) {
      scene->coating_layers[0].material = MaterialModel::fractional_zener;
      scene->coating_layers[0].fractional_order = 0.6;
    }
    scaled.coating_layers[0].creep_time *= ratio;
  }
  SECTION("a master curve") {
    for (RollingScene* const scene : {&given, &scaled}) {
      BondedLayer& coating = scene->coating_layers[0];
      coating.material = MaterialModel::master_curve;
      coating.static_shear_modulus.reset();
      for (double frequency = 0.01; frequency < 1e5; frequency *= 2) {
        const std::complex<double> turn(0, 2 * M_PI * frequency * 5e-3);
        const std::complex<double> modulus = 2e6 * 2.5 * (1.0 + turn) / (2.5 + turn);
        coating.frequencies.push_back(scene == &scaled ? frequency / ratio : frequency);
        coating.storage_moduli.push_back(modulus.real());
        coating.loss_moduli.push_back(modulus.imag());
      }
    }
  }
  for (const Method method : {Method::spectral, Method::newton}) {
    CAPTURE(name_of(method));
    // A fractional ring remembers its earlier turns, on a grid.
    if (method == Method::spectral && given.coating_layers[0].material == MaterialModel::fractional_zener) continue;
    given.method = scaled.method = method;
    const RollingSolution got = converged(given), expected = converged(scaled);
    // A master curve is fitted twice. Tractions are the same, and with them force and torque; the torque turns at
    // another rate.
    CHECK(got.driving_force == Approx(expected.driving_force).epsilon(1e-6));
    CHECK(got.driving_torque == Approx(expected.driving_torque).epsilon(1e-6));
    CHECK(got.rolling_resistance ==
          Approx(expected.driving_force + ratio * expected.driving_torque / given.radius).epsilon(1e-6));
    CHECK(got.peak_pressure == Approx(expected.peak_pressure).epsilon(1e-6));
  }
}

TEST_CASE("a tyre sliding over a hard floor meets only the speed of its own surface", "[core][coating_flow]") {
  // All slides: the shear is mu p at any ratio.
  RollingScene slower = turning(tyre(), 0.5), faster = turning(tyre(), 0.25);
  faster.coating_layers[0].creep_time *= 2;
  const RollingSolution expected = converged(slower), got = converged(faster);
  CHECK(expected.slip_nodes == expected.contact_nodes);
  CHECK(got.driving_force == Approx(expected.driving_force).epsilon(1e-8));
  CHECK(got.driving_torque == Approx(expected.driving_torque).epsilon(1e-8));
  CHECK(got.peak_pressure == Approx(expected.peak_pressure).epsilon(1e-7));
}

TEST_CASE("where the drive leaves the rotation open the coating flows at the rotation found", "[core][coating_flow]") {
  for (const Drive drive : {Drive::free, Drive::top_force}) {
    CAPTURE(name_of(drive));
    RollingScene scene = tyre();
    scene.drive = drive;
    const RollingSolution open = converged(scene);
    CHECK(std::abs(open.rotation_ratio - 1) > 0.01);
    const RollingSolution given = converged(turning(tyre(), open.rotation_ratio));
    CHECK(given.rolling_resistance == Approx(open.rolling_resistance).epsilon(1e-8));
    CHECK(given.driving_torque == Approx(open.driving_torque).margin(1e-8 * scene.radius * *scene.load));
    CHECK(open.model.find("the coating flows at 0.97") != std::string::npos);
    // What is left of the search is in the estimate.
    CHECK(std::abs(given.rolling_resistance - open.rolling_resistance) <
          open.rolling_resistance_error + given.rolling_resistance_error);

    scene.method = Method::newton;
    scene.spacing = 0.025e-3;
    const RollingSolution grid = converged(scene);
    CHECK(grid.rolling_resistance == Approx(open.rolling_resistance).epsilon(2e-4));
    // Slip by forward differences: of first order in the spacing.
    CHECK(grid.rotation_ratio - 1 == Approx(open.rotation_ratio - 1).epsilon(5e-3));
  }
}

TEST_CASE("spectral and newton agree on turning coated bodies", "[core][coating_flow]") {
  for (const double ratio : {0.0, 0.4, 3.0}) {
    CAPTURE(ratio);
    RollingScene scene = turning(soft_tyre_on_layer(), ratio);
    scene.load = 5e3;
    const RollingSolution limit = converged(scene);
    CHECK(limit.method == Method::spectral);
    scene.method = Method::newton;
    scene.spacing = 0.025e-3;
    const RollingSolution grid = converged(scene);
    CHECK(grid.rolling_resistance == Approx(limit.rolling_resistance).epsilon(2e-4));
    CHECK(grid.peak_pressure == Approx(limit.peak_pressure).epsilon(1e-3));
  }
}

TEST_CASE("spectral and newton agree on the friction that a drive of a coated body needs", "[core][coating_flow]") {
  // Newton slides the body to find it, at a rotation at which the coating does not flow.
  RollingScene scene = soft_tyre_on_layer();
  scene.friction_coefficient = 0.002;
  scene.load = 3e3;  // at larger ones the creepage, and with it the flow, matters
  const RollingSolution spectral = solve(scene);
  scene.method = Method::newton;
  const RollingSolution newton = solve(scene);
  for (const RollingSolution& refused : {spectral, newton}) {
    CHECK(refused.status == Status::no_steady_state);
    CHECK(refused.reason.find("more traction than friction can give") != std::string::npos);
  }
  // What the coating takes is a sum over nodes, whose edges are known to a cell's share.
  CHECK(newton.friction_needed == Approx(spectral.friction_needed).epsilon(3e-3));
}

TEST_CASE("a coating that flows backwards remembers ahead of the contact", "[core][coating_flow]") {
  RollingScene scene = turning(soft_tyre_on_layer(), -0.5);
  RollingScene spectral = scene;
  spectral.method = Method::spectral;
  REQUIRE(check(spectral).size() == 1);
  CHECK(check(spectral)[0] ==
        "rotation_ratio = -0.5: must be >= 0 with method \"spectral\" and a viscoelastic coating");
  scene.spacing = 0.05e-3;
  const RollingSolution passage = converged(scene);
  // A train takes the compliance of every wave as it is.
  scene.period = 0.5;
  scene.series_terms = 40000;
  const RollingSolution train = converged(scene);
  CHECK(passage.rolling_resistance == Approx(train.rolling_resistance).epsilon(1e-5));
  CHECK(passage.peak_pressure == Approx(train.peak_pressure).epsilon(1e-4));
}

TEST_CASE("an elastic coating does not feel how fast it flows", "[core][coating_flow]") {
  for (const Method method : {Method::spectral, Method::newton}) {
    CAPTURE(name_of(method));
    RollingScene scene = tyre();
    scene.method = method;
    scene.drive = Drive::free;
    scene.coating_layers[0].material = MaterialModel::elastic;
    const RollingSolution at_speed = converged(scene);
    const RollingSolution slower = solve_model(ContactModel(scene).with_flow(0.5));  // where its search would begin
    CHECK(slower.rolling_resistance == at_speed.rolling_resistance);
    CHECK(slower.rotation_ratio == at_speed.rotation_ratio);
    CHECK(at_speed.model.find("the coating flows") == std::string::npos);
  }
}
