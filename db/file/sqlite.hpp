#pragma once

/// SQLite as the sources of this chapter see it; no other header includes it.

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/Savepoint.h>
#include <SQLiteCpp/VariadicBind.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

namespace rollres {

/// A file may be a stranger's: its triggers do not run, its views and columns call no function that does more than
/// compute, its tables are changed by ordinary statements alone, and no other file is opened beside it. For every
/// connection, before its first statement (sqlite.org, "Defense Against The Dark Arts").
void distrust(SQLite::Database& connection);

/// Writes the file anew without what was deleted, or such a copy `into` a new file, for which SQLite attaches it.
void vacuum(SQLite::Database& connection, const std::filesystem::path& into = {});

/// Does `work`, and puts the file's name before SQLite's own words where it fails.
template <class Work>
auto naming(const std::string& file, Work&& work) -> decltype(work()) {
  try {
    return std::forward<Work>(work)();
  } catch (const SQLite::Exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

/// A statement with values for its first parameters.
template <class... Values>
SQLite::Statement bound(SQLite::Database& connection, const std::string& sql, const Values&... values) {
  SQLite::Statement statement(connection, sql);
  SQLite::bind(statement, values...);
  return statement;
}

/// Binds a value; a number that is NaN is NULL.
template <class Value>
void bind_value(SQLite::Statement& statement, int index, const Value& value) {
  statement.bind(index, value);
}
inline void bind_value(SQLite::Statement& statement, int index, double value) {
  std::isnan(value) ? statement.bind(index) : statement.bind(index, value);
}

/// While it lives, 100 MB of pages are kept in memory: pages of an index to whose random places rows go, or at which
/// they are looked up, are then written and read once.
class LargeCache {
 public:
  explicit LargeCache(SQLite::Database& connection)
      : connection_(connection), usual_(connection.execAndGet("PRAGMA cache_size").getInt()) {
    connection.exec("PRAGMA cache_size = -100000");
  }
  ~LargeCache() { connection_.tryExec("PRAGMA cache_size = " + std::to_string(usual_)); }
  LargeCache(const LargeCache&) = delete;
  LargeCache& operator=(const LargeCache&) = delete;

 private:
  SQLite::Database& connection_;
  int usual_;
};

}  // namespace rollres
