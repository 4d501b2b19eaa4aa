#include "studies/file_schema/file_keys.hpp"

#include <span>

#include "studies/fit/fit_keys.hpp"
#include "studies/optimise/design_keys.hpp"
#include "studies/study/study_keys.hpp"
#include "studies/study/trusted_fit.hpp"
#include "studies/study/uncertain_inputs.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

std::string values_of(const KeyForm& form) {
  switch (form.kind) {
    case KeyForm::text:
      return "text";
    case KeyForm::name:
      return "text, not empty";
    case KeyForm::number:
      return "number, or one with a unit";
    case KeyForm::positive:
      return "number > 0";
    case KeyForm::boolean:
      return "true, false";
    case KeyForm::whole:
      return "whole number from " + std::to_string(form.lowest) + " to " + std::to_string(form.highest);
    case KeyForm::one_of:
      return joined(form.names);
    case KeyForm::own:
      break;
  }
  return "";
}

/// "default 1e-4" of a meaning that ends with what the default is.
std::string default_in(const FileKey& key) {
  if (key.needed) return "required";
  if (key.form.kind == KeyForm::boolean) return "false";
  const std::string_view meaning = key.meaning;
  for (const std::string_view word : {"; default: ", "; default "})
    if (const std::size_t place = meaning.rfind(word); place != std::string_view::npos)
      return std::string(meaning.substr(place + word.size()));
  return "";
}

Table table_of(std::span<const FileKey> keys) {
  Table table{{"key", "values", "default", "meaning"}, {}};
  for (const FileKey& key : keys)
    table.rows.push_back(
        {"`" + std::string(key.key) + "`", values_of(key.form), default_in(key), std::string(key.meaning)});
  return table;
}

}  // namespace

std::vector<KeySection> key_sections() {
  return {{"Study", table_of(study_keys)},
          {"Study: an interval under `axes`", table_of(interval_keys)},
          {"Study: a zip under `axes`", table_of(zip_keys)},
          {"Study: `sample`", table_of(sample_keys)},
          {"Study: a range under `sample`", table_of(range_keys)},
          {"`uncertain`, beside the inputs that scatter", table_of(uncertain_keys)},
          {"`uncertain`: an input's distribution", table_of(distribution_keys)},
          {"`uncertain`: `fit`, and `prior` of a fit", table_of(stored_fit_keys)},
          {"Study: `chart`, and each of `charts`", table_of(chart_keys)},
          {"Optimisation", table_of(design_keys)},
          {"Optimisation: a goal as an object", table_of(goal_keys)},
          {"Optimisation: a constraint as an object", table_of(constraint_keys)},
          {"Optimisation: a variable between two bounds", table_of(variable_keys)},
          {"Optimisation: each of `scenes`", table_of(duty_keys)},
          {"Optimisation: `stop`", table_of(stop_keys)},
          {"Optimisation: `pareto`", table_of(pareto_keys)},
          {"Fit of a scene", table_of(fit_keys)},
          {"Fit of a scene: a data set", table_of(data_set_keys)},
          {"Fit of a scene: a parameter", table_of(fit_parameter_keys)},
          {"Fit of a scene: `prior` of a parameter", table_of(prior_keys)},
          {"Fit of a scene: `design`", table_of(design_wish_keys)},
          {"Fit of a scene: a range under `design`", table_of(design_range_keys)},
          {"Fit of a material", table_of(material_fit_keys)},
          {"Fit of Kraus's model to a strain sweep", table_of(strain_fit_keys)}};
}

}  // namespace rollres
