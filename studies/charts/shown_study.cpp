#include "studies/charts/shown_study.hpp"

#include "core/scene/scene_input.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

StudyDefinition definition_of(ResultStore& store, const std::string& study) {
  return definition_in(store.definition(study).value_or(""), store.database().name() + ": " + study);
}

/// The names of all studies that are drawn; a name given twice is one study.
std::vector<std::string> names_of(ResultStore& store, const StudyChartOptions& options) {
  std::vector<std::string> names{stored_study_name(store, options.study)};
  for (const std::string& more : options.more_studies)
    if (const std::string name = stored_study_name(store, more); !contains(names, name)) names.push_back(name);
  return names;
}

/// Several studies as one, whose first axis is the study.
StudyOutline outline_of(ResultStore& store, const std::vector<std::string>& names) {
  StudyOutline all = stored_outline(store, names.front());
  if (names.size() == 1) return all;
  all.name = joined(names);
  all.axes.insert(all.axes.begin(), std::string(study_key));
  for (std::size_t i = 1; i < names.size(); ++i) {
    const StudyOutline one = stored_outline(store, names[i]);
    for (const std::string& axis : one.axes)
      if (!contains(all.axes, axis)) all.axes.push_back(axis);
    all.points += one.points;
  }
  return all;
}

/// What the first study's file says but for its comment, and which axes of any are logarithmic, go together or are
/// sampled.
StudyDefinition definition_of(ResultStore& store, const std::vector<std::string>& names) {
  StudyDefinition all = definition_of(store, names.front());
  for (std::size_t i = 1; i < names.size(); ++i) {
    const StudyDefinition one = definition_of(store, names[i]);
    all.comment.clear();  // the title names the studies
    all.logarithmic.insert(one.logarithmic.begin(), one.logarithmic.end());
    all.together.insert(all.together.end(), one.together.begin(), one.together.end());
    all.sampled.insert(one.sampled.begin(), one.sampled.end());
  }
  return all;
}

StudyRows rows_of(ResultStore& store, const std::vector<std::string>& names, const std::vector<Filter>& filters) {
  if (names.size() == 1) return {store, names.front(), filters};
  std::vector<StudyRows> studies;
  for (const std::string& name : names) studies.emplace_back(store, name, filters);
  return StudyRows(studies);
}

}  // namespace

std::vector<std::string> stored_charts(ResultStore& store, const std::string& study) {
  return definition_of(store, stored_study_name(store, study)).chart_names();
}

StudyChart chart_of_file(ResultStore& store, const std::string& wanted, const std::string& chart) {
  const std::string study = stored_study_name(store, wanted);
  return definition_of(store, study).chart(chart, store.database().name() + ": " + study);
}

ShownStudy::ShownStudy(ResultStore& store, const StudyChartOptions& options)
    : ShownStudy(store, names_of(store, options), options.filters) {}

ShownStudy::ShownStudy(ResultStore& store, const std::vector<std::string>& names, const std::vector<Filter>& filters)
    : file(store.database().name()),
      study(outline_of(store, names)),
      definition(definition_of(store, names)),
      rows(rows_of(store, names, filters)) {}

ShownStudy::ShownStudy(const ShownStudy& shown, ResultStore& store, const std::vector<Filter>& filters)
    : file(shown.file),
      study(shown.study),
      definition(shown.definition),
      rows(shown.rows, store, study.name, filters) {}

std::size_t ShownStudy::unanswered() const {
  std::size_t count = 0;
  for (std::size_t row = 0; row < rows.size(); ++row) count += rows.converged(row) ? 0 : 1;
  return count;
}

std::string ShownStudy::title() const { return title_of_study(definition, study.name); }

std::string filters_in_words(const std::vector<Filter>& filters, const StudyRows& rows) {
  constexpr std::array<std::string_view, 7> signs{"=", "≠", "<", "≤", ">", "≥", "contains"};
  return joined(filters, ", ", [&](const Filter& filter) {
    const QuantityColumn* const column = find_quantity_column(filter.column);
    const auto number = column && column->type == "REAL" ? plain_number(filter.value) : std::nullopt;
    return in_words(column ? column->quantity.key : std::string_view(filter.column)) + " " +
           std::string(signs.at(static_cast<std::size_t>(filter.comparison))) + " " +
           (number ? value_in_words(column->quantity, *number, unit_in(rows, *column)) : in_words(filter.value));
  });
}

std::string fixed_in_words(const std::vector<Filter>& filters, const StudyRows& rows) {
  constexpr std::array<std::string_view, 8> shown{"radius",   "layer_thickness",      "speed",          "load",
                                                  "approach", "friction_coefficient", "rotation_ratio", "temperature"};
  std::string text;
  const auto add = [&](const std::string& name, const QuantityColumn& column) {
    if (const auto value = rows.common(column))
      text +=
          (text.empty() ? "" : ", ") + name + " = " + value_in_words(column.quantity, *value, unit_in(rows, column));
  };
  const auto filtered = [&](std::string_view key) {
    return any_of(filters, [&](const Filter& filter) {
      const QuantityColumn* const of = find_quantity_column(filter.column);
      return filter.column == key || (of && of->quantity.key == key);
    });
  };
  for (const std::string_view key : shown) {
    const QuantityColumn* const column = find_quantity_column(key);
    if (column && !filtered(key)) add(std::string(column->quantity.symbol), *column);
    if (key != "layer_thickness") continue;
    for (const QuantityColumn* const further : rows.columns())
      if (const auto layer = layer_key(further->quantity.key);
          layer && layer->input == key && !filtered(further->quantity.key))
        add("H of " + layer->layer_in_words(), *further);
  }
  return text;
}

std::string subtitle_of(const std::vector<Filter>& filters, const StudyRows& rows) {
  const std::string asked = filters_in_words(filters, rows), fixed = fixed_in_words(filters, rows);
  return asked + (asked.empty() || fixed.empty() ? "" : ", ") + fixed;
}

std::string ShownStudy::comment() const {
  return "study " + study.name + " in " + file + ": " + std::to_string(rows.size()) + " points, " +
         std::to_string(unanswered()) + " without an answer" + common_inputs(rows);
}

}  // namespace rollres
