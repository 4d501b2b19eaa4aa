#include "core/medium_shapes.hpp"

#include <cmath>
#include <utility>

#include "core/quadrature.hpp"
#include "core/wavenumber_fade.hpp"
#include "core/wavenumber_rule.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Corrections = MediumExpansion::Corrections;

constexpr int sampled_degree = 15, table_degree = 9, parts_of_panel = 4;

/// A rule of wavenumbers with the corrections there, for distances from r0 to r1 over the length.
struct SampledRule : WavenumberRule {
  SampledRule(const MediumExpansion& expansion, double length, double r0, double r1)
      : WavenumberRule(expansion.lowest_wavenumber() * length, expansion.highest_wavenumber() * length, r0, r1) {
    for (const double k : nodes) values.push_back(expansion.correction(k / length));
  }
  std::vector<Corrections> values;
};

/// The corrections' transforms at distance r over the length, for RadialTable: by rows its four functions.
Corrections radial_transform(const SampledRule& rule, double r) {
  Corrections sum = Corrections::Zero(4, rule.values.front().cols());
  for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
    const double z = rule.nodes[q] * r, j0 = ::j0(z), j1 = ::j1(z);
    const double j2 = z > 1e-2 ? 2 * j1 / z - j0 : z * z / 8 * (1 - z * z / 12);
    const double weight = rule.weights[q] / (2 * M_PI);
    const Corrections& c = rule.values[q];  // normal, longitudinal, transverse, cross
    sum.row(0) += weight * j0 * c.row(0);
    sum.row(1) += 0.5 * weight * j0 * (c.row(1) + c.row(2));
    sum.row(2) += 0.5 * weight * j2 * (c.row(1) - c.row(2));
    sum.row(3) += weight * j1 * c.row(3);
  }
  return sum;
}

/// int (1 - fade) F_cross / (pi k^2) dk over all wavenumbers: what the constant part of the cross term's antiderivative
/// has beyond the faded rule.
Eigen::ArrayXd beyond_fade(const MediumExpansion& expansion, double length, double r0) {
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(static_cast<Index>(expansion.terms().size()));
  const WavenumberFade fade(r0);
  const double highest = expansion.highest_wavenumber() * length;
  const QuadratureRule gauss = gauss_legendre(16);
  double from = fade.from;
  for (double to = fade.from * 1.3; from < highest; from = to, to *= 1.3)
    for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
      const double k = from + (to - from) * gauss.nodes[q];
      sum += (to - from) * gauss.weights[q] * (1 - fade(k)) / (M_PI * k * k) *
             expansion.correction(k / length).row(3).transpose();
    }
  return sum;
}

/// Antiderivatives over x of the corrections, at distance x over the length, for LineTable: rows normal and
/// longitudinal less their known part e^{-2k}, and cross.
Corrections line_transform(const MediumExpansion& expansion, const SampledRule& rule, double length, double r0,
                           double x) {
  const auto count = static_cast<Index>(expansion.terms().size());
  Corrections sum = Corrections::Zero(4, count), known = Corrections::Zero(4, count);
  for (Index m = 0; m < count; ++m) {
    const auto& [time, deep, base] = expansion.terms()[static_cast<std::size_t>(m)];
    known.col(m) << base.normal - deep.normal, base.longitudinal - deep.longitudinal, 0, 0;
  }
  for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
    const double k = rule.nodes[q], sine = std::sin(k * x), half_sine = std::sin(0.5 * k * x);
    const double weight = rule.weights[q] / (M_PI * k * k);
    const Corrections& c = rule.values[q];
    sum.row(0) += weight * sine * (c.row(0) - std::exp(-2 * k) * known.row(0));
    sum.row(1) += weight * sine * (c.row(1) - std::exp(-2 * k) * known.row(1));
    sum.row(2) -= 2 * weight * half_sine * half_sine * c.row(3);
  }
  if (r0 > 0) sum.row(2) -= beyond_fade(expansion, length, r0).transpose();
  return sum;
}

/// Distance over the length beyond which every term's surface is at rest (rigid base), or close to that of the base.
double table_end(const MediumExpansion& expansion, double length, double finite, bool rigid) {
  constexpr double longest = 300, on_half_space = 60, at_rest = 1e-9;
  if (!rigid) return on_half_space * finite / length;
  double largest = 0;
  for (const MediumTerm& term : expansion.terms()) largest = std::max(largest, std::abs(term.deep.transverse));
  double end = 30 * finite / length;
  for (; end < longest * finite / length; end *= 1.3) {
    const Corrections at = radial_transform(SampledRule(expansion, length, end, end), end);
    double left = 0;
    for (std::size_t m = 0; m < expansion.terms().size(); ++m) {
      const LayerSymbols& deep = expansion.terms()[m].deep;
      const double half_space = (deep.longitudinal + deep.transverse) / (4 * M_PI * end);
      left = std::max({left, std::abs(at(1, static_cast<Index>(m)) + half_space),
                       std::abs(at(0, static_cast<Index>(m)) + deep.normal / (2 * M_PI * end))});
    }
    if (left < at_rest * largest) break;
  }
  return end;
}

}  // namespace

std::vector<TimedShape> medium_shapes(Indenter indenter, const LayeredMedium& medium,
                                      const MediumExpansion& expansion) {
  std::vector<TimedShape> shapes;
  const double finite = finite_thickness(medium);
  for (const MediumTerm& term : expansion.terms())
    shapes.push_back({term.time, {.deep = term.deep, .base = term.base, .radial = {}, .line = {}}});
  if (finite == 0) return shapes;

  const double length = medium.front().thickness;
  const bool rigid = std::isfinite(medium.back().thickness), sphere = indenter == Indenter::sphere;
  const std::vector<double> borders = distance_panels(table_end(expansion, length, finite, rigid));
  std::vector<Corrections> samples;  // in the order in which a table asks for them
  std::vector<double> fine{0};
  for (std::size_t panel = 0; panel + 1 < borders.size(); ++panel) {
    const double from = borders[panel], to = borders[panel + 1];
    const SampledRule rule(expansion, length, from, to);
    for (int node = 0; node <= sampled_degree; ++node) {
      const double r = from + 0.5 * (to - from) * (1 + std::cos(M_PI * (node + 0.5) / (sampled_degree + 1)));
      samples.push_back(sphere ? radial_transform(rule, r) : line_transform(expansion, rule, length, from, r));
    }
    for (int part = 1; part <= parts_of_panel; ++part) fine.push_back(from + (to - from) * part / parts_of_panel);
  }

  for (std::size_t m = 0; m < shapes.size(); ++m) {
    SurfaceShape& shape = shapes[m].shape;
    shape.length = length;
    shape.extent = borders.back() * length;
    std::size_t next = 0;
    const auto sampled = [&](auto rows) {
      constexpr int functions = decltype(rows)::value;
      using Table = ChebyshevTable<functions>;
      const Table wide(borders, sampled_degree, [&](double) -> typename Table::Values {
        return samples[next++].template topRows<functions>().col(static_cast<Index>(m));
      });
      return std::make_shared<const Table>(fine, table_degree, [&](double r) { return wide(r); });
    };
    if (sphere)
      shape.radial = sampled(std::integral_constant<int, 4>());
    else
      shape.line = sampled(std::integral_constant<int, 3>());
  }
  return shapes;
}

}  // namespace rollres
