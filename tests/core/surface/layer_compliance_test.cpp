#include "core/surface/layer_compliance.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// Stream function psi of the layer, its derivatives over z to the third, at the surface z = 0, by fourth-order
/// Runge-Kutta from the bonded base z = -H, where psi = psi' = 0.
std::array<double, 4> from_base(double k, double thickness, double second, double third) {
  std::array<double, 4> state{0, 0, second, third};
  // (D^2 - k^2)^2 psi = 0
  const auto rate = [&](const std::array<double, 4>& s) {
    return std::array<double, 4>{s[1], s[2], s[3], 2 * k * k * s[2] - k * k * k * k * s[0]};
  };
  constexpr int steps = 4000;
  const double h = thickness / steps;
  for (int step = 0; step < steps; ++step) {
    const auto moved = [&](const std::array<double, 4>& slope, double by) {
      std::array<double, 4> there = state;
      for (std::size_t i = 0; i < 4; ++i) there[i] += by * slope[i];
      return there;
    };
    const auto k1 = rate(state), k2 = rate(moved(k1, h / 2)), k3 = rate(moved(k2, h / 2)), k4 = rate(moved(k3, h));
    for (std::size_t i = 0; i < 4; ++i) state[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  return state;
}

/// The same with psi scaled such that the shear psi'' + k^2 psi and the pressure's (psi''' - 3 k^2 psi')/k take the
/// given values at the surface (unit shear modulus, no inertia).
std::array<double, 4> layer_under(double k, double thickness, double shear, double normal) {
  const auto a = from_base(k, thickness, 1, 0), b = from_base(k, thickness, 0, 1);
  const auto shear_of = [&](const auto& s) { return s[2] + k * k * s[0]; };
  const auto normal_of = [&](const auto& s) { return (s[3] - 3 * k * k * s[1]) / k; };
  const double determinant = shear_of(a) * normal_of(b) - shear_of(b) * normal_of(a);
  const double of_a = (shear * normal_of(b) - shear_of(b) * normal) / determinant;
  const double of_b = (shear_of(a) * normal - shear * normal_of(a)) / determinant;
  std::array<double, 4> state{};
  for (std::size_t i = 0; i < 4; ++i) state[i] = of_a * a[i] + of_b * b[i];
  return state;
}

/// Displacements of the surface of a compressible layer under given tractions, by Runge-Kutta from the bonded base:
/// with u = i U e^{ikx}, w = W e^{ikx} and g = 1/(1 - 2 nu), U'' = k^2 (1 + g) U - g k W' and (1 + g) W'' = k^2 W + g k
/// U'; tau = i (U' + k W), sigma = 2 nu g (W' - k U) + 2 W'.
struct Surface {
  double u, w;
};
Surface compressible(double k, double thickness, double nu, double tau_over_i, double sigma) {
  const double g = 1 / (1 - 2 * nu);
  using State = std::array<double, 4>;  // U, U', W, W'
  const auto rate = [&](const State& s) {
    return State{s[1], k * k * (1 + g) * s[0] - g * k * s[3], s[3], (k * k * s[2] + g * k * s[1]) / (1 + g)};
  };
  const auto grown = [&](State state) {
    constexpr int steps = 4000;
    const double h = thickness / steps;
    for (int step = 0; step < steps; ++step) {
      const auto moved = [&](const State& slope, double by) {
        State there = state;
        for (std::size_t i = 0; i < 4; ++i) there[i] += by * slope[i];
        return there;
      };
      const State k1 = rate(state), k2 = rate(moved(k1, h / 2)), k3 = rate(moved(k2, h / 2)), k4 = rate(moved(k3, h));
      for (std::size_t i = 0; i < 4; ++i) state[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
    return state;
  };
  const State a = grown({0, 1, 0, 0}), b = grown({0, 0, 0, 1});
  const auto shear = [&](const State& s) { return s[1] + k * s[2]; };
  const auto normal = [&](const State& s) { return 2 * nu * g * (s[3] - k * s[0]) + 2 * s[3]; };
  const double determinant = shear(a) * normal(b) - shear(b) * normal(a);
  const double of_a = (tau_over_i * normal(b) - shear(b) * sigma) / determinant;
  const double of_b = (shear(a) * sigma - tau_over_i * normal(a)) / determinant;
  return {of_a * a[0] + of_b * b[0], of_a * a[2] + of_b * b[2]};
}

}  // namespace

TEST_CASE("the symbols of a compressible layer solve Navier's equations", "[core][layer_compliance]") {
  const double thickness = 0.7;
  for (const double nu : {0.0, 0.3, 0.45})
    for (const double h : {0.02, 0.049, 0.051, 0.3, 1.0, 2.5, 5.0}) {
      const double k = h / thickness;
      const LayerSymbols c = layer_symbols(k, {thickness, nu});
      // sigma = 1: w = c_ww, u = i U = i c_x; tau = i: u = i c_ll, w = -i c_x i
      const Surface pressed = compressible(k, thickness, nu, 0, 1), sheared = compressible(k, thickness, nu, 1, 0);
      INFO("nu = " << nu << ", kH = " << h);
      const double tolerance = 1e-9;  // Runge-Kutta's; of the largest where a symbol passes through zero
      CHECK(pressed.w == Approx(c.normal).epsilon(tolerance));
      CHECK(pressed.u == Approx(c.cross).epsilon(tolerance).margin(tolerance * c.normal));
      CHECK(sheared.u == Approx(c.longitudinal).epsilon(tolerance));
      CHECK(sheared.w == Approx(c.cross).epsilon(tolerance).margin(tolerance * c.normal));
    }
}

TEST_CASE("a thin compressible layer is a foundation, a thick one a half-space, and nu = 1/2 no special case",
          "[core][layer_compliance]") {
  for (const double nu : {0.0, 0.3, 0.49}) {
    INFO("nu = " << nu);
    CHECK(layer_symbols(0, {2, nu}).normal == Approx(2 * (1 - 2 * nu) / (2 * (1 - nu))).epsilon(1e-14));
    CHECK(layer_symbols(0, {2, nu}).longitudinal == Approx(2).epsilon(1e-14));
    const LayerSymbols deep = half_space_symbols(nu), thick = layer_symbols(3, {20, nu});
    CHECK(thick.normal == Approx(deep.normal / 3).epsilon(1e-12));
    CHECK(thick.cross == Approx(deep.cross / 3).epsilon(1e-12));
    for (const double h : {0.3, 2.0}) {
      const LayerSymbols correction = layer_correction(h, nu), whole = layer_symbols(h, {1, nu});
      CHECK(correction.normal + deep.normal / h == Approx(whole.normal).epsilon(1e-12));
      CHECK(correction.cross + deep.cross / h == Approx(whole.cross).epsilon(1e-12));
    }
  }
  for (const double h : {0.01, 0.3, 2.0, 8.0}) {
    const LayerSymbols limit = layer_symbols(h, 1), near = layer_symbols(h, {1, 0.5 - 1e-10});
    CHECK(near.normal == Approx(limit.normal).epsilon(1e-8).margin(2e-10));
    CHECK(near.cross == Approx(limit.cross).epsilon(1e-8).margin(2e-10));
  }
}

TEST_CASE("the layer's symbols solve the equations of the incompressible layer", "[core][layer_compliance]") {
  const double thickness = 0.7;
  for (const double h : {0.02, 0.049, 0.051, 0.3, 1.0, 2.5, 5.0}) {
    const double k = h / thickness;
    const LayerSymbols c = layer_symbols(k, thickness);
    // sigma = 1: with psi = i phi, w = k phi = c_ww and u = i phi' = i c_x; phi''' - 3 k^2 phi' = -k
    const auto pressed = layer_under(k, thickness, 0, -1);
    // tau = 1: u = psi' = c_ll and w = -i k psi = -i c_x
    const auto sheared = layer_under(k, thickness, 1, 0);
    // Runge-Kutta errs by (h/4000)^4, the 2x2 system for small h by 1e-16/h^2.
    const double tolerance = 1e-10;
    INFO("kH = " << h);
    CHECK(k * pressed[0] == Approx(c.normal).epsilon(tolerance));
    CHECK(pressed[1] == Approx(c.cross).epsilon(tolerance));
    CHECK(sheared[1] == Approx(c.longitudinal).epsilon(tolerance));
    CHECK(k * sheared[0] == Approx(c.cross).epsilon(tolerance));
    // anti-plane: v'' = k^2 v, v' = 1
    CHECK(c.transverse == Approx(std::tanh(h) / k).epsilon(1e-14));
  }
}

TEST_CASE("a layer of long wavelength is a lubrication film, one of short wavelength a half-space",
          "[core][layer_compliance]") {
  // Thin film: c_ww = k^2 H^3/3, c_ll = c_tt = H, c_x = k H^2/2, each to relative order h^2.
  const double h = 1e-4;
  const LayerSymbols film = layer_symbols(h, 1);
  CHECK(film.normal == Approx(h * h / 3).epsilon(h));
  CHECK(film.longitudinal == Approx(1).epsilon(h));
  CHECK(film.cross == Approx(h / 2).epsilon(h));
  CHECK(film.transverse == Approx(1).epsilon(h));
  const LayerSymbols at_rest = layer_symbols(0, 2);
  CHECK(at_rest.normal == 0);
  CHECK(at_rest.longitudinal == 2);
  CHECK(at_rest.cross == 0);
  CHECK(at_rest.transverse == 2);

  const LayerSymbols half_space = layer_symbols(3, std::numeric_limits<double>::infinity());
  CHECK(half_space.normal == Approx(1. / 6).epsilon(1e-15));
  CHECK(half_space.longitudinal == Approx(1. / 6).epsilon(1e-15));
  CHECK(half_space.cross == 0);
  CHECK(half_space.transverse == Approx(1. / 3).epsilon(1e-15));
  for (const double thick : {20.0, 1e3, 1e6}) {  // e^{-2h} is below 1e-50 and may underflow, not overflow
    const LayerSymbols deep = layer_symbols(3, thick);
    CHECK(deep.normal == Approx(half_space.normal).epsilon(1e-14));
    CHECK(deep.longitudinal == Approx(half_space.longitudinal).epsilon(1e-14));
    CHECK(deep.transverse == Approx(half_space.transverse).epsilon(1e-14));
    CHECK(std::abs(deep.cross) < 1e-40);
  }
}

TEST_CASE("the correction to the half-space is what the layer's symbols leave of it", "[core][layer_compliance]") {
  for (const double h : {0.01, 0.1, 1.0, 4.0, 9.0}) {
    const LayerSymbols correction = layer_correction(h), c = layer_symbols(h, 1);
    // Adding back 1/(2h) loses digits where it is large beside the symbol.
    const double tolerance = 1e-15 / h;
    CHECK(std::abs(correction.normal + 0.5 / h - c.normal) < tolerance);
    CHECK(std::abs(correction.longitudinal + 0.5 / h - c.longitudinal) < tolerance);
    CHECK(std::abs(correction.cross - c.cross) < tolerance);
    CHECK(std::abs(correction.transverse + 1 / h - c.transverse) < tolerance);
  }
}

TEST_CASE("the layer's compliance is that of a passive body", "[core][layer_compliance]") {
  // The 2x2 matrix (normal, cross; cross, longitudinal) must be positive definite: work done is positive.
  for (double h = 1e-3; h < 30; h *= 1.3) {
    const LayerSymbols c = layer_symbols(h, 1);
    CHECK(c.normal > 0);
    CHECK(c.transverse > 0);
    CHECK(c.normal * c.longitudinal > c.cross * c.cross);
  }
}
