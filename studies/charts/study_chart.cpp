#include "studies/charts/study_chart.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "studies/charts/resistance_error.hpp"
#include "studies/scatter/scatter_statistics.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// Which columns are drawn as what.
struct Choice {
  const QuantityColumn* x = nullptr;
  const QuantityColumn* y = nullptr;
  const QuantityColumn* along = nullptr;        // joins the points of a curve: x, or an axis if x is none
  std::vector<const QuantityColumn*> families;  // their values tell the curves apart
  bool scatter = false;                         // several points at each place: their median, and a band
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

/// The columns that the options ask for, or the chart of the file; x and `along` are null where neither does.
Choice wished(const ShownStudy& shown, const StudyChart& hints, const StudyChartOptions& options) {
  const StudyOutline& study = shown.study;
  const StudyRows& rows = shown.rows;
  const auto first_of = [](const std::string& wish, const std::string& hint) { return wish.empty() ? hint : wish; };
  Choice choice;
  if (options.shares && !options.y.empty())
    throw std::invalid_argument("y = " + options.y + ": with shares it is the rolling resistance");
  const std::string y = options.shares ? "" : first_of(options.y, hints.y);
  choice.y = &number_column(first_of(y, "rolling_resistance"), study, rows, "y");
  if (const std::string x = first_of(options.x, hints.x); !x.empty()) choice.x = &number_column(x, study, rows, "x");
  const std::string family = first_of(options.family, hints.family);
  if (family.empty()) return choice;
  const QuantityColumn& column = column_of(family, study, rows, "family");
  if (&column != choice.x)
    choice.families.push_back(&column);
  else if (!options.family.empty())
    throw std::invalid_argument("family = " + options.family + ": must differ from x");
  return choice;
}

/// Curves over a number that never changes are a column of points.
void refuse_constant(const ShownStudy& shown, const QuantityColumn& x) {
  const auto& [file, study, definition, rows] = shown;
  if (rows.size() == 1 || rows.values(x).size() > 1) return;
  std::string varied;
  for (const std::string& key : study.axes)
    if (const QuantityColumn& axis = column_of(key, study, rows, "axis");
        axis.type != "TEXT" && rows.values(axis).size() > 1)
      varied += (varied.empty() ? "" : ", ") + key;
  throw std::invalid_argument(
      "x = " + key_of(x) + ": is " + value_in_words(x.quantity, rows.cell(0, x), unit_in(rows, x)) + " in all " +
      std::to_string(rows.size()) + " points shown" + (varied.empty() ? "" : "; these vary: " + varied));
}

bool scatters(const StudyDefinition& definition, const QuantityColumn& column) {
  return definition.uncertain.contains(key_of(column));
}

Choice choose(const ShownStudy& shown, const StudyChart& hints, const StudyChartOptions& options) {
  const auto& [file, study, definition, rows] = shown;
  Choice choice = wished(shown, hints, options);
  const auto taken = [&](const QuantityColumn* column) { return contains(choice.families, column); };
  const QuantityColumn* longest = nullptr;
  std::size_t most = 0;
  std::vector<const QuantityColumn*> axes;
  for (const std::string& key : study.axes) {
    axes.push_back(&column_of(key, study, rows, "axis"));
    if (axes.back() == choice.x) choice.along = choice.x;
    if (axes.back()->type == "TEXT" || taken(axes.back())) continue;
    if (scatters(definition, *axes.back()) && longest && !scatters(definition, *longest)) continue;
    if (!scatters(definition, *axes.back()) && longest && scatters(definition, *longest)) most = 0;
    if (const std::size_t count = rows.values(*axes.back()).size(); count > most) {
      most = count;
      longest = axes.back();
    }
  }
  if (choice.x && !choice.along && !definition.uncertain.empty())  // numbers that scatter against each other
    choice.along = &column_of(*definition.uncertain.begin(), study, rows, "axis");
  if (!choice.along) choice.along = longest;
  if (!choice.x) choice.x = longest;
  if (!choice.x) throw std::invalid_argument(study.name + ": no axis is a number; choose one with --x");
  if (!choice.along) choice.along = choice.x;
  refuse_constant(shown, *choice.x);
  choice.scatter = !definition.uncertain.empty() && !scatters(definition, *choice.along);
  if (choice.scatter && options.shares)
    throw std::invalid_argument(study.name + ": shares cannot be drawn where inputs scatter");
  for (const QuantityColumn* axis : axes) {
    if (axis == choice.along || taken(axis) || rows.values(*axis).size() <= 1) continue;
    std::vector<const QuantityColumn*> mates;  // drawn already, and varying together with this axis
    for (const QuantityColumn* drawn : axes)
      if ((drawn == choice.along || taken(drawn)) && definition.are_together(key_of(*drawn), key_of(*axis)))
        mates.push_back(drawn);
    if (choice.scatter && scatters(definition, *axis)) continue;  // in the band
    const bool scattered =  // drawn as points without lines: nothing need tell them apart
        (definition.sampled.contains(key_of(*choice.along)) && definition.sampled.contains(key_of(*axis))) ||
        (scatters(definition, *choice.along) && scatters(definition, *axis));
    if (!scattered && (mates.empty() || !follows(rows, *axis, mates))) choice.families.push_back(axis);
  }
  return choice;
}

struct ChartScales {
  ColumnScale x, y;
};

ChartScales scales_of(const ShownStudy& shown, const Choice& choice, const StudyChartOptions& options) {
  if (options.shares && options.y_scale == AxisScale::logarithmic)
    throw std::invalid_argument("y-scale = logarithmic: shares that are stacked need a linear one");
  const bool spaced = shown.definition.logarithmic.contains(key_of(*choice.x));
  return {scale_of(shown.rows, *choice.x, options.x_scale, spaced, "x-scale"),
          scale_of(shown.rows, *choice.y, options.shares ? AxisScale::linear : options.y_scale, false, "y-scale")};
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

/// Values at one place of a curve whose inputs scatter, as their median and a band from P10 to P90.
struct ScatteredValues {
  double x = 0;
  std::vector<double> values = {};
  bool all_converged = true;

  ChartPoint point() {
    ChartPoint drawn{x, std::numeric_limits<double>::quiet_NaN(), all_converged};
    if (values.empty()) return drawn;
    std::sort(values.begin(), values.end());
    drawn.y = quantile_of_sorted(values, 0.5);
    drawn.low = quantile_of_sorted(values, 0.1);
    drawn.high = quantile_of_sorted(values, 0.9);
    return drawn;
  }
};

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

/// The points of the curves: by the values of the families, then by that of the column along them.
using Curves = std::map<std::vector<Cell>, std::map<Cell, ChartPoint>, StudyOrder>;

/// The same where several points at each place become their median and a band.
Curves scattered_curves(const StudyRows& rows, const Choice& choice, const ChartScales& scales) {
  std::map<std::vector<Cell>, std::map<Cell, ScatteredValues>> found;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::vector<Cell> values;
    for (const QuantityColumn* const family : choice.families) values.push_back(rows.cell(row, *family));
    ScatteredValues& here = found[values][rows.cell(row, *choice.along)];
    const double value = scales.y.unit.number(rows.number(row, *choice.y));
    here.x = scales.x.unit.number(rows.number(row, *choice.x));
    if (rows.converged(row) && std::isfinite(value))
      here.values.push_back(value);
    else
      here.all_converged = false;
  }
  Curves curves(StudyOrder(rows, choice.families));
  for (auto& [values, places] : found)
    for (auto& [place, scattered] : places) curves[values][place] = scattered.point();
  return curves;
}

Curves curves_of(const ShownStudy& shown, const Choice& choice, const ChartScales& scales, bool shares) {
  const StudyRows& rows = shown.rows;
  Curves curves(StudyOrder(rows, choice.families));
  if (choice.scatter) curves = scattered_curves(rows, choice, scales);
  const ResistanceError error(*choice.y);
  for (std::size_t row = 0; row < rows.size() && !choice.scatter; ++row) {
    std::vector<Cell> values;
    for (const QuantityColumn* const family : choice.families) values.push_back(rows.cell(row, *family));
    ChartPoint& point = curves[values][rows.cell(row, *choice.along)];
    point = {scales.x.unit.number(rows.number(row, *choice.x)), scales.y.unit.number(rows.number(row, *choice.y)),
             rows.converged(row) && !rows.breaks_constraint(row)};
    if (shares)
      add_shares(point, rows, row, scales.y.unit.factor);
    else if (error.known() && point.converged)
      add_band(point, error(rows, row));
  }
  if (curves.size() > most_curves)
    throw TooManyCurves(shown.study.name + ": would need " + std::to_string(curves.size()) + " curves; show at most " +
                        std::to_string(most_curves) + " by fixing an axis with --where, as in --where " +
                        choice.families.back()->name + "=VALUE");
  return curves;
}

/// The unit that suits all values of a family: "0.7937 m/s" beside "1.2599 m/s". Nothing where none does.
std::optional<ScaledUnit> common_unit(const QuantityColumn& family, const StudyRows& rows) {
  const std::string_view unit = unit_in(rows, family);
  if (family.type != "REAL" || unit == "K") return {};
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (const Cell& value : rows.values(family)) {
    const double size = std::abs(number_in(value).value_or(0));
    if (size == 0 || !std::isfinite(size)) continue;
    smallest = std::min(smallest, size);
    largest = std::max(largest, size);
  }
  constexpr double least = 0.1;  // that is read easily
  const ScaledUnit scaled = scaled_unit(unit, largest);
  return largest > 0 && scaled.number(smallest) >= least ? std::optional(scaled) : std::nullopt;
}

/// @param unit  common_unit
std::string family_value(const QuantityColumn& family, const Cell& value, const std::optional<ScaledUnit>& unit,
                         const StudyRows& rows) {
  const std::optional<double> number = number_in(value);
  if (!unit || !number || !std::isfinite(*number)) return value_in_words(family.quantity, value, unit_in(rows, family));
  return short_number(unit->number(*number), shown_digits) + (unit->name.empty() ? "" : " " + unit->name);
}

/// The values of its families: "20 kN/m"; where there are several, "P = 20 kN/m, V = 1 m/s".
/// @param units  of the families
std::string label_of(const std::vector<Cell>& values, const Choice& choice,
                     const std::vector<std::optional<ScaledUnit>>& units, const StudyRows& rows) {
  std::string label;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const QuantityColumn& family = *choice.families[i];
    const std::string_view symbol = family.quantity.symbol;
    label += i == 0 ? "" : ", ";
    if (values.size() > 1 && family.type != "TEXT")
      label += (symbol.empty() ? in_words(family.name) : std::string(symbol)) + " = ";
    label += family_value(family, values[i], units[i], rows);
  }
  return label;
}

