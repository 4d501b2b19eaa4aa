#pragma once

/// Predictions of a fit as a table, as JSON and as a chart with the data. For sources only: it needs nlohmann_json.

#include <filesystem>
#include <string>

#include "studies/drawing/chart.hpp"
#include "studies/predict/predicted_scenes.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// What a fit says of some scenes.
struct FitPredictions {
  PredictedAs as;
  PredictedScenes asked;
  std::vector<PredictedScene> values;  ///< of the scenes, in their order

  std::size_t without_answer() const;
};

/// @throws std::invalid_argument as predicted_scenes, predicted
FitPredictions predictions_of(const FitRecord& fit, const std::filesystem::path& scenes, PredictedAs as,
                              const std::string& set, const Evaluate& evaluate, int jobs = 0);

/// A line that says what is predicted, and a row for each scene.
std::string prediction_summary(const FitRecord& fit, const FitPredictions& predictions);

/// A list with an object for each scene: its inputs, value, standard_error, lowest, highest, measured; SI.
Json json_of(const FitPredictions& predictions);

/// The predictions with their intervals over the input that varies, the speed first, and the data of the fit. Data are
/// drawn without offset and scale where true values are predicted.
/// @throws std::invalid_argument if no input of the scenes varies and none of the data is drawn over one
ChartRequest prediction_chart(const FitRecord& fit, const FitPredictions& predictions);

}  // namespace rollres
