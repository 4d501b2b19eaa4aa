#include "studies/fit/fit_design.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "core/scene/scene_input.hpp"
#include "db/rows/result_store.hpp"
#include "fitting/descent/latin_hypercube.hpp"
#include "studies/scene_io/scene_inputs.hpp"
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

/// An input between two ends, in equal factors where both are positive.
struct Span {
  std::string key;
  double lowest, highest;

  bool logarithmic() const { return lowest > 0; }
  double at(double part) const {
    part = std::clamp(part, 0.0, 1.0);
    return logarithmic() ? lowest * std::pow(highest / lowest, part) : lowest + part * (highest - lowest);
  }
  /// The part that a value lies at.
  double part_of(double value) const {
    return logarithmic() ? std::log(value / lowest) / std::log(highest / lowest)
                         : (value - lowest) / (highest - lowest);
  }
};

/// The inputs that vary, and the speed and the load, each over a range about that of the data.
std::vector<Span> spans_of(const FitFile& file) {
  std::vector<std::string> keys{"speed"};
  if (file.scenes.front().scene.load) keys.emplace_back("load");
  for (const std::string& key : file.varying)
    if (find_input(key)->real() && std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  std::vector<Span> spans;
  for (const std::string& key : keys) {
    Span span{key, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const MeasuredScene& row : file.scenes) {
      if (is_modulus(row.output)) continue;
      const double value = real_input(row.scene, key);
      if (!std::isfinite(value)) continue;
      span.lowest = std::min(span.lowest, value);
      span.highest = std::max(span.highest, value);
    }
    const double beyond = key == "speed" ? 10 : key == "load" ? 3 : 1;
    if (span.lowest > 0) span.lowest /= beyond, span.highest *= beyond;
    if (span.highest > span.lowest) spans.push_back(span);
  }
  return spans;
}

/// Scenes over a part of all spans: of half-width `reach` around a place in the unit cube.
std::vector<MeasuredScene> scenes_around(const std::vector<MeasuredScene>& groups, const std::vector<Span>& spans,
                                         const Eigen::VectorXd& centre, double reach, int count, std::uint64_t seed,
                                         std::vector<Eigen::VectorXd>& places) {
  const Eigen::MatrixXd sample = latin_hypercube(count, std::ssize(spans), seed);
  std::vector<MeasuredScene> scenes;
  for (int i = 0; i < count; ++i) {
    MeasuredScene one = groups[static_cast<std::size_t>(i) % groups.size()];
    Eigen::VectorXd place = centre + reach * (2 * sample.row(i).transpose().array() - 1).matrix();
    place = place.cwiseMax(0).cwiseMin(1);
    for (std::size_t k = 0; k < spans.size(); ++k)
      set_input(one.scene, spans[k].key, spans[k].at(place[static_cast<Eigen::Index>(k)]));
    scenes.push_back(std::move(one));
    places.push_back(std::move(place));
  }
  return scenes;
}

/// The best measurements over all inputs at once.
void look_anywhere(FitDesign& answer, const FitFile& file, const FitReport& report, const Evaluate& evaluate,
                   const ResistanceFitOptions& options) {
  const std::vector<Span> spans = spans_of(file);
  std::vector<MeasuredScene> groups;
  for (const MeasuredScene& row : file.scenes)
    if (!is_modulus(row.output) &&
        std::none_of(groups.begin(), groups.end(), [&](const MeasuredScene& other) { return other.set == row.set; }))
      groups.push_back(row);
  if (spans.empty() || groups.empty()) return;
  for (const Span& span : spans) answer.inputs.push_back(span.key);
  Eigen::VectorXd centre = Eigen::VectorXd::Constant(std::ssize(spans), 0.5);
  const int first = 30 + 10 * static_cast<int>(spans.size());
  double reach = 0.5;
  for (int round = 0; round < 4; ++round, reach /= 3) {
    std::vector<Eigen::VectorXd> places;
    const std::vector<MeasuredScene> scenes = scenes_around(groups, spans, centre, reach, round == 0 ? first : 12,
                                                            static_cast<std::uint64_t>(round) + 1, places);
    const MeasurementPlan plan = design(report, file.inputs, scenes, evaluate, options);
    if (round == 0)
      answer.anywhere = plan;
    else
      answer.anywhere.choices.insert(answer.anywhere.choices.end(), plan.choices.begin(), plan.choices.end());
    auto& choices = answer.anywhere.choices;
    if (choices.empty()) return;
    const auto worst = static_cast<Eigen::Index>(answer.anywhere.worst);
    std::stable_sort(choices.begin(), choices.end(), [&](const DesignChoice& a, const DesignChoice& b) {
      return a.deviations[worst] < b.deviations[worst];
    });
    const auto same = [&](const DesignChoice& a, const DesignChoice& b) {  // at the ends of the spans
      return a.set == b.set && std::all_of(spans.begin(), spans.end(), [&](const Span& span) {
               return real_input(a.scene, span.key) == real_input(b.scene, span.key);
             });
    };
    choices.erase(std::unique(choices.begin(), choices.end(), same), choices.end());
    for (std::size_t k = 0; k < spans.size(); ++k)
      centre[static_cast<Eigen::Index>(k)] = spans[k].part_of(real_input(choices.front().scene, spans[k].key));
  }
  answer.together = best_together(answer.anywhere, named_together);
}

std::vector<Cell> inputs_of(const DesignChoice& choice, const FitDesign& design) {
  std::vector<Cell> cells;
  for (const std::string& key : design.inputs)
    cells.emplace_back(
        readable(real_input(choice.scene, key), find_input(key)->quantity.unit_for(choice.scene.indenter)));
  return cells;
}

Table table_of_anywhere(const FitDesign& design) {
  Table table{design.inputs, {}};
  table.columns.insert(table.columns.end(), {"data", "error now", "afterwards", "ratio"});
  const MeasurementPlan& plan = design.anywhere;
  const auto worst = static_cast<Eigen::Index>(plan.worst);
  for (std::size_t i = 0; i < std::min(best_shown, plan.choices.size()); ++i) {
    const DesignChoice& choice = plan.choices[i];
    std::vector<Cell> row = inputs_of(choice, design);
    row.insert(row.end(), {choice.set, percent(plan.deviations[worst]), percent(choice.deviations[worst]),
                           short_number(plan.ratio(choice), 3)});
    table.rows.push_back(std::move(row));
  }
  return table;
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
  FitDesign answer{design(report, file.inputs, candidates, evaluate, options), {}, {}};
  look_anywhere(answer, file, report, evaluate, options);
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
  if (design.anywhere.choices.empty()) return text.str();
  text << "all inputs at once\n";
  write_aligned(text, table_of_anywhere(design));
  text << named_together << " measurements together\n";
  Table table{design.inputs, {}};
  for (const std::size_t place : design.together.choices)
    table.rows.push_back(inputs_of(design.anywhere.choices[place], design));
  write_aligned(text, table);
  text << "then the errors are";
  for (std::size_t j = 0; j < report.parameters.size(); ++j)
    text << (j == 0 ? " " : ", ") << percent(design.together.deviations[static_cast<Eigen::Index>(j)]) << " of "
         << report.parameters[j].parameter.name;
  text << '\n';
  return text.str();
}

}  // namespace rollres
