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

/// Legendre's functions of the second kind Q_0 ... Q_last, on the cut from -1 to 1 their principal values.
std::vector<std::complex<double>> legendre_second_kind(int last, std::complex<double> s) {
  using complex = std::complex<double>;
  std::vector<complex> q(static_cast<std::size_t>(last) + 1);
  const bool on_cut = s.imag() == 0 && std::abs(s.real()) < 1;
  q[0] = on_cut ? complex(std::atanh(s.real())) : 0.5 * std::log((s + 1.0) / (s - 1.0));
  const double decay = on_cut ? 0 : std::abs(std::log(std::abs(s + std::sqrt(s - 1.0) * std::sqrt(s + 1.0))));
  constexpr double digits_kept = 3;
  if (2 * last * decay < digits_kept) {
    q[1] = s * q[0] - 1.0;
    for (int n = 1; n < last; ++n) {
      const auto i = static_cast<std::size_t>(n);
      q[i + 1] = ((2.0 * n + 1.0) * s * q[i] - static_cast<double>(n) * q[i - 1]) / (n + 1.0);
    }
    return q;
  }
  complex above = 0, here = 1e-280;  // backwards (Miller), from where the start is forgotten
  for (int n = last + static_cast<int>(std::ceil(20 / decay)); n > 0; --n) {
    const complex below = ((2.0 * n + 1.0) * s * here - (n + 1.0) * above) / static_cast<double>(n);
    above = here;
    here = below;
    if (n <= last) q[static_cast<std::size_t>(n)] = above;
    if (std::abs(here) < 1e200) continue;
    for (int known = std::max(n, 1); known <= last; ++known) q[static_cast<std::size_t>(known)] *= 1e-200;
    above *= 1e-200;
    here *= 1e-200;
  }
  for (int n = 1; n <= last; ++n) q[static_cast<std::size_t>(n)] *= q[0] / here;
  return q;
}

/// (2n + 1)/2 P_n at the nodes of the Gauss rule: values to the series of a function, but for the weights on [-1, 1].
struct LegendreFit {
  Eigen::MatrixXd from_values;  // [n, node]

  explicit LegendreFit(int order) : from_values(order, order) {
    const QuadratureRule& rule = gauss_rule(order);
    for (int q = 0; q < order; ++q) {
      const double s = 2 * rule.nodes[static_cast<std::size_t>(q)] - 1;
      double before = 0, here = 1;
      for (int n = 0; n < order; ++n) {
        from_values(n, q) = (n + 0.5) * here;
        const double next = ((2 * n + 1) * s * here - n * before) / (n + 1);
        before = here;
        here = next;
      }
    }
  }
};

}  // namespace

Eigen::RowVectorXd gauss_logarithm_missed(int order, std::complex<double> place) {
  using complex = std::complex<double>;
  complex s = 2.0 * place - 1.0;
  constexpr double rounded = 1e-15;
  if (const double end = std::copysign(1, s.real()); std::abs(s - end) < rounded) s = end * (1 - rounded);
  constexpr double faded = 19;
  if (2 * order * std::log(std::abs(s) + std::sqrt(std::max(std::norm(s) - 1, 0.0))) > 2 * faded)
    return Eigen::RowVectorXd::Zero(order);
  // int P_n(r) ln(s - r) dr = 2 (Q_{n+1} - Q_{n-1})/(2n + 1)
  const std::vector<complex> q = legendre_second_kind(order, s);
  Eigen::RowVectorXd integrals(order);
  const auto times_logarithm = [](complex z) { return z == 0.0 ? 0 : (z * std::log(z)).real(); };
  integrals(0) = s.imag() == 0 ? (s.real() + 1) * std::log(std::abs(s.real() + 1)) -
                                     (s.real() - 1) * std::log(std::abs(s.real() - 1)) - 2
                               : times_logarithm(s + 1.0) - times_logarithm(s - 1.0) - 2;
  for (int n = 1; n < order; ++n) {
    const auto i = static_cast<std::size_t>(n);
    integrals(n) = 2 * (q[i + 1] - q[i - 1]).real() / (2 * n + 1);
  }
  Eigen::RowVectorXd missed = integrals * kept_for_thread<LegendreFit>(order).from_values;
  const QuadratureRule& rule = gauss_rule(order);
  for (int k = 0; k < order; ++k)
    missed(k) -= std::log(std::abs(s - (2 * rule.nodes[static_cast<std::size_t>(k)] - 1)));
  return missed;
}

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

const QuadratureRule& panel_gauss() {
  static const QuadratureRule rule = gauss_legendre(20);
  return rule;
}

/// Lagrange's basis on the Chebyshev-Lobatto nodes of [0, 1] at the Gauss points of the half next to 2^-halvings below
/// it, or of all below it.
struct LobattoBasis {
  static int key(int order, int halvings, bool all) { return (order * most_halvings + halvings) * 2 + (all ? 1 : 0); }
  static constexpr int most_halvings = 2048;  // of a double

  explicit LobattoBasis(int key) {
    const int order = key / 2 / most_halvings;
    const double upper = std::ldexp(1, -(key / 2 % most_halvings)), lower = key % 2 ? 0 : 0.5 * upper;
    const std::vector<double>& points = panel_gauss().nodes;
    values.resize(order + 1, static_cast<Eigen::Index>(points.size()));
    for (std::size_t g = 0; g < points.size(); ++g) {
      auto column = values.col(static_cast<Eigen::Index>(g));
      for (int q = 0; q <= order; ++q)  // barycentric
        column(q) = ((q == 0 || q == order) ? 0.5 : 1.0) * (q % 2 ? -1 : 1) /
                    (lower + (upper - lower) * points[g] - lobatto(q, order));
      column /= column.sum();
    }
  }

  Eigen::MatrixXd values;  // [node, point]
};

}  // namespace

void MemoryRule::add_panel(double start, double length, int order, Singular singular) {
  panels_.push_back({start, length, order, singular});
  for (int q = 0; q <= order; ++q) nodes_.push_back(start + length * position(singular, lobatto(q, order)).first);
}

Eigen::VectorXd MemoryRule::weights(double memory_length) const {
  const QuadratureRule& gauss = panel_gauss();
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(nodes_.size()));
  Eigen::VectorXd factors(static_cast<Eigen::Index>(gauss.nodes.size()));
  Eigen::Index first = 0;
  for (const Panel& panel : panels_) {
    const double decay = panel.length / memory_length;
    // Intervals of t halved towards 0 until the exponential hardly changes within them.
    bool last = panel.start / memory_length >= 45;
    for (int halvings = 0; !last; ++halvings) {
      const double upper = std::ldexp(1, -halvings), below = decay * position(panel.singular, 0.5 * upper).first;
      last = decay * position(panel.singular, upper).first < 2;
      if (!last && below >= 45) continue;
      const double lower = last ? 0 : 0.5 * upper;
      for (std::size_t g = 0; g < gauss.nodes.size(); ++g) {
        const auto [s, slope] = position(panel.singular, lower + (upper - lower) * gauss.nodes[g]);
        factors(static_cast<Eigen::Index>(g)) =
            (upper - lower) * gauss.weights[g] * slope * decay * std::exp(-panel.start / memory_length - decay * s);
      }
      weights.segment(first, panel.order + 1).noalias() +=
          kept_for_thread<LobattoBasis>(LobattoBasis::key(panel.order, halvings, last)).values * factors;
    }
    first += panel.order + 1;
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
