#pragma once

/// Points and weights that stand for the tractions where smooth functions of x act on them: the layer's correction, the
/// resultants.

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <vector>

#include "core/spectral/sliding_base.hpp"
#include "core/spectral/slope_correction.hpp"

namespace rollres {

struct TractionSources {
  Eigen::VectorXd x;                      // [m]; the contact's own nodes first
  Eigen::MatrixXd of_pressure, of_shear;  // [source, unknown]: force per unknown [m]
  Eigen::Index pressure_nodes = 0;        // first sources, and first unknowns, that have a pressure
  std::vector<SourceRun> runs;            // of all sources; the first one bears the pressure
};

/// @param base if there is friction   @param stick_places of the first coefficient of each zone of stick among the
/// unknowns; those of the pressure are the first   @param unknowns their number
TractionSources traction_sources(const SlipPattern& pattern, const SpectralEdges& edges, const SpectralOrders& orders,
                                 const SlidingBase* base, double friction,
                                 const std::vector<Eigen::Index>& stick_places, Eigen::Index unknowns);

/// Slopes of the surface under unit forces at a distance [m], as those of core/surface/layer_slopes.hpp.
using LayerKernel = std::function<LayerSlopes(double)>;

/// What the layer adds to the elastic slopes g_w and g_u of unit modulus at points x [m], by unknown: [point, unknown]
/// (core/spectral/README.md, (S2)).
Eigen::MatrixXd normal_slopes(const TractionSources& sources, const LayerKernel& layer, const Eigen::VectorXd& x);
Eigen::MatrixXd tangential_slopes(const TractionSources& sources, const LayerKernel& layer, const Eigen::VectorXd& x);

/// Between the points of a contact, in its middle [m].
inline double finest_distance(const Interval& contact, Eigen::Index points) {
  return M_PI * contact.half_length() / static_cast<double>(points);
}

/// What sums at x miss of the parts of a ring's kernels that go with ln|x|, to be added to the kernels [1/m].
struct MissedSlopes {
  Eigen::RowVectorXd normal;  // by source of the first run
  Eigen::RowVectorXd hoop;    // by source; empty where the surface has no such part
};
MissedSlopes missed_slopes(const RingLogarithms& logarithms, const std::vector<SourceRun>& runs,
                           const Eigen::VectorXd& sources, double x);

/// A resultant by unknown, from its lever arms (S18): `load`, `driving_force` [N/m] or `torque` [N] of the shape.
Eigen::RowVectorXd resultant_row(const IndenterShape& shape, LeverArm (IndenterShape::*arm)(double, double) const,
                                 const TractionSources& sources);

}  // namespace rollres
