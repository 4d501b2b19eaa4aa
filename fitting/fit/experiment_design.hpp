#pragma once

/// Which further measurement would tell most: from the slopes at a fit, for scenes that are not measured yet.
///
/// A value with slopes j (by the scaled parameters) and standard deviation s turns the covariance C into
/// C - C j (C j)^T / (s^2 + j^T C j). What is to be known better is the relative deviation sqrt(c^T C c) of a parameter
/// (c is 1 at it), or of a prediction (c are its slopes over it: c-optimality, Elfving 1952).

#include <string>
#include <vector>

#include "fitting/fit/fit_report.hpp"
#include "fitting/fit/resistance_fit.hpp"

namespace rollres {

/// What is to be known better: a parameter, or a prediction.
struct DesignAim {
  std::string name;
  Eigen::VectorXd direction;  ///< c
};

/// What measuring one scene would do.
struct DesignChoice {
  RollingScene scene;
  std::string set;             ///< data set whose parameters it would have
  double predicted;            ///< [SI]; NaN: it has no answer
  double deviation;            ///< the standard deviation it is thought to have [SI]: relative as the data's median
  Eigen::VectorXd deviations;  ///< of the aims, afterwards [1]
  Eigen::VectorXd slope;       ///< j [SI]
};

struct MeasurementPlan {
  std::vector<DesignAim> aims;
  std::size_t worst;                  ///< the aim with the largest deviation now
  Eigen::VectorXd deviations;         ///< of the aims, now [1]
  std::vector<DesignChoice> choices;  ///< those with an answer; what shrinks the worst most comes first
  Eigen::MatrixXd covariance;         ///< C, now

  /// The worst aim's deviation after a choice over that now.
  double ratio(const DesignChoice& choice) const {
    const auto j = static_cast<Eigen::Index>(worst);
    return choice.deviations[j] / deviations[j];
  }
  /// The aims' deviations with a covariance.
  Eigen::VectorXd deviations_with(const Eigen::MatrixXd& covariance) const;
  void sort();
};

/// What a fit predicts of a scene that is not measured.
struct ScenePrediction {
  double value;           ///< [SI]; NaN: no answer, or slopes that are but noise
  Eigen::VectorXd slope;  ///< by the scaled parameters [SI]
};
/// @param parameters, point, inputs  of the fit
/// @param scenes  their measured values are not used
std::vector<ScenePrediction> predictions_at(const std::vector<FitParameter>& parameters, const FitPoint& point,
                                            const std::vector<FittedInput>& inputs,
                                            const std::vector<MeasuredScene>& scenes, const Evaluate& evaluate,
                                            const ResistanceFitOptions& options = {});
/// The same at the fit.
std::vector<ScenePrediction> predictions_at(const FitReport& report, const std::vector<FittedInput>& inputs,
                                            const std::vector<MeasuredScene>& scenes, const Evaluate& evaluate,
                                            const ResistanceFitOptions& options = {});

/// The covariance by the slopes at the fit. Directions that no datum tells get a deviation of e^10 in place of
/// infinity, so that what tells them is found.
Eigen::MatrixXd design_covariance(const FitReport& report);

/// The median of the data's standard deviations over the predictions [1].
double usual_relative_deviation(const FitReport& report);

/// Each parameter.
std::vector<DesignAim> parameter_aims(const FitReport& report);
/// What the model, without offset and scale, says of each scene; its name is that of its place.
/// @throws std::invalid_argument naming a scene without an answer
std::vector<DesignAim> prediction_aims(const FitReport& report, const std::vector<FittedInput>& inputs,
                                       const std::vector<MeasuredScene>& scenes, const Evaluate& evaluate,
                                       const ResistanceFitOptions& options = {});

/// A plan without choices.
/// @throws std::invalid_argument if the report has no slopes
MeasurementPlan plan_for(const FitReport& report, std::vector<DesignAim> aims);

/// What each scene would do, in their order. @param inputs  of the fit
std::vector<DesignChoice> rated(const MeasurementPlan& plan, const FitReport& report,
                                const std::vector<FittedInput>& inputs, const std::vector<MeasuredScene>& scenes,
                                const Evaluate& evaluate, const ResistanceFitOptions& options = {});

/// The plan with these scenes as its choices. @param aims  default: each parameter
/// @throws std::invalid_argument if the report has no slopes
MeasurementPlan design(const FitReport& report, const std::vector<FittedInput>& inputs,
                       const std::vector<MeasuredScene>& candidates, const Evaluate& evaluate,
                       const ResistanceFitOptions& options = {}, std::vector<DesignAim> aims = {});

/// The choices that together leave the aim which is worst known afterwards best known: one after another, then each
/// exchanged for any other as long as that helps (Fedorov 1972). A choice may be taken more than once.
struct JointChoice {
  std::vector<std::size_t> choices;  ///< places in plan.choices
  Eigen::VectorXd deviations;        ///< of the aims, after all of them [1]
};
JointChoice best_together(const MeasurementPlan& plan, std::size_t count);

/// The covariance with some choices measured.
Eigen::MatrixXd covariance_with(const MeasurementPlan& plan, const std::vector<std::size_t>& places);

}  // namespace rollres
