#include "studies/fit/fit_file.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "core/messages/message_text.hpp"
#include "core/scene/scene_input.hpp"
#include "core/surface/scene_rules.hpp"
#include "db/file/digest.hpp"
#include "db/rows/result_store.hpp"
#include "fitting/fit/closed_form_start.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/scene_entries.hpp"
#include "studies/study/study_scene.hpp"
#include "studies/text/file_kind.hpp"
#include "studies/text/measured_table.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// One data set as it was given.
struct GivenSet {
  std::string name;
  std::string file;  // beside the fit's file
  std::vector<SceneEntry> set = {};
  std::optional<Json> sigma = {};
  std::string place;
  std::string output = {};  // empty: the fit's
};

/// A parameter before units and rules.
struct GivenParameter {
  std::string key, place, set;
  std::optional<Json> start = {}, lowest = {}, highest = {};
  std::optional<bool> logarithmic = {};
  bool fixed = false;
  std::optional<Json> prior = {};
};

constexpr const char* parameter_rule =
    "must be a start, or an object with start, lowest, highest, scale, fixed, data, prior";

GivenParameter given_parameter(const std::string& key, const Json& value, const std::string& fit_place) {
  const std::string place = fit_place + ": parameters";
  const InputKind* const kind = find_input(key);
  const bool term = is_measured_term(key);
  std::vector<std::string_view> known = keys_like(key);
  known.insert(known.end(), {offset_key, scale_key});
  if (!kind && !term) refuse(place, key, value, unknown("unknown key", known, key));
  if (!term && !kind->real()) refuse(place, key, value, "must be an input that is a real number");
  GivenParameter given{.key = key, .place = place + ": " + key, .set = ""};
  if (value.is_number() || value.is_string()) {
    given.start = value;
    return given;
  }
  if (!value.is_object()) refuse(place, key, value, parameter_rule);
  refuse_unknown_keys(value, fit_parameter_keys, given.place);
  const auto take = [&](const char* name, std::optional<Json>& target) {
    if (const auto found = value.find(name); found != value.end()) target = *found;
  };
  take("start", given.start);
  take("lowest", given.lowest);
  take("highest", given.highest);
  take("prior", given.prior);
  if (value.contains("scale"))
    given.logarithmic = name_or_first(value, "scale", spacing_names, given.place) == "logarithmic";
  given.fixed = is_true(value, "fixed", given.place);
  if (const auto set = value.find("data"); set != value.end()) {
    if (!set->is_string()) refuse(given.place, "data", *set, "must be the name of a data set");
    given.set = set->get<std::string>();
  }
  return given;
}

constexpr std::string_view moduli_name = "moduli";

/// The output that is measured, or "moduli".
std::string output_name(const Json& object, const std::string& place) {
  const std::string name = needed_text(object, "output", place, "must be the key of an output, or moduli");
  if (name != moduli_name) refusing_at(place + ": output", [&] { return real_output(name); });
  return name;
}

GivenSet given_set(const Json& value, const std::filesystem::path& fit_file, const std::string& fit_place) {
  const std::string place = fit_place + ": data";
  const auto beside = [&](const std::string& file) { return (fit_file.parent_path() / file).string(); };
  if (value.is_string() && !value.get_ref<const std::string&>().empty()) {
    const auto file = value.get<std::string>();
    return {.name = std::filesystem::path(file).stem().string(), .file = beside(file), .place = place};
  }
  if (!value.is_object()) refuse(fit_place, "data", value, "must be the name of a CSV file, an object or a list");
  refuse_unknown_keys(value, data_set_keys, place);
  const std::string file = needed_text(value, "file", place, "must be the name of a CSV file");
  GivenSet given{.name = std::filesystem::path(file).stem().string(), .file = beside(file), .place = place};
  if (value.contains("name")) given.name = needed_name(value, "name", place, "must be a name");
  given.set = set_entries(value, place);
  if (value.contains("output")) given.output = output_name(value, place);
  if (const auto sigma = value.find("sigma"); sigma != value.end()) given.sigma = *sigma;
  return given;
}

std::vector<GivenSet> given_sets(const Json& fit, const std::filesystem::path& file, const std::string& place) {
  const Json& data = needed(fit, "data", place, "must be the name of a CSV file, an object or a list");
  std::vector<GivenSet> sets;
  if (data.is_array() && !data.empty())
    for (const Json& item : data) sets.push_back(given_set(item, file, place));
  else
    sets.push_back(given_set(data, file, place));
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (sets[i].name == sets[j].name)
        throw std::invalid_argument(place + ": data: name = \"" + sets[i].name + "\": given twice");
  return sets;
}

