#include "studies/study_chart.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "db/schema.hpp"
#include "studies/readable_number.hpp"
#include "studies/scaled_unit.hpp"
#include "studies/stored_study.hpp"
#include "studies/strict_json.hpp"
#include "studies/study_definition.hpp"

namespace rollres {

namespace {

StudyDefinition definition_of(ResultStore& store, const std::string& study) {
  return definition_in(store.definition(study).value_or(""), store.database().name() + ": " + study);
}

/// A column of the stored rows; an axis is shown as it was given, not as it was found.
const QuantityColumn& column_of(const std::string& key, const StudySummary& study, const std::string& option) {
  const bool axis = std::find(study.axes.begin(), study.axes.end(), key) != study.axes.end();
  if (const QuantityColumn* const column = find_quantity_column(axis ? input_column(key) : key)) return *column;
  std::vector<std::string_view> names;
  for (const QuantityColumn& column : quantity_columns()) names.push_back(column.name);
  throw std::invalid_argument(option + " = " + key + ": " + unknown("unknown key", names, key));
}

const QuantityColumn& number_column(const std::string& key, const StudySummary& study, const std::string& option) {
  const QuantityColumn& column = column_of(key, study, option);
  if (column.type == "TEXT") throw std::invalid_argument(option + " = " + key + ": must be a number");
  return column;
}

/// The rows of a study, read by column.
class Rows {
 public:
  Rows(ResultStore& store, const std::string& study, const std::vector<Filter>& filters) {
    Query query{.filters = filters, .sort = {"position"}};
    query.filters.push_back({"study", Comparison::equal, study});
    for (const QuantityColumn& column : quantity_columns()) query.columns.push_back(column.name);
    table_ = run_query(store.database(), query);
    for (std::size_t i = 0; i < table_.columns.size(); ++i) places_[table_.columns[i]] = i;
    if (table_.rows.empty())
      throw std::invalid_argument(store.database().name() + ": " + study + ": " +
                                  (filters.empty() ? "no point is computed yet" : "no point matches"));
  }

  std::size_t size() const { return table_.rows.size(); }
  const Cell& cell(std::size_t row, const Column& column) const { return table_.rows[row][places_.at(column.name)]; }
  double number(std::size_t row, const Column& column) const {
    const Cell& value = cell(row, column);
    if (const auto* const count = std::get_if<std::int64_t>(&value)) return static_cast<double>(*count);
    if (const auto* const number = std::get_if<double>(&value)) return *number;
    return std::numeric_limits<double>::quiet_NaN();
  }
  bool converged(std::size_t row) const {
    return cell(row, *find_quantity_column("status")) == Cell(std::string(name_of(Status::converged)));
  }
  std::set<Cell> values(const Column& column) const {
    std::set<Cell> values;
    for (std::size_t row = 0; row < size(); ++row) values.insert(cell(row, column));
    return values;
  }

