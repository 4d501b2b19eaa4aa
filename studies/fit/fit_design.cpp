#include "studies/fit/fit_design.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "db/rows/result_store.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

constexpr std::size_t most_groups = 6;
constexpr int speeds_tried = 25, loads_tried = 13;

double spaced(double from, double to, int i, int count) { return from * std::pow(to / from, i / (count - 1.0)); }

/// One scene for each combination of all inputs but the speed.
std::vector<MeasuredScene> groups_of(const FitFile& file) {
  std::map<std::string, bool> seen;
  std::vector<MeasuredScene> groups;
  for (const MeasuredScene& row : file.scenes) {
    if (is_modulus(row.output)) continue;
    MeasuredScene group = row;
    group.scene.speed = 1;
    if (seen.try_emplace(evaluation_key(group.scene) + row.set, true).second && groups.size() < most_groups)
      groups.push_back(group);
  }
  return groups;
}

Table table_of(const MeasurementPlan& design, const FitFile& file) {
  const Quantity output = real_output(file.output);
  Table table{{"speed", "load", "data", std::string(output.key), "error now", "afterwards", "ratio"}, {}};
  const auto worst = static_cast<Eigen::Index>(design.worst);
  for (std::size_t i = 0; i < std::min(best_shown, design.choices.size()); ++i) {
    const DesignChoice& choice = design.choices[i];
    const std::string_view load_unit = choice.scene.indenter == Indenter::cylinder ? "N/m" : "N";
    table.rows.push_back({readable(choice.scene.speed, "m/s"),
                          choice.scene.load ? readable(*choice.scene.load, load_unit) : std::string("-"), choice.set,
                          readable(choice.predicted, output.unit_for(choice.scene.indenter)),
                          percent(design.deviations[worst]), percent(choice.deviations[worst]),
                          short_number(design.ratio(choice), 3)});
  }
  return table;
}

}  // namespace

FitDesign design_of(const FitFile& file, const FitReport& report, const Evaluate& evaluate, int jobs) {
  const ResistanceFitOptions options{.output = file.output, .jobs = jobs, .step = file.step};
  const auto [slowest, fastest] =
      std::minmax_element(file.scenes.begin(), file.scenes.end(),
                          [](const auto& a, const auto& b) { return a.scene.speed < b.scene.speed; });
  std::vector<MeasuredScene> candidates;
  for (MeasuredScene group : groups_of(file))
    for (int i = 0; i < speeds_tried; ++i) {
      group.scene.speed = spaced(0.1 * slowest->scene.speed, 10 * fastest->scene.speed, i, speeds_tried);
      candidates.push_back(group);
    }
  if (candidates.empty()) return {};
  FitDesign answer{design(report, file.inputs, candidates, evaluate, options), {}};
  if (answer.speeds.choices.empty() || !answer.speeds.choices.front().scene.load) return answer;
  const auto [lightest, heaviest] =
      std::minmax_element(file.scenes.begin(), file.scenes.end(),
                          [](const auto& a, const auto& b) { return *a.scene.load < *b.scene.load; });
  candidates.clear();
  const DesignChoice& best = answer.speeds.choices.front();
  for (int i = 0; i < loads_tried; ++i) {
    candidates.push_back({best.scene, {}, best.set, file.output});
    candidates.back().scene.load = spaced(*lightest->scene.load / 3, 3 * *heaviest->scene.load, i, loads_tried);
  }
  answer.loads = design(report, file.inputs, candidates, evaluate, options);
  return answer;
}

std::string design_summary(const FitDesign& design, const FitFile& file, const FitReport& report) {
  std::ostringstream text;
  text << "\nnext measurement, for " << report.parameters[design.speeds.worst].parameter.name
       << " (the worst known), with the relative deviation that the data have\n";
  if (design.speeds.choices.empty()) return text.str() + "  no scene nearby has an answer\n";
  text << "speeds\n";
  write_aligned(text, table_of(design.speeds, file));
  if (!design.loads.choices.empty()) {
    text << "loads at the best speed\n";
    write_aligned(text, table_of(design.loads, file));
  }
  return text.str();
}

}  // namespace rollres
