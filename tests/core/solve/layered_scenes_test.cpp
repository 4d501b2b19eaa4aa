/// Rolling on several bonded layers, with coated bodies and with inertia.

#include <cmath>

#include "core/model/contact_surface.hpp"
#include "core/model/scene_rules.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/converged.hpp"
#include "tests/infinite.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

RollingScene on_one_layer(Indenter indenter) {
  RollingScene scene;
  scene.indenter = indenter;
  scene.radius = 0.025;
  scene.layer_thickness = 0.01;
  scene.static_shear_modulus = 1e6;
  scene.stiffening = 9;
  scene.creep_time = 0.01;
  scene.speed = 0.5;
  scene.load = indenter == Indenter::sphere ? 60 : 5000;
  scene.friction_coefficient = 0.3;
  scene.spacing = indenter == Indenter::sphere ? 0.5e-3 : 0.2e-3;
  return scene;
}

BondedLayer like_first(const RollingScene& scene, double thickness) {
  BondedLayer layer;
  static_cast<MaterialInputs&>(layer) = scene;
  layer.layer_thickness = thickness;
  return layer;
}

BondedLayer zener_layer(double thickness, double modulus, double stiffening, double time) {
  BondedLayer layer;
  layer.layer_thickness = thickness;
  layer.static_shear_modulus = modulus;
  layer.stiffening = stiffening;
  layer.creep_time = time;
  return layer;
}

}  // namespace

TEST_CASE("two equal layers roll like one of their thickness", "[core][layered_scenes]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    CAPTURE(name_of(indenter));
    const RollingScene one = on_one_layer(indenter);
    RollingScene two = one;
    two.layer_thickness = 0.003;
    two.lower_layers = {like_first(one, 0.007)};
    const RollingSolution expected = converged(one), got = converged(two);
    CHECK(got.rolling_resistance == Approx(expected.rolling_resistance).epsilon(1e-8));
    CHECK(got.approach == Approx(expected.approach).epsilon(1e-8));
    CHECK(got.rotation_ratio == Approx(expected.rotation_ratio).epsilon(1e-8));
  }
}

TEST_CASE("a very thick lower layer is a half-space", "[core][layered_scenes]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    CAPTURE(name_of(indenter));
    RollingScene scene = on_one_layer(indenter);
    scene.lower_layers = {zener_layer(infinite, 4e6, 2, 1e-3)};
    const double expected = converged(scene).rolling_resistance;
    scene.lower_layers[0].layer_thickness = 5;
    CHECK(converged(scene).rolling_resistance == Approx(expected).epsilon(1e-4));
  }
}

TEST_CASE("a layer on a half-space of its own material is that half-space", "[core][layered_scenes]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    CAPTURE(name_of(indenter));
    RollingScene half_space = on_one_layer(indenter);
    half_space.layer_thickness = infinite;
    RollingScene layered = on_one_layer(indenter);
    layered.lower_layers = {like_first(layered, infinite)};
    CHECK(converged(layered).rolling_resistance == Approx(converged(half_space).rolling_resistance).epsilon(1e-8));
  }
}

TEST_CASE("layers of different materials: a single passage is a train of bodies far apart", "[core][layered_scenes]") {
  // The sum over wavenumbers uses the compliance itself, not its expansion in retardation times.
  RollingScene scene = on_one_layer(Indenter::cylinder);
  scene.layer_thickness = 0.005;
  scene.lower_layers = {zener_layer(0.005, 5e6, 2, 1e-3)};
  scene.coating_layers = {zener_layer(0.002, 3e6, 1, 1e-2)};
  const RollingSolution passage = converged(scene);
  CHECK(passage.energy_residual < 5e-3);
  scene.period = 0.5;
  scene.series_terms = 20000;
  CHECK(passage.rolling_resistance == Approx(converged(scene).rolling_resistance).epsilon(1e-5));
}

