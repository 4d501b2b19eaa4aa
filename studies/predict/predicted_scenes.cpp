#include "studies/predict/predicted_scenes.hpp"

#include <stdexcept>

#include "core/model/scene_rules.hpp"
#include "core/scene/scene_input.hpp"
#include "studies/fit/fit_data.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/scene_overrides.hpp"
#include "studies/scene_io/usual_names.hpp"
#include "studies/study/study.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// What the fit's file says, as far as predictions need it.
struct FitOfScenes {
  const FitRecord& record;
  std::string output;
  std::vector<GivenSet> sets;

  explicit FitOfScenes(const FitRecord& fit) : record(fit) {
    if (fit.kind != "resistance" || fit.scene.empty())
      throw std::invalid_argument(fit.name + ": predictions need a fit of scenes that is stored with its scene");
    const Json definition = parse_object(fit.definition, fit.name);
    output = definition.value("output", "rolling_resistance");
    sets = given_sets(definition, {}, fit.name);
  }

  bool measures_output(const GivenSet& set) const { return set.output.empty() || set.output == output; }

  /// @throws std::invalid_argument if the fit has no such data set
  const GivenSet& set(const std::string& name, const std::string& place) const {
    std::vector<std::string_view> names;
    for (const GivenSet& one : sets) {
      if (measures_output(one) && (name.empty() || one.name == name)) return one;
      names.push_back(one.name);
    }
    throw std::invalid_argument(
        place + ": data = " + unknown(name + ": no data set of the fit that measures " + output, names, name));
  }

  bool is_fitted(const std::string& key) const {
    return any_of(record.parameters,
                  [&](const FitParameterRecord& one) { return !one.fixed && parameter_name(one.name).key == key; });
  }
};

/// Entries of the fitted values that a scene needs before it is one.
std::vector<SceneEntry> fitted_entries(const FitRecord& fit, const std::string& set) {
  std::vector<SceneEntry> entries;
  for (const FitParameterRecord& one : parameters_of(fit, set)) {
    const std::string key = parameter_name(one.name).key;
    const InputKind* const kind = find_input(key);
    if (kind && kind->real() && key.find('[') == std::string::npos)
      entries.push_back({key, written_input(kind->quantity, one.value), fit.name});
  }
  return entries;
}

/// As fits do, without a spacing that only makes answers jump.
AskedScene asked(RollingScene scene, const GivenSet& set, std::string place) {
  if (smooth_without_spacing(scene)) scene.spacing.reset();
  AskedScene one{.scene = {.scene = std::move(scene), .measured = {}, .set = set.name}};
  one.scene.measured.place = std::move(place);
  return one;
}

PredictedScenes of_study(const FitOfScenes& fit, const std::string& file, const GivenSet& set) {
  const Study study = read_study(file);
  PredictedScenes answer{fit.output, {}, {}};
  for (const Axis& axis : study.axes) {
    if (fit.is_fitted(axis.key))
      throw std::invalid_argument(file + ": " + axis.key + ": is fitted: it is no axis here");
    if (const InputKind* const kind = find_input(axis.key); kind && kind->real()) answer.inputs.push_back(axis.key);
  }
  StudyPlan(study).for_each([&](std::size_t point, const RollingScene& scene) {
    answer.scenes.push_back(asked(scene, set, file + ", point " + std::to_string(point + 1)));
  });
  return answer;
}

PredictedScenes of_scene(const FitOfScenes& fit, const std::filesystem::path& file, const Json& object,
                         const GivenSet& set) {
  const auto entries =
      overridden(scene_entries(object, file.parent_path(), file.string()), fitted_entries(fit.record, set.name));
  return {fit.output, {"speed", "load"}, {asked(scene_from(entries, file.string()), set, file.string())}};
}

/// The inputs that varied between the fit's own data of scenes.
std::vector<std::string> varied_inputs(const FitRecord& fit) {
  std::vector<std::string> names;
  for (const FitInputRecord& input : fit.inputs)
    if (find_input(input.name) && !contains(names, input.name)) names.push_back(input.name);
  return names;
}

/// Names of columns that are no inputs.
constexpr std::array<std::string_view, 3> other_columns{"data", "sigma", "note"};