 private:
  Table table_;
  std::map<std::string, std::size_t> places_;
};

std::string_view unit_in(const Rows& rows, const QuantityColumn& column) {
  const auto indenters = rows.values(*find_quantity_column("indenter"));
  if (indenters.size() > 1 && !column.quantity.unit_2d.empty())
    throw std::invalid_argument(column.name + ": has another unit for a cylinder than for a sphere; choose one with " +
                                "indenter=cylinder or indenter=sphere");
  const bool cylinder = *indenters.begin() == Cell(std::string(name_of(Indenter::cylinder)));
  return column.quantity.unit_for(cylinder ? Indenter::cylinder : Indenter::sphere);
}

std::string in_words(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

std::string value_in_words(const Cell& cell, std::string_view unit) {
  if (const auto* const text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* const count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
  if (const auto* const number = std::get_if<double>(&cell)) return readable(*number, unit);
  return "none";
}

ChartAxis described(const QuantityColumn& column) {
  return {.name = in_words(std::string(column.quantity.key)), .symbol = std::string(column.quantity.symbol)};
}

/// Which columns are drawn as what.
struct Choice {
  const QuantityColumn* x = nullptr;
  const QuantityColumn* y = nullptr;
  const QuantityColumn* along = nullptr;        // joins the points of a curve: x, or an axis if x is none
  std::vector<const QuantityColumn*> families;  // their values tell the curves apart
};
/// Whether the columns tell the value of another one in every row.
bool follows(const Rows& rows, const QuantityColumn& column, const std::vector<const QuantityColumn*>& from) {
  std::map<std::vector<Cell>, Cell> values;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::vector<Cell> place;
    for (const QuantityColumn* const other : from) place.push_back(rows.cell(row, *other));
    if (values.emplace(place, rows.cell(row, column)).first->second != rows.cell(row, column)) return false;
  }
  return true;
}

std::string key_of(const QuantityColumn& column) { return std::string(column.quantity.key); }

Choice choose(const StudySummary& study, const Rows& rows, const StudyDefinition& definition, const StudyChart& hints,
              const StudyChartWishes& wishes) {
  const auto first_of = [](const std::string& wish, const std::string& hint) { return wish.empty() ? hint : wish; };
  Choice choice;
  const std::string y = first_of(wishes.y, hints.y);
  choice.y = &number_column(y.empty() ? "rolling_resistance" : y, study, "y");
  if (const std::string x = first_of(wishes.x, hints.x); !x.empty()) choice.x = &number_column(x, study, "x");
  if (!wishes.family.empty()) choice.families.push_back(&column_of(wishes.family, study, "family"));
  if (choice.x && !choice.families.empty() && choice.families.front() == choice.x)
    throw std::invalid_argument("family = " + wishes.family + ": must differ from x");
  if (wishes.family.empty() && !hints.family.empty())
    if (const QuantityColumn& family = column_of(hints.family, study, "family"); &family != choice.x)
      choice.families.push_back(&family);

  const auto taken = [&](const QuantityColumn* column) {
    return std::find(choice.families.begin(), choice.families.end(), column) != choice.families.end();
  };
  const QuantityColumn* longest = nullptr;
  std::size_t most = 0;
  std::vector<const QuantityColumn*> axes;
  for (const std::string& key : study.axes) {
    axes.push_back(&column_of(key, study, "axis"));
    if (axes.back() == choice.x) choice.along = choice.x;
    if (axes.back()->type == "TEXT" || taken(axes.back())) continue;
    if (const std::size_t count = rows.values(*axes.back()).size(); count > most) {
      most = count;
      longest = axes.back();
    }
  }
  if (!choice.along) choice.along = longest;
  if (!choice.x) choice.x = longest;
  if (!choice.x) throw std::invalid_argument(study.name + ": no axis is a number; choose one with --x");
  if (!choice.along) choice.along = choice.x;
  for (const QuantityColumn* axis : axes) {
    if (axis == choice.along || taken(axis) || rows.values(*axis).size() <= 1) continue;
    std::vector<const QuantityColumn*> mates;  // drawn already, and varying together with this axis
    for (const QuantityColumn* drawn : axes)
      if ((drawn == choice.along || taken(drawn)) && definition.are_together(key_of(*drawn), key_of(*axis)))
        mates.push_back(drawn);
    const bool scattered =  // drawn as points without lines: nothing need tell them apart
        definition.sampled.contains(key_of(*choice.along)) && definition.sampled.contains(key_of(*axis));
    if (!scattered && (mates.empty() || !follows(rows, *axis, mates))) choice.families.push_back(axis);
  }
  return choice;
}

/// Unit, and whether logarithmic.
struct Scale {
  ScaledUnit unit;
  bool logarithmic = false;
};
Scale scale_of(const Rows& rows, const QuantityColumn& column, AxisScale wish, bool hint, const std::string& option) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  bool positive = true;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double value = rows.number(row, column);
    if (!std::isfinite(value)) continue;
    positive = positive && value > 0;
    smallest = std::min(smallest, std::abs(value));
    largest = std::max(largest, std::abs(value));
  }
  constexpr double two_decades = 100 * (1 - 1e-9);
  if (wish == AxisScale::logarithmic && !positive)
    throw std::invalid_argument(option + " = logarithmic: " + column.name + " has values that are not positive");
  const bool logarithmic = wish == AxisScale::logarithmic ||
                           (wish == AxisScale::automatic && positive && (hint || largest >= two_decades * smallest));
  const std::string_view unit = unit_in(rows, column);
  return {logarithmic ? scaled_unit_logarithmic(unit, smallest, largest) : scaled_unit(unit, largest), logarithmic};
}

/// What all rows have in common, line by line.
std::string common_inputs(const Rows& rows) {
  std::string lines;
  for (const QuantityColumn& column : quantity_columns()) {
    if (!column.is_input) continue;
    const auto values = rows.values(column);
    if (values.size() != 1 || std::holds_alternative<std::monostate>(*values.begin())) continue;
    lines += "\n" + std::string(column.quantity.key) + " = " + value_in_words(*values.begin(), unit_in(rows, column));
  }
  return lines;
}

}  // namespace