TEST_CASE("a hard floor under a coated body: the layer may as well lie on the floor", "[core][layered_scenes]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    CAPTURE(name_of(indenter));
    RollingScene floor = on_one_layer(indenter);
    floor.friction_coefficient = 0;
    if (indenter == Indenter::cylinder) {  // whose coating is a ring, and flat to H/R
      floor.radius *= 1e5;
      floor.load = 1e-5 * *floor.load;
    }
    RollingScene coated = floor;
    coated.material = MaterialModel::elastic;
    coated.static_shear_modulus = 1e13;
    coated.layer_thickness = 1e-3;
    coated.coating_layers = {like_first(floor, floor.layer_thickness)};
    CHECK(converged(coated).rolling_resistance == Approx(converged(floor).rolling_resistance).epsilon(1e-6));
  }
}

TEST_CASE("between equal layers on body and base friction does not act on the pressure", "[core][layered_scenes]") {
  // Cross terms of the two surfaces cancel (Johnson 1985, section 5.1).
  RollingScene scene = on_one_layer(Indenter::cylinder);
  scene.radius *= 1e3;  // the coating is a ring, on whose pressure shear acts by a/R
  scene.load = 1e-3 * *scene.load;
  scene.coating_layers = {like_first(scene, scene.layer_thickness)};
  scene.drive = Drive::free;
  const RollingSolution rough = converged(scene);
  scene.friction_coefficient = 0;
  scene.drive = Drive::rotation;  // the coating flows as fast
  scene.rotation_ratio = rough.rotation_ratio;
  const RollingSolution smooth = converged(scene);
  CHECK(rough.contact_nodes == smooth.contact_nodes);
  CHECK(rough.approach == Approx(smooth.approach).epsilon(1e-5));
}

TEST_CASE("inertia: a single passage is a train of bodies far apart, and vanishes with the speed",
          "[core][layered_scenes]") {
  RollingScene scene = on_one_layer(Indenter::cylinder);
  scene.speed = 15;
  scene.creep_time = 3e-4;
  scene.inertia = Inertia::on;
  const double with = converged(scene).rolling_resistance;
  RollingScene train = scene;
  train.period = 0.4;
  train.series_terms = 20000;
  CHECK(with == Approx(converged(train).rolling_resistance).epsilon(1e-5));
  RollingScene without = scene;
  without.inertia = Inertia::off;
  CHECK(with / converged(without).rolling_resistance == Approx(1.08).margin(0.005));  // the train's as well

  scene.speed = without.speed = 1e-3;  // rho V^2/G = 1e-9
  scene.creep_time = without.creep_time = 10;
  CHECK(converged(scene).rolling_resistance == Approx(converged(without).rolling_resistance).epsilon(1e-6));
}

TEST_CASE("inertia comes by itself where the tolerance asks for it", "[core][layered_scenes]") {
  RollingScene scene = on_one_layer(Indenter::cylinder);
  scene.speed = 5;
  CHECK_FALSE(ContactModel(scene).inertia);  // a spacing, no tolerance
  scene.spacing.reset();
  scene.tolerance = 1e-2;
  CHECK(rayleigh_number(scene) == Approx(1000 * 25 / 1e6 / 0.912).epsilon(0.01));
  CHECK(ContactModel(scene).inertia);
  scene.speed = 0.5;
  CHECK_FALSE(ContactModel(scene).inertia);
  scene.speed = 1.5;
  CHECK(ContactModel(scene).inertia);
  scene.tolerance = 0.1;
  CHECK_FALSE(ContactModel(scene).inertia);
  scene.tolerance = 1e-3;
  scene.method = Method::spectral;
  CHECK(ContactModel(scene).inertia);
  scene.coating_layers = {like_first(scene, 0.01)};  // with which it has no inertia
  CHECK_FALSE(ContactModel(scene).inertia);
  scene.coating_layers.clear();
  scene.method = Method::automatic;
  scene.indenter = Indenter::sphere;
  CHECK(ContactModel(scene).inertia);
}