void check_columns(const FitOfScenes& fit, const MeasuredTable& table) {
  for (const MeasuredColumn& column : table.columns) {
    std::vector<std::string_view> known = keys_like(column.name);
    known.insert(known.end(), other_columns.begin(), other_columns.end());
    known.push_back(fit.output);
    if (find_name(known, column.name) < 0)
      throw std::invalid_argument(table.file + ": " + column.name + ": " +
                                  unknown("unknown column", known, column.name));
    if (fit.is_fitted(held_key(column.name)))
      throw std::invalid_argument(table.file + ": " + column.name + ": is fitted: leave the column out");
  }
  for (const std::string& key : varied_inputs(fit.record))
    if (none_of(table.columns, [&](const MeasuredColumn& column) { return held_key(column.name) == key; }))
      throw std::invalid_argument(table.file + ": " + key + ": is missing: it varies between the data of the fit");
}

/// Entries of the fit's scene as it is for a data set. @throws std::invalid_argument if the first set alone says more
std::vector<SceneEntry> scene_of_set(const FitOfScenes& fit, const GivenSet& set, const MeasuredTable& table) {
  for (const SceneEntry& entry : fit.sets.front().set)
    if (!value_given(set.set, entry.key) && !table.find(entry.key))
      throw std::invalid_argument(table.file + ": " + entry.key + ": is missing: only the data set " +
                                  fit.sets.front().name + " of the fit gives it");
  const Json scene = parse_object(fit.record.scene, fit.record.name + ": scene");
  return overridden(scene_entries(scene, {}, fit.record.name), set.set);
}

double sigma_of(const MeasuredTable& table, std::size_t row, double reading, std::string_view unit) {
  const MeasuredColumn* const column = table.find("sigma");
  if (!column) return RollingSolution::absent;
  const bool part = column->unit == "%";
  MeasuredColumn plain = *column;
  if (part) plain.unit = "";
  const double sigma = measured_number(table, plain, row, part ? "1" : unit);
  if (!(sigma > 0))
    throw std::invalid_argument(table.place(row) + ": " + heading(*column) + " = " + column->cells[row] +
                                ": must be > 0");
  if (part && !std::isfinite(reading))
    throw std::invalid_argument(table.file + ": sigma: a part needs the measured values too: give it with its unit");
  return part ? sigma / 100 * std::abs(reading) : sigma;
}

PredictedScenes of_table(const FitOfScenes& fit, const std::string& file, const std::string& given_set) {
  const MeasuredTable table = read_measured_table(file);
  check_columns(fit, table);
  PredictedScenes answer{fit.output, {}, {}};
  for (const MeasuredColumn& column : table.columns)
    if (const InputKind* const kind = find_input(held_key(column.name));
        kind && kind->real() && column.name != fit.output)
      answer.inputs.push_back(held_key(column.name));
  const MeasuredColumn *const sets = table.find("data"), *const measured = table.find(fit.output);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string place = table.place(row);
    const GivenSet& set = fit.set(sets ? sets->cells[row] : given_set, place);
    std::vector<SceneEntry> own = fitted_entries(fit.record, set.name);
    for (const MeasuredColumn& column : table.columns)
      if (find_input(column.name) && column.name != fit.output)
        own.push_back(held_entry(column_entry(table, column, row)));
    AskedScene one = asked(scene_from(overridden(scene_of_set(fit, set, table), own), place), set, place);
    const std::string_view unit = measured_quantity(fit.output).unit_for(body_of(one.scene.scene));
    if (measured && !measured->cells[row].empty()) one.measured = measured_number(table, *measured, row, unit);
    one.deviation = sigma_of(table, row, one.measured, unit);
    answer.scenes.push_back(std::move(one));
  }
  return answer;
}

}  // namespace

PredictedScenes predicted_scenes(const FitRecord& record, const std::filesystem::path& file, const std::string& set) {
  const FitOfScenes fit(record);
  const GivenSet& usual = fit.set(set, "--predict-data");
  if (file.extension() != ".json") return of_table(fit, file.string(), usual.name);
  const Json object = read_object(file.string());
  PredictedScenes answer =
      object.contains("study") ? of_study(fit, file.string(), usual) : of_scene(fit, file, object, usual);
  for (AskedScene& one : answer.scenes) {
    assign_fitted(one.scene.scene, record, one.scene.set);
    if (const auto broken = check(one.scene.scene); !broken.empty())
      throw std::invalid_argument(one.scene.measured.place + ": " + broken.front());
  }
  return answer;
}

}  // namespace rollres
