#include "studies/fit/fit_file.hpp"

#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "core/scene/scene_input.hpp"
#include "db/file/digest.hpp"
#include "fitting/fit/closed_form_start.hpp"
#include "fitting/fit/noise_fit.hpp"
#include "studies/fit/design_wish.hpp"
#include "studies/fit/fit_data.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/scene_entries.hpp"
#include "studies/scene_io/scene_overrides.hpp"
#include "studies/scene_io/usual_names.hpp"
#include "studies/study/study_scene.hpp"
#include "studies/study/trusted_fit.hpp"
#include "studies/text/file_kind.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// A parameter before units and rules.
struct GivenParameter {
  std::string key, place, set;
  std::string written;  // the key as it stands in the file
  std::optional<Json> start = {}, lowest = {}, highest = {};
  std::optional<bool> logarithmic = {};
  bool fixed = false;
  std::optional<Json> prior = {};
  std::optional<double> smooth = {};  // of its logarithm from that of the parameter before it
};

constexpr const char* parameter_rule =
    "must be a start, or an object with start, lowest, highest, scale, fixed, data, prior, or of a list smooth";

constexpr const char* noise_rule = "must be {} or {\"data\": SET}: a noise needs no start";

GivenParameter given_parameter(const std::string& key, const Json& value, const std::string& fit_place) {
  const std::string place = fit_place + ": parameters";
  const InputKind* const kind = find_number(key);
  const bool term = is_measured_term(key);
  std::vector<std::string_view> known = keys_like(key);
  known.insert(known.end(), {offset_key, scale_key, noise_level_key, relative_noise_key});
  if (!kind && !term && !is_noise_term(key)) refuse(place, key, value, unknown_input(known, key));
  const bool list = kind && kind->list && !kind->layers;
  if (kind && !kind->real() && !list) refuse(place, key, value, "must be an input that is a real number");
  GivenParameter given{.key = held_key(key), .place = place + ": " + key, .set = "", .written = key};
  if (is_noise_term(key) && !value.is_object()) refuse(place, key, value, noise_rule);
  if (value.is_number() || value.is_string()) {
    given.start = value;
    return given;
  }
  if (!value.is_object()) refuse(place, key, value, parameter_rule);
  refuse_unknown_keys(value, fit_parameter_keys, given.place);
  if (is_noise_term(key))
    for (const auto& [name, ignored] : value.items())
      if (name != "data") refuse(place, key, value, noise_rule);
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
  if (given.fixed && element_key(key)) refuse(place, key, value, "is fixed where no parameter names it: leave it out");
  if (value.contains("smooth")) {
    if (!list) refuse(given.place, "smooth", value["smooth"], "is for a whole list: relaxation_moduli");
    given.smooth = positive_or(value, "smooth", 1, given.place);
  }
  if (const auto set = value.find("data"); set != value.end()) {
    if (!set->is_string()) refuse(given.place, "data", *set, "must be the name of a data set");
    given.set = set->get<std::string>();
  }
  return given;
}

/// A list as the numbers that the scene has, each a parameter; every other parameter as it is.
std::vector<GivenParameter> each_number(const std::vector<GivenParameter>& given, const RollingScene& scene) {
  std::vector<GivenParameter> numbers;
  for (const GivenParameter& one : given) {
    const InputKind* const kind = find_input(one.key);
    if (!kind || !kind->list) {
      numbers.push_back(one);
      continue;
    }
    if (one.fixed) throw std::invalid_argument(one.place + ": fixed: leave it out");
    std::size_t count = 0;
    visit_input(scene, one.key, [&](const Quantity&, const auto& value) {
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::vector<double>>) count = value.size();
    });
    if (count == 0) throw std::invalid_argument(one.place + ": the scene has no " + one.key + " to start from");
    for (std::size_t i = 0; i < count; ++i) {
      GivenParameter& number = numbers.emplace_back(one);
      number.key += "[" + std::to_string(i) + "]";
      number.written = number.key;
      number.place += "[" + std::to_string(i) + "]";
      if (i == 0) number.smooth.reset();
    }
  }
  return numbers;
}

