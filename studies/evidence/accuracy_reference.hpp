#pragma once

/// The value against which errors are measured: see accuracy.hpp.

#include "studies/evidence/accuracy.hpp"

namespace rollres {

/// Solves on grids finer than those of the points, as far as the limit of time allows, at least one.
/// @return not found() if no point converged, or no answer can be trusted
AccuracyReference find_reference(const std::string& name, const RollingScene& scene,
                                 const std::vector<AccuracyPoint>& points, const AccuracyOptions& options,
                                 const Measure& measure);

/// The scene for a method and a spacing [m].
RollingScene with_grid(RollingScene scene, Method method, double spacing);

/// Nodes ~ spacing^-dimension.
inline double surface_dimension(Indenter indenter) { return indenter == Indenter::cylinder ? 1 : 2; }

/// The scene for a method without a grid and a tolerance [1].
RollingScene with_tolerance(RollingScene scene, Method method, double tolerance);

/// Says what is at work now.
void tell(const AccuracyOptions& options, const std::string& name, Method method, const std::string& at);

}  // namespace rollres
