#include "core/spectral/spectral_memory.hpp"

#include <algorithm>
#include <cmath>

#include "core/messages/message_text.hpp"
#include "core/numerics/memory_functions.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int terms_at_a_distance = 100;
constexpr double furthest = 40;              // memory lengths after which nothing is remembered
constexpr double least_coefficient = 1e-17;  // of an exponential that is 1 at the leading end

}  // namespace

IntervalMemory::IntervalMemory(const SpectralProblem& problem, const Interval& interval, int order) {
  const Index terms = problem.terms();
  const double half = interval.half_length();
  constexpr double kept = 2;  // `tails` and the factors of all memories
  require_memory(8 * static_cast<double>(terms) * (kept * static_cast<double>(terms) + 2 * order + terms_at_a_distance),
                 message_text("the memories of ", terms, " retardation times"));
  series.resize(order + 1, terms);
  beyond = Eigen::MatrixXd::Zero(terms_at_a_distance, terms);
  memory.resize(order + 1, terms);
  tails = Eigen::MatrixXd::Zero(terms, terms);
  tail_lift = VectorXd::Zero(terms);
  std::vector<ScaledBesselK> edge;
  for (Index m = 0; m < terms; ++m) {
    require_time();
    const double decay = half / problem.creep_length[static_cast<std::size_t>(m)];
    edge.push_back(scaled_bessel_k(decay));
    memory.col(m) = edge_memory(decay, order + 1, edge.back());
  }
  for (Index j = 0; j < terms; ++j) {
    require_time();
    const double rate = half / problem.relaxation_length[static_cast<std::size_t>(j)];
    const VectorXd bessel = scaled_bessel_i(rate, order + 1);
    series.col(j) = 2 * bessel;
    series(0, j) = bessel(0);
    has_tail.push_back(bessel(order) > least_coefficient);
    if (!has_tail.back()) continue;
    // (S23): U_{n-1} lifts it by -1/2 1/(n^2 - 1); sum_{n>1} I_n 2/(n^2 - 1) = I_0 + I_1/2 - (e^x - I_0)/x.
    tail_lift(j) = -(bessel(0) + 0.5 * bessel(1) - (1 - bessel(0)) / rate);
    for (Index n = 2; n <= order; ++n) tail_lift(j) += series(n, j) / static_cast<double>(n * n - 1);
    beyond.col(j) = 2 * scaled_bessel_i(rate, order + 1 + terms_at_a_distance).tail(terms_at_a_distance);
    for (Index m = 0; m < terms; ++m) {  // all orders together (S13), less those of the series
      const double decay = half / problem.creep_length[static_cast<std::size_t>(m)];
      const ScaledBesselK& k = edge[static_cast<std::size_t>(m)];
      // A_1 of (S12), to all its digits: of a long memory `all` is in proportion to the decay, and is multiplied by the
      // memory's length where the approach is summed up.
      const double first = decay < 1 ? 1 - memory(1, m) : k.order_1 - 1 / decay;
      const double all = decay * (rate * (bessel(1) * k.order_0 + bessel(0) * first) + bessel(0) - 1) / (rate - decay);
      tails(j, m) = all - series.col(j).tail(order).dot(memory.col(m).tail(order));
    }
  }
  if (!any_tail()) beyond.resize(0, terms);
}

bool IntervalMemory::any_tail() const { return std::find(has_tail.begin(), has_tail.end(), true) != has_tail.end(); }

int IntervalMemory::tail_terms() const {
  Index terms = beyond.rows();
  while (terms > 0 && beyond.row(terms - 1).maxCoeff() < least_coefficient) --terms;
  return static_cast<int>(terms);
}

double IntervalMemory::tail_field(std::size_t j, const Interval& interval, double x) const {
  const double t = std::abs(place_in(interval, x));
  const double factor = std::copysign(1 / (t + std::sqrt((t - 1) * (t + 1))), x - interval.centre());
  double power = std::pow(factor, static_cast<double>(series.rows())), sum = 0;
  for (Index k = 0; k < beyond.rows() && std::abs(power) > 1e-18; ++k, power *= factor)
    sum += beyond(k, static_cast<Index>(j)) * power;
  return sum;
}

