#include "core/surface/fourier_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/chebyshev.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int terms = 20;
constexpr double highest_wavenumber = 18;  // e^{-36}
constexpr double panel_growth = 1.6;       // of distances, as of the first ones
/// Radians over which the waves of a fade e^{-(14 u)^2} in its own length fall to 1e-14: they add to those of the
/// phase.
constexpr double fade_phase = 160;
constexpr std::array<double, 7> first_borders{1.2, 3, 6, 11, 19, 31, 48};

}  // namespace

FourierTable::FourierTable(std::size_t functions, Index components, double lowest_wavenumber, Transform transform)
    : components_(components),
      columns_(components * static_cast<Index>(functions)),
      lowest_(lowest_wavenumber),
      transform_(std::move(transform)) {}

/// Wavenumbers, and there w f for each function: the values at x are Re sum factors e^{i k x}.
struct FourierTable::WaveRule {
  Eigen::ArrayXd k;
  MatrixXd real, imaginary;  // [node, components * function + component]
};

FourierTable::WaveRule FourierTable::wave_rule(double from, double to) const {
  const WavenumberFade fade(from);
  const double end = std::min(highest_wavenumber, fade.to);
  std::vector<double> nodes, weights;
  double start = 0;
  for (double stop = std::min(lowest_, 0.5); start < end; start = stop, stop = std::min(2 * stop, stop + 1)) {
    const double width = std::min(stop, end) - start;
    const double phase = width * to + (stop > fade.from ? fade_phase * width / (fade.to - fade.from) : 0);
    const QuadratureRule& gauss = gauss_rule(11 + checked_count(0.3 * phase, "nodes of a transform"));
    for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
      nodes.push_back(start + width * gauss.nodes[q]);
      weights.push_back(width * gauss.weights[q] * fade(nodes.back()));
    }
  }
  const auto count = static_cast<Index>(nodes.size());
  WaveRule rule{Eigen::Map<Eigen::ArrayXd>(nodes.data(), count), MatrixXd(count, columns_), MatrixXd(count, columns_)};
  Eigen::ArrayXcd values(columns_);
  for (Index q = 0; q < count; ++q) {
    transform_(rule.k(q), {values.data(), static_cast<std::size_t>(columns_)});
    values *= weights[static_cast<std::size_t>(q)];
    rule.real.row(q) = values.real();
    rule.imaginary.row(q) = values.imag();
  }
  return rule;
}

FourierTable::PanelPair FourierTable::made(double from, double to) const {
  const WaveRule rule = wave_rule(from, to);
  const ChebyshevFit& fit = chebyshev_fit(terms);
  const Eigen::ArrayXd x = from + 0.5 * (to - from) * (1 + fit.nodes.array());
  const Eigen::ArrayXXd phase = (x.matrix() * rule.k.matrix().transpose()).array();
  const MatrixXd even = fit.from_values * (phase.cos().matrix() * rule.real);
  const MatrixXd odd = fit.from_values * (phase.sin().matrix() * rule.imaginary);
  PanelPair pair;
  for (const int side : {0, 1}) {
    const MatrixXd series = side == 0 ? MatrixXd(even - odd) : MatrixXd(even + odd);
    std::vector<LayerSlopes>& c = pair.coefficients[static_cast<std::size_t>(side)];
    for (Index first = 0; first < columns_; first += components_)
      for (Index k = 0; k < terms; ++k) {
        c.push_back(LayerSlopes::Zero());
        c.back().head(components_) = series.row(k).segment(first, components_).transpose();
      }
  }
  return pair;
}

LayerSlopes FourierTable::operator()(std::size_t function, double x) const {
  const double r = std::abs(x);
  while (borders_.back() < r)
    borders_.push_back(borders_.size() <= first_borders.size() ? first_borders[borders_.size() - 1]
                                                               : panel_growth * borders_.back());
  std::size_t panel = 0;
  while (panel + 2 < borders_.size() && r > borders_[panel + 1]) ++panel;
  if (panels_.size() <= panel) panels_.resize(panel + 1);
  const double from = borders_[panel], to = borders_[panel + 1];
  PanelPair& pair = panels_[panel];
  if (pair.coefficients[0].empty()) pair = made(from, to);
  const std::span<const LayerSlopes> all(pair.coefficients[x < 0 ? 1 : 0]);
  return chebyshev_sum(all.subspan(function * terms, terms), 2 * (r - from) / (to - from) - 1);
}

}  // namespace rollres
