#include "db/rows/fit_store.hpp"

#include <cmath>

#include "db/file/provenance.hpp"
#include "db/file/sqlite.hpp"

namespace rollres {

namespace {

/// Binds values one after the other; NULL for NaN.
class Binder {
 public:
  explicit Binder(SQLite::Statement& statement) : statement_(statement) {}

  Binder& operator<<(double value) {
    if (std::isnan(value))
      statement_.bind(index_++);
    else
      statement_.bind(index_++, value);
    return *this;
  }
  Binder& operator<<(std::int64_t value) {
    statement_.bind(index_++, value);
    return *this;
  }
  Binder& operator<<(bool value) { return *this << std::int64_t{value}; }
  Binder& operator<<(const std::string& value) {
    statement_.bind(index_++, value);
    return *this;
  }

 private:
  SQLite::Statement& statement_;
  int index_ = 1;
};

/// Reads columns one after the other; NaN for NULL.
class Reader {
 public:
  explicit Reader(SQLite::Statement& statement) : statement_(statement) {}

  Reader& operator>>(double& value) {
    const SQLite::Column column = statement_.getColumn(index_++);
    value = column.isNull() ? std::nan("") : column.getDouble();
    return *this;
  }
  Reader& operator>>(std::int64_t& value) {
    value = statement_.getColumn(index_++).getInt64();
    return *this;
  }
  Reader& operator>>(bool& value) {
    value = statement_.getColumn(index_++).getInt() != 0;
    return *this;
  }
  Reader& operator>>(std::string& value) {
    value = statement_.getColumn(index_++).getString();
    return *this;
  }

