#include "db/merge/merge.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <unordered_set>

#include "db/file/sqlite.hpp"
#include "db/merge/copied_table.hpp"
#include "db/merge/readable_source.hpp"
#include "db/rows/schema.hpp"

namespace rollres {

namespace {

struct Output {
  std::string name;
  bool relative = false;  // unit 1
};

/// Refuses a column that no version of rollres would give a table: its names are those of quantities.
void require_quantity(const std::string& table, const Column& column) {
  constexpr std::size_t longest = 64;
  const bool named = !column.name.empty() && column.name.size() <= longest && column.name[0] >= 'a' &&
                     column.name[0] <= 'z' &&
                     column.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
  const bool typed = column.type == "REAL" || column.type == "INTEGER" || column.type == "TEXT";
  if (named && typed) return;
  const std::string text = "table " + table + ": column \"" + column.name.substr(0, longest) + "\"";
  throw std::invalid_argument(named ? text + " is " + column.type.substr(0, longest) + ": must be REAL, INTEGER or TEXT"
                                    : text + ": must have a name of at most 64 of a-z, 0-9 and _, a letter first");
}

/// Real outputs that two solutions of one scene have in common.
std::vector<Output> compared_outputs(SQLite::Database& one, SQLite::Database& other) {
  const std::set<std::string> present = column_names(one, "evaluation");
  std::vector<Output> outputs;
  for (const Column& column : columns_of(other, "evaluation")) {
    const QuantityColumn* const known = find_quantity_column(column.name);
    if (known && !known->is_input && known->type == "REAL" && known->name != "seconds" && present.contains(known->name))
      outputs.push_back({known->name, known->quantity.unit == "1"});
  }
  return outputs;
}

/// Difference over what rounding may make of it: 1 is the most.
double excess(const Output& output, const SQLite::Column& kept, const SQLite::Column& other) {
  if (kept.isNull() != other.isNull()) return std::numeric_limits<double>::infinity();
  if (kept.isNull() || kept.getDouble() == other.getDouble()) return 0;
  const double a = kept.getDouble(), b = other.getDouble();
  const double scale = std::max({std::abs(a), std::abs(b), output.relative ? 1.0 : 0.0});
  return std::abs(a - b) / (merge_tolerance * scale);
}

/// The part of a merge that knows of evaluations and studies.
class Merge {
 public:
  Merge(SQLite::Database& into, SQLite::Database& source, const std::optional<std::string>& study)
      : into_(into), source_(source), study_(study) {}

  MergeReport run() {
    add_missing_columns_of_source();
    for (const std::string& table : tables_by_reference(source_)) {
      CopiedTable copied(table, source_, into_, ids_);
      if (table == "evaluation")
        copy_evaluations(copied);
      else if (table == "study")
        copy_studies(copied);
      else if (!study_ || copied.owned())
        copied.copy_all();
      else if (table == "provenance")
        copied.copy_all("id IN (SELECT provenance FROM evaluation WHERE " + of_study() + ")");
    }
    return std::move(report_);
  }

 private:
  std::string of_study() const {
    return "key IN (SELECT key FROM study_point JOIN study ON study.id = study WHERE name = " + quoted_text(*study_) +
           ")";
  }

  /// A source written by a program with more quantities.
  void add_missing_columns_of_source() {
    const std::set<std::string> present = column_names(into_, "evaluation");
    for (const Column& column : columns_of(source_, "evaluation")) {
      if (present.contains(column.name)) continue;
      require_quantity("evaluation", column);
      into_.exec("ALTER TABLE evaluation ADD COLUMN " + quoted_name(column.name) + " " + column.type);
    }
  }

