#include "core/spectral/surface_panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/numerics/chebyshev.hpp"
#include "core/numerics/dense_algebra.hpp"

namespace rollres {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// From the contact, in half-lengths, where forces at points stand for the tractions.
constexpr double distance_of_points = 2;

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

/// What finite thickness adds to the elastic slopes, as Chebyshev series on panels no wider than the depth it comes
/// from: it is singular at twice that distance from the surface.
class AddedSlopes {
 public:
  /// Between these places; elsewhere, and where there would be more nodes than `most`, it is summed anew.
  AddedSlopes(const SpectralProblem& problem, const SpectralField& field, double from, double to, std::size_t most)
      : field_(field), layered_(problem.layered()) {
    if (!layered_) return;
    const double panels = std::ceil((to - from) / problem.correction->depth());
    if (panels * count > static_cast<double>(most)) return;
    from_ = from;
    width_ = (to - from) / panels;
    for (int panel = 0; panel < static_cast<int>(panels); ++panel) {
      std::array<Eigen::Array2d, count> c;
      c.fill(Eigen::Array2d::Zero());
      for (int node = 0; node < count; ++node) {
        const double angle = M_PI * (node + 0.5) / count;
        const SpectralField::Slopes value = field.added_slopes(from + width_ * (panel + 0.5 + 0.5 * std::cos(angle)));
        for (int k = 0; k < count; ++k)
          c[static_cast<std::size_t>(k)] +=
              (k == 0 ? 1.0 : 2.0) / count * std::cos(k * angle) * Eigen::Array2d(value.w, value.u);
      }
      series_.push_back(c);
    }
  }

  SpectralField::Slopes operator()(double x) const {
    if (!layered_) return {0, 0};
    const double place = (x - from_) / width_;
    if (!(place >= 0 && place <= static_cast<double>(series_.size()))) return field_.added_slopes(x);
    const auto panel = std::min(static_cast<std::size_t>(place), series_.size() - 1);
    const double t = 2 * (place - static_cast<double>(panel)) - 1;
    const Eigen::Array2d sum = chebyshev_sum(std::span<const Eigen::Array2d>(series_[panel]), t);
    return {sum(0), sum(1)};
  }

