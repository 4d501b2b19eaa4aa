#include "db/rows/schema.hpp"

#include <map>
#include <mutex>

#include "core/messages/message_text.hpp"
#include "core/scene/scene_input.hpp"
#include "core/scene/solution.hpp"
#include "db/file/digest.hpp"
#include "db/file/sqlite.hpp"
#include "db/rows/fit_store.hpp"
#include "db/rows/result_store.hpp"

namespace rollres {

namespace {

void create_first_tables(SQLite::Database& connection) {
  connection.exec(R"(
    CREATE TABLE provenance(
      id INTEGER PRIMARY KEY,
      version TEXT NOT NULL,
      git_hash TEXT NOT NULL,
      solver TEXT NOT NULL,
      compiler TEXT NOT NULL,
      machine TEXT NOT NULL,
      UNIQUE(version, git_hash, solver, compiler, machine)) STRICT;
    CREATE TABLE study(
      id INTEGER PRIMARY KEY,
      name TEXT NOT NULL UNIQUE,
      axes TEXT NOT NULL,
      definition TEXT NOT NULL,
      created TEXT NOT NULL,
      started TEXT NOT NULL) STRICT;
    CREATE TABLE study_point(
      study INTEGER NOT NULL REFERENCES study ON DELETE CASCADE,
      position INTEGER NOT NULL,
      key TEXT NOT NULL,
      PRIMARY KEY(study, position)) STRICT, WITHOUT ROWID;
  )");
  connection.exec(study_point_index);
  std::string table =
      "CREATE TABLE evaluation(\n  id INTEGER PRIMARY KEY,\n  key TEXT NOT NULL UNIQUE,\n  created TEXT NOT NULL,\n"
      "  provenance INTEGER NOT NULL REFERENCES provenance";
  for (const Column& column : quantity_columns()) table += ",\n  " + column.name + " " + column.type;
  connection.exec(table + ") STRICT");
  connection.exec(R"(
    CREATE VIEW result AS
      SELECT study.name AS study, study_point.position AS position, evaluation.*
      FROM study_point JOIN study ON study.id = study_point.study JOIN evaluation ON evaluation.key = study_point.key
  )");
}

void create_summary_and_fields(SQLite::Database& connection) {
  connection.exec("CREATE INDEX evaluation_summary ON evaluation(" + joined(summary_columns) + ")");
  connection.exec(R"(
    CREATE TABLE fields(
      key TEXT NOT NULL PRIMARY KEY REFERENCES evaluation(key) ON DELETE CASCADE,
      format INTEGER NOT NULL,
      bytes BLOB NOT NULL) STRICT;
    CREATE VIEW converged AS SELECT * FROM result WHERE status = 'converged';
    CREATE VIEW resistance AS
      SELECT study, position, indenter, radius, layer_thickness, speed, load, friction_coefficient, drive,
             rolling_resistance, rolling_resistance_coefficient, approach, contact_area, peak_pressure
      FROM converged
  )");
}

/// Rows of before there was a choice were solved with the paper's kinematics.
void add_kinematics(SQLite::Database& connection) {
  if (column_names(connection, "evaluation").contains("kinematics")) return;
  connection.exec("ALTER TABLE evaluation ADD COLUMN kinematics TEXT; UPDATE evaluation SET kinematics = 'printed'");
}

/// Before, the load found stood in the place of the load asked for, and differed in its last digits; so for the others.
void show_as_asked(SQLite::Database& connection) {
  const std::vector<Column> present = columns_of(connection, "evaluation");
  for (const char* const key : {"load", "approach", "driving_torque", "rotation_ratio"})
    if (any_of(present, [&](const Column& column) { return column.name == input_column(key); }))
      connection.exec(std::string("UPDATE evaluation SET ") + key + " = given_" + key + " WHERE given_" + key +
                      " IS NOT NULL");
}

void add_notes(SQLite::Database& connection) {
  connection.exec("ALTER TABLE study ADD COLUMN note TEXT NOT NULL DEFAULT ''");
}

/// A point bears the name of the variant (named set of inputs) of its study that it is of.
void add_variants(SQLite::Database& connection) {
  connection.exec(R"(
    ALTER TABLE study_point ADD COLUMN variant TEXT;
    DROP VIEW IF EXISTS result;
    CREATE VIEW result AS
      SELECT study.name AS study, study_point.position AS position, study_point.variant AS variant, evaluation.*
      FROM study_point JOIN study ON study.id = study_point.study JOIN evaluation ON evaluation.key = study_point.key
  )");
}

/// What the designs of an optimisation are worth.
void add_designs(SQLite::Database& connection) {
  connection.exec(R"(
    ALTER TABLE study_point ADD COLUMN design INTEGER;
    ALTER TABLE study_point ADD COLUMN goal REAL;
    ALTER TABLE study_point ADD COLUMN second_goal REAL;
    ALTER TABLE study_point ADD COLUMN feasible INTEGER;
    ALTER TABLE study_point ADD COLUMN front INTEGER;
    DROP VIEW IF EXISTS result;
    CREATE VIEW result AS
      SELECT study.name AS study, study_point.position AS position, study_point.variant AS variant,
             study_point.design AS design, study_point.goal AS goal, study_point.second_goal AS second_goal,
             study_point.feasible AS feasible, study_point.front AS front, evaluation.*
      FROM study_point JOIN study ON study.id = study_point.study JOIN evaluation ON evaluation.key = study_point.key
  )");
}

std::vector<Column> missing_columns(SQLite::Database& connection) {
  const std::set<std::string> present = column_names(connection, "evaluation");
  std::vector<Column> missing;
  for (const Column& column : quantity_columns())
    if (!present.contains(column.name)) missing.push_back(column);
  return missing;
}

/// SQL of an input in a list of layers, which leaves out what is at its default.
template <class Value>
std::string expression_of(const LayerKey& key, const Quantity& quantity, const Value& usual) {
  const std::string list(key.list), place = std::to_string(key.layer);
  const std::string given = "json_extract(" + list + ", '$[" + place + "]." + std::string(key.input) + "')";
  const auto or_usual = [&](const std::string& value, const std::string& otherwise) {
    return "CASE WHEN json_array_length(" + list + ") > " + place + " THEN coalesce(" + value + ", " + otherwise +
           ") END";
  };
  if constexpr (std::is_enum_v<Value>) {
    return or_usual(given, "'" + std::string(name_of(usual)) + "'");
  } else if constexpr (std::is_same_v<Value, double>) {
    const std::string number = quantity.range.infinity_allowed
                                   ? "CASE " + given + " WHEN 'infinite' THEN 9e999 ELSE " + given + " END"
                                   : given;
    return "CAST(" + or_usual(number, twelve_digits(usual)) + " AS REAL)";
  } else {
    return given;
  }
}

/// The type of a quantity's column.
template <class Value>
std::string column_type(const Value&) {
  if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>)
    return "REAL";
  else if constexpr (std::is_same_v<Value, int>)
    return "INTEGER";
  else
    return "TEXT";
}

/// The column of a key "coating_layers[0].layer_thickness", NULL where a scene has not that layer or its layer not that
/// input; nullptr if no layer has such an input. It lives as long as the program.
const QuantityColumn* layer_column(std::string_view key) {
  static std::mutex mutex;
  static std::map<std::string, QuantityColumn, std::less<>> kept;
  const std::lock_guard lock(mutex);
  if (const auto found = kept.find(key); found != kept.end()) return &found->second;
  const std::optional<LayerKey> parts = layer_key(key);
  if (!parts) return nullptr;
  const BondedLayers usual(parts->layer + 1);
  RollingScene scene;
  scene.lower_layers = scene.coating_layers = usual;
  const QuantityColumn* column = nullptr;
  visit_input(scene, key, [&](const Quantity& quantity, const auto& value) {
    QuantityColumn& one = kept[std::string(key)];
    one = {{std::string(key), column_type(value), expression_of(*parts, quantity, value)}, quantity, true};
    column = &one;
  });
  return column;
}

/// The column of a number of a list of the solution, "bond_shears[1]", NULL where that has none; nullptr if there is no
/// such list. It lives as long as the program.
const QuantityColumn* output_element_column(std::string_view key) {
  static std::mutex mutex;
  static std::map<std::string, QuantityColumn, std::less<>> kept;
  const std::optional<ElementKey> element = element_key(key);
  const std::optional<Quantity> quantity = output_quantity(key);
  if (!element || !quantity) return nullptr;
  const std::string place = std::to_string(element->place);
  const std::string sql = "json_extract(" + std::string(element->list) + ", '$[" + place + "]')";
  const std::lock_guard lock(mutex);
  return &kept.try_emplace(std::string(key), QuantityColumn{{std::string(key), "REAL", sql}, *quantity, false})
              .first->second;
}

}  // namespace

