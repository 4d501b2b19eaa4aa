#include "core/influence/piecewise_field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/chebyshev.hpp"

namespace rollres {

using Eigen::Index;

namespace {

/// Of each row: the sign that goes with its coefficient.
Eigen::VectorXd signs(const Coefficients& of_coefficients, Index rows) {
  return of_coefficients.matrix().replicate(rows / 6, 1);
}

}  // namespace

ChebyshevPanels::ChebyshevPanels(std::vector<double> borders, int degree) : borders_(std::move(borders)) {
  const int count = degree + 1;
  const ChebyshevFit& fit = chebyshev_fit(count);
  for (std::size_t panel = 0; panel + 1 < borders_.size(); ++panel)
    for (const double t : fit.nodes)
      nodes_.push_back(borders_[panel] + 0.5 * (borders_[panel + 1] - borders_[panel]) * (1 + t));
  integration_ = Eigen::MatrixXd::Zero(count + 1, count);
  for (int node = 0; node < count; ++node) {
    Eigen::VectorXd series = Eigen::VectorXd::Zero(count + 2);  // of the function that is 1 at the node
    series.head(count) = fit.from_values.col(node);
    double at_start = 0;
    for (int k = 1; k <= count; ++k) {
      integration_(k, node) = ((k == 1 ? 2 : 1) * series(k - 1) - series(k + 1)) / (2 * k);
      at_start += (k % 2 == 0 ? 1 : -1) * integration_(k, node);
    }
    integration_(0, node) = -at_start;
  }
}

std::size_t ChebyshevPanels::panel_of(double x) const {
  const auto after = std::upper_bound(borders_.begin() + 1, borders_.end() - 1, x);
  return static_cast<std::size_t>(after - borders_.begin() - 1);
}

/// T_k at the place of x in a panel.
Eigen::VectorXd ChebyshevPanels::images(std::size_t panel, double x) const {
  const double from = borders_[panel], to = borders_[panel + 1],
               t = std::clamp(2 * (x - from) / (to - from) - 1, -1.0, 1.0);
  return chebyshev_images(t, static_cast<int>(integration_.rows()));
}

Eigen::VectorXd ChebyshevPanels::integral_weights(double x) const {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<Index>(nodes_.size()));
  const Index count = integration_.cols();
  for (std::size_t panel = 0, last = panel_of(x); panel <= last; ++panel) {
    const double half = 0.5 * (borders_[panel + 1] - borders_[panel]);
    weights.segment(static_cast<Index>(panel) * count, count) =
        half * integration_.transpose() * images(panel, panel < last ? borders_[panel + 1] : x);
  }
  return weights;
}

ChebyshevPanels::Antiderivatives ChebyshevPanels::antiderivatives(const Eigen::MatrixXd& values) const {
  const Index count = integration_.cols(), panels = static_cast<Index>(borders_.size()) - 1;
  Antiderivatives result{this, Eigen::MatrixXd(values.rows(), panels * (count + 1))};
  Eigen::VectorXd before = Eigen::VectorXd::Zero(values.rows());
  for (Index panel = 0; panel < panels; ++panel) {
    const auto p = static_cast<std::size_t>(panel);
    auto series = result.coefficients.middleCols(panel * (count + 1), count + 1);
    series = 0.5 * (borders_[p + 1] - borders_[p]) * values.middleCols(panel * count, count) * integration_.transpose();
    series.col(0) += before;
    before = series.rowwise().sum();  // at the panel's end
  }
  return result;
}

Eigen::VectorXd ChebyshevPanels::Antiderivatives::operator()(double x) const {
  const std::size_t panel = panels->panel_of(x);
  const Index count = panels->integration_.rows();
  return coefficients.middleCols(static_cast<Index>(panel) * count, count) * panels->images(panel, x);
}

Eigen::VectorXd ChebyshevPanels::Antiderivatives::between(double left, double right) const {
  const std::size_t panel = panels->panel_of(right);
  if (panel != panels->panel_of(left)) return (*this)(right) - (*this)(left);
  const Index count = panels->integration_.rows();
  return coefficients.middleCols(static_cast<Index>(panel) * count, count) *
         (panels->images(panel, right) - panels->images(panel, left));
}

PiecewiseField::PiecewiseField(const std::vector<double>& borders, int degree, Value value)
    : panels_(borders, degree), value_(std::move(value)), values_(panels_.nodes().size()), sampled_(panels_.count()) {}

void PiecewiseField::sample(std::size_t panel) const {
  const std::vector<double>& nodes = panels_.nodes();
  const std::size_t each = panels_.nodes_each();
  for (std::size_t j = panel * each; j < (panel + 1) * each; ++j) {
    Eigen::MatrixXd row;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Eigen::VectorXd values = value_(nodes[i], nodes[j]);
      if (i == 0) row.resize(values.size(), static_cast<Index>(nodes.size()));
      row.col(static_cast<Index>(i)) = values;
    }
    values_[j] = std::move(row);
  }
}

PiecewiseField::Strip PiecewiseField::strip(double below, double above) const {
  const Eigen::VectorXd to = panels_.integral_weights(std::abs(above)),
                        from = panels_.integral_weights(std::abs(below));
  const double to_sign = above < 0 ? -1 : 1, from_sign = below < 0 ? -1 : 1;
  const std::size_t last = panels_.panel_of(std::max(std::abs(below), std::abs(above)));
  const std::size_t first = below < 0 ? 0 : panels_.panel_of(below);
  for (std::size_t panel = first; panel <= last; ++panel) std::call_once(sampled_[panel], [&] { sample(panel); });
  const std::size_t each = panels_.nodes_each();
  const Index rows = values_[first * each].rows();
  const Eigen::ArrayXd parity = signs(coefficient::mirror_y, rows);
  Eigen::MatrixXd along = Eigen::MatrixXd::Zero(rows, to.size());
  for (std::size_t j = first * each; j < (last + 1) * each; ++j) {
    // The antiderivative of what is even is odd.
    const auto at = static_cast<Index>(j);
    const double even = to_sign * to(at) - from_sign * from(at), odd = to(at) - from(at);
    if (even == odd)
      along += even * values_[j];
    else
      along += (0.5 * ((even + odd) + (even - odd) * parity)).matrix().asDiagonal() * values_[j];
  }
  Strip strip;
  strip.antiderivatives_ = panels_.antiderivatives(along);
  return strip;
}

Eigen::VectorXd PiecewiseField::Strip::operator()(double left, double right) const {
  if (left >= 0) return antiderivatives_.between(left, right);
  const auto from_0 = [&](double x) -> Eigen::VectorXd {
    const Eigen::VectorXd right_of_0 = antiderivatives_(std::abs(x));
    if (x >= 0) return right_of_0;
    return -signs(coefficient::mirror_x, right_of_0.size()).cwiseProduct(right_of_0);
  };
  return from_0(right) - from_0(left);
}

}  // namespace rollres
