#pragma once

/// A contour map of one number over two others, drawn by gnuplot as every picture of this program (chart.hpp): bands of
/// perceptually uniform colours; axes and values may be logarithmic.
///
/// Around a node without an answer the map is blank, and the node bears a cross, or a hollow mark if it has a value
/// that is not converged. Where there is no steady state it is grey: the region that a body does not bear.

#include "studies/drawing/chart.hpp"
#include "studies/drawing/contour_loops.hpp"

namespace rollres {

enum class MapNode : signed char { answered, not_converged, unanswered, no_steady_state, not_computed };

struct MapPoint {
  double x = 0, y = 0;
};

/// A constraint: by how much it is kept or broken at each node of the field.
struct MapLimit {
  std::string meaning;         ///< "peak_pressure <= 4 MPa"
  std::vector<double> excess;  ///< above 0 where it is broken, NaN where that is not known
};

struct MapRequest {
  std::string title, subtitle = {};
  ChartAxis x, y, value;
  PlaneField field;                      ///< in the units of the axes; NaN where there is no answer
  std::vector<MapNode> nodes;            ///< of the field's nodes, in their order
  std::vector<MapLimit> limits = {};     ///< constraints on what is shown
  std::vector<MapPoint> designs = {};    ///< that an optimisation looked at: small dots
  std::optional<MapPoint> optimum = {};  ///< its best: a star
  std::string optimum_meaning = {};      ///< "least rolling_resistance"
  std::string comment = {};              ///< for the head of the data file, line by line
};

/// Place of the largest answer that no answer around it exceeds and that is not at the border, or empty.
std::optional<std::size_t> map_peak(const MapRequest& request);

/// @throws std::invalid_argument as chart_files, or if fewer than two columns or rows have an answer
/// @throws std::runtime_error as draw_chart
ChartFiles draw_map(const MapRequest& request, const std::filesystem::path& name,
                    const std::string& gnuplot = "gnuplot");

}  // namespace rollres