/// The curves, each with a point at every place of the column along them; where it has none the line is broken.
std::vector<ChartCurve> labelled(const Curves& curves, const Choice& choice, const StudyRows& rows) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  // Each study has places of its own.
  const auto study = std::find(choice.families.begin(), choice.families.end(), find_quantity_column(study_key));
  const auto family = static_cast<std::size_t>(study - choice.families.begin());
  const auto study_of = [&](const auto& cells) { return family < cells.size() ? cells[family] : Cell(); };
  std::map<Cell, std::set<Cell>> places;
  for (std::size_t row = 0; row < rows.size(); ++row)
    places[study == choice.families.end() ? Cell() : rows.cell(row, **study)].insert(rows.cell(row, *choice.along));
  std::vector<std::optional<ScaledUnit>> units;
  for (const QuantityColumn* const one : choice.families) units.push_back(common_unit(*one, rows));
  std::vector<ChartCurve> all;
  for (const auto& [values, points] : curves) {
    ChartCurve& curve = all.emplace_back(ChartCurve{label_of(values, choice, units, rows), {}});
    for (const Cell& place : places.at(study_of(values))) {
      const auto found = points.find(place);
      curve.points.push_back(found != points.end() ? found->second : ChartPoint{none, none, true});
    }
  }
  return all;
}

