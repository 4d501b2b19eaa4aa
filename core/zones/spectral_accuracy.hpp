#pragma once

/// What an order tells of an answer with continuous edges: its errors, and which violations of the laws between the
/// points are those of its order and not of a wrong pattern (core/spectral/README.md, (S27)).

#include "core/model/contact_model.hpp"
#include "core/zones/spectral_solution.hpp"

namespace rollres {

/// Violations of any law that an answer may have: of rings, whose curvature is known to its memories between points,
/// and where another order mends nothing, the larger one.
inline constexpr double largest_violation = 5e-9, borne_violation = 1e-8;

/// The wanted relative error of a scene without a tolerance, and what rounding allows.
inline constexpr double default_spectral_tolerance = 1e-8, smallest_spectral_tolerance = 1e-13;

/// R_r [N/m].
double resistance_of(const SpectralState& state, double radius);
/// Rounding and what is left of the residuals move the centre of pressure by a part of it [N/m].
double lever_of(const SpectralState& state, double radius);
/// By which errors of R_r are measured; an elastic layer resists with nothing.
double scale_of(const SpectralState& state, double radius);
/// The last coefficients over the largest.
double relative_tail(const SpectralState& state);

/// What an order told of the resistance.
struct OrderResult {
  int order = 0;
  double error = INFINITY;  ///< expected change, of the scale
  double resistance = 0, lever = 0, scale = 1;
};

class SpectralAccuracy {
 public:
  /// Both live longer.
  SpectralAccuracy(const ContactModel& model, const SpectralProblem& problem);

  /// Of R_r, to which all is solved.
  double tolerance() const { return tolerance_; }
  /// What the last change may let expect, if no higher order can be had: a missed tolerance is then warned of [1].
  double largest_change(bool graded) const { return tolerance_ / (graded && model_.tolerance ? 2 : 1); }
  /// The same else: a tolerance that is asked for is one of the estimate [1].
  double wanted_change(bool graded) const;

  /// The error of R_r that an answer states, of the scale. Of graded points changes may be small by chance, and tell
  /// nothing of an inequality that is violated a little between points: if that is since the pattern is wrong, all
  /// orders of it share what it costs.
  double estimate(const SpectralState& state, const AssessedSpectral& assessed, const OrderResult& told) const;
  /// Of the largest pressure [Pa]: what coefficients, or graded points, and short memories leave.
  double peak_error(const SpectralState& state, const AssessedSpectral& assessed, const OrderResult& told) const;

  /// The estimate over the change that one order more is expected to make.
  double over_change() const;
  /// The tail, and the error of the fields, that an order of graded points leaves.
  double tail(int order) const;
  double field_error(int order) const;
  /// What so many graded points leave of R_r, of random scenes and by their order alone. @param lever  over the scale
  double usual_error(int order, double lever) const;

  bool misses_tolerance(const SpectralState& state, const AssessedSpectral& assessed, const OrderResult& told) const;
  /// Whether the inequalities hold, of graded points to what their number allows.
  bool in_its_zones(const SpectralState& state, const AssessedSpectral& assessed, int order) const;
  /// Violation between the points that is one of the order.
  double between_points(const SpectralState& state, int order) const;
  /// Of graded points, and on rings, the laws hold where they are imposed, and in between to what their number allows.
  double imposed_violation(const SpectralState& state, const AssessedSpectral& assessed) const;
  /// Violation of an inequality at an order of few graded points that refutes the pattern.
  double refuted_at(int order) const;

 private:
  double resolving(int order) const;
  double left_by_short_memories(const SpectralState& state, double place) const;

  const ContactModel& model_;
  const SpectralProblem& problem_;
  double tolerance_;
};

}  // namespace rollres
