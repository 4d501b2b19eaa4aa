#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>

#include "db/merge/merge.hpp"
#include "db/queries/query.hpp"
#include "db/rows/fit_store.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "tests/catch.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/temporary_directory.hpp"

// The files in former_files were written by the programs of their time, from one study and one fit, and then thinned
// out: of the fit's evaluations every sixtieth is left, and of the fields one. They are the dumps of `sqlite3`.

using namespace rollres;

namespace {

constexpr int never_written = 5;  // no program left a file of this schema

struct FormerFile {
  std::filesystem::path path;
  int schema;
};

/// In the order of their schemas.
std::vector<FormerFile> former_files(const std::filesystem::path& folder) {
  std::vector<FormerFile> files;
  for (const auto& entry : std::filesystem::directory_iterator(source_directory() / "tests/db/rows/former_files")) {
    const auto path = folder / entry.path().stem().concat(".db");
    SQLite::Database plain(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    plain.exec(file_text(entry.path()));
    files.push_back({path, plain.execAndGet("PRAGMA user_version").getInt()});
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.schema < b.schema; });
  return files;
}

/// As SQLite reads them, without this program.
std::vector<double> stored_numbers(const std::filesystem::path& file, const std::string& query) {
  SQLite::Database plain(file.string(), SQLite::OPEN_READONLY);
  SQLite::Statement row(plain, query);
  std::vector<double> numbers;
  while (row.executeStep()) numbers.push_back(row.getColumn(0).getDouble());
  return numbers;
}

/// Rolling resistances of the study's points, in their order.
std::vector<double> study_in(const std::filesystem::path& file, Access access) {
  const Table table =
      run_query(open_database(file, access),
                {.filters = {parse_filter("study=sample")}, .columns = {"rolling_resistance"}, .sort = {"position"}});
  std::vector<double> numbers;
  for (const auto& row : table.rows) numbers.push_back(std::get<double>(row[0]));
  return numbers;
}

/// The program of schema 9, built with today's libraries, ended when it fitted.
bool holds_fits(const FormerFile& file) { return file.schema >= 3 && file.schema != 9; }

}  // namespace

TEST_CASE("there is a kept file of every former schema", "[db][migration]") {
  const TemporaryDirectory folder;
  std::vector<int> kept, expected;
  for (const FormerFile& file : former_files(folder.path)) kept.push_back(file.schema);
  for (int schema = 1; schema < static_cast<int>(schema_migrations().size()); ++schema)
    if (schema != never_written) expected.push_back(schema);
  CHECK(kept == expected);
}

// Fails if a migration asks for what a program of the time did not write, or loses or changes a number of it.
TEST_CASE("files of former programs open, are asked and hold what was written", "[db][migration]") {
  const TemporaryDirectory folder;
  for (const FormerFile& file : former_files(folder.path)) {
    INFO("schema " << file.schema);
    const std::vector<double> written = stored_numbers(
        file.path, "SELECT rolling_resistance FROM study_point JOIN evaluation USING(key) ORDER BY position");
    REQUIRE(written.size() == 6);
    CHECK(study_in(file.path, Access::read) == written);
    const std::vector<double> fitted = holds_fits(file)
                                           ? stored_numbers(file.path, "SELECT value FROM fit_parameter ORDER BY name")
                                           : std::vector<double>();
    CHECK(study_in(file.path, Access::write) == written);  // brought to the present schema
    CHECK(study_in(file.path, Access::read) == written);
    CHECK(stored_numbers(file.path, "PRAGMA user_version") ==
          std::vector<double>{static_cast<double>(schema_migrations().size())});
    ResultStore store(file.path);
    const std::optional<StudySummary> study = store.study("sample");
    REQUIRE(study);
    CHECK(study->answered == 6);
    CHECK(study->failed == 0);
    const std::vector<FitSummary> fits = stored_fits(store.database());
    CHECK(fits.size() == (holds_fits(file) ? 1 : 0));
    if (fits.empty()) continue;
    const FitRecord fit = *find_fit(store.database(), "sample_fit", FitParts::with_data);
    REQUIRE(fit.parameters.size() == fitted.size());
    CHECK(fit.parameters.front().name == "static_shear_modulus");
    CHECK(fit.parameters.front().value == fitted.back());
    CHECK(fit.data.size() == 5);
  }
}

// Fails if rows of one schema lose their identity beside those of another, or one of them cannot be brought up to date
// without its file being written.
TEST_CASE("files of former programs merge into one of today", "[db][migration]") {
  const TemporaryDirectory folder;
  const auto all = folder / "all.db";
  std::size_t evaluations = 0;
  for (const FormerFile& file : former_files(folder.path)) {
    INFO("schema " << file.schema);
    const std::string before = file_text(file.path);
    const MergeReport report = merge(open_database(all, Access::write), file.path);
    CHECK(file_text(file.path) == before);
    CHECK(report.conflicts.empty());
    CHECK(report.evaluations >= 6);
    evaluations += report.added;
  }
  ResultStore store(all);
  CHECK(stored_numbers(all, "SELECT count(*) FROM evaluation").front() == static_cast<double>(evaluations));
  CHECK(stored_fits(store.database()).size() == 1);  // of one name, file and data
  CHECK(study_in(all, Access::read).size() == 6);
}
