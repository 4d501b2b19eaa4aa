#include "core/influence/elastic_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "core/numerics/quadrature.hpp"
#include "core/numerics/solution_limits.hpp"

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

/// Mean of ln(t^2 + b^2) over a cell from `left` to `right`: far away by powers of the cell over the distance, for the
/// antiderivative's digits are lost there.
double mean_log(double left, double right, double b) {
  const double cell = right - left;
  const std::complex<double> middle(0.5 * (left + right), b);  // ln(t^2 + b^2) is the real part of ln((t + ib)^2)
  constexpr double far = 0.02;                                 // cell over distance, whose eighth power is nothing
  if (cell < far * std::abs(middle)) {
    const std::complex<double> ratio = cell / middle, q = ratio * ratio;
    return std::log(std::norm(middle)) - (q * (1.0 / 12 + q * (1.0 / 160 + q / 1344.0))).real();
  }
  return (integrated_log(right, b) - integrated_log(left, b)) / cell;
}

/// Enough Gauss points that the average over a cell of the correction, whose wavelength is about H, is exact to 1e-9.
QuadratureRule averaging_rule(double cell_over_thickness) {
  const double c = cell_over_thickness;
  return gauss_legendre(c < 0.1   ? 2
                        : c < 0.3 ? 3
                        : c < 0.7 ? 4
                        : c < 1.5 ? 6
                                  : checked_count(std::floor(4 * c), "points in a cell") + 4);
}

/// Of the thickness: over a shorter cell two Gauss points give the mean of the correction to 1e-12, and a difference of
/// antiderivatives, which tables have to 5e-13, has lost more.
constexpr double short_cell = 0.01;

}  // namespace

double x_asinh(double x, double y) { return x == 0 ? 0 : x * std::asinh(y / std::abs(x)); }

ElasticKernel::ElasticKernel(int dimension, const Layer& layer, double cell_x, double cell_y)
    : dimension_(dimension), cell_x_(cell_x), cell_y_(cell_y), deep_(half_space_symbols(layer.poisson_ratio)) {
  scales_.line_load = dimension < 3;
  if (std::isinf(layer.thickness)) return;
  scales_ = {layer.thickness, layer_table_end * layer.thickness, true};
  if (dimension == 2) {
    if (cell_x < short_cell * layer.thickness)
      slopes_ = line_slopes(layer.poisson_ratio);
    else
      line_ = line_table(layer.poisson_ratio);
    return;
  }
  const auto fill = [&](double cell, std::vector<double>& nodes, std::vector<double>& weights) {
    const QuadratureRule rule = averaging_rule(cell / layer.thickness);
    weights = rule.weights;
    for (const double node : rule.nodes) nodes.push_back((node - 0.5) * cell);
  };
  fill(cell_x, nodes_x_, weights_x_);
  if (dimension == 1) return;
  radial_ = radial_table(layer.poisson_ratio);
  fill(cell_y, nodes_y_, weights_y_);
}

Coefficients ElasticKernel::operator()(double x, double y) const {
  require_time();
  return dimension_ == 3 ? sphere(x, y) : dimension_ == 2 ? cylinder(x) : along_axle(x);
}

/// ln coth z is -ln z and a smooth function, z = pi |x|/4H.
Coefficients ElasticKernel::along_axle(double x) const {
  Coefficients sum = Coefficients::Zero();
  const double reach = scales_.reach();
  if (std::abs(x) - 0.5 * cell_x_ >= reach) return sum;
  const double right = std::min(x + 0.5 * cell_x_, reach), left = std::max(x - 0.5 * cell_x_, -reach);
  double mean = -0.5 * mean_log(left, right, 0);
  if (!nodes_x_.empty()) {
    const double scale = 0.25 * M_PI / scales_.length;
    mean -= std::log(scale);
    for (std::size_t i = 0; i < nodes_x_.size(); ++i) {
      const double z = scale * std::abs(left + (nodes_x_[i] / cell_x_ + 0.5) * (right - left));
      mean += weights_x_[i] * (z < 1e-4 ? z * z / 3 : std::log(z / std::tanh(z)));
    }
  }
  sum(coefficient::ww) = (right - left) / (cell_x_ * M_PI) * mean;
  return sum;
}

