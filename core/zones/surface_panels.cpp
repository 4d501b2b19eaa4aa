#include "core/zones/surface_panels.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/algebra/dense_algebra.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/spectral/graded_tractions.hpp"
#include "core/zones/added_slopes.hpp"

namespace rollres {

using Eigen::ArrayX2d;
using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// From the contact, in half-lengths, where forces at points stand for the tractions.
constexpr double distance_of_points = 2;
/// By how much panels narrow towards the ends of zones whose tractions have any exponents, and their number otherwise.
constexpr double graded_narrowing = 0.16;
constexpr int graded_parts = 8;

/// Chebyshev-Lobatto nodes s_k = cos(pi k/last) with everything a panel needs.
struct PanelRule {
  static constexpr int last = 20, count = last + 1;
  ArrayXd s, place, rate;         // nodes, sin(pi s/2), its derivative
  MatrixXd derivative, integral;  // by s; from s = 1
  PanelRule() : s(count), derivative(count, count), integral(count, count) {
    MatrixXd values(count, count), integrals(count, count), slopes(count, count);  // of T_n at nodes
    for (int k = 0; k < count; ++k) {
      const double angle = M_PI * k / last;
      s(k) = std::cos(angle);
      for (int n = 0; n < count; ++n) {
        values(k, n) = std::cos(n * angle);
        const double upper = n == 0 ? std::cos(angle) : n == 1 ? 0.25 * std::cos(2 * angle) : 0;
        const double at_end = n == 0 ? 1 : n == 1 ? 0.25 : 0.5 / (n + 1) - 0.5 / (n - 1);
        integrals(k, n) =
            (n < 2 ? upper : 0.5 * std::cos((n + 1) * angle) / (n + 1) - 0.5 * std::cos((n - 1) * angle) / (n - 1)) -
            at_end;
        slopes(k, n) = k == 0      ? n * n
                       : k == last ? (n % 2 ? 1 : -1) * n * n
                                   : n * std::sin(n * angle) / std::sin(angle);
      }
    }
    const MatrixXd to_series = SquareSystem(values).inverse();
    derivative = slopes * to_series;
    integral = integrals * to_series;
    place = (M_PI / 2 * s).sin();
    rate = M_PI / 2 * (M_PI / 2 * s).cos();
    rate(0) = rate(last) = 0;
  }
};

const PanelRule& panel_rule() {
  static const PanelRule rule;
  return rule;
}

/// Whether the memories are begun from forces at points: where they reach farther than the layer moves, or that is not
/// known.
bool from_points(const SpectralProblem& problem) {
  return problem.layered() && std::isinf(problem.correction->reach());
}

/// How far ahead of the contact panels are needed: as far as the memories reach and the layer moves [m].
double reach_ahead(const SpectralProblem& problem, double half) {
  double memories = 0.5 * half;
  for (const double length : problem.creep_length) memories = std::max(memories, 40 * length);
  if (!problem.layered()) return memories;
  const double far = from_points(problem) ? distance_of_points * half : problem.correction->reach();
  return std::max(0.5 * half, std::min(memories, far));
}

/// Descending, without those that nearly coincide; of these the ends stay.
std::vector<double> distinct(std::vector<double> borders, const std::vector<double>& ends, double nearest) {
  const auto is_end = [&](double border) { return std::find(ends.begin(), ends.end(), border) != ends.end(); };
  std::sort(borders.rbegin(), borders.rend());
  std::vector<double> kept;
  for (const double border : borders) {
    if (!kept.empty() && kept.back() - border < nearest) {
      if (is_end(border) && !is_end(kept.back())) kept.back() = border;
      if (!is_end(border) || kept.back() == border) continue;
    }
    kept.push_back(border);
  }
  return kept;
}

/// Borders of the panels, from ahead to behind [m].
std::vector<double> panel_borders(const SpectralProblem& problem, const SpectralState& state) {
  const Interval& contact = state.edges.contact;
  const double half = contact.half_length();
  const std::vector<double> ends = ends_of_zones(state.edges);
  std::vector<double> borders = ends;
  // Towards the ends, down to layers as thin as the shortest memory.
  double shortest = half;
  for (const double length : problem.relaxation_length) shortest = std::min(shortest, length);
  if (state.graded)  // where exponents are no halves
    shortest = std::min(shortest, state.graded->nearest_judged());
  const double narrowing = state.graded ? graded_narrowing : 0.25;
  for (const double end : ends)
    for (double distance = 0.25 * half; distance > 0.7 * shortest; distance *= narrowing)
      for (const double border : {end - distance, end + distance})
        if (border < contact.to + 0.5 * half) borders.push_back(border);
  // Ahead, in panels that widen with the distance.
  const double reach = reach_ahead(problem, half);
  double width = std::min(0.5 * half, problem.layered() ? problem.correction->depth() : half), ahead = 0;
  for (; ahead < reach; width *= 2) borders.push_back(contact.to + (ahead += width));
  borders.push_back(contact.from - 0.5 * half);
  borders.push_back(contact.from - 1.5 * half);
  // In contact: a number of the coefficients' oscillations for each panel, at most; graded points have none.
  const auto order = static_cast<double>(state.pressure.coefficients.size());
  const int parts = state.graded ? graded_parts : 1 + static_cast<int>(M_PI * order / 14);
  for (int i = 1; i < parts; ++i) borders.push_back(contact.centre() + half * std::cos(M_PI * i / parts));
  return distinct(std::move(borders), ends, 0.2 * std::min(shortest, 0.05 * half));
}

/// Nodes, weights and tractions of a panel.
SurfacePanel loaded_panel(const SpectralField& field, double from, double to) {
  const PanelRule& rule = panel_rule();
  const double half = 0.5 * (to - from);
  const ArrayXd none = ArrayXd::Zero(PanelRule::count);
  SurfacePanel panel{.zone = field.zone(0.5 * (from + to)),
                     .from = from,
                     .to = to,
                     .x = 0.5 * (from + to) + half * rule.place,
                     .weights = -(rule.integral.row(PanelRule::last).transpose().array() * half * rule.rate),
                     .pressure = none,
                     .shear = none,
                     .slope_w = {},
                     .slope_u = {},
                     .coating_w = {},
                     .coating_u = {},
                     .gap = {}};
  panel.x(0) = to;
  panel.x(PanelRule::last) = from;
  if (panel.zone == Zone::free) return panel;
  panel.pressure = field.pressure(panel.x);
  panel.shear = field.shear(panel.x, panel.pressure);
  return panel;
}

/// Memories at a panel's leading end, term by term, of w and u.
using Memories = Eigen::ArrayXXd;

Memories memories_ahead(const SpectralProblem& part, const SpectralField& field, double x, bool by_points) {
  Memories memories = Memories::Zero(part.terms(), 2);
  if (by_points)
    for (Index m = 0; m < part.terms(); ++m) {
      const SpectralField::Slopes begin = field.remembered_ahead(part, static_cast<std::size_t>(m), x);
      memories.row(m) << begin.w, begin.u;
    }
  return memories;
}

/// Slopes on a panel from its elastic ones [node, w and u]; takes the memories from its leading to its trailing end.
MatrixXd march_memories(const SpectralProblem& problem, const SurfacePanel& panel, const MatrixXd& elastic,
                        Memories& memories) {
  const PanelRule& rule = panel_rule();
  const ArrayXd rate = 0.5 * (panel.to - panel.from) * rule.rate;
  MatrixXd slopes = problem.glassy_compliance * elastic;
  for (Index m = 0; m < problem.terms(); ++m) {
    // x'(s) y - T dy/ds = x'(s) g, y given at the leading end.
    MatrixXd system = -problem.creep_length[static_cast<std::size_t>(m)] * rule.derivative;
    system.diagonal().array() += rate;
    MatrixXd right = elastic.array().colwise() * rate;
    system.row(0).setZero();
    system(0, 0) = 1;
    right.row(0) = memories.row(m);
    const MatrixXd y = SquareSystem(system).solve(right);
    slopes += problem.creep_compliance[static_cast<std::size_t>(m)] * y;
    memories.row(m) = y.row(PanelRule::last).array();
  }
  return slopes;
}

/// Integrates the gaps from the leading edge.
void measure_gaps(const SpectralProblem& problem, double leading_edge, std::vector<SurfacePanel>& panels) {
  double gap = 0;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    SurfacePanel& panel = panels[i];
    ArrayXd opening(PanelRule::count);
    for (int k = 0; k < PanelRule::count; ++k) opening(k) = problem.shape.slope(panel.x(k)) - panel.slope_w(k);
    panel.gap = gap + panel.integrated(opening);
    gap = panel.gap(PanelRule::last);
    if (panel.from != leading_edge) continue;
    for (std::size_t ahead = 0; ahead <= i; ++ahead) panels[ahead].gap -= gap;
    gap = 0;
  }
}

}  // namespace

