#include "studies/report/report.hpp"

#include <stdexcept>

#include "studies/report/html.hpp"
#include "studies/report/report_sections.hpp"
#include "studies/stored/accepted_study.hpp"
#include "studies/stored_fits/stored_fit.hpp"

namespace rollres {

namespace {

/// What stands at the end: the file from which all of it can be computed again.
std::string file_section(const std::string& heading, const std::string& text) {
  return text.empty() ? "" : html::folded(heading, html::listing(text));
}

StudyReport fit_report(const FitRecord& fit, const std::string& file) {
  const PictureSection section = fit_section(fit);
  return {fit.name,
          "<h1>" + html::text(fit.name) + "</h1>\n" + section.html + html::heading("Provenance") +
              html::paragraph("Stored in " + file + ".") + file_section("Fit file", fit.definition),
          section.pictures, fit.name};
}

/// A report without the frame of a page.
StudyReport report_of(ResultStore& store, const ReportOptions& options) {
  const std::string& file = store.database().name();
  if (const auto fit = meant_fit(store, options.study, FitParts::with_data)) return fit_report(*fit, file);

  const auto shown = std::make_shared<const ShownStudy>(store, StudyChartOptions{.study = options.study});
  const StudySummary study = stored_study(store, shown->study.name);
  const std::string text = accepted_study(store.definition(study.name).value_or(""));
  const ReportSource source{store, text, {}, shown, study};
  const PictureSection charts = chart_section(source, options), errors = accuracy_pictures(source);
  const std::string title = title_of_study(source.definition, study.name);
  StudyReport report{study.name, "<h1>" + html::text(title) + "</h1>\n", charts.pictures + errors.pictures};
  const std::optional<StoredOptimum> found = stored_optimum(store, study.name);
  const PictureSection sketch = sketch_section(source, found);
  const PictureSection moduli = master_curve_section(source);
  report.pictures += sketch.pictures + moduli.pictures;
  if (found) {
    const PictureSection optimum = optimum_section(source, *found);
    report.html += summary_section(source, optimum_sentences(*found)) + optimum.html;
    report.pictures += optimum.pictures;
  } else {
    report.html += summary_section(source);
  }
  report.html += charts.html + html::heading("Scene") + sketch.html + moduli.html + scene_section(source) +
                 failure_section(source) + model_section(source) + result_section(source, options.most_rows);
  std::string fit_file;
  if (const auto fit = find_fit(store.database(), study.name, FitParts::with_data)) {
    const PictureSection section = fit_section(*fit);
    report.html += section.html;
    report.pictures += section.pictures;
    fit_file = fit->definition;
  }
  report.html += accuracy_section(source) + errors.html + provenance_section(source) +
                 file_section("Study file", text) + file_section("Fit file", fit_file);
  report.title = title;
  return report;
}

}  // namespace

ReportSource ReportSource::with(const std::vector<Filter>& wanted) const {
  return {store, definition_text, wanted,
          wanted == filters ? shown : std::make_shared<const ShownStudy>(*shown, store, wanted), study};
}

StudyReport study_report(ResultStore& store, const ReportOptions& options) {
  StudyReport report = report_of(store, options);
  if (!options.more_studies.empty()) {
    const PictureSection together = together_section(store, options);
    report.html = together.html + report.html;
    report.pictures += together.pictures;
  }
  for (const std::string& name : options.more_studies) {
    ReportOptions alone = options;
    alone.study = name;
    alone.optimum.clear();
    const StudyReport one = report_of(store, alone);
    report.study += ", " + one.study;
    report.html += one.html;
    report.pictures += one.pictures;
  }
  report.html = html::page(options.more_studies.empty() ? report.title : report.study, report.html);
  return report;
}

}  // namespace rollres