PrescribedSlope::PrescribedSlope(const SpectralProblem& problem, const Interval& interval, const VectorXd& points,
                                 const std::function<double(double)>& f)
    : elastic(points.size()), amplitude(problem.terms()) {
  for (Index i = 0; i < points.size(); ++i) elastic(i) = problem.glassy * f(points(i));
  for (Index j = 0; j < problem.terms(); ++j) {
    require_time();
    const double length = problem.relaxation_length[static_cast<std::size_t>(j)];
    const double modulus = problem.relaxation_modulus[static_cast<std::size_t>(j)];
    // A short memory as if the body went on; a long one from the leading end.
    const bool goes_on =
        interval.half_length() > 8 * length && interval.to + furthest * length < 0.9 * problem.shape.radius();
    const auto remembered = [&](double x) {
      const double range = goes_on ? furthest : std::min((interval.to - x) / length, furthest);
      const QuadratureRule& rule = gauss_rule(range > 4 ? 32 : 14);
      double sum = 0;
      for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
        const double s = range * rule.nodes[q];
        sum += rule.weights[q] * std::exp(-s) * f(x + length * s);
      }
      return range * sum;
    };
    for (Index i = 0; i < points.size(); ++i) elastic(i) -= modulus * remembered(points(i));
    amplitude(j) = goes_on ? modulus * remembered(interval.to) : 0;
  }
}

PointsAhead::PointsAhead(const SpectralProblem& problem, const SpectralEdges& edges, double from, int order) {
  const auto [shortest, longest] = std::minmax_element(problem.creep_length.begin(), problem.creep_length.end());
  const Interval& contact = edges.contact;
  const double half = contact.half_length(), reach = from + 40 * *longest;
  std::vector<double> ends{contact.to}, borders;
  for (const Interval& stick : edges.sticks) {
    ends.push_back(stick.from);
    ends.push_back(stick.to);
  }
  // In contact: panels between ends, cut where the memories begin and into few oscillations each.
  const auto cut = [&](double border) {
    if (border > from && border < contact.to) borders.push_back(border);
  };
  for (const double end : ends) cut(end);
  for (double distance = 0.5 * half; distance > *shortest; distance *= 0.3) cut(from + distance);
  const int parts = 1 + order / 6;
  for (int i = 1; i < parts; ++i) cut(contact.centre() + half * std::cos(M_PI * i / parts));
  borders.push_back(from);
  borders.push_back(contact.to);
  // Beyond: widening from where the highest coefficient has left the surface.
  for (double distance = half * std::min(0.5, 32.0 / (order * order)); borders.back() < reach; distance *= 4)
    borders.push_back(contact.to + distance);
  std::sort(borders.begin(), borders.end());
  const QuadratureRule& rule = gauss_rule(14);
  std::vector<double> points, steps;
  for (std::size_t i = 1; i < borders.size() && borders[i - 1] < reach; ++i) {
    const double width = 0.5 * (borders[i] - borders[i - 1]);
    if (width < 1e-13 * half) continue;
    for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
      const double angle = M_PI * (rule.nodes[q] - 0.5);
      points.push_back(borders[i - 1] + 2 * width * std::pow(std::sin(0.5 * M_PI * rule.nodes[q]), 2));
      steps.push_back(M_PI * width * std::cos(angle) * rule.weights[q]);
    }
  }
  x = Eigen::Map<Eigen::ArrayXd>(points.data(), static_cast<Index>(points.size()));
  weights.resize(x.size(), problem.terms());
  for (Index m = 0; m < problem.terms(); ++m) {
    const double length = problem.creep_length[static_cast<std::size_t>(m)];
    weights.col(m) = Eigen::Map<Eigen::ArrayXd>(steps.data(), x.size()) * ((from - x) / length).exp() / length;
  }
}

}  // namespace rollres
