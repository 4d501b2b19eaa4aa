#include "core/elastic_kernel.hpp"

#include <cmath>

#include "core/layer_compliance.hpp"
#include "core/quadrature.hpp"

namespace rollres {

namespace {

constexpr double table_end = 30.0;           // r/H
constexpr double highest_wavenumber = 18.0;  // k H: the corrections have fallen to e^{-36}
constexpr int table_panels = 20, table_degree = 15;

/// Nodes and weights in k H for the transforms below.
const QuadratureRule& wavenumber_rule() {
  static const QuadratureRule rule = [] {
    QuadratureRule sum;
    const QuadratureRule gauss = gauss_legendre(20);
    // Panels of kH = 1 hold at most 30 rad of the oscillation at the table's end.
    for (int panel = 0; panel < static_cast<int>(highest_wavenumber); ++panel)
      for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
        sum.nodes.push_back(panel + gauss.nodes[q]);
        sum.weights.push_back(gauss.weights[q]);
      }
    return sum;
  }();
  return rule;
}

/// Radial functions of r/H [1/H]: normal (J0), mean tangential (J0), half difference tangential (J2), cross (J1).
const ChebyshevTable<4>& radial_table() {
  static const ChebyshevTable<4> table(table_end, table_panels, table_degree, [](double r) {
    Eigen::Array4d sum = Eigen::Array4d::Zero();
    const QuadratureRule& rule = wavenumber_rule();
    for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
      const double k = rule.nodes[q], z = k * r;
      const LayerSymbols c = layer_correction(k);
      const double j0 = ::j0(z), j1 = ::j1(z), j2 = z > 1e-2 ? 2 * j1 / z - j0 : z * z / 8 * (1 - z * z / 12);
      sum += rule.weights[q] * k / (2 * M_PI) *
             Eigen::Array4d(c.normal * j0, 0.5 * (c.longitudinal + c.transverse) * j0,
                            0.5 * (c.longitudinal - c.transverse) * j2, c.cross * j1);
    }
    return sum;
  });
  return table;
}

/// Antiderivatives over x/H of the layer's correction to a line load, less the part (1 - e^{-2kH})/(2k) that is known
/// in closed form: normal, longitudinal [1], cross [1].
const ChebyshevTable<3>& line_table() {
  static const ChebyshevTable<3> table(table_end, table_panels, table_degree, [](double x) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    const QuadratureRule& rule = wavenumber_rule();
    for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
      const double k = rule.nodes[q];
      const LayerSymbols c = layer_correction(k);
      const double known = -std::exp(-2 * k) / (2 * k);
      sum += rule.weights[q] / (M_PI * k) *
             Eigen::Array3d((c.normal - known) * std::sin(k * x), (c.longitudinal - known) * std::sin(k * x),
                            -2 * c.cross * std::pow(std::sin(0.5 * k * x), 2));
    }
    return sum;
  });
  return table;
}

double x_asinh(double x, double y) { return x == 0 ? 0 : x * std::asinh(y / std::abs(x)); }

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

ElasticKernel::ElasticKernel(Indenter indenter, double thickness, double cell_x, double cell_y)
    : indenter_(indenter), thickness_(thickness), cell_x_(cell_x), cell_y_(cell_y) {
  if (indenter == Indenter::cylinder || std::isinf(thickness)) return;
  const auto fill = [&](double cell, std::vector<double>& nodes, std::vector<double>& weights) {
    const QuadratureRule rule = averaging_rule(cell / thickness);
    weights = rule.weights;
    for (const double node : rule.nodes) nodes.push_back((node - 0.5) * cell);
  };
  fill(cell_x, nodes_x_, weights_x_);
  fill(cell_y, nodes_y_, weights_y_);
}

double ElasticKernel::reach() const { return table_end * thickness_; }

Coefficients ElasticKernel::operator()(double x, double y) const {
  return indenter_ == Indenter::sphere ? sphere(x, y) : cylinder(x);
}

Coefficients ElasticKernel::sphere(double x, double y) const {
  using namespace coefficient;
  Coefficients sum = Coefficients::Zero();
  if (std::hypot(x, y) > reach()) return sum;
  for (const int sx : {1, -1})
    for (const int sy : {1, -1}) {
      const double cx = x + 0.5 * sx * cell_x_, cy = y + 0.5 * sy * cell_y_;
      const double a = x_asinh(cx, cy), b = x_asinh(cy, cx), sign = sx * sy;
      sum(ww) += sign * (a + b);
      sum(uu) += sign * (a + 2 * b);
      sum(vv) += sign * (2 * a + b);
      sum(uv) -= sign * std::hypot(cx, cy);
    }
  sum /= 4 * M_PI * cell_x_ * cell_y_;
  if (std::isinf(thickness_)) return sum;

  const ChebyshevTable<4>& table = radial_table();
  Coefficients correction = Coefficients::Zero();
  for (std::size_t j = 0; j < nodes_y_.size(); ++j)
    for (std::size_t i = 0; i < nodes_x_.size(); ++i) {
      const double px = x + nodes_x_[i], py = y + nodes_y_[j], r2 = px * px + py * py, r = std::sqrt(r2);
      const double cosine = r > 0 ? px / r : 1, sine = r > 0 ? py / r : 0;
      const double cosine2 = cosine * cosine - sine * sine, sine2 = 2 * sine * cosine;
      const Eigen::Array4d f = table(std::min(r / thickness_, table_end));
      Coefficients value;
      value << f(0), f(1) - cosine2 * f(2), f(1) + cosine2 * f(2), -sine2 * f(2), -cosine * f(3), -sine * f(3);
      correction += weights_x_[i] * weights_y_[j] * value;
    }
  return sum + correction / thickness_;
}

Coefficients ElasticKernel::cylinder(double x) const {
  using namespace coefficient;
  Coefficients sum = Coefficients::Zero();
  if (std::abs(x) > reach()) return sum;
  const double right = x + 0.5 * cell_x_, left = x - 0.5 * cell_x_;
  const double half_space = -(integrated_log(right, 0) - integrated_log(left, 0)) / (4 * M_PI * cell_x_);
  sum(ww) = sum(uu) = half_space;
  if (std::isinf(thickness_)) return sum;

  const double image = 2 * thickness_;
  const double known = (integrated_log(right, image) - integrated_log(left, image)) / (4 * M_PI * cell_x_);
  const ChebyshevTable<3>& table = line_table();
  const auto antiderivative = [&](double t) -> Eigen::Array3d {
    const Eigen::Array3d value = table(std::min(std::abs(t) / thickness_, table_end));
    return t < 0 ? Eigen::Array3d(-value(0), -value(1), value(2)) : value;
  };
  const Eigen::Array3d correction = (antiderivative(right) - antiderivative(left)) * thickness_ / cell_x_;
  sum(ww) += known + correction(0);
  sum(uu) += known + correction(1);
  sum(uw) += correction(2);
  return sum;
}

}  // namespace rollres
