#include "db/file/database.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

std::string opening(const std::filesystem::path& file, Access access) {
  return message_of([&] { Database database = open_database(file, access); });
}

Evaluation evaluation(const RollingScene& scene) { return {evaluation_key(scene), scene, closed_form(scene)}; }

/// A database with so many evaluations, closed again.
void fill(const std::filesystem::path& file, int count) {
  ResultStore store(file);
  std::vector<Evaluation> all;
  for (int i = 0; i < count; ++i) all.push_back(evaluation(plain_scene(1.0 + i)));
  store.save(all);
}

}  // namespace

TEST_CASE("a new database carries the program's number and the version of its schema", "[db][database]") {
  const TemporaryDirectory folder;
  fill(folder.path / "a.db", 1);
  SQLite::Database plain((folder.path / "a.db").string());
  CHECK(plain.execAndGet("PRAGMA application_id").getInt() == Database::application_id);
  CHECK(plain.execAndGet("PRAGMA user_version").getInt() == static_cast<int>(schema_migrations().size()));
  CHECK(plain.execAndGet("PRAGMA integrity_check").getString() == "ok");
  CHECK(plain
            .execAndGet("SELECT count(*) FROM pragma_table_list WHERE type = 'table' AND NOT strict "
                        "AND name NOT LIKE 'sqlite_%'")
            .getInt() == 0);
}

TEST_CASE("a file that is no database of this program is refused and left as it was", "[db][database]") {
  const TemporaryDirectory folder;
  for (const std::string& text : {std::string("speed,load\n1,2\n"), std::string("x"), std::string(5000, 'z')}) {
    const auto file = folder.write("text.db", text);
    for (const Access access : {Access::read, Access::write})
      CHECK(opening(file, access) == file.string() + ": file is not a database");
    CHECK(file_text(file) == text);
  }

  const auto other = folder.path / "other.db";
  {
    SQLite::Database foreign(other.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    foreign.exec("CREATE TABLE photograph(name TEXT)");
  }
  const std::string before = file_text(other);
  for (const Access access : {Access::read, Access::write})
    CHECK(opening(other, access) == other.string() + ": an SQLite database, but not one of rollres");
  CHECK(file_text(other) == before);

  CHECK(opening(folder.path / "none.db", Access::read) == (folder.path / "none.db").string() + ": no such file");
  CHECK_FALSE(std::filesystem::exists(folder.path / "none.db"));
  CHECK(opening(folder.path / "no/folder.db", Access::write) ==
        (folder.path / "no/folder.db").string() + ": there is no folder " + (folder.path / "no").string());
  CHECK(opening(folder.path / "", Access::write) == (folder.path / "").string() + ": not a regular file");
  CHECK(opening("", Access::write) == "db = \"\": must name a file");
  CHECK(opening(std::string("a.db\0b", 6), Access::write) == "db = \"a.db\": must name a file");
  folder.write("empty.db", "");
  CHECK(opening(folder.path / "empty.db", Access::read) ==
        (folder.path / "empty.db").string() + ": an empty file, no database of rollres");
}

TEST_CASE("a database of a newer schema is refused and left as it was", "[db][database]") {
  const TemporaryDirectory folder;
  const auto file = folder.path / "newer.db";
  fill(file, 1);
  {
    SQLite::Database plain(file.string(), SQLite::OPEN_READWRITE);
    plain.exec("PRAGMA user_version = 999");
  }
  const std::string before = file_text(file);
  for (const Access access : {Access::read, Access::write})
    CHECK(opening(file, access) == file.string() +
                                       ": written by a newer version of rollres (schema 999, this one knows " +
                                       std::to_string(schema_migrations().size()) + ")");
  CHECK(file_text(file) == before);
}

TEST_CASE("a damaged database is reported with its name and SQLite's words", "[db][database]") {
  const TemporaryDirectory folder;
  const auto file = folder.path / "damaged.db";
  fill(file, 200);
  std::string bytes = file_text(file);
  REQUIRE(bytes.size() > 65536);
  bytes.replace(8192, bytes.size() - 8192, bytes.size() - 8192, '\x5a');
  folder.write("damaged.db", bytes);
  const std::string message = message_of([&] {
    ResultStore store(file);
    fill(file, 400);
    for (std::int64_t id = 1; id <= 200; ++id) store.find(id);
  });
  CHECK(message == file.string() + ": database disk image is malformed");
}

TEST_CASE("a read-only database is read, and refused for writing", "[db][database]") {
  const TemporaryDirectory folder;
  const auto file = folder.path / "archive/a.db";
  std::filesystem::create_directory(folder.path / "archive");
  fill(file, 3);
  chmod(folder.path.c_str(), 0755);
  chmod(file.c_str(), 0444);
  chmod((folder.path / "archive").c_str(), 0555);
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && seteuid(65534) != 0) _exit(9);  // root may write everything
    int wrong = 0;
    if (opening(file, Access::write) != file.string() + ": the file is read-only") wrong |= 1;
    if (message_of([&] {
          if (!ResultStore(file, Access::read).find(std::int64_t{3})) throw std::runtime_error("row is missing");
        }) != "nothing")
      wrong |= 2;
    _exit(wrong);
  }
  int status = 0;
  waitpid(child, &status, 0);
  chmod((folder.path / "archive").c_str(), 0755);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("an older schema is migrated once, also by a reader, and keeps its rows", "[db][database]") {
  const TemporaryDirectory folder;
  const auto file = folder.path / "older.db";
  fill(file, 5);
  const Migration next = [](SQLite::Database& connection) {
    connection.exec("CREATE TABLE novelty(id INTEGER PRIMARY KEY, name TEXT NOT NULL) STRICT");
  };
  std::vector<Migration> longer(schema_migrations().begin(), schema_migrations().end());
  longer.push_back(next);
  for (const Access access : {Access::read, Access::write, Access::read}) {
    Database database(file, access, {longer, add_missing_columns});
    CHECK(database.connection().execAndGet("SELECT count(*) FROM novelty").getInt() == 0);
    CHECK(database.connection().execAndGet("SELECT count(*) FROM evaluation").getInt() == 5);
    CHECK(database.connection().execAndGet("PRAGMA user_version").getInt() == static_cast<int>(longer.size()));
  }
  const Migration broken = [](SQLite::Database& connection) {
    connection.exec("CREATE TABLE half(id INTEGER) STRICT");
    connection.exec("nonsense");
  };
  longer.push_back(broken);
  CHECK(message_of([&] {
          Database(file, Access::write, {longer, add_missing_columns});
        }).starts_with(file.string() + ": near \"nonsense\""));
  SQLite::Database plain(file.string());
  CHECK_FALSE(plain.tableExists("half"));
  CHECK(plain.execAndGet("PRAGMA user_version").getInt() == static_cast<int>(longer.size()) - 1);
}

