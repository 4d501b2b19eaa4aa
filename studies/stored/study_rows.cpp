#include "studies/stored/study_rows.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "core/scene/scene_input.hpp"
#include "db/merge/readable_source.hpp"
#include "db/rows/fit_store.hpp"
#include "db/rows/layer_list.hpp"
#include "db/rows/point_states.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/stored/derived_columns.hpp"
#include "studies/stored/learned_cost.hpp"
#include "studies/stored/shown_table.hpp"
#include "studies/study/predicted_cost.hpp"
#include "studies/study/shards.hpp"
#include "studies/study/study_definition.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/units.hpp"

namespace rollres {

namespace {

/// The columns that tell a row's body.
struct BodyColumns {
  const QuantityColumn &indenter = *find_quantity_column("indenter"), &width = *find_quantity_column("width");

  Body at(const StudyRows& rows, std::size_t row) const {
    return body_in(rows.cell(row, indenter), rows.cell(row, width)).value_or(Indenter::cylinder);
  }
};

constexpr const char* feasible_key = "feasible";

FormulaDefinitions formulas_of(ResultStore& store, const std::string& study) {
  return definition_in(store.definition(study).value_or(""), store.database().name() + ": " + study).formulas;
}

}  // namespace

std::vector<const QuantityColumn*> quantity_columns_of(const Database& database, const std::vector<Filter>& filters) {
  std::map<std::string_view, std::size_t> layers;
  GroupQuery lists{.filters = filters};
  for (const InputKind& kind : input_kinds())
    if (kind.layers) lists.by.emplace_back(kind.quantity.key);
  for (const auto& group : run_group_query(database, lists).rows)
    for (std::size_t i = 0; i < lists.by.size(); ++i)
      if (const auto* const text = std::get_if<std::string>(&group[i]))
        layers[lists.by[i]] = std::max(layers[lists.by[i]], layers_in(*text).size());
  std::vector<const QuantityColumn*> columns;
  for (const QuantityColumn& column : quantity_columns()) {
    const std::string_view key = column.quantity.key;
    if (!contains(lists.by, key)) columns.push_back(&column);
    for (std::size_t i = 0; i < layers[key]; ++i)
      for (const InputKind& own : layer_kinds())
        columns.push_back(find_quantity_column(layer_quantity(key, i, own.quantity).key));
  }
  return columns;
}

StudyRows::StudyRows(ResultStore& store, const std::string& study, const std::vector<Filter>& filters) {
  const FormulaDefinitions formulas = formulas_of(store, study);
  std::vector<Filter> rows = formulas.empty() ? filters : std::vector<Filter>();  // groups know no formula
  rows.push_back({"study", Comparison::equal, study});
  columns_ = quantity_columns_of(store.database(), rows);
  const bool named = column_names(store.database().connection(), "result").contains(std::string(variant_key));
  if (named) columns_.push_back(find_quantity_column(variant_key));
  const auto of_variants = columns_.size() - 1;
  for (const auto& [name, formula] : formulas) columns_.push_back(&derived_column(name, formula));
  read(store, study, filters, formulas);
  if (named && values(*columns_[of_variants]) == std::vector<Cell>{Cell()})  // no point is of a variant
    columns_.erase(columns_.begin() + static_cast<std::ptrdiff_t>(of_variants));
}

StudyRows::StudyRows(const StudyRows& like, ResultStore& store, const std::string& study,
                     const std::vector<Filter>& filters)
    : columns_(like.columns_) {
  read(store, study, filters, formulas_of(store, study));
}

void StudyRows::read(ResultStore& store, const std::string& study, const std::vector<Filter>& filters,
                     const FormulaDefinitions& formulas) {
  Query query{.filters = filters, .sort = {"position"}, .computed = computed_columns(formulas)};
  query.filters.push_back({"study", Comparison::equal, study});
  convert_to_si(query.filters, formulas);
  for (const QuantityColumn* const column : columns_) query.columns.push_back(column->name);
  query.columns.emplace_back(study_key);
  const bool designs = !definition_in(store.definition(study).value_or(""), store.database().name()).goals.empty();
  if (designs && column_names(store.database().connection(), "result").contains(feasible_key))
    query.columns.emplace_back(feasible_key);
  table_ = run_column_query(store.database(), query);
  for (std::size_t i = 0; i < table_.names.size(); ++i) places_[table_.names[i]] = i;
  if (table_.rows > 0) return;
  const bool unit_tells = any_of(query.filters, [](const Filter& filter) { return filter.per_metre.has_value(); });
  throw std::invalid_argument(
      store.database().name() + ": " + study + ": " +
      (filters.empty() ? "no point is computed yet" : "no point matches") +
      (unit_tells ? "; a value in N finds spheres and cylinders with a width, a value in N/m cylinders without width"
                  : ""));
}

StudyRows::StudyRows(const std::vector<StudyRows>& studies) {
  for (const StudyRows& one : studies)
    for (const QuantityColumn* const column : one.columns_) {
      if (const auto same = places_.find(column->name); same == places_.end()) {
        places_[column->name] = columns_.size();
        columns_.push_back(column);
      } else if (columns_[same->second] != column) {
        throw std::invalid_argument(column->name + ": is computed differently in the studies");
      }
    }
  places_[std::string(study_key)] = columns_.size();
  columns_.push_back(find_quantity_column(study_key));
  for (const QuantityColumn* const column : columns_) {
    table_.names.push_back(column->name);
    CellColumn& cells = table_.columns.emplace_back();
    for (const StudyRows& one : studies) {
      const auto place = one.places_.find(column->name);
      for (std::size_t row = 0; row < one.size(); ++row)
        cells.add(place == one.places_.end() ? Cell() : one.table_.columns[place->second][row]);
    }
  }
  for (const StudyRows& one : studies) table_.rows += one.size();
}

const CellColumn& StudyRows::cells(const Column& column) const {
  const auto place = places_.find(column.name);
  if (place == places_.end()) throw std::invalid_argument(column.name + ": no point of the study has this layer");
  return table_.columns[place->second];
}

Cell StudyRows::cell(std::size_t row, const Column& column) const { return cells(column)[row]; }

double StudyRows::number(std::size_t row, const Column& column) const { return cells(column).number(row); }

double StudyRows::number(std::size_t row, const char* key) const { return number(row, *find_quantity_column(key)); }

std::string StudyRows::text(std::size_t row, const char* key) const {
  const Cell value = cell(row, *find_quantity_column(key));
  const auto* const text = std::get_if<std::string>(&value);
  return text ? *text : std::string();
}

bool StudyRows::converged(std::size_t row) const {
  return cell(row, *find_quantity_column("status")) == Cell(std::string(name_of(Status::converged)));
}

bool StudyRows::breaks_constraint(std::size_t row) const {
  const auto place = places_.find(feasible_key);
  return place != places_.end() && table_.columns[place->second][row] == Cell(std::int64_t{0});
}

std::vector<Cell> StudyRows::values(const Column& column) const { return cells(column).values(); }

std::optional<Cell> StudyRows::common(const Column& column) const {
  const CellColumn& all = cells(column);
  if (!all.uniform() || std::holds_alternative<std::monostate>(all[0])) return {};
  return all[0];
}

const QuantityColumn& column_of(const std::string& key, const StudyOutline& study, const StudyRows& rows,
                                const std::string& option) {
  const bool axis = contains(study.axes, key);
  if (const QuantityColumn* const column = find_quantity_column(axis ? input_column(key) : key)) return *column;
  refusing_at(option, [&] { require_held(key); });
  std::vector<std::string_view> names = keys_like(key);
  for (const QuantityColumn* const column : rows.columns()) {
    if (column->name == key) return *column;
    names.push_back(column->name);
  }
  throw std::invalid_argument(option + " = " + key + ": " + unknown("unknown key", names, key));
}

const QuantityColumn& number_column(const std::string& key, const StudyOutline& study, const StudyRows& rows,
                                    const std::string& option) {
  const QuantityColumn& column = column_of(key, study, rows, option);
  if (column.type == "TEXT") throw std::invalid_argument(option + " = " + key + ": must be a number");
  return column;
}

std::string_view unit_in(const StudyRows& rows, const QuantityColumn& column) {
  const Body first = body_at(rows, 0);
  const std::optional<Body> other = column.quantity.grows_with_width() ? body_of_other_units(rows) : std::nullopt;
  if (!other) return column.quantity.unit_for(first);
  if (other->indenter != first.indenter)
    throw std::invalid_argument(column.name + ": has another unit for a cylinder than for a sphere; choose one " +
                                "with indenter=cylinder or indenter=sphere");
  throw std::invalid_argument(column.name + ": is per metre where no width is given, and of the whole body where " +
                              "one is; choose one width with width=VALUE");
}

Body body_at(const StudyRows& rows, std::size_t row) { return BodyColumns().at(rows, row); }

std::optional<Body> body_of_other_units(const StudyRows& rows) {
  const BodyColumns columns;
  if (rows.values(columns.indenter).size() == 1 && rows.values(columns.width).size() == 1) return {};
  for (std::size_t row = 1; row < rows.size(); ++row)
    if (const Body body = columns.at(rows, row); body.per_metre() != columns.at(rows, row - 1).per_metre()) return body;
  return std::nullopt;
}

StudyOrder::StudyOrder(const StudyRows& rows, std::span<const QuantityColumn* const> columns) {
  for (const QuantityColumn* const column : columns)
    if (column->type == "TEXT")
      for (std::size_t row = 0; row < rows.size(); ++row) places_.try_emplace(rows.cell(row, *column), places_.size());
}

bool StudyOrder::operator()(const Cell& a, const Cell& b) const {
  const auto first = places_.find(a), second = places_.find(b);
  return first == places_.end() || second == places_.end() ? a < b : first->second < second->second;
}

bool StudyOrder::operator()(const std::vector<Cell>& a, const std::vector<Cell>& b) const {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), *this);
}

