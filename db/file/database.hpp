#pragma once

/// A database file of rollres: an SQLite 3 file that is checked before it is used, and never overwritten.
///
/// The header of the file holds an application number and the version of its schema. A file of an older version is
/// brought to the present one by a list of migrations, in one transaction. Writers use a write-ahead log, so that
/// readers and one writer go on side by side; on a network file system, where that log does not work, a rollback
/// journal. Whoever finds the file locked waits up to `patience`. The log and its index (-wal, -shm) stand beside the
/// file while somebody has it open; the last to close removes them.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace SQLite {
class Database;
}

namespace rollres {

enum class Access { read, write };

/// Brings the tables from one version of the schema to the next; runs inside a transaction.
using Migration = void (*)(SQLite::Database&);

/// What the tables of a file are to be.
struct Schema {
  std::span<const Migration> migrations;  ///< from an empty file; the schema's version is their number
  Migration complete = nullptr;           ///< what every writer adds to a file of that version; none if null
};

class Database {
 public:
  static constexpr int application_id = 0x726f6c6c;  // "roll"
  static constexpr std::chrono::seconds patience{60};

  /// Opens `file`; with Access::write creates it if it is missing or empty. Either migrates it to `schema`, the present
  /// one of which `open_database` takes (schema.hpp); a reader who may not write it reads an older file as it is.
  /// @throws std::invalid_argument if `file` is empty
  /// @throws std::runtime_error naming the file: it is missing (read), damaged, of another program, written by a newer
  ///         version, read-only (write) or locked for longer than `patience`
  Database(const std::filesystem::path& file, Access access, const Schema& schema);
  Database(Database&&) noexcept;
  Database& operator=(Database&&) noexcept;
  ~Database();

  /// Name of the file as it was given, for messages.
  const std::string& name() const { return name_; }
  SQLite::Database& connection() const { return *connection_; }

  /// @throws std::runtime_error if the file was deleted or replaced since it was opened: SQLite would go on writing
  void require_present() const;

  /// As soon as `wish`, which must outlive this, is true, what runs and what comes fails with "interrupted".
  void stop_when(const std::atomic<bool>& wish);

 private:
  std::string name_;
  std::filesystem::path place_;
  std::uint64_t device_ = 0, inode_ = 0;
  std::unique_ptr<SQLite::Database> connection_;
};

}  // namespace rollres
