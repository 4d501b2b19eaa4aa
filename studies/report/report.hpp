#pragma once

/// A study as one HTML file that can be sent: what was asked, the scene, the model, charts, results, failures, the fit
/// of that name if there is one, errors against seconds, and what computed it. Pictures are inside; it needs no network
/// and can be read without scripts.

#include <string>
#include <vector>

#include "db/queries/query.hpp"
#include "db/rows/result_store.hpp"

namespace rollres {

struct ReportOptions {
  std::string study = {};                      ///< may be left out if the database holds one study
  std::vector<std::string> more_studies = {};  ///< that follow it, after a chart of all
  std::size_t most_rows = 200;                 ///< of the table of results; of a longer study every n-th point
  std::string optimum = {};                    ///< an optimisation in the same database to be drawn into the map
  std::string x = {}, family = {};             ///< of its charts of curves; empty: as StudyChartOptions
  std::vector<Filter> filters = {};            ///< rows that its charts show
};

struct StudyReport {
  std::string study;
  std::string html;
  std::size_t pictures = 0;
  std::string title = {};  ///< of the page
};

/// @throws std::invalid_argument if the database holds no such study and no fit of that name, or the study has no
/// answer
///         yet
/// @throws std::runtime_error if the database or gnuplot fails
StudyReport study_report(ResultStore& store, const ReportOptions& options);

}  // namespace rollres
