#include "core/influence/line_passage.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/grid_choice.hpp"
#include "core/model/contact_surface.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// A soft layer that forgets within a few of its thicknesses on a harder one.
RollingScene two_layers() {
  RollingScene scene;
  scene.radius = 0.05;
  scene.layer_thickness = 0.003;
  scene.static_shear_modulus = 1e6;
  scene.stiffening = 2;
  scene.creep_time = 0.004;
  scene.speed = 1;
  scene.load = 1000;
  scene.friction_coefficient = 0.3;
  BondedLayer below;
  static_cast<MaterialInputs&>(below) = scene;
  below.static_shear_modulus = 4e6;
  below.creep_time = 0.001;
  below.layer_thickness = 0.002;
  scene.lower_layers = {below};
  return scene;
}

SurfaceGrid line(double spacing, int columns) {
  SurfaceGrid grid;
  grid.spacing_x = spacing;
  grid.spacing_y = 1;
  grid.columns = columns;
  grid.rows = 1;
  return grid;
}

}  // namespace

TEST_CASE("where a layer is cut in two changes nothing, be the upper part far thinner than a cell",
          "[core][line_passage]") {
  // A rule of nodes over a cell that follows the thickness would not end.
  const SurfaceGrid grid = line(0.5e-3, 30);
  RollingScene scene = two_layers();
  static_cast<MaterialInputs&>(scene.lower_layers.front()) = scene;
  const auto cut_at = [&](double depth) {
    scene.layer_thickness = depth;
    scene.lower_layers.front().layer_thickness = 0.005 - depth;
    return line_passage_table(scene, grid, grid.columns);
  };
  const InfluenceTable half = cut_at(0.0025);
  for (const double depth : {1e-4, 1e-6, 1e-9}) {
    const InfluenceTable sheet = cut_at(depth);
    for (const auto component : {&InfluenceTable::ww, &InfluenceTable::uu, &InfluenceTable::uw}) {
      double largest = 0, difference = 0;
      for (std::size_t i = 0; i < (half.*component).size(); ++i) {
        largest = std::max(largest, std::abs((half.*component)[i]));
        difference = std::max(difference, std::abs((sheet.*component)[i] - (half.*component)[i]));
      }
      CAPTURE(depth, difference, largest);
      CHECK(difference < 1e-8 * largest);
    }
  }
}

TEST_CASE("a single passage over two layers under a cylinder is a train of bodies far apart", "[core][line_passage]") {
  const SurfaceGrid grid = line(0.5e-3, 30);
  for (const bool inertia : {false, true}) {
    RollingScene scene = two_layers();
    if (inertia) scene.inertia = Inertia::on;
    const InfluenceTable passage = line_passage_table(scene, grid, grid.columns);
    constexpr int columns = 801, aliases = 60;
    scene.period = columns * grid.spacing_x;  // 80 thicknesses: the rigid base has ended all by then
    // Aliases alternate in sign and fall with their square, so the mean of two sums errs by the cube.
    scene.series_terms = aliases * columns + (columns - 1) / 2;
    const InfluenceTable last = influence_table(scene, grid);
    scene.series_terms -= columns;
    const InfluenceTable before = influence_table(scene, grid);
    for (const auto component : {&InfluenceTable::ww, &InfluenceTable::uu, &InfluenceTable::uw}) {
      double largest = 0, difference = 0;
      for (std::size_t i = 0; i < (passage.*component).size(); ++i) {
        const double train = 0.5 * ((last.*component)[i] + (before.*component)[i]);
        largest = std::max(largest, std::abs(train));
        difference = std::max(difference, std::abs((passage.*component)[i] - train));
      }
      INFO("inertia " << inertia);
      CHECK(difference < 1e-6 * largest);
    }
  }
}

TEST_CASE("a memory that no contact lives to see changes no displacement, however long it is", "[core][line_passage]") {
  const SurfaceGrid grid = line(0.1e-3, 40);
  const auto table_with = [&](double time) {
    RollingScene scene = two_layers();
    scene.material = MaterialModel::prony;
    scene.static_shear_modulus = 1e6;
    scene.relaxation_moduli = {2e6, 3e6};
    scene.relaxation_times = {1e-3, time};
    return line_passage_table(scene, grid, grid.columns);
  };
  // The memory's rate is still felt at 1e8 thicknesses, by 1e-8 of its compliance.
  const InfluenceTable wanted = table_with(3e5);
  for (const double time : {3e7, 3e9, 1e12, 1e16}) {
    INFO("memory " << time << " s");
    const InfluenceTable table = table_with(time);
    for (const auto component : {&InfluenceTable::ww, &InfluenceTable::uu, &InfluenceTable::uw}) {
      double largest = 0, difference = 0;
      for (std::size_t i = 0; i < (table.*component).size(); ++i) {
        largest = std::max(largest, std::abs((wanted.*component)[i]));
        difference = std::max(difference, std::abs((table.*component)[i] - (wanted.*component)[i]));
      }
      CHECK(difference < 1e-7 * largest);
    }
  }
}

TEST_CASE("a coating's share of what yields is that in passage: what it would do at rest has no part in it",
          "[core][line_passage]") {
  RollingScene scene = two_layers();
  BondedLayer coating;
  coating.material = MaterialModel::prony;
  coating.layer_thickness = 0.002;
  coating.relaxation_times = {1e-3};
  coating.relaxation_moduli = {2e6};
  coating.static_shear_modulus = 3e6;
  scene.coating_layers = {coating};
  const double fresh = share_of_coating(scene);
  coating.static_shear_modulus = 1e5;
  scene.coating_layers = {coating};
  CHECK(share_of_coating(scene) > fresh + 0.1);  // a softer coating yields more
  coating.relaxation_times.push_back(1e9);
  coating.relaxation_moduli.push_back(2.9e6);
  scene.coating_layers = {coating};
  CHECK(share_of_coating(scene) == Approx(fresh).epsilon(1e-9));
  // The same contact, given by its approach.
  const ContactEstimate contact = estimate_contact(scene);
  scene.load.reset();
  scene.approach = contact.approach;
  CHECK(share_of_coating(scene) == Approx(fresh).epsilon(1e-3));  // to which half-widths are estimated
}

TEST_CASE("far from a load on thin incompressible layers nothing moves, to the last digit", "[core][line_passage]") {
  // A long wave moves them by k^2 H^3/(3 G) each: so -1/2 sum C x^2 is the sum of H^3/(3 G), and an error of 1e-11 at
  // each of the far cells would be seen in its fourth digit.
  RollingScene scene;
  scene.radius = 4e5;
  scene.layer_thickness = 1;
  scene.static_shear_modulus = 1;
  scene.material = MaterialModel::elastic;
  scene.speed = 1;
  scene.load = 1;
  scene.inertia = Inertia::off;
  BondedLayer coating;
  coating.layer_thickness = 1;
  coating.static_shear_modulus = 30;
  coating.material = MaterialModel::elastic;
  scene.coating_layers = {coating};
  const double cell = 0.1;
  const int reach = 8000;
  const InfluenceTable table = line_passage_table(ContactModel(scene), line(cell, 2), reach);
  double moment = 0;
  for (int column = -reach; column <= reach; ++column)
    moment -= 0.5 * table.ww[static_cast<std::size_t>(table.index(column, 0))] * std::pow(column * cell, 2) * cell;
  // The ring's curvature adds 1.5 H/R = 4e-6, the sum over cells 2e-5.
  CHECK(moment == Approx((1 + 1 / 30.0) / 3).epsilon(5e-5));
}
