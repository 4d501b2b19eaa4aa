#include "core/interior/sphere_inside.hpp"

#include <cmath>

#include "core/reference/reference_inside.hpp"
#include "tests/core/converged.hpp"
#include "tests/core/interior/layered_scenes.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

using Detail = InteriorField::Detail;

RollingScene rubber_sphere(double friction, double spacing = 0.25e-3) {
  RollingScene scene = paper_sphere();
  scene.kinematics = Kinematics::consistent;
  scene.friction_coefficient = friction;
  scene.spacing = spacing;
  return scene;
}

}  // namespace

TEST_CASE("the loss summed over the inside of a sphere's layers is that of their surface, ever nearer on finer grids",
          "[core][interior][long]") {
  for (const double friction : {0.0, 0.2}) {
    double before = INFINITY;
    for (const double spacing : {0.5e-3, 0.25e-3, 0.125e-3}) {
      const RollingScene scene = rubber_sphere(friction, spacing);
      const RollingSolution s = converged(scene);
      const double missed = std::abs(interior_summary(scene, s.fields, Detail::inside).loss / s.viscous_loss - 1);
      CHECK(missed < 0.5 * before);
      before = missed;
    }
    CHECK(before < 1e-3);
  }
}

TEST_CASE("the inside of a turned sphere loses what its surface takes up, and turned back is its mirror image",
          "[core][interior][turned]") {
  RollingScene scene = rubber_sphere(0.2, 0.5e-3);
  const auto missed = [](const RollingSolution& s) { return s.interior_loss / s.viscous_loss - 1; };
  scene.interior = Interior::on;
  const RollingSolution straight = converged(scene);
  scene.skew_angle = 0.03;
  scene.camber_angle = 0.1;
  const RollingSolution left = converged(scene);
  CHECK(left.viscous_loss > 1.02 * straight.viscous_loss);
  CHECK(missed(left) == Approx(missed(straight)).epsilon(0.1));  // what this grid misses of a straight sphere
  scene.skew_angle = -0.03;
  scene.camber_angle = -0.1;
  const RollingSolution right = converged(scene);
  CHECK(std::abs(left.peak_shear_strain_y) > 1e-5);
  CHECK(right.peak_shear_strain_y == Approx(-left.peak_shear_strain_y).epsilon(1e-6));
  CHECK(right.peak_shear_strain == Approx(left.peak_shear_strain).epsilon(1e-9));
  CHECK(right.bond_shear == Approx(left.bond_shear).epsilon(1e-9));
  CHECK(right.strain_amplitude == Approx(left.strain_amplitude).epsilon(1e-9));
}

TEST_CASE("the largest shear strain under a Hertz sphere is Huber's", "[core][interior][long]") {
  RollingScene scene = rubber_sphere(0);
  scene.spacing.reset();
  scene.tolerance = 1e-3;
  scene.material = MaterialModel::elastic;
  scene.poisson_ratio = 0.3;
  scene.layer_thickness = INFINITY;
  scene.load = 1;
  scene.interior = Interior::on;
  const RollingSolution s = converged(scene);
  const AxisShear huber = hertz_point_largest_shear(0.3);
  CHECK(huber.difference == Approx(2 * 0.310).epsilon(1e-3));  // Johnson 1985, section 3.4
  CHECK(huber.depth == Approx(0.48).epsilon(0.01));
  const double half = std::cbrt(3 * *scene.load * scene.radius * (1 - 0.3) / (8 * 3e6));
  const double p0 = 1.5 * *scene.load / (M_PI * half * half);
  CHECK(s.peak_shear_strain == Approx(huber.difference * p0 / (2 * 3e6)).epsilon(2e-3));
  CHECK(s.peak_shear_strain_z == Approx(-huber.depth * half).epsilon(0.02));
  CHECK(std::abs(s.peak_shear_strain_x) < 0.02 * half);
  CHECK(s.peak_shear_strain_y == 0);
  CHECK(s.interior_loss == 0);
}

TEST_CASE("a coating on a sphere loses what is its own, and an elastic layer nothing", "[core][interior][long]") {
  const RollingScene coated = coated_alike(rubber_sphere(0));
  const RollingSolution both = converged(coated);
  const InteriorSummary halves = interior_summary(coated, both.fields, Detail::inside);
  REQUIRE(halves.layers.size() == 2);
  CHECK(halves.layers[0].loss == Approx(halves.layers[1].loss).epsilon(1e-9));
  CHECK(halves.layers[0].strain_amplitude == Approx(halves.layers[1].strain_amplitude).epsilon(1e-9));
  CHECK(halves.loss == Approx(both.viscous_loss).epsilon(5e-3));
  CHECK(halves.lines.front().z < 0);
  CHECK(halves.lines.back().z > 0);

  const RollingScene on_hard = on_hard_layer(rubber_sphere(0.2));
  const RollingSolution s = converged(on_hard);
  const InteriorSummary inside = interior_summary(on_hard, s.fields, Detail::surface);
  REQUIRE(inside.layers.size() == 2);
  CHECK(inside.layers[1].loss == 0);
  REQUIRE(inside.bonds.size() == 2);
  CHECK(inside.bonds[0].z == Approx(-0.005));
  CHECK(inside.bonds[0].shear > 0);
  CHECK(inside.peak_shear_strain >= inside.peak_strain_amplitude);
  CHECK(inside.peak_strain_amplitude >= inside.strain_amplitude);
}

TEST_CASE("sections of a sphere: upright at y = 0, the surface with its tractions, the base at rest",
          "[core][interior]") {
  const RollingScene scene = rubber_sphere(0.2);
  const RollingSolution s = converged(scene);
  const std::vector<InteriorSection> sections = interior_sections(scene, s.fields);
  REQUIRE(sections.size() == 3);
  const InteriorSection &upright = sections[0], &surface = sections[1], &base = sections[2];
  CHECK(!upright.is_face());
  CHECK(upright.z.back() == Approx(-0.005));
  CHECK(upright.fields.loss_density.minCoeff() >= 0);
  CHECK(upright.fields.v.size() == 0);
  CHECK(surface.is_face());
  CHECK(surface.z == std::vector<double>{0});
  CHECK(surface.fields.stress_of(Component::z).minCoeff() == Approx(-s.peak_pressure).epsilon(0.01));
  CHECK(surface.fields.stress_of(Component::yz).abs().maxCoeff() == Approx(s.peak_shear_y).epsilon(0.1));
  CHECK(base.fields.w.abs().maxCoeff() < 1e-10 * surface.fields.w.abs().maxCoeff());
  // Even across the motion.
  const Eigen::Index last = surface.fields.u.cols() - 1;
  CHECK((surface.fields.u.col(0) - surface.fields.u.col(last)).abs().maxCoeff() <
        1e-9 * surface.fields.u.abs().maxCoeff());
}
