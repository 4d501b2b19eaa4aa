#include <ostream>
#include <type_traits>

#include "studies/file_schema/file_keys.hpp"
#include "studies/file_schema/json_schema.hpp"
#include "studies/program/commands.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// One quantity in words.
struct Row {
  std::string key, symbol, unit_2d, unit_3d, range, default_value, meaning;
};

std::string range_text(const Quantity& quantity, std::span<const std::string_view> choices, bool list = false) {
  if (!choices.empty()) return joined(choices);
  std::string text = quantity.range.rule();
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
  if (!kind.held_as.empty()) return "or " + std::string(kind.held_as);
  if (kind.optional) {
    const std::string others = joined(replaced_inputs(kind.quantity.key, 0.0));
    return others.empty() ? "" : "or " + others;
  }
  // A scene without moduli in lists has no use for it, and one with them says it (studies/scene_io/scene_entries.cpp).
  if (kind.quantity.key == listed_moduli_key) return "required beside storage_moduli";
  const std::string needed_by = kind.needed_by();
  if (needed_by == "every scene") return "required";
  if (!needed_by.empty()) return "required by " + needed_by;
  if (const auto* const name = std::get_if<std::string>(&kind.default_value)) return *name;
  return text_of(kind.default_value);
}

std::vector<Row> input_rows() {
  std::vector<Row> rows;
  for (const InputKind& kind : written_kinds()) {
    rows.push_back(row_of(kind.quantity));
    rows.back().range = kind.layers ? "list of layers" : range_text(kind.quantity, kind.choices, kind.list);
    rows.back().default_value = default_text(kind);
  }
  return rows;
}

/// How inputs of further layers are named.
struct FurtherLayers {
  std::vector<std::string_view> lists, keys;

  std::string text() const {
    return "inputs of further layers: LIST[N].KEY, counted from 0, as in coating_layers[0].layer_thickness\n\n"
           "LIST  " +
           joined(lists) + "\nKEY   " + joined(keys) + "\n";
  }
  std::string form() const { return joined(lists, "[N].KEY and ") + "[N].KEY"; }
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
    else if constexpr (std::is_same_v<Value, std::vector<double>>)
      rows.back().range = "list of numbers";
    else
      rows.back().range = "list of texts";
  });
  return rows;
}

/// Columns that are empty in all rows are left out.
Table table_of(const std::vector<Row>& rows) {
  const std::array columns{&Row::key,   &Row::symbol,        &Row::unit_2d, &Row::unit_3d,
                           &Row::range, &Row::default_value, &Row::meaning};
  constexpr std::array names{"key", "symbol", "per metre", "whole body", "values", "default", "meaning"};
  Table table;
  table.rows.resize(rows.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (all_of(rows, [&](const Row& row) { return (row.*columns[i]).empty(); })) continue;
    table.columns.emplace_back(names[i]);
    for (std::size_t j = 0; j < rows.size(); ++j) table.rows[j].emplace_back(rows[j].*columns[i]);
  }
  return table;
}

void print_table(std::ostream& out, const std::vector<Row>& rows) { write_aligned(out, table_of(rows), ""); }

/// Every key of every kind of files, as Markdown.
void print_keys(std::ostream& out) {
  out << "# Keys of the files\n\n"
         "Written by `rollres schema keys`, from the lists by which the files are read. Examples of every key of "
         "studies "
         "and\noptimisations are in [examples](examples); how they go together is told in [the guide](guide.md).\n\n"
         "## Scene\n\n";
  write_markdown(out, table_of(input_rows()));
  out << "\nBesides: `" << master_curve_key << "`, a CSV file with the lists of a master curve, `" << strain_sweep_key
      << "`, one with those of a\nstrain sweep, `" << shift_table_key
      << "`, one with a table of shifts, each of a further layer, too; `$schema` and `comment`, texts that are "
         "ignored. `"
      << profile_key
      << "`, with the profile of a roller, is the scene's alone. Inputs of further "
         "layers are "
      << further_layers().form() << ", counted from 0: " << joined(further_layers().keys) << ".\n";
  out << "\n## Answers\n\nWhat formulas, limits, charts and queries name beside inputs; a number of a list by its "
         "place, "
         "`bond_shears[1]`.\n\n";
  write_markdown(out, table_of(output_rows()));
  for (const auto& [title, keys] : key_sections()) {
    out << "\n## " << title << "\n\n";
    write_markdown(out, keys);
  }
  out << "\nUnder `axes` and `variables` stand keys of inputs with their values, `variant` with named sets of inputs, "
         "and\n`"
      << master_curve_key << "` with a list of files, each a variant.\n";
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

void quantities(bool json, Session& session) {
  if (json) {
    const Json object{{"inputs", json_rows(input_rows(), true)},
                      {"further_layers", further_layers().json()},
                      {"outputs", json_rows(output_rows(), false)}};
    session.out << object.dump(2) << '\n';
    return;
  }
  session.out << "inputs of a scene\n\n";
  print_table(session.out, input_rows());
  session.out << '\n' << further_layers().text() << "\noutputs of a solution\n\n";
  print_table(session.out, output_rows());
}

void schema(const std::string& what, Session& session) {
  if (what == "keys") return print_keys(session.out);
  session.out << (what == "scene"   ? scene_schema()
                  : what == "study" ? study_schema()
                  : what == "fit"   ? fit_schema()
                                    : optimisation_schema());
}

}  // namespace

void add_quantities(Command& program, Session& session) {
  const auto [command, json] =
      program.add<bool>("quantities", "List every key: symbol, unit, values, default and meaning", session, quantities);
  command->add_flag("--json", json, "print one JSON object");
  command->footer("Example: rollres quantities --json");
}

void add_schema(Command& program, Session& session) {
  const auto [command, what] =
      program.add<std::string>("schema", "Print the JSON schema of a kind of files, for editors", session, schema);
  command->add_option("what KIND", what, "scene, study, fit or optimisation; keys: a page of all keys for people")
      ->required()
      ->one_of({"scene", "study", "fit", "optimisation", "keys"});
  command->footer(
      "An editor that knows JSON schemas completes and checks a file that begins with\n"
      "{\"$schema\": \"../schema/study.json\", ...}, where that is the output of this command, kept beside it.\n"
      "Example: rollres schema study > study.schema.json");
}

}  // namespace rollres
