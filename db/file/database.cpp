#include "db/file/database.hpp"

#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/vfs.h>

#include <algorithm>
#include <array>
#include <thread>

#include "db/file/sqlite.hpp"

namespace rollres {

namespace {

constexpr int patience_in_ms = std::chrono::duration_cast<std::chrono::milliseconds>(Database::patience).count();

using Connection = std::unique_ptr<SQLite::Database>;

int number(SQLite::Database& connection, const std::string& query) { return connection.execAndGet(query).getInt(); }

/// File systems shared by machines, by the numbers of statfs(2): the shared memory of a write-ahead log is not shared.
bool on_network(const std::filesystem::path& file) {
  constexpr std::array<std::uint32_t, 9> network{0x6969 /*NFS*/,        0x517b /*SMB*/,        0xff534d42 /*CIFS*/,
                                                 0xfe534d42 /*SMB2*/,   0x0bd00bd0 /*Lustre*/, 0x47504653 /*GPFS*/,
                                                 0x19830326 /*BeeGFS*/, 0x00c36400 /*Ceph*/,   0x5346414f /*AFS*/};
  struct statfs system {};
  if (statfs(file.parent_path().c_str(), &system) != 0) return false;
  return std::find(network.begin(), network.end(), static_cast<std::uint32_t>(system.f_type)) != network.end();
}

/// The file as a URI that tells SQLite that nobody writes to it.
std::string immutable_uri(const std::filesystem::path& file) {
  std::string uri = "file:";
  for (const char letter : file.string()) {
    if (letter == '%' || letter == '?' || letter == '#') {
      constexpr char digits[] = "0123456789abcdef";
      uri += {'%', digits[letter >> 4], digits[letter & 15]};
    } else {
      uri += letter;
    }
  }
  return uri + "?immutable=1";
}

bool is_read_only(SQLite::Database& connection) { return sqlite3_db_readonly(connection.getHandle(), "main") == 1; }

/// SQLite opens a file that may not be written read-only. One that may is opened for writing all the same, though
/// nothing is written through it: otherwise a reader that is the last to close leaves the log behind. Where the log
/// cannot be made, there is none and nobody writes: the file is read as it stands.
Connection open_for_reading(const std::filesystem::path& file) {
  try {
    auto connection = std::make_unique<SQLite::Database>(file.string(), SQLite::OPEN_READWRITE, patience_in_ms);
    distrust(*connection);
    connection->exec("PRAGMA query_only = ON");
    connection->exec("PRAGMA schema_version");
    return connection;
  } catch (const SQLite::Exception& error) {
    const int code = error.getErrorCode();
    const bool log_impossible =
        code == SQLITE_CANTOPEN || code == SQLITE_READONLY || code == SQLITE_IOERR || code == SQLITE_FULL;
    const std::filesystem::path log = file.string() + "-wal";
    if (!log_impossible || !std::filesystem::exists(file) || std::filesystem::exists(log)) throw;
    auto connection = std::make_unique<SQLite::Database>(immutable_uri(file), SQLite::OPEN_READONLY | SQLite::OPEN_URI);
    distrust(*connection);
    return connection;
  }
}

Connection open_for_writing(const std::filesystem::path& file, const std::string& name) {
  auto connection =
      std::make_unique<SQLite::Database>(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, patience_in_ms);
  distrust(*connection);
  if (is_read_only(*connection)) throw std::runtime_error(name + ": the file is read-only");
  return connection;
}

enum class Found { nothing, ours };

/// Refuses a file that is not ours or that is newer than this program. Reads all of it in one state of the file, as
/// another process may just be creating it.
Found inspect(SQLite::Database& connection, const std::string& name, int newest) {
  SQLite::Savepoint one_state(connection, "inspection");
  const int application = number(connection, "PRAGMA application_id");
  const int version = number(connection, "PRAGMA user_version");
  const bool empty = number(connection, "SELECT count(*) FROM sqlite_schema") == 0;
  one_state.release();
  if (application == 0 && version == 0 && empty) return Found::nothing;
  if (application != Database::application_id)
    throw std::runtime_error(name + ": an SQLite database, but not one of rollres");
  if (version < 0) throw std::runtime_error(name + ": damaged: schema " + std::to_string(version));
  if (version > newest)
    throw std::runtime_error(name + ": written by a newer version of rollres (schema " + std::to_string(version) +
                             ", this one knows " + std::to_string(newest) + ")");
  return Found::ours;
}

/// Another connection that is just doing the same makes this fail at once, whatever the patience: try again.
void choose_journal(SQLite::Database& connection, const std::filesystem::path& file) {
  const std::string wanted = on_network(file) ? "delete" : "wal";
  for (int attempt = 0; attempt < 100; ++attempt) {
    if (connection.execAndGet("PRAGMA journal_mode").getString() == wanted) break;
    try {
      if (connection.execAndGet("PRAGMA journal_mode = " + wanted).getString() == wanted) break;
    } catch (const SQLite::Exception& error) {
      if (error.getErrorCode() != SQLITE_BUSY) throw;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  connection.exec("PRAGMA synchronous = FULL");
}

void migrate(SQLite::Database& connection, const std::string& name, std::span<const Migration> migrations) {
  const int newest = static_cast<int>(migrations.size());
  SQLite::Transaction transaction(connection, SQLite::TransactionBehavior::IMMEDIATE);
  inspect(connection, name, newest);  // again, as another process may have been faster
  for (int version = number(connection, "PRAGMA user_version"); version < newest; ++version)
    migrations[static_cast<std::size_t>(version)](connection);
  connection.exec("PRAGMA application_id = " + std::to_string(Database::application_id));
  connection.exec("PRAGMA user_version = " + std::to_string(newest));
  transaction.commit();
}

}  // namespace

void distrust(SQLite::Database& connection) {
  sqlite3* const handle = connection.getHandle();
  constexpr int off = 0, on = 1;
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, off, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, off, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, on, nullptr);
  sqlite3_limit(handle, SQLITE_LIMIT_ATTACHED, 0);
}

void vacuum(SQLite::Database& connection, const std::filesystem::path& into) {
  constexpr int the_copy = 1;
  sqlite3_limit(connection.getHandle(), SQLITE_LIMIT_ATTACHED, the_copy);
  SQLite::Statement statement(connection, into.empty() ? "VACUUM" : "VACUUM INTO ?");
  if (!into.empty()) statement.bind(1, into.string());
  statement.exec();
  sqlite3_limit(connection.getHandle(), SQLITE_LIMIT_ATTACHED, 0);
}

Database::Database(const std::filesystem::path& file, Access access, const Schema& schema) : name_(file.string()) {
  if (file.empty() || file.native().find('\0') != std::string::npos)
    throw std::invalid_argument("db = \"" + std::string(file.c_str()) + "\": must name a file");
  const int newest = static_cast<int>(schema.migrations.size());
  const std::filesystem::path place = std::filesystem::absolute(file);  // never a special name such as ":memory:"
  std::error_code none;
  // SQLite would wait for the other end of a pipe.
  if (std::filesystem::exists(place, none) && !std::filesystem::is_regular_file(place, none))
    throw std::runtime_error(name_ + ": not a regular file");
  if (std::filesystem::is_regular_file(place, none) && std::filesystem::file_size(place, none) == 1)
    throw std::runtime_error(name_ + ": file is not a database");  // SQLite takes a single byte for an empty file
  place_ = place;
  naming(name_, [&] {
    if (access == Access::read) {
      if (!std::filesystem::exists(place)) throw std::runtime_error(name_ + ": no such file");
      connection_ = open_for_reading(place);
      if (inspect(*connection_, name_, newest) == Found::nothing)
        throw std::runtime_error(name_ + ": an empty file, no database of rollres");
      if (number(*connection_, "PRAGMA user_version") < newest && !is_read_only(*connection_)) {
        connection_.reset();
        { Database migrated(file, Access::write, schema); }
        connection_ = open_for_reading(place);
      }
      return;
    }
    if (!std::filesystem::is_directory(place.parent_path(), none))
      throw std::runtime_error(name_ + ": there is no folder " + file.parent_path().string());
    connection_ = open_for_writing(place, name_);
    const Found found = inspect(*connection_, name_, newest);
    connection_->exec("PRAGMA foreign_keys = ON");
    choose_journal(*connection_, place);
    if (found == Found::nothing || number(*connection_, "PRAGMA user_version") < newest)
      migrate(*connection_, name_, schema.migrations);
    if (schema.complete) schema.complete(*connection_);
  });
  struct stat opened {};
  if (::stat(place_.c_str(), &opened) == 0) {
    device_ = opened.st_dev;
    inode_ = opened.st_ino;
  }
}

void Database::require_present() const {
  struct stat now {};
  if (::stat(place_.c_str(), &now) != 0 || now.st_dev != device_ || now.st_ino != inode_)
    throw std::runtime_error(name_ + ": was deleted or replaced while it was open; what it held is lost");
}

void Database::stop_when(const std::atomic<bool>& wish) {
  constexpr int steps = 10000;  // of SQLite's machine, less than a millisecond
  sqlite3_progress_handler(
      connection_->getHandle(), steps,
      [](void* stop) { return static_cast<const std::atomic<bool>*>(stop)->load() ? 1 : 0; },
      const_cast<std::atomic<bool>*>(&wish));
}

Database::Database(Database&&) noexcept = default;
Database& Database::operator=(Database&&) noexcept = default;
Database::~Database() = default;

}  // namespace rollres
