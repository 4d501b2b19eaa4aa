#include <SQLiteCpp/SQLiteCpp.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "db/merge/merge.hpp"
#include "db/queries/query.hpp"
#include "db/rows/fit_store.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

std::string text_in(SQLite::Database& connection, const std::string& query) {
  return connection.execAndGet(query).getString();
}

/// What came with schema 9. No view may stand on it.
void take_out_designs(SQLite::Database& plain) {
  for (auto column = std::find(point_columns.begin(), point_columns.end(), "design"); column != point_columns.end();
       ++column)
    plain.exec("ALTER TABLE study_point DROP COLUMN " + std::string(*column));
}

/// Takes out of an empty study's tables what came after schema 5.
void take_out_later_columns(SQLite::Database& plain) {
  plain.exec("DROP VIEW resistance; DROP VIEW converged; DROP VIEW result");  // they stand on the columns
  plain.exec("ALTER TABLE study DROP COLUMN note; ALTER TABLE study_point DROP COLUMN variant");
  take_out_designs(plain);
}

/// A database of the first schema, as the first version left it: nine evaluations, one of them failed, and a study of
/// six. Rows go in by plain SQL, as this version's store would bring the file up to date.
class FirstSchema {
 public:
  FirstSchema() : file_(folder_.path / "first.db") {
    { Database(file_, Access::write, {schema_migrations().first(1), add_missing_columns}); }
    const auto model = folder_.path / "model.db";
    {
      ResultStore store(model);
      for (int i = 1; i <= 9; ++i) {
        const RollingScene scene = plain_scene(0.1 * i);
        RollingSolution solution = closed_form(scene);
        if (i == 4) {
          solution = {};
          solution.reason = "singular matrix";
          solution.load = *scene.load;
        }
        const Evaluation one{evaluation_key(scene), scene, solution};
        keys_.push_back(one.key);
        store.save({&one, 1});
      }
      store.start_study({"a study", {"speed"}, "{}"}, std::span(keys_).first(6));
    }
    SQLite::Database plain(file_.string(), SQLite::OPEN_READWRITE);
    plain.exec("ATTACH '" + model.string() + "' AS model");
    for (const std::string table : {"provenance", "study", "study_point", "evaluation"}) {
      std::string columns;  // those of the first schema
      for (const Column& column : columns_of(plain, table)) columns += (columns.empty() ? "" : ", ") + column.name;
      plain.exec("INSERT INTO main." + table + "(" + columns + ") SELECT " + columns + " FROM model." + table);
    }
    plain.exec("DETACH model");
    before_ = content(plain);
  }

  /// Every cell of every table of the first schema.
  static std::string content(SQLite::Database& connection) {
    std::string all;
    for (const std::string table : {"provenance", "study", "study_point", "evaluation", "result"}) {
      std::string columns;
      for (const Column& column : columns_of(connection, table))
        if (const bool of_point = std::count(point_columns.begin() + 2, point_columns.end(), column.name) > 0;
            column.name != "note" && !of_point)  // of later schemas
          columns += (columns.empty() ? "quote(" : " || '|' || quote(") + column.name + ")";
      all += text_in(connection, "SELECT group_concat(" + columns + ", x'0a') FROM " + table) + "\n\n";
    }
    return all;
  }

  const std::filesystem::path& folder() const { return folder_.path; }
  const std::filesystem::path& file() const { return file_; }
  const std::string& before() const { return before_; }
  const std::vector<std::string>& keys() const { return keys_; }

 private:
  TemporaryDirectory folder_;
  std::filesystem::path file_;
  std::vector<std::string> keys_;
  std::string before_;
};

}  // namespace

