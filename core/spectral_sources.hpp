#pragma once

/// Points and weights that stand for the tractions where smooth functions of x act on them: the layer's correction, the
/// resultants.

#include <Eigen/Core>
#include <vector>

#include "core/sliding_base.hpp"

namespace rollres {

struct TractionSources {
  Eigen::VectorXd x;                      // [m]; the contact's own nodes first
  Eigen::MatrixXd of_pressure, of_shear;  // [source, unknown]: force per unknown [m]
};

/// @param base if there is friction   @param stick_places of the first coefficient of each zone of stick among the
/// unknowns; those of the pressure are the first   @param unknowns their number
TractionSources traction_sources(const SlipPattern& pattern, const SpectralEdges& edges, const SpectralOrders& orders,
                                 const SlidingBase* base, double friction,
                                 const std::vector<Eigen::Index>& stick_places, Eigen::Index unknowns);

/// Resultants by unknown, as in core/contact_problem.hpp: P [N/m], Q [N/m], T/R [N/m].
Eigen::RowVectorXd load_row(const SpectralProblem& problem, const TractionSources& sources);
Eigen::RowVectorXd force_row(const SpectralProblem& problem, const TractionSources& sources);
Eigen::RowVectorXd torque_row(const TractionSources& sources);

}  // namespace rollres
