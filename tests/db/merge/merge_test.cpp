#include "db/merge/merge.hpp"

#include <SQLiteCpp/SQLiteCpp.h>

#include "db/file/provenance.hpp"
#include "db/file/sql_text.hpp"
#include "db/file/sqlite.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers copied_table and readable_source, too.

using namespace rollres;

namespace {

Evaluation evaluation_at(double speed) {
  const RollingScene scene = plain_scene(speed);
  return {evaluation_key(scene), scene, closed_form(scene)};
}

Evaluation failed_at(double speed) {
  Evaluation evaluation = evaluation_at(speed);
  evaluation.solution.status = Status::not_converged;
  evaluation.solution.reason = "singular matrix";
  return evaluation;
}

void fill(const std::filesystem::path& file, const std::vector<Evaluation>& evaluations, const std::string& study = "",
          const std::vector<double>& speeds = {}) {
  ResultStore store(file);
  store.save(evaluations);
  std::vector<std::string> keys;
  for (const double speed : speeds) keys.push_back(evaluation_at(speed).key);
  if (!study.empty())
    store.start_study({study, {"speed"}, "{\"speeds\": " + std::to_string(speeds.size()) + "}"}, keys);
}

MergeReport merge_into(const std::filesystem::path& file, const std::filesystem::path& source) {
  return merge(open_database(file, Access::write), source);
}

/// Everything that stands in a file, as text.
std::string dump(const std::filesystem::path& file) {
  SQLite::Database plain(file.string());
  std::string text;
  for (const char* const table : {"provenance", "study", "study_point", "evaluation"}) {
    SQLite::Statement row(plain, std::string("SELECT * FROM ") + table);
    while (row.executeStep())
      for (int column = 0; column < row.getColumnCount(); ++column) text += row.getColumn(column).getString() + "|";
  }
  return text;
}

void execute(const std::filesystem::path& file, const std::string& sql) {
  SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec(sql);
}

int count(const std::filesystem::path& file, const std::string& sql) {
  return SQLite::Database(file.string()).execAndGet(sql).getInt();
}

}  // namespace

TEST_CASE("databases merged hold each evaluation once, with its study and what computed it", "[db][merge]") {
  const TemporaryDirectory folder;
  const std::vector<double> speeds{1, 2, 3, 4, 5};
  fill(folder / "1", {evaluation_at(1), evaluation_at(2), evaluation_at(3)}, "speeds", speeds);
  fill(folder / "2", {evaluation_at(3), evaluation_at(4)}, "speeds", speeds);
  execute(folder / "2", "UPDATE provenance SET machine = 'another'");
  const MergeReport one = merge_into(folder / "all", folder / "1"), two = merge_into(folder / "all", folder / "2");
  CHECK(one.evaluations == 3);
  CHECK(one.added == 3);
  CHECK(one.studies == 1);
  CHECK(two.evaluations == 2);
  CHECK(two.added == 1);
  ResultStore all(folder / "all", Access::read);
  CHECK(all.study("speeds")->points == 5);
  CHECK(all.study("speeds")->answered == 4);
  CHECK(all.find(evaluation_at(3).key)->provenance == this_program());
  CHECK(all.find(evaluation_at(4).key)->provenance.machine == "another");
  CHECK(all.find(evaluation_at(4).key)->solution.rolling_resistance == closed_form(plain_scene(4)).rolling_resistance);
}

TEST_CASE("merging again changes nothing, and the sources are only read", "[db][merge]") {
  const TemporaryDirectory folder;
  fill(folder / "1", {evaluation_at(1), failed_at(2)}, "speeds", {1, 2, 3});
  fill(folder / "2", {evaluation_at(2), evaluation_at(3)}, "speeds", {1, 2, 3, 4});
  const std::string first = dump(folder / "1"), second = dump(folder / "2");
  for (const char* const source : {"1", "2"}) merge_into(folder / "all", folder / source);
  const std::string once = dump(folder / "all");
  for (const char* const source : {"2", "1", "1"}) {
    const MergeReport again = merge_into(folder / "all", folder / source);
    CHECK(again.added + again.replaced + again.studies + again.conflicts.size() == 0);
  }
  CHECK(dump(folder / "all") == once);
  CHECK(dump(folder / "1") == first);
  CHECK(dump(folder / "2") == second);
}

