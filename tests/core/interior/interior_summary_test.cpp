#include "core/interior/interior_summary.hpp"

#include <algorithm>
#include <cmath>

#include "core/reference/reference_inside.hpp"
#include "tests/core/converged.hpp"
#include "tests/core/interior/layered_scenes.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/plain_scene.hpp"

// Covers cylinder_inside and interior_lines, too.

using namespace rollres;

namespace {

using Detail = InteriorField::Detail;

RollingScene continuous(double friction) {
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  scene.kinematics = Kinematics::consistent;
  scene.friction_coefficient = friction;
  return scene;
}

}  // namespace

TEST_CASE("the loss summed over the inside of the layer is that of its surface", "[core][interior]") {
  for (const double friction : {0.0, 0.2}) {
    const RollingScene scene = continuous(friction);
    const RollingSolution s = converged(scene);
    for (const Detail detail : {Detail::surface, Detail::inside}) {
      const double loss = interior_summary(scene, s.fields, detail).loss;
      CHECK(loss == Approx(s.viscous_loss).epsilon(detail == Detail::surface ? 1e-6 : 3e-5));
    }
  }
}

TEST_CASE("the inside of a skewed cylinder loses what its surface takes up, under it and in its cover",
          "[core][interior][skew]") {
  RollingScene scene = continuous(0.2);
  scene.drive = Drive::free;
  scene.skew_angle = 0.04;
  scene.tolerance = 1e-4;
  scene.interior = Interior::on;
  const RollingSolution left = converged(scene);
  CHECK(left.interior_loss == Approx(left.viscous_loss).epsilon(1e-5));
  RollingScene straight = scene;
  straight.skew_angle.reset();
  CHECK(left.viscous_loss > 1.03 * converged(straight).viscous_loss);
  scene.skew_angle = -0.04;
  const RollingSolution right = converged(scene);
  CHECK(right.peak_shear_strain == Approx(left.peak_shear_strain).epsilon(1e-9));
  CHECK(right.bond_shear == Approx(left.bond_shear).epsilon(1e-9));
  // Without friction nothing is drawn along the axle.
  scene.friction_coefficient = 0;
  scene.drive = Drive::top_force;
  const RollingSolution smooth = converged(scene);
  CHECK(smooth.interior_loss == Approx(smooth.viscous_loss).epsilon(1e-5));
}

TEST_CASE("inside a thick ring bonds bear what comes round, too", "[core][interior][ring]") {
  // By the equations in polar coordinates for whole harmonics, in another program; of an endless ring 1993 and 6921 Pa.
  RollingScene scene = plain_scene(1, 2000);
  scene.radius = 0.05;
  scene.layer_thickness = 0.2;
  scene.material = MaterialModel::elastic;
  scene.static_shear_modulus = 100e9;
  scene.friction_coefficient = 0;
  scene.inertia = Inertia::off;
  scene.drive = Drive::free;
  scene.interior = Interior::on;
  BondedLayer outer, inner;
  outer.layer_thickness = 0.004;
  outer.poisson_ratio = 0.45;
  outer.static_shear_modulus = 8e6;
  outer.stiffening = 0.5;
  outer.creep_time = 0.001;
  inner.layer_thickness = 0.02;
  inner.static_shear_modulus = 1e6;
  inner.stiffening = 2;
  inner.creep_time = 0.1;
  scene.coating_layers = {outer, inner};
  const RollingSolution s = converged(scene);
  CHECK(s.bond_tensions.at(1) == Approx(2139).epsilon(3e-3));
  CHECK(s.bond_tensions.at(2) == Approx(7070).epsilon(3e-3));
}

TEST_CASE("the half-length on a grid follows the contact smoothly, and is that of continuous edges as cells shrink",
          "[core][interior]") {
  RollingScene scene = continuous(0);
  scene.material = MaterialModel::elastic;
  const auto half_length = [&](double load) {
    scene.load = load;
    return interior_summary(scene, converged(scene).fields, Detail::inside).half_length;
  };
  const double a = half_length(20e3);
  scene.spacing = a / 20.3;
  double before = half_length(20e3);
  CHECK(before == Approx(a).epsilon(0.01));
  for (int step = 1; step <= 10; ++step) {  // a node more or less would be 0.05; over a thin layer a grows as P^(1/3)
    const double now = half_length(20e3 * (1 + 0.02 * step));
    CHECK(now / before - 1 > 0.001);
    CHECK(now / before - 1 < 0.015);
    before = now;
  }
}

TEST_CASE("of a soft layer on an elastic one all is lost in the soft one, a coating loses what is its own",
          "[core][interior]") {
  const RollingScene scene = on_hard_layer(continuous(0));
  const RollingSolution s = converged(scene);
  const InteriorSummary inside = interior_summary(scene, s.fields, Detail::surface);
  REQUIRE(inside.layers.size() == 2);
  CHECK(inside.layers[1].loss == 0);
  CHECK(inside.loss == Approx(s.viscous_loss).epsilon(1e-6));
  REQUIRE(inside.bonds.size() == 2);
  CHECK(inside.bonds[0].z == Approx(-0.005));
  CHECK(inside.bonds[1].z == Approx(-0.009));
  CHECK(inside.bonds[0].shear > 0);

  RollingScene coated = coated_alike(continuous(0));
  coated.load = *coated.load * coated.radius / 500;  // as long a contact of so large a cylinder that its ring is flat
  coated.radius = 500;
  const RollingSolution both = converged(coated);
  const InteriorSummary halves = interior_summary(coated, both.fields, Detail::inside);
  REQUIRE(halves.layers.size() == 2);
  CHECK(halves.layers[0].loss == Approx(halves.layers[1].loss).epsilon(1e-4));  // H/R of the ring is 2e-5
  CHECK(halves.loss == Approx(both.viscous_loss).epsilon(3e-5));
  CHECK(halves.lines.front().z < 0);
  CHECK(halves.lines.back().z > 0);
}