Coefficients ElasticKernel::sphere(double x, double y) const {
  using namespace coefficient;
  Coefficients sum = Coefficients::Zero();
  if (distance(x, y) > scales_.reach()) return sum;
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
  sum(ww) = deep_.normal * (a + b);
  sum(uu) = deep_.longitudinal * a + deep_.transverse * b;
  sum(vv) = deep_.transverse * a + deep_.longitudinal * b;
  sum(uv) = (deep_.longitudinal - deep_.transverse) * (r(0) - r(1) - r(2) + r(3));
  if (deep_.cross != 0) {
    const auto corners = [&](auto&& f) { return f(right, above) - f(right, below) - f(left, above) + f(left, below); };
    sum(uw) = -deep_.cross * corners(integrated_cosine);
    sum(vw) = -deep_.cross * corners([](double p, double q) { return integrated_cosine(q, p); });
  }
  sum /= 2 * M_PI * cell_x_ * cell_y_;
  return radial_ ? Coefficients(sum + sphere_correction(x, y)) : sum;
}

Coefficients ElasticKernel::sphere_correction(double x, double y) const {
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
      inside[p] = std::min(distances[p], scales_.extent) / scales_.length;
    }
    std::array<Eigen::Array4d, together> values = radial_->at(inside);
    for (std::size_t p = 0; p < together; ++p) {
      const double from_load = distances[p], per_distance = from_load > 0 ? 1 / from_load : 0;
      Eigen::Array4d& f = values[p];
      if (from_load >= scales_.extent)  // minus the half-space's part
        f = -Eigen::Array4d(2 * deep_.normal, deep_.longitudinal + deep_.transverse,
                            deep_.longitudinal - deep_.transverse, 2 * deep_.cross) *
            (scales_.length / (4 * M_PI * from_load));
      const double cosine = from_load > 0 ? px[p] * per_distance : 1, sine = py[p] * per_distance;
      const double cosine2 = cosine * cosine - sine * sine, sine2 = 2 * sine * cosine;
      Coefficients value;
      value << f(0), f(1) - cosine2 * f(2), f(1) + cosine2 * f(2), -sine2 * f(2), -cosine * f(3), -sine * f(3);
      correction += weights[p] * value;
    }
  }
  return correction / scales_.length;
}

Coefficients ElasticKernel::cylinder(double x) const {
  using namespace coefficient;
  Coefficients sum = Coefficients::Zero();
  const double reach = scales_.reach();
  if (std::abs(x) > reach) return sum;
  // A cell across the end of the response ends there.
  const double right = std::min(x + 0.5 * cell_x_, reach), left = std::max(x - 0.5 * cell_x_, -reach);
  // Far from the load the length of the cell is lost in the difference of its ends.
  const double share = std::abs(x) + 0.5 * cell_x_ <= reach ? 1 : (right - left) / cell_x_;
  const double logarithm = share * mean_log(left, right, 0) / (2 * M_PI);
  sum(ww) = -deep_.normal * logarithm;
  sum(uu) = -deep_.longitudinal * logarithm;
  const double sign = std::abs(x) >= 0.5 * cell_x_ ? std::copysign(share, x) : 2 * x / cell_x_;
  sum(uw) = -0.5 * deep_.cross * sign;
  if (!line_ && !slopes_) return sum;

  const double known = share * mean_log(left, right, 2 * scales_.length) / (2 * M_PI);
  const Eigen::Array3d correction = line_correction(left, right);
  sum(ww) += correction(0) + deep_.normal * known;
  sum(uu) += correction(1) + deep_.longitudinal * known;
  sum(uw) += correction(2);
  return sum;
}

/// Of the correction less its known part, the integral over what the cell from `left` to `right` has within the reach,
/// over the cell; two components even and one odd in x.
Eigen::Array3d ElasticKernel::line_correction(double left, double right) const {
  const auto at = [&](const auto& table, double x, const Eigen::Array3d& mirror) -> Eigen::Array3d {
    const Eigen::Array3d value = table(std::min(std::abs(x), scales_.extent) / scales_.length);
    return x < 0 ? Eigen::Array3d(mirror * value) : value;
  };
  if (line_) return (at(*line_, right, {-1, -1, 1}) - at(*line_, left, {-1, -1, 1})) * (scales_.length / cell_x_);
  const double middle = 0.5 * (left + right), apart = (right - left) / (2 * std::sqrt(3.0));
  return (at(*slopes_, middle - apart, {1, 1, -1}) + at(*slopes_, middle + apart, {1, 1, -1})) *
         (0.5 * (right - left) / cell_x_);
}

}  // namespace rollres