/// A standard deviation: of its own, or relative to the measured value.
struct Sigma {
  double value;
  bool relative;
  double of(double measured) const { return relative ? value * std::abs(measured) : value; }
};

Sigma given_sigma(const Json& value, std::string_view unit, const std::string& place) {
  const std::string rule = "must be > 0: a percentage (\"2 %\"), or have " + unit_in_words(unit);
  Sigma sigma{0, false};
  if (value.is_number()) {
    sigma.value = value.get<double>();
  } else if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    if (const auto part = percentage(text))
      sigma = {*part, true};
    else
      try {
        sigma.value = si_value(text, unit);
      } catch (const std::invalid_argument&) {
        refuse(place, "sigma", value, rule);
      }
  }
  if (!(sigma.value > 0)) refuse(place, "sigma", value, rule);
  return sigma;
}

/// A cell of an input's column.
SceneEntry entry_of(const MeasuredTable& table, const MeasuredColumn& column, std::size_t row) {
  const std::string& cell = column.cells[row];
  const InputKind& kind = *find_input(column.name);
  SceneEntry entry{column.name, cell, table.place(row)};
  if (!kind.choices.empty() || (kind.quantity.range.infinity_allowed && cell == "infinite")) return entry;
  const bool dimensionless = kind.quantity.unit == "1";
  if (cell.empty() || !plain_number(cell) || dimensionless || column.unit.empty())
    entry.value = measured_number(table, column, row, dimensionless ? "1" : kind.quantity.unit);
  else
    entry.value = cell + " " + column.unit;  // its unit may depend on the body
  return entry;
}

/// @param others  outputs that other data sets read from the same table
void refuse_unknown_columns(const MeasuredTable& table, const std::vector<std::string>& others, bool moduli) {
  for (const MeasuredColumn& column : table.columns) {
    std::vector<std::string_view> known = keys_like(column.name);
    std::erase_if(known, [](std::string_view key) { return find_input(key)->list; });
    known.insert(known.end(), others.begin(), others.end());
    known.insert(known.end(), {"sigma", "note"});
    if (moduli) known.insert(known.end(), {"frequency", "angular_frequency", storage_modulus_key, loss_modulus_key});
    if (find_name(known, column.name) < 0)
      throw std::invalid_argument(table.file + ": " + column.name + ": " +
                                  unknown("unknown column", known, column.name));
  }
}

/// Whether the scene has smooth answers without its spacing.
bool smooth_without_spacing(const RollingScene& scene) {
  if (!scene.spacing) return false;
  if (scene.indenter == Indenter::sphere) return scene.method == Method::automatic || scene.method == Method::newton;
  RollingScene free = scene;
  free.spacing.reset();
  return resolved_method(free) == Method::spectral;
}

/// The standard deviation that a row's value has, or what its residual is measured in, and whether it is relative.
struct Deviation {
  double value;
  bool relative;
};

Deviation deviation_of(const FitFile& fit, const GivenSet& set, const MeasuredTable& table,
                       const MeasuredColumn& output, std::size_t row, double value, std::string_view unit) {
  const MeasuredColumn* const deviations = table.find("sigma");
  const std::string place = table.place(row);
  if (deviations) {
    const bool relative = deviations->unit == "%";
    MeasuredColumn column = *deviations;
    if (column.unit.empty()) column.unit = output.unit;
    if (relative) column.unit = "";
    const Sigma sigma{measured_number(table, column, row, relative ? "1" : unit) / (relative ? 100 : 1), relative};
    if (!(sigma.of(value) > 0))
      throw std::invalid_argument(place + ": " + heading(*deviations) + " = " + deviations->cells[row] +
                                  ": must be > 0");
    return {sigma.of(value), relative};
  }
  if (set.sigma) {
    const Sigma sigma = given_sigma(*set.sigma, unit, set.place);
    return {sigma.of(value), sigma.relative};
  }
  if (fit.relative_weights) return {std::abs(value), true};
  return {1, false};
}

