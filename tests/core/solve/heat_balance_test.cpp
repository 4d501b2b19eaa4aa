#include "core/solve/heat_balance.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "core/interior/interior_summary.hpp"
#include "core/model/contact_model.hpp"
#include "core/scene/warmed_layers.hpp"
#include "tests/core/converged.hpp"
#include "tests/core/heat/warm_wheel.hpp"

// Covers loss_with_depth, loss_estimate and one_temperature, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

constexpr double air = 293.15;

void give_wlf(MaterialInputs& layer) {
  layer.reference_temperature = air;
  layer.wlf_c1 = 8.86;
  layer.wlf_c2 = 101.6;
}

/// The wheel with a cover of one narrow peak of loss, f = 2 and 2 ms at 20 degrees.
RollingScene narrow_wheel(double ambient) {
  RollingScene scene = warm_wheel();
  BondedLayer cover;
  cover.layer_thickness = 0.012;
  cover.static_shear_modulus = 12e6;
  cover.stiffening = 2;
  cover.creep_time = 2e-3;
  give_wlf(cover);
  scene.coating_layers = {cover};
  scene.ambient_temperature = ambient;
  return scene;
}

RollingScene warm_belt() {
  RollingScene belt = plain_scene(3, 5e3);
  belt.heat = Heat::on;
  belt.thermal_conductivity = 0.2;
  belt.turn_length = 5;
  belt.surface_heat_transfer = 15;
  belt.core_heat_transfer = 10;
  belt.ambient_temperature = 253.15;
  belt.creep_time = 3e-3;
  give_wlf(belt);
  return belt;
}

/// A cooled core, a core that takes nothing, and a belt with a warm other face: without friction.
std::vector<RollingScene> unevenly_warm() {
  RollingScene cooled = narrow_wheel(313.15), insulated = narrow_wheel(293.15), belt = warm_belt();
  cooled.core_temperature = 288.15;
  insulated.surface_heat_transfer = 60;
  belt.core_temperature = 293.15;
  std::vector<RollingScene> scenes{cooled, insulated, belt};
  for (RollingScene& scene : scenes) {
    scene.friction_coefficient = 0;
    scene.drive = Drive::free;
  }
  return scenes;
}

double heat_leaving(const RollingSolution& s) { return s.heat_to_air + s.heat_to_ground + s.heat_to_core; }

int isothermal_solutions_of(const RollingSolution& solution) {
  const std::size_t place = solution.model.find("their own loss, found in ");
  REQUIRE(place != std::string::npos);
  return std::stoi(solution.model.substr(place + 25));
}

/// What its assumption of one temperature says: the change of R_r and its scatter [1].
std::pair<double, double> told_of_one_temperature(const RollingSolution& solution) {
  for (const std::string& assumption : solution.assumptions) {
    double change = 0, scatter = 0;
    const std::size_t place = assumption.find("without it R_r ");
    if (assumption.starts_with("one temperature (") && place != std::string::npos &&
        std::sscanf(assumption.c_str() + place, "without it R_r %lf %% +- %lf", &change, &scatter) == 2)
      return {change / 100, scatter / 100};
  }
  return {NAN, NAN};
}

/// The scene at the temperature found has the same answer, and its loss makes this temperature.
void check_own_temperature(const RollingScene& scene, const RollingSolution& s) {
  const RollingSolution isothermal = converged(at_temperature(scene, s.mean_temperature));
  CHECK(isothermal.rolling_resistance == s.rolling_resistance);
  CHECK(heat_leaving(s) == Approx(s.rolling_resistance * scene.speed).epsilon(1e-10));
}

}  // namespace

// A flat cover and one material for all temperatures, as the prototype had them; the floor is that of concrete, whose
// h_c is 230 W/m2K. Its table tells whole kelvins.
TEST_CASE("the wheel of polyurethane is as warm as the prototype found it", "[core][heat]") {
  struct Row {
    double transfer, core, ground, face, bond, peak;
  };
  for (const Row& row : {Row{10, 0, 0, 64, 82, 82}, Row{20, 0, 0, 32, 50, 50}, Row{30, 0, 0, 21, 40, 40},
                         Row{20, 50, 0, 15, 9, 19}, Row{20, 0, 1960, 2.5, 21, 21}, Row{20, 50, 1960, 1.7, 5, 10}}) {
    RollingScene scene = warm_wheel();
    scene.inertia = Inertia::on;  // its cover is flat
    scene.surface_heat_transfer = row.transfer;
    if (row.core > 0) scene.core_heat_transfer = row.core;
    scene.ground_effusivity = row.ground;
    const RollingSolution s = converged(scene);
    CHECK(s.rolling_resistance == Approx(134).epsilon(0.004));
    CHECK(std::abs(s.surface_temperature - air - row.face) < 1);
    CHECK(std::abs(s.bond_temperature - air - row.bond) < 1);
    CHECK(std::abs(s.peak_temperature - air - row.peak) < 1);
    CHECK(heat_leaving(s) == Approx(s.rolling_resistance * scene.speed).epsilon(1e-10));
    CHECK(s.peclet == Approx(4.9e4).epsilon(0.01));
    CHECK(s.temperatures == std::vector<double>{s.mean_temperature});
    CHECK(isothermal_solutions_of(s) == 1);
  }
}

