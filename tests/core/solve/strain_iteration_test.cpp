#include "core/solve/strain_iteration.hpp"

#include <cmath>

#include "core/interior/interior_summary.hpp"
#include "core/material/strain_softening.hpp"
#include "core/solve/model_answer.hpp"
#include "tests/core/converged.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

/// A cylinder on rubber that loses half of its modulus.
RollingScene soft_scene(double load = 1e4) {
  RollingScene scene = plain_scene(1, load);
  scene.payne_drop = 0.5;
  scene.payne_strain = 0.02;
  scene.payne_exponent = 0.5;
  scene.payne_loss_peak = 1.2;
  scene.static_shear_modulus = 3e6;
  scene.stiffening = 0.5;
  return scene;
}

int solutions_of(const RollingSolution& solution) {
  const std::size_t place = solution.model.find("found in ");
  REQUIRE(place != std::string::npos);
  return std::stoi(solution.model.substr(place + 9));
}

/// The linear model of the moduli that an answer found, and what is inside its layers.
struct LinearTwin {
  ContactModel model;
  InteriorSummary inside;
};

/// Whose answer and strains are those that were found.
LinearTwin linear_twin(const RollingScene& scene, const RollingSolution& s) {
  const ContactModel linear = ContactModel(scene).with_answer(s);
  const RollingSolution same = solve_model(linear);
  CHECK(same.rolling_resistance == s.rolling_resistance);
  const InteriorSummary inside = interior_summary(linear, same.fields, InteriorField::Detail::inside);
  CHECK(inside.strain_amplitude == Approx(s.strain_amplitude).epsilon(1e-12));
  return {linear, inside};
}

/// Whether the twin's moduli are what Kraus's model makes of the scene's at the twin's strains.
void check_moduli(const RollingScene& scene, const LinearTwin& twin, double omega) {
  const Softening wanted = softening_at(scene, twin.inside.strain_amplitude);
  const std::complex<double> before = complex_modulus(scene, omega), after = 1.0 / twin.model.top().creep(omega);
  CHECK(after.real() == Approx(wanted.storage * before.real()).epsilon(3e-8));
  CHECK(after.imag() == Approx(wanted.loss * before.imag()).epsilon(3e-8));
}

}  // namespace

TEST_CASE("a scene with moduli at its strains is the linear scene of those moduli, whose strains they are",
          "[core][strain]") {
  const RollingScene scene = soft_scene();
  const RollingSolution s = converged(scene);
  REQUIRE(s.moduli_factors.size() == 1);
  CHECK(s.softening < 0.95);
  CHECK(s.strain_amplitude > 1e-3);
  CHECK(solutions_of(s) <= 12);
  const LinearTwin twin = linear_twin(scene, s);
  CHECK(softening_at(scene, twin.inside.strain_amplitude).storage == Approx(s.softening).epsilon(1e-12));
  check_moduli(scene, twin, scene.speed / (0.5 * s.contact_area));
}

// The whole of the inside, up to the surface, is another quadrature of the same strains; what it finds for the moduli
// is followed by the slope of R_r between two amplitudes.
TEST_CASE("the estimate contains the quadrature of the amplitude, which interior: on leaves as it is",
          "[core][strain]") {
  for (const double speed : {0.05, 1.0}) {
    RollingScene scene = soft_scene();
    scene.speed = speed;
    const RollingSolution s = converged(scene);
    const InteriorSummary fine =
        interior_summary(ContactModel(scene).with_answer(s), s.fields, InteriorField::Detail::surface);
    const double missed = std::log(fine.strain_amplitude / s.strain_amplitude);
    CHECK(std::abs(missed) < 1e-3);
    RollingScene softer = scene;  // as if the strains were 1 % larger
    *softer.payne_strain /= 1.01;
    const double slope = std::log(converged(softer).rolling_resistance / s.rolling_resistance) / std::log(1.01);
    CHECK(std::abs(slope * missed) < s.error_estimate);
    CHECK(s.error_estimate < 1e-3);
    scene.interior = Interior::on;
    const RollingSolution inside = converged(scene);
    CHECK(inside.strain_amplitude == s.strain_amplitude);
    CHECK(inside.peak_strain_amplitude == s.peak_strain_amplitude);
    CHECK(inside.error_estimate == s.error_estimate);
  }
}

TEST_CASE("without a drop the answer is the linear one to all digits, and at a small load it comes near it",
          "[core][strain]") {
  RollingScene none = soft_scene();
  none.payne_drop = 0;
  none.payne_loss_peak = 1;
  RollingScene plain = none;
  plain.payne_strain.reset();
  CHECK(converged(none).rolling_resistance == converged(plain).rolling_resistance);
  for (const auto& [load, near] : {std::pair{10.0, 0.1}, {0.01, 0.01}}) {
    RollingScene soft = soft_scene(load), linear = plain;
    linear.load = load;
    soft.payne_exponent = 1;
    const RollingSolution s = converged(soft);
    CHECK(s.rolling_resistance == Approx(converged(linear).rolling_resistance).epsilon(near));
    CHECK(1 - s.softening < near);
  }
}

TEST_CASE("under a sphere, too, the moduli are those of the strains, and a small load leaves them",
          "[core][strain][long]") {
  RollingScene scene = soft_scene(20);
  scene.indenter = Indenter::sphere;
  scene.friction_coefficient = 0.2;
  const RollingSolution s = converged(scene);
  CHECK(s.softening < 0.95);
  CHECK(solutions_of(s) <= 12);
  const LinearTwin twin = linear_twin(scene, s);
  check_moduli(scene, twin, scene.speed / twin.inside.half_length);
  scene.load = 1e-6;
  scene.payne_exponent = 1;
  RollingScene linear = scene;
  linear.payne_drop = 0;
  linear.payne_loss_peak = 1;
  CHECK(converged(scene).rolling_resistance == Approx(converged(linear).rolling_resistance).epsilon(1e-3));
}

