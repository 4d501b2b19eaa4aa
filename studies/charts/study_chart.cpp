#include "studies/charts/study_chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "db/rows/schema.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/study/study_definition.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

namespace {

StudyDefinition definition_of(ResultStore& store, const std::string& study) {
  return definition_in(store.definition(study).value_or(""), store.database().name() + ": " + study);
}

/// Which columns are drawn as what.
struct Choice {
  const QuantityColumn* x = nullptr;
  const QuantityColumn* y = nullptr;
  const QuantityColumn* along = nullptr;        // joins the points of a curve: x, or an axis if x is none
  std::vector<const QuantityColumn*> families;  // their values tell the curves apart
};
/// Whether the columns tell the value of another one in every row.
bool follows(const StudyRows& rows, const QuantityColumn& column, const std::vector<const QuantityColumn*>& from) {
  std::map<std::vector<Cell>, Cell> values;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::vector<Cell> place;
    for (const QuantityColumn* const other : from) place.push_back(rows.cell(row, *other));
    if (values.emplace(place, rows.cell(row, column)).first->second != rows.cell(row, column)) return false;
  }
  return true;
}

Choice choose(const StudySummary& study, const StudyRows& rows, const StudyDefinition& definition,
              const StudyChart& hints, const StudyChartOptions& options) {
  const auto first_of = [](const std::string& wish, const std::string& hint) { return wish.empty() ? hint : wish; };
  Choice choice;
  if (options.shares && !options.y.empty())
    throw std::invalid_argument("y = " + options.y + ": with shares it is the rolling resistance");
  const std::string y = options.shares ? "" : first_of(options.y, hints.y);
  choice.y = &number_column(y.empty() ? "rolling_resistance" : y, study, "y");
  if (const std::string x = first_of(options.x, hints.x); !x.empty()) choice.x = &number_column(x, study, "x");
  if (!options.family.empty()) choice.families.push_back(&column_of(options.family, study, "family"));
  if (choice.x && !choice.families.empty() && choice.families.front() == choice.x)
    throw std::invalid_argument("family = " + options.family + ": must differ from x");
  if (options.family.empty() && !hints.family.empty())
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

/// Half as wide as the estimated error, which is relative.
void add_band(ChartPoint& point, double error_estimate) {
  const double half_width = error_estimate * std::abs(point.y);
  point.low = point.y - half_width;
  point.high = point.y + half_width;
}

/// From what is lost in the layer to that and what is lost to friction: over the speed, parts of the resistance.
void add_shares(ChartPoint& point, const StudyRows& rows, std::size_t row, double factor) {
  const double force = 1 / (rows.number(row, "speed") * factor);
  point.low = force * rows.number(row, "viscous_loss");
  point.high = point.low + force * rows.number(row, "frictional_loss");
}

/// The one curve of a chart as two, each with the area below it.
void stack_shares(ChartRequest& request, const std::string& place) {
  if (request.curves.size() != 1)
    throw std::invalid_argument(place + ": shares are drawn of one curve, not of " +
                                std::to_string(request.curves.size()) + "; fix the other axes with --where");
  const std::vector<ChartPoint> points = request.curves.front().points;
  request.curves = {{"lost in the layer", points}, {"lost to friction", points}};
  request.family = {};
  request.mark_peaks = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ChartPoint &below = request.curves[0].points[i], &above = request.curves[1].points[i];
    above.y = below.high;
    below.y = below.high = below.low;
    below.low = 0;
  }
}

}  // namespace

std::vector<std::string> stored_charts(ResultStore& store, const std::string& study) {
  return definition_of(store, stored_study(store, study).name).chart_names();
}

StudyChart chart_of_file(ResultStore& store, const std::string& wanted, const std::string& chart) {
  const std::string study = stored_study(store, wanted).name;
  return definition_of(store, study).chart(chart, store.database().name() + ": " + study);
}