TEST_CASE("a cover that follows its temperature has the resistance of that temperature, in at most eight solutions",
          "[core][heat]") {
  double last = INFINITY;
  for (const double speed : {0.5, 3.0, 6.0}) {
    RollingScene scene = warm_wheel();
    give_wlf(scene.coating_layers[0]);
    scene.speed = speed;
    const RollingSolution s = converged(scene);
    REQUIRE(s.temperatures.size() == 1);
    CHECK(isothermal_solutions_of(s) <= 8);
    CHECK(s.mean_temperature > s.surface_temperature);
    CHECK(s.mean_temperature < s.bond_temperature);
    check_own_temperature(scene, s);
    CHECK(s.rolling_resistance < last);  // the faster, the warmer
    last = s.rolling_resistance;
    // Its model is that of the warm cover, for whoever looks inside.
    const ContactModel solved = ContactModel(scene).with_answer(s);
    CHECK(solved.coating[0].temperature == s.mean_temperature);
    CHECK(solved.coating[0].creep == ContactModel(at_temperature(scene, s.mean_temperature)).coating[0].creep);
    CHECK(ContactModel(scene).coating[0].temperature == air);
  }
}

TEST_CASE("a narrow peak of loss has one state at 0 degrees and three at -20, of which warming reaches the coldest",
          "[core][heat]") {
  const RollingScene mild = narrow_wheel(273.15), cold = narrow_wheel(253.15);
  const RollingSolution one = converged(mild), three = converged(cold);
  CHECK(one.temperatures.size() == 1);
  check_own_temperature(mild, one);
  REQUIRE(three.temperatures.size() == 3);
  check_own_temperature(cold, three);
  CHECK(three.mean_temperature == three.temperatures[0]);
  CHECK(three.mean_temperature - 253.15 < 1);
  CHECK_THAT(three.warnings.back(), Contains("more than one steady state") && Contains("unstable"));
  // The others by a scan: what is lost at a temperature against what would leave there, of an insulated core in
  // proportion to how much warmer than the air the layers are.
  const auto excess = [&](double temperature) {
    return solve(at_temperature(cold, temperature)).rolling_resistance * cold.speed / (temperature - 253.15);
  };
  const double leaving = three.heat_to_air / (three.mean_temperature - 253.15);
  CHECK(excess(three.temperatures[1] - 4) < leaving);
  CHECK(excess(three.temperatures[1] + 4) > leaving);
  CHECK(excess(three.temperatures[2] - 4) > leaving);
  CHECK(excess(three.temperatures[2] + 4) < leaving);
}

TEST_CASE("without heat its inputs change nothing and its outputs are absent", "[core][heat]") {
  RollingScene plain = warm_wheel();
  plain.heat = Heat::off;
  RollingScene bare = plain;
  bare.thermal_conductivity.reset();
  bare.heat_capacity.reset();
  bare.surface_heat_transfer.reset();
  bare.ambient_temperature.reset();
  const RollingSolution a = converged(plain), b = converged(bare);
  CHECK(a.rolling_resistance == b.rolling_resistance);
  CHECK(a.model == b.model);
  CHECK(std::isnan(a.mean_temperature));
  CHECK(std::isnan(a.heat_to_air));
  CHECK(a.temperatures.empty());
}

TEST_CASE("heats of a wheel whose width is given are those of the whole wheel", "[core][heat]") {
  RollingScene scene = narrow_wheel(273.15), wide = scene;
  wide.width = 0.25;
  *wide.load *= 0.25;
  const RollingSolution per_metre = converged(scene), whole = converged(wide);
  CHECK(whole.mean_temperature == Approx(per_metre.mean_temperature).epsilon(1e-9));
  CHECK(whole.heat_to_air == Approx(0.25 * per_metre.heat_to_air).epsilon(1e-7));
}