 private:
  SQLite::Statement& statement_;
  int index_ = 0;
};

std::string placeholders(int count) {
  std::string text = "?";
  for (int i = 1; i < count; ++i) text += ", ?";
  return text;
}

constexpr const char* fit_columns =
    "name, kind, definition, data_digest, status, reason, warnings, weakest_direction, degrees, starts, agreeing, "
    "evaluations, recalled, failures, chi_squared, reduced_chi_squared, p_value, rms, runs_p_value, condition, noise, "
    "seconds, deviations_known";
constexpr int fit_column_count = 23;

constexpr const char* parameter_columns =
    "name, unit, fixed, value, standard_error, relative_error, linear_lowest, linear_highest, profile_lowest, "
    "profile_highest, profile_low, profile_high, start, lowest, highest, step, flag";
constexpr int parameter_column_count = 17;

void save_parts(SQLite::Database& connection, std::int64_t id, const FitRecord& fit) {
  SQLite::Statement parameter(connection, std::string("INSERT INTO fit_parameter(fit, position, ") + parameter_columns +
                                              ") VALUES (" + placeholders(parameter_column_count + 2) + ")");
  std::int64_t position = 0;
  for (const FitParameterRecord& p : fit.parameters) {
    parameter.reset();
    Binder(parameter) << id << ++position << p.name << p.unit << p.fixed << p.value << p.standard_error
                      << p.relative_error << p.linear_lowest << p.linear_highest << p.profile_lowest
                      << p.profile_highest << p.profile_low << p.profile_high << p.start << p.lowest << p.highest
                      << p.step << p.flag;
    parameter.exec();
  }
  SQLite::Statement correlation(connection,
                                "INSERT INTO fit_correlation(fit, first, second, correlation) VALUES (?, ?, ?, ?)");
  for (const FitCorrelationRecord& pair : fit.correlations) {
    correlation.reset();
    Binder(correlation) << id << pair.first << pair.second << pair.correlation;
    correlation.exec();
  }
  SQLite::Statement row(connection,
                        "INSERT INTO fit_data(fit, position, place, measured, deviation, predicted, residual, band) "
                        "VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  position = 0;
  for (const FitDataRecord& datum : fit.data) {
    row.reset();
    Binder(row) << id << ++position << datum.place << datum.measured << datum.deviation << datum.predicted
                << datum.residual << datum.band;
    row.exec();
  }
}

}  // namespace

void create_fit_tables(SQLite::Database& connection) {
  connection.exec(R"(
    CREATE TABLE fit(
      id INTEGER PRIMARY KEY,
      created TEXT NOT NULL,
      version TEXT NOT NULL,
      git_hash TEXT NOT NULL,
      solver TEXT NOT NULL,
      name TEXT NOT NULL,
      kind TEXT NOT NULL,
      definition TEXT NOT NULL,
      data_digest TEXT NOT NULL,
      status TEXT NOT NULL,
      reason TEXT NOT NULL,
      warnings TEXT NOT NULL,
      weakest_direction TEXT NOT NULL,
      degrees INTEGER NOT NULL,
      starts INTEGER NOT NULL,
      agreeing INTEGER NOT NULL,
      evaluations INTEGER NOT NULL,
      recalled INTEGER NOT NULL,
      failures INTEGER NOT NULL,
      chi_squared REAL,
      reduced_chi_squared REAL,
      p_value REAL,
      rms REAL,
      runs_p_value REAL,
      condition REAL,
      noise REAL,
      seconds REAL,
      deviations_known INTEGER NOT NULL,
      UNIQUE(name, definition, data_digest)) STRICT;
    CREATE TABLE fit_parameter(
      fit INTEGER NOT NULL REFERENCES fit ON DELETE CASCADE,
      position INTEGER NOT NULL,
      name TEXT NOT NULL,
      unit TEXT NOT NULL,
      fixed INTEGER NOT NULL,
      value REAL,
      standard_error REAL,
      relative_error REAL,
      linear_lowest REAL,
      linear_highest REAL,
      profile_lowest REAL,
      profile_highest REAL,
      profile_low TEXT NOT NULL,
      profile_high TEXT NOT NULL,
      start REAL,
      lowest REAL,
      highest REAL,
      step REAL,
      flag TEXT NOT NULL,
      PRIMARY KEY(fit, position)) STRICT, WITHOUT ROWID;
    CREATE TABLE fit_correlation(
      fit INTEGER NOT NULL REFERENCES fit ON DELETE CASCADE,
      first TEXT NOT NULL,
      second TEXT NOT NULL,
      correlation REAL,
      PRIMARY KEY(fit, first, second)) STRICT, WITHOUT ROWID;
    CREATE TABLE fit_data(
      fit INTEGER NOT NULL REFERENCES fit ON DELETE CASCADE,
      position INTEGER NOT NULL,
      place TEXT NOT NULL,
      measured REAL,
      deviation REAL,
      predicted REAL,
      residual REAL,
      band REAL,
      PRIMARY KEY(fit, position)) STRICT, WITHOUT ROWID;
  )");
}

std::int64_t save_fit(const Database& database, const FitRecord& fit) {
  return naming(database.name(), [&] {
    SQLite::Database& connection = database.connection();
    SQLite::Transaction transaction(connection, SQLite::TransactionBehavior::IMMEDIATE);
    SQLite::Statement find(connection, "SELECT id FROM fit WHERE name = ? AND definition = ? AND data_digest = ?");
    Binder(find) << fit.name << fit.definition << fit.data_digest;
    if (find.executeStep()) {
      const std::int64_t old = find.getColumn(0).getInt64();
      for (const char* table : {"fit_parameter", "fit_correlation", "fit_data"}) {
        SQLite::Statement remove(connection, std::string("DELETE FROM ") + table + " WHERE fit = ?");
        Binder(remove) << old;
        remove.exec();
      }
      SQLite::Statement remove(connection, "DELETE FROM fit WHERE id = ?");
      Binder(remove) << old;
      remove.exec();
    }
    find.reset();
    SQLite::Statement insert(connection, std::string("INSERT INTO fit(created, version, git_hash, solver, ") +
                                             fit_columns +
                                             ") VALUES (strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), ?, ?, ?, " +
                                             placeholders(fit_column_count) + ")");
    const Provenance& program = this_program();
    Binder(insert) << program.version << program.git_hash << program.solver << fit.name << fit.kind << fit.definition
                   << fit.data_digest << fit.status << fit.reason << fit.warnings << fit.weakest_direction
                   << fit.degrees << fit.starts << fit.agreeing << fit.evaluations << fit.recalled << fit.failures
                   << fit.chi_squared << fit.reduced_chi_squared << fit.p_value << fit.rms << fit.runs_p_value
                   << fit.condition << fit.noise << fit.seconds << fit.deviations_known;
    insert.exec();
    const std::int64_t id = connection.getLastInsertRowid();
    save_parts(connection, id, fit);
    transaction.commit();
    return id;
  });
}

std::optional<FitRecord> find_fit(const Database& database, const std::string& name, FitParts parts) {
  return naming(database.name(), [&]() -> std::optional<FitRecord> {
    SQLite::Database& connection = database.connection();
    SQLite::Statement row(connection,
                          std::string("SELECT id, ") + fit_columns + " FROM fit WHERE name = ? ORDER BY id DESC");
    Binder(row) << name;
    if (!row.executeStep()) return std::nullopt;
    FitRecord fit;
    std::int64_t id = 0;
    Reader(row) >> id >> fit.name >> fit.kind >> fit.definition >> fit.data_digest >> fit.status >> fit.reason >>
        fit.warnings >> fit.weakest_direction >> fit.degrees >> fit.starts >> fit.agreeing >> fit.evaluations >>
        fit.recalled >> fit.failures >> fit.chi_squared >> fit.reduced_chi_squared >> fit.p_value >> fit.rms >>
        fit.runs_p_value >> fit.condition >> fit.noise >> fit.seconds >> fit.deviations_known;
    SQLite::Statement parameter(
        connection, std::string("SELECT ") + parameter_columns + " FROM fit_parameter WHERE fit = ? ORDER BY position");
    Binder(parameter) << id;
    while (parameter.executeStep()) {
      FitParameterRecord& p = fit.parameters.emplace_back();
      Reader(parameter) >> p.name >> p.unit >> p.fixed >> p.value >> p.standard_error >> p.relative_error >>
          p.linear_lowest >> p.linear_highest >> p.profile_lowest >> p.profile_highest >> p.profile_low >>
          p.profile_high >> p.start >> p.lowest >> p.highest >> p.step >> p.flag;
    }
    SQLite::Statement pair(connection, "SELECT first, second, correlation FROM fit_correlation WHERE fit = ?");
    Binder(pair) << id;
    while (pair.executeStep()) {
      FitCorrelationRecord& correlation = fit.correlations.emplace_back();
      Reader(pair) >> correlation.first >> correlation.second >> correlation.correlation;
    }
    if (parts == FitParts::without_data) return fit;
    SQLite::Statement data(connection,
                           "SELECT place, measured, deviation, predicted, residual, band FROM fit_data WHERE fit = ? "
                           "ORDER BY position");
    Binder(data) << id;
    while (data.executeStep()) {
      FitDataRecord& one = fit.data.emplace_back();
      Reader(data) >> one.place >> one.measured >> one.deviation >> one.predicted >> one.residual >> one.band;
    }
    return fit;
  });
}

}  // namespace rollres
