#pragma once

/// A stored study, or several together, as it is read for a picture; what is the same in all that a picture shows.

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

/// A study as it is read for a picture.
struct ShownStudy {
  std::string file;  ///< of the database
  StudyOutline study;
  StudyDefinition definition;
  StudyRows rows;

  ShownStudy(ResultStore& store, const StudyChartOptions& options);
  /// The rows of one study that meet other filters. @throws std::invalid_argument if there is none
  ShownStudy(const ShownStudy& shown, ResultStore& store, const std::vector<Filter>& filters);
  std::size_t unanswered() const;  ///< rows that have not converged
  std::string title() const;       ///< the comment of the study file, its first clause where it is long; or the name
  std::string comment() const;     ///< for the head of a data file

 private:
  ShownStudy(ResultStore& store, const std::vector<std::string>& names, const std::vector<Filter>& filters);
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

}  // namespace rollres
