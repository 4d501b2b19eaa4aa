#pragma once

/// The values of contour lines, written on the lines, as labels of a gnuplot script.

#include <array>
#include <functional>
#include <iosfwd>
#include <vector>

#include "studies/drawing/chart_frame.hpp"

namespace rollres {

/// Writes the levels of contour lines on them, each where none stands yet and away from the frame; small loops bear
/// none.
/// @param loops  in the units of the axes   @param taken  places that are to stay free, in the same units
/// @param shown  whether there is a line to be seen at a place of it; absent: everywhere
void write_contour_levels(std::ostream& script, const std::vector<ContourLoop>& loops, const Span& x, const Span& y,
                          const std::vector<std::array<double, 2>>& taken = {},
                          const std::function<bool(const std::array<double, 2>&)>& shown = {});

}  // namespace rollres
