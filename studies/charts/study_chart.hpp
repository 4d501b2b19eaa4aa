#pragma once

/// The charts of a stored study: any number against any number, one curve for each value of its other axes; and its
/// map, one output over two of its axes.

#include <stdexcept>

#include "studies/drawing/map_chart.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/study/study_definition.hpp"

namespace rollres {

/// What to show; what is empty is taken from a chart of the study file, else: x is the first of the axes with the most
/// values, y the rolling resistance, and the family all other axes that have more than one value and do not follow from
/// x because they vary together with it. The axes of a map are the two with the most values.
struct StudyChartOptions {
  std::string study = {};                      ///< may be left out if the database holds one study
  std::vector<std::string> more_studies = {};  ///< drawn together with it, each a family; the first one's file counts
  std::string chart = {};                      ///< name or number of a chart of the study file; empty: the first
  std::string x = {}, y = {}, family = {};
  bool shares = false;  ///< what of the rolling resistance is lost in the layer and what to friction, stacked
  std::vector<Filter> filters = {};  ///< rows to show
  AxisScale x_scale = AxisScale::automatic, y_scale = AxisScale::automatic;
  std::string map = {};  ///< output of a map; empty: the rolling resistance
  AxisScale map_scale = AxisScale::automatic;
  std::string optimum = {};  ///< an optimisation in the same database whose designs and optimum are drawn into the map
};

/// A stored study as a chart or a map.
template <class Request>
struct StoredPicture {
  std::string study;
  Request request = {};
  std::size_t points = 0;      ///< rows shown
  std::size_t unanswered = 0;  ///< of these, not converged
  std::int64_t missing = 0;    ///< points of the study that are not computed yet
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

/// A study as it is read for a picture.
struct ShownStudy {
  std::string file;  ///< of the database
  StudySummary study;
  StudyDefinition definition;
  StudyRows rows;

  ShownStudy(ResultStore& store, const StudyChartOptions& options);
  std::size_t unanswered() const;  ///< rows that have not converged
  std::string title() const;       ///< the comment of the study file, its first clause where it is long; or the name
  std::string comment() const;     ///< for the head of a data file
};

/// Filters as a subtitle says them: "load = 20 kN/m, speed > 1 m/s".
std::string filters_in_words(const std::vector<Filter>& filters, const StudyRows& rows);
/// What of body, layer and operation is the same in all rows and in no filter, by symbols: "R = 20 mm, H = 5 mm".
std::string fixed_in_words(const std::vector<Filter>& filters, const StudyRows& rows);
/// Both.
std::string subtitle_of(const std::vector<Filter>& filters, const StudyRows& rows);

/// Names of the charts in the study's file, or their numbers; one where the file has none.
/// @param study  may be empty if the database holds one study
std::vector<std::string> stored_charts(ResultStore& store, const std::string& study);

/// A chart of the study's file, by its name or number; the first for an empty name.
/// @throws std::invalid_argument naming the charts that there are
StudyChart chart_of_file(ResultStore& store, const std::string& study, const std::string& chart);

/// Reads the curves of a study; the points of a sample of several inputs are not joined. An axis is logarithmic if the
/// study spaced it so, or if its values are positive and span two decades or more; units are scaled to be read easily.
/// Rolling resistance, and its coefficient, has a band as wide as its estimated error on either side.
/// @throws std::invalid_argument naming what is unknown (and the nearest known name), what cannot be drawn, or that no
///         row is left
/// @throws TooManyCurves
/// @throws std::runtime_error naming the file if the database fails
StoredChart stored_chart(ResultStore& store, const StudyChartOptions& options);

/// Reads the map of a study.
/// @throws std::invalid_argument naming what is unknown, what cannot be drawn (fewer than two values along an axis,
///         several points at one place: a further axis must be fixed by a filter), or that no row is left
/// @throws std::runtime_error naming the file if the database fails
StoredMap stored_map(ResultStore& store, const StudyChartOptions& options);

}  // namespace rollres
