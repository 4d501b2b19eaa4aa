#include "core/surface/earlier_turns.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/chebyshev.hpp"
#include "core/numerics/quadrature.hpp"

namespace rollres {

namespace {

using complex = std::complex<double>;
using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

/// Nodes n = k R of the sum less those of the integral, and their weights. The earlier turns are at least 2 pi - reach
/// radii away.
struct HarmonicRule {
  std::vector<double> nodes, weights;

  explicit HarmonicRule(double lowest) {
    constexpr double nearest = 2;
    const WavenumberFade fade(nearest);
    // Functions may grow like i/k, of hoops that do not close: their limit is in sin(k x).
    constexpr double almost_none = 1e-6;
    nodes.push_back(almost_none * lowest);
    weights.push_back(0.5);
    for (double n = 1; n < fade.to; ++n) {
      nodes.push_back(n);
      weights.push_back(fade(n));
    }
    const WavenumberRule integral(lowest, fade.to, nearest, EarlierTurns::reach);
    nodes.insert(nodes.end(), integral.nodes.begin(), integral.nodes.end());
    for (const double weight : integral.weights) weights.push_back(-weight);
  }
};

}  // namespace

EarlierTurns::EarlierTurns(double radius, double longest_wave, std::size_t functions, Index components,
                           const FourierTable::Transform& of_wavenumber, Index from_origin)
    : radius_(radius) {
  const HarmonicRule rule(0.1 * radius / longest_wave);
  const auto count = static_cast<Index>(rule.nodes.size()), columns = components * static_cast<Index>(functions);
  MatrixXd real(count, columns), imaginary(count, columns);
  Eigen::ArrayXcd values(columns);
  for (Index q = 0; q < count; ++q) {
    const auto at = static_cast<std::size_t>(q);
    of_wavenumber(rule.nodes[at] / radius, {values.data(), static_cast<std::size_t>(columns)});
    values *= rule.weights[at] / radius;
    real.row(q) = values.real();
    imaginary.row(q) = values.imag();
  }
  const ChebyshevFit& fit = chebyshev_fit(nodes_);
  const ArrayXd n = Eigen::Map<const ArrayXd>(rule.nodes.data(), count);
  const Eigen::ArrayXXd phase = (reach * fit.nodes * n.matrix().transpose()).array();
  MatrixXd values_at = phase.cos().matrix() * real - phase.sin().matrix() * imaginary;
  for (Index column = from_origin; column >= 0 && column < columns; column += components)
    values_at.col(column) = -2 * (0.5 * phase).sin().square().matrix() * real.col(column) -  // cos - 1
                            phase.sin().matrix() * imaginary.col(column);
  const MatrixXd series = fit.from_values * values_at;
  for (Index first = 0; first < columns; first += components)
    for (Index k = 0; k < nodes_; ++k) {
      series_.push_back(LayerSlopes::Zero());
      series_.back().head(components) = series.row(k).segment(first, components).transpose();
    }
}

LayerSlopes EarlierTurns::operator()(std::size_t function, double x) const {
  const std::span<const LayerSlopes> all(series_);
  return chebyshev_sum(all.subspan(function * nodes_, nodes_), std::clamp(x / (reach * radius_), -1.0, 1.0));
}

}  // namespace rollres
