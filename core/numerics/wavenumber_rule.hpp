#pragma once

/// Wavenumbers for transforms of what a layer adds to its half-space: smooth from 0 to where it has vanished.

#include <vector>

namespace rollres {

/// Distances over the length where panels of tables end, the last one beyond `end`: the functions are singular at
/// distances of +-2i and more only, so that panels may widen.
std::vector<double> distance_panels(double end);

/// Nodes k with weights, fade included, for distances from r0 to r1; in any unit of length.
struct WavenumberRule {
  /// @param lowest wavenumber at which anything happens   @param highest that matters
  WavenumberRule(double lowest, double highest, double r0, double r1, int order = 0);

  std::vector<double> nodes, weights;
};

}  // namespace rollres