/// A number of a parameter, in its unit; an offset has that of what is measured, a scale none.
double number_of(const GivenParameter& given, const Json& value, const std::string& what, const FitFile& fit) {
  const Body body = fit.body();
  if (is_measured_term(given.key)) {
    const auto row =
        find_if(fit.scenes, [&](const MeasuredScene& scene) { return given.set.empty() || scene.set == given.set; });
    const std::string_view unit =
        given.key == scale_key || row == fit.scenes.end() ? "1" : measured_quantity(row->output).unit_for(body);
    if (value.is_number()) {
      if (const std::string doubt = doubt_of_measured(unit, value.get<double>()); !doubt.empty())
        refuse(given.place, what, value, doubt);
      return value.get<double>();
    }
    try {
      if (value.is_string()) return si_value(value.get_ref<const std::string&>(), unit);
    } catch (const std::invalid_argument&) {  // refused below
    }
    refuse(given.place, what, value, "must be a number, or have " + unit_in_words(unit));
  }
  const InputValue found =
      input_value({given.written, value, given.place + ": " + what}, *find_number(given.written), body);
  return std::get<double>(found);
}

/// The standard deviation of a parameter, in its unit.
double parameter_deviation(const GivenParameter& given, const Json& value, const FitFile& fit) {
  const std::string what = "prior: sigma";
  if (is_measured_term(given.key)) return number_of(given, value, what, fit);
  return input_difference({given.written, value, given.place + ": " + what}, *find_number(given.written), fit.body());
}

/// What was known before needs it.
void need_sigma(const FitFile& fit, const std::string& place, const char* key, const Json& value) {
  if (!fit.deviations_known && fit.noise.empty())
    refuse(place, key, value, "needs the sigma of the data, too, which gives the weight of data against prior");
}

Prior prior_of(const GivenParameter& given, const FitFile& fit) {
  const std::string place = given.place + ": prior";
  if (!given.prior->is_object()) refuse(given.place, "prior", *given.prior, "must be an object with mean and sigma");
  refuse_unknown_keys(*given.prior, prior_keys, place);
  need_sigma(fit, given.place, "prior", *given.prior);
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
    prior.deviation = part ? *part * std::abs(prior.mean) : parameter_deviation(given, sigma, fit);
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
    const InputKind* const kind = find_input(given.key);
    if (!kind || kind->list) continue;  // numbers of lists start once there are scenes
    if (given.start && (given.set.empty() || !has(given.key)))
      entries = overridden(entries, {held_entry({given.written, *given.start, given.place})});
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
  given = each_number(given, fit.scenes.front().scene);

  for (const GivenParameter& parameter : given) {  // before priors, which need some deviation
    if (!is_noise_term(parameter.key)) continue;
    if (fit.deviations_known)
      throw std::invalid_argument(parameter.place + ": the data have a sigma; leave out either it or this parameter");
    fit.noise.push_back({parameter.key, parameter.set});
  }
  warn_of_equal_weights(fit);
  for (const GivenParameter& parameter : given) {
    if (contains(fit.varying, parameter.key))
      throw std::invalid_argument(parameter.place + ": is a column of the data too");
    if (any_of(fit.inputs, [&](const FittedInput& other) {
          return other.input.key == parameter.key && other.set == parameter.set;
        }))
      throw std::invalid_argument(parameter.place + ": is given twice");
    if (!parameter.set.empty() && none_of(sets, [&](const GivenSet& set) { return set.name == parameter.set; }))
      throw std::invalid_argument(parameter.place + ": data = \"" + parameter.set + "\": no data set of that name");
    if (is_noise_term(parameter.key)) continue;
    FittedInput input{{parameter.key}, {}, parameter.set};
    if (parameter.lowest) input.input.lowest = number_of(parameter, *parameter.lowest, "lowest", fit);
    if (parameter.highest) input.input.highest = number_of(parameter, *parameter.highest, "highest", fit);
    input.input.logarithmic = parameter.logarithmic;
    if (parameter.start) input.start = number_of(parameter, *parameter.start, "start", fit);
    if (parameter.prior) input.prior = prior_of(parameter, fit);
    if (parameter.smooth) need_sigma(fit, parameter.place, "smooth", *parameter.smooth);
    input.smooth = parameter.smooth;
    if (!parameter.fixed) {
      fit.inputs.push_back(input);
      continue;
    }
    if (is_measured_term(parameter.key)) throw std::invalid_argument(parameter.place + ": fixed: leave it out");
    if (!input.start || !parameter.set.empty())
      throw std::invalid_argument(parameter.place + ": fixed: needs a start, and no data set");
    fit.fixed.push_back({parameter.key, *input.start});
  }
  if (const auto former = object.find("prior"); former != object.end()) {
    need_sigma(fit, place, "prior", *former);
    fit.former = trusted_fit(*former, file, place, "prior");
  }
  if (fit.inputs.empty()) refuse(place, "parameters", parameters, "all are fixed: nothing is left to fit");
  fit.design = read_design(object, fit, place);
  return fit;
}

