#pragma once

/// Rows of a table on their way from one database to another, where row numbers differ. For sources only.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "db/file/sqlite.hpp"

namespace rollres {

/// For each table, by the number of a row in the source, the number of the same row in the destination.
using RowNumbers = std::map<std::string, std::unordered_map<std::int64_t, std::int64_t>>;

/// Tables of a database, those that others refer to before those.
std::vector<std::string> tables_by_reference(SQLite::Database& connection);

/// One table of both databases; columns that the destination lacks are left out. References to numbered rows are
/// translated by `numbers`, which must hold the tables referred to.
class CopiedTable {
 public:
  CopiedTable(const std::string& name, SQLite::Database& source, SQLite::Database& into, RowNumbers& numbers);

  /// Whether its rows belong to rows of another table (other than provenance): the first they refer to.
  bool owned() const { return owner_ != nullptr; }

  void add(std::int64_t source_row);                           ///< as a new row
  void replace(std::int64_t source_row, std::int64_t row);     ///< over an old one, which keeps its number
  void keep(std::int64_t source_row, std::int64_t row) const;  ///< it is the same as that one
  /// Adds rows that the destination lacks: of an owned table, if it has none with the same owner; otherwise those whose
  /// UNIQUE columns it does not have. Rows that refer to what was not copied are left out.
  /// @param condition  SQL; empty: all rows
  void copy_all(const std::string& condition = "");

 private:
  struct Reference {
    std::string parent;
    std::string column;  ///< of the parent, if it is not the row's number
    bool by_number = false;
  };
  struct CopiedColumn {
    std::string name;
    std::optional<Reference> reference;
  };

  void read_columns();
  std::vector<std::string> identity() const;
  bool bind(SQLite::Statement& to, int index, const CopiedColumn& column, const SQLite::Column& value);
  bool bind_row(SQLite::Statement& to, SQLite::Statement& from);
  SQLite::Statement& source_row(std::int64_t number);
  std::optional<std::int64_t> insert(SQLite::Statement& from);
  std::string list() const;

  std::string name_;
  SQLite::Database& source_;
  SQLite::Database& into_;
  RowNumbers& numbers_;
  std::string number_column_;  ///< INTEGER PRIMARY KEY; empty if there is none
  std::vector<CopiedColumn> columns_;
  const CopiedColumn* owner_ = nullptr;
  std::optional<SQLite::Statement> select_, insert_, update_;
};

}  // namespace rollres