TEST_CASE("a converged result takes the place of a failed one, not the other way round", "[db][merge]") {
  const TemporaryDirectory folder;
  fill(folder / "good", {evaluation_at(1), evaluation_at(2)});
  fill(folder / "bad", {failed_at(1), failed_at(2), failed_at(3)});
  CHECK(merge_into(folder / "bad", folder / "good").replaced == 2);
  CHECK(merge_into(folder / "bad", folder / "good").replaced == 0);
  fill(folder / "bad again", {failed_at(1), failed_at(3)});
  const MergeReport report = merge_into(folder / "good", folder / "bad again");
  CHECK(report.replaced == 0);
  CHECK(report.added == 1);
  CHECK(ResultStore(folder / "bad").find(evaluation_at(1).key)->solution.status == Status::converged);
  CHECK(ResultStore(folder / "good").find(evaluation_at(1).key)->solution.status == Status::converged);
  CHECK(ResultStore(folder / "good").find(evaluation_at(3).key)->solution.reason == "singular matrix");
}

TEST_CASE("converged results that differ by more than rounding are a conflict, and the first stays", "[db][merge]") {
  const TemporaryDirectory folder;
  Evaluation same = evaluation_at(1), other = evaluation_at(2), slower = evaluation_at(3);
  same.solution.rolling_resistance *= 1 + 1e-11;
  same.solution.law_violation = 1e-13;
  other.solution.rolling_resistance *= 1.001;
  slower.solution.seconds = 100;
  Evaluation first = evaluation_at(1);
  first.solution.law_violation = 3e-16;
  fill(folder / "a", {first, evaluation_at(2), evaluation_at(3)});
  fill(folder / "b", {same, other, slower});
  const MergeReport report = merge_into(folder / "a", folder / "b");
  REQUIRE(report.conflicts.size() == 1);
  CHECK(report.conflicts[0].key == other.key);
  CHECK(report.conflicts[0].column == "rolling_resistance");
  CHECK(report.conflicts[0].kept == evaluation_at(2).solution.rolling_resistance);
  CHECK(report.conflicts[0].other == other.solution.rolling_resistance);
  CHECK(ResultStore(folder / "a").find(other.key)->solution.rolling_resistance == report.conflicts[0].kept);
}

TEST_CASE("of two studies of one name the one started last is kept, whatever the order of merging", "[db][merge]") {
  const TemporaryDirectory folder;
  fill(folder / "old", {evaluation_at(1)}, "speeds", {1, 2});
  execute(folder / "old", "UPDATE study SET created = '2013-05-01T12:00:00.000Z', started = created");
  fill(folder / "new", {evaluation_at(3)}, "speeds", {1, 2, 3});
  for (const auto& order : {std::pair{"old", "new"}, std::pair{"new", "old"}}) {
    const auto all = folder / (std::string("all ") + order.first);
    merge_into(all, folder / order.first);
    merge_into(all, folder / order.second);
    ResultStore store(all, Access::read);
    CHECK(store.study("speeds")->points == 3);
    CHECK(store.study("speeds")->answered == 2);
    CHECK(store.study("speeds")->created == "2013-05-01T12:00:00.000Z");
    CHECK(store.definition("speeds") == "{\"speeds\": 3}");
  }
}

