// Covers layer_mesh and point_shapes too.

#include "core/finite_strain/flowing_layer.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

FlowingLayer some_layer(bool bulk_relaxes, double curvature = 0) {
  FlowingMaterial rubber{.modulus = 2.5, .terms = {{0.7, 0.3}, {0.6, 20}}};
  rubber.bulk_ratio = bulk_relaxes ? 9 : 1e3;
  rubber.bulk_relaxes = bulk_relaxes;
  rubber.yeoh = {-0.3, 0.2};
  FlowingMaterial stiff{.modulus = 4, .terms = {{1.5, 2}}};
  stiff.bulk_ratio = 50;
  return {layer_mesh({.trailing = -1, .leading = 1.2, .cells = 4, .thicknesses = {0.6, 0.4}, .curvature = curvature}),
          {rubber, stiff},
          1};
}

/// Displacements that vanish at held columns.
Vector some_displacements(const FlowingLayer& layer, double phase) {
  const Numbering& numbers = layer.numbering();
  Vector moved = Vector::Zero(numbers.size());
  for (int column = 1; column < numbers.columns; ++column)
    for (int row = 0; row < numbers.free_rows && !layer.is_held(column); ++row) {
      const double x = layer.mesh().node_x(column), depth = 1 + layer.mesh().node_z(row);
      moved(numbers.node(column, row)) = 0.05 * depth * std::sin(x + phase) / (1 + x * x);
      moved(numbers.node(column, row) + 1) = -0.1 * depth * std::cos(0.7 * x + phase) / (1 + x * x);
    }
  return moved;
}

}  // namespace

TEST_CASE("a mesh crowds at the edges of the contact, ends rows where layers meet and reaches far", "[core][finite]") {
  const LayerMesh mesh = layer_mesh({.trailing = -1, .leading = 2, .cells = 12, .thicknesses = {0.5, 1.5}});
  double share = 0;
  for (int column = 0; column < mesh.columns(); ++column) share += mesh.share(column);
  CHECK(std::abs(share - (mesh.x.front() - mesh.x.back())) < 1e-12 * share);
  CHECK(mesh.x.front() >= 2 + 10 * 2);
  CHECK(mesh.x.back() <= -1 - 10 * 2);
  for (int e = 0; e < mesh.cells_along(); ++e) CHECK(mesh.length(e) > 0);
  for (int r = 0; r < mesh.cells_down(); ++r) {
    CHECK(mesh.height(r) > 0);
    CHECK((mesh.layer[static_cast<std::size_t>(r)] == 0) == (mesh.node_z(2 * r + 1) > -0.5));
  }
  CHECK(std::abs(mesh.z.back() + 2) < 1e-12);
}

TEST_CASE("the derivative of a flowing layer's forces, memory included, is that by differences", "[core][finite]") {
  for (const auto& [bulk_relaxes, curvature] : {std::pair(false, 0.0), std::pair(true, 0.0), std::pair(true, 0.4)}) {
    FlowingLayer layer = some_layer(bulk_relaxes, curvature);
    const Vector moved = some_displacements(layer, 0), change = some_displacements(layer, 1.1);
    Eigen::Matrix3Xd pressures = Eigen::Matrix3Xd::Zero(3, layer.cells());
    // Pressures that go with the displacements.
    for (int pass = 0; pass < 2; ++pass) {
      REQUIRE(layer.evaluate(moved, pressures));
      pressures += layer.pressure_change(Vector::Zero(moved.size()));
    }
    REQUIRE(layer.evaluate(moved, pressures));
    CHECK(layer.volume_defect() < 1e-12);
    const Vector derivative = layer.apply(change);
    const Eigen::Matrix3Xd following = layer.pressure_change(change);
    constexpr double step = 1e-6;
    const auto forces = [&, bulk = bulk_relaxes, bend = curvature](double by) {
      FlowingLayer other = some_layer(bulk, bend);
      REQUIRE(other.evaluate(moved + by * change, pressures + by * following));
      return other.forces();
    };
    const Vector differences = (forces(step) - forces(-step)) / (2 * step);
    CHECK((derivative - differences).norm() < 1e-7 * derivative.norm());  // step squared, and rounding over the step
  }
}

