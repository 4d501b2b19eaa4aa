#include "core/surface/earlier_turns.hpp"

#include <cmath>

#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/converged.hpp"

// Covers closed_ring_slopes, too.

using namespace rollres;

namespace {

/// A polyurethane-like cover on a steel roller, which remembers for several turns.
RollingScene slow_cover(double friction) {
  RollingScene scene;
  scene.radius = 0.1;
  scene.material = MaterialModel::elastic;
  scene.layer_thickness = 0.2;
  scene.static_shear_modulus = 7e9;
  BondedLayer cover;
  cover.layer_thickness = 0.015;
  cover.material = MaterialModel::prony;
  cover.static_shear_modulus = 2e6;
  cover.relaxation_moduli = {1e6, 1.5e6, 1e6};
  cover.relaxation_times = {1e-3, 5e-2, 2};
  scene.coating_layers = {cover};
  scene.inertia = Inertia::off;
  scene.speed = 5;
  scene.load = 5e4;
  scene.friction_coefficient = friction;
  scene.drive = Drive::free;
  return scene;
}

}  // namespace

TEST_CASE("earlier turns of exponentials are their geometric series", "[core][surface]") {
  // Re int cos(k x)/(k^2 + s^2) dk = pi/(2s) e^{-s|x|}, and the derivative of it.
  constexpr double radius = 0.25, turn = 2 * M_PI * radius;
  for (const double s : {0.01, 1.0, 10.0}) {
    const EarlierTurns turns(radius, 1 / s, 2, 2, [&](double k, std::span<std::complex<double>> values) {
      const double even = 1 / (k * k + s * s);
      values[0] = values[3] = even;
      values[1] = values[2] = std::complex<double>(0, k) * even;
    });
    for (const double x : {-0.7, -0.1, 0.0, 0.3, 0.75}) {
      const double behind = std::exp(-s * (turn + x)), ahead = std::exp(-s * (turn - x)), all = 1 - std::exp(-s * turn);
      const double even = M_PI / (2 * s) * (ahead + behind) / all, odd = M_PI / 2 * (ahead - behind) / all;
      CAPTURE(s, x);
      CHECK(turns(0, x)(0) == Approx(even).epsilon(1e-12).margin(1e-12));
      CHECK(turns(0, x)(1) == Approx(odd).epsilon(1e-12).margin(1e-12));
      CHECK(turns(1, x)(0) == turns(0, x)(1));
      CHECK(turns(1, x)(1) == turns(0, x)(0));
    }
  }
}

TEST_CASE("a cover that remembers its turns has continuous edges, and grids tend to its answer", "[core][surface]") {
  for (const double friction : {0.0, 0.3}) {
    CAPTURE(friction);
    RollingScene scene = slow_cover(friction);
    scene.method = Method::spectral;
    scene.tolerance = 1e-7;
    const RollingSolution exact = converged(scene);
    scene.method = Method::newton;
    scene.tolerance = 1e-5;
    const RollingSolution grid = converged(scene);
    CHECK(std::abs(grid.rolling_resistance - exact.rolling_resistance) <
          2 * (grid.rolling_resistance_error + exact.rolling_resistance_error));
    CHECK(exact.approach == Approx(grid.approach).epsilon(1e-4));
    CHECK(exact.leading_edge == Approx(grid.leading_edge).epsilon(1e-3));
    CHECK(exact.energy_residual < 1e-6);
    // Beside a tolerance of a half the turns do not count, and R_r is another.
    scene = slow_cover(friction);
    scene.method = Method::spectral;
    scene.tolerance = 0.5;
    CHECK(std::abs(solve(scene).rolling_resistance / exact.rolling_resistance - 1) > 1e-5);
  }
}

TEST_CASE("a ring that has not recovered is one of bodies a turn apart", "[core][surface]") {
  const auto [poisson_ratio, longest] = GENERATE(std::pair(0.5, 2.0), std::pair(0.35, 2.0), std::pair(0.35, 1e11));
  CAPTURE(poisson_ratio, longest);
  RollingScene scene = slow_cover(0.2);
  scene.coating_layers[0].poisson_ratio = poisson_ratio;
  scene.coating_layers[0].relaxation_times.back() = longest;  // in the mean over all turns at rest, however long
  if (longest > 1e3) {                                        // and no other remembers a turn
    scene.coating_layers[0].relaxation_times.erase(scene.coating_layers[0].relaxation_times.begin() + 1);
    scene.coating_layers[0].relaxation_moduli.erase(scene.coating_layers[0].relaxation_moduli.begin() + 1);
  }
  scene.drive = Drive::rotation;
  scene.rotation_ratio = 1.002;
  scene.method = Method::newton;
  scene.spacing = 1e-4;
  const RollingSolution closed = converged(scene);
  scene.period = 2 * M_PI * scene.radius;
  scene.series_terms = 100000;
  const RollingSolution repeated = converged(scene);
  // The series ends with waves of a 16th of a cell.
  CHECK(closed.rolling_resistance == Approx(repeated.rolling_resistance).epsilon(2e-4));
  CHECK(closed.driving_torque == Approx(repeated.driving_torque).epsilon(1e-3));
  CHECK(closed.approach == Approx(repeated.approach).epsilon(2e-4));
}