std::vector<std::string> stored_charts(ResultStore& store, const std::string& study) {
  return definition_of(store, stored_study(store, study).name).chart_names();
}

StoredChart stored_chart(ResultStore& store, const StudyChartWishes& wishes) {
  const StudySummary study = stored_study(store, wishes.study);
  const std::string& file = store.database().name();
  const StudyDefinition definition = definition_of(store, study.name);
  const Rows rows(store, study.name, wishes.filters);
  const auto [x, y, along, families] =
      choose(study, rows, definition, definition.chart(wishes.chart, file + ": " + study.name), wishes);
  const Scale x_scale = scale_of(rows, *x, wishes.x_scale, definition.logarithmic.contains(key_of(*x)), "x-scale");
  const Scale y_scale = scale_of(rows, *y, wishes.y_scale, false, "y-scale");

  StoredChart chart;
  chart.study = study.name;
  chart.points = rows.size();
  if (wishes.filters.empty()) chart.missing = study.points - study.answered;
  std::map<std::vector<Cell>, std::map<Cell, ChartPoint>> curves;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::vector<Cell> values;
    for (const QuantityColumn* const family : families) values.push_back(rows.cell(row, *family));
    const bool converged = rows.converged(row);
    if (!converged) ++chart.unanswered;
    curves[values][rows.cell(row, *along)] = {rows.number(row, *x) / x_scale.unit.factor,
                                              rows.number(row, *y) / y_scale.unit.factor, converged};
  }
  if (curves.size() > most_curves)
    throw std::invalid_argument(study.name + ": would need " + std::to_string(curves.size()) +
                                " curves; show at most " + std::to_string(most_curves) +
                                " by fixing an axis with --where, as in --where " + families.back()->name + "=VALUE");

  ChartRequest& request = chart.request;
  request.title = study.name;
  request.comment = "study " + study.name + " in " + file + ": " + std::to_string(chart.points) + " points, " +
                    std::to_string(chart.unanswered) + " without an answer" + common_inputs(rows);
  request.x = described(*x);
  request.y = described(*y);
  request.x.unit = typeset_unit(x_scale.unit.name);
  request.y.unit = typeset_unit(y_scale.unit.name);
  request.x.logarithmic = x_scale.logarithmic;
  request.y.logarithmic = y_scale.logarithmic;
  request.lines = definition.sampled.size() < 2 || !definition.sampled.contains(key_of(*along));
  if (!request.lines) request.x.margin = 0.03;  // no mark is cut by the frame
  if (families.size() == 1) request.family = described(*families.front());

  const std::set<Cell> places = rows.values(*along);
  for (const auto& [values, points] : curves) {
    ChartCurve curve;
    for (std::size_t i = 0; i < families.size(); ++i) {
      const std::string& key = families[i]->name;
      const std::string_view symbol = families[i]->quantity.symbol;
      const bool named = families.size() > 1 && families[i]->type != "TEXT";
      curve.label += i == 0 ? "" : ", ";
      if (named) curve.label += (symbol.empty() ? in_words(key) : std::string(symbol)) + " = ";
      curve.label += value_in_words(values[i], unit_in(rows, *families[i]));
    }
    for (const Cell& place : places) {
      const auto found = points.find(place);
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      curve.points.push_back(found != points.end() ? found->second : ChartPoint{none, none, true});
    }
    request.curves.push_back(curve);
  }
  return chart;
}

}  // namespace rollres