TEST_CASE("a file of the first schema keeps every cell through the migrations, and its rows are found and written",
          "[db][migration]") {
  const FirstSchema first;
  REQUIRE(first.before().find("singular matrix") != std::string::npos);
  {
    SQLite::Database plain(first.file().string());
    REQUIRE(plain.execAndGet("PRAGMA user_version").getInt() == 1);
    REQUIRE_FALSE(plain.tableExists("fields"));
  }
  ResultStore store(first.file(), Access::read);
  SQLite::Database& connection = store.database().connection();
  CHECK(connection.execAndGet("PRAGMA user_version").getInt() == static_cast<int>(schema_migrations().size()));
  CHECK(FirstSchema::content(connection) == first.before());
  CHECK(text_in(connection, "PRAGMA integrity_check") == "ok");
  CHECK(connection.execAndGet("SELECT count(*) FROM pragma_foreign_key_check").getInt() == 0);
  CHECK(store.find(first.keys()[2])->solution.rolling_resistance ==
        closed_form(plain_scene(0.1 * 3)).rolling_resistance);
  CHECK(connection.execAndGet("SELECT count(*) FROM converged WHERE study = 'a study'").getInt() == 5);
  CHECK_FALSE(store.find_fields(first.keys()[0]));

  ResultStore writer(first.file());
  const Evaluation again{first.keys()[3], plain_scene(0.4), closed_form(plain_scene(0.4))};
  CHECK(writer.save({&again, 1}) == 0);
  CHECK(writer.save({&again, 1}, Existing::replaced) == 1);
  CHECK(store.find(std::int64_t{4})->solution.status == Status::converged);
}

TEST_CASE("a file of the first schema that may not be written is read as it is", "[db][migration]") {
  const FirstSchema first;
  std::filesystem::create_directory(first.folder() / "archive");
  const auto file = first.folder() / "archive/a.db";
  std::filesystem::copy(first.file(), file);
  const std::string before = file_text(file);
  chmod(first.folder().c_str(), 0755);
  chmod(file.c_str(), 0444);
  chmod((first.folder() / "archive").c_str(), 0555);
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && seteuid(65534) != 0) _exit(9);  // root may write everything
    int wrong = 0;
    const std::string message = message_of([&] {
      ResultStore store(file, Access::read);
      if (store.studies().size() != 1 || store.study("a study")->failed != 1) wrong |= 1;
      if (!store.find(first.keys()[0]) || store.find_fields(first.keys()[0])) wrong |= 2;
      if (store.find_answer(first.keys()[0])->has_fields) wrong |= 4;
      const Query page{.filters = {parse_filter("speed>0.2"), parse_filter("status=converged")},
                       .sort = {"-rolling_resistance"},
                       .limit = 3};
      if (run_query(store.database(), page).rows.size() != 3) wrong |= 8;
    });
    if (message != "nothing") std::fprintf(stderr, "child: %s\n", message.c_str());
    _exit(message == "nothing" ? wrong : 10);
  }
  int status = 0;
  waitpid(child, &status, 0);
  chmod((first.folder() / "archive").c_str(), 0755);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK(file_text(file) == before);
}

TEST_CASE("the views hold what is plotted: every point, those with an answer, and few columns of these",
          "[db][migration]") {
  const FirstSchema first;
  const Database database = open_database(first.file(), Access::read);
  SQLite::Database& connection = database.connection();
  auto count = [&](const std::string& view) { return connection.execAndGet("SELECT count(*) FROM " + view).getInt(); };
  CHECK(count("result") == 6);
  CHECK(count("converged") == 5);
  CHECK(count("resistance") == 5);
  CHECK(columns_of(connection, "converged").size() == columns_of(connection, "result").size());
  std::string names;
  for (const Column& column : columns_of(connection, "resistance")) names += column.name + " ";
  CHECK(names ==
        "study position indenter radius layer_thickness speed load friction_coefficient drive rolling_resistance "
        "rolling_resistance_coefficient approach contact_area peak_pressure ");
}

