#pragma once

/// What makes a chart of a report answer to the mouse: points that tell their numbers, and buttons that show one curve
/// alone. The chart itself stays a picture; without scripts the points still tell their numbers, and without either
/// nothing is missing.

#include <string>
#include <string_view>

#include "studies/drawing/chart.hpp"

namespace rollres {

struct ChartOverlay {
  std::string layer;    ///< an <svg> of the picture's size, to lie upon it
  std::string buttons;  ///< one for each of several curves
};

/// Empty for a picture whose frame is not found in it, and for charts of very many points.
/// @param svg  the picture, drawn of this request
ChartOverlay chart_overlay(const ChartRequest& request, std::string_view svg);

}  // namespace rollres