/// A family with its symbol, and with a unit where its numbers have one.
ChartAxis family_axis(const QuantityColumn& column, const StudyRows& rows) {
  ChartAxis axis = described(column);
  axis.symbol = column.quantity.symbol;  // stands alone in the legend
  if (const std::string_view unit = unit_in(rows, column); unit != "1") axis.unit = unit;
  return axis;
}

/// Tells two families apart, one by colour and one by dash and mark, where these have looks enough for their values.
void tell_families_apart(ChartRequest& request, const Curves& curves, const Choice& choice, const StudyRows& rows) {
  constexpr std::size_t most_colours = 7, most_dashes = 5;
  if (choice.families.size() != 2) return;
  const std::set<Cell, StudyOrder> none(StudyOrder(rows, choice.families));
  std::array values{none, none};
  for (const auto& [place, points] : curves)
    for (const std::size_t family : {0, 1}) values[family].insert(place[family]);
  const bool texts = choice.families[1]->type == "TEXT" && choice.families[0]->type != "TEXT";
  std::size_t first = texts || values[0].size() < values[1].size() ? 1 : 0;
  if (choice.families[0]->type == "TEXT" && choice.families[1]->type != "TEXT") first = 0;
  if (values[first].size() > most_colours || values[1 - first].size() > most_dashes) first = 1 - first;
  if (values[first].size() > most_colours || values[1 - first].size() > most_dashes) return;
  for (const std::size_t family : {first, 1 - first}) {
    const QuantityColumn& column = *choice.families[family];
    ChartFamily& shown = request.families.emplace_back();
    if (column.type != "TEXT") shown.axis = family_axis(column, rows);
    const std::optional<ScaledUnit> unit = common_unit(column, rows);
    for (const Cell& value : values[family]) shown.labels.push_back(family_value(column, value, unit, rows));
  }
  std::size_t number = 0;
  for (const auto& [place, points] : curves) {
    const auto rank = [&, &at = place](std::size_t family) {
      return static_cast<std::size_t>(std::distance(values[family].begin(), values[family].find(at[family])));
    };
    request.curves[number++].place = {rank(first), rank(1 - first)};
  }
}

}  // namespace

