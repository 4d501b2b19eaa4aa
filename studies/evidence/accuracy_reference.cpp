#include "studies/evidence/accuracy_reference.hpp"

#include <algorithm>
#include <cmath>

#include "studies/evidence/power_law.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// Methods whose answer may be the reference, the first choice first.
constexpr Method trusted_methods[] = {Method::newton, Method::newton_dense};
constexpr double trusted_violation = 1e-8;  // of the laws of contact, relative
constexpr int most_halvings = 3;            // from the finest spacing shown to the reference
/// The first of these halvings may take longer than the limit by this factor.
constexpr double first_halving_allowance = 16;

bool trusted(const RollingSolution& solution) {
  return solution.status == Status::converged && solution.law_violation <= trusted_violation;
}

/// A value that may be the reference, or help to judge it.
struct Witness {
  double spacing, rolling_resistance;
  Method method;
  int contact_nodes;
};

/// Trusted values among the points, on `finest` and on up to two grids twice as coarse each; from coarse to fine.
std::vector<Witness> witnesses_among(const std::vector<AccuracyPoint>& points, double finest) {
  constexpr double same = 1e-6;
  std::vector<Witness> witnesses;
  for (const double ratio : {4.0, 2.0, 1.0}) {
    for (const Method method : trusted_methods) {
      const auto at = find_if(points, [&](const AccuracyPoint& point) {
        return point.method == method && point.status == AccuracyStatus::converged && trusted(point.solution) &&
               std::abs(point.spacing / (ratio * finest) - 1) < same;
      });
      if (at == points.end()) continue;
      witnesses.push_back({at->spacing, at->solution.rolling_resistance, method, at->solution.contact_nodes});
      break;
    }
  }
  return witnesses;
}

/// Adds values on finer and finer grids, as far as the limit of time allows, at least one.
void add_finer(std::vector<Witness>& witnesses, const TimedScene& measured, const std::vector<AccuracyPoint>& points,
               double finest) {
  const double limit = measured.options.seconds_limit;
  std::vector<SolveCost> costs;
  for (const Method method : trusted_methods) {
    costs.emplace_back(measured.dimension());
    for (const AccuracyPoint& point : points)
      if (point.method == method && point.repeats > 0) costs.back().add(point.spacing, point.seconds);
  }
  const bool known = !witnesses.empty() && witnesses.back().spacing < 1.5 * finest;
  for (int halving = known ? 1 : 0; halving <= most_halvings; ++halving) {
    const double spacing = finest * std::ldexp(1.0, -halving);
    bool found = false;
    for (std::size_t i = 0; i < costs.size() && !found; ++i) {
      const Method method = trusted_methods[i];
      const bool in_any_case = i == 0 && halving <= 1;
      if (!in_any_case && !(costs[i].predicted(spacing) <= limit)) continue;
      measured.tell(method, readable(spacing, "m"), ", reference");
      const auto [solution, seconds, processor_seconds, memory, stopped, failure] =
          measured.measure(measured.on_grid(method, spacing), (in_any_case ? first_halving_allowance : 1) * limit);
      if (stopped || !failure.empty()) continue;
      costs[i].add(spacing, seconds);
      found = trusted(solution);
      if (found) witnesses.push_back({spacing, solution.rolling_resistance, method, solution.contact_nodes});
    }
    if (!found) return;
  }
}

/// Richardson's value from the last four witnesses, or NaN where they do not show one and the same order.
double extrapolated(const std::vector<Witness>& witnesses) {
  if (witnesses.size() < 4) return RollingSolution::absent;
  const Witness* last = &witnesses[witnesses.size() - 4];
  std::array<double, 3> change;
  for (std::size_t i = 0; i < 3; ++i) {
    change[i] = last[i + 1].rolling_resistance - last[i].rolling_resistance;
    if (std::abs(last[i].spacing / last[i + 1].spacing - 2) > 1e-3) return RollingSolution::absent;
  }
  const double order = std::log2(change[1] / change[2]), earlier = std::log2(change[0] / change[1]);
  constexpr double lowest = 0.5, highest = 6, scatter = 0.1;
  if (!(order >= lowest && order <= highest && std::abs(order - earlier) <= scatter)) return RollingSolution::absent;
  return last[3].rolling_resistance + change[2] / (std::exp2(order) - 1);
}

AccuracyReference reference_of(const std::vector<Witness>& witnesses) {
  if (witnesses.empty()) return {};
  const Witness& finest = witnesses.back();
  AccuracyReference reference{.rolling_resistance = extrapolated(witnesses),
                              .method = finest.method,
                              .spacing = finest.spacing,
                              .contact_nodes = finest.contact_nodes};
  reference.extrapolated = reference.found();
  if (!reference.extrapolated) reference.rolling_resistance = finest.rolling_resistance;
  const double other = reference.extrapolated ? finest.rolling_resistance
                       : witnesses.size() > 1 ? witnesses[witnesses.size() - 2].rolling_resistance
                                              : RollingSolution::absent;
  reference.uncertainty = std::abs(other / reference.rolling_resistance - 1);
  return reference;
}

/// The spectral method's value, if that answers the scene itself.
AccuracyReference gridless_reference(const TimedScene& measured) {
  constexpr double tightest = 1e-11, rounding = 1e-12;
  measured.tell(Method::spectral, "tolerance 1e-11", ", reference");
  const Measurement found = measured.measure(measured.without_grid(Method::spectral, tightest),
                                             first_halving_allowance * measured.options.seconds_limit);
  const RollingSolution& solution = found.solution;
  if (found.stopped || !found.failure.empty() || !trusted(solution) || solution.method != Method::spectral) return {};
  return {.rolling_resistance = solution.rolling_resistance,
          .uncertainty = std::max(rounding, solution.error_estimate),
          .method = Method::spectral,
          .contact_nodes = solution.contact_nodes};
}

}  // namespace

AccuracyReference find_reference(const TimedScene& measured, const std::vector<AccuracyPoint>& points) {
  if (dimension_of(measured.scene.indenter) == 2 && !measured.scene.period) {
    const AccuracyReference reference = gridless_reference(measured);
    if (reference.found()) return reference;
  }
  double finest = std::numeric_limits<double>::infinity();
  for (const AccuracyPoint& point : points)
    if (point.status == AccuracyStatus::converged) finest = std::min(finest, point.spacing);
  if (std::isinf(finest)) return {};
  std::vector<Witness> witnesses = witnesses_among(points, finest);
  add_finer(witnesses, measured, points, finest);
  return reference_of(witnesses);
}

}  // namespace rollres
