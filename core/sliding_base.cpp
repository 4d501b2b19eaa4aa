#include "core/sliding_base.hpp"

#include <algorithm>
#include <cmath>

#include "core/chebyshev_rule.hpp"
#include "core/quadrature.hpp"

namespace rollres {

namespace {

const QuadratureRule& gauss(int order) {
  static const QuadratureRule rule_16 = gauss_legendre(16), rule_24 = gauss_legendre(24);
  return order == 16 ? rule_16 : rule_24;
}

}  // namespace

SlidingBase::SlidingBase(const SlipPattern& pattern, const SpectralEdges& edges, int order, int stick_order)
    : pattern_(pattern), edges_(edges), order_(order), borders_(2 * (stick_order + 1)) {
  const ChebyshevRule& rule = chebyshev_rule(order);
  const double centre = edges.centre(), half = edges.half_length();
  if (pattern.one_direction()) {
    nodes = centre + half * rule.nodes.array();
    densities = half * pattern.trailing * rule.densities;
    return;
  }
  border_angles_.resize(borders_);
  partial_.resize(order, borders_);
  for (int k = 0; k < borders_; ++k) {
    const double s =
        (edges.stick_centre() + edges.stick_half_length() * std::cos(M_PI * (k + 0.5) / borders_) - centre) / half;
    const double angle = std::acos(std::clamp(s, -1.0, 1.0));
    border_angles_(k) = angle;
    partial_(0, k) = 0.5 * (M_PI - angle) + 0.25 * std::sin(2 * angle);
    for (int n = 1; n < order; ++n)
      partial_(n, k) = -0.5 * (std::sin(n * angle) / n - std::sin((n + 2) * angle) / (n + 2));
  }
  // Gauss points on the three zones; angles make the roots at the ends and the arcsine smooth.
  const QuadratureRule& points = gauss(24);
  const auto count = static_cast<Eigen::Index>(points.nodes.size());
  nodes.resize(3 * count);
  densities.resize(3 * count, order);
  const double from = std::acos(std::clamp((edges.stick_from - centre) / half, -1.0, 1.0));
  const double to = std::acos(std::clamp((edges.stick_to - centre) / half, -1.0, 1.0));
  const auto add = [&](Eigen::Index at, double t, double weight, double m) {
    const double angle = std::acos(std::clamp(t, -1.0, 1.0));
    nodes(at) = centre + half * t;
    for (int n = 0; n < order; ++n) densities(at, n) = half * weight * m * std::sin((n + 1) * angle);
  };
  for (Eigen::Index q = 0; q < count; ++q) {
    const double part = points.nodes[static_cast<std::size_t>(q)], weight = points.weights[static_cast<std::size_t>(q)];
    const double behind = from + (M_PI - from) * part, ahead = to * part, stick = M_PI * part;
    add(q, std::cos(behind), (M_PI - from) * weight * std::sin(behind), pattern.trailing);
    add(count + q, std::cos(ahead), to * weight * std::sin(ahead), pattern.leading);
    const double x = edges.stick_centre() + edges.stick_half_length() * std::cos(stick);
    add(2 * count + q, (x - centre) / half,
        M_PI * weight * std::sin(stick) * edges.stick_half_length() / half,
        pattern.leading + (pattern.trailing - pattern.leading) * part);
  }
}

double SlidingBase::direction(double x) const {
  if (pattern_.one_direction()) return pattern_.trailing;
  const double t = std::clamp((x - edges_.stick_centre()) / edges_.stick_half_length(), -1.0, 1.0);
  const double part = std::acos(t) / M_PI;  // 0 at the leading border
  return pattern_.leading + (pattern_.trailing - pattern_.leading) * part;
}

/// Mean of F_n(t; s) over the borders.
Eigen::RowVectorXd SlidingBase::jump_mean(double x) const {
  const double t = place_in(x, edges_.centre(), edges_.half_length());
  const bool inside = std::abs(t) < 1;
  const double angle = inside ? std::acos(t) : 0, sine = inside ? std::sin(angle) : 0;
  const double rate = inside ? 0 : std::acosh(std::max(std::abs(t), 1.0));
  Eigen::ArrayXd before = Eigen::ArrayXd::Zero(borders_), here(borders_);
  for (int k = 0; k < borders_; ++k) {
    const double s = border_angles_(k);
    if (inside) {
      const double logarithm = std::log(std::abs(std::sin(0.5 * (s + angle)) / std::sin(0.5 * (s - angle))));
      here(k) = sine * logarithm + t * (M_PI - s) - std::sin(s);
    } else {
      // int_{-1}^{s} dr/((t - r) sqrt(1 - r^2)) = arc/root, times 1 - t^2
      const double root = std::sinh(rate), sine_half = std::sin(0.5 * s), cosine_half = std::cos(0.5 * s);
      const double arc = t > 0 ? 2 * std::atan2(std::tanh(0.5 * rate) * cosine_half, sine_half)
                               : -2 * std::atan2(cosine_half, std::tanh(0.5 * rate) * sine_half);
      here(k) = -root * arc + t * (M_PI - s) - std::sin(s);
    }
  }
  // What the rule over s makes of ln|t - s| against its exact mean.
  const double place = place_in(x, edges_.stick_centre(), edges_.stick_half_length());
  const double correction = std::abs(place) <= 1
                                ? std::log(std::abs(2 * std::cos(borders_ * std::acos(place)))) / borders_
                                : std::log1p(std::exp(-2 * borders_ * std::acosh(std::abs(place)))) / borders_;
  Eigen::RowVectorXd mean(order_);
  for (int n = 0; n < order_; ++n) {
    mean(n) = here.mean() + (inside ? std::sin((n + 1) * angle) * correction : 0);
    const Eigen::ArrayXd next = 2 * t * here - before - 2 * partial_.row(n).transpose().array();
    before = here;
    here = next;
  }
  return mean;
}

Eigen::RowVectorXd SlidingBase::slope(double x) const {
  const double t = place_in(x, edges_.centre(), edges_.half_length());
  const Eigen::RowVectorXd whole = chebyshev_images(t, order_ + 1).tail(order_).transpose();
  if (pattern_.one_direction()) return -0.5 * pattern_.trailing * whole;
  if (std::abs(t) > 1 && order_ * std::acosh(std::abs(t)) > 8) {  // the recursion would lose its digits; no point of the sources is near
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(order_);
    for (Eigen::Index q = 0; q < nodes.size(); ++q) sum += densities.row(q) / (x - nodes(q));
    return -sum / (2 * M_PI);
  }
  return -0.5 * pattern_.leading * whole -
         (pattern_.trailing - pattern_.leading) / (2 * M_PI) * jump_mean(x);
}

Eigen::RowVectorXd memory_of_base(const SlidingBase& base, const SpectralEdges& edges, double memory_length,
                                  int order) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(order);
  const QuadratureRule& rule = gauss(16);
  // From the border with s = v^2, where the slope begins with a root, in panels that the exponential does not outrun.
  const double inside = edges.leading - edges.stick_to;
  const double end = std::sqrt(std::min(inside, 40 * memory_length));
  const int panels = 1 + static_cast<int>(2 * end / std::sqrt(memory_length) / 2);
  for (int panel = 0; panel < panels; ++panel)
    for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
      const double width = end / panels, v = width * (panel + rule.nodes[q]);
      sum += width * rule.weights[q] * 2 * v / memory_length * std::exp(-v * v / memory_length) *
             base.slope(edges.stick_to + v * v);
    }
  // Beyond the leading edge with x = c + l cosh(h).
  const double ratio = edges.half_length() / memory_length, decay = std::exp(-inside / memory_length);
  if (inside < 40 * memory_length) {
    const double last = std::acosh(1 + 40 / ratio);
    const int outer = 2 + static_cast<int>(last);
    for (int panel = 0; panel < outer; ++panel)
      for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
        const double width = last / outer, h = width * (panel + rule.nodes[q]);
        sum += width * rule.weights[q] * decay * ratio * std::sinh(h) * std::exp(-ratio * (std::cosh(h) - 1)) *
               base.slope(edges.centre() + edges.half_length() * std::cosh(h));
      }
  }
  return sum;
}

}  // namespace rollres
