#pragma once

/// How a number scatters, as pictures: its histogram and its cumulative distribution.

#include <string>

#include "studies/drawing/chart.hpp"
#include "studies/stored/scatter_results.hpp"

namespace rollres {

/// A number that scatters at some places, and what to call it.
struct ScatterPicture {
  std::string title;
  ChartAxis axis;  ///< name and symbol of the number
  std::string unit;
  std::vector<std::string> labels;     ///< of each place: "V = 1 m/s"
  std::vector<ScatterBatches> values;  ///< of each place
  std::string comment = {};
  bool ordered = false;  ///< the places are in the order of a number
};

/// Shares of the values in bins of equal width, as steps; with one place filled to the axis.
ChartRequest histogram_chart(const ScatterPicture& picture);

/// The probability of a value below x.
ChartRequest cumulative_chart(const ScatterPicture& picture);

}  // namespace rollres
