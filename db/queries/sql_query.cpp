#include <sqlite3.h>

#include <stdexcept>

#include "db/file/sql_functions.hpp"
#include "db/queries/select.hpp"

namespace rollres {

namespace {

/// Lets a statement read; nothing else.
int allow_reading(void*, int action, const char*, const char*, const char*, const char*) {
  const bool reads =
      action == SQLITE_SELECT || action == SQLITE_READ || action == SQLITE_FUNCTION || action == SQLITE_RECURSIVE;
  return reads ? SQLITE_OK : SQLITE_DENY;
}

struct ReadingOnly {
  sqlite3* handle;
  explicit ReadingOnly(sqlite3* connection) : handle(connection) {
    sqlite3_set_authorizer(handle, allow_reading, nullptr);
  }
  ~ReadingOnly() { sqlite3_set_authorizer(handle, nullptr, nullptr); }
  ReadingOnly(const ReadingOnly&) = delete;
  ReadingOnly& operator=(const ReadingOnly&) = delete;
};

[[noreturn]] void refuse(const std::string& rule) { throw std::invalid_argument("sql: " + rule); }

/// The first statement of a text, by itself.
struct First {
  bool found = false, reads = false;
  const char* rest = nullptr;
};
First first_statement(sqlite3* handle, const char* text) {
  sqlite3_stmt* statement = nullptr;
  First first;
  const int code = sqlite3_prepare_v2(handle, text, -1, &statement, &first.rest);
  if (code == SQLITE_AUTH) refuse("must only read");
  if (code == SQLITE_ERROR) refuse(sqlite3_errmsg(handle));
  if (code != SQLITE_OK) throw SQLite::Exception(handle, code);
  first.found = statement != nullptr;
  first.reads = first.found && sqlite3_stmt_readonly(statement) != 0;
  sqlite3_finalize(statement);
  return first;
}

}  // namespace

Table run_sql(const Database& database, const std::string& sql) {
  return naming(database.name(), [&] {
    SQLite::Database& connection = database.connection();
    add_functions(connection);
    const ReadingOnly guard(connection.getHandle());
    const First first = first_statement(connection.getHandle(), sql.c_str());
    if (!first.found) refuse("must be a statement, as in SELECT * FROM resistance");
    if (!first.reads) refuse("must only read");
    if (first_statement(connection.getHandle(), first.rest).found) refuse("must be one statement");
    SQLite::Statement statement(connection, sql);
    return rows_of(statement);
  });
}

}  // namespace rollres