TEST_CASE("a bent layer at rest has no stress, and its places lie on circles", "[core][finite]") {
  FlowingMaterial elastic{.modulus = 1, .terms = {}};
  elastic.bulk_ratio = 20;
  FlowingLayer layer(layer_mesh({.trailing = -1, .leading = 1, .cells = 24, .thicknesses = {1}, .curvature = 0.5}),
                     {elastic}, 1);
  const Vector rest = Vector::Zero(layer.numbering().size());
  REQUIRE(layer.evaluate(rest, Eigen::Matrix3Xd::Zero(3, layer.cells())));
  CHECK(layer.forces().norm() < 1e-13);
  const LayerMesh& mesh = layer.mesh();
  // The core's surface is a circle of half the radius about (0, -2).
  for (const double along : {-3.0, 0.2, 2.0})
    CHECK((mesh.rest(along, -1) - Eigen::Vector2d(0, -2)).norm() == Approx(1));
  // Derivatives of places are the frame, as long as the circles.
  const double step = 1e-6;
  const Eigen::Vector2d along = (mesh.rest(1 + step, -0.5) - mesh.rest(1 - step, -0.5)) / (2 * step),
                        up = (mesh.rest(1, -0.5 + step) - mesh.rest(1, -0.5 - step)) / (2 * step);
  CHECK((along - mesh.shortening(-0.5) * mesh.frame(1).col(0)).norm() < 1e-9);
  CHECK((up - mesh.frame(1).col(1)).norm() < 1e-9);
}

TEST_CASE("without memory the local matrix is the whole derivative", "[core][finite]") {
  FlowingMaterial elastic{.modulus = 1, .terms = {}};
  elastic.bulk_ratio = 20;
  FlowingLayer layer(layer_mesh({.trailing = -1, .leading = 1, .cells = 4, .thicknesses = {1}}), {elastic}, 1);
  REQUIRE(layer.evaluate(some_displacements(layer, 0), Eigen::Matrix3Xd::Zero(3, layer.cells())));
  const Numbering& numbers = layer.numbering();
  BlockTridiagonal local(layer.mesh().cells_along() + 1, 2 * numbers.stride(), numbers.stride(), numbers.stride());
  layer.add_local(local);
  for (int column = 0; column < numbers.columns; ++column)
    local.add(numbers.surface(column, 0), numbers.surface(column, 0), 1);
  local.factorise();
  const Vector change = some_displacements(layer, 2);
  CHECK((local.solve(layer.apply(change)) - change).norm() < 1e-9 * change.norm());
}

TEST_CASE("an elastic layer that ends as it began takes no power, and a folded one is told", "[core][finite]") {
  FlowingMaterial elastic{.modulus = 1, .terms = {}};
  elastic.bulk_ratio = 20;
  FlowingLayer layer(layer_mesh({.trailing = -1, .leading = 1, .cells = 16, .thicknesses = {1}}), {elastic}, 1);
  Vector moved = some_displacements(layer, 0.4);
  Eigen::Matrix3Xd pressures = Eigen::Matrix3Xd::Zero(3, layer.cells());
  REQUIRE(layer.evaluate(moved, pressures));
  double stored = 0;
  for (const double force : layer.forces()) stored += std::abs(force);
  CHECK(std::abs(layer.taken_power()) < 1e-3 * stored);  // of the mesh
  CHECK(layer.folding(0 * moved).least == 1);
  CHECK(layer.folding(-40 * moved).least < 0.1);
  CHECK_FALSE(layer.evaluate(-40 * moved, pressures));
}
