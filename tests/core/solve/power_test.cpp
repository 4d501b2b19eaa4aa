// Covers contact_powers, model_notes too.
/// Where the power goes: two balances that do not share their parts.

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "core/material/material.hpp"
#include "core/model/indenter_shape.hpp"
#include "core/solve/rolling_contact.hpp"
#include "core/surface/layer_compliance.hpp"
#include "tests/catch.hpp"
#include "tests/core/converged.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

/// Power lost in the layer under a cylinder [W/m] by Parseval: with tractions sigma, tau constant on each cell and
/// their Fourier transforms over a line of length L,
///   -V int (sigma dw/dx + tau du/dx) dx = V/(2 pi) int k Im J*(-kV) q(k) dk,
///   q = c_ww |sigma|^2 + c_ll |tau|^2 + 2 c_x Im(conj(sigma) tau).
double spectral_loss(const RollingScene& scene, const RollingSolution& s, double length, int cycles_per_cell) {
  const CreepSpectrum creep = creep_spectrum(scene);
  const SurfaceGrid& grid = s.fields.grid;
  const double cell = grid.spacing_x, step = 2 * M_PI / length;
  const int count = static_cast<int>(cycles_per_cell * length / cell);
  std::vector<int> nodes;
  for (int i = 0; i < grid.size(); ++i)
    if (s.fields.zone[static_cast<std::size_t>(i)] != Zone::free) nodes.push_back(i);
  double sum = 0;
  for (int n = 1; n <= count; ++n) {  // k and -k give the same
    const double k = n * step;
    const std::complex<double> turn = std::polar(1.0, -k * cell);
    std::complex<double> phase = 1, sigma = 0, tau = 0;
    for (int i = nodes.front(); i <= nodes.back(); ++i, phase *= turn) {
      sigma -= s.fields.pressure[static_cast<std::size_t>(i)] * phase;
      tau += s.fields.shear_x[static_cast<std::size_t>(i)] * phase;
    }
    const double factor = cell * std::sin(0.5 * k * cell) / (0.5 * k * cell);
    const LayerSymbols c = layer_symbols(k, scene.layer_thickness);
    const double q =
        c.normal * std::norm(sigma) + c.longitudinal * std::norm(tau) + 2 * c.cross * std::imag(std::conj(sigma) * tau);
    sum += 2 * step * k * std::imag(creep(-k * scene.speed)) * factor * factor * q;
  }
  return scene.speed / (2 * M_PI) * sum;
}

/// A shallow contact, a/R = 0.002: the equilibrium's terms of second order in the slope are left out of the waves.
RollingScene shallow_scene() {
  RollingScene scene = with_method(paper_cylinder(), Method::newton_dense);
  scene.radius = 2;
  scene.load = 200;
  return scene;
}

RollingScene with_consistent_kinematics(RollingScene scene) {
  scene.kinematics = Kinematics::consistent;
  return scene;
}

}  // namespace

// The drive gives what the resultants say; the layers and friction take what displacements and slip say. Wrong lever
// arms, a wrong slip or wrong displacements would part them: with the paper's kinematics they part by up to a third.
TEST_CASE("the power that drives a cylinder is lost in the layer and by friction, whatever drives it",
          "[core][power]") {
  RollingScene scene = with_consistent_kinematics(paper_cylinder());
  scene.spacing.reset();
  for (const MaterialModel material : {MaterialModel::zener, MaterialModel::elastic}) {
    scene.material = material;
    const auto check_balance = [&](const RollingScene& driven) {
      const RollingSolution s = converged(driven);
      CAPTURE(name_of(material), name_of(driven.drive), driven.driving_torque.value_or(0),
              driven.rotation_ratio.value_or(0));
      REQUIRE(s.method == Method::spectral);
      const double power = s.load * 0.2 * driven.speed;  // of P a/R
      CHECK(s.viscous_loss + s.frictional_loss == Approx(s.rolling_resistance * driven.speed).margin(1e-7 * power));
      CHECK(s.frictional_loss > -1e-9 * power);
      if (material == MaterialModel::elastic) CHECK(std::abs(s.viscous_loss) < 1e-9 * power);
    };
    for (const Drive drive : {Drive::top_force, Drive::free}) {
      RollingScene driven = scene;
      driven.drive = drive;
      check_balance(driven);
    }
    for (const double torque : {-60.0, -20.0, 0.0, 20.0, 60.0}) {
      RollingScene driven = scene;
      driven.drive = Drive::torque;
      driven.driving_torque = torque;
      check_balance(driven);
    }
    for (const double ratio : {0.5, 1.0, 1.06}) {
      RollingScene driven = scene;
      driven.drive = Drive::rotation;
      driven.rotation_ratio = ratio;
      check_balance(driven);
    }
  }
}

