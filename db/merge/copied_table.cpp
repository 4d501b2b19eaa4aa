#include "db/merge/copied_table.hpp"

#include <functional>
#include <set>
#include <unordered_set>

#include "core/messages/message_text.hpp"
#include "db/rows/schema.hpp"

namespace rollres {

namespace {

void bind_value(SQLite::Statement& to, int index, const SQLite::Column& value) {
  if (value.isNull())
    to.bind(index);
  else if (value.isInteger())
    to.bind(index, value.getInt64());
  else if (value.isFloat())
    to.bind(index, value.getDouble());
  else if (value.isText())
    to.bind(index, value.getString());
  else
    to.bind(index, value.getBlob(), value.getBytes());
}

/// The INTEGER PRIMARY KEY that names rows by number; empty if there is none.
std::string number_column(SQLite::Database& connection, const std::string& table) {
  SQLite::Statement row = bound(connection,
                                "SELECT name, type, count(*) OVER (), wr FROM pragma_table_info(?1), (SELECT wr FROM "
                                "pragma_table_list(?1)) WHERE pk > 0",
                                table);
  const bool numbered = row.executeStep() && row.getColumn(1).getString() == "INTEGER" &&
                        row.getColumn(2).getInt() == 1 && row.getColumn(3).getInt() == 0;
  return numbered ? row.getColumn(0).getString() : "";
}

}  // namespace

std::vector<std::string> tables_by_reference(SQLite::Database& connection) {
  std::vector<std::string> names, ordered;
  SQLite::Statement row(
      connection, "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite_%' ORDER BY name");
  while (row.executeStep()) names.push_back(row.getColumn(0).getString());
  std::set<std::string> visited;
  const std::function<void(const std::string&)> visit = [&](const std::string& name) {
    if (!visited.insert(name).second) return;
    std::vector<std::string> parents;
    SQLite::Statement reference = bound(connection, "SELECT \"table\" FROM pragma_foreign_key_list(?)", name);
    while (reference.executeStep()) parents.push_back(reference.getColumn(0).getString());
    for (const std::string& parent : parents) visit(parent);
    ordered.push_back(name);
  };
  for (const std::string& name : names) visit(name);
  return ordered;
}

CopiedTable::CopiedTable(const std::string& name, SQLite::Database& source, SQLite::Database& into, RowNumbers& numbers)
    : name_(name), source_(source), into_(into), numbers_(numbers), number_column_(number_column(source, name)) {
  read_columns();
}

void CopiedTable::read_columns() {
  const std::set<std::string> known = column_names(into_, name_);
  for (const Column& column : columns_of(source_, name_))
    if (known.contains(column.name) && column.name != number_column_) columns_.push_back({column.name, {}});
  SQLite::Statement row = bound(
      source_, "SELECT \"from\", \"table\", coalesce(\"to\", '') FROM pragma_foreign_key_list(?) ORDER BY id", name_);
  while (row.executeStep()) {
    const std::string from = row.getColumn(0).getString(), parent = row.getColumn(1).getString(),
                      to = row.getColumn(2).getString();
    for (CopiedColumn& column : columns_)
      if (column.name == from)
        column.reference = Reference{parent, to, to.empty() || to == number_column(source_, parent)};
  }
  for (const CopiedColumn& column : columns_)
    if (!owner_ && column.reference && column.reference->parent != "provenance") owner_ = &column;
}

std::string CopiedTable::list() const {
  return joined(columns_, ", ", [](const CopiedColumn& column) { return quoted_name(column.name); });
}

/// Columns that tell one row from another, wherever it is.
std::vector<std::string> CopiedTable::identity() const {
  SQLite::Statement row =
      bound(source_,
            "SELECT column.name FROM (SELECT name FROM pragma_index_list(?) WHERE \"unique\" = 1 "
            "ORDER BY origin = 'u' DESC, seq LIMIT 1) AS first, pragma_index_info(first.name) AS column",
            name_);
  std::vector<std::string> names, all;
  for (const CopiedColumn& column : columns_) all.push_back(column.name);
  while (row.executeStep()) names.push_back(row.getColumn(0).getString());
  const bool of_columns = all_of(names, [&](const std::string& name) { return contains(all, name); });
  return names.empty() || !of_columns ? all : names;
}

bool CopiedTable::bind(SQLite::Statement& to, int index, const CopiedColumn& column, const SQLite::Column& value) {
  if (!column.reference || value.isNull()) {
    bind_value(to, index, value);
    return true;
  }
  const Reference& reference = *column.reference;
  if (reference.by_number) {
    const auto& parents = numbers_[reference.parent];
    const auto found = parents.find(value.getInt64());
    if (found == parents.end()) return false;
    to.bind(index, found->second);
    return true;
  }
  SQLite::Statement parent(
      into_, "SELECT 1 FROM " + quoted_name(reference.parent) + " WHERE " + quoted_name(reference.column) + " = ?");
  bind_value(parent, 1, value);
  bind_value(to, index, value);
  return parent.executeStep();
}

/// The row that `from` stands at, whose columns are list(); whether all it refers to is there.
bool CopiedTable::bind_row(SQLite::Statement& to, SQLite::Statement& from) {
  to.reset();
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (!bind(to, static_cast<int>(i) + 1, columns_[i], from.getColumn(static_cast<int>(i)))) return false;
  return true;
}

SQLite::Statement& CopiedTable::source_row(std::int64_t number) {
  if (!select_)
    select_.emplace(
        source_, "SELECT " + list() + " FROM " + quoted_name(name_) + " WHERE " + quoted_name(number_column_) + " = ?");
  select_->reset();
  select_->bind(1, number);
  select_->executeStep();
  return *select_;
}

std::optional<std::int64_t> CopiedTable::insert(SQLite::Statement& from) {
  if (!insert_) {
    const std::string values = joined(columns_, ", ", [](const CopiedColumn&) { return "?"; });
    insert_.emplace(into_, "INSERT INTO " + quoted_name(name_) + "(" + list() + ") VALUES (" + values + ")");
  }
  if (!bind_row(*insert_, from)) return std::nullopt;
  insert_->exec();
  insert_->reset();
  return into_.getLastInsertRowid();
}

void CopiedTable::add(std::int64_t number) {
  if (const auto row = insert(source_row(number))) numbers_[name_][number] = *row;
  select_->reset();
}

void CopiedTable::replace(std::int64_t number, std::int64_t row) {
  if (!update_) {
    const std::string values =
        joined(columns_, ", ", [](const CopiedColumn& column) { return quoted_name(column.name) + " = ?"; });
    update_.emplace(
        into_, "UPDATE " + quoted_name(name_) + " SET " + values + " WHERE " + quoted_name(number_column_) + " = ?");
  }
  bind_row(*update_, source_row(number));
  update_->bind(static_cast<int>(columns_.size()) + 1, row);
  update_->exec();
  update_->reset();
  select_->reset();
  keep(number, row);
}

void CopiedTable::keep(std::int64_t number, std::int64_t row) const { numbers_[name_][number] = row; }

void CopiedTable::copy_all(const std::string& condition) {
  if (columns_.empty()) return;  // the destination has no such table
  SQLite::Statement row(source_, "SELECT " + list() +
                                     (number_column_.empty() ? ", NULL" : ", " + quoted_name(number_column_)) +
                                     " FROM " + quoted_name(name_) + (condition.empty() ? "" : " WHERE " + condition));
  const int number = static_cast<int>(columns_.size());
  const auto keep_number = [&](std::int64_t there) {
    if (!number_column_.empty()) keep(row.getColumn(number).getInt64(), there);
  };
  if (owner_) {
    std::unordered_set<std::string> owners;
    SQLite::Statement present(into_, "SELECT DISTINCT " + quoted_name(owner_->name) + " FROM " + quoted_name(name_));
    while (present.executeStep()) owners.insert(present.getColumn(0).getString());
    SQLite::Statement translated(into_, "SELECT ?");
    const int owner = static_cast<int>(owner_ - columns_.data());
    while (row.executeStep()) {
      translated.reset();
      if (!bind(translated, 1, *owner_, row.getColumn(owner))) continue;
      translated.executeStep();
      if (owners.contains(translated.getColumn(0).getString())) continue;
      if (const auto there = insert(row)) keep_number(*there);
    }
    return;
  }
  const std::vector<std::string> names = identity();
  std::vector<int> at;
  for (const std::string& name : names)
    at.push_back(static_cast<int>(find_if(columns_, [&](const CopiedColumn& column) { return column.name == name; }) -
                                  columns_.begin()));
  SQLite::Statement same(
      into_, "SELECT " + (number_column_.empty() ? "1" : quoted_name(number_column_)) + " FROM " + quoted_name(name_) +
                 " WHERE " +
                 joined(names, " AND ", [](const std::string& name) { return quoted_name(name) + " IS ?"; }));
  while (row.executeStep()) {
    same.reset();
    bool complete = true;
    for (std::size_t i = 0; i < at.size(); ++i)
      complete &= bind(same, static_cast<int>(i) + 1, columns_[static_cast<std::size_t>(at[i])], row.getColumn(at[i]));
    if (!complete) continue;
    if (same.executeStep())
      keep_number(same.getColumn(0).getInt64());
    else if (const auto there = insert(row))
      keep_number(*there);
  }
}

}  // namespace rollres
