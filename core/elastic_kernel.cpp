#include "core/elastic_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/layer_compliance.hpp"
#include "core/quadrature.hpp"

namespace rollres {

namespace {

constexpr double table_end = 30.0;  // r/H
constexpr int table_degree = 15;

/// Borders of the tables' panels in r/H. The corrections are singular at r/H = +-2i only, so that panels may widen
/// with r.
std::vector<double> table_borders() { return {0, 1.5, 3.5, 6.5, 11, 18.5, table_end}; }

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
    return ChebyshevTable<4>(table_borders(), table_degree, [&](double r) {
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
  if (std::hypot(x, y) > reach()) return sum;
  const double right = x + 0.5 * cell_x_, left = x - 0.5 * cell_x_;
  const double above = y + 0.5 * cell_y_, below = y - 0.5 * cell_y_;
  const double r_ra = distance(right, above), r_rb = distance(right, below);
  const double r_la = distance(left, above), r_lb = distance(left, below);
  double a, b;  // x asinh(y/|x|) and y asinh(x/|y|), differenced over the corners
  if (left > 0 && below > 0) {
    a = right * std::log((above + r_ra) / (below + r_rb)) - left * std::log((above + r_la) / (below + r_lb));
    b = above * std::log((right + r_ra) / (left + r_la)) - below * std::log((right + r_rb) / (left + r_lb));
  } else {
    a = x_asinh(right, above) - x_asinh(right, below) - x_asinh(left, above) + x_asinh(left, below);
    b = x_asinh(above, right) - x_asinh(above, left) - x_asinh(below, right) + x_asinh(below, left);
  }
  sum(ww) = a + b;
  sum(uu) = a + 2 * b;
  sum(vv) = 2 * a + b;
  sum(uv) = -(r_ra - r_rb - r_la + r_lb);
  sum /= 4 * M_PI * cell_x_ * cell_y_;
  if (std::isinf(thickness_)) return sum;

  const ChebyshevTable<4>& table = radial_table();
  Coefficients correction = Coefficients::Zero();
  for (std::size_t j = 0; j < nodes_y_.size(); ++j)
    for (std::size_t i = 0; i < nodes_x_.size(); ++i) {
      const double px = x + nodes_x_[i], py = y + nodes_y_[j], r2 = px * px + py * py, r = std::sqrt(r2);
      const double cosine = r > 0 ? px / r : 1, sine = r > 0 ? py / r : 0;
      const double cosine2 = cosine * cosine - sine * sine, sine2 = 2 * sine * cosine;
      // Beyond the table the correction cancels the half-space's part.
      const Eigen::Array4d f = r < table_end * thickness_
                                   ? table(r / thickness_)
                                   : Eigen::Array4d(Eigen::Array4d(-2, -3, 1, 0) * thickness_ / (8 * M_PI * r));
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