std::string input_column(std::string_view key) {
  static const std::vector<std::string_view> outputs = output_keys();
  return (find_name(outputs, key) >= 0 ? "given_" : "") + std::string(key);
}

const std::vector<QuantityColumn>& quantity_columns() {
  static const std::vector<QuantityColumn> all = [] {
    std::vector<QuantityColumn> columns;
    const RollingScene scene;
    const RollingSolution solution;
    visit_inputs(scene, [&](const Quantity& quantity, const auto& value) {
      columns.push_back({{input_column(quantity.key), column_type(value)}, quantity, true});
    });
    visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
      columns.push_back({{std::string(quantity.key), column_type(value)}, quantity, false});
    });
    return columns;
  }();
  return all;
}

const QuantityColumn* find_quantity_column(std::string_view name) {
  if (layer_key(name)) return layer_column(name);
  if (name == variant_key) {
    static const QuantityColumn variant{
        {std::string(variant_key), "TEXT"}, {variant_key, "", "", "named set of inputs of the study"}, true};
    return &variant;
  }
  if (name == study_key) {
    static const QuantityColumn study{{std::string(study_key), "TEXT"}, {study_key, "", "", "study"}, true};
    return &study;
  }
  const auto& all = quantity_columns();
  const auto found = find_if(all, [&](const Column& column) { return column.name == name; });
  return found == all.end() ? output_element_column(name) : &*found;
}