ArrayXd SurfacePanel::integrated(const ArrayXd& values) const {
  const PanelRule& rule = panel_rule();
  return rule.integral * (0.5 * (to - from) * rule.rate * values).matrix();
}

double SurfacePanel::at(const ArrayXd& values, double position) const {
  const PanelRule& rule = panel_rule();
  const double sine = std::clamp((2 * position - from - to) / (to - from), -1.0, 1.0);
  const double s = 2 / M_PI * std::asin(sine);
  double numerator = 0, denominator = 0;
  for (int k = 0; k < PanelRule::count; ++k) {
    if (s == rule.s(k)) return values(k);
    const double weight = (k % 2 ? -1.0 : 1.0) * (k == 0 || k == PanelRule::last ? 0.5 : 1.0) / (s - rule.s(k));
    numerator += weight * values(k);
    denominator += weight;
  }
  return numerator / denominator;
}

namespace {

/// Slopes of the surface, or of a side's part, panel by panel in the direction of time.
class MarchedSlopes {
 public:
  /// @param end  trailing end of the last panel that is asked for [m]
  MarchedSlopes(const SpectralProblem& problem, const SpectralProblem& part, const SpectralState& state,
                const SpectralField& field, const std::vector<double>& borders, double end)
      : part_(part),
        added_(part, field, state.edges, end, state.edges.contact.to + 0.5 * state.edges.contact.half_length(),
               (borders.size() - 1) * PanelRule::count / 2),
        memories_(memories_ahead(part, field, borders.front(), from_points(problem))) {}

