#pragma once

/// The fitted curves between the measured values of a resistance fit.

#include "studies/fit/fit_chart.hpp"
#include "studies/fit/fit_file.hpp"

namespace rollres {

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
