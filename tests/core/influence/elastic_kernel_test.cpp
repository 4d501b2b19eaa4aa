#include "core/influence/elastic_kernel.hpp"

#include <cmath>

#include "core/numerics/quadrature.hpp"
#include "tests/catch.hpp"
#include "tests/infinite.hpp"

using namespace rollres;
using namespace rollres::coefficient;

namespace {

/// Boussinesq (normal) and Cerruti (tangential) for a point force on an incompressible half-space of unit modulus.
Coefficients point_force(double x, double y) {
  const double r = std::hypot(x, y), f = 1 / (4 * M_PI * r);
  Coefficients c;
  c << f, f * (1 + x * x / (r * r)), f * (1 + y * y / (r * r)), f * x * y / (r * r), 0, 0;
  return c;
}

/// Average of the point force over a cell that does not contain the point.
Coefficients averaged(double x, double y, double cell_x, double cell_y) {
  const QuadratureRule gauss = gauss_legendre(40);
  Coefficients sum = Coefficients::Zero();
  for (std::size_t j = 0; j < gauss.nodes.size(); ++j)
    for (std::size_t i = 0; i < gauss.nodes.size(); ++i)
      sum += gauss.weights[i] * gauss.weights[j] *
             point_force(x - (gauss.nodes[i] - 0.5) * cell_x, y - (gauss.nodes[j] - 0.5) * cell_y);
  return sum;
}

}  // namespace

TEST_CASE("a uniformly loaded cell moves the half-space as Boussinesq and Cerruti say", "[core][elastic_kernel]") {
  const double ax = 0.3, ay = 0.2;
  const ElasticKernel kernel(3, infinite, ax, ay);
  for (const auto& [x, y] : {std::pair{0.3, 0.0}, {0.0, -0.25}, {-0.4, 0.3}, {0.6, 0.5}, {2.0, -1.0}, {0.0, 7.0}}) {
    // Gauss's rule of 40 nodes is exact to rounding half a cell away from the loaded cell's edge.
    CHECK((kernel(x, y) - averaged(x, y, ax, ay)).abs().maxCoeff() < 1e-12 * kernel(x, y).abs().maxCoeff());
  }
  // In the middle of the cell in polar coordinates: int f(angle)/r dA = int f(angle) r_edge(angle) d(angle).
  const QuadratureRule gauss = gauss_legendre(60);
  const double corner = std::atan2(ay, ax);
  Coefficients middle = Coefficients::Zero();
  for (const auto& [from, to] : {std::pair{0.0, corner}, {corner, 0.5 * M_PI}})
    for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
      const double angle = from + (to - from) * gauss.nodes[q], c = std::cos(angle), s = std::sin(angle);
      const double edge = std::min(0.5 * ax / c, 0.5 * ay / s);
      middle(ww) += 4 * (to - from) * gauss.weights[q] * edge;
      middle(uu) += 4 * (to - from) * gauss.weights[q] * edge * (1 + c * c);
      middle(vv) += 4 * (to - from) * gauss.weights[q] * edge * (1 + s * s);
    }
  middle /= 4 * M_PI * ax * ay;
  CHECK((kernel(0, 0) - middle).abs().maxCoeff() < 1e-13 * middle(vv));
}

