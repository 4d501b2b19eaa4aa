#pragma once

/// The charts of a stored study: any number against any number, one curve for each value of its other axes; and its
/// map, one output over two of its axes.

#include <stdexcept>

#include "studies/charts/shown_study.hpp"
#include "studies/drawing/map_chart.hpp"

namespace rollres {

/// A stored study as a chart or a map.
template <class Request>
struct StoredPicture {
  std::string study;
  Request request = {};
  std::size_t points = 0;                  ///< rows shown
  std::size_t unanswered = 0;              ///< of these, not converged
  std::int64_t missing = 0;                ///< points of the study that are not computed yet
  std::string x = {};                      ///< of a chart: the key along x
  std::vector<std::string> families = {};  ///< and those whose values tell its curves apart
};
using StoredChart = StoredPicture<ChartRequest>;
using StoredMap = StoredPicture<MapRequest>;

/// Curves of more values than this cannot be told apart any more.
inline constexpr std::size_t most_curves = 24;

/// A chart would need more curves than that: an axis must be fixed.
class TooManyCurves : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Reads the curves of a study; the points of a sample of several inputs are not joined. An axis is logarithmic if the
/// study spaced it so, or if its values are positive and span two decades or more; units are scaled to be read easily.
/// Rolling resistance, and its coefficient, has a band as wide as its estimated error on either side.
/// @throws std::invalid_argument naming what is unknown (and the nearest known name), what cannot be drawn, or that no
///         row is left
/// @throws TooManyCurves
/// @throws std::runtime_error naming the file if the database fails
StoredChart stored_chart(ResultStore& store, const StudyChartOptions& options);
/// The same of a study that is read already, with the filters of the options.
StoredChart stored_chart(const ShownStudy& shown, const StudyChartOptions& options);

/// Reads the map of a study.
/// @throws std::invalid_argument naming what is unknown, what cannot be drawn (fewer than two values along an axis,
///         several points at one place: a further axis must be fixed by a filter), or that no row is left
/// @throws std::runtime_error naming the file if the database fails
StoredMap stored_map(ResultStore& store, const StudyChartOptions& options);
/// The same of a study that is read already; the store has the optimisation.
StoredMap stored_map(ResultStore& store, const ShownStudy& shown, const StudyChartOptions& options);

}  // namespace rollres
