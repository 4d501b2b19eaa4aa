#pragma once

/// Chebyshev series and tables of them, and Chebyshev polynomials for densities sqrt(1 - t^2) sum phi_n U_n(t), n = 0
/// ... order - 1, whose Cauchy integral
///     int sqrt(1 - s^2) U_n(s)/(t - s) ds = pi T_{n+1}(t)        (|t| <= 1),
/// is collocated at the order + 1 zeros of T_{order+1}; smooth functions are integrated against the density at the
/// order zeros of U_order.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/numerics/solution_limits.hpp"

namespace rollres {

struct ChebyshevRule {
  explicit ChebyshevRule(int order);

  int order;
  Eigen::VectorXd nodes;      // t_k, zeros of U_order
  Eigen::MatrixXd densities;  // [node, n]: int sqrt(1 - t^2) U_n h dt = sum over nodes of this times h(t_k)
  Eigen::VectorXd points;     // t_i, zeros of T_{order+1}
  Eigen::MatrixXd images;     // [point, n]: T_n(t_i), n = 0 ... order
};

/// The rule of an order, kept for the thread.
const ChebyshevRule& chebyshev_rule(int order);

/// Interpolation at the zeros of T_count: values there to the coefficients of c_0 + c_1 T_1(t) + ... of as many terms.
struct ChebyshevFit {
  explicit ChebyshevFit(int count);

  Eigen::VectorXd nodes;        // from 1 to -1
  Eigen::MatrixXd from_values;  // [k, node]: c = from_values * values

  /// The series of a function of t whose values are of any type of array.
  template <class Value, class Function>
  std::vector<Value> series(const Function& function) const {
    std::vector<Value> values, c;
    for (const double t : nodes) values.push_back(function(t));
    for (Eigen::Index k = 0; k < nodes.size(); ++k) {
      c.push_back(from_values(k, 0) * values[0]);
      for (Eigen::Index node = 1; node < nodes.size(); ++node)
        c.back() += from_values(k, node) * values[static_cast<std::size_t>(node)];
    }
    return c;
  }
};

/// The fit of so many terms, kept for the thread.
const ChebyshevFit& chebyshev_fit(int count);

/// T_n(t) for n = 0 ... count - 1, |t| <= 1; beyond 1 the continuation (t - sqrt(t^2 - 1))^n of the density's field.
Eigen::VectorXd chebyshev_images(double t, int count);

/// What sums over the zeros s of U_order lack where a density is integrated against f(s) ln|t - s|, f smooth: by node,
/// to be added to the logarithm there. Any t that is not a node.
Eigen::RowVectorXd logarithm_missed(int order, double t);

/// c_0 + c_1 T_1(t) + ... by Clenshaw's recurrence; at least one coefficient, of any type of array of fixed size.
template <class Value>
Value chebyshev_sum(std::span<const Value> c, double t) {
  Value b1 = Value::Zero(), b2 = Value::Zero();
  for (std::size_t k = c.size() - 1; k > 0; --k) {
    const Value b0 = c[k] + 2 * t * b1 - b2;
    b2 = b1;
    b1 = b0;
  }
  return c[0] + t * b1 - b2;
}

/// Several functions of a distance as Chebyshev series on panels; the panels may widen with the distance, as the
/// functions get smoother.
template <int Functions>
class ChebyshevTable {
 public:
  using Values = Eigen::Array<double, Functions, 1>;

  /// @param borders of the panels, ascending   @param sample values of the functions at a point
  template <class Sample>
  ChebyshevTable(std::vector<double> borders, int degree, const Sample& sample)
      : borders_(std::move(borders)), degree_(degree) {
    const ChebyshevFit& fit = chebyshev_fit(degree + 1);
    for (std::size_t panel = 0; panel + 1 < borders_.size(); ++panel) {
      const double from = borders_[panel], to = borders_[panel + 1];
      const std::vector<Values> c =
          fit.series<Values>([&](double t) { return sample(from + 0.5 * (to - from) * (1 + t)); });
      coefficients_.insert(coefficients_.end(), c.begin(), c.end());
    }
    double narrowest = borders_.back() - borders_.front();
    for (std::size_t i = 0; i + 1 < borders_.size(); ++i)
      narrowest = std::min(narrowest, borders_[i + 1] - borders_[i]);
    constexpr double most_bins = 1e4;
    const double range = borders_.back() - borders_.front();
    per_bin_ = std::min(1 / narrowest, most_bins / range);
    const int bins = checked_count(std::ceil(range * per_bin_), "panels of a table");
    for (int bin = 0, panel = 0; bin <= bins; ++bin) {
      const double start = borders_.front() + bin / per_bin_;
      while (panel + 2 < static_cast<int>(borders_.size()) && borders_[static_cast<std::size_t>(panel) + 1] <= start)
        ++panel;
      first_panel_.push_back(panel);
    }
  }

  /// @param x between the first and the last border
  Values operator()(double x) const { return at(std::array<double, 1>{x})[0]; }

  /// At several points at once, which a processor does side by side.
  template <std::size_t Points>
  std::array<Values, Points> at(const std::array<double, Points>& x) const {
    std::array<Values, Points> b1, b2;
    std::array<double, Points> t;
    std::array<const Values*, Points> c;
    for (std::size_t i = 0; i < Points; ++i) {
      const double bin = std::min((x[i] - borders_.front()) * per_bin_, static_cast<double>(first_panel_.size() - 1));
      auto panel = static_cast<std::size_t>(first_panel_[bin > 0 ? static_cast<std::size_t>(bin) : 0]);
      while (panel + 2 < borders_.size() && x[i] > borders_[panel + 1]) ++panel;
      t[i] = 2 * (x[i] - borders_[panel]) / (borders_[panel + 1] - borders_[panel]) - 1;
      c[i] = &coefficients_[panel * static_cast<std::size_t>(degree_ + 1)];
      b1[i] = b2[i] = Values::Zero();
    }
    for (int k = degree_; k > 0; --k)  // Clenshaw
      for (std::size_t i = 0; i < Points; ++i) {
        const Values b0 = c[i][k] + 2 * t[i] * b1[i] - b2[i];
        b2[i] = b1[i];
        b1[i] = b0;
      }
    for (std::size_t i = 0; i < Points; ++i) b1[i] = c[i][0] + t[i] * b1[i] - b2[i];
    return b1;
  }

 private:
  std::vector<double> borders_;
  int degree_;
  std::vector<Values> coefficients_;
  double per_bin_;                // bins as wide as the narrowest panel, or wider
  std::vector<int> first_panel_;  // that a bin touches
};

}  // namespace rollres
