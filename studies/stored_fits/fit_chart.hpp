#pragma once

/// Pictures of a stored fit: data with error bars and the fitted curves with their 95 % bands, residuals against each
/// input, normal quantiles, the profile of each parameter, and ellipses of the pairs that are hardest to separate.

#include <filesystem>
#include <string>
#include <vector>

#include "db/rows/fit_store.hpp"
#include "studies/drawing/chart.hpp"

namespace rollres {

struct FitChart {
  std::string name;     ///< "data", "residuals", "residuals_load", "quantiles", "profile_creep_time", "ellipse"
  std::string meaning;  ///< a sentence
  ChartRequest request;
};

/// All that can be drawn of a fit; none without its data.
std::vector<FitChart> fit_charts(const FitRecord& fit);

/// Draws them all and returns their SVG files: NAME_CHART in `folder`.
/// @throws std::runtime_error as draw_chart
std::vector<std::filesystem::path> draw_fit(const FitRecord& fit, const std::filesystem::path& folder);

}  // namespace rollres