std::string value_in_words(const Cell& cell, std::string_view unit) {
  if (const auto* const text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* const count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
  if (const auto* const number = std::get_if<double>(&cell)) return readable(*number, unit);
  return "none";
}

std::string value_in_words(const Quantity& quantity, const Cell& cell, std::string_view unit) {
  const auto* const number = std::get_if<double>(&cell);
  return number ? readable(quantity, *number, unit) : value_in_words(cell, unit);
}

ChartAxis described(const QuantityColumn& column) {
  return {.name = in_words(column.quantity.key), .symbol = std::string(symbol_beside_name(column.quantity))};
}

ColumnScale scale_of(std::span<const double> values, const QuantityColumn& column, std::string_view unit,
                     AxisScale wish, bool hint, const std::string& option) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  bool all_positive = true;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    all_positive = all_positive && value > 0;
    smallest = std::min(smallest, std::abs(value));
    largest = std::max(largest, std::abs(value));
  }
  constexpr double two_decades = 100 * (1 - 1e-9);
  if (wish == AxisScale::logarithmic && !all_positive)
    throw std::invalid_argument(option + " = logarithmic: " + column.name + " has values that are not positive");
  if (unit == "K" && is_temperature(column.quantity.key) && wish != AxisScale::logarithmic) return {celsius(), false};
  const bool logarithmic = wish == AxisScale::logarithmic || (wish == AxisScale::automatic && all_positive &&
                                                              (hint || largest >= two_decades * smallest));
  return {logarithmic ? scaled_unit_logarithmic(unit, smallest, largest) : scaled_unit(unit, largest), logarithmic};
}

