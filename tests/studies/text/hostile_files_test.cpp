#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <thread>

#include "db/file/temporary_folder.hpp"
#include "db/merge/merge.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/drawing/chart.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/study/study.hpp"
#include "studies/text/files.hpp"
#include "studies/text/measured_table.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/table_output.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

#include <SQLiteCpp/SQLiteCpp.h>

// Covers strict_json, files and measured_table, too.

using namespace rollres;
using Catch::Contains;

TEST_CASE("JSON nested 100,000 levels deep is refused", "[studies][hostile]") {
  const std::string text = "{\"a\":" + std::string(100'000, '[') + std::string(100'000, ']') + "}";
  CHECK_THROWS_WITH(parse_object(text, "deep.json"), Contains("deep.json: nested more than"));
}

TEST_CASE("an object of 20,000 keys is refused at once", "[studies][hostile]") {
  std::string text = "{\"k\":0";
  for (int i = 0; i < 20'000; ++i) text += ",\"k" + std::to_string(i) + "\":1";
  CHECK_THROWS_WITH(parse_object(text + "}", "many.json"), Contains("too many keys"));
}

TEST_CASE("a table of measured values without an end is refused", "[studies][hostile]") {
  CHECK_THROWS_WITH(read_measured_table("/dev/zero"), Contains("larger than 100 MB"));
}

TEST_CASE("names with control characters, and . and .., are refused", "[studies][hostile]") {
  for (const char* name : {"\\u001b[2J", "a\\nb", ".", ".."}) {
    const Json object = parse_object(std::string("{\"study\":\"") + name + "\"}", "s");
    CHECK_THROWS_AS(needed_name(object, "study", "s", "must be a name"), std::invalid_argument);
  }
  const Json object = parse_object(R"({"study":"it's ''good''"})", "s");
  CHECK(needed_name(object, "study", "s", "must be a name") == "it's ''good''");
}

TEST_CASE("a NUL, which would end a text before its end, is refused in every text of a file", "[studies][hostile]") {
  for (const char* text : {R"({"radius": "1 mm\u0000x"})", R"({"a\u0000b": 1})", R"({"l": [["load\u0000+1"]]})"})
    CHECK_THROWS_WITH(parse_object(text, "f.json"),
                      Contains("f.json: ") && Contains("\\u0000") && Contains(": must have no NUL character"));
  const TemporaryDirectory folder;
  const auto table = folder.write("t.csv", std::string("speed [m/s]\n1\n2\0003\n", 20));
  CHECK_THROWS_WITH(read_measured_table(table), Contains("t.csv, line 3: has a NUL character"));
}

TEST_CASE("names of files that are empty or have a NUL are refused, not cut off", "[studies][hostile]") {
  const std::filesystem::path nul = std::string("a\0b", 3);
  CHECK_THROWS_WITH(whole_file("", 1), "the file name is empty");
  CHECK_THROWS_WITH(write_file("", "x"), "the file name is empty");
  CHECK_THROWS_WITH(make_directory(""), "the file name is empty");
  CHECK_THROWS_WITH(whole_file(nul, 1), Contains("a...: the file name has a NUL character"));
  CHECK_THROWS_WITH(write_file(nul, "x"), Contains("NUL"));
  CHECK_THROWS_WITH(make_directory(nul), Contains("NUL"));
}

TEST_CASE("a folder for temporary files that is missing is named", "[studies][hostile]") {
  const char* const before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  ::setenv("TMPDIR", "/nowhere/at/all", 1);
  std::string said;
  try {
    const TemporaryFolder folder;
  } catch (const std::runtime_error& error) {
    said = error.what();
  }
  if (before)
    ::setenv("TMPDIR", kept.c_str(), 1);
  else
    ::unsetenv("TMPDIR");
  CHECK_THAT(said, Contains("TMPDIR = /nowhere/at/all"));
}

TEST_CASE("a database of a negative version, and a pipe, are refused", "[studies][hostile]") {
  const TemporaryDirectory folder;
  const auto file = folder.path / "a.db";
  { const ResultStore store(file); }
  { SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = -1"); }
  for (const Access access : {Access::read, Access::write})
    CHECK_THROWS_WITH(open_database(file, access), Contains("damaged: schema -1"));
  const auto pipe = folder.path / "pipe.db";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  for (const Access access : {Access::read, Access::write})
    CHECK_THROWS_WITH(open_database(pipe, access), Contains("not a regular file"));
  const Database merged = open_database(folder.path / "merged.db", Access::write);
  CHECK_THROWS_WITH(merge(merged, pipe), Contains("not a regular file"));
}

TEST_CASE("a database that was deleted takes no more results", "[studies][hostile]") {
  const TemporaryDirectory folder;
  const auto file = folder.path / "a.db";
  ResultStore store(file);
  const RollingScene scene = plain_scene(1.0);
  const Evaluation one{evaluation_key(scene), scene, closed_form(scene)};
  CHECK(store.save({&one, 1}) == 1);
  std::filesystem::remove(file);
  CHECK_THROWS_WITH(store.save({&one, 1}), Contains("a.db: was deleted or replaced"));
  ResultStore again(file);  // another file of the same name
  CHECK_THROWS_WITH(store.save({&one, 1}), Contains("a.db: was deleted or replaced"));
}

TEST_CASE("an answer found under a limit is recalled for a scene of this limit alone", "[studies][hostile]") {
  RollingScene scene = plain_scene(1.0);
  std::set<std::string> keys{evaluation_key(scene)};
  scene.time_limit = 10;
  keys.insert(evaluation_key(scene));
  scene.memory_limit = 1e9;
  keys.insert(evaluation_key(scene));
  scene.time_limit.reset();
  keys.insert(evaluation_key(scene));
  CHECK(keys.size() == 4);
}

TEST_CASE("only regular files are replaced: pipes and what links lead to are written to", "[studies][hostile]") {
  const TemporaryDirectory folder;
  const auto pipe = folder.path / "pipe", link = folder.path / "link", file = folder.path / "file";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::string heard;
  {
    const std::jthread listener([&] { heard = whole_file(pipe, 1000); });
    write_file(pipe, "words");
  }
  CHECK(heard == "words");
  CHECK(std::filesystem::is_fifo(pipe));
  for (const char* const content : {"one", "another"}) {  // a link that leads nowhere, then to a file
    std::filesystem::remove(link);
    std::filesystem::create_symlink(file, link);
    write_file(link, content);
    CHECK(whole_file(file, 1000) == content);
    CHECK(std::filesystem::is_symlink(link));
  }
  CHECK_THROWS_WITH(write_file(folder.path, "x"),
                    Contains(folder.path.string() + ": cannot be written: Is a directory"));
  CHECK_THROWS_WITH(write_file("/dev/full", "x"), Contains("/dev/full: cannot be written: No space left"));
  // What somebody laid where the temporary file would stand is not written through.
  const auto part = folder.path / ("file." + std::to_string(::getpid()) + ".part"), victim = folder.path / "victim";
  write_file(victim, "kept");
  std::filesystem::create_symlink(victim, part);
  write_file(file, "new");
  CHECK(whole_file(victim, 1000) == "kept");
  CHECK(whole_file(file, 1000) == "new");
}

TEST_CASE("a text that a spreadsheet would compute is marked as text in CSV, a number stays one",
          "[studies][hostile]") {
  Table table;
  table.columns = {"a", "b"};
  for (const char* const text : {"=1+2", "+cmd", "-x", "@a", "\tb"}) table.rows.push_back({std::string(text), -1.5});
  table.rows.push_back({std::string("-1e-3"), std::int64_t{-2}});
  CHECK(csv_of(table) == "a,b\n\"'=1+2\",-1.5\n\"'+cmd\",-1.5\n\"'-x\",-1.5\n\"'@a\",-1.5\n\"'\tb\",-1.5\n-1e-3,-2\n");
}

TEST_CASE("a chart bears any name, and a picture that is cut off is an error", "[studies][hostile]") {
  const TemporaryDirectory folder;
  ChartRequest request;
  request.x = {.name = "speed"};
  request.y = {.name = "rolling_resistance"};
  request.curves.push_back({.label = "a", .points = {{.x = 1, .y = 1}, {.x = 2, .y = 3}}});
  for (const std::string name : {"'a", "b''c", "''''", "`touch hacked`'", "it's \"q\" \\ @x"}) {
    request.title = name;
    request.curves[0].label = name;
    CHECK_NOTHROW(draw_chart(request, folder.path / ("n" + name)));
  }
  const auto cut = folder.write("gnuplot.sh", "#!/bin/sh\nprintf '<svg>' > c.svg; printf 'PNG' > c.png\n");
  std::filesystem::permissions(cut, std::filesystem::perms::owner_all);
  CHECK_THROWS_WITH(draw_chart(request, folder.path / "c", cut.string()), Contains("cut off"));
  CHECK(!std::filesystem::exists(folder.path / "c.svg"));
}

TEST_CASE("a film that is cut off is an error", "[studies][hostile]") {
  const TemporaryDirectory folder;
  const auto script = folder.write("film.gp", "");
  const auto drawing = [&](const std::string& bytes) {
    const auto program = folder.write("gnuplot.sh", "#!/bin/sh\nprintf '" + bytes + "' > film.gif\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    return program.string();
  };
  const auto film = folder.path / "film.gif";
  CHECK_NOTHROW(run_script(script, {film}, drawing("GIF89a...\\0;")));
  CHECK_THROWS_WITH(run_script(script, {film}, drawing("GIF89a...")), Contains("film.gif") && Contains("cut off"));
  CHECK(!std::filesystem::exists(film));
  CHECK_THROWS_WITH(run_script(script, {film}, drawing("")), Contains("drew nothing"));
}