TEST_CASE("a belt warms itself by its loss over both faces, and the inside is that of the warm belt", "[core][heat]") {
  RollingScene belt = warm_belt();
  belt.interior = Interior::on;
  const RollingSolution s = converged(belt);
  CHECK(s.mean_temperature > 253.15);
  CHECK(s.heat_to_core > 0);
  CHECK(heat_leaving(s) == Approx(s.rolling_resistance * belt.speed).epsilon(1e-10));
  CHECK(s.interior_loss == Approx(s.viscous_loss).epsilon(1e-3));
  CHECK(std::isnan(s.peclet));  // no heat_capacity
  RollingScene isothermal = at_temperature(belt, s.mean_temperature);
  CHECK(converged(isothermal).rolling_resistance == s.rolling_resistance);
}

TEST_CASE("friction heats the face, and a floor keeps what it loses itself", "[core][heat]") {
  RollingScene scene = warm_wheel();
  scene.material = MaterialModel::zener;  // the floor
  scene.static_young_modulus.reset();
  scene.static_shear_modulus = 50e6;
  scene.stiffening = 1;
  scene.creep_time = 2e-3;
  scene.friction_coefficient = 0.3;
  scene.drive = Drive::rotation;
  scene.rotation_ratio = 1.1;
  const RollingSolution s = converged(scene);
  CHECK(s.frictional_loss > 0);
  CHECK(s.heat_to_ground > 0);  // which takes no heat from the cover
  CHECK(heat_leaving(s) == Approx(s.rolling_resistance * scene.speed).epsilon(1e-10));
  RollingScene elastic = scene;
  elastic.material = elastic.coating_layers[0].material = MaterialModel::elastic;
  const RollingSolution rubbed = converged(elastic);
  CHECK(rubbed.heat_to_ground == 0);
  CHECK(rubbed.surface_temperature == Approx(rubbed.bond_temperature).epsilon(1e-9));
}

TEST_CASE("a skewed roll is the warmer for what its axle costs", "[core][heat][skew]") {
  RollingScene scene = warm_wheel();
  scene.friction_coefficient = 0.3;
  const RollingSolution straight = converged(scene);
  scene.skew_angle = 0.02;
  const RollingSolution skewed = converged(scene);
  CHECK(skewed.mean_temperature > straight.mean_temperature + 1);
  const double given_off = skewed.heat_to_air + skewed.heat_to_ground + skewed.heat_to_core;
  CHECK(given_off == Approx(skewed.viscous_loss + skewed.frictional_loss).epsilon(1e-3));
  CHECK(given_off == Approx(skewed.rolling_resistance * scene.speed).epsilon(2e-3));
  CHECK(skewed.frictional_loss > 0.02 * given_off);
}

TEST_CASE("where more is lost than leaves at any temperature there is no steady state, and the reason says how much",
          "[core][heat]") {
  RollingScene scene = narrow_wheel(293.15);
  MaterialInputs& cover = scene.coating_layers[0];
  cover.wlf_c1.reset();
  cover.wlf_c2.reset();
  cover.shift_temperatures = {273.15, 293.15, 313.15};
  cover.shift_factors = {1.3, 1, 0.8};
  scene.surface_heat_transfer = 2;
  const RollingSolution s = solve(scene);
  CHECK(s.status == Status::no_steady_state);
  CHECK_THAT(s.reason, Contains("cannot leave") && Contains("W/m"));
}

TEST_CASE("moduli that soften with the strain do so at the temperature found", "[core][heat]") {
  RollingScene belt = warm_belt();
  belt.payne_drop = 0.4;
  belt.payne_strain = 0.02;
  const RollingSolution s = converged(belt);
  CHECK(s.softening < 1);
  check_own_temperature(belt, s);
}

TEST_CASE("what one temperature for a cover costs is what twelve sublayers change", "[core][heat]") {
  for (const RollingScene& scene : unevenly_warm()) {
    const RollingSolution warm = converged(scene);
    RollingScene fine = scene;
    fine.thermal_sublayers = 12;
    const double change = converged(fine).rolling_resistance / warm.rolling_resistance - 1;
    const auto [told, scatter] = told_of_one_temperature(warm);
    CAPTURE(change, told, scatter, warm.surface_temperature, warm.bond_temperature);
    CHECK(std::abs(change) > 2e-3);
    CHECK(std::abs(told - change) < scatter + 0.1 * std::abs(change));
    CHECK(warm.model_error >= std::abs(told));
  }
}

