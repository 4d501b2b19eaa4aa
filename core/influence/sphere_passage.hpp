#pragma once

/// Influence coefficients of a sphere in a single passage over any layers, with inertia or without: each retardation
/// time's response is that of an elastic surface (directional_expansion.hpp), a half-space's in closed form plus a
/// smooth correction from tables, with an exponential memory (core/influence/README.md, section 5).

#include <memory>
#include <vector>

#include "core/influence/directional_expansion.hpp"
#include "core/influence/directional_half_space.hpp"
#include "core/influence/influence.hpp"
#include "core/influence/piecewise_field.hpp"

namespace rollres {

class SpherePassage {
 public:
  /// @param wave_speed V, for the inertia [m/s]; 0: without
  SpherePassage(const LayeredMedium& medium, double wave_speed);

  /// As of DirectionalExpansion.
  double error() const { return error_; }

  /// At a speed [m/s], which with inertia is that of the waves, for offsets of up to reach_x columns and reach_y rows
  /// of cells [m].
  InfluenceTable table(double speed, double cell_x, double cell_y, int reach_x, int reach_y) const;

 private:
  struct Term {
    double time;                      // tau_m [s]
    DirectionalHalfSpace deep, base;  // half-spaces under short and long waves
    Harmonics tail;                   // of what the correction has left to base at the extent, over a half-space
  };
  class RowResponse;

  double error_;
  int harmonics_;
  ResponseScales scales_;
  std::vector<Term> terms_;
  std::unique_ptr<const PiecewiseField> correction_;  // to deep, of all terms, up to the extent; none for a half-space
};

}  // namespace rollres
