#pragma once

/// Points as letters on a terminal, for a look at what is being computed.

#include <string>
#include <vector>

namespace rollres {

struct TextPlotAxis {
  std::string name;          ///< "speed [m/s]"
  bool logarithmic = false;  ///< then all numbers are positive
};

struct TextPlotCurve {
  std::string label;  ///< "20 kN/m"; empty if there is one curve
  std::vector<std::pair<double, double>> points;
};

/// Lines that end with a newline, `width` letters at most and `height` lines of points: each curve has a letter of its
/// own, o where there is one alone. Numbers that are not finite are left out; empty if nothing is left.
std::string text_plot(const TextPlotAxis& x, const TextPlotAxis& y, const std::vector<TextPlotCurve>& curves,
                      std::size_t width, std::size_t height);

}  // namespace rollres
