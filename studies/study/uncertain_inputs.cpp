#include "studies/study/uncertain_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/derivatives/objective.hpp"
#include "core/scene/scene_input.hpp"
#include "fitting/fit/measured_terms.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/usual_names.hpp"
#include "studies/study/trusted_fit.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// An entry of the list of a distribution, or the only number.
std::vector<Json> numbers_of(const Json& given) {
  if (!given.is_array()) return {given};
  return {given.begin(), given.end()};
}

std::optional<double> share_of(const Json& given) {
  return given.is_string() ? percentage(given.get<std::string>()) : std::nullopt;
}

bool all_shares(const std::vector<Json>& numbers) {
  return all_of(numbers, [](const Json& one) { return share_of(one).has_value(); });
}

/// What is read where.
struct Place {
  std::string key;  ///< as it is written
  const InputKind& kind;
  Body body;
  std::string text;  ///< for messages

  std::string_view unit() const { return kind.quantity.unit_for(body); }
  double value(const Json& given) const { return std::get<double>(input_value({key, given, text}, body)); }
  double difference(const Json& given) const { return input_difference({key, given, text}, kind, body); }
};

void refuse_count(const Place& place, const Json& given, DistributionKind kind) {
  constexpr std::array rules{"must be [mean, standard deviation], or a share as in \"10 %\"",
                             "must be [median, standard deviation of the logarithm], or a share as in \"10 %\"",
                             "must be [lowest, highest]", "must be [lowest, highest]",
                             "must be [lowest, most probable, highest]"};
  refuse(place.text, name_of(kind), given, rules[static_cast<std::size_t>(kind)]);
}

/// The numbers of a distribution; of its ratio to the input's own value where only shares stand there.
UncertainInput read_numbers(const Place& place, DistributionKind kind, const Json& given) {
  const std::vector<Json> numbers = numbers_of(given);
  UncertainInput input{.key = held_key(place.key), .distribution = {kind, {}}};
  std::vector<double>& parameters = input.distribution.parameters;
  const bool two_moments = kind == DistributionKind::normal || kind == DistributionKind::lognormal;
  if (two_moments && numbers.size() == 1 && all_shares(numbers)) {
    input.relative = true;
    parameters = {1, *share_of(numbers[0])};
    return input;
  }
  if (numbers.size() != (kind == DistributionKind::triangular ? 3U : 2U)) refuse_count(place, given, kind);
  if (two_moments) {
    parameters = {place.value(numbers[0])};
    const std::optional<double> share = share_of(numbers[1]);
    if (kind == DistributionKind::normal)
      parameters.push_back(share ? *share * std::abs(parameters[0]) : place.difference(numbers[1]));
    else if (!share && !numbers[1].is_number())
      refuse(place.text, name_of(kind), numbers[1], "the standard deviation of the logarithm has no unit: 0.1 or 10 %");
    else
      parameters.push_back(share ? *share : numbers[1].get<double>());
    return input;
  }
  input.relative = all_shares(numbers);
  if (input.relative && place.unit() == "1")
    refuse(place.text, name_of(kind), given, "has no unit: write its values as plain numbers, 0.1 for 10 %");
  for (const Json& number : numbers) parameters.push_back(input.relative ? 1 + *share_of(number) : place.value(number));
  return input;
}

void refuse_weight_outside(const Place& place, const UncertainInput& input, double about, const Json& given) {
  const Distribution whole = input.relative ? times(input.distribution, about) : input.distribution;
  const double outside = weight_outside(whole, place.kind.quantity.range);
  if (outside <= negligible_weight) return;
  const std::string share = short_number(100 * outside, 3) + " % of its weight";
  if (outside >= 0.5)
    refuse(place.text, name_of(whole.kind), given,
           share + " is outside its range: " + place.kind.quantity.range.rule());
  if (!input.truncated)
    refuse(place.text, name_of(whole.kind), given,
           share + " is outside its range (" + place.kind.quantity.range.rule() +
               "): take another distribution, or \"truncated\": true to cut it off there");
}

/// The value about which an input scatters.
double value_about(const Place& place, const std::vector<SceneEntry>& scene, const Json& given) {
  const Json* const own = value_given(scene, held_key(place.key));
  if (!own) refuse(place.text, place.key, given, "scatters about its value in the scene, which gives it none");
  const double value = std::get<double>(input_value({held_key(place.key), *own, place.text}, place.body));
  if (!(value > 0) || !std::isfinite(value))
    refuse(place.text, place.key, given, "scatters about its value in the scene, which must be > 0 and finite");
  return value;
}