void add_value(FitFile& fit, const GivenSet& set, const MeasuredTable& table, const MeasuredColumn& output,
               std::size_t row, MeasuredScene measured) {
  const std::string place = table.place(row);
  const std::string_view unit = measured_quantity(measured.output).unit_for(measured.scene.indenter);
  const double value = measured_number(table, output, row, unit);
  const Deviation deviation = deviation_of(fit, set, table, output, row, value, unit);
  if (deviation.relative && !(value > 0))
    throw std::invalid_argument(place + ": " + heading(output) + " = " + output.cells[row] +
                                ": must be > 0 where deviations are relative to it");
  if (value < 0) fit.warnings.push_back(place + ": " + heading(output) + " = " + output.cells[row] + ": is negative");
  measured.measured = {.value = value, .deviation = deviation.value, .place = place};
  fit.scenes.push_back(std::move(measured));
}

/// Leaves out the scene's own spacing where there are smooth answers without it.
void leave_out_spacing(FitFile& fit, RollingScene& scene) {
  if (!smooth_without_spacing(scene)) return;
  if (fit.notes.empty())
    fit.notes.push_back("spacing = " + readable(*scene.spacing, "m") +
                        " of the scene left out, for answers without a grid's jumps: " +
                        (scene.indenter == Indenter::sphere ? "the grid is tied to the contact"
                                                            : "the edges of contact are continuous"));
  scene.spacing.reset();
}

/// Reads the rows of one data set into the fit. @param keep_spacing  the fit's own set has one
/// @param others  outputs that data sets read from the same table
void read_rows(FitFile& fit, const GivenSet& set, const std::vector<SceneEntry>& base, bool keep_spacing,
               const MeasuredTable& table, const std::vector<std::string>& others) {
  const std::string output = set.output.empty() ? fit.output : set.output;
  const bool moduli = output == moduli_name, first = fit.scenes.empty();
  refuse_unknown_columns(table, others, moduli);
  if (table.find("sigma") && set.sigma) refuse(set.place, "sigma", *set.sigma, "the table has a column sigma too");
  std::vector<const MeasuredColumn*> columns;
  if (moduli) {
    for (const std::string_view key : {storage_modulus_key, loss_modulus_key})
      if (const MeasuredColumn* const column = table.find(key)) columns.push_back(column);
    if (columns.empty()) columns.push_back(&table.needed(storage_modulus_key));
  } else {
    columns.push_back(&table.needed(output));
  }
  const std::vector<double> frequencies = moduli ? measured_frequencies(table) : std::vector<double>();
  const std::vector<SceneEntry> common = overridden(base, set.set);
  const auto is_other = [&](const MeasuredColumn& column) {
    return std::find(others.begin(), others.end(), column.name) != others.end();
  };
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<SceneEntry> own;
    for (const MeasuredColumn& column : table.columns)
      if (find_input(column.name) && !is_other(column)) own.push_back(entry_of(table, column, row));
    const std::string place = table.place(row);
    RollingScene scene = scene_from(overridden(common, own), place);
    if (!keep_spacing && !value_given(set.set, "spacing") && !value_given(own, "spacing"))
      leave_out_spacing(fit, scene);
    if (!fit.scenes.empty() && scene.indenter != fit.indenter())
      throw std::invalid_argument(place + ": indenter: must be the same in all rows");
    for (const MeasuredColumn* const column : columns)
      add_value(fit, set, table, *column, row,
                {.scene = scene,
                 .measured = {},
                 .set = set.name,
                 .output = moduli ? column->name : output,
                 .angular_frequency = moduli ? 2 * std::numbers::pi * frequencies[row] : RollingSolution::absent});
  }
  const bool known = table.find("sigma") || set.sigma;
  if (!first && known != fit.deviations_known)
    throw std::invalid_argument((known ? fit.source : table.file) +
                                ": sigma is missing: give it for all data sets or for none");
  fit.deviations_known = known;
  for (const MeasuredColumn& column : table.columns)
    if (find_input(column.name) && !is_other(column) &&
        std::find(fit.varying.begin(), fit.varying.end(), column.name) == fit.varying.end())
      fit.varying.push_back(column.name);
}

/// Reads all data sets; a table that several sets read may have a column for each of their outputs.
std::string read_data(FitFile& fit, const std::vector<GivenSet>& sets, const std::vector<SceneEntry>& base,
                      bool keep_spacing) {
  std::string all_text;
  for (const GivenSet& set : sets) {
    const MeasuredTable table = read_measured_table(set.file);
    all_text += table.text + '\n';
    std::vector<std::string> others;
    for (const GivenSet& other : sets)
      if (other.file == set.file) others.push_back(other.output.empty() ? fit.output : other.output);
    read_rows(fit, set, base, keep_spacing, table, others);
  }
  return all_text;
}

