#include "core/estimate/assumptions.hpp"

#include <fstream>
#include <functional>
#include <sstream>

#include "core/estimate/linearity_error.hpp"
#include "core/solve/model_answer.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/infinite.hpp"
#include "tests/source_directory.hpp"

using namespace rollres;

namespace {

/// The paper's cylinder or sphere without friction, between continuous edges or on the program's grid.
RollingScene smooth(Indenter indenter) {
  RollingScene scene = indenter == Indenter::sphere ? paper_sphere() : paper_cylinder();
  scene.kinematics = Kinematics::consistent;
  scene.friction_coefficient = 0;
  scene.inertia = Inertia::off;
  scene.spacing.reset();
  return scene;
}

RollingSolution answered(const RollingScene& scene) {
  RollingSolution solution = solve(scene);
  INFO(solution.reason);
  REQUIRE(solution.status == Status::converged);
  return solution;
}

Assumption stated(const ContactModel& model, const RollingSolution& solution, std::string_view name) {
  const std::vector<Assumption> all = assumptions(model, solution);
  const Assumption* const found = find_assumption(all, name);
  REQUIRE(found);
  return *found;
}

/// What the solution of the other scene says of the statement: the true change over the one stated.
double over_stated(const RollingScene& scene, std::string_view name, const std::function<void(RollingScene&)>& lift) {
  const RollingSolution with = answered(scene);
  RollingScene other = scene;
  lift(other);
  const double change = answered(other).rolling_resistance / with.rolling_resistance - 1;
  const Assumption assumption = stated(scene, with, name);
  REQUIRE(assumption.change);
  return change / *assumption.change;
}

bool within_two(double ratio) { return ratio > 0.5 && ratio < 2; }

}  // namespace

TEST_CASE("what inertia left out costs is what solutions with it say, within a factor of two",
          "[core][estimate][assumptions]") {
  // Reference: the scene with inertia. A wrong density, sign or power of the load fails it.
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere})
    for (const double speed : {10.0, 30.0}) {
      RollingScene scene = smooth(indenter);
      scene.static_shear_modulus = 5e6;
      scene.speed = speed;
      scene.creep_time = 5e-3 / speed;
      CHECK(within_two(over_stated(scene, "no inertia", [](RollingScene& other) { other.inertia = Inertia::on; })));
    }
}

TEST_CASE("what a body and a base of steel cost is what solutions with them say, within a factor of two",
          "[core][estimate][assumptions]") {
  // Reference: the scene on a half-space of steel, its body covered with more steel than the contact feels.
  const auto steel = [](RollingScene& other) {
    BondedLayer layer;
    layer.material = MaterialModel::elastic;
    layer.static_shear_modulus = 81e9;
    layer.poisson_ratio = 0.3;
    layer.layer_thickness = infinite;
    other.lower_layers = {layer};
    layer.layer_thickness = 0.6 * other.radius;
    other.coating_layers = {layer};
  };
  for (const double thickness : {0.5e-3, 2e-3, 10e-3}) {
    RollingScene scene = smooth(Indenter::cylinder);
    scene.static_shear_modulus = 1e9;
    scene.load = 500e3;
    scene.layer_thickness = thickness;
    CHECK(within_two(over_stated(scene, "rigid body and base", steel)));
  }
}

TEST_CASE("the strain of a cover is counted by its own thickness, whatever carries it",
          "[core][estimate][assumptions]") {
  // Reference: d over the cover's thickness, and the same cover on a hundred times as much steel.
  RollingScene scene = smooth(Indenter::cylinder);
  scene.radius = 0.05;
  scene.load = 8e3;
  scene.tolerance = 1e-3;
  BondedLayer cover;
  cover.layer_thickness = 12e-3;
  cover.static_shear_modulus = 2e6;
  scene.coating_layers = {cover};
  scene.material = MaterialModel::elastic;
  scene.static_shear_modulus = 81e9;
  double on_thin = 0;
  for (const double thickness : {0.01, 1.0, infinite}) {
    scene.layer_thickness = thickness;
    const RollingSolution solution = answered(scene);
    const ContactModel model(scene);
    const double strain = strain_number(model, solution);
    if (thickness < infinite) CHECK(strain == Approx(solution.approach / 12e-3).epsilon(1e-12));
    if (thickness == 1.0) CHECK(strain == Approx(on_thin).epsilon(1e-3));
    on_thin = strain;
    for (const std::string& warning : solution.warnings) CHECK(warning.find("nan") == std::string::npos);
    CHECK(
        stated(model, solution, small_strains).rests_on.starts_with(thickness < infinite ? "d/H = 0.05" : "a/R = 0.1"));
  }
}

