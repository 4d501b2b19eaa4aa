#pragma once

/// Horizontal bars with error bars, drawn by gnuplot as every picture of this program (chart.hpp).

#include "studies/drawing/chart.hpp"

namespace rollres {

struct BarValue {
  double value = 0;  ///< NaN: no bar
  double error = 0;  ///< half the length of its error bar; NaN: none
};

/// One name with a bar for each series.
struct Bar {
  std::string name;
  std::string symbol = {};  ///< as Quantity writes it
  std::vector<BarValue> values;
};

struct BarChart {
  std::string title;
  ChartAxis axis;                        ///< of the values
  std::vector<std::string> series = {};  ///< names for the legend; empty for one series
  std::vector<Bar> bars;                 ///< from top to bottom
};

/// @throws std::invalid_argument as chart_files, or if no bar has a value
/// @throws std::runtime_error as draw_chart
ChartFiles draw_bar_chart(const BarChart& chart, const std::filesystem::path& name,
                          const std::string& gnuplot = "gnuplot");

}  // namespace rollres
