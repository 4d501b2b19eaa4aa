#include "core/layer_slopes.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "core/layer_compliance.hpp"
#include "core/memory_functions.hpp"
#include "core/quadrature.hpp"

namespace rollres {

namespace {

// The corrections are singular at x/H = +-2i only, so that panels may widen with the distance.
constexpr std::array<double, 8> borders{0, 1.2, 3, 6, 11, 19, 31, layer_reach};
constexpr int panels = static_cast<int>(borders.size()) - 1, degree = 19, terms = degree + 1;

struct Panel {
  int index;
  double place;  // in [-1, 1]
};
Panel find_panel(double r) {
  int index = 0;
  while (index + 1 < panels && r > borders[static_cast<std::size_t>(index) + 1]) ++index;
  const double start = borders[static_cast<std::size_t>(index)], end = borders[static_cast<std::size_t>(index) + 1];
  return {index, 2 * (r - start) / (end - start) - 1};
}

LayerSlopes clenshaw(const LayerSlopes* c, double t) {
  LayerSlopes b1 = LayerSlopes::Zero(), b2 = LayerSlopes::Zero();
  for (int k = degree; k > 0; --k) {
    const LayerSlopes b0 = c[k] + 2 * t * b1 - b2;
    b2 = b1;
    b1 = b0;
  }
  return c[0] + t * b1 - b2;
}

/// The corrections for H = 1, r > 0, by quadrature over wavenumbers.
LayerSlopes transformed(double r) {
  static const QuadratureRule gauss = gauss_legendre(10 + static_cast<int>(0.5 * layer_reach));
  LayerSlopes sum = LayerSlopes::Zero();
  for (int start = 0; start < 18; ++start)
    for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
      const double k = start + gauss.nodes[q], sine = std::sin(k * r), cosine = std::cos(k * r);
      const LayerSymbols c = layer_correction(k);
      sum -= gauss.weights[q] * k / M_PI * LayerSlopes(c.normal * sine, c.longitudinal * sine, c.cross * cosine, 0);
    }
  return sum;
}

struct SlopeTable {
  std::array<LayerSlopes, panels * terms> slopes, displacements;  // d displacement/dx = slope

  SlopeTable() {
    for (int panel = 0; panel < panels; ++panel) {
      const auto p = static_cast<std::size_t>(panel);
      const double middle = 0.5 * (borders[p] + borders[p + 1]), half = 0.5 * (borders[p + 1] - borders[p]);
      LayerSlopes* c = &slopes[p * terms];
      for (int k = 0; k < terms; ++k) c[k].setZero();
      for (int node = 0; node < terms; ++node) {
        const double angle = M_PI * (node + 0.5) / terms;
        const LayerSlopes value = transformed(middle + half * std::cos(angle));
        for (int k = 0; k < terms; ++k) c[k] += (k == 0 ? 1.0 : 2.0) / terms * std::cos(k * angle) * value;
      }
    }
    const double ahead = std::log(layer_reach) / (2 * M_PI);
    LayerSlopes end_value(ahead, ahead, 0, 0);
    for (int panel = panels - 1; panel >= 0; --panel) {
      const auto p = static_cast<std::size_t>(panel);
      const double half = 0.5 * (borders[p + 1] - borders[p]);
      const LayerSlopes* slope = &slopes[p * terms];
      LayerSlopes* c = &displacements[p * terms];
      LayerSlopes at_end = LayerSlopes::Zero(), at_start = LayerSlopes::Zero();
      for (int k = 1; k < terms; ++k) {
        c[k] = half / (2 * k) * (k == 1 ? 2 * slope[0] : slope[k - 1]);
        if (k + 1 < terms) c[k] -= half / (2 * k) * slope[k + 1];
        at_end += c[k];
        at_start += k % 2 ? LayerSlopes(-c[k]) : c[k];
      }
      c[0] = end_value - at_end;
      end_value += at_start - at_end;
    }
  }
};

const SlopeTable& slope_table() {
  static const SlopeTable table;
  return table;
}

}  // namespace

