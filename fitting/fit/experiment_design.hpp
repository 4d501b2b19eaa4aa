#pragma once

/// Which further measurement would tell most: from the slopes at a fit, for scenes that are not measured yet.
///
/// A value with slopes j (by the scaled parameters) and standard deviation s turns the covariance C into
/// C - C j (C j)^T / (s^2 + j^T C j).

#include <vector>

#include "fitting/fit/fit_report.hpp"
#include "fitting/fit/resistance_fit.hpp"

namespace rollres {

/// What measuring one scene would do.
struct DesignChoice {
  RollingScene scene;
  std::string set;             ///< data set whose parameters it would have
  double predicted;            ///< [SI]
  double deviation;            ///< the standard deviation it is thought to have [SI]: relative as the data's median
  Eigen::VectorXd deviations;  ///< of the scaled parameters, afterwards
  Eigen::VectorXd slope;       ///< j [SI]
};

struct MeasurementPlan {
  std::size_t worst;                  ///< the parameter with the largest standard deviation now
  Eigen::VectorXd deviations;         ///< of the scaled parameters, now
  std::vector<DesignChoice> choices;  ///< those with an answer; what shrinks the worst most comes first
  Eigen::MatrixXd covariance;         ///< C, now

  /// The worst parameter's deviation after a choice over that now.
  double ratio(const DesignChoice& choice) const {
    const auto j = static_cast<Eigen::Index>(worst);
    return choice.deviations[j] / deviations[j];
  }
};

/// @param inputs      of the fit
/// @param candidates  scenes; their measured values are not used
/// @throws std::invalid_argument if the report has no slopes
MeasurementPlan design(const FitReport& report, const std::vector<FittedInput>& inputs,
                       std::vector<MeasuredScene> candidates, const Evaluate& evaluate,
                       const ResistanceFitOptions& options = {});

/// The choices that together leave the parameter which is worst known afterwards best known: one after another, then
/// each exchanged for any other as long as that helps (Fedorov 1972). A choice may be taken more than once.
struct JointChoice {
  std::vector<std::size_t> choices;  ///< places in plan.choices
  Eigen::VectorXd deviations;        ///< of the scaled parameters, after all of them
};
JointChoice best_together(const MeasurementPlan& plan, std::size_t count);

}  // namespace rollres