ColumnScale scale_of(const StudyRows& rows, const QuantityColumn& column, AxisScale wish, bool hint,
                     const std::string& option) {
  std::vector<double> values;
  for (std::size_t row = 0; row < rows.size(); ++row) values.push_back(rows.number(row, column));
  return scale_of(values, column, unit_in(rows, column), wish, hint, option);
}

ChartAxis described(const QuantityColumn& column, const ColumnScale& scale) {
  ChartAxis axis = described(column);
  const bool is_length = column.quantity.unit_2d == "m" && scale.unit.name.ends_with('m');
  if (const std::size_t area = axis.name.find("area"); is_length && area != std::string::npos)
    axis = {.name = axis.name.replace(area, 4, "length")};  // what is an area of a whole body
  return axis;
}

ChartAxis scaled_axis(const QuantityColumn& column, const ColumnScale& scale) {
  ChartAxis axis = described(column, scale);
  axis.unit = typeset_unit(scale.unit.name);
  axis.logarithmic = scale.logarithmic;
  return axis;
}

std::string common_inputs(const StudyRows& rows) {
  std::string lines;
  for (const QuantityColumn* const column : rows.columns()) {
    if (!column->is_input) continue;
    if (const auto value = rows.common(*column))
      lines += "\n" + std::string(column->quantity.key) + " = " +
               value_in_words(column->quantity, *value, unit_in(rows, *column));
  }
  return lines;
}

std::string stored_study_name(ResultStore& store, const std::string& name) {
  const std::string& file = store.database().name();
  const std::vector<std::string> all = store.study_names();
  if (contains(all, name)) return name;
  if (all.empty()) {
    const std::size_t fits = stored_fits(store.database()).size();
    throw std::invalid_argument(
        file + ": holds no study" +
        (fits == 0 ? "" : ", only fits, " + std::to_string(fits) + " (rollres list names them)"));
  }
  if (name.empty() && all.size() == 1) return all.front();
  if (!name.empty())
    throw std::invalid_argument(file + ": study = " + name + ": " + unknown("unknown study", all, name));
  throw std::invalid_argument(file + ": holds several studies, choose one with --study: " + joined(all));
}

