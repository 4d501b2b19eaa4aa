#include "tests/core/elastic_layer_contact.hpp"

#include <cmath>
#include <numbers>

#include "core/algebra/dense_algebra.hpp"
#include "core/numerics/quadrature.hpp"

namespace rollres::testing {

namespace {

/// Wavenumbers h with Simpson's weights times 1 - S(h), which is below 1e-18 beyond the last.
struct Correction {
  Eigen::ArrayXd h, density;

  explicit Correction(double alpha) {
    const int steps = alpha < 6 ? 4000 : 12000;  // h alpha u changes by 0.1 at most
    const double step = 25.0 / steps;
    h = Eigen::ArrayXd::LinSpaced(steps + 1, 0, 25);
    density.resize(steps + 1);
    for (int k = 0; k <= steps; ++k) {
      const double e = std::exp(-2 * h[k]);
      const double S = ((1 - e * e) / 2 - 2 * h[k] * e) / ((1 + e * e) / 2 + (1 + 2 * h[k] * h[k]) * e);
      density[k] = (1 - S) * step / 3 * (k == 0 || k == steps ? 1 : k % 2 == 1 ? 4 : 2);
    }
  }
};

}  // namespace

LayerContact layer_contact_line(double alpha, int n) {
  using std::numbers::pi;
  const Correction correction(alpha);
  const auto& [h, density] = correction;
  Eigen::MatrixXd system(n + 1, n);
  Eigen::VectorXd shape(n + 1), node(n), weight(n);
  for (int j = 0; j < n; ++j) {
    node[j] = std::cos(pi * (j + 1) / (n + 1));
    weight[j] = pi / (n + 1) * (1 - node[j] * node[j]);
  }
  for (int i = 0; i <= n; ++i) {
    shape[i] = std::cos(pi * (i + 0.5) / (n + 1));
    for (int j = 0; j < n; ++j) {
      const double u = shape[i] - node[j];
      system(i, j) = weight[j] / (2 * pi) * (1 / u - alpha * (density * (h * (alpha * u)).sin()).sum());
    }
  }
  // By symmetry one equation is spare: least squares of a consistent system.
  const Eigen::VectorXd phi = least_squares(system, shape);
  // Deflection at x = 0: kernel (1/2) [C - gamma - ln(alpha |t|) + int (1 - S)(1 - cos(h alpha t)) dh/h] / pi with
  // C = int_0^inf [S - h^2/(1 + h^2)] dh/h = int [1/(1 + h^2) - (1 - S)] dh/h. Midpoint rule in ln h.
  double C = 0;
  for (double s = -14 + 0.005; s < 14; s += 0.01) {
    const double at = std::exp(s), e = std::exp(-2 * at);
    const double S =
        at < 1e-3 ? 2 * at * at * at / 3 : ((1 - e * e) / 2 - 2 * at * e) / ((1 + e * e) / 2 + (1 + 2 * at * at) * e);
    C += 0.01 * (S - at * at / (1 + at * at));
  }
  double sum = 0;
  const auto tail = h.size() - 1;  // (1 - cos(h alpha t))/h is 0 at h = 0
  for (int j = 0; j < n; ++j) {
    const Eigen::ArrayXd wave = (h.tail(tail) * (alpha * node[j] / 2)).sin();
    const double smooth = (density.tail(tail) * 2 * wave.square() / h.tail(tail)).sum();
    sum += weight[j] * phi[j] * (C - std::numbers::egamma - std::log(alpha) + smooth);
  }
  // The logarithm acts on phi = sum b_m U_m: int sqrt(1 - t^2) U_m ln|t| dt = (pi/2) [T_{m+2}(0)/(m+2) - T_m(0)/m],
  // with ln 2 in place of T_0/0.
  for (int m = 0; m < n; m += 2) {
    double b = 0;
    for (int j = 0; j < n; ++j) {
      const double angle = pi * (j + 1) / (n + 1);
      b += 2 / pi * weight[j] * phi[j] * std::sin((m + 1) * angle) / std::sin(angle);
    }
    const double sign = m % 4 == 0 ? 1 : -1;  // T_m(0)
    sum -= b * pi / 2 * (-sign / (m + 2) - (m == 0 ? std::numbers::ln2 : sign / m));
  }
  return {weight.dot(phi), sum / (2 * pi)};
}

LayerContact layer_contact_sphere(double alpha, int n) {
  using std::numbers::pi;
  const Correction correction(alpha);
  const auto& [h, density] = correction;
  const QuadratureRule rule = gauss_legendre(n);  // on [0, 1]
  Eigen::VectorXd t(n + 1), weight = Eigen::VectorXd::Zero(n + 1);
  t.head(n) = Eigen::VectorXd::Map(rule.nodes.data(), n);
  weight.head(n) = Eigen::VectorXd::Map(rule.weights.data(), n);
  t[n] = 1;
  Eigen::MatrixXd cosines(h.size(), n + 1);
  for (int i = 0; i <= n; ++i) cosines.col(i) = (h * (alpha * t[i])).cos();
  const Eigen::MatrixXd weighted = density.matrix().asDiagonal() * cosines;
  Eigen::MatrixXd system = -2 / pi * alpha * (cosines.transpose() * weighted) * weight.asDiagonal();
  system.diagonal().array() += 1;
  Eigen::MatrixXd right(n + 1, 2);  // for d = 1, and for -t^2
  right.col(0).setConstant(4 / pi);
  right.col(1) = -4 / pi * t.array().square();
  const Eigen::MatrixXd phi = SquareSystem(system).solve(right);
  const double approach = -phi(n, 1) / phi(n, 0);
  return {2 * pi * weight.dot(phi.col(0) * approach + phi.col(1)), approach};
}

}  // namespace rollres::testing
