#include "core/spectral/sliding_base.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/chebyshev.hpp"
#include "core/numerics/quadrature.hpp"

namespace rollres {

bool SlipPattern::one_direction() const {
  for (std::size_t i = 1; i < slips.size(); ++i)
    if (direction(i) != direction(0)) return false;
  return true;
}

SlidingBase::SlidingBase(const SlipPattern& pattern, const SpectralEdges& edges, int order, int stick_order)
    : contact_(edges.contact),
      trailing_(pattern.direction(0)),
      leading_(pattern.direction(pattern.slips.size() - 1)),
      order_(order) {
  // An odd number more than collocation points, so that these never coincide with borders.
  const int borders = stick_order + 4;
  for (std::size_t i = 0; i < pattern.sticks(); ++i) {
    const int change = pattern.direction(i + 1) - pattern.direction(i);
    if (change == 0) continue;
    Transition transition{edges.sticks[i], change, Eigen::ArrayXd(borders), Eigen::VectorXd::Zero(order)};
    for (int k = 0; k < borders; ++k) {
      const double x =
          transition.stick.centre() + transition.stick.half_length() * std::cos(M_PI * (k + 0.5) / borders);
      const double angle = std::acos(std::clamp(place_in(contact_, x), -1.0, 1.0));
      transition.border_angles(k) = angle;
      transition.partial(0) += (M_PI - angle + 0.5 * std::sin(2 * angle)) / borders;
      double here = std::sin(angle), after = std::sin(2 * angle);  // sin(n angle), sin((n + 1) angle)
      for (int n = 1; n < order; ++n) {
        const double next = 2 * std::cos(angle) * after - here;
        transition.partial(n) -= (here / n - next / (n + 2)) / borders;
        here = after;
        after = next;
      }
    }
    transitions_.push_back(std::move(transition));
  }
  place_nodes();
}

void SlidingBase::place_nodes() {
  const double centre = contact_.centre(), half = contact_.half_length();
  if (transitions_.empty()) {
    const ChebyshevRule& rule = chebyshev_rule(order_);
    runs_.push_back({0, order_, contact_});
    nodes_ = centre + half * rule.nodes.array();
    densities_ = half * trailing_ * rule.densities;
    return;
  }
  // Gauss points on each zone; angles make the roots at the ends and the arcsine smooth.
  const QuadratureRule& points = gauss_rule(16 + order_ / 2);
  const auto count = static_cast<Eigen::Index>(points.nodes.size());
  const auto zones = static_cast<Eigen::Index>(2 * transitions_.size() + 1);
  nodes_.resize(zones * count);
  densities_.resize(zones * count, order_);
  Eigen::Index at = 0;
  const auto add = [&](double x, double weight, double m) {
    const double angle = std::acos(std::clamp(place_in(contact_, x), -1.0, 1.0));
    nodes_(at) = x;
    double before = 0, here = std::sin(angle);
    for (int n = 0; n < order_; ++n) {
      densities_(at, n) = weight * m * here;
      const double next = 2 * std::cos(angle) * here - before;
      before = here;
      here = next;
    }
    ++at;
  };
  const auto add_slip = [&](double from, double to, double m) {
    const double behind = std::acos(std::clamp(place_in(contact_, from), -1.0, 1.0));
    const double ahead = std::acos(std::clamp(place_in(contact_, to), -1.0, 1.0));
    runs_.push_back({at, count, contact_, ahead, behind});
    for (std::size_t q = 0; q < points.nodes.size(); ++q) {
      const double angle = ahead + (behind - ahead) * points.nodes[q];
      add(centre + half * std::cos(angle), half * (behind - ahead) * points.weights[q] * std::sin(angle), m);
    }
  };
  double start = contact_.from, m = trailing_;
  for (const Transition& transition : transitions_) {
    const Interval& stick = transition.stick;
    add_slip(start, stick.from, m);
    runs_.push_back({at, count, stick, 0, M_PI});
    for (std::size_t q = 0; q < points.nodes.size(); ++q) {
      const double angle = M_PI * points.nodes[q];  // 0 at the leading end
      add(stick.centre() + stick.half_length() * std::cos(angle),
          stick.half_length() * M_PI * points.weights[q] * std::sin(angle),
          m + transition.change * (1 - points.nodes[q]));
    }
    start = stick.to;
    m += transition.change;
  }
  add_slip(start, contact_.to, m);
}

double SlidingBase::direction(double x) const {
  double m = trailing_;
  for (const Transition& transition : transitions_) {
    const double t = std::clamp(place_in(transition.stick, x), -1.0, 1.0);
    m += transition.change * (1 - std::acos(t) / M_PI);
  }
  return m;
}

/// Mean of F_n(t; s) over the borders: the recursion (S21).
Eigen::RowVectorXd SlidingBase::jump_mean(const Transition& transition, double x) const {
  const double t = place_in(contact_, x);
  const Eigen::Index borders = transition.border_angles.size();
  const bool inside = std::abs(t) < 1;
  const double angle = inside ? std::acos(t) : 0, sine = inside ? std::sin(angle) : 0;
  const double rate = inside ? 0 : std::acosh(std::abs(t));
  Eigen::ArrayXd first(borders);  // F_0
  for (Eigen::Index k = 0; k < borders; ++k) {
    const double s = transition.border_angles(k), sine_half = std::sin(0.5 * s), cosine_half = std::cos(0.5 * s);
    // (1 - t^2) int_{-1}^{s} dr/((t - r) sqrt(1 - r^2))
    double leading_part;
    if (inside)
      leading_part = sine * std::log(std::abs(std::sin(0.5 * (s + angle)) / std::sin(0.5 * (s - angle))));
    else if (t > 0)
      leading_part = -2 * std::sinh(rate) * std::atan2(std::tanh(0.5 * rate) * cosine_half, sine_half);
    else
      leading_part = 2 * std::sinh(rate) * std::atan2(cosine_half, std::tanh(0.5 * rate) * sine_half);
    first(k) = leading_part + t * (M_PI - s) - 2 * sine_half * cosine_half;
  }
  // What the rule over s makes of ln|t - s| against its exact mean (S22). Inside the stick both are singular at every
  // border of the rule, and their sum is not: it is taken in one at the nearest, the middle of the stick being one of
  // them.
  const double signed_place = place_in(transition.stick, x), place = std::abs(signed_place);
  const auto count = static_cast<double>(borders);
  double correction = 0;
  if (place > 1) {
    correction = std::log1p(std::exp(-2 * count * std::acosh(place))) / count;
  } else {
    const double stick_angle = std::acos(signed_place);
    const auto nearest = std::min(static_cast<Eigen::Index>(stick_angle / M_PI * count), borders - 1);
    const double border_angle = M_PI * (static_cast<double>(nearest) + 0.5) / count,
                 s = transition.border_angles(nearest);
    const double distance = stick_angle - border_angle, sum = std::sin(0.5 * (s + angle));
    const double ratio = distance == 0 ? 2 * count : std::sin(count * distance) / std::sin(0.5 * distance);
    const double logarithm = std::log(2 * sum * sum * contact_.half_length() * ratio /
                                      (transition.stick.half_length() * std::sin(0.5 * (stick_angle + border_angle))));
    first(nearest) = sine * logarithm + t * (M_PI - s) - std::sin(s);
  }
  // The recursion is the same for every border, and so for their mean.
  Eigen::RowVectorXd mean(order_);
  double before = 0, here = first.mean() + sine * correction;
  for (int n = 0; n < order_; ++n) {
    mean(n) = here;
    const double next = 2 * t * here - before - transition.partial(n);
    before = here;
    here = next;
  }
  return mean;
}

/// (S21)
Eigen::RowVectorXd SlidingBase::slope(double x) const {
  const double t = place_in(contact_, x);
  if (!transitions_.empty() && std::abs(t) > 1 && order_ * std::acosh(std::abs(t)) > 8) {
    // The recursion would lose its digits; no source is near.
    return -(x - nodes_.array()).inverse().matrix().transpose() * densities_ / (2 * M_PI);
  }
  Eigen::RowVectorXd sum = -0.5 * leading_ * chebyshev_images(t, order_ + 1).tail(order_).transpose();
  for (const Transition& transition : transitions_) sum += transition.change / (2 * M_PI) * jump_mean(transition, x);
  return sum;
}

}  // namespace rollres
