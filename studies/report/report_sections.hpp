#pragma once

/// The sections of a report (report.hpp), each as HTML: report_summary.cpp, report_optimum.cpp,
/// report_tables.cpp, report_model.cpp, report_pictures.cpp, report_fit.cpp.

#include <memory>

#include "db/rows/fit_store.hpp"
#include "studies/charts/shown_study.hpp"
#include "studies/drawing/chart.hpp"
#include "studies/optimise/stored_optimum.hpp"
#include "studies/report/report.hpp"

namespace rollres {

/// What the sections are made of.
struct ReportSource {
  ResultStore& store;
  std::string definition_text;
  std::vector<Filter> filters;  ///< that the rows meet
  std::shared_ptr<const ShownStudy> shown;
  StudySummary study;
  const StudyDefinition& definition = shown->definition;
  const StudyRows& rows = shown->rows;

  /// The study with other rows: read anew where the filters are others.
  ReportSource with(const std::vector<Filter>& wanted) const;

  std::string file() const { return store.database().name(); }
  /// The axes that have more than one value among the rows.
  std::vector<const QuantityColumn*> varied() const;
};

/// A cell with its own unit.
std::string shown_cell(const StudyRows& rows, std::size_t row, const QuantityColumn& column);
/// "speed = 50 mm/s, load = 20 kN/m"
std::string place_of(const ReportSource& source, std::size_t row);

/// The finite values of an output over the converged rows, rising.
std::vector<double> sorted_values(const StudyRows& rows, const char* key);

/// HTML, and how many pictures are in it.
struct PictureSection {
  std::string html;
  std::size_t pictures = 0;
};

/// What the study is about, and three sentences: what was asked, what came out, how sure it is.
/// @param sentences  in place of those, if there are any
std::string summary_section(const ReportSource& source, const std::vector<std::string>& sentences = {});
/// Axes, inputs that all points share, and those at their defaults.
std::string scene_section(const ReportSource& source);
/// The listed moduli of the layer under the body, a picture for each master curve.
PictureSection master_curve_section(const ReportSource& source);
/// Methods, parts of the model, and warnings.
std::string model_section(const ReportSource& source);
std::string result_section(const ReportSource& source, std::size_t most_rows);
std::string failure_section(const ReportSource& source);
/// Seconds and estimated errors.
std::string accuracy_section(const ReportSource& source);
std::string provenance_section(const ReportSource& source);

/// One of the study's scenes as a sketch: the best design of an optimisation.
PictureSection sketch_section(const ReportSource& source, const std::optional<StoredOptimum>& found);

/// Charts with their meanings.
PictureSection chart_pictures(const std::vector<std::pair<std::string, ChartRequest>>& charts);

/// The best design in sentences: what it is, what holds it back, how many were looked at.
std::vector<std::string> optimum_sentences(const StoredOptimum& found);
/// Its variables, constraints and multipliers; all designs; the course of the search.
PictureSection optimum_section(const ReportSource& source, const StoredOptimum& found);

/// The charts of the study file, the shares of losses and a map where they can be drawn.
PictureSection chart_section(const ReportSource& source, const ReportOptions& options);

/// Estimated error against seconds.
PictureSection accuracy_pictures(const ReportSource& source);
/// Several studies in one chart, or why that cannot be drawn.
PictureSection together_section(ResultStore& store, const ReportOptions& options);
/// A stored fit: status, parameters, its charts, tests, correlations, residuals.
PictureSection fit_section(const FitRecord& fit);

}  // namespace rollres
