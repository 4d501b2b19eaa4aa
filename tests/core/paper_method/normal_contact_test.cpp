// Covers offset_kernel too.

#include "core/paper_method/normal_contact.hpp"

#include <numeric>

#include "tests/catch.hpp"
#include "tests/core/active_set_scenes.hpp"

using namespace rollres;
using namespace rollres::test;

namespace {

NormalContact press(const RollingScene& scene, const SurfaceGrid& grid, std::vector<int> start = {}) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(grid.size());
  NormalContactSolver solver(scene, influence_table(scene, grid), grid);
  return solver.solve(none, scene.indenter == Indenter::sphere ? none : Eigen::VectorXd(), std::move(start));
}

std::vector<int> all_nodes(const SurfaceGrid& grid) {
  std::vector<int> nodes(grid.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  return nodes;
}

}  // namespace

TEST_CASE("phases A and B end in the same contact from one node and from all nodes", "[core][normal_contact]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    RollingScene scene = paper_scene(indenter);
    scene.spacing = indenter == Indenter::cylinder ? 0.1e-3 : 0.5e-3;
    const SurfaceGrid grid = mirrored(window(dimension_of(indenter), *scene.spacing, 6e-3));
    const NormalContact grown = press(scene, grid), shrunk = press(scene, grid, all_nodes(grid));
    REQUIRE(grown.converged);
    REQUIRE(shrunk.converged);
    CHECK(grown.contact == shrunk.contact);
    CHECK((grown.force - shrunk.force).norm() < 1e-10 * grown.force.norm());
    CHECK(grown.force.maxCoeff() <= 0);
  }
}

TEST_CASE("the approach that a load causes, given in its place, causes that load", "[core][normal_contact]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    RollingScene scene = paper_scene(indenter);
    scene.spacing = 0.5e-3;
    const SurfaceGrid grid = mirrored(window(dimension_of(indenter), *scene.spacing, 6e-3));
    const NormalContact loaded = press(scene, grid);
    scene.load.reset();
    scene.approach = loaded.approach;
    const NormalContact pressed = press(scene, grid);
    REQUIRE(pressed.converged);
    CHECK(pressed.contact == loaded.contact);
    CHECK((pressed.force - loaded.force).norm() < 1e-10 * loaded.force.norm());
  }
}

TEST_CASE("the more tension a node bears before it lets go, the longer the contact", "[core][normal_contact][long]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    RollingScene scene = paper_scene(indenter);
    scene.spacing = indenter == Indenter::cylinder ? 0.1e-3 : 0.5e-3;
    const SurfaceGrid grid = mirrored(window(dimension_of(indenter), *scene.spacing, 8e-3));
    std::size_t nodes = press(scene, grid).contact.size();
    for (const double threshold : {1e6, 4e6}) {
      scene.adhesion_threshold = threshold;
      const NormalContact contact = press(scene, grid);
      REQUIRE(contact.converged);
      CHECK(contact.force.maxCoeff() > 0);
      CHECK(contact.force.maxCoeff() <= threshold * grid.cell_area());
      CHECK(contact.contact.size() > nodes);
      CHECK(static_cast<int>(contact.contact.size()) < grid.size());
      nodes = contact.contact.size();
    }
  }
}

TEST_CASE("on an elastic layer the pressure under a cylinder is even in x", "[core][normal_contact]") {
  RollingScene scene = paper_scene(Indenter::cylinder);
  scene.stiffening = 0;
  const SurfaceGrid grid = window(2, *scene.spacing, 8e-3);
  const NormalContact contact = press(scene, grid);
  REQUIRE(contact.converged);
  CHECK((contact.force - contact.force.reverse()).norm() < 1e-10 * contact.force.norm());
}