LayerSlopes layer_slope_correction(double x, double thickness) {
  const double r = std::abs(x) / thickness;
  LayerSlopes values(1 / (2 * M_PI * r), 1 / (2 * M_PI * r), 0, 0);
  if (r < layer_reach) {
    const auto [panel, place] = find_panel(r);
    values = clenshaw(&slope_table().slopes[static_cast<std::size_t>(panel * terms)], place);
  }
  if (x < 0) values.head<2>() = -values.head<2>();
  return values / thickness;
}

LayerSlopes layer_displacement_correction(double x, double thickness) {
  const double r = std::abs(x) / thickness;
  LayerSlopes values(std::log(r) / (2 * M_PI), std::log(r) / (2 * M_PI), 0, 0);
  if (r < layer_reach) {
    const auto [panel, place] = find_panel(r);
    values = clenshaw(&slope_table().displacements[static_cast<std::size_t>(panel * terms)], place);
  }
  values.head<2>() += std::log(thickness) / (2 * M_PI);
  if (x < 0) values(2) = -values(2);
  return values;
}

LayerMemory::LayerMemory(double thickness, double memory_length)
    : thickness_(thickness), memory_length_(memory_length), coefficients_(2 * panels * terms) {
  // F - T F' = f from far ahead to far behind, panel by panel, in Chebyshev coefficients: those of F' are the unknowns
  // v, F_k = (v_{k-1} - v_{k+1})/2k, and F is continuous.
  using Matrix = Eigen::Matrix<double, terms, terms>;
  const SlopeTable& table = slope_table();
  const double length = memory_length / thickness;
  const double ahead = scaled_exponential_integral(layer_reach / length) / (2 * M_PI * length);
  LayerSlopes end_value(ahead, ahead, 0, 0);
  for (int panel = 2 * panels - 1; panel >= 0; --panel) {
    const bool mirrored = panel < panels;
    const auto p = static_cast<std::size_t>(mirrored ? panels - 1 - panel : panel - panels);
    const double half = 0.5 * (borders[p + 1] - borders[p]), ratio = length / half;
    Eigen::Matrix<double, terms, 4> right;
    for (int k = 0; k < terms; ++k) {
      // Mirrored: normal and tangential odd in x, cross even, T_k(-t) = (-1)^k T_k(t).
      const double parity = mirrored && k % 2 ? -1 : 1, odd = mirrored ? -1 : 1;
      const LayerSlopes& c = table.slopes[p * terms + static_cast<std::size_t>(k)];
      right.row(k) << parity * odd * c(0), parity * odd * c(1), parity * c(2), 0;
    }
    Matrix integration = Matrix::Zero();  // F_k from v for k >= 1; F_0 makes F(1) the value at the end
    for (int k = 1; k < terms; ++k) {
      integration(k, k - 1) += (k == 1 ? 2.0 : 1.0) / (2 * k);
      if (k + 1 < terms) integration(k, k + 1) -= 1.0 / (2 * k);
    }
    integration.row(0) = -integration.bottomRows<degree>().colwise().sum();
    Matrix system = integration;
    system.diagonal().array() -= ratio;
    right.row(0) -= end_value.matrix().transpose();
    const Eigen::Matrix<double, terms, 4> slope = system.partialPivLu().solve(right);
    Eigen::Matrix<double, terms, 4> value = integration * slope;
    value.row(0) += end_value.matrix().transpose();
    LayerSlopes* c = &coefficients_[static_cast<std::size_t>(panel * terms)];
    LayerSlopes at_start = LayerSlopes::Zero();
    for (int k = 0; k < terms; ++k) {
      c[k] = value.row(k).transpose().array();
      at_start += k % 2 ? LayerSlopes(-c[k]) : c[k];
    }
    end_value = at_start;
  }
}

LayerSlopes LayerMemory::operator()(double x) const {
  const double r = x / thickness_;
  if (r >= layer_reach) {
    const double ahead =
        scaled_exponential_integral(x / memory_length_) / (2 * M_PI * memory_length_);
    return {ahead, ahead, 0, 0};
  }
  auto [panel, place] = find_panel(std::abs(r));
  panel += panels;
  if (r < 0) {
    panel = 2 * panels - 1 - panel;
    place = -place;
  }
  return clenshaw(&coefficients_[static_cast<std::size_t>(panel * terms)], place) / thickness_;
}

}  // namespace rollres