TEST_CASE("sublayers are as warm as the profile that they make, and have the resistance of such layers",
          "[core][heat][sublayers]") {
  for (RollingScene scene : unevenly_warm()) {
    const RollingSolution one = converged(scene);
    scene.thermal_sublayers = 5;
    const RollingSolution s = converged(scene);
    REQUIRE(s.sublayer_temperatures.size() == 5);
    // Layers that are given as warm: the same answer, whose loss makes these temperatures.
    const RollingScene cut = at_temperatures(scene, s.sublayer_temperatures);
    const RollingSolution given = converged(cut);
    CHECK(given.rolling_resistance == s.rolling_resistance);
    const WarmedDepth depth = warmed_depth(scene, ContactModel(cut).with_answer(given), given);
    const std::vector<double> middles = sublayer_depths(scene, 5);
    for (std::size_t i = 0; i < middles.size(); ++i)
      CHECK(depth.profile.at(middles[i]) == Approx(s.sublayer_temperatures[i]).epsilon(1e-7));
    CHECK(depth.profile.mean() == Approx(s.mean_temperature).epsilon(1e-7));
    CHECK(s.peak_temperature == Approx(depth.profile.peak().temperature).epsilon(1e-9));
    CHECK(heat_leaving(s) == Approx(s.rolling_resistance * scene.speed).epsilon(1e-10));
    // The warmer parts lose less: the answer of one temperature said by how much it was off.
    const auto [told, scatter] = told_of_one_temperature(one);
    const double change = s.rolling_resistance / one.rolling_resistance - 1;
    CAPTURE(change, told, scatter);
    CHECK(std::abs(told - change) < scatter + 0.2 * std::abs(change));
    CHECK(std::abs(told_of_one_temperature(s).first) < 0.3 * std::abs(told));
  }
}

TEST_CASE("of a cover in sublayers the inside and the messages count layers as the scene does",
          "[core][heat][sublayers]") {
  RollingScene scene = narrow_wheel(273.15);
  scene.interior = Interior::on;
  scene.friction_coefficient = 0;
  scene.coating_layers[0].layer_thickness = 6e-3;
  scene.coating_layers.push_back(scene.coating_layers[0]);
  scene.thermal_sublayers = 3;
  const RollingSolution s = converged(scene);
  CHECK(s.sublayer_temperatures.size() == 6);
  CHECK(s.bond_shears.size() == 3);
  CHECK(s.interior_loss == Approx(s.viscous_loss).epsilon(1e-3));
  CHECK_THAT(s.model, Contains("rigid body with 2 coatings"));
  const InteriorSummary inside = inside_of_answer(ContactModel(scene), s);
  REQUIRE(inside.layers.size() == 3);
  REQUIRE(inside.bonds.size() == 3);
  CHECK(inside.bonds[2].layer == 1);
  CHECK(inside.bonds[2].z == Approx(12e-3));
  double sum = 0;
  for (const LayerLoss& layer : inside.layers) sum += layer.loss;
  CHECK(sum == Approx(inside.loss).epsilon(1e-12));
  // As many sublayers of all as layers that are cut by hand.
  RollingScene by_hand = at_temperatures(scene, s.sublayer_temperatures);
  by_hand.interior = Interior::on;
  const RollingSolution cut = converged(by_hand);
  CHECK(cut.rolling_resistance == s.rolling_resistance);
  CHECK(cut.bond_shears.size() == 7);
  CHECK(cut.bond_shears[6] == s.bond_shears[2]);
  CHECK(cut.peak_shear_strain == s.peak_shear_strain);
}

TEST_CASE("all states of a cover in sublayers are found where a mean temperature has a steep profile",
          "[core][heat][sublayers]") {
  RollingScene scene = narrow_wheel(273.15);
  scene.friction_coefficient = 0;
  scene.core_temperature = 263.15;
  scene.thermal_sublayers = 3;
  const RollingSolution s = converged(scene);
  REQUIRE(s.temperatures.size() == 3);
  CHECK_THAT(s.warnings.back(), Contains("more than one steady state"));
  RollingSolution damaged = s;
  damaged.sublayer_temperatures.clear();
  damaged.sublayer_temperatures.resize(5, 300);
  scene.coating_layers.push_back(scene.coating_layers[0]);
  CHECK_THROWS_WITH(ContactModel(scene).with_answer(damaged),
                    "sublayer_temperatures: 5 numbers are not as many for each of 2 layers");
  // Materials that do not follow the temperature are not cut.
  RollingScene constant = warm_wheel();
  constant.thermal_sublayers = 4;
  const RollingSolution plain = converged(constant);
  CHECK(plain.sublayer_temperatures.empty());
  CHECK(isothermal_solutions_of(plain) == 1);
}