  void copy_evaluations(CopiedTable& table) {
    const std::vector<Output> outputs = compared_outputs(into_, source_);
    std::string list = "id, status IS 'converged'";
    for (const Output& output : outputs) list += ", " + output.name;
    SQLite::Statement there(into_, "SELECT " + list + " FROM evaluation WHERE key = ?");
    SQLite::Statement here(source_, "SELECT " + list + ", key FROM evaluation" +
                                        (study_ ? " WHERE " + of_study() : std::string()) + " ORDER BY id");
    const int key_column = static_cast<int>(outputs.size()) + 2;
    while (here.executeStep()) {
      ++report_.evaluations;
      const std::int64_t source_id = here.getColumn(0).getInt64();
      const std::string key = here.getColumn(key_column).getString();
      there.reset();
      there.bind(1, key);
      if (!there.executeStep()) {
        table.add(source_id);
        ++report_.added;
        continue;
      }
      const std::int64_t id = there.getColumn(0).getInt64();
      const bool kept_converged = there.getColumn(1).getInt() == 1, other_converged = here.getColumn(1).getInt() == 1;
      if (kept_converged && other_converged) compare(outputs, there, here, key);
      there.reset();
      if (!kept_converged && other_converged) {
        table.replace(source_id, id);
        ++report_.replaced;
      } else {
        table.keep(source_id, id);
      }
    }
  }

  void compare(const std::vector<Output>& outputs, SQLite::Statement& there, SQLite::Statement& here,
               const std::string& key) {
    double worst = 1;
    MergeConflict conflict{key, "", 0, 0};
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const SQLite::Column kept = there.getColumn(static_cast<int>(i) + 2),
                           other = here.getColumn(static_cast<int>(i) + 2);
      const double found = excess(outputs[i], kept, other);
      if (!(found > worst)) continue;
      worst = found;
      const auto value = [](const SQLite::Column& column) {
        return column.isNull() ? std::nan("") : column.getDouble();
      };
      conflict = {key, outputs[i].name, value(kept), value(other)};
    }
    if (!conflict.column.empty()) report_.conflicts.push_back(conflict);
  }

  using Keys = std::unordered_set<std::string>;

  static Keys points_of(SQLite::Database& connection, std::int64_t study) {
    SQLite::Statement row = bound(connection, "SELECT key FROM study_point WHERE study = ?", study);
    Keys keys;
    while (row.executeStep()) keys.insert(row.getColumn(0).getString());
    return keys;
  }

  static std::string definition_of(SQLite::Database& connection, std::int64_t study) {
    SQLite::Statement row = bound(connection, "SELECT definition FROM study WHERE id = ?", study);
    row.executeStep();
    return row.getColumn(0).getString();
  }

  /// Whether a study of the destination is the one of the source: defined alike, or one has all points of the other.
  bool are_same(std::int64_t there, std::int64_t here) {
    if (definition_of(into_, there) == definition_of(source_, here)) return true;
    const Keys kept = points_of(into_, there), other = points_of(source_, here);
    const Keys &fewer = kept.size() < other.size() ? kept : other, &more = kept.size() < other.size() ? other : kept;
    return all_of(fewer, [&](const std::string& key) { return more.contains(key); });
  }

  /// Where a study of the source belongs: a row of the destination, or a name that is free there.
  struct Place {
    std::string name;
    std::optional<std::int64_t> row;
  };
  Place place_of(std::int64_t here, const std::string& name) {
    SQLite::Statement there(into_, "SELECT id FROM study WHERE name = ?");
    for (int version = 1;; ++version) {
      const std::string candidate = version == 1 ? name : name + " " + std::to_string(version);
      there.reset();
      there.bind(1, candidate);
      if (!there.executeStep()) return {candidate, {}};
      const std::int64_t row = there.getColumn(0).getInt64();
      if (are_same(row, here)) return {candidate, row};
    }
  }

  void name_study(const std::string& name, const std::string& other) {
    bound(into_, "UPDATE study SET name = ? WHERE name = ?", other, name).exec();
  }

