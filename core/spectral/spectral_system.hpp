#pragma once

/// The linear problem inside given edges of contact and borders of stick: tractions, memories and rotation.
///
/// In the contact p = sqrt(1 - t^2) sum phi_n U_n(t), in a zone of stick shear = base + sqrt(1 - t'^2) sum psi_n
/// U_n(t'), t and t' the places in contact and zone, the base being +-mu p outside the stick (sliding_base.hpp). Where
/// the body touches w' is its slope, where it sticks u' = R Omega/V - 1, so that the elastic slopes are known but for
/// what each memory has at the leading end, amplitudes Z_j of exponentials. Bounded tractions are possible for the
/// right edges only: the constants that the system lacks are the residuals that the search for edges and borders must
/// bring to zero. Derived in core/spectral/README.md, (S6) to (S19).

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "core/algebra/nearby_systems.hpp"
#include "core/spectral/spectral_problem.hpp"

namespace rollres {

/// Which zones there are: slip and stick in turn, from the trailing to the leading edge.
struct SlipPattern {
  bool shear = false;  // false: no friction, and no zones
  std::vector<int>
      slips;  // direction of the shear in each zone of slip, +1 or -1; 0 first or last: stick up to the edge

  std::size_t sticks() const { return slips.empty() ? 0 : slips.size() - 1; }
  bool sticks_at_trailing_edge() const { return sticks() > 0 && slips.front() == 0; }
  bool sticks_at_leading_edge() const { return sticks() > 0 && slips.back() == 0; }
  /// Direction of the base on a zone of slip, continued up to an edge that sticks.
  int direction(std::size_t slip) const {
    if (slips[slip] != 0 || slips.size() == 1) return slips[slip];
    return slips[slip == 0 ? 1 : slip - 1];
  }
  bool one_direction() const;
  /// Edges and borders to be found. Stick all over is possible where the shear happens to vanish at the trailing edge;
  /// whether it does is left to the check of the slip.
  int unknowns() const {
    return 2 + 2 * static_cast<int>(sticks()) - sticks_at_trailing_edge() - sticks_at_leading_edge();
  }
};

struct Interval {
  double from, to;  // trailing and leading end [m]
  double centre() const { return 0.5 * (from + to); }
  double half_length() const { return 0.5 * (to - from); }
};

struct SpectralEdges {
  Interval contact{};
  std::vector<Interval> sticks;  // from the trailing to the leading edge
};

/// x in units of an interval; roots of the distance from its ends must not see the ends' rounding.
inline double place_in(const Interval& interval, double x) {
  const double t = (x - interval.centre()) / interval.half_length();
  return std::abs(std::abs(t) - 1) < 1e-12 ? std::copysign(1, t) : t;
}

struct SpectralOrders {
  int contact = 8, stick = 8;
};

/// A density's unknowns on one interval.
struct SpectralDensity {
  Eigen::VectorXd coefficients;  // phi_n or psi_n [Pa]
  Eigen::VectorXd amplitudes;    // of the exponentials in the elastic slope, Z_j of (S7) [Pa]
};

struct GradedTractions;

/// Consecutive points x = centre + half-length cos(angle) that stand for a traction: their forces are the weights of a
/// rule times a smooth function of the angle.
struct SourceRun {
  Eigen::Index first, count;
  Interval interval;
  /// Gauss points between these angles; if they are the same, the zeros of U_count in the interval and its density.
  double from_angle = 0, to_angle = 0;
};

struct SpectralState {
  SlipPattern pattern;
  SpectralEdges edges{};
  SpectralDensity pressure;
  std::vector<SpectralDensity> sticks;
  double rotation_ratio = 1;                               // R Omega/V
  double load = 0, approach = 0;                           // P [N/m], d [m] (NaN for a half-space)
  double driving_torque = 0, driving_force = 0;            // T [N], Q [N/m]
  Eigen::VectorXd edge_means;                              // R_{T_m} g_w at the leading edge [Pa]
  Eigen::VectorXd sources, pressure_forces, shear_forces;  // points and forces that stand for the tractions at a
                                                           // distance [m], [N/m]
  std::vector<SourceRun> runs;                             // of these; none of graded points
  Eigen::VectorXd residuals;                               // relative, one for each edge and border
  std::shared_ptr<const GradedTractions> graded;           // in place of densities (graded_tractions.hpp)
};

/// On a surface next to which nothing creeps, the slack of a zone of stick and the rotation are the same to it: bounded
/// tractions fix the rotation, and what the slack is elsewhere, the residual of its zone, is what the drive lacks.
/// @return the zone of stick whose slack is left out, if any
std::optional<std::size_t> redundant_slack(const SpectralProblem& problem, const SlipPattern& pattern);

/// @param edges with the pattern's zones of stick, inside the contact
SpectralState solve_inside(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
                           const SpectralOrders& orders);
/// @param nearby  of former evaluations, of which graded points make use
SpectralState solve_inside(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
                           const SpectralOrders& orders, NearbySystems& nearby);

}  // namespace rollres
