#pragma once

/// Pictures of a fit: data with error bars and the fitted curves with their 95 % bands, residuals, the profile of each
/// parameter, and the ellipse of the two that are hardest to separate.

#include <filesystem>
#include <string>
#include <vector>

#include "fitting/fit/fit_report.hpp"
#include "studies/drawing/chart.hpp"

namespace rollres {

/// One family of data and its fitted curve [SI].
struct FitCurve {
  std::string label;
  std::vector<double> x = {}, value = {}, band = {};  ///< band: half-width
  std::vector<double> data_x = {};                    ///< of its data
  std::vector<std::size_t> data = {};                 ///< their places in the report
};

struct FitCurves {
  ChartAxis x, y;  ///< units: SI
  std::vector<FitCurve> curves;
};

/// Draws all pictures and returns their SVG files: NAME_data, NAME_residuals, NAME_profile_KEY, NAME_ellipse in
/// `folder`.
/// @throws std::runtime_error as draw_pictures
std::vector<std::filesystem::path> draw_fit(const FitReport& report, const FitCurves& curves, const std::string& name,
                                            const std::filesystem::path& folder, Indenter indenter);

}  // namespace rollres
