#include <algorithm>

#include "core/material/master_curve.hpp"
#include "studies/figures/material_chart.hpp"
#include "studies/report/html.hpp"
#include "studies/report/report_sections.hpp"
#include "studies/text/similar_texts.hpp"

namespace rollres {

namespace {

using html::TableRow;

using TextCounts = std::map<std::string, std::size_t>;

void add_parts(TextCounts& parts, const std::string& text, std::string_view between) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(between, start), text.size());
    if (end > start) ++parts[text.substr(start, end - start)];
    start = end + between.size();
  }
}

/// Texts with the points that each holds for, the most frequent first; texts that differ only in their numbers are one,
/// with the ranges of these.
std::string count_table(const std::string& what, const TextCounts& counts) {
  constexpr std::size_t most = 20;
  std::vector<std::string> texts;
  for (const auto& [text, count] : counts) texts.push_back(text);
  const std::vector<std::string> words = with_ranges(texts);
  TextCounts kinds;
  std::size_t place = 0;
  for (const auto& [text, count] : counts) kinds[words[place++]] += count;
  std::vector<std::pair<std::string, std::size_t>> list(kinds.begin(), kinds.end());
  stable_sort(list, [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<TableRow> rows;
  for (const auto& [text, count] : list)
    if (rows.size() < most) rows.push_back({{text.empty() ? "-" : text, std::to_string(count)}});
  return html::table({{what}, {"points", true}}, rows) +
         (list.size() > most ? html::paragraph(std::to_string(list.size() - most) + " further ones are not listed.")
                             : "");
}

/// The scenes of some points, evenly from all, that have a master curve; one for each curve.
std::vector<RollingScene> scenes_of_curves(const ReportSource& source) {
  constexpr std::size_t most_points = 64, most_curves_shown = 4;
  std::vector<RollingScene> found;
  const std::vector<std::string> keys = source.store.points(source.study.name);
  for (std::size_t i = 0; i < keys.size() && found.size() < most_curves_shown; i += 1 + keys.size() / most_points) {
    const auto answer = source.store.find(keys[i]);
    if (!answer || !is_measured_curve(answer->scene.material)) continue;
    const RollingScene& scene = answer->scene;
    if (none_of(found, [&](const RollingScene& other) { return measured_curve(other) == measured_curve(scene); }))
      found.push_back(scene);
  }
  return found;
}

}  // namespace

PictureSection master_curve_section(const ReportSource& source) {
  std::vector<std::pair<std::string, ChartRequest>> charts;
  for (MaterialInputs layer : scenes_of_curves(source)) {
    layer.temperature.reset();  // a study may vary it
    const std::string words =
        "The master curve of the layer, " + std::to_string(measured_curve(layer).frequencies.size()) + " values";
    charts.emplace_back(words, moduli_chart(layer, title_of_study(source.definition, source.study.name)));
    charts.back().second.subtitle += ", at the reference temperature";
  }
  return chart_pictures(charts);
}

std::string model_section(const ReportSource& source) {
  TextCounts methods, models, assumptions, warnings;
  for (std::size_t row = 0; row < source.rows.size(); ++row) {
    ++methods[source.rows.text(row, "method")];
    add_parts(models, source.rows.text(row, "model"), "; ");
    add_parts(assumptions, source.rows.text(row, "assumptions"), "\n");
    add_parts(warnings, source.rows.text(row, "warnings"), "\n");
  }
  return html::heading("Model") + count_table("method", methods) +
         count_table("what the model keeps and leaves out, and why", models) +
         (assumptions.empty() ? std::string()
                              : count_table("what the model assumes, and what each costs", assumptions)) +
         (warnings.empty() ? html::paragraph("No warnings.") : count_table("warning", warnings));
}

}  // namespace rollres
