#include "core/influence/elastic_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/numerics/quadrature.hpp"

namespace rollres {

namespace {

double distance(double x, double y) { return std::sqrt(x * x + y * y); }

/// Antiderivative over x and y of x/(x^2 + y^2).
double integrated_cosine(double x, double y) {
  const double square = x * x + y * y;
  if (square == 0) return 0;
  return 0.5 * y * std::log(square) + (x == 0 ? 0 : x * std::atan(y / x));
}

/// Antiderivative of ln(t^2 + b^2).
double integrated_log(double t, double b) {
  const double square = t * t + b * b;
  return square == 0 ? 0 : t * std::log(square) - 2 * t + (b > 0 ? 2 * b * std::atan(t / b) : 0);
}

/// Enough Gauss points that the average over a cell of the correction, whose wavelength is about H, is exact to 1e-9.
QuadratureRule averaging_rule(double cell_over_thickness) {
  const double c = cell_over_thickness;
  return gauss_legendre(c < 0.1 ? 2 : c < 0.3 ? 3 : c < 0.7 ? 4 : c < 1.5 ? 6 : static_cast<int>(4 * c) + 4);
}

}  // namespace

double x_asinh(double x, double y) { return x == 0 ? 0 : x * std::asinh(y / std::abs(x)); }

ElasticKernel::ElasticKernel(Indenter indenter, const SurfaceShape& shape, double cell_x, double cell_y)
    : indenter_(indenter), shape_(shape), cell_x_(cell_x), cell_y_(cell_y) {
  if (std::isinf(shape.extent)) return;
  const LayerSymbols &deep = shape.deep, &base = shape.base;
  beyond_ = {base.normal - deep.normal, base.longitudinal - deep.longitudinal, base.cross - deep.cross,
             base.transverse - deep.transverse};
  const double end = shape.extent / shape.length;
  if (indenter == Indenter::cylinder) {
    if (shape.rigid_base()) return;
    // Over a half-space the antiderivatives go on like T + B/x and, for the cross term, like -x/2 + T + B ln x.
    const double before = 0.9 * end;
    const Eigen::Array3d change = (*shape.line)(end) - (*shape.line)(before);
    line_tail_ << change(0) / (1 / end - 1 / before), change(1) / (1 / end - 1 / before),
        (change(2) + 0.5 * beyond_.cross * (end - before)) / std::log(end / before);
    return;
  }
  if (!shape.rigid_base()) radial_tail_ = (*shape.radial)(end)-radial_limit(shape.extent);
  const auto fill = [&](double cell, std::vector<double>& nodes, std::vector<double>& weights) {
    const QuadratureRule rule = averaging_rule(cell / shape.length);
    weights = rule.weights;
    for (const double node : rule.nodes) nodes.push_back((node - 0.5) * cell);
  };
  fill(cell_x, nodes_x_, weights_x_);
  fill(cell_y, nodes_y_, weights_y_);
}

Coefficients ElasticKernel::operator()(double x, double y) const {
  return indenter_ == Indenter::sphere ? sphere(x, y) : cylinder(x);
}

Coefficients ElasticKernel::sphere(double x, double y) const {
  using namespace coefficient;
  Coefficients sum = Coefficients::Zero();
  if (distance(x, y) > shape_.scales().reach()) return sum;
  const double right = x + 0.5 * cell_x_, left = x - 0.5 * cell_x_;
  const double above = y + 0.5 * cell_y_, below = y - 0.5 * cell_y_;
  const Eigen::Array4d r =  // of the corners
      (Eigen::Array4d(right, right, left, left).square() + Eigen::Array4d(above, below, above, below).square()).sqrt();
  double a, b;  // x asinh(y/|x|) and y asinh(x/|y|), differenced over the corners
  if (left > 0 && below > 0) {
    const Eigen::Array4d logarithm = (Eigen::Array4d(above + r(0), above + r(2), right + r(0), right + r(1)) /
                                      Eigen::Array4d(below + r(1), below + r(3), left + r(2), left + r(3)))
                                         .log();
    a = right * logarithm(0) - left * logarithm(1);
    b = above * logarithm(2) - below * logarithm(3);
  } else {
    a = x_asinh(right, above) - x_asinh(right, below) - x_asinh(left, above) + x_asinh(left, below);
    b = x_asinh(above, right) - x_asinh(above, left) - x_asinh(below, right) + x_asinh(below, left);
  }
  const LayerSymbols& deep = shape_.deep;
  sum(ww) = deep.normal * (a + b);
  sum(uu) = deep.longitudinal * a + deep.transverse * b;
  sum(vv) = deep.transverse * a + deep.longitudinal * b;
  sum(uv) = (deep.longitudinal - deep.transverse) * (r(0) - r(1) - r(2) + r(3));
  if (deep.cross != 0) {
    const auto corners = [&](auto&& f) { return f(right, above) - f(right, below) - f(left, above) + f(left, below); };
    sum(uw) = -deep.cross * corners(integrated_cosine);
    sum(vw) = -deep.cross * corners([](double p, double q) { return integrated_cosine(q, p); });
  }
  sum /= 2 * M_PI * cell_x_ * cell_y_;
  if (std::isinf(shape_.extent)) return sum;

  Coefficients correction = Coefficients::Zero();
  constexpr std::size_t together = 4;
  const std::size_t points = nodes_x_.size() * nodes_y_.size();
  for (std::size_t first = 0; first < points; first += together) {
    // Points past the last one repeat it with no weight.
    std::array<double, together> px, py, distances, weights, inside;
    for (std::size_t p = 0; p < together; ++p) {
      const std::size_t point = std::min(first + p, points - 1), i = point % nodes_x_.size(),
                        j = point / nodes_x_.size();
      px[p] = x + nodes_x_[i];
      py[p] = y + nodes_y_[j];
      distances[p] = distance(px[p], py[p]);
      weights[p] = first + p < points ? weights_x_[i] * weights_y_[j] : 0;
      inside[p] = std::min(distances[p], shape_.extent) / shape_.length;
    }
    std::array<Eigen::Array4d, together> values = shape_.radial->at(inside);
    for (std::size_t p = 0; p < together; ++p) {
      const double from_load = distances[p], per_distance = from_load > 0 ? 1 / from_load : 0;
      Eigen::Array4d& f = values[p];
      if (from_load >= shape_.extent) {
        const double kept = shape_.extent / from_load, square = kept * kept;
        f = radial_limit(from_load) + Eigen::Array4d(square * kept, square * kept, square, square) * radial_tail_;
      }
      const double cosine = from_load > 0 ? px[p] * per_distance : 1, sine = py[p] * per_distance;
      const double cosine2 = cosine * cosine - sine * sine, sine2 = 2 * sine * cosine;
      Coefficients value;
      value << f(0), f(1) - cosine2 * f(2), f(1) + cosine2 * f(2), -sine2 * f(2), -cosine * f(3), -sine * f(3);
      correction += weights[p] * value;
    }
  }
  return sum + correction / shape_.length;
}

/// The correction far away, where it turns the half-space's part into that of the base.
Eigen::Array4d ElasticKernel::radial_limit(double from_load) const {
  return Eigen::Array4d(2 * beyond_.normal, beyond_.longitudinal + beyond_.transverse,
                        beyond_.longitudinal - beyond_.transverse, 2 * beyond_.cross) *
         (shape_.length / (4 * M_PI * from_load));
}

Coefficients ElasticKernel::cylinder(double x) const {
  using namespace coefficient;
  Coefficients sum = Coefficients::Zero();
  const double reach = shape_.scales().reach();
  if (std::abs(x) > reach) return sum;
  // A cell across the end of the response ends there.
  const double right = std::min(x + 0.5 * cell_x_, reach), left = std::max(x - 0.5 * cell_x_, -reach);
  const LayerSymbols& deep = shape_.deep;
  const double logarithm = (integrated_log(right, 0) - integrated_log(left, 0)) / (2 * M_PI * cell_x_);
  sum(ww) = -deep.normal * logarithm;
  sum(uu) = -deep.longitudinal * logarithm;
  sum(uw) = -0.5 * deep.cross * (std::abs(right) - std::abs(left)) / cell_x_;
  if (std::isinf(shape_.extent)) return sum;

  const double image = 2 * shape_.length;
  const double known = (integrated_log(right, image) - integrated_log(left, image)) / (2 * M_PI * cell_x_);
  const Eigen::Array3d correction =
      (line_antiderivative(right) - line_antiderivative(left)) * (shape_.length / cell_x_);
  sum(ww) += correction(0) - beyond_.normal * known;
  sum(uu) += correction(1) - beyond_.longitudinal * known;
  sum(uw) += correction(2);
  return sum;
}

/// Of the correction less its known part, over the length; two components odd and one even in x.
Eigen::Array3d ElasticKernel::line_antiderivative(double x) const {
  const double end = shape_.extent / shape_.length, t = std::abs(x) / shape_.length;
  Eigen::Array3d value = (*shape_.line)(std::min(t, end));
  if (t > end && !shape_.rigid_base())
    value += Eigen::Array3d(line_tail_(0) * (1 / t - 1 / end), line_tail_(1) * (1 / t - 1 / end),
                            -0.5 * beyond_.cross * (t - end) + line_tail_(2) * std::log(t / end));
  return x < 0 ? Eigen::Array3d(-value(0), -value(1), value(2)) : value;
}

}  // namespace rollres
