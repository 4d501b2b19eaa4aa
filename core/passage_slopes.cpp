#include "core/passage_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "core/quadrature.hpp"
#include "core/wavenumber_fade.hpp"

namespace rollres {

namespace {

using complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr int degree = 19, terms = degree + 1;
constexpr double highest_wavenumber = 18;  // times the depth: e^{-36}
constexpr double panel_growth = 1.6;       // of distances, as of the first ones
constexpr std::array<double, 7> first_borders{1.2, 3, 6, 11, 19, 31, 48};

/// The Chebyshev nodes of a panel, and the series from values there.
struct PanelNodes {
  Eigen::ArrayXd place{terms};
  MatrixXd to_series{terms, terms};

  PanelNodes() {
    for (int node = 0; node < terms; ++node) {
      const double angle = M_PI * (node + 0.5) / terms;
      place(node) = std::cos(angle);
      for (int k = 0; k < terms; ++k) to_series(k, node) = (k == 0 ? 1.0 : 2.0) / terms * std::cos(k * angle);
    }
  }
};

const PanelNodes& panel_nodes() {
  static const PanelNodes nodes;
  return nodes;
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

}  // namespace

PassageSlopes::PassageSlopes(const RollingScene& scene, const CreepSpectrum& deep)
    : surface_(scene), deep_(deep), depth_(nearest_interface(scene)), rigid_base_(has_rigid_base(scene)) {
  double longest = finite_thickness(scene);
  for (const CreepSpectrum::Term& term : deep.terms) memory_lengths_.push_back(scene.speed * term.time / depth_);
  // Bending of a stiff layer on a soft one: its length is the thickness times the cube root of their moduli's ratio.
  longest *= std::cbrt(surface_.contrast());
  longest_wave_ = std::max(longest, scene.speed * surface_.longest_time());
}

/// Wavenumbers times the depth, and there i w s/pi and the like for each function: the values at x are
/// Re sum factors e^{i k x}.
struct PassageSlopes::WaveRule {
  Eigen::ArrayXd k;
  MatrixXd real, imaginary;  // [node, 3 * function + component]
};

PassageSlopes::WaveRule PassageSlopes::wave_rule(double from, double to) const {
  const WavenumberFade fade(from);
  const double end = std::min(highest_wavenumber, fade.to);
  std::vector<double> nodes, weights;
  const double lowest = 0.1 * depth_ / longest_wave_;
  double start = 0;
  for (double stop = std::min(lowest, 0.5); start < end; start = stop, stop = std::min(2 * stop, stop + 1)) {
    const double width = std::min(stop, end) - start;
    const QuadratureRule& gauss = gauss_rule(11 + static_cast<int>(0.3 * width * to));
    for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
      nodes.push_back(start + width * gauss.nodes[q]);
      weights.push_back(width * gauss.weights[q] * fade(nodes.back()));
    }
  }
  const auto count = static_cast<Index>(nodes.size());
  const auto functions = static_cast<Index>(first_memory_ + memory_lengths_.size());
  WaveRule rule{Eigen::Map<Eigen::ArrayXd>(nodes.data(), count), MatrixXd(count, 3 * functions),
                MatrixXd(count, 3 * functions)};
  constexpr complex i(0, 1);
  for (Index q = 0; q < count; ++q) {
    const double k = rule.k(q), along = k / depth_, weight = weights[static_cast<std::size_t>(q)] / M_PI;
    const SteadySurface::Moduli moduli = surface_.moduli(along);
    const SurfaceCompliance c = surface_(moduli, along, 0), c_deep = surface_.half_spaces(moduli);
    const complex per_deep = 1.0 / deep_(-along * surface_.speed());
    const complex normal = (along * c.normal - c_deep.normal) * per_deep;
    const complex tangential = (along * c.longitudinal - c_deep.longitudinal) * per_deep;
    const complex cross = (along * c.cross - c_deep.cross) * per_deep;
    const auto put = [&](std::size_t function, const complex& n, const complex& t, const complex& x) {
      const Index at = 3 * static_cast<Index>(function);
      rule.real.row(q).segment<3>(at) << n.real(), t.real(), x.real();
      rule.imaginary.row(q).segment<3>(at) << n.imag(), t.imag(), x.imag();
    };
    put(slopes_, i * weight * normal, i * weight * tangential, -weight * cross);
    // With the half-space's -ln|x|/(2 pi) but for its long waves, which ln(x^2 + 4 depth^2)/(4 pi) takes.
    const double half_space = 0.5 * std::exp(-2 * k);
    put(displacements_, weight / k * (normal + half_space), weight / k * (tangential + half_space),
        i * (weight / k) * cross);
    for (std::size_t m = 0; m < memory_lengths_.size(); ++m) {
      const complex mean = weight / (1.0 - i * k * memory_lengths_[m]);
      put(first_memory_ + m, i * mean * normal, i * mean * tangential, -mean * cross);
    }
  }
  return rule;
}

PassageSlopes::PanelPair PassageSlopes::made(double from, double to) const {
  const WaveRule rule = wave_rule(from, to);
  const PanelNodes& nodes = panel_nodes();
  const Eigen::ArrayXd x = from + 0.5 * (to - from) * (1 + nodes.place);
  const Eigen::ArrayXXd phase = (x.matrix() * rule.k.matrix().transpose()).array();
  const MatrixXd even = nodes.to_series * (phase.cos().matrix() * rule.real);
  const MatrixXd odd = nodes.to_series * (phase.sin().matrix() * rule.imaginary);
  PanelPair pair;
  for (const int side : {0, 1}) {
    const MatrixXd series = side == 0 ? MatrixXd(even - odd) : MatrixXd(even + odd);
    std::vector<LayerSlopes>& c = pair.coefficients[static_cast<std::size_t>(side)];
    for (Index function = 0; 3 * function < series.cols(); ++function)
      for (Index k = 0; k < terms; ++k)
        c.emplace_back(series(k, 3 * function), series(k, 3 * function + 1), series(k, 3 * function + 2), 0);
  }
  return pair;
}

LayerSlopes PassageSlopes::value(std::size_t function, double x) const {
  const double r = std::abs(x) / depth_;
  while (borders_.back() < r)
    borders_.push_back(borders_.size() <= first_borders.size() ? first_borders[borders_.size() - 1]
                                                               : panel_growth * borders_.back());
  std::size_t panel = 0;
  while (panel + 2 < borders_.size() && r > borders_[panel + 1]) ++panel;
  if (panels_.size() <= panel) panels_.resize(panel + 1);
  const double from = borders_[panel], to = borders_[panel + 1];
  PanelPair& pair = panels_[panel];
  if (pair.coefficients[0].empty()) pair = made(from, to);
  return clenshaw(&pair.coefficients[x < 0 ? 1 : 0][function * terms], 2 * (r - from) / (to - from) - 1);
}

LayerSlopes PassageSlopes::displacement(double x) const {
  if (!rigid_base_) return LayerSlopes::Constant(NAN);
  LayerSlopes sum = value(displacements_, x);
  sum.head<2>() += std::log(x * x + 4 * depth_ * depth_) / (4 * M_PI);
  return sum;
}

}  // namespace rollres