std::vector<Column> columns_of(SQLite::Database& connection, const std::string& table) {
  std::vector<Column> columns;
  SQLite::Statement statement = bound(connection, "SELECT name, type FROM pragma_table_info(?)", table);
  while (statement.executeStep())
    columns.push_back({statement.getColumn(0).getString(), statement.getColumn(1).getString()});
  return columns;
}

std::set<std::string> column_names(SQLite::Database& connection, const std::string& table) {
  std::set<std::string> names;
  for (const Column& column : columns_of(connection, table)) names.insert(column.name);
  return names;
}

std::span<const Migration> schema_migrations() {
  static constexpr Migration migrations[] = {create_first_tables, create_summary_and_fields,
                                             create_fit_tables,   add_kinematics,
                                             show_as_asked,       add_notes,
                                             add_variants,        add_fit_scenes,
                                             add_fit_curves,      add_designs,
                                             add_fit_inputs,      add_fit_details};
  return migrations;
}

void add_missing_columns(SQLite::Database& connection) {
  if (missing_columns(connection).empty()) return;
  SQLite::Transaction transaction(connection, SQLite::TransactionBehavior::IMMEDIATE);
  for (const Column& column : missing_columns(connection))
    connection.exec("ALTER TABLE evaluation ADD COLUMN " + column.name + " " + column.type);
  transaction.commit();
}

Database open_database(const std::filesystem::path& file, Access access) {
  return Database(file, access, {schema_migrations(), add_missing_columns});
}

}  // namespace rollres
