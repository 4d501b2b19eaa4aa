#include "studies/charts/study_chart.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "studies/optimise/stored_optimum.hpp"

namespace rollres {

namespace {

/// Axes of the study that are numbers, those with the most values first.
std::vector<const QuantityColumn*> longest_axes(const StudyOutline& study, const StudyRows& rows) {
  std::vector<const QuantityColumn*> axes;
  for (const std::string& key : study.axes)
    if (const QuantityColumn& column = column_of(key, study, rows, "axis"); column.type != "TEXT")
      axes.push_back(&column);
  stable_sort(
      axes, [&](const auto* one, const auto* other) { return rows.values(*one).size() > rows.values(*other).size(); });
  return axes;
}

constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();  // not on the map

struct MapAxes {
  const QuantityColumn *x = nullptr, *y = nullptr;
};

MapAxes choose_axes(const StudyOutline& study, const StudyRows& rows, const StudyChartOptions& options) {
  MapAxes axes;
  if (!options.x.empty()) axes.x = &number_column(options.x, study, rows, "x");
  if (!options.y.empty()) axes.y = &number_column(options.y, study, rows, "y");
  for (const QuantityColumn* axis : longest_axes(study, rows)) {
    if (axis == axes.x || axis == axes.y) continue;
    if (!axes.x)
      axes.x = axis;
    else if (!axes.y)
      axes.y = axis;
  }
  if (!axes.x || !axes.y || axes.x == axes.y)
    throw std::invalid_argument(study.name + ": a map needs two different axes that are numbers");
  return axes;
}

/// Values of a column in rising order.
std::vector<double> places(const StudyRows& rows, const QuantityColumn& column) {
  std::set<double> values;
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (const double value = rows.number(row, column); std::isfinite(value)) values.insert(value);
  return {values.begin(), values.end()};
}

MapNode state_of(const StudyRows& rows, std::size_t row, double value) {
  if (rows.converged(row)) return std::isfinite(value) ? MapNode::answered : MapNode::unanswered;
  if (rows.text(row, "status") == name_of(Status::no_steady_state)) return MapNode::no_steady_state;
  return std::isfinite(value) ? MapNode::not_converged : MapNode::unanswered;
}

/// The numbers of a scene and its solution, as far as formulas use them, from a row.
struct RowOfFormula {
  RollingScene scene;
  RollingSolution solution;

  RowOfFormula(const StudyRows& rows, std::size_t row) {
    const auto fill = [&](const std::string& column, auto& value) {
      using Value = std::decay_t<decltype(value)>;
      if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>)
        if (const double number = rows.number(row, *find_quantity_column(column)); !std::isnan(number)) value = number;
    };
    visit_inputs(scene, [&](const Quantity& quantity, auto& value) { fill(input_column(quantity.key), value); });
    visit_outputs(solution, [&](const Quantity& quantity, auto& value) { fill(std::string(quantity.key), value); });
  }
};

/// The optimisation's constraints, at the points of the map.
void add_limits(MapRequest& request, const DesignProblem& problem, const StudyRows& rows,
                const std::vector<std::size_t>& nodes) {
  if (problem.scenes.size() > 1) return;  // the map shows one of them
  for (const Condition& constraint : problem.constraints) {
    MapLimit limit{formula_in_words(constraint.text()),
                   std::vector<double>(request.field.values.size(), RollingSolution::absent)};
    for (std::size_t row = 0; row < nodes.size(); ++row) {
      if (nodes[row] == nowhere || !rows.converged(row)) continue;
      const RowOfFormula values(rows, row);
      limit.excess[nodes[row]] = constraint.excess(values.scene, values.solution);
    }
    request.limits.push_back(std::move(limit));
  }
}

void add_optimum(MapRequest& request, const StoredOptimum* found, const std::string& name, const MapAxes& axes,
                 const ScaledUnit& x_unit, const ScaledUnit& y_unit) {
  if (!found)
    throw std::invalid_argument("optimum = " + name + ": is no optimisation; its study file has no variables");
  const int x = found->variable(axes.x->quantity.key), y = found->variable(axes.y->quantity.key);
  for (const auto& [place, column] : {std::pair(x, axes.x), std::pair(y, axes.y)})
    if (place < 0) throw std::invalid_argument("optimum = " + name + ": has no variable " + key_of(*column));
  const auto point = [&](const Design& design) {
    return MapPoint{x_unit.number(design.point[static_cast<std::size_t>(x)]),
                    y_unit.number(design.point[static_cast<std::size_t>(y)])};
  };
  for (const Design& design : found->designs) request.designs.push_back(point(design));
  if (!found->best) return;
  request.optimum = point(*found->best);
  request.optimum_meaning = std::string(found->problem.goal.maximise ? "best: greatest " : "best: least ") +
                            formula_in_words(found->problem.goal.formula.text());
}

}  // namespace