UncertainInput uncertain_input(const std::string& key, const Json& object, const std::vector<SceneEntry>& scene,
                               const std::string& outer, const std::vector<std::string>& varied) {
  const InputKind* const kind = find_input(key);
  if (!kind || !kind->real()) {
    std::vector<std::string_view> known = keys_like(key);
    for (const FileKey& option : uncertain_keys) known.push_back(option.key);
    if (!kind) refuse(outer, key, object, unknown_input(known, key));
    refuse(outer, key, object, "must be an input that is a real number");
  }
  const std::string place_text = outer + ": " + key;
  const std::string rule = "must be an object with one of normal, lognormal, uniform, loguniform, triangular";
  if (!object.is_object()) refuse(outer, key, object, rule);
  refuse_unknown_keys(object, distribution_keys, place_text);
  const Place place{key, *kind, body_of(scene), place_text};
  std::optional<UncertainInput> input;
  Json given;
  for (std::size_t i = 0; i < ChoiceNames<DistributionKind>::names.size(); ++i) {
    const auto found = object.find(std::string(ChoiceNames<DistributionKind>::names[i]));
    if (found == object.end()) continue;
    if (input) refuse(outer, key, object, rule);
    given = *found;
    input = read_numbers(place, static_cast<DistributionKind>(i), given);
  }
  if (!input) refuse(outer, key, object, rule);
  input->truncated = is_true(object, "truncated", place_text);
  const std::string name(name_of(input->distribution.kind));
  if (const std::string broken = broken_rule(input->distribution); !broken.empty())
    refuse(place_text, name, given, broken);
  const bool of_a_variable = contains(varied, held_key(key));
  if (of_a_variable && !input->relative)
    refuse(place_text, name, given, "is a variable: it scatters about its value, by shares as in \"10 %\"");
  if (input->relative && !of_a_variable) input->about = value_about(place, scene, given);
  if (!of_a_variable) refuse_weight_outside(place, *input, input->about, given);
  return *input;
}

std::vector<CorrelatedPair> pairs_of(const Json& uncertain, const std::vector<UncertainInput>& inputs,
                                     const std::string& place) {
  std::vector<CorrelatedPair> pairs;
  const auto found = uncertain.find("correlation");
  if (found == uncertain.end()) return pairs;
  const std::string rule = "must be a list of pairs with their correlation: [[\"load\", \"speed\", 0.5]]";
  if (!found->is_array()) refuse(place, "correlation", *found, rule);
  const auto place_of = [&](const Json& name, const Json& pair) {
    if (!name.is_string()) refuse(place, "correlation", pair, rule);
    for (std::size_t i = 0; i < inputs.size(); ++i)
      if (inputs[i].key == held_key(name.get<std::string>())) return i;
    refuse(place, "correlation", pair, name.get<std::string>() + " is none of the uncertain inputs");
  };
  for (const Json& pair : *found) {
    if (!pair.is_array() || pair.size() != 3 || !pair[2].is_number()) refuse(place, "correlation", pair, rule);
    const CorrelatedPair read{place_of(pair[0], pair), place_of(pair[1], pair), pair[2].get<double>()};
    if (read.first == read.second) refuse(place, "correlation", pair, "must name two inputs");
    if (!(std::abs(read.correlation) < 1)) refuse(place, "correlation", pair, "must lie between -1 and 1");
    for (const CorrelatedPair& other : pairs)
      if (std::minmax(other.first, other.second) == std::minmax(read.first, read.second))
        refuse(place, "correlation", pair, "given twice");
    pairs.push_back(read);
  }
  refusing_at(place + ": correlation", [&] { return correlation_factor(inputs.size(), pairs); });
  return pairs;
}

void read_sampling(UncertainInputs& uncertain, const Json& object, const std::string& place) {
  uncertain.method = choice_or_first<SampleMethod>(object, "method", place);
  const auto each = static_cast<int>(uncertain.points_of_each());
  const int scramblings =
      whole_number_or(object, "scramblings", static_cast<int>(uncertain.scramblings), 1, 1000, place);
  const int points = whole_number_or(object, "points", each * scramblings, 2, most_points, place);
  if (points % scramblings != 0)
    refuse(place, "points", points,
           "must be a multiple of the " + std::to_string(scramblings) + " scramblings: " +
               std::to_string((points / scramblings + 1) * scramblings) + ", or give other \"scramblings\"");
  uncertain.points = static_cast<std::size_t>(points);
  uncertain.scramblings = static_cast<std::size_t>(scramblings);
  if (const auto seed = object.find("seed"); seed != object.end()) {
    if (!seed->is_number_unsigned()) refuse(place, "seed", *seed, "must be a whole number >= 0");
    uncertain.seed = seed->get<std::uint64_t>();
  }
}

std::vector<Condition> probabilities_of(const Json& object, Body body, const std::string& place) {
  std::vector<Condition> conditions;
  const auto found = object.find("probability");
  if (found == object.end()) return conditions;
  const std::string rule = "must be a list of conditions of inputs and outputs";
  if (!found->is_array()) refuse(place, "probability", *found, rule);
  for (const Json& item : *found) {
    if (!item.is_string()) refuse(place, "probability", item, rule);
    refusing_at(place + ": probability",
                [&] { conditions.emplace_back(item.get<std::string>(), FormulaNames::inputs_and_outputs, body); });
  }
  return conditions;
}

