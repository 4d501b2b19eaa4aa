#include <algorithm>
#include <array>
#include <memory>
#include <ostream>
#include <type_traits>

#include "studies/program/command_line.hpp"
#include "studies/program/commands.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

namespace {

/// One quantity in words.
struct Row {
  std::string key, symbol, unit_2d, unit_3d, range, default_value, meaning;
};

std::string range_text(const Quantity& quantity, std::span<const std::string_view> choices, bool list = false) {
  std::string text;
  for (const std::string_view name : choices) text += (text.empty() ? "" : ", ") + std::string(name);
  if (!choices.empty()) return text;
  text = quantity.range.rule();
  constexpr std::string_view verb = "must be ";
  if (text.starts_with(verb)) text.erase(0, verb.size());
  return list ? "list, each " + text : text;
}

Row row_of(const Quantity& quantity) {
  return {std::string(quantity.key),
          std::string(quantity.symbol),
          std::string(quantity.unit_for(Indenter::cylinder)),
          std::string(quantity.unit_for(Indenter::sphere)),
          "",
          "",
          std::string(quantity.meaning)};
}

std::string default_text(const InputKind& kind) {
  if (kind.optional) {
    std::string text;
    for (const std::string_view other : replaced_inputs(kind.quantity.key, 0.0))
      text += (text.empty() ? "or " : ", ") + std::string(other);
    return text;
  }
  const std::string needed_by = kind.needed_by();
  if (needed_by == "every scene") return "required";
  if (!needed_by.empty()) return "required by " + needed_by;
  if (const auto* const name = std::get_if<std::string>(&kind.default_value)) return *name;
  return text_of(kind.default_value);
}

std::vector<Row> input_rows() {
  std::vector<Row> rows;
  for (const InputKind& kind : input_kinds()) {
    rows.push_back(row_of(kind.quantity));
    rows.back().range = kind.layers ? "list of layers" : range_text(kind.quantity, kind.choices, kind.list);
    rows.back().default_value = default_text(kind);
  }
  return rows;
}

std::string listed(const std::vector<std::string_view>& keys) {
  std::string text;
  for (const std::string_view key : keys) text += (text.empty() ? "" : ", ") + std::string(key);
  return text;
}

/// How inputs of further layers are named.
struct FurtherLayers {
  std::vector<std::string_view> lists, keys;

  std::string text() const {
    return "inputs of further layers: LIST[N].KEY, counted from 0, as in coating_layers[0].layer_thickness\n\n"
           "LIST  " +
           listed(lists) + "\nKEY   " + listed(keys) + "\n";
  }
  Json json() const { return {{"form", "LIST[N].KEY"}, {"lists", lists}, {"keys", keys}}; }
};

FurtherLayers further_layers() {
  FurtherLayers found;
  for (const InputKind& kind : input_kinds())
    if (kind.layers) found.lists.push_back(kind.quantity.key);
  for (const InputKind& kind : layer_kinds()) found.keys.push_back(kind.quantity.key);
  return found;
}

std::vector<Row> output_rows() {
  std::vector<Row> rows;
  const RollingSolution solution;
  visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    rows.push_back(row_of(quantity));
    if constexpr (std::is_enum_v<Value>)
      rows.back().range = range_text(quantity, ChoiceNames<Value>::names);
    else if constexpr (std::is_arithmetic_v<Value>)
      rows.back().range = "number";
    else if constexpr (std::is_same_v<Value, std::string>)
      rows.back().range = "text";
    else
      rows.back().range = "list of texts";
  });
  return rows;
}

std::string table(const std::vector<Row>& rows) {
  const std::array columns{&Row::key, &Row::symbol, &Row::unit_2d, &Row::unit_3d, &Row::range, &Row::default_value};
  std::vector<Row> all{{"key", "symbol", "cylinder", "sphere", "values", "default", "meaning"}};
  all.insert(all.end(), rows.begin(), rows.end());
  std::string text;
  for (const Row& row : all) {
    for (const auto column : columns) {
      std::size_t widest = 0;
      for (const Row& other : all) widest = std::max(widest, width(other.*column));
      const bool empty = std::all_of(rows.begin(), rows.end(), [&](const Row& r) { return (r.*column).empty(); });
      if (!empty) text += padded(row.*column, widest + 2);
    }
    text += row.meaning + '\n';
  }
  return text;
}

Json json_rows(const std::vector<Row>& rows, bool inputs) {
  Json list = Json::array();
  for (const Row& row : rows) {
    Json object{{"key", row.key},         {"symbol", row.symbol}, {"unit_2d", row.unit_2d},
                {"unit_3d", row.unit_3d}, {"values", row.range},  {"meaning", row.meaning}};
    if (inputs) object["default"] = row.default_value.empty() ? Json(nullptr) : Json(row.default_value);
    list.push_back(object);
  }
  return list;
}

}  // namespace

void add_quantities(Command& program, Session& session) {
  Command* const command =
      program.add_subcommand("quantities", "List every key: symbol, unit, values, default and meaning");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print one JSON object");
  command->footer("Example: rollres quantities --json");
  command->callback([json, &session] {
    if (*json) {
      const Json object{{"inputs", json_rows(input_rows(), true)},
                        {"further_layers", further_layers().json()},
                        {"outputs", json_rows(output_rows(), false)}};
      session.out << object.dump(2) << '\n';
    } else {
      session.out << "inputs of a scene\n\n"
                  << table(input_rows()) << '\n'
                  << further_layers().text() << "\noutputs of a solution\n\n"
                  << table(output_rows());
    }
  });
}

}  // namespace rollres