StoredChart stored_chart(ResultStore& store, const StudyChartOptions& options) {
  return stored_chart(ShownStudy(store, options), options);
}

StoredChart stored_chart(const ShownStudy& shown, const StudyChartOptions& options) {
  const auto& [file, study, definition, rows] = shown;
  const StudyChart& hints = definition.chart(options.chart, file + ": " + study.name);
  const Choice choice = choose(shown, hints.map.empty() ? hints : StudyChart(), options);
  const ChartScales scales = scales_of(shown, choice, options);
  const Curves curves = curves_of(shown, choice, scales, options.shares);

  StoredChart chart{.study = study.name, .points = rows.size(), .unanswered = shown.unanswered()};
  if (options.filters.empty()) chart.missing = study.points - static_cast<std::int64_t>(rows.size());
  chart.x = key_of(*choice.x);
  for (const QuantityColumn* const family : choice.families) chart.families.push_back(key_of(*family));
  ChartRequest& request = chart.request;
  request.title = shown.title();
  request.subtitle = subtitle_of(options.filters, rows);
  request.comment = shown.comment();
  request.x = scaled_axis(*choice.x, scales.x);
  request.y = scaled_axis(*choice.y, scales.y);
  request.lines = !scatters(definition, *choice.along) &&
                  (definition.sampled.size() < 2 || !definition.sampled.contains(key_of(*choice.along)));
  if (!request.lines) request.x.margin = 0.03;  // no mark is cut by the frame
  if (choice.families.size() == 1) {
    request.family = family_axis(*choice.families.front(), rows);
    request.ordered = choice.families.front()->type != "TEXT";
  }
  request.curves = labelled(curves, choice, rows);
  tell_families_apart(request, curves, choice, rows);
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (rows.breaks_constraint(row)) request.hollow = "breaks a constraint";
  if (options.shares)
    stack_shares(request, study.name);
  else if (choice.scatter)
    request.areas = "P10 to P90, line: median";
  else if (ResistanceError(*choice.y).known())
    request.areas = "estimated error";
  return chart;
}

}  // namespace rollres