TEST_CASE("tables that refer to evaluations, studies or each other come along, whatever they are", "[db][merge]") {
  const TemporaryDirectory folder;
  const char* const tables = R"(
    CREATE TABLE note(id INTEGER PRIMARY KEY, evaluation INTEGER NOT NULL REFERENCES evaluation, text TEXT) STRICT;
    CREATE TABLE picture(key TEXT PRIMARY KEY REFERENCES evaluation(key), bytes BLOB) STRICT;
    CREATE TABLE model(id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE) STRICT;
    CREATE TABLE model_parameter(model INTEGER NOT NULL REFERENCES model ON DELETE CASCADE, position INTEGER NOT NULL,
                                 value REAL, PRIMARY KEY(model, position)) STRICT, WITHOUT ROWID;)";
  fill(folder / "a", {evaluation_at(1)});
  fill(folder / "b", {evaluation_at(2), evaluation_at(1)});
  for (const char* const file : {"a", "b"}) execute(folder / file, tables);
  execute(folder / "a", "INSERT INTO model VALUES (1, 'first'); INSERT INTO model_parameter VALUES (1, 1, 0.5)");
  execute(folder / "b", R"(
    INSERT INTO note VALUES (1, 1, 'of speed 2'), (2, 2, 'of speed 1');
    INSERT INTO picture SELECT key, x'000102' FROM evaluation;
    INSERT INTO model VALUES (1, 'second'), (2, 'first');
    INSERT INTO model_parameter VALUES (1, 1, 7), (2, 1, 8), (2, 2, 9);)");
  for (int i = 0; i < 2; ++i) merge_into(folder / "a", folder / "b");
  const auto text_of = [&](const std::string& speed) {
    return SQLite::Database((folder / "a").string())
        .execAndGet("SELECT text FROM note JOIN evaluation ON evaluation.id = evaluation WHERE speed = " + speed)
        .getString();
  };
  CHECK(count(folder / "a", "SELECT count(*) FROM note") == 2);
  CHECK(text_of("2") == "of speed 2");
  CHECK(text_of("1") == "of speed 1");
  CHECK(count(folder / "a", "SELECT count(*) FROM picture WHERE bytes = x'000102'") == 2);
  CHECK(count(folder / "a", "SELECT count(*) FROM model") == 2);
  CHECK(count(folder / "a", "SELECT count(*) FROM model_parameter JOIN model ON id = model WHERE name = 'first'") == 1);
  CHECK(count(folder / "a", "SELECT value FROM model_parameter JOIN model ON id = model WHERE name = 'second'") == 7);
}

TEST_CASE("a source that cannot be read leaves the database as it was", "[db][merge]") {
  const TemporaryDirectory folder;
  fill(folder / "all", {evaluation_at(1)});
  std::vector<Evaluation> many;
  for (int i = 0; i < 200; ++i) many.push_back(evaluation_at(2 + i));
  fill(folder / "damaged", many);
  {
    std::fstream file(folder / "damaged", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(40 * 1024);
    file << std::string(60 * 1024, 'x');
  }
  folder.write("text", "no database");
  const std::string before = dump(folder / "all");
  for (const char* const source : {"damaged", "text", "missing"}) {
    const std::string message = message_of([&] { merge_into(folder / "all", folder / source); });
    CHECK(message.find((folder / source).string()) == 0);
    CHECK(dump(folder / "all") == before);
  }
  CHECK(message_of([&] { merge_into(folder / "all", folder / "all"); }).find("into itself") != std::string::npos);
}

TEST_CASE("one study is taken out of a database with what belongs to it and nothing else", "[db][merge]") {
  const TemporaryDirectory folder;
  fill(folder / "all", {evaluation_at(1), evaluation_at(2), evaluation_at(3)}, "slow", {1, 2});
  fill(folder / "all", {}, "quick's", {2, 3, 4});
  extract_study(folder / "all", "quick's", folder / "one");
  CHECK(count(folder / "one", "SELECT count(*) FROM evaluation") == 2);
  CHECK(count(folder / "one", "SELECT count(*) FROM study") == 1);
  CHECK(count(folder / "one", "SELECT count(*) FROM study_point") == 3);
  CHECK(count(folder / "one", "SELECT count(*) FROM provenance") == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "one-wal"));
  CHECK(message_of([&] { extract_study(folder / "all", "none", folder / "two"); }).find("no such study") !=
        std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "two"));
  CHECK_FALSE(std::filesystem::exists(folder / "two.part"));
}

