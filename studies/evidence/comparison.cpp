#include "studies/evidence/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/scene/scene_input.hpp"
#include "db/file/digest.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

namespace {

/// Cells as they are told apart.
std::string identity(const Cell& cell) {
  if (const auto* const number = std::get_if<double>(&cell)) return twelve_digits(*number);
  if (const auto* const count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
  if (const auto* const text = std::get_if<std::string>(&cell)) return '"' + *text;
  return "";
}

/// The stored points of a study: position and status, inputs, outputs.
struct Points {
  std::string place;  ///< file and study, for messages
  std::vector<std::vector<Cell>> rows;

  std::optional<Cell> only_value(std::size_t column) const {
    if (rows.empty()) return std::nullopt;
    for (const auto& row : rows)
      if (identity(row[column]) != identity(rows.front()[column])) return std::nullopt;
    return rows.front()[column];
  }
};

constexpr std::size_t position_column = 0, status_column = 1, first_input = 2;

Points read_points(ResultStore& store, const std::string& name, const std::vector<std::string>& columns) {
  stored_study_name(store, name);  // or refuses
  Query query{.filters = {{"study", Comparison::equal, name}}, .columns = columns};
  return {store.database().name() + ": " + name, run_query(store.database(), query).rows};
}

/// Positions in `rows` by what tells the points apart. A point that a study has twice is one.
std::map<std::string, std::size_t> by_inputs(const Points& points, const std::vector<std::size_t>& telling,
                                             std::size_t inputs) {
  auto words = [&](const std::vector<Cell>& row, const auto& columns) {
    std::string text;
    for (const std::size_t column : columns) text += identity(row[column]) + '\n';
    return text;
  };
  std::vector<std::size_t> all(inputs);
  for (std::size_t i = 0; i < inputs; ++i) all[i] = first_input + i;
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < points.rows.size(); ++i) {
    const auto [found, is_new] = places.emplace(words(points.rows[i], telling), i);
    if (is_new || words(points.rows[i], all) == words(points.rows[found->second], all)) continue;
    auto position = [&](std::size_t row) {
      return std::to_string(std::get<std::int64_t>(points.rows[row][position_column]));
    };
    throw std::invalid_argument(points.place + ": points " + position(found->second) + " and " + position(i) +
                                " differ only in inputs that are ignored");
  }
  return places;
}

double relative_difference(const Cell& first, const Cell& second) {
  const std::optional<double> a = number_in(first), b = number_in(second);
  if (!a || !b) return std::numeric_limits<double>::infinity();
  return *a == *b ? 0.0 : (*b - *a) / std::abs(*a);
}

void check_keys(const ComparisonOptions& options) {
  for (const std::string& key : options.ignored)
    if (!find_input(key))
      throw std::invalid_argument("ignore = " + key + ": " + unknown("unknown input", keys_like(key), key));
  for (const std::string& key : options.outputs) {
    if (const auto keys = output_keys(); find_name(keys, key) < 0)
      throw std::invalid_argument("output = " + key + ": " + unknown("unknown output", keys, key));
    if (find_quantity_column(key)->type == "TEXT")
      throw std::invalid_argument("output = " + key + ": must be a number");
  }
}

/// The inputs of the points of both, those of further layers among them.
std::vector<const QuantityColumn*> inputs_of(const Database& first, const std::string& first_study,
                                             const Database& second, const std::string& second_study) {
  std::vector<const QuantityColumn*> inputs;
  for (const auto& [database, study] : {std::pair(&first, &first_study), {&second, &second_study}})
    for (const QuantityColumn* const column : quantity_columns_of(*database, {{"study", Comparison::equal, *study}}))
      if (column->is_input && !contains(inputs, column)) inputs.push_back(column);
  return inputs;
}

/// Whether an input is ignored, by itself or with its whole list of layers.
bool is_ignored(const std::string& key, const std::vector<std::string>& ignored) {
  const std::optional<LayerKey> layered = layer_key(key);
  return any_of(ignored, [&](const std::string& one) { return one == key || (layered && one == layered->list); });
}

void add_differences(StudyComparison& result, const std::vector<Cell>& first, const std::vector<Cell>& second,
                     const std::vector<std::size_t>& axes, std::size_t inputs,
                     const std::vector<std::string>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const Cell &a = first[first_input + inputs + i], &b = second[first_input + inputs + i];
    if (!number_in(a) && !number_in(b)) continue;  // of no meaning for this indenter
    PointDifference difference{.position = std::get<std::int64_t>(first[position_column]),
                               .inputs = {},
                               .output = outputs[i],
                               .first = a,
                               .second = b,
                               .relative = relative_difference(a, b)};
    for (const std::size_t axis : axes) difference.inputs.push_back(first[axis]);
    const double size = std::abs(difference.relative);
    OutputDifference& all = result.outputs[i];
    ++all.points;
    all.largest = std::max(all.largest, size);
    all.rms += size * size;  // their sum, until all are known
    result.differences.push_back(std::move(difference));
  }
}

}  // namespace

bool StudyComparison::within(double relative) const {
  return !differences.empty() && std::abs(differences.front().relative) <= relative && half_answered == 0;
}

StudyComparison compare_studies(ResultStore& first_store, const std::string& first, ResultStore& second_store,
                                const std::string& second, const ComparisonOptions& options) {
  check_keys(options);
  const auto inputs = inputs_of(first_store.database(), first, second_store.database(), second);
  std::vector<std::string> columns{"position", "status"};
  for (const QuantityColumn* const input : inputs) columns.push_back(input->name);
  columns.insert(columns.end(), options.outputs.begin(), options.outputs.end());
  const Points a = read_points(first_store, first, columns), b = read_points(second_store, second, columns);

  StudyComparison result;
  std::vector<std::size_t> telling, axes;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::size_t column = first_input + i;
    const std::optional<Cell> in_a = a.only_value(column), in_b = b.only_value(column);
    const std::string key(inputs[i]->quantity.key);
    if (in_a && in_b && identity(*in_a) != identity(*in_b)) {
      result.compared.push_back({key, *in_a, *in_b});
    } else if (!is_ignored(key, options.ignored)) {
      telling.push_back(column);
      if (in_a && in_b) continue;
      axes.push_back(column);
      result.axes.push_back(key);
    }
  }
  for (const std::string& output : options.outputs) result.outputs.push_back({.output = output});

  const auto places_a = by_inputs(a, telling, inputs.size()), places_b = by_inputs(b, telling, inputs.size());
  for (const auto& [values, place] : places_a) {
    const auto other = places_b.find(values);
    if (other == places_b.end()) {
      ++result.only_first;
      continue;
    }
    ++result.matched;
    const auto &row_a = a.rows[place], &row_b = b.rows[other->second];
    const Cell converged = std::string(name_of(Status::converged));
    const int answers = (row_a[status_column] == converged) + (row_b[status_column] == converged);
    if (answers == 2)
      add_differences(result, row_a, row_b, axes, inputs.size(), options.outputs);
    else
      ++(answers == 1 ? result.half_answered : result.unanswered);
  }
  result.only_second = places_b.size() - result.matched;
  for (OutputDifference& output : result.outputs)
    if (output.points > 0) output.rms = std::sqrt(output.rms / static_cast<double>(output.points));
  std::sort(result.differences.begin(), result.differences.end(),
            [](const PointDifference& one, const PointDifference& other) {
              const double size = std::abs(one.relative), other_size = std::abs(other.relative);
              return size != other_size ? size > other_size : one.position < other.position;
            });
  return result;
}

}  // namespace rollres