TEST_CASE("inertia that a tolerance asks for and the method named has not is warned of", "[core][layered_scenes]") {
  RollingScene scene = on_one_layer(Indenter::cylinder);
  BondedLayer coating;
  coating.layer_thickness = 0.3 * scene.layer_thickness;
  coating.static_shear_modulus = 3e6;
  scene.coating_layers = {coating};
  scene.friction_coefficient = 0;
  scene.spacing.reset();
  scene.tolerance = 1e-6;
  scene.method = Method::spectral;  // which has no inertia with a coating
  const auto warned = [&] {
    const RollingSolution solution = converged(scene);
    CHECK(solution.model.find("which may change R_r by about as much") != std::string::npos);
    return std::any_of(solution.warnings.begin(), solution.warnings.end(), [](const std::string& line) {
      return line.find("is not negligible, and is left out") != std::string::npos;
    });
  };
  scene.speed = 5;  // rho V^2/|G| = 0.004
  CHECK(warned());
  scene.speed = 0.5;
  CHECK_FALSE(warned());
}

TEST_CASE("a grid that stands in for continuous edges leaves inertia out as the scene does", "[core][layered_scenes]") {
  RollingScene scene = on_one_layer(Indenter::cylinder);
  scene.speed = 10;
  scene.adhesion_threshold = 1;  // for which there are no continuous edges
  scene.spacing.reset();
  const RollingSolution by_default = converged(scene);
  CHECK(by_default.model.find("inertia left out") != std::string::npos);
  scene.inertia = Inertia::off;
  CHECK(by_default.rolling_resistance == converged(scene).rolling_resistance);
}

TEST_CASE("a tolerance has no answer above the speed of Rayleigh waves, unless inertia is negligible or off",
          "[core][layered_scenes]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    CAPTURE(name_of(indenter));
    RollingScene scene = on_one_layer(indenter);
    scene.friction_coefficient = 0;
    scene.spacing.reset();
    scene.tolerance = 2e-2;
    scene.speed = 31;  // 30.1 m/s are those of Rayleigh waves
    const RollingSolution refused = solve(scene);
    CHECK(refused.status == Status::no_steady_state);
    CHECK(refused.reason.find("below that of Rayleigh waves on the layer at rest, 30.1") != std::string::npos);
    CHECK(refused.reason.find("inertia = off") != std::string::npos);
    CHECK(std::isnan(refused.rolling_resistance));

    RollingScene without = scene;
    without.inertia = Inertia::off;
    CHECK(converged(without).warnings.size() > 0);

    RollingScene glassy = scene;  // rho V^2/|G| = 1e-3 at the frequency of the contact
    glassy.stiffening = 1000;
    glassy.creep_time = 10;
    CHECK(converged(glassy).model.find("inertia left out") != std::string::npos);
  }
}

TEST_CASE("a heavy layer slows the waves of a softer one below, and with them the speeds that inertia allows",
          "[core][layered_scenes]") {
  RollingScene scene = on_one_layer(Indenter::sphere);
  scene.friction_coefficient = 0;
  scene.layer_thickness = 1e-3;
  scene.layer_density = 8000;
  *scene.static_shear_modulus *= 10;
  scene.lower_layers = {zener_layer(infinite, 1e6, 2, 1e-3)};
  scene.inertia = Inertia::on;
  scene.speed = 20;  // Rayleigh waves: 33.7 and 30.1 m/s
  CHECK(rayleigh_number(scene) < 0.5);
  CHECK(check(scene).empty());
  scene.speed = 22;
  REQUIRE(check(scene).size() == 1);
  CHECK(check(scene)[0] == "speed = 22: with inertia must be below that of the waves which the layers carry together");
  scene.inertia = Inertia::automatic;
  scene.spacing.reset();
  scene.tolerance = 1e-2;
  CHECK(solve(scene).reason.find("the waves which the layers carry together") != std::string::npos);
}