TEST_CASE("results of before the kinematics were a choice count as those of the paper's equations", "[db][migration]") {
  const TemporaryDirectory folder;
  const auto file = folder / "old.db";
  const Evaluation evaluation{"a key", plain_scene(), closed_form(plain_scene())};
  ResultStore(file).save({&evaluation, 1});
  {
    SQLite::Database plain(file.string(), SQLite::OPEN_READWRITE);
    plain.exec("ALTER TABLE evaluation DROP COLUMN kinematics");
    take_out_later_columns(plain);
    plain.exec("PRAGMA user_version = 3");  // the schema before
  }
  const std::optional<StoredEvaluation> found = ResultStore(file).find("a key");
  REQUIRE(found);
  CHECK(found->scene.kinematics == Kinematics::printed);
  SQLite::Database plain(file.string());
  CHECK(plain.execAndGet("SELECT kinematics FROM evaluation").getString() == "printed");
}

TEST_CASE("a load asked for stands as it was asked for, also where an older program stored what it found",
          "[db][migration]") {
  const TemporaryDirectory folder;
  const auto file = folder / "old.db";
  std::vector<Evaluation> rows;
  for (const double speed : {1.0, 2.0, 3.0}) rows.push_back({std::to_string(speed), plain_scene(speed), {}});
  rows[0].solution.load = 1e4 * (1 + 1e-11);
  rows[1].scene.load.reset();
  rows[1].scene.approach = 1e-4;
  rows[1].solution.load = 77;
  ResultStore(file).save(rows);
  {
    SQLite::Database plain(file.string(), SQLite::OPEN_READWRITE);
    take_out_later_columns(plain);
    plain.exec("PRAGMA user_version = 4");  // the schema before
  }
  ResultStore store(file);
  CHECK(store.solution(rows[0].key)->load == 1e4);
  CHECK(store.solution(rows[1].key)->load == 77);
  CHECK(store.solution(rows[1].key)->approach == 1e-4);
  CHECK(store.solution(rows[2].key)->load == 1e4);
}

TEST_CASE("fits of before their scenes were stored are listed and read, without one", "[db][migration]") {
  const TemporaryDirectory folder;
  const auto file = folder / "old.db";
  FitRecord fit{};
  fit.name = "a fit";
  fit.kind = "material";
  fit.definition = "{}";
  FitParameterRecord time;
  time.name = "creep_time";
  time.linear_lowest = 0;
  time.lowest = 0;
  FitParameterRecord level;
  level.name = "noise_level";
  level.fixed = true;
  level.flag = "noise, by likelihood";
  fit.parameters = {time, level};
  fit.y_unit = "N/m";
  fit.data.push_back({"data.csv, line 2", 1, 0.1, 1.1, 1, 0.05, 3, 0});
  save_fit(open_database(file, Access::write), fit);
  {
    SQLite::Database plain(file.string(), SQLite::OPEN_READWRITE);
    plain.exec(
        "DROP VIEW resistance; DROP VIEW converged; DROP VIEW result; ALTER TABLE fit DROP COLUMN scene;"
        "DROP TABLE fit_profile; DROP TABLE fit_curve;"
        "DROP TABLE fit_failure; ALTER TABLE fit DROP COLUMN iterations; ALTER TABLE fit DROP COLUMN output_unit;"
        "ALTER TABLE fit_parameter DROP COLUMN noise; ALTER TABLE fit_parameter DROP COLUMN linear_low;"
        "ALTER TABLE fit DROP COLUMN x_name; ALTER TABLE fit_data DROP COLUMN x;"
        "ALTER TABLE fit_data DROP COLUMN curve; PRAGMA user_version = 7");  // the schema before
    take_out_designs(plain);
  }
  const Database database = open_database(file, Access::write);
  const std::vector<FitSummary> fits = stored_fits(database);
  REQUIRE(fits.size() == 1);
  CHECK(fits.front().parameters == "creep_time");
  const FitRecord read = *find_fit(database, "a fit", FitParts::with_data);
  CHECK(read.scene.empty());
  CHECK(read.x_name.empty());
  REQUIRE(read.data.size() == 1);
  CHECK(read.data.front().measured == 1);
  CHECK(std::isnan(read.data.front().x));
  CHECK(read.data.front().curve == -1);
  CHECK(read.iterations == -1);     // not known
  CHECK(read.output_unit.empty());  // of one kind or of several: not known
  CHECK(read.failure_reasons.empty());
  REQUIRE(read.parameters.size() == 2);
  CHECK(read.parameters[0].linear_low == "limit");
  CHECK(read.parameters[0].linear_high == "open");
  CHECK_FALSE(read.parameters[0].noise);
  CHECK(read.parameters[1].noise);
}