TEST_CASE("a compressible half-space moves as Boussinesq and Cerruti say", "[core][elastic_kernel]") {
  const double ax = 0.3, ay = 0.2, nu = 0.3;
  const ElasticKernel sphere(3, Layer{infinite, nu}, ax, ay);
  const QuadratureRule gauss = gauss_legendre(40);
  for (const auto& [x, y] : {std::pair{0.3, 0.0}, {0.0, -0.25}, {-0.4, 0.3}, {0.6, 0.5}, {2.0, -1.0}, {0.0, 7.0}}) {
    Coefficients sum = Coefficients::Zero();
    for (std::size_t j = 0; j < gauss.nodes.size(); ++j)
      for (std::size_t i = 0; i < gauss.nodes.size(); ++i) {
        const double dx = x - (gauss.nodes[i] - 0.5) * ax, dy = y - (gauss.nodes[j] - 0.5) * ay;
        const double square = dx * dx + dy * dy, r = std::sqrt(square), r3 = r * square;
        Coefficients point;  // of unit shear modulus (Johnson 1985, eqs. 3.18, 3.75)
        point << (1 - nu) / r, (1 - nu) / r + nu * dx * dx / r3, (1 - nu) / r + nu * dy * dy / r3, nu * dx * dy / r3,
            0.5 * (1 - 2 * nu) * dx / square, 0.5 * (1 - 2 * nu) * dy / square;
        sum += gauss.weights[i] * gauss.weights[j] / (2 * M_PI) * point;
      }
    CHECK((sphere(x, y) - sum).abs().maxCoeff() < 1e-12 * sum.abs().maxCoeff());
  }
  // A line load lifts the surface on either side away from itself: u = (1 - 2 nu)/4 sgn(x).
  const ElasticKernel cylinder(2, Layer{infinite, nu}, ax, 1);
  CHECK(cylinder(2, 0)(uw) == Approx(0.25 * (1 - 2 * nu)).epsilon(1e-14));
  CHECK(cylinder(-2, 0)(uw) == Approx(-0.25 * (1 - 2 * nu)).epsilon(1e-14));
  CHECK(cylinder(0, 0)(uw) == 0);
}

TEST_CASE("the layer's influence functions have the moments of its long waves", "[core][elastic_kernel]") {
  // The average over a cell has no alias at zero wavenumber, so sums over the nodes are the integrals. At small k
  // c_ww = 0, c_ll = H and u from a normal force = i k H^2/2.
  const double H = 0.8, a = 0.3;
  const ElasticKernel kernel(2, H, a, 1);
  double normal = 0, longitudinal = 0, first_cross = 0;
  for (int i = -80; i <= 80; ++i) {
    const double x = i * a;
    const Coefficients c = kernel(x, 0);
    normal += a * c(ww);
    longitudinal += a * c(uu);
    first_cross += a * x * c(uw);
  }
  // The kernels are good to 1e-9 of their largest value and end at 30 H.
  CHECK(std::abs(normal) < 1e-8 * H);
  CHECK(longitudinal == Approx(H).epsilon(1e-8));
  CHECK(first_cross == Approx(-0.5 * H * H).epsilon(1e-7));
}

TEST_CASE("rows of cells under a sphere add up to the cells under a cylinder", "[core][elastic_kernel]") {
  for (const double a : {0.25, 1.0}) {
    const double H = 1, ay = 0.7;
    const ElasticKernel sphere(3, H, a, ay), cylinder(2, H, a, 1);
    for (const double x : {0.0, 0.5 * a, a, -1.7, 4.0}) {
      Coefficients sum = Coefficients::Zero();
      for (int j = -43; j <= 43; ++j) sum += ay * sphere(x, j * ay);
      const Coefficients line = cylinder(x, 0);
      INFO("cell " << a << " x " << x);
      // 1e-9 per row from the tables of the layer's correction
      CHECK(std::abs(sum(ww) - line(ww)) < 2e-8);
      CHECK(std::abs(sum(uu) - line(uu)) < 2e-8);
      CHECK(std::abs(sum(uw) - line(uw)) < 2e-8);
      CHECK(std::abs(sum(uv)) < 1e-12);
      CHECK(std::abs(sum(vw)) < 1e-12);
    }
  }
}

TEST_CASE("elastic influence functions have the parity of their direction", "[core][elastic_kernel]") {
  for (const double thickness : {1.0, infinite}) {
    const ElasticKernel kernel(3, thickness, 0.3, 0.2);
    const Coefficients c = kernel(0.7, 0.4);
    CHECK((kernel(-0.7, 0.4) - mirror_x * c).abs().maxCoeff() < 1e-14);
    CHECK((kernel(0.7, -0.4) - mirror_y * c).abs().maxCoeff() < 1e-14);
    const ElasticKernel turned(3, thickness, 0.2, 0.3);  // x and y exchanged
    const Coefficients t = turned(0.4, 0.7);
    CHECK(t(vv) == Approx(c(uu)).epsilon(1e-12));
    CHECK(t(uv) == Approx(c(uv)).epsilon(1e-12));
    CHECK(t(vw) == Approx(c(uw)).epsilon(1e-12));
  }
}