namespace {

template <class Study>
Study still_there(std::optional<Study> study, ResultStore& store, const std::string& name) {
  if (study) return *std::move(study);
  throw std::invalid_argument(store.database().name() + ": " + name + ": was deleted just now");
}

}  // namespace

StudyOutline stored_outline(ResultStore& store, const std::string& name) {
  const std::string found = stored_study_name(store, name);
  return still_there(store.outline(found), store, found);
}

StudySummary stored_study(ResultStore& store, const std::string& name) {
  const std::string found = stored_study_name(store, name);
  return still_there(store.study(found), store, found);
}

namespace {

/// A word that the column never holds would match nothing, or everything.
void refuse_unknown_choice(const Filter& filter, const QuantityColumn& column) {
  if (filter.value.empty() || (filter.comparison != Comparison::equal && filter.comparison != Comparison::not_equal))
    return;
  std::span<const std::string_view> choices;
  if (const InputKind* const input = find_input(key_of(column))) choices = input->choices;
  if (column.name == "status") choices = ChoiceNames<Status>::names;
  if (choices.empty() || find_name(choices, filter.value) >= 0) return;
  throw std::invalid_argument(filter.column + " = " + filter.value + ": must be one of " + joined(choices));
}

}  // namespace

Filter read_filter(const std::string& text) {
  Filter filter = parse_filter(text);
  require_held(filter.column);
  const QuantityColumn* column = find_quantity_column(filter.column);
  if (column && column->type == "TEXT") refuse_unknown_choice(filter, *column);
  if (column && column->type == "REAL") convert_written(filter, column->quantity);
  return filter;
}

std::vector<ComputedShare> computed_shares(ResultStore& store, const std::string& study) {
  const Table results = run_query(store.database(), {.filters = {{"study", Comparison::equal, study}},
                                                     .columns = {"id", "provenance", "created", "seconds"}});
  std::map<std::int64_t, ComputedShare> shares;
  for (const std::vector<Cell>& row : results.rows) {
    ComputedShare& share = shares[std::get<std::int64_t>(row[1])];
    const std::string& time = std::get<std::string>(row[2]);
    if (share.points++ == 0) {
      share.program = store.find(std::get<std::int64_t>(row[0])).value().provenance;
      share.first = share.last = time;
    }
    share.first = std::min(share.first, time);
    share.last = std::max(share.last, time);
    if (const auto* const seconds = std::get_if<double>(&row[3])) share.seconds += *seconds;
  }
  std::vector<ComputedShare> list;
  for (auto& [ignored, share] : shares) list.push_back(std::move(share));
  return list;
}

StudyStatus study_status(const Study& study, std::span<const std::filesystem::path> databases, int shards) {
  const StudyPlan plan(study);
  std::vector<std::string> keys(plan.size());
  if (!databases.empty() || shards > 1) keys = plan.keys();
  std::vector<double> predictions;
  std::vector<CostKind> kinds;
  plan.for_each([&](std::size_t, const RollingScene& scene) {
    predictions.push_back(predicted_seconds(scene));
    kinds.push_back(cost_kind(scene));
  });
  std::vector<PointState> best(keys.size());
  LearnedCost own;
  for (const std::filesystem::path& file : databases) {
    const std::vector<PointState> here = point_states(ReadableSource(file).database(), keys);
    for (std::size_t i = 0; i < best.size(); ++i)
      if (here[i].answer > best[i].answer) best[i] = here[i];
  }
  for (std::size_t i = 0; i < best.size(); ++i)
    if (best[i].answer != Answer::missing) own.add(kinds[i], predictions[i], best[i].seconds);

  StudyStatus status;
  status.points = keys.size();
  status.seconds_left = 0;
  const std::vector<int> shard = shards_of_points(keys, predictions, shards);
  std::set<int> missing;
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (best[i].answer == Answer::missing) {
      ++status.missing;
      status.seconds_left += predictions[i] * own.ratio(kinds[i]);
      if (!own.knows(kinds[i])) {
        ++status.unlearned;
        status.seconds_unlearned += predictions[i] * own.ratio(kinds[i]);
      }
      missing.insert(shard[i]);
      continue;
    }
    ++(best[i].answer == Answer::converged ? status.converged : status.failed);
  }
  status.shards_missing.assign(missing.begin(), missing.end());
  return status;
}

}  // namespace rollres
