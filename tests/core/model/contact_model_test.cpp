#include "core/model/contact_model.hpp"

#include <fstream>
#include <regex>
#include <set>

#include "core/model/contact_surface.hpp"
#include "core/model/model_in_words.hpp"
#include "core/solve/resolve.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/infinite.hpp"
#include "tests/source_directory.hpp"

using namespace rollres;

namespace {

/// A rubber tyre on a mat on a half-space.
RollingScene tyre_on_mat() {
  RollingScene scene;
  scene.radius = 0.05;
  scene.layer_thickness = 0.01;
  scene.static_shear_modulus = 5e6;
  scene.stiffening = 2;
  scene.creep_time = 1e-3;
  BondedLayer ground;
  ground.layer_thickness = infinite;
  ground.material = MaterialModel::elastic;
  ground.static_shear_modulus = 1e8;
  scene.lower_layers = {ground};
  BondedLayer tyre;
  tyre.layer_thickness = 0.005;
  tyre.static_shear_modulus = 1e6;
  tyre.stiffening = 4;
  tyre.creep_time = 0.02;
  scene.coating_layers = {tyre};
  scene.speed = 0.8;
  scene.load = 400;
  scene.friction_coefficient = 0.4;
  scene.drive = Drive::free;
  return scene;
}

/// The names of the members of a struct in a header, one declaration a line.
std::set<std::string> members_of(const std::string& header, const std::string& name) {
  std::ifstream file(source_directory() / header);
  const std::regex declaration(
      R"(^  [A-Za-z_:<>]+ ([a-z][a-z0-9_]*(?: = [^,;]+)?(?:, [a-z][a-z0-9_]*(?: = [^,;]+)?)*);.*)");
  const std::regex one("([a-z][a-z0-9_]*)(?: = [^,;]+)?");
  std::set<std::string> members;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("struct " + name, 0) == 0) inside = true;
    if (inside && line == "};") break;
    std::smatch found;
    if (!inside || !std::regex_match(line, found, declaration)) continue;
    const std::string list = found[1];
    for (std::sregex_iterator at(list.begin(), list.end(), one), end; at != end; ++at) members.insert((*at)[1]);
  }
  return members;
}

std::string about(const ContactModel& model, const std::string& what) {
  for (const ModelStatement& statement : model_in_words(model))
    if (statement.about == what) return statement.text;
  return {};
}

}  // namespace

TEST_CASE("a scene holds inputs alone: each of its members is visited as one", "[core][model]") {
  std::set<std::string> visited;
  const RollingScene scene;
  visit_inputs(scene, [&](const Quantity& quantity, const auto&) { visited.insert(std::string(quantity.key)); });
  std::set<std::string> members = members_of("core/scene/scene.hpp", "RollingScene");
  members.merge(members_of("core/scene/bonded_layer.hpp", "BondedLayer"));
  members.merge(members_of("core/scene/material_inputs.hpp", "MaterialInputs"));
  CHECK(members.size() > 50);  // the headers were read
  CHECK(members == visited);
}

TEST_CASE("a model at another flow keeps its layers, and its coating is met with other times", "[core][model]") {
  const ContactModel model(tyre_on_mat()), slower = model.with_flow(0.5);
  CHECK(model.flow == 1);
  CHECK(slower.coating.front().creep == model.coating.front().creep);
  const double time = coating_of(model).front().material.terms.front().time;
  CHECK(coating_of(slower).front().material.terms.front().time == Approx(0.5 * time).epsilon(1e-14));
  CHECK(foundation_of(slower) == foundation_of(model));
  CHECK(coating_of(model.with_flow(0)).front().material.terms.empty());
}

TEST_CASE("softening changes the layer that it names, under the body first and then on it", "[core][model]") {
  const ContactModel model(tyre_on_mat());
  const ContactModel softer = model.with_softening({{1, 1}, {1, 1}, {0.5, 0.25}});
  CHECK(foundation_of(softer) == foundation_of(model));
  const CreepSpectrum &before = model.coating.front().creep, &after = softer.coating.front().creep;
  CHECK(1 / after.at_rest() == Approx(0.5 / before.at_rest()).epsilon(1e-12));
  // G at once is that at rest and all of the relaxation: 1 + 4 of 1 MPa.
  CHECK(1 / after.instantaneous == Approx(0.5e6 + 0.25 * 4e6).epsilon(1e-9));
  CHECK(softer.coating.front().modulus_at_rest == Approx(0.5e6));
}

TEST_CASE("a model decides whether inertia counts and which method solves it", "[core][model]") {
  RollingScene scene = tyre_on_mat();
  CHECK(ContactModel(scene).method == Method::spectral);
  scene.period = 1;
  CHECK(ContactModel(scene).method == Method::newton);
  scene.period.reset();
  scene.coating_layers.clear();
  scene.lower_layers.clear();
  scene.tolerance = 1e-3;
  CHECK_FALSE(ContactModel(scene).inertia);
  CHECK_FALSE(ContactModel(scene).composite());
  scene.speed = 30;
  // Viktorov's approximation: Rayleigh waves are slower than those of shear by (0.87 + 1.12 nu)/(1 + nu) = 0.9533.
  const ContactModel fast(scene);
  CHECK(rayleigh_number(fast) == Approx(1000 * 30 * 30 / (5e6 * 0.9533 * 0.9533)).epsilon(1e-4));
  CHECK(fast.inertia);
  CHECK(fast.composite());
  CHECK(about(fast, "inertia").find("included by itself: ") == 0);
}

TEST_CASE("the words of a model are what its answer was solved by", "[core][model]") {
  RollingScene scene = tyre_on_mat();
  scene.tolerance = 1e-2;
  scene.lower_layers.front().static_shear_modulus = 1e11;
  const ContactModel model = resolve(scene);
  REQUIRE(model.decisions.size() == 1);
  CHECK(about(model, "left out") == model.decisions.front());
  CHECK(about(model, "layer 2").empty());
  CHECK(about(model, "coating 1").find("0.005 m thick, ν = 0.5, G from 1e+06 to 5e+06 Pa, ") == 0);
  const RollingSolution solution = solve(scene);
  CHECK(solution.model.find(model.decisions.front()) != std::string::npos);
  CHECK(about(model, "method").find(name_of(solution.method)) == 0);
}
