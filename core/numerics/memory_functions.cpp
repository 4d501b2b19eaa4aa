#include "core/numerics/memory_functions.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "core/numerics/chebyshev.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

constexpr double large = 100;  // beyond it Hankel's expansion has all digits

/// sum_k (+-1)^k a_k(order)/x^k of I (alternating) or K, without exp(+-x) and sqrt: Abramowitz and Stegun 9.7.1, 9.7.2.
double hankel_sum(int order, double x, bool alternating) {
  double sum = 1, term = 1;
  for (int k = 1; k < 12; ++k) {
    term *= (4.0 * order * order - (2 * k - 1) * (2 * k - 1)) / (8 * k * x) * (alternating ? -1 : 1);
    sum += term;
  }
  return sum;
}

/// Order from which a recursion downwards forgets its start before it comes to `count`: I_n(x) e^{-x} ~ e^{-n^2/2x}.
int far_order(double x, int count) {
  return checked_count(std::sqrt(static_cast<double>(count) * count + 80 * x), "terms of a recursion") + 30;
}

/// Upwards the recursions below multiply errors by e^{n^2/2x} or so.
bool upwards(double x, int count) { return x > large && x > 0.5 * count * count; }

}  // namespace

Eigen::VectorXd scaled_bessel_i(double x, int count) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(count);
  if (upwards(x, count)) {
    const double factor = 1 / std::sqrt(2 * M_PI * x);
    for (int n = 0; n < count; ++n)
      values(n) = n < 2 ? factor * hankel_sum(n, x, true) : values(n - 2) - 2 * (n - 1) / x * values(n - 1);
    return values;
  }
  // Miller's recursion, normalised by I_0 + 2 (I_1 + I_2 + ...) = e^x.
  double above = 0, here = 1e-280, sum = 0;
  for (int n = far_order(x, count); n >= 0; --n) {
    if (n < count) values(n) = here;
    sum += n == 0 ? here : 2 * here;
    const double below = x > 0 ? above + 2 * n / x * here : 0;
    above = here;
    here = below;
    if (here > 1e200) {
      above *= 1e-280;
      here *= 1e-280;
      sum *= 1e-280;
      values *= 1e-280;
    }
  }
  return values / sum;
}

ScaledBesselK scaled_bessel_k(double x) {
  if (x > large) {
    const double factor = std::sqrt(M_PI / (2 * x));
    return {factor * hankel_sum(0, x, false), factor * hankel_sum(1, x, false)};
  }
  const double growth = std::exp(x);
  return {growth * std::cyl_bessel_k(0, x), growth * std::cyl_bessel_k(1, x)};
}

Eigen::VectorXd edge_memory(double x, int count, const ScaledBesselK& k) {
  // A_n = int e^{-x (cosh h - 1)} e^{-n h} dh obeys x (A_{n-1} - A_{n+1}) = 2 (1 - n A_n), and b_n = 1 - n A_n.
  Eigen::VectorXd values = Eigen::VectorXd::Ones(count);
  if (upwards(x, count)) {
    double before = k.order_0, here = k.order_1 - 1 / x;
    for (int n = 1; n < count; ++n) {
      values(n) = 1 - n * here;
      const double next = before - 2 / x * values(n);
      before = here;
      here = next;
    }
    return values;
  }
  // 2 b_n - x b_{n+1}/(n+1) + x b_{n-1}/(n-1) = 2 x/(n^2 - 1), a boundary value problem: its pivots only grow.
  const int last = far_order(x, count);
  std::vector<double> pivot(static_cast<std::size_t>(last + 1)), right(pivot);
  pivot[1] = 2;
  right[1] = x * k.order_0 - x / 2;
  for (int n = 2; n <= last; ++n) {
    const auto i = static_cast<std::size_t>(n);
    const double factor = x / (n - 1) / pivot[i - 1];
    pivot[i] = 2 + factor * x / n;
    right[i] = 2 * x / (static_cast<double>(n) * n - 1) - factor * right[i - 1];
  }
  double above = x / (x + (last + 1.0) * (last + 1.0));
  for (int n = last; n >= 1; --n) {
    const auto i = static_cast<std::size_t>(n);
    above = (right[i] + x / (n + 1) * above) / pivot[i];
    if (n < count) values(n) = above;
  }
  return values;
}

