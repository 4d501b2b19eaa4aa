#pragma once

/// Charts of more points than a picture shows.

#include "studies/drawing/chart.hpp"

namespace rollres {

/// The same picture of half as many points or fewer, which the subtitle says, where a chart has more than 4,000. Of a
/// curve each of a thousand steps along x keeps its first, last, lowest and highest point, and one of each kind that
/// the line does not pass through; of points without lines those that lie in one place remain one, and the outermost
/// remain.
ChartRequest thinned(const ChartRequest& request);

}  // namespace rollres