 private:
  static constexpr int count = 18;
  const SpectralField& field_;
  bool layered_;
  double from_ = 0, width_ = 1;
  std::vector<std::array<Eigen::Array2d, count>> series_;
};

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

std::vector<SurfacePanel> surface_panels(const SpectralProblem& problem, const SpectralState& state,
                                         const SpectralField& field) {
  const Interval& contact = state.edges.contact;
  const double half = contact.half_length();
  std::vector<SurfacePanel> panels;
  // Ends at which tractions or slopes have roots of the distance, and layers as thin as the shortest memory.
  std::vector<double> ends{contact.from, contact.to};
  for (const Interval& stick : state.edges.sticks)
    for (const double end : {stick.from, stick.to})
      if (std::find(ends.begin(), ends.end(), end) == ends.end()) ends.push_back(end);
  std::vector<double> borders = ends;
  double shortest = half, reach = 0.5 * half;
  for (const double length : problem.relaxation_length) shortest = std::min(shortest, length);
  for (const double length : problem.creep_length) reach = std::max(reach, 40 * length);
  // Where that is farther than the layer moves, or not known, the memories are begun from forces at points.
  const bool from_points = problem.layered() && std::isinf(problem.correction->reach());
  const double far = from_points ? distance_of_points * half : problem.layered() ? problem.correction->reach() : reach;
  reach = std::max(0.5 * half, std::min(reach, far));
  for (const double end : ends)
    for (double distance = 0.25 * half; distance > 0.7 * shortest; distance *= 0.25)
      for (const double border : {end - distance, end + distance})
        if (border < contact.to + 0.5 * half) borders.push_back(border);
  // Ahead, as far as the memories reach and the layer moves, in panels that widen with the distance.
  double width = std::min(0.5 * half, problem.layered() ? problem.correction->depth() : half), ahead = 0;
  for (; ahead < reach; width *= 2) borders.push_back(contact.to + (ahead += width));
  borders.push_back(contact.from - 0.5 * half);
  borders.push_back(contact.from - 1.5 * half);
  // In contact: a number of the coefficients' oscillations for each panel, at most.
  const auto order = static_cast<double>(state.pressure.coefficients.size());
  const int parts = 1 + static_cast<int>(M_PI * order / 14);
  for (int i = 1; i < parts; ++i) borders.push_back(contact.centre() + half * std::cos(M_PI * i / parts));
  std::sort(borders.rbegin(), borders.rend());
  // Of borders that nearly coincide those stay that are ends.
  std::vector<double> kept;
  for (const double border : borders) {
    const bool is_end = std::find(ends.begin(), ends.end(), border) != ends.end();
    if (!kept.empty() && kept.back() - border < 0.2 * std::min(shortest, 0.05 * half)) {
      if (is_end && std::find(ends.begin(), ends.end(), kept.back()) == ends.end()) kept.back() = border;
      if (!is_end || kept.back() == border) continue;
    }
    kept.push_back(border);
  }
  for (std::size_t i = 1; i < kept.size(); ++i) {
    const double from = kept[i], to = kept[i - 1];
    panels.push_back({.zone = field.zone(0.5 * (from + to)),
                      .from = from,
                      .to = to,
                      .x = {},
                      .weights = {},
                      .pressure = {},
                      .shear = {},
                      .slope_w = {},
                      .slope_u = {},
                      .gap = {}});
  }

  const PanelRule& rule = panel_rule();
  const Index terms = problem.terms();
  const AddedSlopes added(problem, field, contact.from - 1.5 * half, contact.to + 0.5 * half,
                          panels.size() * PanelRule::count / 2);
  Eigen::ArrayXXd memory = Eigen::ArrayXXd::Zero(terms, 2);  // of w and u at the panel's leading end
  if (from_points)
    for (Index m = 0; m < terms; ++m) {
      const SpectralField::Slopes begin = field.remembered_ahead(static_cast<std::size_t>(m), panels.front().to);
      memory.row(m) << begin.w, begin.u;
    }
  double gap = 0;
  for (SurfacePanel& panel : panels) {
    const double half_panel = 0.5 * (panel.to - panel.from);
    panel.x = 0.5 * (panel.from + panel.to) + half_panel * rule.place;
    panel.x(0) = panel.to;
    panel.x(PanelRule::last) = panel.from;
    panel.weights = -(rule.integral.row(PanelRule::last).transpose().array() * half_panel * rule.rate);
    panel.pressure = panel.shear = ArrayXd::Zero(PanelRule::count);
    MatrixXd elastic(PanelRule::count, 2);
    for (int k = 0; k < PanelRule::count; ++k) {
      const SpectralField::Slopes g = field.elastic_slopes(panel.x(k), added(panel.x(k)));
      elastic.row(k) << g.w, g.u;
      if (panel.zone == Zone::free) continue;
      panel.pressure(k) = field.pressure(panel.x(k));
      panel.shear(k) = field.shear(panel.x(k), panel.pressure(k));
    }
    MatrixXd slopes = problem.glassy_compliance * elastic;
    for (Index m = 0; m < terms; ++m) {
      // x'(s) y - T dy/ds = x'(s) g, y given at the leading end.
      const double length = problem.creep_length[static_cast<std::size_t>(m)];
      const ArrayXd rate = half_panel * rule.rate;
      MatrixXd system = -length * rule.derivative;
      system.diagonal().array() += rate;
      MatrixXd right = elastic.array().colwise() * rate;
      system.row(0).setZero();
      system(0, 0) = 1;
      right.row(0) = memory.row(m);
      const MatrixXd y = SquareSystem(system).solve(right);
      slopes += problem.creep_compliance[static_cast<std::size_t>(m)] * y;
      memory.row(m) = y.row(PanelRule::last).array();
    }
    panel.slope_w = slopes.col(0);
    panel.slope_u = slopes.col(1);
    ArrayXd opening(PanelRule::count);
    for (int k = 0; k < PanelRule::count; ++k) opening(k) = problem.slope(panel.x(k)) - panel.slope_w(k);
    panel.gap = gap + panel.integrated(opening);
    gap = panel.gap(PanelRule::last);
    if (panel.from == contact.to) {  // measured from the leading edge
      for (SurfacePanel& other : panels) {
        if (other.gap.size() > 0) other.gap -= gap;
        if (&other == &panel) break;
      }
      gap = 0;
    }
  }
  return panels;
}

}  // namespace rollres
