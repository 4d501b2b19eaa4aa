#include "db/rows/study_upkeep.hpp"

#include <initializer_list>

#include "db/file/sqlite.hpp"

namespace rollres {

namespace {

constexpr const char* of_no_study = "NOT EXISTS (SELECT 1 FROM study_point WHERE study_point.key = evaluation.key)";

bool there_is(const Database& database, const std::string& study) {
  SQLite::Statement row = bound(database.connection(), "SELECT 1 FROM study WHERE name = ?", study);
  return row.executeStep();
}

/// Runs a statement on one study, whose name it binds last.
void change_study(const Database& database, const char* sql, std::initializer_list<std::string> values,
                  const std::string& study) {
  naming(database.name(), [&] {
    SQLite::Statement change(database.connection(), sql);
    int index = 0;
    for (const std::string& value : values) change.bind(++index, value);
    change.bind(++index, study);
    if (change.exec() == 0) throw std::invalid_argument("study = " + study + ": there is no such study");
  });
}

}  // namespace

void rename_study(const Database& database, const std::string& study, const std::string& name) {
  if (study != name && naming(database.name(), [&] { return there_is(database, name); }))
    throw std::invalid_argument(database.name() + ": study = " + name + ": is there already");
  change_study(database, "UPDATE study SET name = ? WHERE name = ?", {name}, study);
}

void delete_study(const Database& database, const std::string& study) {
  change_study(database, "DELETE FROM study WHERE name = ?", {}, study);
}

void set_note(const Database& database, const std::string& study, const std::string& note) {
  change_study(database, "UPDATE study SET note = ? WHERE name = ?", {note}, study);
}

std::int64_t rows_of_no_study(const Database& database) {
  return naming(database.name(), [&] {
    return database.connection()
        .execAndGet(std::string("SELECT count(*) FROM evaluation WHERE ") + of_no_study)
        .getInt64();
  });
}

void delete_rows_of_no_study(const Database& database) {
  naming(database.name(), [&] {
    database.connection().exec(std::string("DELETE FROM evaluation WHERE ") + of_no_study);
    vacuum(database.connection());
  });
}

}  // namespace rollres
