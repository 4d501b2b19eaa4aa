#pragma once

/// The predictions of `rollres fit --predict`, of a fit just made and of a stored one. For sources only: it needs
/// nlohmann_json.

#include <string>

#include "studies/predict/prediction_report.hpp"
#include "studies/program/commands.hpp"

namespace rollres {

struct PredictArguments {
  std::string scenes, as = "true_value", data;
  std::string out;  ///< folder of the chart; empty: none
  int jobs = 0;
  bool json = false;
};

/// Tells the predictions as text where no JSON is wanted, draws them, and returns them for it. The exit status becomes
/// 1 where a scene has no answer.
Json tell_predictions(const FitRecord& fit, const PredictArguments& wanted, const Evaluate& evaluate, Session& session);

/// Predicts by a fit that a database holds. The exit status is that of the fit.
/// @throws std::invalid_argument if there is none of the name
void predict_by_stored_fit(const std::string& name, const std::string& database, const PredictArguments& wanted,
                           Session& session);

}  // namespace rollres