TEST_CASE("a database that lacks columns of newer quantities gets them, and its rows are still read",
          "[db][database]") {
  const TemporaryDirectory folder;
  const auto file = folder.path / "narrow.db";
  fill(file, 2);
  {
    SQLite::Database plain(file.string(), SQLite::OPEN_READWRITE);
    plain.exec("ALTER TABLE evaluation DROP COLUMN mean_pressure");
    plain.exec("ALTER TABLE evaluation DROP COLUMN stiffening");
  }
  {
    ResultStore reader(file, Access::read);
    const auto row = reader.find(std::int64_t{1});
    REQUIRE(row);
    CHECK(std::isnan(row->solution.mean_pressure));
    CHECK(row->scene.stiffening == 0);
    CHECK(row->scene.creep_time == 0.1);
  }
  fill(file, 3);
  ResultStore store(file);
  CHECK(store.find(std::int64_t{1})->solution.rolling_resistance == closed_form(plain_scene(1)).rolling_resistance);
  CHECK(store.find(std::int64_t{3})->scene.stiffening == 2);
  CHECK(columns_of(store.database().connection(), "result").size() ==
        columns_of(store.database().connection(), "evaluation").size() + point_columns.size());  // study, position, variant
}

TEST_CASE("processes that create one database at the same moment all get it", "[db][database]") {
  const TemporaryDirectory folder;
  for (int round = 0; round < thinned(12); ++round) {
    const auto file = folder.path / std::to_string(round);
    int gate[2];
    REQUIRE(pipe(gate) == 0);
    std::vector<pid_t> children;
    for (int i = 0; i < 4; ++i) {
      children.push_back(fork());
      if (children.back() != 0) continue;
      close(gate[1]);
      char letter = 0;
      const bool opened = read(gate[0], &letter, 1) == 0;  // when the parent closes its end
      const std::string message = message_of([&] { fill(file, 1 + i); });
      if (message != "nothing") std::fprintf(stderr, "child: %s\n", message.c_str());
      _exit(opened && message == "nothing" ? 0 : 1);
    }
    close(gate[0]);
    close(gate[1]);
    for (const pid_t child : children) {
      int status = 0;
      waitpid(child, &status, 0);
      CHECK(status == 0);
    }
    CHECK(ResultStore(file, Access::read).find(std::int64_t{4}));
    CHECK_FALSE(ResultStore(file, Access::read).find(std::int64_t{5}));
  }
}