TEST_CASE("inertia of a single sphere's layers: its effect is of the order of rho V^2/|G| and takes no energy",
          "[core][layered_scenes][long]") {
  RollingScene scene = on_one_layer(Indenter::sphere);
  scene.spacing = 0.25e-3;
  scene.stiffening = 2;
  scene.creep_time = 1e-3;
  for (const double number : {1e-4, 1e-2, 0.1, 0.6}) {
    CAPTURE(number);
    scene.speed = std::sqrt(number * 1e6 / scene.layer_density);
    scene.inertia = Inertia::on;
    const RollingSolution with = converged(scene);
    scene.inertia = Inertia::off;
    const RollingSolution without = converged(scene);
    CHECK(with.energy_residual < 1e-7 + 2 * without.energy_residual);  // slow rolling: of the grid
    const double effect = with.rolling_resistance / without.rolling_resistance - 1;
    CHECK(effect > (number > 1e-3 ? 0 : -number));  // slow rolling is answered otherwise on several layers
    CHECK(effect < 1.5 * number);
  }
}

TEST_CASE("scenes of several layers that cannot be are refused", "[core][layered_scenes]") {
  const auto first_rule = [](const RollingScene& scene) {
    const auto broken = check(scene);
    return broken.empty() ? "nothing" : broken.front();
  };
  RollingScene scene = on_one_layer(Indenter::cylinder);
  CHECK(first_rule(scene) == "nothing");

  RollingScene nothing_below = scene;
  nothing_below.layer_thickness = infinite;
  nothing_below.lower_layers = {like_first(scene, 0.01)};
  CHECK(first_rule(nothing_below).find("only the last of the lower layers may be infinite") != std::string::npos);

  RollingScene no_thickness = scene;
  no_thickness.lower_layers = {like_first(scene, 0)};
  CHECK(first_rule(no_thickness) == "lower_layers[0].layer_thickness = 0: must be > 0 or \"infinite\"");

  RollingScene thick_coat = scene;
  thick_coat.coating_layers = {like_first(scene, 0.03)};
  CHECK(first_rule(thick_coat) == "coating_layers[0].layer_thickness = 0.03: must be less than the radius, 0.025 m");
  thick_coat.coating_layers = {like_first(scene, 0.015), like_first(scene, 0.015)};
  CHECK(first_rule(thick_coat) ==
        "coating_layers: layer_thickness = 0.03 together: must be less than the radius, 0.025 m");
  thick_coat.coating_layers = {like_first(scene, infinite)};
  CHECK(first_rule(thick_coat).starts_with("coating_layers[0].layer_thickness = \"infinite\": must be less than"));

  RollingScene too_fast = scene;
  too_fast.inertia = Inertia::on;
  too_fast.speed = 31;
  CHECK(first_rule(too_fast) ==
        "speed = 31: with inertia must be below that of Rayleigh waves on the layer at rest, 30.1 m/s");

  RollingScene spectral = scene;
  spectral.spacing.reset();
  spectral.method = Method::spectral;
  spectral.coating_layers = {like_first(scene, 0.003)};
  CHECK(first_rule(spectral) == "nothing");
  spectral.coating_layers[0].poisson_ratio = 0.4;
  CHECK(first_rule(spectral) ==
        "coating_layers[0].poisson_ratio = 0.4: must be 0.5 with method \"spectral\" and a coating");
  spectral.coating_layers[0].poisson_ratio = 0.5;
  spectral.inertia = Inertia::on;
  CHECK(first_rule(spectral) == "inertia: not with method \"spectral\" and a coating");
  spectral.coating_layers.clear();
  spectral.poisson_ratio = 0.3;
  CHECK(first_rule(spectral) == "nothing");
}

namespace {

RollingScene gridless(RollingScene scene) {
  scene.spacing.reset();
  return scene;
}

RollingSolution with_continuous_edges(const RollingScene& scene) {
  const RollingSolution solution = solve(gridless(scene));
  INFO(solution.reason << solution.model);
  REQUIRE(solution.status == Status::converged);
  CHECK(solution.method == Method::spectral);
  CHECK(solution.law_violation < 5e-9);
  CHECK(solution.energy_residual < 1e-7);
  return solution;
}

}  // namespace

