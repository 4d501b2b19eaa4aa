#pragma once

/// The value against which errors are measured: see accuracy.hpp.

#include "studies/evidence/accuracy.hpp"

namespace rollres {

/// A scene in the course of being measured.
struct TimedScene {
  const std::string& name;
  const RollingScene& scene;
  const AccuracyOptions& options;
  const Measure& measure;

  /// The scene for a method and a spacing [m].
  RollingScene on_grid(Method method, double spacing) const;
  /// The scene for a method without a grid and a tolerance [1].
  RollingScene without_grid(Method method, double tolerance) const;
  /// Nodes ~ spacing^-dimension.
  double dimension() const { return dimension_of(scene.indenter) == 2 ? 1 : 2; }
  /// Says what is at work now.
  void tell(Method method, const std::string& at, const char* what = "") const;
};

/// Solves on grids finer than those of the points, as far as the limit of time allows, at least one.
/// @return not found() if no point converged, or no answer can be trusted
AccuracyReference find_reference(const TimedScene& measured, const std::vector<AccuracyPoint>& points);

}  // namespace rollres
