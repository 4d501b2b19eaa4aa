#include "studies/sensitivity/sensitivity.hpp"

#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "core/model/scene_rules.hpp"
#include "core/scene/scene_input.hpp"
#include "studies/optimise/design_file.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/scene_overrides.hpp"
#include "studies/study/study_axes.hpp"

namespace rollres {

namespace {

constexpr std::string_view numerical_inputs[] = {"spacing", "tolerance", "slip_threshold", "time_limit",
                                                 "memory_limit"};

/// An input with both ends as they were given.
struct GivenRange {
  SceneEntry from, to;
  bool logarithmic = false;
};

GivenRange range_of_word(const std::string& word) {
  const std::string rule = "--range: " + word + ": must be KEY=FROM:TO or KEY=FROM:TO:logarithmic";
  const auto equals = word.find('=');
  const auto colon = word.find(':', equals == std::string::npos ? 0 : equals);
  if (equals == std::string::npos || colon == std::string::npos) throw std::invalid_argument(rule);
  const std::string key = word.substr(0, equals);
  std::string to = word.substr(colon + 1);
  GivenRange range;
  if (const auto scale = to.find(':'); scale != std::string::npos) {
    const std::string name = to.substr(scale + 1);
    if (name != "logarithmic" && name != "linear") throw std::invalid_argument(rule);
    range.logarithmic = name == "logarithmic";
    to.resize(scale);
  }
  range.from = override_entries({key + "=" + word.substr(equals + 1, colon - equals - 1)}, "--range").front();
  range.to = override_entries({key + "=" + to}, "--range").front();
  return range;
}

/// The scene at the middle of the ranges, and its variables.
DesignProblem problem_of(RollingScene scene, const std::vector<GivenRange>& ranges, const Formula& output) {
  DesignProblem problem{.name = {}, .scenes = {}, .variables = {}, .start = {}, .goal = {output}};
  std::vector<InputChoice> choices;
  for (const auto& [from_entry, to_entry, logarithmic] : ranges) {
    const InputValue from = input_value(from_entry, body_of(scene)), to = input_value(to_entry, body_of(scene));
    const auto* const lowest = std::get_if<double>(&from);
    const auto* const highest = std::get_if<double>(&to);
    if (!lowest || !highest) refuse(from_entry.place, from_entry.key, from_entry.value, "must be a real number");
    if (!std::isfinite(*highest) || !(*lowest < *highest))
      refuse(to_entry.place, to_entry.key, to_entry.value, "must be finite, and larger than the first end");
    if (logarithmic && *lowest <= 0)
      refuse(from_entry.place, from_entry.key, from_entry.value, "logarithmic: both ends must be > 0");
    choices.push_back({from_entry.key, *lowest, *highest, logarithmic});
    set_input(scene, from_entry.key, logarithmic ? std::sqrt(*lowest * *highest) : 0.5 * (*lowest + *highest));
  }
  if (const auto broken = check(scene); !broken.empty())
    throw std::invalid_argument("in the middle of the ranges: " + broken.front());
  problem.scenes = {{scene, 1}};
  problem.variables = variables_of(scene, choices);
  problem.start = base_point({scene, problem.variables, {}, {}});
  return problem;
}

/// The axes of a study that have two ends.
std::vector<GivenRange> ranges_of_study(const Json& file, const std::string& place) {
  std::vector<GivenRange> ranges;
  for (const GivenAxis& axis : given_axes(file, place))
    if (!axis.positions.empty()) ranges.push_back({axis.values.front(), axis.values.back(), axis.logarithmic});
  if (ranges.empty())
    throw std::invalid_argument(place + ": axes: must have an input with from and to, or there must be a sample");
  return ranges;
}

}  // namespace

std::vector<InputChoice> inputs_with_elasticity(const RollingScene& scene) {
  std::vector<InputChoice> choices;
  MaterialModel material = scene.material;  // of the layer whose inputs are walked
  bool kraus = false;                       // whether that layer softens by Kraus's model
  visit_all_inputs(scene, [&](const Quantity& quantity, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, MaterialModel>) material = value;
    if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>) {
      const std::optional<double> number(value);
      const std::string_view own = own_key(quantity.key);
      if (own == "payne_strain") kraus = number.has_value();
      if (own.starts_with("payne_") && own != "payne_drop" && !kraus) return;
      if (!number || *number == 0 || !std::isfinite(*number)) return;
      const InputKind& kind = *find_input(quantity.key);
      const bool of_a_material = !kind.needed_by_all() && !kind.needed_by().empty();
      if (of_a_material && !kind.needed_by(material)) return;  // of another one
      if (quantity.range.lowest == quantity.range.highest || find_name(numerical_inputs, quantity.key) >= 0) return;
      choices.push_back({std::string(quantity.key)});
    }
  });
  return choices;
}

DesignProblem read_ranges(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                          const std::vector<std::string>& ranges, const std::string& output) {
  const std::string place = file.string();
  const Formula formula(output.empty() ? "rolling_resistance" : output, FormulaNames::inputs_and_outputs);
  const Json object = read_object(place);
  const bool study = object.contains("study");
  if (study && (!ranges.empty() || !overrides.empty()))
    throw std::invalid_argument(place + ": a study has ranges of its own; --range and --set are for a scene");
  if (study && object.contains("variables")) {
    DesignProblem problem = read_design_problem(file);
    if (!output.empty()) problem.goal = {formula};
    problem.constraints.clear();
    problem.pareto.reset();
    return problem;
  }
  if (study) {
    const Study read = read_study(file);
    if (!read.variants.empty())
      throw std::invalid_argument(place +
                                  ": axes: variant: a name has no range; give the inputs of one variant in set");
    StudyPlan{read};  // refuses a point that breaks a rule
    refusing_at("--output", [&] { refuse_never_computed(formula, read); });
    DesignProblem problem = problem_of(read.base, ranges_of_study(object, place), formula);
    problem.name = read.name;
    return problem;
  }
  if (ranges.empty()) throw std::invalid_argument("--range: there must be at least one KEY=FROM:TO for a scene");
  std::vector<GivenRange> given;
  for (const std::string& word : ranges) given.push_back(range_of_word(word));
  const RollingScene scene = read_scene(file, overrides);
  refusing_at("--output", [&] { refuse_absent(formula, scene); });
  DesignProblem problem = problem_of(scene, given, formula);
  problem.name = file.stem().string();
  return problem;
}

}  // namespace rollres