TEST_CASE("a very thick layer moves like a half-space up to a rigid shift", "[core][elastic_kernel]") {
  const double H = 1e4;
  const ElasticKernel layer(2, H, 0.1, 1), half_space(2, infinite, 0.1, 1);
  for (const double x : {0.05, 0.3, 1.0, 10.0}) {
    const Coefficients shift = layer(x, 0) - half_space(x, 0) - (layer(0, 0) - half_space(0, 0));
    CHECK(shift.abs().maxCoeff() < 1e-3 * x / 10);  // the layer's correction bends over lengths of order H
  }
  const ElasticKernel thick(3, H, 0.1, 0.1), deep(3, infinite, 0.1, 0.1);
  for (const double x : {0.0, 0.3, 10.0}) CHECK((thick(x, 0.2) - deep(x, 0.2)).abs().maxCoeff() < 1 / H);
}

TEST_CASE("far from a short cell a line force moves a half-space like the logarithm of the distance",
          "[core][elastic_kernel]") {
  const ElasticKernel kernel(2, Layer(infinite, 0.3), 1e-6, 0);
  for (const double x : {1e-4, 1.0, 1e6, 1e12}) {
    CHECK(kernel(x, 0)(ww) == Approx(-0.7 / M_PI * std::log(x)).epsilon(1e-13).margin(0.02 * 1e-12 / (x * x)));
    CHECK(kernel(-x, 0)(uw) == -kernel(x, 0)(uw));
    CHECK(kernel(x, 0)(uw) == Approx(0.1).epsilon(1e-14));
  }
}

TEST_CASE("under a line load a cell twice as long is the mean of two, however short both are against the layer",
          "[core][elastic_kernel]") {
  // Cells of 0.006 H take the correction's slope, those of 0.012 H its antiderivative.
  const double cell = 6e-3;
  for (const double poisson_ratio : {0.5, 0.3}) {
    const Layer layer{1, poisson_ratio};
    const ElasticKernel fine(2, layer, cell, 1), coarse(2, layer, 2 * cell, 1);
    for (const double x : {0.0, 1e-3, -0.2, 1.3, -4.0, 12.0}) {
      const Coefficients mean = 0.5 * (fine(x - 0.5 * cell, 0) + fine(x + 0.5 * cell, 0));
      INFO("Poisson's ratio " << poisson_ratio << ", x = " << x);
      // Tables have the antiderivatives to 5e-13, which two of them over 0.012 make 1e-10.
      CHECK((mean - coarse(x, 0)).abs().maxCoeff() < 2e-10);
    }
  }
}

TEST_CASE("a layer of a thousand million cells moves under a line load as a half-space, but for a constant",
          "[core][elastic_kernel]") {
  const double cell = 1e-5;
  for (const double poisson_ratio : {0.5, 0.3}) {
    const ElasticKernel deep(2, Layer{1e9 * cell, poisson_ratio}, cell, 1),
        half_space(2, Layer{infinite, poisson_ratio}, cell, 1);
    const Coefficients deep_middle = deep(0, 0), middle = half_space(0, 0);
    for (const double x : {1e-5, 4e-5, -1e-3, 0.1}) {
      const Coefficients difference = (deep(x, 0) - deep_middle) - (half_space(x, 0) - middle);
      INFO("Poisson's ratio " << poisson_ratio << ", x = " << x);
      // The layer's part is a square of x/H, of the cross term as much as x/H.
      const double share = std::abs(x) / (1e9 * cell), rounding = 1e-13;
      CHECK(std::abs(difference(ww)) < share * share + rounding);
      CHECK(std::abs(difference(uu)) < share * share + rounding);
      CHECK(std::abs(difference(uw)) < share + rounding);
    }
  }
}
