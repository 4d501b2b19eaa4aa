#pragma once

/// The map of a stored study: one output over two of its axes.

#include <string>
#include <vector>

#include "db/queries/query.hpp"
#include "db/rows/result_store.hpp"
#include "studies/drawing/map_chart.hpp"
#include "studies/stored/study_rows.hpp"

namespace rollres {

/// What to show; empty axes: the two axes of the study with the most values.
struct StudyMapOptions {
  std::string study = {};  ///< may be left out if the database holds one study
  std::string value = "rolling_resistance";
  std::string x = {}, y = {};
  std::vector<Filter> filters = {};  ///< rows to show
  AxisScale x_scale = AxisScale::automatic, y_scale = AxisScale::automatic, value_scale = AxisScale::automatic;
  std::string optimum = {};  ///< an optimisation in the same database whose designs and optimum are drawn into the map
};

struct StoredMap {
  std::string study;
  MapRequest request;
  std::size_t points = 0;      ///< rows shown
  std::size_t unanswered = 0;  ///< of these, not converged
};

/// @throws std::invalid_argument naming what is unknown, what cannot be drawn (fewer than two values along an axis,
///         several points at one place: a further axis must be fixed by a filter), or that no row is left
/// @throws std::runtime_error naming the file if the database fails
StoredMap stored_map(ResultStore& store, const StudyMapOptions& options);

}  // namespace rollres