StoredMap stored_map(ResultStore& store, const StudyChartOptions& options) {
  if (!options.more_studies.empty())
    throw std::invalid_argument("study = " + options.more_studies.front() + ": a map is of one study");
  return stored_map(store, ShownStudy(store, options), options);
}

StoredMap stored_map(ResultStore& store, const ShownStudy& shown, const StudyChartOptions& options) {
  const auto& [file, study, definition, rows] = shown;
  const MapAxes axes = choose_axes(study, rows, options);
  const QuantityColumn& value =
      number_column(options.map.empty() ? "rolling_resistance" : options.map, study, rows, "map");
  const auto scale = [&](const QuantityColumn& column, AxisScale wish, const char* option) {
    return scale_of(shown.rows, column, wish, shown.definition.logarithmic.contains(key_of(column)), option);
  };
  const ColumnScale x = scale(*axes.x, options.x_scale, "x-scale"), y = scale(*axes.y, options.y_scale, "y-scale"),
                    v = scale_of(rows, value, options.map_scale, false, "map-scale");

  StoredMap map{.study = study.name, .points = rows.size(), .unanswered = shown.unanswered()};
  MapRequest& request = map.request;
  request.title = shown.title();
  request.subtitle = subtitle_of(options.filters, rows);
  request.comment = shown.comment();
  request.x = scaled_axis(*axes.x, x);
  request.y = scaled_axis(*axes.y, y);
  request.value = scaled_axis(value, v);
  PlaneField& field = request.field;
  field.x = places(rows, *axes.x);
  field.y = places(rows, *axes.y);
  const std::size_t size = field.x.size() * field.y.size();
  if (size > 4 * rows.size())
    throw std::invalid_argument(study.name + ": the points do not lie on a grid of " + key_of(*axes.x) + " and " +
                                key_of(*axes.y) + "; the shown " + std::to_string(rows.size()) +
                                " would leave most of it empty");
  field.values.assign(size, std::numeric_limits<double>::quiet_NaN());
  request.nodes.assign(size, MapNode::not_computed);
  std::vector<std::size_t> nodes(rows.size(), nowhere);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double at_x = rows.number(row, *axes.x), at_y = rows.number(row, *axes.y);
    if (!std::isfinite(at_x) || !std::isfinite(at_y)) continue;
    const auto column = std::lower_bound(field.x.begin(), field.x.end(), at_x) - field.x.begin();
    const auto line = std::lower_bound(field.y.begin(), field.y.end(), at_y) - field.y.begin();
    const auto node = static_cast<std::size_t>(line) * field.x.size() + static_cast<std::size_t>(column);
    if (request.nodes[node] != MapNode::not_computed)
      throw std::invalid_argument(
          study.name + ": several points at " + key_of(*axes.x) + " = " +
          value_in_words(axes.x->quantity, Cell(at_x), unit_in(rows, *axes.x)) + ", " + key_of(*axes.y) + " = " +
          value_in_words(axes.y->quantity, Cell(at_y), unit_in(rows, *axes.y)) + "; fix the other axes with --where");
    nodes[row] = node;
    const double number = v.unit.number(rows.number(row, value));
    request.nodes[node] = state_of(rows, row, number);
    if (request.nodes[node] == MapNode::answered) field.values[node] = number;
  }
  for (double& place : field.x) place = x.unit.number(place);
  for (double& place : field.y) place = y.unit.number(place);
  if (!options.optimum.empty()) {
    const auto found = stored_optimum(store, stored_study_name(store, options.optimum));
    add_optimum(request, found ? &*found : nullptr, options.optimum, axes, x.unit, y.unit);
    add_limits(request, found->problem, rows, nodes);
  }
  return map;
}

}  // namespace rollres