TEST_CASE("the largest shear strain of a Hertz line contact is at 0.786 a, 0.30028 p0/G", "[core][interior]") {
  RollingScene scene = continuous(0);
  scene.material = MaterialModel::elastic;
  scene.layer_thickness = INFINITY;
  scene.load = 10;  // a/R = 1/1400: a circle is a parabola
  scene.interior = Interior::on;
  const RollingSolution s = converged(scene);
  const double half = 0.5 * s.contact_area;
  CHECK(s.peak_shear_strain * 3e6 / s.peak_pressure == Approx(hertz_line_largest_shear()).epsilon(1e-5));
  CHECK(s.peak_shear_strain_z == Approx(-half * hertz_line_depth_of_largest_shear()).epsilon(3e-3));
  CHECK(std::abs(s.peak_shear_strain_x) < 1e-3 * half);
  CHECK(std::isnan(s.bond_shear));
  CHECK(std::abs(s.interior_loss) < 1e-9 * 10 * scene.speed * half / scene.radius);
}

TEST_CASE("what is inside is an answer of solve only where it is asked for", "[core][interior]") {
  RollingScene scene = continuous(0.2);
  CHECK(std::isnan(converged(scene).peak_shear_strain));
  scene.interior = Interior::on;
  const RollingSolution s = converged(scene);
  CHECK(s.peak_shear_strain >= s.peak_strain_amplitude);
  CHECK(s.peak_strain_amplitude >= s.strain_amplitude);
  CHECK(s.interior_loss == Approx(s.viscous_loss).epsilon(1e-6));
  CHECK(s.bond_shear > 0);
  CHECK(s.bond_shear < s.peak_pressure);
  CHECK(s.bond_shears == std::vector<double>{s.bond_shear});
}

TEST_CASE("each layer tells what its own bond bears, those under the body from the contact and then those on it",
          "[core][interior]") {
  RollingScene wheel = continuous(0);
  wheel.tolerance = 1e-4;
  wheel.inertia = Inertia::off;
  BondedLayer& tyre = wheel.coating_layers.emplace_back();
  tyre.layer_thickness = 0.002;
  tyre.material = MaterialModel::elastic;
  tyre.static_shear_modulus = 5e6;
  BondedLayer& ground = wheel.lower_layers.emplace_back();
  ground.layer_thickness = INFINITY;
  ground.material = MaterialModel::elastic;
  ground.static_shear_modulus = 4e6;
  wheel.interior = Interior::on;
  const RollingSolution s = converged(wheel);
  const InteriorSummary inside = interior_summary(ContactModel(wheel).with_answer(s), s.fields, Detail::surface);
  REQUIRE(inside.bonds.size() == 2);
  REQUIRE(s.bond_shears.size() == 3);
  for (const Bond& bond : inside.bonds) {
    CHECK(s.bond_shears[bond.on_body ? 2 : 0] == Approx(bond.shear));
    CHECK(s.bond_tensions[bond.on_body ? 2 : 0] == Approx(bond.tension));
  }
  CHECK(s.bond_shears[1] == 0);  // a half-space ends nowhere
  CHECK(s.bond_shear == std::max(s.bond_shears[0], s.bond_shears[2]));
  CHECK(s.bond_shears[0] != s.bond_shears[2]);
  CHECK(output_number(s, "bond_shears[2]") == s.bond_shears[2]);
  CHECK(std::isnan(output_number(s, "bond_shears[3]")));
}

// Amplitudes between the lines of Gauss's rule: without them the two differ by 8e-4 and 2 %.
TEST_CASE("the amplitudes of the strain's cycle do not depend on how densely the inside is looked at",
          "[core][interior]") {
  for (const double friction : {0.0, 0.2}) {
    const RollingScene scene = continuous(friction);
    const RollingSolution s = converged(scene);
    const InteriorSummary inside = interior_summary(scene, s.fields, Detail::inside),
                          surface = interior_summary(scene, s.fields, Detail::surface);
    const LayerLoss& layer = inside.layers.front();
    CHECK(std::abs(layer.strain_amplitude - surface.strain_amplitude) < layer.amplitude_error);
    CHECK(layer.amplitude_error < 2e-3 * layer.strain_amplitude);
    CHECK(inside.peak_strain_amplitude == Approx(surface.peak_strain_amplitude).epsilon(5e-3));
  }
}

TEST_CASE("on a grid the loss inside is that of the surface within the grid's error", "[core][interior]") {
  const RollingScene scene = with_method(paper_cylinder(), Method::newton);
  const RollingSolution s = converged(scene);
  CHECK(interior_summary(scene, s.fields, Detail::surface).loss == Approx(s.viscous_loss).epsilon(0.02));
}

TEST_CASE("a section shows bonds from both sides, z upwards", "[core][interior]") {
  const RollingScene scene = continuous(0.2);
  const RollingSolution s = converged(scene);
  const std::vector<InteriorSection> sections = interior_sections(scene, s.fields);
  REQUIRE(sections.size() == 1);
  const InteriorSection& section = sections.front();
  CHECK(section.z.front() == 0);
  CHECK(section.z.back() == Approx(-0.005));
  CHECK(section.fields.w.col(section.fields.w.cols() - 1).abs().maxCoeff() < 1e-10 * section.fields.w.abs().maxCoeff());
  CHECK(section.fields.loss_density.minCoeff() >= 0);
  // The traction on the surface, between the ends of the contact.
  const auto row = static_cast<Eigen::Index>(section.x.size() / 2);
  CHECK(section.fields.stress_of(Component::z)(row, 0) < -0.5 * s.peak_pressure);
}
