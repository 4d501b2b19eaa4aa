#include "db/rows/fit_store.hpp"

#include <cmath>
#include <set>
#include <type_traits>

#include "db/file/provenance.hpp"
#include "db/file/sqlite.hpp"
#include "db/rows/fit_columns.hpp"
#include "db/rows/schema.hpp"

namespace rollres {

namespace {

std::string type_of(double) { return "REAL"; }
std::string type_of(std::int64_t) { return "INTEGER NOT NULL"; }
std::string type_of(bool) { return "INTEGER NOT NULL"; }
std::string type_of(const std::string&) { return "TEXT NOT NULL"; }

/// "name TEXT NOT NULL, ...", or without the types.
template <class Record>
std::string column_list(bool types = false) {
  std::string list;
  const Record record{};
  visit_columns(record, [&](const char* name, const auto& value) {
    list += (list.empty() ? "" : ", ") + std::string(name) + (types ? " " + type_of(value) : "");
  });
  return list;
}

void read_column(const SQLite::Column& column, double& value) {
  value = column.isNull() ? std::nan("") : column.getDouble();
}
void read_column(const SQLite::Column& column, std::int64_t& value) { value = column.getInt64(); }
void read_column(const SQLite::Column& column, bool& value) { value = column.getInt() != 0; }
void read_column(const SQLite::Column& column, std::string& value) { value = column.getString(); }

template <class Record>
Record read_record(SQLite::Statement& row, int index) {
  Record record;
  visit_columns(record, [&](const char*, auto& value) { read_column(row.getColumn(index++), value); });
  return record;
}

/// Adds a row: what comes before the columns of the record are SQL expressions with parameters for `before`.
template <class Record, class... Before>
void insert(SQLite::Database& connection, const std::string& table, const std::string& names, const std::string& values,
            const Record& record, const Before&... before) {
  std::string places = values;
  visit_columns(record, [&](const char*, const auto&) { places += ", ?"; });
  SQLite::Statement row(
      connection, "INSERT INTO " + table + "(" + names + ", " + column_list<Record>() + ") VALUES (" + places + ")");
  int index = 1;
  (rollres::bind_value(row, index++, before), ...);
  visit_columns(record, [&](const char*, const auto& value) { rollres::bind_value(row, index++, value); });
  row.exec();
}

template <class Record>
std::vector<Record> parts_of(SQLite::Database& connection, const std::string& table, const std::string& order,
                             std::int64_t fit) {
  SQLite::Statement row =
      bound(connection, "SELECT " + column_list<Record>() + " FROM " + table + " WHERE fit = ?" + order, fit);
  std::vector<Record> parts;
  while (row.executeStep()) parts.push_back(read_record<Record>(row, 0));
  return parts;
}

}  // namespace

void create_fit_tables(SQLite::Database& connection) {
  const std::string part = "(fit INTEGER NOT NULL REFERENCES fit ON DELETE CASCADE, ",
                    rowless = ") STRICT, WITHOUT ROWID";
  connection.exec(
      "CREATE TABLE fit(id INTEGER PRIMARY KEY, created TEXT NOT NULL, version TEXT NOT NULL, git_hash TEXT "
      "NOT NULL, solver TEXT NOT NULL, " +
      column_list<FitRecord>(true) + ", UNIQUE(name, definition, data_digest)) STRICT");
  connection.exec("CREATE TABLE fit_parameter" + part + "position INTEGER NOT NULL, " +
                  column_list<FitParameterRecord>(true) + ", PRIMARY KEY(fit, position)" + rowless);
  connection.exec("CREATE TABLE fit_correlation" + part + column_list<FitCorrelationRecord>(true) +
                  ", PRIMARY KEY(fit, first, second)" + rowless);
  connection.exec("CREATE TABLE fit_data" + part + "position INTEGER NOT NULL, " + column_list<FitDataRecord>(true) +
                  ", PRIMARY KEY(fit, position)" + rowless);
}

namespace {

/// Adds those columns of a record that a table of an older file lacks.
template <class Record>
void add_columns(SQLite::Database& connection, const std::string& table) {
  const std::set<std::string> present = column_names(connection, table);
  const Record record{};
  visit_columns(record, [&](const char* name, const auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    const std::string usual = std::is_same_v<Value, std::string>    ? " DEFAULT ''"
                              : std::is_same_v<Value, double>       ? ""
                              : std::is_same_v<Value, std::int64_t> ? " DEFAULT -1"
                                                                    : " DEFAULT 0";
    if (!present.contains(name))
      connection.exec("ALTER TABLE " + table + " ADD COLUMN " + name + " " + type_of(value) + usual);
  });
}

/// A table of rows that belong to a fit, in an order.
template <class Record>
void create_part(SQLite::Database& connection, const std::string& table) {
  connection.exec("CREATE TABLE IF NOT EXISTS " + table +
                  "(fit INTEGER NOT NULL REFERENCES fit ON DELETE CASCADE, position INTEGER NOT NULL, " +
                  column_list<Record>(true) + ", PRIMARY KEY(fit, position)) STRICT, WITHOUT ROWID");
}

}  // namespace

void add_fit_curves(SQLite::Database& connection) {
  add_columns<FitRecord>(connection, "fit");
  add_columns<FitDataRecord>(connection, "fit_data");
  create_part<FitProfileRecord>(connection, "fit_profile");
  create_part<FitCurveRecord>(connection, "fit_curve");
}

void add_fit_inputs(SQLite::Database& connection) { create_part<FitInputRecord>(connection, "fit_input"); }

void add_fit_details(SQLite::Database& connection) {
  add_columns<FitRecord>(connection, "fit");
  add_columns<FitParameterRecord>(connection, "fit_parameter");
  create_part<FitFailureRecord>(connection, "fit_failure");
  connection.exec(R"(
    UPDATE fit SET output_unit = y_unit
      WHERE NOT EXISTS (SELECT 1 FROM fit_data WHERE fit_data.fit = fit.id AND curve < 0);
    UPDATE fit_parameter SET noise = fixed AND flag LIKE 'noise%';
    UPDATE fit_parameter SET
      linear_low = CASE WHEN linear_lowest IS NULL THEN 'open' WHEN linear_lowest <= lowest THEN 'limit' ELSE 'closed' END,
      linear_high = CASE WHEN linear_highest IS NULL THEN 'open' WHEN linear_highest >= highest THEN 'limit' ELSE 'closed' END
      WHERE NOT fixed
  )");
}

void add_fit_scenes(SQLite::Database& connection) { add_columns<FitRecord>(connection, "fit"); }

std::vector<FitSummary> stored_fits(const Database& database) {
  return naming(database.name(), [&] {
    SQLite::Statement row(database.connection(),
                          "SELECT id, name, kind, status, created, (SELECT group_concat(name, ', ') FROM (SELECT name "
                          "FROM fit_parameter WHERE fit = id AND NOT fixed ORDER BY position)), (SELECT count(*) FROM "
                          "fit_data WHERE fit = id), chi_squared FROM fit ORDER BY name, id");
    std::vector<FitSummary> fits;
    while (row.executeStep()) {
      FitSummary& fit = fits.emplace_back();
      int column = 0;
      read_column(row.getColumn(column++), fit.id);
      for (std::string* const text : {&fit.name, &fit.kind, &fit.status, &fit.created, &fit.parameters})
        read_column(row.getColumn(column++), *text);
      read_column(row.getColumn(column++), fit.values);
      read_column(row.getColumn(column), fit.chi_squared);
    }
    return fits;
  });
}

std::int64_t save_fit(const Database& database, const FitRecord& fit) {
  return naming(database.name(), [&] {
    SQLite::Database& connection = database.connection();
    SQLite::Transaction transaction(connection, SQLite::TransactionBehavior::IMMEDIATE);
    for (const std::string table : {"fit_parameter", "fit_correlation", "fit_data", "fit_input", "fit_profile",
                                    "fit_curve", "fit_failure", "fit"}) {
      SQLite::Statement remove(connection, "DELETE FROM " + table + " WHERE " + (table == "fit" ? "id" : "fit") +
                                               " IN (SELECT id FROM fit WHERE name = ? AND definition = ? AND "
                                               "data_digest = ?)");
      int index = 1;
      for (const std::string* const text : {&fit.name, &fit.definition, &fit.data_digest}) remove.bind(index++, *text);
      remove.exec();
    }
    const Provenance& program = this_program();
    insert(connection, "fit", "created, version, git_hash, solver", "strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), ?, ?, ?",
           fit, program.version, program.git_hash, program.solver);
    const std::int64_t id = connection.getLastInsertRowid();
    const auto insert_all = [&](const char* table, const auto& rows) {
      std::int64_t position = 0;
      for (const auto& row : rows) insert(connection, table, "fit, position", "?, ?", row, id, ++position);
    };
    insert_all("fit_parameter", fit.parameters);
    for (const FitCorrelationRecord& pair : fit.correlations)
      insert(connection, "fit_correlation", "fit", "?", pair, id);
    insert_all("fit_data", fit.data);
    insert_all("fit_profile", fit.profiles);
    insert_all("fit_curve", fit.curves);
    insert_all("fit_input", fit.inputs);
    insert_all("fit_failure", fit.failure_reasons);
    transaction.commit();
    return id;
  });
}

std::optional<FitRecord> find_fit(const Database& database, const std::string& name, FitParts parts) {
  return naming(database.name(), [&]() -> std::optional<FitRecord> {
    SQLite::Database& connection = database.connection();
    SQLite::Statement row =
        bound(connection, "SELECT id, " + column_list<FitRecord>() + " FROM fit WHERE name = ? ORDER BY id DESC", name);
    if (!row.executeStep()) return std::nullopt;
    const std::int64_t id = row.getColumn(0).getInt64();
    FitRecord fit = read_record<FitRecord>(row, 1);
    fit.parameters = parts_of<FitParameterRecord>(connection, "fit_parameter", " ORDER BY position", id);
    fit.correlations =
        parts_of<FitCorrelationRecord>(connection, "fit_correlation", " ORDER BY abs(correlation) DESC", id);
    if (parts == FitParts::without_data) return fit;
    fit.data = parts_of<FitDataRecord>(connection, "fit_data", " ORDER BY position", id);
    fit.profiles = parts_of<FitProfileRecord>(connection, "fit_profile", " ORDER BY position", id);
    fit.curves = parts_of<FitCurveRecord>(connection, "fit_curve", " ORDER BY position", id);
    fit.inputs = parts_of<FitInputRecord>(connection, "fit_input", " ORDER BY position", id);
    fit.failure_reasons = parts_of<FitFailureRecord>(connection, "fit_failure", " ORDER BY position", id);
    return fit;
  });
}

}  // namespace rollres
