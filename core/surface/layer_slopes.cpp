#include "core/surface/layer_slopes.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <span>

#include "core/algebra/dense_algebra.hpp"
#include "core/numerics/chebyshev.hpp"
#include "core/numerics/memory_functions.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/surface/layer_compliance.hpp"

namespace rollres {

namespace {

// The corrections are singular at x/H = +-2i only, so that panels may widen with the distance.
constexpr std::array<double, 8> borders{0, 1.2, 3, 6, 11, 19, 31, layer_reach};
constexpr int panels = static_cast<int>(borders.size()) - 1, degree = 19, coefficients_of_panel = degree + 1;

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
  return chebyshev_sum(std::span<const LayerSlopes>(c, coefficients_of_panel), t);
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
  std::array<LayerSlopes, panels * coefficients_of_panel> slopes, displacements;  // d displacement/dx = slope

  SlopeTable() {
    for (int panel = 0; panel < panels; ++panel) {
      const auto p = static_cast<std::size_t>(panel);
      const double middle = 0.5 * (borders[p] + borders[p + 1]), half = 0.5 * (borders[p + 1] - borders[p]);
      const std::vector<LayerSlopes> c = chebyshev_fit(coefficients_of_panel).series<LayerSlopes>([&](double t) {
        return transformed(middle + half * t);
      });
      std::copy(c.begin(), c.end(), slopes.begin() + static_cast<std::ptrdiff_t>(p * coefficients_of_panel));
    }
    const double ahead = std::log(layer_reach) / (2 * M_PI);
    LayerSlopes end_value(ahead, ahead, 0, 0);
    for (int panel = panels - 1; panel >= 0; --panel) {
      const auto p = static_cast<std::size_t>(panel);
      const double half = 0.5 * (borders[p + 1] - borders[p]);
      const LayerSlopes* slope = &slopes[p * coefficients_of_panel];
      LayerSlopes* c = &displacements[p * coefficients_of_panel];
      LayerSlopes at_end = LayerSlopes::Zero(), at_start = LayerSlopes::Zero();
      for (int k = 1; k < coefficients_of_panel; ++k) {
        c[k] = half / (2 * k) * (k == 1 ? 2 * slope[0] : slope[k - 1]);
        if (k + 1 < coefficients_of_panel) c[k] -= half / (2 * k) * slope[k + 1];
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

/// The slopes once more, as polynomials on narrow panels of equal width: faster, for single values.
class FastTable {
 public:
  FastTable() {
    Eigen::MatrixXd powers(count, count);
    const Eigen::VectorXd& nodes = chebyshev_fit(count).nodes;
    for (int k = 0; k < count; ++k) powers.col(k) = nodes.array().pow(k);
    const SquareSystem to_powers(powers);
    for (int panel = 0; panel < fast_panels; ++panel) {
      Eigen::MatrixXd values(count, 4);
      for (int node = 0; node < count; ++node) {
        const auto [wide, place] = find_panel((panel + 0.5 + 0.5 * nodes(node)) * width);
        values.row(node) =
            clenshaw(&slope_table().slopes[static_cast<std::size_t>(wide * coefficients_of_panel)], place).transpose();
      }
      const Eigen::MatrixXd c = to_powers.solve(values);
      for (int k = 0; k < count; ++k) coefficients_[static_cast<std::size_t>(panel * count + k)] = c.row(k).transpose();
    }
  }

  LayerSlopes operator()(double r) const {
    const double scaled = r / width;
    const int panel = static_cast<int>(scaled);
    const double t = 2 * (scaled - panel) - 1;
    const LayerSlopes* c = &coefficients_[static_cast<std::size_t>(panel * count)];
    const double t2 = t * t, t4 = t2 * t2;
    return (c[0] + t * c[1] + t2 * (c[2] + t * c[3])) +
           t4 * ((c[4] + t * c[5] + t2 * (c[6] + t * c[7])) + t4 * (c[8] + t * c[9]));
  }

 private:
  static constexpr int count = 10, fast_panels = 192;
  static constexpr double width = layer_reach / fast_panels;
  std::array<LayerSlopes, count * fast_panels> coefficients_;
};

}  // namespace

LayerSlopes layer_slope_correction(double x, double thickness) {
  const double r = std::abs(x) / thickness;
  LayerSlopes values(1 / (2 * M_PI * r), 1 / (2 * M_PI * r), 0, 0);
  static const FastTable table;
  if (r < layer_reach) values = table(r);
  if (x < 0) values.head<2>() = -values.head<2>();
  return values / thickness;
}

LayerSlopes layer_displacement_correction(double x, double thickness) {
  const double r = std::abs(x) / thickness;
  LayerSlopes values(std::log(r) / (2 * M_PI), std::log(r) / (2 * M_PI), 0, 0);
  if (r < layer_reach) {
    const auto [panel, place] = find_panel(r);
    values = clenshaw(&slope_table().displacements[static_cast<std::size_t>(panel * coefficients_of_panel)], place);
  }
  values.head<2>() += std::log(thickness) / (2 * M_PI);
  if (x < 0) values(layer_slope::cross) = -values(layer_slope::cross);
  return values;
}

LayerMemory::LayerMemory(double thickness, double memory_length)
    : thickness_(thickness), memory_length_(memory_length), coefficients_(panels * coefficients_of_panel) {
  const double length = memory_length / thickness;
  const double ahead = scaled_exponential_integral(layer_reach / length) / (2 * M_PI * length);
  LayerSlopes end_value(ahead, ahead, 0, 0);
  march(end_value, panels - 1, 0);
}

/// F - T F' = f from ahead to behind, panel by panel (negative numbers: the mirrored ones), in Chebyshev coefficients:
/// those of F' are the unknowns v, F_k = (v_{k-1} - v_{k+1})/2k, and F is continuous.
void LayerMemory::march(LayerSlopes end_value, int first, int last) {
  using Matrix = Eigen::Matrix<double, coefficients_of_panel, coefficients_of_panel>;
  const SlopeTable& table = slope_table();
  const double length = memory_length_ / thickness_;
  for (int panel = first; panel >= last; --panel) {
    const bool mirrored = panel < 0;
    const auto p = static_cast<std::size_t>(mirrored ? -1 - panel : panel);
    const double half = 0.5 * (borders[p + 1] - borders[p]), ratio = length / half;
    Eigen::Matrix<double, coefficients_of_panel, 4> right;
    for (int k = 0; k < coefficients_of_panel; ++k) {
      // Mirrored: normal and tangential odd in x, cross even, T_k(-t) = (-1)^k T_k(t).
      const double parity = mirrored && k % 2 ? -1 : 1, odd = mirrored ? -1 : 1;
      const LayerSlopes& c = table.slopes[p * coefficients_of_panel + static_cast<std::size_t>(k)];
      right.row(k) << parity * odd * c(layer_slope::normal), parity * odd * c(layer_slope::tangential),
          parity * c(layer_slope::cross), 0;
    }
    Matrix integration = Matrix::Zero();  // F_k from v for k >= 1; F_0 makes F(1) the value at the end
    for (int k = 1; k < coefficients_of_panel; ++k) {
      integration(k, k - 1) += (k == 1 ? 2.0 : 1.0) / (2 * k);
      if (k + 1 < coefficients_of_panel) integration(k, k + 1) -= 1.0 / (2 * k);
    }
    integration.row(0) = -integration.bottomRows<degree>().colwise().sum();
    Matrix system = integration;
    system.diagonal().array() -= ratio;
    right.row(0) -= end_value.matrix().transpose();
    const Eigen::Matrix<double, coefficients_of_panel, 4> slope = system.partialPivLu().solve(right);
    Eigen::Matrix<double, coefficients_of_panel, 4> value = integration * slope;
    value.row(0) += end_value.matrix().transpose();
    LayerSlopes* c = mirrored ? &behind_[p * coefficients_of_panel] : &coefficients_[p * coefficients_of_panel];
    LayerSlopes at_start = LayerSlopes::Zero();
    for (int k = 0; k < coefficients_of_panel; ++k) {
      c[k] = value.row(k).transpose().array();
      at_start += k % 2 ? LayerSlopes(-c[k]) : c[k];
    }
    end_value = at_start;
  }
}

LayerSlopes LayerMemory::operator()(double x) const {
  const double r = x / thickness_;
  if (r >= layer_reach) {
    const double ahead = scaled_exponential_integral(x / memory_length_) / (2 * M_PI * memory_length_);
    return {ahead, ahead, 0, 0};
  }
  const auto [panel, place] = find_panel(std::abs(r));
  const auto first = static_cast<std::size_t>(panel * coefficients_of_panel);
  if (r >= 0) return clenshaw(&coefficients_[first], place) / thickness_;
  if (behind_.empty()) {
    LayerMemory complete = *this;
    complete.behind_.resize(panels * coefficients_of_panel);
    LayerSlopes at_zero = LayerSlopes::Zero();
    for (int k = 0; k < coefficients_of_panel; ++k)
      at_zero += (k % 2 ? -1 : 1) * coefficients_[static_cast<std::size_t>(k)];
    complete.march(at_zero, -1, -panels);
    behind_ = std::move(complete.behind_);
  }
  return clenshaw(&behind_[first], -place) / thickness_;
}

}  // namespace rollres
