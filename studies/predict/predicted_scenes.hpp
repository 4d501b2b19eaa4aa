#pragma once

/// Reads the scenes that a fit is asked to predict.
///
/// A scene file and the points of a study stand for themselves. The rows of a CSV file stand in the scene of the fit,
/// as those of its own data do: a column for each input that varied there, others as wanted, and beside them `data`
/// (the data set), `sigma` (of one more measurement) and the measured output. The fitted values are put into all of
/// them.

#include <filesystem>
#include <string>
#include <vector>

#include "studies/predict/fit_prediction.hpp"

namespace rollres {

struct PredictedScenes {
  std::string output;               ///< its key
  std::vector<std::string> inputs;  ///< that tell the scenes apart, real numbers: axes of a study, columns of a table
  std::vector<AskedScene> scenes;
};

/// @param set  data set whose offset, scale, noise and own parameters count; empty: the first with the fit's output
/// @throws std::invalid_argument naming file, line or key, value and rule
/// @throws std::runtime_error if a file cannot be read
PredictedScenes predicted_scenes(const FitRecord& fit, const std::filesystem::path& file, const std::string& set = {});

}  // namespace rollres
