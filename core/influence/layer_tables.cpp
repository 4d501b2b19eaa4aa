#include "core/influence/layer_tables.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/numerics/quadrature.hpp"
#include "core/numerics/recently_made.hpp"
#include "core/surface/layer_compliance.hpp"

namespace rollres {

namespace {

constexpr double table_end = layer_table_end;
constexpr int table_degree = 15;  // of the series that is sampled,
constexpr int fast_degree = 9;    // and of the one that is used, on narrower panels

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
std::vector<WavenumberNode> wavenumber_nodes(double r, double poisson_ratio) {
  std::vector<WavenumberNode> nodes;
  const QuadratureRule gauss = gauss_legendre(10 + static_cast<int>(0.5 * r));
  for (int panel = 0; panel < 16; ++panel)
    for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
      const double k = panel + gauss.nodes[q];
      nodes.push_back({k, gauss.weights[q], layer_correction(k, poisson_ratio)});
    }
  return nodes;
}

/// Wavenumber nodes fit for every r up to the panel's end, kept for the panel's samples.
class WavenumberNodes {
 public:
  explicit WavenumberNodes(double poisson_ratio) : poisson_ratio_(poisson_ratio) {}
  const std::vector<WavenumberNode>& operator()(double r) {
    const std::vector<double> borders = table_borders();
    const double end = *std::lower_bound(borders.begin(), borders.end(), r);
    if (end != end_) {
      nodes_ = wavenumber_nodes(end, poisson_ratio_);
      end_ = end;
    }
    return nodes_;
  }

 private:
  double poisson_ratio_, end_ = -1;
  std::vector<WavenumberNode> nodes_;
};

RadialTable make_radial_table(double poisson_ratio) {
  WavenumberNodes nodes(poisson_ratio);
  const RadialTable sampled(table_borders(), table_degree, [&](double r) {
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
  return RadialTable(fast_borders(), fast_degree, [&](double r) { return sampled(r); });
}

LineTable make_line_table(double poisson_ratio) {
  WavenumberNodes nodes(poisson_ratio);
  const double deep = half_space_symbols(poisson_ratio).normal;
  return LineTable(table_borders(), table_degree, [&](double x) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (const auto& [k, weight, c] : nodes(x)) {
      const double known = -deep * std::exp(-2 * k) / k, sine = std::sin(k * x), half_sine = std::sin(0.5 * k * x);
      sum += weight / (M_PI * k) *
             Eigen::Array3d((c.normal - known) * sine, (c.longitudinal - known) * sine,
                            -2 * c.cross * half_sine * half_sine);
    }
    return sum;
  });
}

LineSlopes make_line_slopes(double poisson_ratio) {
  WavenumberNodes nodes(poisson_ratio);
  const double deep = half_space_symbols(poisson_ratio).normal;
  return LineSlopes(table_borders(), table_degree, [&](double x) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (const auto& [k, weight, c] : nodes(x)) {
      const double known = -deep * std::exp(-2 * k) / k, cosine = std::cos(k * x);
      sum += weight / M_PI *
             Eigen::Array3d((c.normal - known) * cosine, (c.longitudinal - known) * cosine, -c.cross * std::sin(k * x));
    }
    return sum;
  });
}

/// Tables made on demand, by Poisson's ratio; the most recently used are kept.
template <class Table>
std::shared_ptr<const Table> kept_table(double poisson_ratio, Table (*make)(double)) {
  static const auto incompressible = std::make_shared<const Table>(make(0.5));
  if (poisson_ratio == 0.5) return incompressible;
  static RecentlyMade<double, Table, 16> cache;
  return cache(poisson_ratio, [&] { return make(poisson_ratio); });
}

}  // namespace

std::shared_ptr<const RadialTable> radial_table(double poisson_ratio) {
  return kept_table<RadialTable>(poisson_ratio, make_radial_table);
}

std::shared_ptr<const LineTable> line_table(double poisson_ratio) {
  return kept_table<LineTable>(poisson_ratio, make_line_table);
}

std::shared_ptr<const LineSlopes> line_slopes(double poisson_ratio) {
  return kept_table<LineSlopes>(poisson_ratio, make_line_slopes);
}

}  // namespace rollres