void warn_of_repeated_rows(FitFile& fit) {
  std::map<std::string, const MeasuredScene*> seen;
  for (const MeasuredScene& row : fit.scenes) {
    const auto [place, fresh] = seen.try_emplace(
        evaluation_key(row.scene) + row.set + row.output + message_text<17>(row.angular_frequency), &row);
    if (fresh) continue;
    const bool same = place->second->measured.value == row.measured.value;
    if (same)
      fit.warnings.push_back(row.measured.place + ": the same row as " + place->second->measured.place +
                             "; both count");
  }
}

/// A number of a parameter, in its unit; an offset has that of what is measured, a scale none.
double number_of(const GivenParameter& given, const Json& value, const std::string& what, const FitFile& fit) {
  const Indenter indenter = fit.indenter();
  if (is_measured_term(given.key)) {
    const auto row = std::find_if(fit.scenes.begin(), fit.scenes.end(), [&](const MeasuredScene& scene) {
      return given.set.empty() || scene.set == given.set;
    });
    const std::string_view unit =
        given.key == scale_key || row == fit.scenes.end() ? "1" : measured_quantity(row->output).unit_for(indenter);
    if (value.is_number()) return value.get<double>();
    try {
      if (value.is_string()) return si_value(value.get_ref<const std::string&>(), unit);
    } catch (const std::invalid_argument&) {  // refused below
    }
    refuse(given.place, what, value, "must be a number, or have " + unit_in_words(unit));
  }
  const InputValue found = input_value({given.key, value, given.place + ": " + what}, indenter);
  return std::get<double>(found);
}

Prior prior_of(const GivenParameter& given, const FitFile& fit) {
  const std::string place = given.place + ": prior";
  if (!given.prior->is_object()) refuse(given.place, "prior", *given.prior, "must be an object with mean and sigma");
  refuse_unknown_keys(*given.prior, prior_keys, place);
  if (!fit.deviations_known)
    refuse(given.place, "prior", *given.prior, "needs the sigma of the data too: they say which of both weighs more");
  const Json& sigma = needed(*given.prior, "sigma", place, "must be the standard deviation");
  Prior prior{.lognormal = name_or_first(*given.prior, "kind", prior_names, place) == "lognormal",
              .mean = number_of(given, needed(*given.prior, "mean", place, "must be the mean"), "mean", fit),
              .deviation = 0};
  std::optional<double> part;
  if (sigma.is_string()) part = percentage(sigma.get_ref<const std::string&>());
  if (prior.lognormal) {
    if (!(prior.mean > 0)) refuse(place, "mean", (*given.prior)["mean"], "must be > 0 where it is lognormal");
    prior.deviation = part ? *part : sigma.is_number() ? sigma.get<double>() : 0;
  } else {
    prior.deviation = part ? *part * std::abs(prior.mean) : number_of(given, sigma, "prior: sigma", fit);
  }
  if (!(prior.deviation > 0))
    refuse(place, "sigma", sigma, prior.lognormal ? "must be a percentage or a number > 0" : "must be > 0");
  return prior;
}

void read_loss(FitFile& fit, const Json& object, const std::string& place) {
  fit.loss = choice_or_first<Loss>(object, "loss", place);
  fit.loss_scale = positive_or(object, "loss_scale", usual_loss_scale(fit.loss), place);
  fit.relative_weights = name_or_first(object, "weights", weight_names, place) == "relative";
  if (object.contains("step")) fit.step = positive_or(object, "step", 0, place, 0.1);
}

