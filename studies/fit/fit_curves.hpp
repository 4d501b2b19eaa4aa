#pragma once

/// The fitted curves between the measured values of a resistance fit.

#include <string>
#include <vector>

#include "studies/drawing/chart.hpp"
#include "studies/fit/fit_file.hpp"

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

/// How closely curves are drawn: for the store quickly, for pictures with slopes of their own.
struct CurveDetail {
  int points = 41;
  std::size_t most_curves = 1000;  ///< of more, only the data are in the answer
  bool slopes = true;              ///< else bands are drawn between those at the data
};
inline constexpr CurveDetail for_the_store{.points = 25, .most_curves = 6, .slopes = false};

/// Output against the speed (or, where that does not vary, the first input that does), one curve for each combination
/// of the other inputs, with its 95 % band. @param evaluate called by several threads at once; where it throws
/// Interrupted, points are missing
FitCurves fit_curves(const FitFile& file, const FitReport& report, const Evaluate& evaluate, int jobs,
                     const CurveDetail& detail = {});

}  // namespace rollres