bool is_option(const std::string& key) {
  return any_of(uncertain_keys, [&](const FileKey& known) { return known.key == key; });
}

/// Whether a parameter is an offset or a scale: no input of a scene, but of how values were measured. Of several normal
/// numbers those that are left keep their errors and correlations.
bool is_of_measurement(const std::string& name) { return is_measured_term(name.substr(0, name.find(" ("))); }

/// A parameter of a fit as a distribution: lognormal where a fit takes it in its logarithm, for its errors are of that.
Json fitted_distribution(const FitParameterRecord& parameter, const std::string& place) {
  const InputKind* const kind = find_input(parameter.name);
  if (!kind || !kind->real())
    throw std::invalid_argument(place + ": its parameter " + parameter.name + " is no input of a scene");
  const double error = refusing_at(place, [&] { return trusted_error(parameter); });
  const Range& range = kind->quantity.range;
  const bool positive = range.lowest >= 0 && range.lowest_excluded;
  const bool logarithmic = parameter.value > 0 && (kind->quantity.unit != "1" || positive);
  const Json value = written_input(kind->quantity, parameter.value);
  if (logarithmic) return {{"lognormal", {value, error / parameter.value}}};
  return {{"normal", {value, error}}, {"truncated", true}};
}

}  // namespace

void resolve_fit(Json& file, const std::filesystem::path& path, const std::string& file_place) {
  const auto found = file.find("uncertain");
  if (found == file.end() || !found->is_object() || !found->contains("fit")) return;
  const std::string place = file_place + ": uncertain";
  Json& uncertain = *found;
  const Json given = uncertain["fit"];
  const FitRecord fit = trusted_fit(given, path, place, "fit");
  const std::string fit_place = place + ": fit " + fit.name;
  Json resolved = Json::object();
  for (const FitParameterRecord& parameter : fit.parameters) {
    if (parameter.fixed || is_of_measurement(parameter.name)) continue;
    if (uncertain.contains(parameter.name))
      refuse(place, parameter.name, uncertain[parameter.name], "scatters by the fit already");
    resolved[parameter.name] = fitted_distribution(parameter, fit_place);
  }
  Json pairs = uncertain.value("correlation", Json::array());
  for (const FitCorrelationRecord& pair : fit.correlations)
    if (std::isfinite(pair.correlation) && resolved.contains(pair.first) && resolved.contains(pair.second))
      pairs.push_back({pair.first, pair.second, pair.correlation});
  uncertain.erase("fit");
  for (const auto& [key, value] : uncertain.items())
    if (key != "correlation") resolved[key] = value;
  if (!pairs.empty()) resolved["correlation"] = pairs;
  uncertain = resolved;
}

UncertainInputs uncertain_inputs(const Json& file, const std::vector<SceneEntry>& scene, const std::string& file_place,
                                 const UncertainInputs& usual, const std::vector<std::string>& varied) {
  UncertainInputs uncertain = usual;
  const auto found = file.find("uncertain");
  if (found == file.end()) return uncertain;
  const std::string place = file_place + ": uncertain";
  if (!found->is_object()) refuse(file_place, "uncertain", *found, "must be an object of inputs with distributions");
  for (const auto& [key, object] : found->items())
    if (!is_option(key)) {
      uncertain.inputs.push_back(uncertain_input(key, object, scene, place, varied));
      const std::string& held = uncertain.inputs.back().key;
      for (std::size_t i = 0; i + 1 < uncertain.inputs.size(); ++i)
        if (uncertain.inputs[i].key == held) refuse(place, key, object, "scatters already");
    }
  if (uncertain.inputs.empty()) refuse(file_place, "uncertain", *found, "must have at least one input");
  uncertain.correlations = pairs_of(*found, uncertain.inputs, place);
  read_sampling(uncertain, *found, place);
  uncertain.probabilities = probabilities_of(*found, body_of(scene), place);
  return uncertain;
}

std::vector<GivenAxis> uncertain_axes(const UncertainInputs& uncertain, const std::string& place) {
  std::vector<GivenAxis> axes;
  if (!uncertain.any()) return axes;
  const auto points = uncertain_points(uncertain);
  for (std::size_t i = 0; i < uncertain.inputs.size(); ++i) {
    const UncertainInput& input = uncertain.inputs[i];
    const std::string here = place + ": uncertain: " + input.key;
    const Distribution distribution = input.own();
    GivenAxis axis{.key = input.key, .place = here, .shown = name_of(distribution.kind), .values = {}};
    axis.group = uncertain_group;
    const Quantity& quantity = find_input(input.key)->quantity;
    for (const double probability : points[i])
      axis.values.push_back({input.key, written_input(quantity, quantile(distribution, probability)), here});
    axes.push_back(std::move(axis));
  }
  return axes;
}

}  // namespace rollres
