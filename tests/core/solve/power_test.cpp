/// Where the power goes: two balances that do not share their parts.

#include <cmath>
#include <complex>
#include <vector>

#include "core/material/material.hpp"
#include "core/solve/rolling_contact.hpp"
#include "core/surface/layer_compliance.hpp"
#include "tests/catch.hpp"
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

}  // namespace

TEST_CASE("the power that drives a body is lost in the layer and by friction, to the order of the differences used",
          "[core][power]") {
  // dw/dx by differences of fourth order inside the contact.
  const auto residual = [](RollingScene scene, int refinement) {
    *scene.spacing /= refinement;
    const RollingSolution s = solve(scene);
    REQUIRE(s.status == Status::converged);
    return s.energy_residual;
  };
  for (const bool rough : {true, false}) {
    const RollingScene cylinder = rough ? paper_cylinder() : frictionless(paper_cylinder());
    CHECK(residual(cylinder, 1) < 1e-6);
    CHECK(residual(cylinder, 2) < residual(cylinder, 1) / 10);
    CHECK(residual(cylinder, 4) < residual(cylinder, 2) / 10);
    const RollingScene sphere = rough ? paper_sphere() : frictionless(paper_sphere());
    CHECK(residual(sphere, 1) < 1e-6);
    CHECK(residual(sphere, 2) < residual(sphere, 1) / 10);
  }
}

TEST_CASE("losses of drive, layer and friction add up for every drive", "[core][power]") {
  for (RollingScene scene : {paper_cylinder(), paper_sphere()}) {
    const auto check_balance = [&] {
      const RollingSolution s = solve(scene);
      REQUIRE(s.status == Status::converged);
      INFO(name_of(scene.indenter) << ", " << name_of(scene.drive));
      CHECK(s.energy_residual < 1e-6);
      CHECK(s.frictional_loss >= 0);
      CHECK(s.viscous_loss + s.frictional_loss == Approx(s.rolling_resistance * scene.speed).epsilon(1e-6));
    };
    check_balance();
    scene.drive = Drive::free;
    check_balance();
    scene.drive = Drive::rotation;
    for (const double ratio : {0.0, 1.0, 1.1}) {
      scene.rotation_ratio = ratio;
      check_balance();
    }
  }
}

TEST_CASE("the layer's loss equals the loss of its waves, counted one by one", "[core][power]") {
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