TEST_CASE("fits of former versions have the unit of their curves, unless other values have no curve",
          "[db][fit_store]") {
  const TemporaryDirectory folder;
  for (const std::int64_t curve : {0, -1}) {
    const auto file = folder / ("fit" + std::to_string(curve) + ".db");
    FitRecord fit{};
    fit.name = "a fit";
    fit.y_unit = "N/m";
    fit.data = {{"data.csv, line 2", 1, 0.1, 1.1, 1, 0.05, 3, 0}, {"data.csv, line 3", 1, 0.1, 1.1, 1, 0.05, 3, curve}};
    save_fit(open_database(file, Access::write), fit);
    SQLite::Database(file.string(), SQLite::OPEN_READWRITE)
        .exec("ALTER TABLE fit DROP COLUMN output_unit; PRAGMA user_version = 11");  // the schema before
    CHECK(find_fit(open_database(file, Access::read), "a fit")->output_unit == (curve == 0 ? "N/m" : ""));
  }
}

TEST_CASE("profiles, curves and failures of a fit are read as they were stored", "[db][fit_store]") {
  const TemporaryDirectory folder;
  const auto file = folder / "fits.db";
  FitRecord fit{};
  fit.name = "a fit";
  fit.definition = "{}";
  fit.x_name = "speed";
  fit.x_unit = "m/s";
  fit.x_logarithmic = true;
  fit.profile_threshold = 3.84;
  fit.data.push_back({"data.csv, line 2", 1, 0.1, 1.1, 1, 0.05, 3, 0});
  fit.profiles = {{"creep_time", 0.1, 3.8}, {"creep_time", 0.2, 4.1}};
  fit.curves = {{0, "P = 1 kN/m", 0.5, 10, 0.3}, {0, "P = 1 kN/m", 1.5, 11, std::nan("")}};
  fit.failure_reasons = {{"no steady state", 3, "data.csv, line 2"}};
  for (int again = 0; again < 2; ++again) save_fit(open_database(file, Access::write), fit);
  const FitRecord read = *find_fit(open_database(file, Access::read), "a fit", FitParts::with_data);
  CHECK(read.x_name == "speed");
  CHECK(read.x_unit == "m/s");
  CHECK(read.x_logarithmic);
  CHECK(!read.y_logarithmic);
  CHECK(read.profile_threshold == 3.84);
  CHECK(read.data.front().x == 3);
  CHECK(read.data.front().curve == 0);
  REQUIRE(read.profiles.size() == 2);
  CHECK(read.profiles[1].parameter == "creep_time");
  CHECK(read.profiles[1].value == 0.2);
  CHECK(read.profiles[1].rise == 4.1);
  REQUIRE(read.curves.size() == 2);
  CHECK(read.curves[1].label == "P = 1 kN/m");
  CHECK(read.curves[0].band == 0.3);
  CHECK(std::isnan(read.curves[1].band));
  REQUIRE(read.failure_reasons.size() == 1);
  CHECK(read.failure_reasons[0].reason == "no steady state");
  CHECK(read.failure_reasons[0].count == 3);
  CHECK(read.failure_reasons[0].first_place == "data.csv, line 2");
}
