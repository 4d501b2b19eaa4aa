#pragma once

/// What the checks of a verification share: their rows, and the scenes that more than one of them looks at.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "studies/evidence/verification.hpp"

namespace rollres::verification {

/// The rows in the making.
class Checks {
 public:
  explicit Checks(const Evaluate& evaluate) : evaluate_(evaluate) {}

  /// Without an answer every number is absent.
  RollingSolution solve(const RollingScene& scene);
  void add(VerificationRow row);

  std::vector<VerificationRow> rows() && { return std::move(rows_); }

 private:
  const Evaluate& evaluate_;
  std::string reason_;  // of the last scene without an answer
  std::vector<VerificationRow> rows_;
};

/// "paper_cylinder" or "paper_sphere"
RollingScene paper_scene(std::string_view name);
RollingScene without_grid(RollingScene scene);

inline constexpr double shear_modulus = 1e11, unit_radius = 1;   // [Pa], [m]
inline constexpr double line_width = 1e-5, sphere_width = 1e-3;  // a [m]: so small that a circle is a parabola

/// Rolls at 1 m/s on an elastic half-space that does not change its volume.
RollingScene on_half_space(Indenter indenter);

/// Of bodies whose axle or path is turned.
void check_skewed_paper_cylinder(Checks& checks);
void check_turned_spheres(Checks& checks);

/// Of a pressure that is given, without a body.
void check_given_pressures(Checks& checks);

}  // namespace rollres::verification
