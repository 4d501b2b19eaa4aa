#pragma once

/// What every picture of this program has around its plots, as lines of its gnuplot script: axes and grid, and above
/// them a title and a legend that stands clear of the points; drawn as SVG and PNG.

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "studies/drawing/chart.hpp"
#include "studies/drawing/chart_layout.hpp"

namespace rollres {

/// gnuplot keeps the blanks of an SVG's text only where two stand together.
inline constexpr const char* kept_blanks = "  ";

/// Colour of the n-th curve: those of Okabe and Ito (2008) without their yellow, seven in turn.
std::string_view curve_colour(std::size_t curve);

/// One entry of the legend.
struct LegendEntry {
  std::string sample;   ///< how it looks: "points pt 7 lc rgb 'red'"
  std::string markup;   ///< what it says, in gnuplot's markup
  std::size_t letters;  ///< of what it says
};

/// The head of a script: the data file (as `data`), axes with labels and numbers, grid.
void write_axes(std::ostream& script, const ChartFiles& files, const ChartAxis& x, const Span& x_span,
                const ChartAxis& y, const Span& y_span);

/// Sizes of a picture in pixels of its SVG, which is 560 wide.
struct PictureShape {
  double height = 345;                       ///< of all that stands below title and legend
  double left = 0, right = 535, bottom = 0;  ///< of the plot, from the left and the lower edge; 0: as the numbers need
  double gap = 10;                           ///< above the plot
  bool surface = false;                      ///< the plots are of gnuplot's splot
};

/// The tail of a script: title, legend and the two pictures of all `plots` ("data index 0 using 1:2 with lines").
void write_pictures(std::ostream& script, const ChartFiles& files, const std::string& title,
                    std::vector<std::string> plots, const std::vector<LegendEntry>& entries,
                    const PictureShape& shape = {});

}  // namespace rollres