namespace {

constexpr double euler = 0.57721566490153286;

/// Ei(x) - euler - ln|x| for |x| <= 1: the sum of x^k/(k k!).
double entire_part(double x) {
  static const std::array<double, 18> coefficients = [] {
    std::array<double, 18> c{};
    double factorial = 1;
    for (int k = 1; k <= 18; ++k) c[static_cast<std::size_t>(k - 1)] = 1 / (k * (factorial *= k));
    return c;
  }();
  double sum = 0;
  for (std::size_t k = coefficients.size(); k-- > 0;) sum = coefficients[k] + sum * x;
  return sum * x;
}

constexpr double tabled_to = 1024;

/// A function of x from 1 to tabled_to whose only singularity is 0: on panels in constant ratio it is as smooth as on
/// the first.
ChebyshevTable<1> on_panels(double (*function)(double)) {
  constexpr int panels_to_double = 4;
  std::vector<double> borders;
  for (int panel = 0; borders.empty() || borders.back() < tabled_to; ++panel)
    borders.push_back(std::exp2(static_cast<double>(panel) / panels_to_double));
  return {borders, 12, [&](double x) { return ChebyshevTable<1>::Values::Constant(function(x)); }};
}

/// 1/x (1 + sign/x + 2/x^2 + sign 6/x^3 + ...)
double far_integral(double x, int sign) {
  double term = 1 / x, sum = 0;
  for (int k = 1; k < 40 && std::abs(term) > 1e-18 * sum; ++k, term *= sign * (k - 1) / x) sum += term;
  return sum;
}

double fraction_of_exponential_integral(double x) {
  // Continued fraction, from below (Abramowitz and Stegun 5.1.22 in its even form).
  double tail = 0;
  for (int k = 20 + static_cast<int>(80 / x); k >= 1; --k) tail = k * k / (x + 2 * k + 1 - tail);
  return 1 / (x + 1 - tail);
}

}  // namespace

double scaled_exponential_integral(double x) {
  if (x < 1) return -std::exp(x) * (euler + std::log(x) + entire_part(-x));
  if (x >= tabled_to) return far_integral(x, -1);
  static const ChebyshevTable<1> table = on_panels(fraction_of_exponential_integral);
  return table(x)[0];
}

double scaled_growing_integral(double x) {
  if (x < 1) return std::exp(-x) * (euler + std::log(x) + entire_part(x));
  if (x >= tabled_to) return far_integral(x, 1);
  static const ChebyshevTable<1> table =
      on_panels([](double at) { return at < 40 ? std::exp(-at) * std::expint(at) : far_integral(at, 1); });
  return table(x)[0];
}

double remembered_pole(double x, double length) {
  return (x > 0 ? scaled_exponential_integral(x / length) : -scaled_growing_integral(-x / length)) / length;
}

TrigonometricIntegrals trigonometric_integrals(double x) {
  if (x < 4) {
    double sine = 0, cosine = euler + std::log(x), power = 1;
    for (int k = 1; k < 40; ++k) {  // x^k/k!, signs + - - +
      power *= x / k;
      const double sign = k % 4 < 2 ? 1 : -1;
      (k % 2 ? sine : cosine) += sign * power / k;
    }
    return {cosine, sine};
  }
  // E_1(i x) by its continued fraction, from below.
  using complex = std::complex<double>;
  const complex z(0, x);
  complex tail = 0;
  for (int k = 20 + static_cast<int>(160 / x); k >= 1; --k)
    tail = static_cast<double>(k) * static_cast<double>(k) / (z + 2.0 * k + 1.0 - tail);
  const complex integral = std::polar(1.0, -x) / (z + 1.0 - tail);
  return {-integral.real(), M_PI / 2 + integral.imag()};
}

}  // namespace rollres
