#include <algorithm>

#include "studies/report/html.hpp"
#include "studies/report/report_sections.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/similar_texts.hpp"

namespace rollres {

namespace {

using html::TableRow;

/// Texts with how often they come, the most frequent first.
std::vector<std::pair<std::string, std::size_t>> counted(const std::vector<std::string>& texts) {
  std::map<std::string, std::size_t> counts;
  for (const std::string& text : texts) ++counts[text];
  std::vector<std::pair<std::string, std::size_t>> list(counts.begin(), counts.end());
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return list;
}

void add_parts(std::vector<std::string>& parts, const std::string& text, std::string_view between) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(between, start), text.size());
    if (end > start) parts.push_back(text.substr(start, end - start));
    start = end + between.size();
  }
}

/// The scenes of some points, evenly from all, that have a master curve; one for each curve.
std::vector<RollingScene> scenes_of_curves(const ReportSource& source) {
  constexpr std::size_t most_points = 64, most_curves_shown = 4;
  std::vector<RollingScene> found;
  const std::vector<std::string> keys = source.store.points(source.study.name);
  for (std::size_t i = 0; i < keys.size() && found.size() < most_curves_shown; i += 1 + keys.size() / most_points) {
    const auto answer = source.store.find(keys[i]);
    if (!answer || answer->scene.frequencies.empty()) continue;
    const RollingScene& scene = answer->scene;
    if (std::none_of(found.begin(), found.end(), [&](const RollingScene& other) {
          return other.frequencies == scene.frequencies && other.storage_moduli == scene.storage_moduli &&
                 other.loss_moduli == scene.loss_moduli;
        }))
      found.push_back(scene);
  }
  return found;
}

ChartRequest master_curve_chart(const ReportSource& source, const RollingScene& scene) {
  const auto [least, largest] = std::minmax_element(scene.storage_moduli.begin(), scene.storage_moduli.end());
  const ScaledUnit unit = scaled_unit_logarithmic("Pa", *least, *largest);
  ChartRequest request{.title = title_of_study(source.definition, source.study.name),
                       .subtitle = "moduli as listed, at the reference temperature",
                       .x = {.name = "frequency", .unit = "Hz", .logarithmic = true},
                       .y = {.name = "modulus", .unit = typeset_unit(unit.name), .logarithmic = true},
                       .curves = {{"storage modulus", {}}, {"loss modulus", {}}},
                       .mark_peaks = false};
  for (std::size_t i = 0; i < scene.frequencies.size(); ++i)
    for (const auto& [curve, moduli] : {std::pair(0, &scene.storage_moduli), std::pair(1, &scene.loss_moduli)})
      if ((*moduli)[i] > 0)
        request.curves[static_cast<std::size_t>(curve)].points.push_back(
            {scene.frequencies[i], (*moduli)[i] / unit.factor});
  std::erase_if(request.curves, [](const ChartCurve& curve) { return curve.points.empty(); });
  return request;
}

}  // namespace

PictureSection master_curve_section(const ReportSource& source) {
  std::vector<std::pair<std::string, ChartRequest>> charts;
  for (const RollingScene& scene : scenes_of_curves(source))
    charts.emplace_back("The master curve of the layer, " + std::to_string(scene.frequencies.size()) + " values",
                        master_curve_chart(source, scene));
  return chart_pictures(charts);
}

std::string count_table(const std::string& what, const std::vector<std::string>& texts) {
  constexpr std::size_t most = 20;
  std::vector<TableRow> rows;
  const auto kinds = counted(with_ranges(texts));
  for (const auto& [text, count] : kinds)
    if (rows.size() < most) rows.push_back({{text.empty() ? "-" : text, std::to_string(count)}});
  return html::table({{what}, {"points", true}}, rows) +
         (kinds.size() > most ? html::paragraph(std::to_string(kinds.size() - most) + " further ones are not listed.")
                              : "");
}

std::string model_section(const ReportSource& source) {
  std::vector<std::string> methods, models, assumptions, warnings;
  for (std::size_t row = 0; row < source.rows.size(); ++row) {
    methods.push_back(source.rows.text(row, "method"));
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
