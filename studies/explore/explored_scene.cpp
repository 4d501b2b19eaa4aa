#include "studies/explore/explored_scene.hpp"

#include <cmath>

#include "core/material/material.hpp"
#include "core/model/scene_rules.hpp"
#include "core/newton/surface_window.hpp"
#include "core/numerics/parallel.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/scene/layer_name.hpp"
#include "studies/figures/figure.hpp"
#include "studies/figures/material_chart.hpp"
#include "studies/figures/scene_sketch.hpp"
#include "studies/run/evaluate.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/model_text.hpp"
#include "studies/scene_io/scene_entries.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/study/study_axes.hpp"
#include "studies/text/table_json.hpp"

namespace rollres {

namespace {

/// Where the walk of the inputs comes to another subject.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> groups{{{"indenter", "Body"},
                                                                               {"layer_thickness", "Layer"},
                                                                               {"material", "Material"},
                                                                               {"lower_layers", "Further layers"},
                                                                               {"speed", "Motion and load"},
                                                                               {"spacing", "Numbers"},
                                                                               {"heat", "Heat"},
                                                                               {"time_limit", "Limits"}}};

Json quantity_json(const Quantity& quantity) {
  return json_object("key", quantity.key, "symbol", quantity.symbol, "unit", quantity.unit, "unit_2d",
                     quantity.unit_for(Indenter::cylinder), "meaning", quantity.meaning);
}

Json json_of_input(const InputKind& kind) {
  const Quantity& quantity = kind.quantity;
  Json object = quantity_json(quantity);
  object.update(json_object("rule", quantity.range.rule(), "lowest", quantity.range.lowest, "highest",
                            quantity.range.highest, "real", kind.real(), "list", kind.list, "layers", kind.layers));
  if (kind.real()) object["replaces"] = replaced_inputs(quantity.key, 0.0);
  if (!kind.held_as.empty()) object["held_as"] = kind.held_as;
  if (!kind.choices.empty()) object["choices"] = kind.choices;
  if (!kind.optional && !kind.list && !kind.needed_by_all()) {
    if (const auto* const number = std::get_if<double>(&kind.default_value))
      object["default"] = finite_or_null(*number);
    if (const auto* const name = std::get_if<std::string>(&kind.default_value)) object["default"] = *name;
  }
  return object;
}

struct NumbersOfAnswers {
  Json list = Json::array();
  void operator()(const Quantity& quantity, const double&) { list.push_back(quantity_json(quantity)); }
  template <class Other>
  void operator()(const Quantity&, const Other&) {}
};

/// The nodes of a solution's middle row, few enough to be drawn.
Json surface_for_pages(const RollingScene& scene, const RollingSolution& solution) {
  const SurfaceFields fields = surface_around(ContactModel(scene).with_answer(solution), solution, figure_margin);
  const SurfaceGrid& grid = fields.grid;
  constexpr int most = 800;
  const int row = dimension_of(scene.indenter) == 2 ? 0 : std::clamp(-grid.first_row, 0, grid.rows - 1);
  const int step = 1 + (grid.columns - 1) / most;
  Json x = Json::array(), w = x, pressure = x, shear = x, zone = x;
  for (int column = 0; column < grid.columns; column += step) {
    const auto node = static_cast<std::size_t>(grid.index(column, row));
    x.push_back(grid.x(column));
    w.push_back(finite_or_null(fields.w[node]));
    pressure.push_back(finite_or_null(fields.pressure[node]));
    shear.push_back(finite_or_null(fields.shear_x[node]));
    zone.push_back(name_of(fields.zone[node]));
  }
  return {{"x", x}, {"w", w}, {"pressure", pressure}, {"shear", shear}, {"zone", zone}};
}

/// The file's folder seen from another, if it lies in that or below.
std::optional<std::filesystem::path> below(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code none;
  const std::filesystem::path seen = std::filesystem::relative(file, folder, none);
  if (none || seen.empty() || *seen.begin() == "..") return {};
  return seen;
}

}  // namespace

Json quantities_for_pages() {
  Json inputs = Json::array(), layer = Json::array();
  std::string_view group;
  for (const InputKind& kind : written_kinds()) {
    for (const auto& [first, name] : groups)
      if (kind.quantity.key == first) group = name;
    inputs.push_back(json_of_input(kind));
    inputs.back()["group"] = group;
  }
  for (const InputKind& kind : layer_kinds()) layer.push_back(json_of_input(kind));
  NumbersOfAnswers outputs;
  const RollingSolution none;
  visit_outputs(none, outputs);
  Json figures = Json::array();
  for (const Figure& figure : all_figures()) figures.push_back(figure.name);
  return {
      {"inputs", inputs}, {"layer", layer}, {"outputs", outputs.list}, {"tables", table_keys}, {"figures", figures}};
}

Json scene_for_pages(const std::string& file, const std::filesystem::path& folder) {
  const RollingScene scene = read_scene(file);
  Json object = read_object(file);
  const std::filesystem::path own = std::filesystem::path(file).parent_path();
  for (const TablePart& part : parts_with_tables(object))
    for (const std::string_view key : table_keys)
      if (const auto named = part.object->find(std::string(key)); named != part.object->end() && named->is_string()) {
        const auto seen = below(folder, own / named->get<std::string>());
        if (!seen) return parse_object(scene_json(scene), file);
        *named = seen->string();
      }
  object.erase("$schema");
  return object;
}