TEST_CASE(
    "on a grid the power of a driven body is lost in the layer and by friction but for what the edges between nodes "
    "take",
    "[core][power][long]") {
  for (RollingScene scene : {with_consistent_kinematics(paper_cylinder()), with_consistent_kinematics(paper_sphere())})
    for (const MaterialModel material : {MaterialModel::zener, MaterialModel::elastic}) {
      scene.material = material;
      scene.drive = Drive::torque;
      scene.driving_torque = ContactModel(scene).dimension == 2 ? 60 : 0.2;
      const auto residual = [&](double spacing) {
        scene.spacing = spacing;
        const RollingSolution s = converged(scene);
        CAPTURE(name_of(material), name_of(scene.indenter));
        if (material == MaterialModel::elastic) CHECK(std::abs(s.viscous_loss) < 1e-9 * s.frictional_loss);
        return s.energy_residual;
      };
      CHECK(residual(0.25e-3) < 0.03);
      CHECK(residual(0.0625e-3) < 4e-3);
    }
}

TEST_CASE("the paper's kinematics leave a power of second order over, and say so", "[core][power]") {
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  scene.material = MaterialModel::elastic;
  scene.drive = Drive::torque;
  scene.driving_torque = 60;
  const RollingSolution s = converged(scene);
  CHECK(std::abs(s.viscous_loss) < 1e-6 * s.frictional_loss);
  CHECK(s.rolling_resistance * scene.speed > 1.3 * s.frictional_loss);
  CHECK(std::any_of(s.warnings.begin(), s.warnings.end(),
                    [](const std::string& warning) { return warning.find("kinematics") != std::string::npos; }));
}

TEST_CASE("the layer's loss equals the loss of its waves, counted one by one", "[core][power][long]") {
  // The waves average displacements over a cell, the balance samples them at nodes and takes slip by forward
  // differences: without shear they differ at second order, with it at first. V tau = 12.5 mm decays to e^{-24} over
  // the line of 0.3 m.
  const auto difference = [](const RollingScene& scene) {
    const RollingSolution s = solve(scene);
    REQUIRE(s.status == Status::converged);
    return std::abs(s.viscous_loss / spectral_loss(scene, s, 0.3, 6) - 1);
  };
  for (const double nodes : {38.0, 76.0, 152.0}) {  // in contact
    RollingScene scene = shallow_scene();
    scene.spacing = 0.2e-3 * 38 / nodes;
    INFO(nodes << " nodes");
    CHECK(difference(frictionless(scene)) < 4 / (nodes * nodes));
    CHECK(difference(scene) < 0.6 / nodes);
    scene.drive = Drive::torque;
    for (const double share : {-0.6, 0.6}) {
      scene.driving_torque = share * scene.friction_coefficient * *scene.load * scene.radius;
      CHECK(difference(scene) < 0.6 / nodes);
    }
  }
}

TEST_CASE("a tolerance counts what the power balance of a sphere misses", "[core][power]") {
  RollingScene scene;  // on 281 nodes the balance misses 1.3 %
  scene.indenter = Indenter::sphere;
  scene.radius = 0.11;
  scene.layer_thickness = 0.05;
  scene.poisson_ratio = 0.36;
  scene.static_shear_modulus = 1.1e6;
  scene.stiffening = 7.3;
  scene.creep_time = 1.5e-3;
  scene.speed = 1.1;
  scene.load = 3.5;
  scene.friction_coefficient = 7.6e-4;
  scene.drive = Drive::rotation;
  scene.rotation_ratio = 0;
  scene.tolerance = 8e-3;
  const RollingSolution s = converged(scene);
  CHECK(s.energy_residual < 0.01);
  CHECK(s.error_estimate <= *scene.tolerance);
}