TEST_CASE("what a flat coating costs is what the ring says, within a factor of two", "[core][estimate][assumptions]") {
  // Reference: the same wheel with its coating as a ring. A change of the wrong sign or of another load fails it.
  for (const double thickness : {4e-3, 12e-3, 25e-3}) {
    RollingScene scene = smooth(Indenter::cylinder);
    scene.radius = 0.05;
    scene.layer_thickness = 1e-3;
    scene.material = MaterialModel::elastic;
    scene.static_shear_modulus = 1e10;
    BondedLayer cover;
    cover.layer_thickness = thickness;
    cover.static_shear_modulus = 2e6;
    cover.stiffening = 1.5;
    cover.creep_time = 5e-3;
    scene.coating_layers = {cover};
    scene.load = 4e3;
    scene.speed = 1;
    ContactModel flat(scene);
    const RollingSolution ring = solve_model(flat);
    CHECK_FALSE(find_assumption(assumptions(flat, ring), "flat coating"));
    flat.bend_coating(infinite);
    flat.choose_method();
    const RollingSolution straight = solve_model(flat);
    REQUIRE(straight.status == Status::converged);
    const Assumption assumption = stated(flat, straight, "flat coating");
    REQUIRE(assumption.change);
    CHECK(within_two((ring.rolling_resistance / straight.rolling_resistance - 1) / *assumption.change));
  }
}

TEST_CASE("the model's error is the sum in squares of what its assumptions cost, where all of it is known",
          "[core][estimate][assumptions]") {
  const Assumption one{"a", "1", 0.03, 0}, other{"b", "2", 0.0, 0.04}, unknown{"c", "3", {}, 0, "why"},
      input{"d", "4", {}, 0, "", true};
  CHECK(model_error({one, other, input}) == Approx(0.05));
  CHECK(model_error({{"a", "1", -0.03, 0.01}}) == Approx(0.04));
  CHECK_FALSE(model_error({one, unknown}));
  CHECK(in_words(one) == "a (1): without it R_r +3 %");
  CHECK(in_words(other) == "b (2): without it R_r within 4 %");
  CHECK(in_words({"a", "1", -0.012, 0.01}) == "a (1): without it R_r -1.2 % +- 1 %");
  CHECK(in_words(unknown) == "c (3): what that costs is not known, why");
  CHECK(in_words(input) == "d (4)");

  const RollingSolution cylinder = answered(smooth(Indenter::cylinder)), sphere = answered(smooth(Indenter::sphere));
  CHECK(cylinder.model_error > 0);
  CHECK(std::isnan(sphere.model_error));  // of its strains no solution is known
  CHECK(cylinder.assumptions.size() == 6);
  CHECK(sphere.assumptions.size() == 5);
}

TEST_CASE("the guide's table names all that is assumed", "[core][estimate][assumptions]") {
  std::ifstream file(source_directory() / "studies" / "guide.md");
  std::ostringstream text;
  text << file.rdbuf();
  std::string guide = text.str(), names;
  const std::size_t table = guide.find("| it assumes |");
  REQUIRE(table != std::string::npos);
  std::istringstream lines(guide.substr(table, guide.find("\n\n", table) - table));
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("| it assumes", 0) != 0 && line.rfind("|---", 0) != 0)
      names += line.substr(2, line.find(" |", 2) - 2) + '\n';
  std::string expected;
  for (const std::string_view name : assumption_names()) expected += std::string(name) + '\n';
  CHECK(names == expected);
}
