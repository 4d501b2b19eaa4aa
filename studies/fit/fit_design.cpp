#include "studies/fit/fit_design.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "core/scene/scene_input.hpp"
#include "db/rows/result_store.hpp"
#include "studies/fit/design_space.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

constexpr std::size_t most_groups = 6;
constexpr int speeds_tried = 25, loads_tried = 13;

/// One scene for each combination of all inputs but the speed.
std::vector<MeasuredScene> without_speed(const FitFile& file) {
  const auto at_one = [](MeasuredScene row) {
    row.scene.speed = 1;
    return row;
  };
  std::vector<MeasuredScene> groups =
      examples_of(file, [&](const MeasuredScene& row) { return evaluation_key(at_one(row).scene) + row.set; });
  if (groups.size() > most_groups) groups.resize(most_groups);
  return groups;
}

/// Joins choices to those that are known, and tells what each is worth: the logarithm of the worst aim's deviation.
class Rating {
 public:
  Rating(MeasurementPlan& plan, const FitFile& file, const FitReport& report, const Evaluate& evaluate,
         const ResistanceFitOptions& options)
      : plan_(plan), file_(file), report_(report), evaluate_(evaluate), options_(options) {}

  /// @param others  places in plan.choices that are measured, too; empty: the worst aim of now counts alone
  std::vector<double> operator()(const std::vector<MeasuredScene>& scenes,
                                 const std::vector<std::size_t>& others = {}) const {
    std::vector<double> values;
    for (DesignChoice& choice : rated(plan_, report_, file_.inputs, scenes, evaluate_, options_)) {
      if (!std::isfinite(choice.predicted) || choice.slope.squaredNorm() == 0) {
        values.push_back(std::numeric_limits<double>::infinity());
        continue;
      }
      double left = choice.deviations[static_cast<Eigen::Index>(plan_.worst)];
      plan_.choices.push_back(std::move(choice));
      if (!others.empty()) {
        std::vector<std::size_t> all = others;
        all.push_back(plan_.choices.size() - 1);
        left = plan_.deviations_with(covariance_with(plan_, all)).maxCoeff();
      }
      values.push_back(std::log(left));
    }
    return values;
  }

 private:
  MeasurementPlan& plan_;
  const FitFile& file_;
  const FitReport& report_;
  const Evaluate& evaluate_;
  const ResistanceFitOptions& options_;
};

/// Choices at the ends of the ranges may come several times.
void drop_repeated(MeasurementPlan& plan, const DesignSpace& space) {
  const auto same = [&](const DesignChoice& a, const DesignChoice& b) {
    return a.set == b.set && all_of(space.ranges, [&](const DesignRange& range) {
             return real_input(a.scene, range.key) == real_input(b.scene, range.key);
           });
  };
  plan.sort();
  plan.choices.erase(std::unique(plan.choices.begin(), plan.choices.end(), same), plan.choices.end());
}

/// Places of the best choices that lie apart: one of each neighbourhood.
std::vector<std::size_t> best_apart(const MeasurementPlan& plan, const DesignSpace& space) {
  constexpr double apart = 0.1;  // of the ranges
  std::vector<std::size_t> best;
  for (std::size_t i = 0; i < plan.choices.size() && best.size() < best_shown; ++i) {
    const Eigen::VectorXd here = place_of(space, plan.choices[i].scene);
    if (none_of(best, [&](std::size_t other) {
          return plan.choices[other].set == plan.choices[i].set &&
                 (place_of(space, plan.choices[other].scene) - here).norm() < apart;
        }))
      best.push_back(i);
  }
  return best;
}