TEST_CASE("a study of the same name with other points is kept beside the first", "[db][merge]") {
  const TemporaryDirectory folder;
  fill(folder / "1", {evaluation_at(1)}, "speeds", {1, 2});
  fill(folder / "2", {evaluation_at(3)}, "speeds", {1, 3, 4});
  for (int i = 0; i < 2; ++i) {
    merge_into(folder / "all", folder / "1");
    const MergeReport report = merge_into(folder / "all", folder / "2");
    CHECK(report.renamed == std::vector<std::pair<std::string, std::string>>{{"speeds", "speeds 2"}});
    CHECK(report.studies == (i == 0 ? 1 : 0));
  }
  ResultStore all(folder / "all", Access::read);
  REQUIRE(all.studies().size() == 2);
  CHECK(all.points("speeds") == std::vector{evaluation_at(1).key, evaluation_at(2).key});
  CHECK(all.points("speeds 2") == std::vector{evaluation_at(1).key, evaluation_at(3).key, evaluation_at(4).key});
  // Another start of the second, with one point more, goes to the second.
  fill(folder / "2", {}, "speeds", {1, 3, 4, 5});
  CHECK(merge_into(folder / "all", folder / "2").studies == 1);
  CHECK(all.points("speeds 2").size() == 4);
  CHECK(all.points("speeds").size() == 2);
}

TEST_CASE("names of tables and columns of a stranger's file are names, never SQL", "[db][merge]") {
  const TemporaryDirectory folder;
  const std::string planted = (folder / "planted").string();
  const std::string hostile = "x\" TEXT; COMMIT; ATTACH '" + planted + "' AS w; CREATE TABLE w.t(a); BEGIN; --";
  fill(folder / "all", {evaluation_at(1)});
  for (const std::string& name : {hostile, std::string("Speed of it"), std::string("_x"), std::string(65, 'a')}) {
    const auto source = folder / "source";
    std::filesystem::remove(source);
    fill(source, {evaluation_at(2)});
    execute(source, "ALTER TABLE evaluation ADD COLUMN " + quoted_name(name) + " TEXT");
    const std::string before = dump(folder / "all"), message = message_of([&] { merge_into(folder / "all", source); });
    CHECK(message == source.string() + ": table evaluation: column \"" + name.substr(0, 64) +
                         "\": must have a name of at most 64 of a-z, 0-9 and _, a letter first");
    CHECK(dump(folder / "all") == before);
  }
  fill(folder / "newer", {evaluation_at(3)});
  execute(folder / "newer",
          "ALTER TABLE evaluation ADD COLUMN \"select\" TEXT DEFAULT 'kept'");  // a key of a later version
  merge_into(folder / "all", folder / "newer");
  CHECK(count(folder / "all", "SELECT count(*) FROM evaluation WHERE \"select\" = 'kept'") == 1);
  for (const char* const file : {"all", "newer"})
    execute(folder / file, "CREATE TABLE " + quoted_name(hostile) + "(id INTEGER PRIMARY KEY, " +
                               quoted_name("a \"b\"") + " TEXT UNIQUE)");
  execute(folder / "newer", "INSERT INTO " + quoted_name(hostile) + " VALUES (7, 'text')");
  for (int i = 0; i < 2; ++i) merge_into(folder / "all", folder / "newer");
  CHECK(count(folder / "all", "SELECT count(*) FROM " + quoted_name(hostile)) == 1);
  CHECK_FALSE(std::filesystem::exists(planted));
}

TEST_CASE("triggers of a stranger's file do not run, and no other file is opened beside it", "[db][database]") {
  const TemporaryDirectory folder;
  fill(folder / "a", {evaluation_at(1)});
  execute(folder / "a",
          "CREATE TRIGGER changes AFTER INSERT ON evaluation BEGIN UPDATE evaluation SET rolling_resistance = 7; END");
  fill(folder / "a", {evaluation_at(2)});
  CHECK(count(folder / "a", "SELECT count(*) FROM evaluation WHERE rolling_resistance = 7") == 0);
  const Database file = open_database(folder / "a", Access::write);
  CHECK_THROWS(file.connection().exec("ATTACH " + quoted_text((folder / "b").string()) + " AS other"));
  vacuum(file.connection());  // which needs that for a moment
  CHECK_THROWS(file.connection().exec("ATTACH " + quoted_text((folder / "b").string()) + " AS other"));
}