namespace {

/// What the former fit says of those of its parameters that this one has.
std::vector<KnownBefore> known_of(const FitRecord& former, const std::vector<FitParameter>& parameters) {
  std::vector<FormerParameter> known;
  for (std::size_t j = 0; j < parameters.size(); ++j)
    for (const FitParameterRecord& one : former.parameters) {
      if (one.name != parameters[j].name || one.fixed) continue;
      const bool logarithm = parameters[j].variable.scaling == Scaling::logarithmic;
      const double error = trusted_error(one);
      known.push_back({j, logarithm, one.value, logarithm ? error / one.value : error, one.name});
    }
  if (known.empty()) throw std::invalid_argument("it has none of the parameters");
  const auto count = std::ssize(known);
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(count, count);
  for (const FitCorrelationRecord& pair : former.correlations)
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index k = 0; k < count; ++k)
        if (known[static_cast<std::size_t>(i)].name == pair.first &&
            known[static_cast<std::size_t>(k)].name == pair.second)
          correlation(i, k) = correlation(k, i) = pair.correlation;
  return known_before(known, correlation);
}

}  // namespace

FitProblem problem_of(const FitFile& file, const Evaluate& evaluate, int jobs) {
  FitProblem problem = refusing_at(file.source + ": parameters", [&] {
    const std::vector<FittedInput> started = with_closed_form_starts(file.scenes, file.inputs, file.output);
    FitProblem posed =
        resistance_problem(file.scenes, started, evaluate, {.output = file.output, .jobs = jobs, .step = file.step});
    if (file.options.starts > 1) add_closed_forms(posed, file.scenes, started, file.output);
    if (!file.former) return posed;
    return with_priors(
        posed, refusing_at("prior " + file.former->name, [&] { return known_of(*file.former, posed.parameters); }));
  });
  problem.deviations_known = file.deviations_known;
  problem.loss = file.loss;
  problem.loss_scale = file.loss_scale;
  return problem;
}

FitReport fit(const FitProblem& problem, const FitFile& file) {
  if (file.noise.empty()) return fit(problem, file.options);
  std::vector<NoiseTerm> terms;
  for (const FittedNoise& noise : file.noise) {
    NoiseTerm& term = terms.emplace_back();
    term.name = noise.key + (noise.set.empty() ? "" : " (" + noise.set + ")");
    term.relative = noise.key == relative_noise_key;
    for (const MeasuredScene& row : file.scenes) term.acts.push_back(noise.set.empty() || row.set == noise.set);
    term.acts.resize(problem.data.size(), false);  // priors
  }
  return fit_with_noise(problem, terms, file.options);
}

}  // namespace rollres
