#include "db/rows/fields_table.hpp"

#include "db/rows/packed_fields.hpp"

namespace rollres {

namespace {

bool exec(SQLite::Statement& statement, const std::string& key) {
  statement.bind(1, key);
  return statement.exec() > 0;
}

void bind_fields(SQLite::Statement& statement, int first, const SurfaceFields& fields) {
  const std::string bytes = packed(fields);
  statement.bind(first, fields_format);
  statement.bind(first + 1, bytes.data(), static_cast<int>(bytes.size()));
}

}  // namespace

bool has_fields_table(SQLite::Database& connection) { return connection.tableExists("fields"); }

void put_fields(SQLite::Database& connection, const std::string& key, const SurfaceFields& fields) {
  SQLite::Statement put(connection, "INSERT OR REPLACE INTO fields(key, format, bytes) VALUES (?, ?, ?)");
  bind_fields(put, 2, fields);
  exec(put, key);
}

bool add_fields(SQLite::Database& connection, const Evaluation& answer) {
  SQLite::Statement add(connection,
                        "INSERT INTO fields(key, format, bytes) SELECT key, ?3, ?4 FROM evaluation "
                        "WHERE key = ?1 AND status = ?2 ON CONFLICT(key) DO NOTHING");
  add.bind(2, std::string(name_of(answer.solution.status)));
  bind_fields(add, 3, answer.solution.fields);
  return exec(add, answer.key);
}

void remove_fields(SQLite::Database& connection, const std::string& key) {
  SQLite::Statement remove(connection, "DELETE FROM fields WHERE key = ?");
  exec(remove, key);
}

std::optional<PackedFields> find_packed_fields(SQLite::Database& connection, const std::string& key) {
  if (!has_fields_table(connection)) return std::nullopt;
  SQLite::Statement row(connection, "SELECT format, bytes FROM fields WHERE key = ?");
  row.bind(1, key);
  if (!row.executeStep()) return std::nullopt;
  const SQLite::Column bytes = row.getColumn(1);
  return PackedFields{row.getColumn(0).getInt(),
                      {static_cast<const char*>(bytes.getBlob()), static_cast<std::size_t>(bytes.getBytes())}};
}

}  // namespace rollres
