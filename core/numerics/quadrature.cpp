#include "core/numerics/quadrature.hpp"

#include <algorithm>

#include "core/numerics/recently_made.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

QuadratureRule gauss_legendre(int order) {
  QuadratureRule rule;
  for (int i = 0; i < order; ++i) {
    double x = -std::cos(M_PI * (i + 0.75) / (order + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {
      require_time();
      double p0 = 1, p1 = x;
      for (int k = 2; k <= order; ++k) {
        const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      slope = order * (x * p1 - p0) / (x * x - 1);
      const double step = p1 / slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    rule.nodes.push_back(0.5 * (1 + x));
    rule.weights.push_back(1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

const QuadratureRule& gauss_rule(int order) { return kept_for_thread<QuadratureRule>(order, gauss_legendre); }

namespace {

constexpr int singular_power = 4;

/// Position s/length in [0, 1] of the parameter t in [0, 1] and its derivative.
std::pair<double, double> position(MemoryRule::Singular singular, double t) {
  using enum MemoryRule::Singular;
  if (singular == left) return {std::pow(t, singular_power), singular_power * std::pow(t, singular_power - 1)};
  // 1 - (1 - t)^4, to all digits as t -> 0: memories may be any times shorter than a panel.
  if (singular == right)
    return {t * (2 - t) * (1 + (1 - t) * (1 - t)), singular_power * std::pow(1 - t, singular_power - 1)};
  return {t, 1};
}

/// Chebyshev-Lobatto node on [0, 1], ascending.
double lobatto(int index, int order) { return 0.5 * (1 - std::cos(M_PI * index / order)); }

}  // namespace

void MemoryRule::add_panel(double start, double length, int order, Singular singular) {
  panels_.push_back({start, length, order, singular});
  for (int q = 0; q <= order; ++q) nodes_.push_back(start + length * position(singular, lobatto(q, order)).first);
}

Eigen::VectorXd MemoryRule::weights(double memory_length) const {
  static const QuadratureRule gauss = gauss_legendre(20);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(nodes_.size()));
  Eigen::Index first = 0;
  for (const Panel& panel : panels_) {
    const int order = panel.order;
    const double decay = panel.length / memory_length;
    std::vector<double> basis(static_cast<std::size_t>(order + 1)), node(basis);
    for (int q = 0; q <= order; ++q) node[static_cast<std::size_t>(q)] = lobatto(q, order);
    // Intervals of t halved towards 0 until the exponential hardly changes within them.
    if (panel.start / memory_length < 45)
      for (double upper = 1; upper > 0;) {
        const double below = decay * position(panel.singular, 0.5 * upper).first;
        const bool last = decay * position(panel.singular, upper).first < 2;
        const double lower = last ? 0 : 0.5 * upper;
        if (last || below < 45)
          for (std::size_t g = 0; g < gauss.nodes.size(); ++g) {
            const double t = lower + (upper - lower) * gauss.nodes[g];
            const auto [s, slope] = position(panel.singular, t);
            const double factor =
                (upper - lower) * gauss.weights[g] * slope * decay * std::exp(-panel.start / memory_length - decay * s);
            double sum = 0;  // barycentric Lagrange basis on Chebyshev-Lobatto nodes
            for (int q = 0; q <= order; ++q) {
              const double term =
                  ((q == 0 || q == order) ? 0.5 : 1.0) * (q % 2 ? -1 : 1) / (t - node[static_cast<std::size_t>(q)]);
              basis[static_cast<std::size_t>(q)] = term;
              sum += term;
            }
            for (int q = 0; q <= order; ++q) weights(first + q) += factor * basis[static_cast<std::size_t>(q)] / sum;
          }
        upper = lower;
      }
    first += order + 1;
  }
  return weights;
}

std::vector<double> distance_panels(double end) {
  constexpr double growth = 1.6;
  std::vector<double> borders{0, 1.5, 3.5, 6.5, 11};
  while (borders.back() < end) borders.push_back(borders.back() * growth);
  return borders;
}

WavenumberRule::WavenumberRule(double lowest, double highest, double r0, double r1, int order) {
  const WavenumberFade fade(r0, order);
  const double end = std::min(highest, fade.to);
  double from = 0;
  for (double to = lowest; from < end; from = to, to *= 1.6) {
    to = std::min(to, end);
    const QuadratureRule gauss = gauss_legendre(10 + checked_count(0.5 * (to - from) * r1, "nodes of a transform"));
    for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
      const double k = from + (to - from) * gauss.nodes[q];
      nodes.push_back(k);
      weights.push_back((to - from) * gauss.weights[q] * fade(k));
    }
  }
}

}  // namespace rollres