TEST_CASE("moduli of the strains go with a skew, of a cylinder and of a sphere", "[core][strain][skew]") {
  for (const Indenter body : {Indenter::cylinder, Indenter::sphere}) {
    RollingScene scene = soft_scene(body == Indenter::sphere ? 30 : 1e4);
    scene.indenter = body;
    scene.friction_coefficient = 0.3;
    scene.drive = Drive::free;
    const RollingSolution straight = converged(scene);
    scene.skew_angle = 0.03;
    const RollingSolution left = converged(scene);
    linear_twin(scene, left);
    CHECK(left.strain_amplitude > 1.001 * straight.strain_amplitude);
    CHECK(left.strain_amplitude < 1.2 * straight.strain_amplitude);
    scene.skew_angle = -0.03;
    CHECK(converged(scene).strain_amplitude == Approx(left.strain_amplitude).epsilon(1e-9));
  }
}

TEST_CASE("softening with the load bends the power law of the resistance", "[core][strain]") {
  const auto exponent = [](RollingScene scene) {
    scene.load = 5e3;
    const double low = converged(scene).rolling_resistance;
    scene.load = 1e4;
    return std::log2(converged(scene).rolling_resistance / low);
  };
  RollingScene linear = soft_scene();
  linear.payne_drop = 0;
  linear.payne_loss_peak = 1;
  CHECK(exponent(soft_scene()) > exponent(linear) + 0.01);
}

TEST_CASE("each layer has the moduli of its own strains, and other methods meet them", "[core][strain]") {
  RollingScene scene = soft_scene();
  scene.friction_coefficient = 0;
  BondedLayer below;
  static_cast<MaterialInputs&>(below) = scene;
  below.static_shear_modulus = 6e6;
  below.payne_strain = 0.05;
  below.layer_thickness = 0.01;
  scene.lower_layers = {below};
  const RollingSolution s = converged(scene);
  REQUIRE(s.moduli_factors.size() == 2);
  CHECK(s.moduli_factors[0] != s.moduli_factors[1]);
  CHECK(solutions_of(s) <= 12);
  scene.method = Method::newton;
  const RollingSolution grid = converged(scene);
  CHECK(grid.rolling_resistance == Approx(s.rolling_resistance).epsilon(0.01));
  CHECK(grid.softening == Approx(s.softening).epsilon(2e-3));
}

TEST_CASE("where solutions are dear, the strains are found on the usual grid first, and are those of the answer",
          "[core][strain]") {
  for (const double load : {1e4, 1e-6}) {  // at the latter nothing softens, and the first answer is the last
    RollingScene scene = soft_scene(load);
    scene.method = Method::newton;
    scene.tolerance = 1e-3;
    scene.payne_exponent = 2;
    const RollingSolution s = converged(scene);
    CHECK((s.model.find(" on the usual grid") != std::string::npos) == (load == 1e4));
    CHECK(solutions_of(s) <= 4);
    const LinearTwin twin = linear_twin(scene, s);
    check_moduli(scene, twin, scene.speed / twin.inside.half_length);
  }
}

TEST_CASE("layers that lose nothing settle at their strains", "[core][strain][long]") {
  RollingScene elastic = soft_scene();
  elastic.material = MaterialModel::elastic;
  elastic.stiffening = 0;
  elastic.payne_loss_peak = 1;
  for (const double strain : {0.001, 0.01, 0.1})
    for (const double load : {1e3, 1e5}) {
      elastic.payne_strain = strain;
      elastic.load = load;
      INFO("payne_strain " << strain << ", load " << load);
      CHECK(solutions_of(converged(elastic)) <= 8);
    }
}

TEST_CASE("on a grid the strains settle where its nodes in contact jump", "[core][strain]") {
  RollingScene scene = paper_cylinder();  // its contact of 1 kN/m is a dozen nodes long
  scene.payne_drop = 0.5;
  for (const double strain : {0.009, 0.01, 0.011})
    for (const double load : {900.0, 1000.0, 1100.0}) {
      scene.payne_strain = strain;
      scene.load = load;
      INFO("payne_strain " << strain << ", load " << load);
      const RollingSolution s = converged(scene);
      CHECK(solutions_of(s) <= 12);
      CHECK(s.softening < 0.7);
    }
}

TEST_CASE("a drop that no linear material follows is refused with its numbers", "[core][strain]") {
  RollingScene scene = soft_scene(1e5);
  scene.stiffening = 20;
  scene.payne_drop = 0.9;
  scene.payne_loss_peak = 3;
  const RollingSolution s = solve(scene);
  CHECK(s.status == Status::not_converged);
  CHECK(s.reason.find("no positive modulus at rest") != std::string::npos);
}

TEST_CASE("inputs of softening that do not fit each other are refused by name", "[core][strain]") {
  const auto refusal = [](auto change) {
    RollingScene scene = soft_scene();
    change(scene);
    return message_of([&] { solve(scene); });
  };
  CHECK(refusal([](RollingScene& s) { s.payne_strain.reset(); }) == "payne_strain is missing: payne_drop needs it");
  CHECK(refusal([](RollingScene& s) { s.period = 1; }) == "payne_drop = 0.5: not with a period");
  CHECK(refusal([](RollingScene& s) {
          s.sweep_strains = {0.1, 0.2};
        }).find("give Kraus's model or a strain sweep, not both") != std::string::npos);
  CHECK(refusal([](RollingScene& s) { s.payne_drop = 1; }).find("payne_drop = 1: must be") == 0);
}