StoredChart stored_chart(ResultStore& store, const StudyChartOptions& options) {
  const StudySummary study = stored_study(store, options.study);
  const std::string& file = store.database().name();
  const StudyDefinition definition = definition_of(store, study.name);
  const StudyRows rows(store, study.name, options.filters);
  const StudyChart& hints = definition.chart(options.chart, file + ": " + study.name);
  const auto [x, y, along, families] =
      choose(study, rows, definition, hints.map.empty() ? hints : StudyChart(), options);
  const ColumnScale x_scale =
      scale_of(rows, *x, options.x_scale, definition.logarithmic.contains(key_of(*x)), "x-scale");
  if (options.shares && options.y_scale == AxisScale::logarithmic)
    throw std::invalid_argument("y-scale = logarithmic: shares that are stacked need a linear one");
  const ColumnScale y_scale =
      scale_of(rows, *y, options.shares ? AxisScale::linear : options.y_scale, false, "y-scale");

  StoredChart chart;
  chart.study = study.name;
  chart.points = rows.size();
  if (options.filters.empty()) chart.missing = study.points - study.answered;
  const bool resistance = y->name == "rolling_resistance" || y->name == "rolling_resistance_coefficient";
  std::map<std::vector<Cell>, std::map<Cell, ChartPoint>> curves;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::vector<Cell> values;
    for (const QuantityColumn* const family : families) values.push_back(rows.cell(row, *family));
    const bool converged = rows.converged(row);
    if (!converged) ++chart.unanswered;
    ChartPoint& point = curves[values][rows.cell(row, *along)];
    point = {rows.number(row, *x) / x_scale.unit.factor, rows.number(row, *y) / y_scale.unit.factor, converged};
    if (options.shares)
      add_shares(point, rows, row, y_scale.unit.factor);
    else if (resistance && converged)
      add_band(point, rows.number(row, "error_estimate"));
  }
  if (curves.size() > most_curves)
    throw std::invalid_argument(study.name + ": would need " + std::to_string(curves.size()) +
                                " curves; show at most " + std::to_string(most_curves) +
                                " by fixing an axis with --where, as in --where " + families.back()->name + "=VALUE");

  ChartRequest& request = chart.request;
  request.title = study.name;
  request.comment = "study " + study.name + " in " + file + ": " + std::to_string(chart.points) + " points, " +
                    std::to_string(chart.unanswered) + " without an answer" + common_inputs(rows);
  request.x = scaled_axis(*x, x_scale);
  request.y = scaled_axis(*y, y_scale);
  request.lines = definition.sampled.size() < 2 || !definition.sampled.contains(key_of(*along));
  if (!request.lines) request.x.margin = 0.03;  // no mark is cut by the frame
  if (families.size() == 1) {
    request.family = described(*families.front());
    request.family.symbol = families.front()->quantity.symbol;  // stands alone in the legend
  }

  const std::set<Cell> places = rows.values(*along);
  for (const auto& [values, points] : curves) {
    ChartCurve curve;
    for (std::size_t i = 0; i < families.size(); ++i) {
      const std::string& key = families[i]->name;
      const std::string_view symbol = families[i]->quantity.symbol;
      const bool named = families.size() > 1 && families[i]->type != "TEXT";
      curve.label += i == 0 ? "" : ", ";
      if (named) curve.label += (symbol.empty() ? in_words(key) : std::string(symbol)) + " = ";
      curve.label += value_in_words(families[i]->quantity, values[i], unit_in(rows, *families[i]));
    }
    for (const Cell& place : places) {
      const auto found = points.find(place);
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      curve.points.push_back(found != points.end() ? found->second : ChartPoint{none, none, true});
    }
    request.curves.push_back(curve);
  }
  if (options.shares) stack_shares(request, study.name);
  if (!options.shares && resistance) request.areas = "estimated error";
  return chart;
}

}  // namespace rollres
