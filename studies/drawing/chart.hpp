#pragma once

/// A chart as a plain value, drawn by gnuplot as SVG and PNG. The script and the data stay beside the pictures, so that
/// a chart can be restyled: change NAME.gp and run "gnuplot NAME.gp" in its folder.
///
/// Every curve differs by colour (safe for colour-blind readers), dash and mark; curves in an order go from dark to
/// light, and where there are many each bears its label, and its peak, at its end; of two families one is told by
/// colour, the other by dash and mark. A point that did not converge is drawn hollow; one without a value is a cross on
/// the lower edge; the line of a curve never passes over either. A curve may have an area from `low` to `high` of its
/// points: a band, left out where it is too narrow to be seen, or its part of a stack.

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace rollres {

/// One point, in the units of the axes. A y that is NaN has no value; with `converged` it was not computed.
struct ChartPoint {
  double x = 0;
  double y = 0;
  bool converged = true;
  double low = std::numeric_limits<double>::quiet_NaN(), high = low;  ///< ends of an area drawn here; NaN: none

  bool area() const { return std::isfinite(low) && std::isfinite(high); }
  bool drawn() const { return std::isfinite(x) && std::isfinite(y); }
  bool joined() const { return drawn() && converged; }  ///< the line passes through it
};

/// What an axis or the family shows: "rolling resistance", "R_r" (as Quantity writes it), "N/m".
struct ChartAxis {
  std::string name;
  std::string symbol = {};
  std::string unit = {};
  bool logarithmic = false;  ///< drawn linear all the same if a value is not positive
  double margin = 0;         ///< of the x axis: left free at either end, as a fraction of its length
};

struct ChartCurve {
  std::string label;                      ///< the value of the family: "20 kN/m"
  std::vector<ChartPoint> points;         ///< in the order in which the line joins them
  std::optional<std::size_t> like = {};   ///< looks as this other curve: the line through its points; without a label
  bool marks = true;                      ///< on some of its points; else only on those that no line reaches
  bool line = true;                       ///< joins its points, where the chart has lines
  std::array<std::size_t, 2> place = {};  ///< of its values in the chart's two families
  bool extrapolated = false;              ///< dashed, and explained; where one is, the others are solid
};

/// One of two families whose values together tell the curves apart.
struct ChartFamily {
  ChartAxis axis;                   ///< its symbol or, where it has none, its name stands before each value
  std::vector<std::string> labels;  ///< of its values
};

/// A part of the x axis that is shaded over the whole height, and explained.
struct ChartRange {
  double from, to;
  std::string meaning;
};

inline constexpr std::string_view not_converged = "not converged";

struct ChartRequest {
  std::string title;          ///< broken into two lines where it is long
  std::string subtitle = {};  ///< what is shown of it: "load = 20 kN/m"
  ChartAxis x, y;
  ChartAxis family = {};  ///< the legend says "symbol = label"
  std::vector<ChartFamily> families =
      {};  ///< two: colours from dark to light tell the first, dashes and marks the second
  std::vector<ChartCurve> curves;
  bool ordered = false;                             ///< the curves come in the order of the family's values
  bool end_labels = true;                           ///< many curves in an order bear their labels at their ends
  std::string hollow = std::string(not_converged);  ///< what a point is that is drawn hollow
  std::string areas = {};  ///< what the areas of the points mean, as bands round the curves; empty: they fill the chart
  std::optional<ChartRange> range = {};
  bool lines = true;         ///< join the points of a curve; else each bears a mark and no peak is marked
  bool marks = true;         ///< on some points of each curve; else the line alone
  bool mark_peaks = true;    ///< marks the peak of each curve with its value
  std::string comment = {};  ///< what else to know, line by line, for the head of the data file
};

/// The files of a chart, which share one name.
struct ChartFiles {
  std::filesystem::path script, data, svg, png;
};

/// Place of the largest converged value of a curve that has a converged, smaller or equal value on either side; empty
/// for a curve that only rises or falls: there the largest value is an end of the study, not a peak.
std::optional<std::size_t> peak(const ChartCurve& curve);

/// The four files of a chart. A suffix .svg, .png, .gp or .dat of `name` is dropped.
/// @throws std::invalid_argument if the name of the file is empty or has a control character
ChartFiles chart_files(const std::filesystem::path& name);
/// The name of one of several pictures beside it: it ends with `ending`. @throws likewise
std::filesystem::path one_of_several(const std::filesystem::path& name, const std::string& ending);

/// The data file: one block for each curve, its columns x, y, converged (1 or 0), marked (1 or 0), and the ends of its
/// area.
std::string chart_data(const ChartRequest& request);

/// The gnuplot script. It names the files without their folder and is to be run there.
std::string chart_script(const ChartRequest& request, const ChartFiles& files);

/// What a picture is called and what it shows, for those who hear it instead of seeing it.
struct PictureWords {
  std::string title, description = {};
};

/// Lets gnuplot draw the pictures of a script; older ones are removed before.
/// @param pictures  .svg, .png, .gif, in the script's folder
/// @throws std::runtime_error if gnuplot is missing or fails (with its own words), or a picture is missing or cut off
void run_script(const std::filesystem::path& script, const std::vector<std::filesystem::path>& pictures,
                const std::string& gnuplot = "gnuplot");

/// Writes script and data and lets gnuplot draw the two pictures: what every picture of this program does. The words go
/// into the SVG.
/// @throws std::runtime_error as draw_chart
void draw_pictures(const ChartFiles& files, const std::string& data, const std::string& script,
                   const PictureWords& words, const std::string& gnuplot = "gnuplot");

/// Writes script and data and draws the pictures; folders are made, older files of that name replaced. Of many points
/// some are drawn (thinned_chart.hpp).
/// @param gnuplot the program that draws
/// @throws std::invalid_argument as chart_files, or if there is nothing to draw: no point has a value
/// @throws std::runtime_error if a file cannot be written, or if gnuplot is missing or fails (with its own words)
ChartFiles draw_chart(const ChartRequest& request, const std::filesystem::path& name,
                      const std::string& gnuplot = "gnuplot");

}  // namespace rollres
