#include "db/rows/schema.hpp"

#include <algorithm>

#include "core/scene/scene_input.hpp"
#include "core/scene/solution.hpp"
#include "db/file/sqlite.hpp"
#include "db/rows/fit_store.hpp"
#include "db/rows/layer_column.hpp"

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
  std::string columns;
  for (const std::string_view column : summary_columns) columns += (columns.empty() ? "" : ", ") + std::string(column);
  connection.exec("CREATE INDEX evaluation_summary ON evaluation(" + columns + ")");
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
  const std::vector<Column> present = columns_of(connection, "evaluation");
  if (std::any_of(present.begin(), present.end(), [](const Column& column) { return column.name == "kinematics"; }))
    return;
  connection.exec("ALTER TABLE evaluation ADD COLUMN kinematics TEXT; UPDATE evaluation SET kinematics = 'printed'");
}

/// Before, the load found stood in the place of the load asked for, and differed in its last digits; so for the others.
void show_as_asked(SQLite::Database& connection) {
  const std::vector<Column> present = columns_of(connection, "evaluation");
  for (const char* const key : {"load", "approach", "driving_torque", "rotation_ratio"})
    if (std::any_of(present.begin(), present.end(),
                    [&](const Column& column) { return column.name == input_column(key); }))
      connection.exec(std::string("UPDATE evaluation SET ") + key + " = given_" + key + " WHERE given_" + key +
                      " IS NOT NULL");
}

void add_notes(SQLite::Database& connection) {
  connection.exec("ALTER TABLE study ADD COLUMN note TEXT NOT NULL DEFAULT ''");
}

std::vector<Column> missing_columns(SQLite::Database& connection) {
  const std::vector<Column> present = columns_of(connection, "evaluation");
  std::vector<Column> missing;
  for (const Column& column : quantity_columns())
    if (std::none_of(present.begin(), present.end(), [&](const Column& other) { return other.name == column.name; }))
      missing.push_back(column);
  return missing;
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
  const auto& all = quantity_columns();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Column& column) { return column.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<Column> columns_of(SQLite::Database& connection, const std::string& table) {
  std::vector<Column> columns;
  SQLite::Statement statement(connection, "SELECT name, type FROM pragma_table_info(?)");
  statement.bind(1, table);
  while (statement.executeStep())
    columns.push_back({statement.getColumn(0).getString(), statement.getColumn(1).getString()});
  return columns;
}

std::span<const Migration> schema_migrations() {
  static constexpr Migration migrations[] = {
      create_first_tables, create_summary_and_fields, create_fit_tables, add_kinematics, show_as_asked, add_notes};
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
