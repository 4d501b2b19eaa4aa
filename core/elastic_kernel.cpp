#include "core/elastic_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/layer_compliance.hpp"
#include "core/quadrature.hpp"

namespace rollres {

namespace {

constexpr double table_end = 30.0;  // r/H
constexpr int table_degree = 15;    // of the series that is sampled,
constexpr int fast_degree = 9;      // and of the one that is used, on narrower panels

/// Borders of the tables' panels in r/H. The corrections are singular at r/H = +-2i only, so that panels may widen
/// with r.
std::vector<double> table_borders() { return {0, 1.5, 3.5, 6.5, 11, 18.5, table_end}; }

std::vector<double> fast_borders() {
  return {0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9.5, 11, 13, 15.5, 18.5, 22, 26, table_end};
}

/// A wavenumber of the transforms below with its weight and the layer's symbols.
struct WavenumberNode {
  double wavenumber, weight;  // times H
  LayerSymbols symbols;
};

/// Gauss panels of k H = 1 up to 16, where the corrections have fallen to e^{-32}; an oscillation of r rad within one
/// takes about r/2 nodes more.
std::vector<WavenumberNode> wavenumber_nodes(double r) {
  std::vector<WavenumberNode> nodes;
  const QuadratureRule gauss = gauss_legendre(10 + static_cast<int>(0.5 * r));
  for (int panel = 0; panel < 16; ++panel)
    for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
      const double k = panel + gauss.nodes[q];
      nodes.push_back({k, gauss.weights[q], layer_correction(k)});
    }
  return nodes;
}

/// Wavenumber nodes fit for every r up to the panel's end, kept for the panel's samples.
class WavenumberNodes {
 public:
  const std::vector<WavenumberNode>& operator()(double r) {
    const std::vector<double> borders = table_borders();
    const double end = *std::lower_bound(borders.begin(), borders.end(), r);
    if (end != end_) {
      nodes_ = wavenumber_nodes(end);
      end_ = end;
    }
    return nodes_;
  }

 private:
  double end_ = -1;
  std::vector<WavenumberNode> nodes_;
};

/// Radial functions of r/H [1/H]: normal (J0), mean tangential (J0), half difference tangential (J2), cross (J1).
const ChebyshevTable<4>& radial_table() {
  static const ChebyshevTable<4> table = [] {
    WavenumberNodes nodes;
    const ChebyshevTable<4> sampled(table_borders(), table_degree, [&](double r) {
      Eigen::Array4d sum = Eigen::Array4d::Zero();
      for (const auto& [k, weight, c] : nodes(r)) {
        const double z = k * r, j0 = ::j0(z), j1 = ::j1(z);
        const double j2 = z > 1e-2 ? 2 * j1 / z - j0 : z * z / 8 * (1 - z * z / 12);
        sum += weight * k / (2 * M_PI) *
               Eigen::Array4d(c.normal * j0, 0.5 * (c.longitudinal + c.transverse) * j0,
                              0.5 * (c.longitudinal - c.transverse) * j2, c.cross * j1);
      }
      return sum;
    });
    return ChebyshevTable<4>(fast_borders(), fast_degree, [&](double r) { return sampled(r); });
  }();
  return table;
}

/// Antiderivatives over x/H of the layer's correction to a line load, less the part (1 - e^{-2kH})/(2k) that is known
/// in closed form: normal, longitudinal [1], cross [1].
const ChebyshevTable<3>& line_table() {
  static const ChebyshevTable<3> table = [] {
    WavenumberNodes nodes;
    return ChebyshevTable<3>(table_borders(), table_degree, [&](double x) {
      Eigen::Array3d sum = Eigen::Array3d::Zero();
      for (const auto& [k, weight, c] : nodes(x)) {
        const double known = -std::exp(-2 * k) / (2 * k), sine = std::sin(k * x), half_sine = std::sin(0.5 * k * x);
        sum += weight / (M_PI * k) *
               Eigen::Array3d((c.normal - known) * sine, (c.longitudinal - known) * sine,
                              -2 * c.cross * half_sine * half_sine);
      }
      return sum;
    });
  }();
  return table;
}

double distance(double x, double y) { return std::sqrt(x * x + y * y); }

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
  if (distance(x, y) > reach()) return sum;
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
  sum(ww) = a + b;
  sum(uu) = a + 2 * b;
  sum(vv) = 2 * a + b;
  sum(uv) = -(r(0) - r(1) - r(2) + r(3));
  sum /= 4 * M_PI * cell_x_ * cell_y_;
  if (std::isinf(thickness_)) return sum;

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
      inside[p] = std::min(distances[p] / thickness_, table_end);
    }
    std::array<Eigen::Array4d, together> values = radial_table().at(inside);
    for (std::size_t p = 0; p < together; ++p) {
      const double from_load = distances[p], per_distance = from_load > 0 ? 1 / from_load : 0;
      Eigen::Array4d& f = values[p];
      // Beyond the table the correction cancels the half-space's part.
      if (from_load >= table_end * thickness_) f = Eigen::Array4d(-2, -3, 1, 0) * thickness_ / (8 * M_PI * from_load);
      const double cosine = from_load > 0 ? px[p] * per_distance : 1, sine = py[p] * per_distance;
      const double cosine2 = cosine * cosine - sine * sine, sine2 = 2 * sine * cosine;
      Coefficients value;
      value << f(0), f(1) - cosine2 * f(2), f(1) + cosine2 * f(2), -sine2 * f(2), -cosine * f(3), -sine * f(3);
      correction += weights[p] * value;
    }
  }
  return sum + correction / thickness_;
}

Coefficients ElasticKernel::cylinder(double x) const {
  using namespace coefficient;
  Coefficients sum = Coefficients::Zero();
  if (std::abs(x) > reach()) return sum;
  // A cell across the end of the response ends there.
  const double right = std::min(x + 0.5 * cell_x_, reach()), left = std::max(x - 0.5 * cell_x_, -reach());
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