/// The best measurements over all inputs at once, and several together: of those that were looked at, then each moved
/// with the others where they are.
void look_anywhere(FitDesign& answer, const DesignSpace& space, const FitFile& file, const FitReport& report,
                   const Evaluate& evaluate, const ResistanceFitOptions& options) {
  if (space.empty()) return;
  for (const DesignRange& range : space.ranges) answer.inputs.push_back(range.key);
  MeasurementPlan& plan = answer.anywhere = plan_for(report, answer.speeds.aims);
  const Rating rating(plan, file, report, evaluate, options);
  search_space(space, [&](const auto& scenes) { return rating(scenes); });
  drop_repeated(plan, space);
  if (plan.choices.empty()) return;
  for (int count = 1; count <= file.design.points; ++count) {
    const auto size = static_cast<std::size_t>(count);
    const std::vector<std::size_t> rough = best_together(plan, size).choices;
    for (std::size_t moved = 0; size > 1 && moved < size; ++moved) {
      std::vector<std::size_t> others = rough;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(moved));
      const DesignChoice& start = plan.choices[rough[moved]];
      const auto set = static_cast<std::size_t>(
          find_if(space.sets, [&](const MeasuredScene& one) { return one.set == start.set; }) - space.sets.begin());
      search_from(space, set, place_of(space, start.scene), [&](const auto& scenes) { return rating(scenes, others); });
    }
    drop_repeated(plan, space);
  }
  answer.best = best_apart(plan, space);
  for (int count = 1; count <= file.design.points; ++count)  // once all choices have their places
    answer.together.push_back(best_together(plan, static_cast<std::size_t>(count)));
}

std::vector<Cell> inputs_of(const DesignChoice& choice, const FitDesign& design) {
  std::vector<Cell> cells;
  for (const std::string& key : design.inputs)
    cells.emplace_back(
        readable(real_input(choice.scene, key), find_input(key)->quantity.unit_for(body_of(choice.scene))));
  return cells;
}

Table table_of_anywhere(const FitDesign& design) {
  Table table{design.inputs, {}};
  table.columns.insert(table.columns.end(), {"data", "error now", "afterwards", "ratio"});
  const MeasurementPlan& plan = design.anywhere;
  const auto worst = static_cast<Eigen::Index>(plan.worst);
  for (const std::size_t place : design.best) {
    const DesignChoice& choice = plan.choices[place];
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
    const std::string_view load_unit = find_input("load")->quantity.unit_for(body_of(choice.scene));
    table.rows.push_back({readable(choice.scene.speed, "m/s"),
                          choice.scene.load ? readable(*choice.scene.load, load_unit) : std::string("-"), choice.set,
                          readable(choice.predicted, output.unit_for(body_of(choice.scene))),
                          percent(design.deviations[worst]), percent(choice.deviations[worst]),
                          short_number(design.ratio(choice), 3)});
  }
  return table;
}

Json after_json(const MeasurementPlan& plan, const Eigen::VectorXd& deviations) {
  Json after = Json::object();
  for (std::size_t k = 0; k < plan.aims.size(); ++k)
    after[plan.aims[k].name] = deviations[static_cast<Eigen::Index>(k)];
  return after;
}

std::vector<std::size_t> places_of_best(const MeasurementPlan& plan) {
  std::vector<std::size_t> places(std::min(best_shown, plan.choices.size()));
  std::iota(places.begin(), places.end(), 0);
  return places;
}

/// @param inputs  that are told beside speed and load
Json choices_json(const MeasurementPlan& design, const std::vector<std::size_t>& places,
                  const std::vector<std::string>& inputs = {}) {
  Json choices = Json::array();
  for (const std::size_t place : places) {
    const DesignChoice& choice = design.choices[place];
    choices.push_back(json_object("speed", choice.scene.speed, "load", choice.scene.load, "data", choice.set,
                                  "predicted", choice.predicted, "deviation", choice.deviation, "relative_errors",
                                  after_json(design, choice.deviations), "ratio", design.ratio(choice)));
    for (const std::string& key : inputs) choices.back()[key] = real_input(choice.scene, key);
  }
  return choices;
}

Json together_json(const FitDesign& design, const JointChoice& joint) {
  Json measured = Json::array();
  for (const std::size_t place : joint.choices) {
    const DesignChoice& choice = design.anywhere.choices[place];
    Json& one = measured.emplace_back(Json{{"data", choice.set}});
    for (const std::string& key : design.inputs) one[key] = real_input(choice.scene, key);
  }
  return {{"measurements", measured}, {"relative_errors", after_json(design.anywhere, joint.deviations)}};
}

}  // namespace

