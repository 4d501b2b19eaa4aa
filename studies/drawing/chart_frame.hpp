#pragma once

/// What every picture of this program has around its plots, as lines of its gnuplot script: axes and grid, and above
/// them a title and a legend that stands clear of the points; drawn as SVG and PNG. And a picture in the making.

#include <sstream>

#include "studies/drawing/chart.hpp"
#include "studies/drawing/contour_loops.hpp"

namespace rollres {

/// What an axis spans.
struct Span {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  bool logarithmic = false;

  double along(double value) const { return logarithmic ? std::log10(value) : value; }
  double back(double place) const { return logarithmic ? std::pow(10.0, place) : place; }
  double decades() const { return std::log10(highest / lowest); }
  /// 0 at the lower end of the axis, 1 at the upper.
  double fraction(double value) const { return (along(value) - along(lowest)) / (along(highest) - along(lowest)); }

  void include(double value) {
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  /// Widens the axis by fractions of its length; an axis of no length becomes one around its value.
  void widen(double below, double above) {
    const double from = along(lowest), to = along(highest);
    const double length = to > from ? to - from : (logarithmic ? 1.0 : std::max(0.2 * std::abs(to), 1e-12));
    if (to <= from) below = above = 0.5;
    lowest = back(from - below * length);
    highest = back(to + above * length);
  }
};

/// A step of 1, 2 or 5 times a power of ten that divides a length into so many parts or some more, up to 2.5 times as
/// many.
double even_step(double length, double fewest = 4);

/// gnuplot keeps the blanks of an SVG's text only where two stand together.
inline constexpr const char* kept_blanks = "  ";

/// Colour of the n-th curve: those of Okabe and Ito (2008) without their yellow, the two lightest darkened to a
/// contrast of 3 to white, seven in turn.
std::string_view curve_colour(std::size_t curve);

/// What the axes of a chart span.
struct ChartSpans {
  Span x, y;
};
ChartSpans chart_spans(const ChartRequest& request);

/// Colour of a curve of a chart.
std::string curve_colour(const ChartRequest& request, std::size_t curve);

/// One entry of the legend.
struct LegendEntry {
  std::string sample;   ///< how it looks: "points pt 7 lc rgb 'red'"
  std::string markup;   ///< what it says, in gnuplot's markup
  std::size_t letters;  ///< of what it says
  bool new_row = false;

  static LegendEntry plain(std::string sample, std::string_view text);
};

/// The head of a script: the data file (as `data`), axes with labels and numbers, grid.
void write_axes(std::ostream& script, const ChartFiles& files, const ChartAxis& x, const Span& x_span,
                const ChartAxis& y, const Span& y_span);

/// Left edge of a plot that leaves room for the numbers of its y axis and, at the picture's edge, for its label [px].
double left_edge_for(const Span& y);

/// Sizes of a picture in pixels of its SVG, which is 560 wide.
struct PictureShape {
  double height = 345;                       ///< of all that stands below title and legend
  double left = 0, right = 535, bottom = 0;  ///< of the plot, from the left and the lower edge; 0: as the numbers need
  double gap = 10;                           ///< above the plot
  bool surface = false;                      ///< the plots are of gnuplot's splot
  std::string subtitle = {};                 ///< below the title, smaller
};

/// The tail of a script: title, legend and the two pictures of all `plots` ("data index 0 using 1:2 with lines").
void write_pictures(std::ostream& script, const ChartFiles& files, const std::string& title,
                    std::vector<std::string> plots, const std::vector<LegendEntry>& entries,
                    const PictureShape& shape = {});

/// A row of numbers; an empty row is a blank line, which ends a line of a surface.
using DataRow = std::vector<double>;

/// The points of a loop, the first one again at the end.
std::vector<DataRow> closed(const ContourLoop& loop);

/// Script and data of a picture.
struct PictureText {
  std::string script, data;
};

/// A picture in the making: its axes are written, plots and legend come one by one. The data are named blocks of
/// columns, as gnuplot's `index` finds them.
class PictureBuilder {
 public:
  PictureBuilder(std::string_view title, const ChartFiles& files, const ChartAxis& x, const Span& x_span,
                 const ChartAxis& y, const Span& y_span);

  std::ostream& script() { return script_; }
  /// Adds a block of data; returns how a plot refers to it: "data index 2".
  /// @param columns what stands in them: "x [mm], u [mm]"   @param digits of the numbers
  std::string add(std::string_view name, std::string_view columns, const std::vector<DataRow>& rows, int digits = 8);
  /// Loops as one block, closed and apart from each other by blank lines.
  std::string add(std::string_view name, std::string_view columns, const std::vector<ContourLoop>& loops);
  void plot(std::string words) { plots_.push_back(std::move(words)); }
  void explain(LegendEntry entry) { legend_.push_back(std::move(entry)); }

  PictureText finished(const std::string& title, const PictureShape& shape = {});

 protected:
  std::vector<LegendEntry> legend_;

 private:
  ChartFiles files_;
  Span x_span_, y_span_;
  std::string y_label_;
  std::ostringstream script_;
  std::string data_;
  int blocks_ = 0;
  std::vector<std::string> plots_;
};

}  // namespace rollres