  /// @param deep  elastic slopes of a half-space on the panel
  /// @return [node, w and u]
  MatrixXd next(const SurfacePanel& panel, const ArrayX2d& deep) {
    MatrixXd elastic = deep;
    for (int k = 0; k < PanelRule::count; ++k) {
      const SpectralField::Slopes added = added_(panel.x(k));
      elastic(k, 0) += added.w;
      elastic(k, 1) += added.u;
    }
    return march_memories(part_, panel, elastic, memories_);
  }

 private:
  const SpectralProblem& part_;
  AddedSlopes added_;
  Memories memories_;
};

/// M and N of (S18), panel by panel.
class SumOfMoments {
 public:
  /// @param ahead the leading end of the first panel [m]
  SumOfMoments(const SpectralProblem& problem, const SpectralField& field, double ahead)
      : problem_(problem),
        over_radius_(problem.model.ring() && problem.model.friction_coefficient > 0 ? 1 / problem.model.radius : 0) {
    if (over_radius_ > 0) w_ = field.displacement_ahead(*problem.side, ahead).w;
  }

  /// @param side_w  slopes of the side that is known
  void add(const SurfacePanel& panel, const ArrayXd& side_w) {
    const bool contact = panel.zone != Zone::free;
    if (contact && problem_.side_is_coating) moments.pressed += (panel.weights * panel.pressure * side_w).sum();
    if (contact && !problem_.side_is_coating) {
      const ArrayXd whole = panel.x.unaryExpr([&](double x) { return problem_.shape.slope(x); });
      moments.pressed += (panel.weights * panel.pressure * (whole - side_w)).sum();
    }
    if (over_radius_ == 0) return;
    const ArrayXd moved = w_ + panel.integrated(side_w);
    if (contact) moments.sheared += over_radius_ * (panel.weights * panel.shear * moved).sum();
    w_ = moved(PanelRule::last);
  }

  CoatingMoments moments;

 private:
  const SpectralProblem& problem_;
  double over_radius_, w_ = 0;  // of a ring with friction; the coating's part of w [m]
};

/// All panels, from ahead to behind.
std::vector<SurfacePanel> surface_panels(const SpectralProblem& problem, const SpectralState& state,
                                         const SpectralField& field) {
  const std::vector<double> borders = panel_borders(problem, state);
  MarchedSlopes surface(problem, problem, state, field, borders, borders.back());
  std::optional<MarchedSlopes> side;
  if (problem.side) side.emplace(problem, *problem.side, state, field, borders, borders.back());
  std::vector<SurfacePanel> panels;
  for (std::size_t i = 1; i < borders.size(); ++i) {
    SurfacePanel panel = loaded_panel(field, borders[i], borders[i - 1]);
    const ArrayX2d deep = field.deep_slopes(panel.x);
    const MatrixXd slopes = surface.next(panel, deep);
    panel.slope_w = slopes.col(0);
    panel.slope_u = slopes.col(1);
    if (side) {
      const MatrixXd part = side->next(panel, deep), coating = problem.side_is_coating ? part : MatrixXd(slopes - part);
      panel.coating_w = coating.col(0);
      panel.coating_u = coating.col(1);
    }
    panels.push_back(std::move(panel));
  }
  measure_gaps(problem, state.edges.contact.to, panels);
  return panels;
}

CoatingMoments moments_on(const SpectralProblem& problem, const SpectralField& field,
                          const std::vector<SurfacePanel>& panels) {
  if (!problem.side) return {};
  SumOfMoments sum(problem, field, panels.front().to);
  for (const SurfacePanel& panel : panels)
    sum.add(panel, problem.side_is_coating ? panel.coating_w : ArrayXd(panel.slope_w - panel.coating_w));
  return sum.moments;
}

}  // namespace

SpectralSurface::SpectralSurface(const SpectralProblem& problem, const SpectralState& state)
    : field(problem, state),
      panels(surface_panels(problem, state, field)),
      coating(moments_on(problem, field, panels)) {}

CoatingMoments coating_moments(const SpectralProblem& problem, const SpectralState& state) {
  if (!problem.side) return {};
  const SpectralField field(problem, state);
  const std::vector<double> borders = panel_borders(problem, state);
  const double end = state.edges.contact.from;
  MarchedSlopes side(problem, *problem.side, state, field, borders, end);
  SumOfMoments sum(problem, field, borders.front());
  for (std::size_t i = 1; i < borders.size() && borders[i] >= end; ++i) {
    const SurfacePanel panel = loaded_panel(field, borders[i], borders[i - 1]);
    sum.add(panel, side.next(panel, field.deep_slopes(panel.x)).col(0));
  }
  return sum.moments;
}

}  // namespace rollres