FitDesign design_of(const FitFile& file, const FitReport& report, const Evaluate& evaluate, int jobs) {
  const ResistanceFitOptions options{.output = file.output, .jobs = jobs, .step = file.step};
  const std::vector<DesignAim> aims =
      file.design.targets.empty() ? parameter_aims(report) : refusing_at(file.source + ": design: targets", [&] {
        return prediction_aims(report, file.inputs, file.design.targets, evaluate, options);
      });
  const DesignSpace space = design_space(file);
  std::vector<MeasuredScene> candidates;
  if (const DesignRange* const speeds = space.range_of("speed"))
    for (const MeasuredScene& group : without_speed(file))
      for (int i = 0; i < speeds_tried; ++i) {
        candidates.push_back(group);
        candidates.back().scene.speed = speeds->at(i / (speeds_tried - 1.0));
      }
  if (candidates.empty()) return {};
  FitDesign answer{design(report, file.inputs, candidates, evaluate, options, aims), {}, {}};
  look_anywhere(answer, space, file, report, evaluate, options);
  const DesignRange* const loads = space.range_of("load");
  if (answer.speeds.choices.empty() || !answer.speeds.choices.front().scene.load || !loads) return answer;
  candidates.clear();
  const DesignChoice& best = answer.speeds.choices.front();
  for (int i = 0; i < loads_tried; ++i) {
    candidates.push_back({best.scene, {}, best.set, file.output});
    candidates.back().scene.load = loads->at(i / (loads_tried - 1.0));
  }
  answer.loads = design(report, file.inputs, candidates, evaluate, options, aims);
  return answer;
}

std::string design_summary(const FitDesign& design, const FitFile& file) {
  std::ostringstream text;
  text << "\nnext measurement, for " << design.speeds.aims[design.speeds.worst].name
       << " (the least certain), measured with the relative deviation of the data\n";
  if (design.speeds.choices.empty() && design.anywhere.choices.empty())
    return text.str() + "  no scene in the ranges has an answer\n";
  text << "speeds\n";
  write_aligned(text, table_of(design.speeds, file));
  if (!design.loads.choices.empty()) {
    text << "loads at the best speed\n";
    write_aligned(text, table_of(design.loads, file));
  }
  text << "all inputs at once\n";
  if (design.anywhere.choices.empty()) return text.str() + "  no scene in the ranges has an answer\n";
  write_aligned(text, table_of_anywhere(design));
  for (const JointChoice& joint : design.together) {
    text << joint.choices.size() << (joint.choices.size() == 1 ? " measurement\n" : " measurements together\n");
    Table table{design.inputs, {}};
    table.columns.emplace_back("data");
    for (const std::size_t place : joint.choices) {
      table.rows.push_back(inputs_of(design.anywhere.choices[place], design));
      table.rows.back().emplace_back(design.anywhere.choices[place].set);
    }
    write_aligned(text, table);
    text << "then the errors are";
    for (std::size_t k = 0; k < design.anywhere.aims.size(); ++k)
      text << (k == 0 ? " " : ", ") << percent(joint.deviations[static_cast<Eigen::Index>(k)]) << " of "
           << design.anywhere.aims[k].name;
    text << '\n';
  }
  return text.str();
}

Json json_of(const FitDesign& design) {
  Json sequence = Json::array();
  for (const JointChoice& joint : design.together) sequence.push_back(together_json(design, joint));
  const MeasurementPlan& plan = design.speeds;
  return json_object("worst", plan.aims[plan.worst].name, "relative_error",
                     plan.deviations[static_cast<Eigen::Index>(plan.worst)], "relative_errors",
                     after_json(plan, plan.deviations), "speeds",
                     choices_json(design.speeds, places_of_best(design.speeds)), "loads",
                     choices_json(design.loads, places_of_best(design.loads)), "anywhere",
                     choices_json(design.anywhere, design.best, design.inputs), "sequence", sequence, "together",
                     sequence.empty() ? Json(nullptr) : sequence.back());
}

}  // namespace rollres