  /// Does what writes a row under the source's name, and leaves it under another one.
  void named(const std::string& name, const std::string& other, const std::function<void()>& write) {
    if (name == other) return write();
    const std::string aside = name + "\n";  // no name of a study
    name_study(other, name + "\n\n");
    name_study(name, aside);
    name_study(name + "\n\n", name);
    write();
    name_study(name, other);
    name_study(aside, name);
  }

  void take_over(CopiedTable& table, std::int64_t source_id, std::int64_t id, const std::string& name,
                 const std::string& started, const std::string& created) {
    SQLite::Statement there = bound(into_, "SELECT started, created, name FROM study WHERE id = ?", id);
    there.executeStep();
    const bool later = started > there.getColumn(0).getString();
    const std::string first_created = std::min(there.getColumn(1).getString(), created);
    const std::string kept_name = there.getColumn(2).getString();
    there.reset();
    if (later) {
      bound(into_, "DELETE FROM study_point WHERE study = ?", id).exec();
      named(name, kept_name, [&] { table.replace(source_id, id); });
      ++report_.studies;
    } else {
      table.keep(source_id, id);
    }
    bound(into_, "UPDATE study SET created = ? WHERE id = ? AND created <> ?", first_created, id, first_created).exec();
  }

  void copy_studies(CopiedTable& table) {
    SQLite::Statement here(source_, "SELECT id, name, started, created FROM study" +
                                        (study_ ? " WHERE name = " + quoted_text(*study_) : std::string()));
    bool found = false;
    while (here.executeStep()) {
      found = true;
      const std::int64_t source_id = here.getColumn(0).getInt64();
      const std::string name = here.getColumn(1).getString();
      const Place place = place_of(source_id, name);
      if (place.name != name) report_.renamed.emplace_back(name, place.name);
      if (place.row) {
        take_over(table, source_id, *place.row, name, here.getColumn(2).getString(), here.getColumn(3).getString());
        continue;
      }
      named(name, place.name, [&] { table.add(source_id); });
      ++report_.studies;
    }
    if (study_ && !found) throw std::invalid_argument("study = " + *study_ + ": there is no such study");
  }

  SQLite::Database& into_;
  SQLite::Database& source_;
  const std::optional<std::string>& study_;
  RowNumbers ids_;
  MergeReport report_;
};

}  // namespace

MergeReport merge(const Database& into, const std::filesystem::path& source, const std::optional<std::string>& study) {
  std::error_code none;
  if (std::filesystem::equivalent(into.name(), source, none))
    throw std::invalid_argument(source.string() + ": cannot be merged into itself");
  const ReadableSource readable(source);
  const Database& from = readable.database();
  // One state of the source, until the end.
  const auto one_state = naming(source.string(), [&] {
    auto transaction = std::make_unique<SQLite::Transaction>(from.connection());
    from.connection().execAndGet("PRAGMA schema_version");
    return transaction;
  });
  const std::string both = source.string() + " into " + into.name();
  try {
    return naming(both, [&] {
      SQLite::Transaction transaction(into.connection(), SQLite::TransactionBehavior::IMMEDIATE);
      MergeReport report = Merge(into.connection(), from.connection(), study).run();
      transaction.commit();
      return report;
    });
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(source.string() + ": " + error.what());
  }
}

void extract_study(const std::filesystem::path& source, const std::string& study, const std::filesystem::path& file) {
  const std::filesystem::path part = file.string() + ".part";
  const auto remove_part = [&] {
    std::error_code none;
    for (const char* const ending : {"", "-wal", "-shm", "-journal"})
      std::filesystem::remove(part.string() + ending, none);
  };
  remove_part();
  try {
    {
      const Database extract = open_database(part, Access::write);
      merge(extract, source, study);
      naming(file.string(), [&] { extract.connection().exec("PRAGMA journal_mode = delete"); });
    }
    std::filesystem::rename(part, file);
  } catch (...) {
    remove_part();
    throw;
  }
}

}  // namespace rollres