void read_limits(FitLimits& limits, const Json& object, const std::string& place) {
  if (object.contains("solutions_limit"))
    limits.solutions = static_cast<std::size_t>(whole_number_or(object, "solutions_limit", 1, 1, 2'000'000'000, place));
  const auto time = object.find("time_limit");
  if (time == object.end()) return;
  if (time->is_number()) limits.seconds = time->get<double>();
  try {
    if (time->is_string()) limits.seconds = si_value(time->get_ref<const std::string&>(), "s");
  } catch (const std::invalid_argument&) {
    limits.seconds = 0;  // refused below
  }
  if (!(limits.seconds > 0 && std::isfinite(limits.seconds)))
    refuse(place, "time_limit", *time, "must be > 0 in s, or a text with a unit of time");
}

/// The scene's entries with the starts of the parameters; what has no value yet gets one from which closed forms start.
std::vector<SceneEntry> started(std::vector<SceneEntry> entries, const std::vector<GivenParameter>& parameters) {
  const auto has = [&](const std::string& key) { return value_given(entries, key) != nullptr; };
  for (const GivenParameter& given : parameters) {
    if (is_measured_term(given.key)) continue;
    if (given.start && (given.set.empty() || !has(given.key)))
      entries = overridden(entries, {{given.key, *given.start, given.place}});
    else if (!given.start && !has(given.key) && has_closed_form_start(given.key))
      entries.push_back({given.key, closed_form_placeholder(given.key), given.place});
  }
  return entries;
}

}  // namespace

FitFile read_fit(const std::filesystem::path& file) {
  const std::string place = file.string();
  const Json object = read_object(place);
  require_kind(FileKind::fit, object, place);
  refuse_unknown_keys(object, fit_keys, place);
  FitFile fit;
  fit.name = needed_name(object, "fit", place, "must be the name of the fit");
  fit.source = place;
  fit.definition = object.dump(2);
  if (object.contains("output")) fit.output = needed_text(object, "output", place, "must be the key of an output");
  refusing_at(place + ": output", [&] { return real_output(fit.output); });
  read_loss(fit, object, place);
  constexpr int usual_starts = 4;
  fit.options.starts = whole_number_or(object, "starts", usual_starts, 1, 1000, place);
  read_limits(fit.options.limits, object, place);
  fit.options.seed = static_cast<std::uint64_t>(whole_number_or(object, "seed", 1, 0, 2'000'000'000, place));

  const Json& parameters = needed(object, "parameters", place, "must be an object with at least one input");
  if (!parameters.is_object() || parameters.empty())
    refuse(place, "parameters", parameters, "must be an object with at least one input");
  std::vector<GivenParameter> given;
  for (const auto& [key, value] : parameters.items()) {
    if (value.is_array())
      for (const Json& item : value) given.push_back(given_parameter(key, item, place));
    else
      given.push_back(given_parameter(key, value, place));
  }
  const auto base = started(overridden(scene_entries_of(object, file, place), set_entries(object, place)), given);
  const std::vector<GivenSet> sets = given_sets(object, file, place);
  const bool keep_spacing = value_given(set_entries(object, place), "spacing") != nullptr;
  fit.data_digest = digest(read_data(fit, sets, base, keep_spacing));
  warn_of_repeated_rows(fit);

  for (const GivenParameter& parameter : given) {
    if (std::find(fit.varying.begin(), fit.varying.end(), parameter.key) != fit.varying.end())
      throw std::invalid_argument(parameter.place + ": is a column of the data too");
    if (!parameter.set.empty() &&
        std::none_of(sets.begin(), sets.end(), [&](const GivenSet& set) { return set.name == parameter.set; }))
      throw std::invalid_argument(parameter.place + ": data = \"" + parameter.set + "\": no data set of that name");
    FittedInput input{{parameter.key}, {}, parameter.set};
    if (parameter.lowest) input.input.lowest = number_of(parameter, *parameter.lowest, "lowest", fit);
    if (parameter.highest) input.input.highest = number_of(parameter, *parameter.highest, "highest", fit);
    input.input.logarithmic = parameter.logarithmic;
    if (parameter.start) input.start = number_of(parameter, *parameter.start, "start", fit);
    if (parameter.prior) input.prior = prior_of(parameter, fit);
    if (!parameter.fixed) {
      fit.inputs.push_back(input);
      continue;
    }
    if (is_measured_term(parameter.key)) throw std::invalid_argument(parameter.place + ": fixed: leave it out");
    if (!input.start || !parameter.set.empty())
      throw std::invalid_argument(parameter.place + ": fixed: needs a start, and no data set");
    fit.fixed.push_back({parameter.key, *input.start});
  }
  if (fit.inputs.empty()) refuse(place, "parameters", parameters, "all are fixed: nothing is left to fit");
  return fit;
}

FitProblem problem_of(const FitFile& file, const Evaluate& evaluate, int jobs) {
  FitProblem problem = refusing_at(file.source + ": parameters", [&] {
    const std::vector<FittedInput> started = with_closed_form_starts(file.scenes, file.inputs, file.output);
    FitProblem posed =
        resistance_problem(file.scenes, started, evaluate, {.output = file.output, .jobs = jobs, .step = file.step});
    if (file.options.starts > 1) add_closed_forms(posed, file.scenes, started, file.output);
    return posed;
  });
  problem.deviations_known = file.deviations_known;
  problem.loss = file.loss;
  problem.loss_scale = file.loss_scale;
  return problem;
}

}  // namespace rollres
