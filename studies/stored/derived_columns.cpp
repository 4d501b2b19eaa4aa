#include "studies/stored/derived_columns.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <stdexcept>

#include "studies/scene_io/dimension.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/study/study_definition.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct KeptColumn {
  std::string name, unit, unit_of_cylinder, formula;
  QuantityColumn column;
};

std::string column_in(const std::string& sort_key) { return sort_key.substr(sort_key.starts_with('-') ? 1 : 0); }

void add_filters(std::vector<std::string>& names, const std::vector<Filter>& filters) {
  for (const Filter& filter : filters) names.push_back(filter.column);
}

bool is_goal(std::string_view name) { return name == "goal" || name == "second_goal"; }

FormulaDefinitions without_goals(FormulaDefinitions formulas) {
  std::erase_if(formulas, [](const auto& one) { return is_goal(one.first); });
  return formulas;
}

/// The formulas of those names that name no column of the store, or a goal.
FormulaDefinitions formulas_in(const Database& database, const std::vector<Filter>& filters,
                               const std::vector<std::string>& names) {
  const auto unknown_column = [](const std::string& name) {
    constexpr std::array<std::string_view, 4> others{"id", "key", "created", "provenance"};
    return !name.empty() && !find_quantity_column(name) && find_name(others, name) < 0 &&
           (is_goal(name) || find_name(point_columns, name) < 0);
  };
  if (none_of(names, unknown_column)) return {};
  FormulaDefinitions formulas;
  std::map<std::string, std::string> study_of;
  for (const auto& row : run_sql(database, "SELECT name, definition FROM study ORDER BY name").rows) {
    const auto& study = std::get<std::string>(row[0]);
    const auto is_named = [](const Filter& one) {
      return one.column == "study" && one.comparison == Comparison::equal;
    };
    const bool any = any_of(filters, is_named);
    const bool asked = any_of(filters, [&](const Filter& one) { return is_named(one) && one.value == study; });
    if (any && !asked) continue;
    StudyDefinition definition = definition_in(std::get<std::string>(row[1]), database.name() + ": " + study);
    definition.formulas.insert(definition.formulas.end(), definition.goals.begin(), definition.goals.end());
    for (auto& [name, formula] : definition.formulas) {
      if (!contains(names, name)) continue;
      const auto same = find_if(formulas, [&](const auto& one) { return one.first == name; });
      if (same == formulas.end())
        formulas.emplace_back(name, formula);
      else if (same->second != formula && !is_goal(name))  // goals are stored: of several, they have no common unit
        throw std::invalid_argument(name + ": is computed differently in the studies " + study_of[name] + " and " +
                                    study + "; choose one with study=NAME");
      study_of.try_emplace(name, study);
    }
  }
  return formulas;
}

}  // namespace

std::vector<ComputedColumn> computed_columns(const FormulaDefinitions& formulas) {
  std::vector<ComputedColumn> columns;
  for (const auto& [name, text] : formulas) {
    const Formula formula(text, FormulaNames::inputs_and_outputs);
    ComputedColumn& column = columns.emplace_back(ComputedColumn{name, formula.keys()});
    column.value = [formula, keys = formula.keys()](std::span<const double> values) {
      return formula([&](const std::string& key) {
        return values[static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin())];
      });
    };
  }
  return columns;
}

const QuantityColumn& derived_column(const std::string& name, const std::string& formula) {
  static std::mutex mutex;
  static std::map<std::pair<std::string, std::string>, KeptColumn> all;
  const std::lock_guard lock(mutex);
  const auto [place, is_new] = all.try_emplace({name, formula});
  KeptColumn& kept = place->second;
  if (!is_new) return kept.column;
  const Formula understood(formula, FormulaNames::inputs_and_outputs);
  kept.name = name;
  kept.formula = formula;
  kept.unit = unit_of(understood, Indenter::sphere);
  kept.unit_of_cylinder = unit_of(understood, Indenter::cylinder);
  Quantity quantity{kept.name, "", kept.unit, kept.formula};
  if (kept.unit_of_cylinder != kept.unit) quantity.unit_2d = kept.unit_of_cylinder;
  kept.column = {{name, "REAL"}, quantity, false};
  return kept.column;
}

void convert_to_si(Filter& filter, const Quantity& quantity) {
  if (filter.value.empty() || filter.value == "infinite" || plain_number(filter.value)) return;
  filter.value = shortest(refusing_at(filter.column + " = " + filter.value, [&] {
    if (quantity.grows_with_width()) filter.per_metre = false;
    try {
      return is_temperature(quantity.key) ? kelvin(filter.value) : si_value(filter.value, quantity.unit);
    } catch (const std::invalid_argument&) {
      if (!quantity.grows_with_width()) throw;
      filter.per_metre = true;
      return si_value(filter.value, quantity.unit_2d);
    }
  }));
}

void convert_written(Filter& filter, const Quantity& quantity) {
  if (const std::optional<double> bare = plain_number(filter.value))
    if (const std::string doubt = doubt_of_filter(quantity, *bare); !doubt.empty())
      throw std::invalid_argument(filter.column + " = " + filter.value + ": " + doubt);
  convert_to_si(filter, quantity);
}

void convert_to_si(std::vector<Filter>& filters, const FormulaDefinitions& formulas) {
  for (Filter& filter : filters)
    for (const auto& [name, formula] : formulas)
      if (name == filter.column) convert_to_si(filter, derived_column(name, formula).quantity);
}

namespace {

/// Adds those among these names, and those of the filters.
template <class Question>
FormulaDefinitions add_named(const Database& database, Question& query, std::vector<std::string> names) {
  add_filters(names, query.filters);
  const FormulaDefinitions formulas = formulas_in(database, query.filters, names);
  convert_to_si(query.filters, formulas);
  query.computed = computed_columns(without_goals(formulas));
  return formulas;
}

}  // namespace

FormulaDefinitions add_derived(const Database& database, Query& query) {
  std::vector<std::string> names = query.columns;
  for (const std::string& text : query.sort) names.push_back(column_in(text));
  return add_named(database, query, std::move(names));
}

FormulaDefinitions add_derived(const Database& database, GroupQuery& query) {
  std::vector<std::string> names = query.by;
  for (const Aggregate& aggregate : query.aggregates) {
    names.push_back(aggregate.column);
    names.push_back(aggregate.weight);
  }
  return add_named(database, query, std::move(names));
}

}  // namespace rollres
