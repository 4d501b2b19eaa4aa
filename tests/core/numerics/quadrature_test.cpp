#include "core/numerics/quadrature.hpp"

#include <algorithm>
#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// int_start^{start + length} e^{-s/T}/T s^power ds by brute force: Gauss's rule on pieces shorter than T, graded
/// towards the start.
template <class Function>
double memory_integral(double start, double length, double memory, const Function& function) {
  const QuadratureRule gauss = gauss_legendre(16);
  double sum = 0;
  // Geometric pieces from both ends take weak singularities and a short memory.
  const auto piece = [&](double from, double to) {
    for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
      const double s = from + (to - from) * gauss.nodes[q];
      sum += (to - from) * gauss.weights[q] * std::exp(-s / memory) / memory * function(s);
    }
  };
  const double middle = start + 0.5 * length;
  for (double width = 0.5 * length; width > 1e-30 * length; width *= 0.5) {
    piece(start + 0.5 * width, start + width);
    piece(middle + 0.5 * length - width, middle + 0.5 * length - 0.5 * width);
  }
  return sum;
}

double integrate(const MemoryRule& rule, double memory, const auto& function) {
  const Eigen::VectorXd weights = rule.weights(memory);
  double sum = 0;
  for (Eigen::Index q = 0; q < weights.size(); ++q)
    sum += weights(q) * function(rule.nodes()[static_cast<std::size_t>(q)]);
  return sum;
}

}  // namespace

TEST_CASE("Gauss's rule with n nodes integrates polynomials of degree 2n - 1", "[core][quadrature]") {
  for (const int order : {1, 2, 5, 20}) {
    const QuadratureRule rule = gauss_legendre(order);
    for (int power = 0; power < 2 * order; ++power) {
      double sum = 0;
      for (std::size_t q = 0; q < rule.nodes.size(); ++q) sum += rule.weights[q] * std::pow(rule.nodes[q], power);
      CHECK(sum == Approx(1. / (power + 1)).epsilon(1e-13));  // rounding of 40 terms
    }
  }
}

TEST_CASE("the rule for a fading memory is exact for polynomials, however short or long the memory",
          "[core][quadrature]") {
  MemoryRule rule;
  rule.add_panel(0, 0.5, 6);
  rule.add_panel(0.5, 1.5, 6);
  for (const double memory : {1e-9, 1e-4, 0.03, 0.5, 2.0, 50.0, 1e6})
    for (int power = 0; power <= 6; ++power) {
      const auto function = [&](double s) { return std::pow(s - 0.3, power); };
      const double expected = memory_integral(0, 2, memory, function);
      const double largest = std::pow(1.7, power) * (1 - std::exp(-2 / memory));
      INFO("memory " << memory << ", power " << power);
      // Rounding of the weights, which are known beside the polynomial's largest value.
      CHECK(std::abs(integrate(rule, memory, function) - expected) < 1e-12 * largest);
    }
}

TEST_CASE("a vanishing memory takes the value and the slope at the start, whatever the panels", "[core][quadrature]") {
  MemoryRule rule;
  rule.add_panel(0, 3, 8);
  const auto function = [](double s) { return std::cos(s) + 2 * std::sin(s); };
  for (const double memory : {1e-3, 1e-5, 1e-7}) {
    const double value = integrate(rule, memory, function);
    // K(0) + T K'(0) + O(T^2), beside 1e-6 of interpolation over a panel of 3 rad by degree 8
    CHECK(std::abs(value - (1 + 2 * memory)) < 2 * memory * memory + 1e-4 * memory);
  }
}

TEST_CASE("a memory may be any times shorter than a panel, wherever its nodes crowd", "[core][quadrature]") {
  using enum MemoryRule::Singular;
  for (const auto singular : {none, left, right})
    for (const double memory : {1e-6, 1e-14, 1e-18, 1e-40}) {
      MemoryRule rule;
      rule.add_panel(0, 0.2, 16, singular);
      INFO("memory " << memory << ", nodes " << static_cast<int>(singular));
      // A polynomial of degree 4 at most of what is interpolated: rounding of 17 weights from 20 points each.
      CHECK(integrate(rule, memory, [](double) { return 1.0; }) == Approx(1).epsilon(1e-12));
      // Where nodes crowd at the start, weights of either sign cancel.
      const double slope = integrate(rule, memory, [](double s) { return s; });
      CHECK(std::abs(slope - memory) < 1e-11 * memory + (singular == left ? 1e-15 : 0));
    }
}

TEST_CASE("the rule for a fading memory follows x log x at the end of a panel", "[core][quadrature]") {
  using enum MemoryRule::Singular;
  const double length = 0.2;
  for (const double memory : {1e-3, 0.05, 1.0, 1e3}) {
    MemoryRule at_left, at_right;
    at_left.add_panel(0, length, 16, left);
    at_right.add_panel(0, length, 16, right);
    const auto xlogx = [](double x) { return x > 0 ? x * std::log(x) : 0; };
    const auto from_left = [&](double s) { return xlogx(s); };
    const auto from_right = [&](double s) { return xlogx(length - s); };
    // t^4 log t interpolated at degree 16: 1e-8 of the function's largest value, length |log length|
    const double scale = 1e-8 * length * (1 - std::exp(-length / memory));
    INFO("memory " << memory);
    CHECK(std::abs(integrate(at_left, memory, from_left) - memory_integral(0, length, memory, from_left)) < scale);
    CHECK(std::abs(integrate(at_right, memory, from_right) - memory_integral(0, length, memory, from_right)) < scale);
  }
}

TEST_CASE("Gauss's rule is mended for a logarithm on the interval, beside it and off the axis", "[core][quadrature]") {
  constexpr int order = 24;
  const QuadratureRule& rule = gauss_rule(order);
  const auto smooth = [](double s) { return std::exp(s) * (1 + std::cos(3 * s)); };
  for (const std::complex<double> place :
       {std::complex<double>(0.3), std::complex<double>(0.999), std::complex<double>(0.0), std::complex<double>(1.02),
        std::complex<double>(-0.3), std::complex<double>(4.0), std::complex<double>(0.4, 0.01),
        std::complex<double>(0.0, 0.3), std::complex<double>(1.0, -2.0)}) {
    CAPTURE(place);
    const Eigen::RowVectorXd missed = gauss_logarithm_missed(order, place);
    double mended = 0, integral = 0;
    for (std::size_t q = 0; q < rule.nodes.size(); ++q)
      mended += rule.weights[q] * smooth(rule.nodes[q]) *
                (std::log(std::abs(place - rule.nodes[q])) + missed(static_cast<Eigen::Index>(q)));
    // By pieces that narrow towards the place from both sides.
    const double at = std::clamp(place.real(), 0.0, 1.0);
    for (const double end : {0.0, 1.0}) {
      if (end == at) continue;
      for (double part = 1; part > 1e-15; part *= 0.5)
        for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
          const double share = part * (0.5 + 0.5 * rule.nodes[q]), s = at + (end - at) * share;
          const double distance = std::abs(place - at - (end - at) * share);
          integral += 0.5 * part * std::abs(end - at) * rule.weights[q] * smooth(s) * std::log(distance);
        }
    }
    CHECK(mended == Approx(integral).epsilon(1e-12).margin(1e-12));
  }
}
