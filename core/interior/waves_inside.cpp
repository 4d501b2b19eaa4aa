#include <algorithm>
#include <cmath>

#include "core/interior/depth_response.hpp"
#include "core/interior/interior_field.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/surface/ring_compliance.hpp"

// Which waves the inside of a cylinder's layers is summed of.

namespace rollres {

namespace {

constexpr int nodes_per_panel = 24;
/// Panels of long waves over their distance from 0: poles of memories on the imaginary axis cost 2^-48 of them.
constexpr double growth = 7;

}  // namespace

double InteriorField::highest_wavenumber(double half_length, Detail detail) const {
  if (detail == Detail::rough) return 20 / half_length;
  const double along = detail == Detail::surface ? 300 : 80;
  return std::max(along / half_length, DepthResponse::vanished / medium_.front().thickness);
}

void InteriorField::put_wave(double wavenumber, double weight, const SurfaceTractions::Transforms& tractions) {
  waves_.push_back({wavenumber, weight, tractions, moduli_at(medium_, -wavenumber * speed_)});
}

void InteriorField::add_waves(double lowest, double widest) {
  const QuadratureRule& rule = gauss_rule(nodes_per_panel);
  require_memory(highest_ / widest * nodes_per_panel * sizeof(Wave), "waves in the layers");
  double from = 0, to = lowest;
  for (; to - from < widest && to < highest_; from = to, to += std::min(growth * to, widest))
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double k = from + (to - from) * rule.nodes[i];
      put_wave(k, (to - from) * rule.weights[i], tractions_.transforms(k));
    }
  // The others are of one width.
  const int panels = std::max(1, static_cast<int>(std::ceil((highest_ - from) / widest)));
  const double width = (highest_ - from) / panels;
  std::vector<double> firsts;
  for (const double node : rule.nodes) firsts.push_back(from + width * node);
  const std::vector<std::vector<SurfaceTractions::Transforms>> tractions = tractions_.transforms(firsts, width, panels);
  for (std::size_t i = 0; i < firsts.size(); ++i)
    for (int panel = 0; panel < panels; ++panel)
      put_wave(firsts[i] + width * panel, width * rule.weights[i], tractions[i][static_cast<std::size_t>(panel)]);
  std::sort(waves_.begin(), waves_.end(), [](const Wave& a, const Wave& b) { return a.wavenumber < b.wavenumber; });
}

bool InteriorField::comes_round(double speed) const {
  constexpr double thick = 0.15;  // of the radius: of thinner rings what is half a turn away is below 1e-4
  constexpr double recovered = 1e-4;
  if (!is_ring(medium_)) return false;
  const double radius = medium_.front().radius;
  if (finite_thickness(medium_) > thick * radius) return true;
  const auto remembers = [&](const CreepSpectrum::Term& term) {
    return std::exp(-2 * M_PI * radius / (speed * term.time)) > recovered;
  };
  return std::any_of(medium_.begin(), medium_.end(), [&](const MediumLayer& ring) {
    return std::any_of(ring.material.terms.begin(), ring.material.terms.end(), remembers);
  });
}

void InteriorField::add_harmonics() {
  constexpr double even = 1e-4;  // in place of the harmonic 0, which is even all around
  const double step = 1 / medium_.front().radius;
  require_memory(highest_ / step * sizeof(Wave), "harmonics of a ring");
  const int count = checked_count(std::ceil(highest_ / step), "harmonics of a ring");
  put_wave(even * step, 0.5 * step, tractions_.transforms(even * step));
  const auto tractions = tractions_.transforms({step}, step, count);
  for (int n = 0; n < count; ++n) put_wave((n + 1) * step, step, tractions.front()[static_cast<std::size_t>(n)]);
}

}  // namespace rollres