std::optional<RollingScene> coarse_scene(const RollingScene& scene) {
  if (dimension_of(scene.indenter) == 2 || resolved_method(scene) == Method::active_set) return {};
  constexpr double loose = 0.1;
  if (!scene.spacing && scene.tolerance.value_or(1) >= loose) return {};
  RollingScene coarse = scene;
  coarse.spacing.reset();
  coarse.tolerance = loose;
  return coarse;
}

Json answer_for_pages(const RollingScene& scene, const RollingSolution& solution) {
  Json reply = json_object("answer", parse_object(solution_json(scene, solution), "answer"), "coating_yields",
                           coating_yields(scene), "decisions", model_text(scene));
  if (solution.status == Status::converged && solution.fields.grid.size() > 0)
    reply["surface"] = surface_for_pages(scene, solution);
  return reply;
}

ExploredCurve explored_curve(const Json& wish, const std::string& place) {
  refuse_unknown_keys(wish, std::array<std::string_view, 6>{"x", "y", "from", "to", "points", "logarithmic"}, place);
  ExploredCurve curve;
  curve.x = needed_text(wish, "x", place, "must be a number of a scene");
  curve.y = needed_text(wish, "y", place, "must be a number of an answer");
  const InputKind* const kind = find_number(curve.x);
  if (!kind || !kind->real()) refuse(place, "x", curve.x, "must be a number of a scene");
  if (const auto output = output_quantity(curve.y); !output || output->unit.empty())
    refuse(place, "y", curve.y, "must be a number of an answer");
  const auto number = [&](const char* key) {
    const Json& value = needed(wish, key, place, "must be a number");
    if (!value.is_number() || !kind->quantity.range.contains(value.get<double>()))
      refuse(place, key, value, kind->quantity.rule());
    return value.get<double>();
  };
  curve.from = number("from");
  curve.to = number("to");
  if (!(curve.to > curve.from)) refuse(place, "to", curve.to, "must be above from");
  constexpr int most = 400;
  curve.points = static_cast<std::size_t>(whole_number_or(wish, "points", 60, 2, most, place));
  const auto logarithmic = wish.find("logarithmic");
  curve.logarithmic = logarithmic != wish.end() && logarithmic->is_boolean() && logarithmic->get<bool>();
  if (curve.logarithmic && !(curve.from > 0)) refuse(place, "from", curve.from, "must be > 0 on a logarithmic scale");
  return curve;
}

Json curve_for_pages(const RollingScene& scene, const ExploredCurve& curve, StoredEvaluations& evaluations,
                     const std::function<bool()>& stop) {
  std::vector<double> x(curve.points), y(curve.points), error(curve.points);
  std::vector<std::string> reason(curve.points);
  for (std::size_t i = 0; i < curve.points; ++i)
    x[i] = spaced_value(curve.from, curve.to, static_cast<double>(i) / static_cast<double>(curve.points - 1),
                        curve.logarithmic);
  for_each_piece(curve.points, 0, [&](std::size_t point) {
    const Interruptible until(stop);
    RollingScene here = scene;
    set_input(here, curve.x, x[point]);
    const RollingSolution solution = evaluations(here);
    const bool answered = solution.status == Status::converged;
    y[point] = answered ? output_number(solution, curve.y) : RollingSolution::absent;
    error[point] =
        answered && curve.y == "rolling_resistance" ? solution.rolling_resistance_error : RollingSolution::absent;
    if (!answered) reason[point] = solution.reason;
  });
  Json reply{{"x", x}, {"y", Json::array()}, {"y_error", Json::array()}, {"reason", Json::array()}};
  for (std::size_t i = 0; i < curve.points; ++i) {
    reply["y"].push_back(finite_or_null(y[i]));
    reply["y_error"].push_back(finite_or_null(error[i]));
    reply["reason"].push_back(reason[i]);
  }
  return reply;
}

Json chart_for_pages(const ChartRequest& chart) {
  const auto axis = [](const ChartAxis& one) {
    return Json{{"name", one.name}, {"symbol", one.symbol}, {"unit", one.unit}, {"logarithmic", one.logarithmic}};
  };
  Json curves = Json::array();
  for (const ChartCurve& curve : chart.curves) {
    Json points = Json::array();
    for (const ChartPoint& point : curve.points)
      points.push_back({finite_or_null(point.x), finite_or_null(point.y), point.converged, finite_or_null(point.low),
                        finite_or_null(point.high)});
    curves.push_back(json_object("label", curve.label, "points", points, "dashed", curve.extrapolated, "line",
                                 curve.line && chart.lines));
    if (curve.like) curves.back()["like"] = *curve.like;
  }
  return {{"title", chart.title},         {"subtitle", chart.subtitle}, {"x", axis(chart.x)}, {"y", axis(chart.y)},
          {"family", axis(chart.family)}, {"ordered", chart.ordered},   {"curves", curves}};
}

Json materials_for_pages(const RollingScene& scene) {
  Json charts = Json::array();
  const auto add = [&](const MaterialInputs& layer, const std::string& name) {
    charts.push_back(chart_for_pages(moduli_chart(layer, name)));
  };
  add(scene, layer_name(false, 0));
  for (std::size_t i = 0; i < scene.lower_layers.size(); ++i) add(scene.lower_layers[i], layer_name(false, i + 1));
  for (std::size_t i = 0; i < scene.coating_layers.size(); ++i) add(scene.coating_layers[i], layer_name(true, i));
  const auto contact = contact_frequencies(scene);
  return {{"charts", charts}, {"frequency", contact ? Json(contact->typical) : Json()}};
}

}  // namespace rollres