TEST_CASE("two equal layers roll like one of their thickness, edges of contact being continuous",
          "[core][layered_scenes]") {
  const RollingScene one = on_one_layer(Indenter::cylinder);
  RollingScene two = one;
  two.layer_thickness = 0.003;
  two.lower_layers = {like_first(one, 0.007)};
  for (const double friction : {0.3, 0.0})
    for (const double speed : {0.005, 0.5, 20.0}) {
      CAPTURE(friction, speed);
      RollingScene single = one, split = two;
      single.friction_coefficient = split.friction_coefficient = friction;
      single.speed = split.speed = speed;
      const RollingSolution expected = with_continuous_edges(single), got = with_continuous_edges(split);
      // 1e-8 is the tolerance that they are solved to.
      CHECK(got.rolling_resistance == Approx(expected.rolling_resistance).epsilon(3e-8));
      CHECK(got.approach == Approx(expected.approach).epsilon(1e-8));
    }
}

TEST_CASE("layers of different materials: the grid tends to the answer with continuous edges",
          "[core][layered_scenes]") {
  RollingScene scene = on_one_layer(Indenter::cylinder);
  scene.layer_thickness = 0.005;
  scene.lower_layers = {zener_layer(0.005, 5e6, 2, 1e-3)};
  SECTION("on a rigid base, under a coated body") {
    scene.coating_layers = {zener_layer(0.002, 3e6, 1, 1e-2)};
    scene.tolerance = 1e-7;  // a ring with friction is else solved to 1e-6
  }
  SECTION("on a half-space") { scene.lower_layers.push_back(zener_layer(infinite, 3e7, 0, 1e-3)); }
  SECTION("without friction, compressible") {
    scene.friction_coefficient = 0;
    scene.poisson_ratio = 0.35;
  }
  SECTION("a nearly elastic layer on one that is not") { scene.stiffening = 0.1; }
  const RollingSolution limit = with_continuous_edges(scene);
  scene.tolerance.reset();
  scene.spacing = 0.025e-3;  // some 280 nodes: with friction up to 1.2e-4 from continuous edges
  const RollingSolution grid = converged(scene);
  CHECK(grid.rolling_resistance == Approx(limit.rolling_resistance).epsilon(2e-4));
  CHECK(grid.peak_pressure == Approx(limit.peak_pressure).epsilon(1e-3));
  if (!std::isnan(limit.approach)) CHECK(grid.approach == Approx(limit.approach).epsilon(3e-4));
  if (scene.friction_coefficient > 0) CHECK(grid.rotation_ratio == Approx(limit.rotation_ratio).epsilon(2e-4));
}

TEST_CASE("without friction the resistance is continuous as Poisson's ratio tends to a half",
          "[core][layered_scenes]") {
  RollingScene scene = on_one_layer(Indenter::cylinder);
  scene.friction_coefficient = 0;
  const double limit = with_continuous_edges(scene).rolling_resistance;
  double before = 1;
  for (const double short_of : {0.1, 1e-2, 1e-3, 1e-4, 1e-6}) {
    scene.poisson_ratio = 0.5 - short_of;
    const double distance = std::abs(with_continuous_edges(scene).rolling_resistance / limit - 1);
    CHECK(distance < 1.5 * short_of);
    CHECK(distance < before);
    before = distance;
  }
}

TEST_CASE("the surface beside a contact without grid is that of the grid", "[core][layered_scenes]") {
  RollingScene scene = on_one_layer(Indenter::cylinder);
  scene.layer_thickness = 0.005;
  scene.lower_layers = {zener_layer(0.005, 5e6, 2, 1e-3)};
  const RollingSolution limit = with_continuous_edges(scene);
  scene.spacing = 0.1e-3;
  const RollingSolution grid = converged(scene);
  const auto at_zero = [](const RollingSolution& solution, const std::vector<double>& values) {
    return values[static_cast<std::size_t>(-solution.fields.grid.first_column)];
  };
  CHECK(at_zero(grid, grid.fields.u) == Approx(at_zero(limit, limit.fields.u)).epsilon(2e-3));
  CHECK(at_zero(grid, grid.fields.w) == Approx(at_zero(limit, limit.fields.w)).epsilon(2e-3));
}
