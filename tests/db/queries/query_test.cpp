#include "db/queries/query.hpp"

#include <algorithm>
#include <atomic>
#include <thread>

#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers select, too.

using namespace rollres;

namespace {

/// Speeds 0.1 to 0.5, the fourth without an answer; the first three are a study, in falling order.
class Filled {
 public:
  Filled() : store_(folder_.path / "a.db") {
    std::vector<Evaluation> all;
    for (const double speed : {0.1, 0.2, 0.1 + 0.2, 0.4, 0.5}) {
      const RollingScene scene = plain_scene(speed);
      all.push_back({evaluation_key(scene), scene, closed_form(scene)});
    }
    all[3].solution = {};
    all[3].solution.reason = "oscillates; friction";
    all[4].scene.layer_thickness = std::numeric_limits<double>::infinity();
    store_.save(all);
    store_.start_study({"a study", {"speed"}, ""}, std::vector{all[2].key, all[1].key, all[0].key});
  }

  Table run(const Query& query) const { return run_query(store_.database(), query); }
  Table group(const GroupQuery& query) const { return run_group_query(store_.database(), query); }

  /// Ids of the rows that fulfil all filters.
  std::vector<std::int64_t> ids(const std::vector<std::string>& filters,
                                const std::vector<std::string>& sort = {}) const {
    Query query{.columns = {"id"}, .sort = sort};
    for (const std::string& text : filters) query.filters.push_back(parse_filter(text));
    std::vector<std::int64_t> found;
    for (const auto& row : run(query).rows) found.push_back(std::get<std::int64_t>(row[0]));
    return found;
  }

 private:
  TemporaryDirectory folder_;
  ResultStore store_;
};

using Ids = std::vector<std::int64_t>;

}  // namespace

TEST_CASE("filters select by numbers, names and absence", "[db][query]") {
  const Filled store;
  CHECK(store.ids({}) == Ids{1, 2, 3, 4, 5});
  CHECK(store.ids({"speed>0.2", "status=converged"}) == Ids{3, 5});
  CHECK(store.ids({"speed >= 0.2", "speed<0.5"}) == Ids{2, 3, 4});
  CHECK(store.ids({"speed=0.3"}) == Ids{3});
  CHECK(store.ids({"speed<=0.3"}) == Ids{1, 2, 3});
  CHECK(store.ids({"speed>0.3"}) == Ids{4, 5});
  CHECK(store.ids({"speed>=0.3"}) == Ids{3, 4, 5});
  CHECK(store.ids({"speed<0.3"}) == Ids{1, 2});
  CHECK(store.ids({"speed!=0.3"}) == Ids{1, 2, 4, 5});
  CHECK(store.ids({"status!=converged"}) == Ids{4});
  CHECK(store.ids({"reason~friction"}) == Ids{4});
  CHECK(store.ids({"rolling_resistance="}) == Ids{4});
  CHECK(store.ids({"rolling_resistance!="}) == Ids{1, 2, 3, 5});
  CHECK(store.ids({"rolling_resistance!=1"}) == Ids{1, 2, 3, 4, 5});
  CHECK(store.ids({"reason="}) == Ids{1, 2, 3, 5});
  CHECK(store.ids({"layer_thickness=infinite"}) == Ids{5});
  CHECK(store.ids({"layer_thickness<infinite"}) == Ids{1, 2, 3, 4});
  CHECK(store.ids({"contact_nodes=31"}) == Ids{1, 2, 3, 5});
  CHECK(store.ids({"given_load=1e4", "load="}) == Ids{4});
}

TEST_CASE("a number finds the rows that show it, to the digits written and to five at least", "[db][query]") {
  const TemporaryDirectory folder;
  ResultStore store(folder / "a.db");
  std::vector<Evaluation> all;
  for (const double speed : {3.174802103936, 3.1748, 3.17479, 3.17486, 123456.0, 123456.4})
    all.push_back({std::to_string(all.size()), plain_scene(speed), closed_form(plain_scene(speed))});
  store.save(all);
  const auto ids = [&](const std::string& filter) {
    std::string found;
    for (const auto& row : run_query(store.database(), {.filters = {parse_filter(filter)}, .columns = {"id"}}).rows)
      found += std::to_string(std::get<std::int64_t>(row[0])) + " ";
    return found;
  };
  CHECK(ids("speed=3.1748") == "1 2 3 ");  // 3.17479 prints as 3.1748 with five digits
  CHECK(ids("speed=3.17480") == "1 2 ");
  CHECK(ids("speed=3.17480210") == "1 ");
  CHECK(ids("speed=0.317480210e1") == "1 ");
  CHECK(ids("speed>3.1748") == "4 5 6 ");
  CHECK(ids("speed<=3.1748") == "1 2 3 ");
  CHECK(ids("speed!=3.1748") == "4 5 6 ");
  CHECK(ids("speed=123456") == "5 6 ");
  CHECK(ids("speed=123456.0") == "5 ");
  CHECK(ids("id=3") == "3 ");
  CHECK(slack_of_written("0") == 0);
  CHECK(slack_of_written("100 mm") == Approx(5e-5));
}

TEST_CASE("rows are sorted by several columns, absent values last, and limited", "[db][query]") {
  const Filled store;
  CHECK(store.ids({}, {"-speed"}) == Ids{5, 4, 3, 2, 1});
  CHECK(store.ids({}, {"status", "-speed"}) == Ids{5, 3, 2, 1, 4});
  CHECK(store.ids({}, {"rolling_resistance"}).back() == 4);
  CHECK(store.ids({}, {"-rolling_resistance"}).back() == 4);
  CHECK(store.run({.sort = {"-speed"}, .limit = 2}).rows.size() == 2);
  CHECK(store.run({.limit = 0}).rows.empty());
}

TEST_CASE("a study's points come in its order", "[db][query]") {
  const Filled store;
  CHECK(store.ids({"study=a study"}) == Ids{3, 2, 1});
  CHECK(store.ids({"study=a study", "position=2"}) == Ids{2});
  CHECK(store.ids({"study=another"}).empty());
  CHECK(store.run({.columns = {"study", "speed"}}).rows.size() == 3);
}

TEST_CASE("a question the store cannot understand is refused with what it knows", "[db][query]") {
  const Filled store;
  CHECK(message_of([&] { store.ids({"sped>1"}); }) == "sped: unknown column; did you mean speed?");
  CHECK(message_of([&] { store.ids({"colour=red"}); }) == "colour: unknown column; see rollres quantities");
  CHECK(message_of([&] { store.ids({"speed=fast"}); }) == "speed = fast: must be a number");
  CHECK(message_of([&] { store.ids({"speed=nan"}); }) == "speed = nan: must be a number");
  CHECK(message_of([&] { store.ids({"speed>"}); }) == "speed: needs a value to compare with");
  CHECK(message_of([&] { store.ids({"speed"}); }) == "speed: must be a column, one of = != < <= > >= ~ and a value");
  CHECK(message_of([&] { store.ids({"=1"}); }) == "=1: must be a column, one of = != < <= > >= ~ and a value");
  CHECK(message_of([&] { store.ids({"speed!1"}); }) == "speed!1: a single ! compares nothing; use !=");
  CHECK(message_of([&] { store.run({.columns = {"rolling_resistence"}}); }) ==
        "rolling_resistence: unknown column; did you mean rolling_resistance?");
  CHECK(message_of([&] { store.run({.sort = {"-sped"}}); }) == "sped: unknown column; did you mean speed?");
}

TEST_CASE("nothing that is asked becomes SQL", "[db][query]") {
  const Filled store;
  CHECK(store.ids({"status=converged' OR '1'='1"}).empty());
  CHECK(store.ids({"study=x'; DROP TABLE evaluation; --"}).empty());
  CHECK(message_of([&] { store.ids({"1=1 OR speed=1"}); }).starts_with("1: unknown column"));
  CHECK(message_of([&] { store.run({.columns = {"id; DROP TABLE evaluation"}}); }).find("unknown column") !=
        std::string::npos);
  CHECK(message_of([&] { store.run({.sort = {"speed; DROP TABLE evaluation"}}); }).find("unknown column") !=
        std::string::npos);
  CHECK(store.ids({}).size() == 5);
}

TEST_CASE("the first page of any question is the head of the whole answer, whichever way it is found", "[db][query]") {
  const TemporaryDirectory folder;
  ResultStore store(folder / "a.db");
  std::vector<Evaluation> all;
  std::vector<std::string> keys;
  for (int i = 0; i < 300; ++i) {
    const RollingScene scene = plain_scene(0.1 * (1 + i % 60), 1e3 * (1 + i / 60));
    all.push_back({evaluation_key(scene), scene, closed_form(scene)});
    all.back().solution.approach = 1e-4 * (i % 7);
    if (i % 11 == 0) {
      all.back().solution = {};
      all.back().solution.reason = "singular matrix";
    }
    keys.push_back(all.back().key);
  }
  store.save(all);
  std::reverse(keys.begin(), keys.end());
  store.start_study({"large", {"speed"}, ""}, keys);
  keys.resize(5);
  store.start_study({"small", {"speed"}, ""}, keys);
  for (const std::string study : {"", "study=large", "study=small", "study!=small"})
    for (const std::string filter : {"", "speed>3", "approach>2e-4", "load=2 kN/m", "status=converged"})
      for (const std::string sort :
           {"", "rolling_resistance", "-rolling_resistance", "-speed", "approach", "-status"}) {
        Query query{.columns = {"id", "rolling_resistance"}};
        for (const std::string& text : {study, filter})
          if (!text.empty()) query.filters.push_back(parse_filter(text == "load=2 kN/m" ? "load=2000" : text));
        if (!sort.empty()) query.sort = {sort};
        Table whole = run_query(store.database(), query);
        query.limit = 7;
        INFO(study + " " + filter + " " + sort);
        whole.rows.resize(std::min<std::size_t>(7, whole.rows.size()));
        CHECK(run_query(store.database(), query).rows == whole.rows);
      }
}

TEST_CASE("groups of rows are counted and summed up, by columns equal to 12 digits", "[db][query]") {
  const Filled store;
  auto groups = [&](const GroupQuery& query) { return store.group(query); };
  using Row = std::vector<Cell>;
  const Table all = groups({.aggregates = {parse_aggregate("count"), parse_aggregate("count rolling_resistance"),
                                           parse_aggregate("min speed"), parse_aggregate(" median  speed "),
                                           parse_aggregate("sum contact_nodes")}});
  CHECK(all.columns == std::vector<std::string>{"count", "count_rolling_resistance", "min_speed", "median_speed",
                                                "sum_contact_nodes"});
  REQUIRE(all.rows.size() == 1);
  CHECK(all.rows[0] == Row{std::int64_t{5}, std::int64_t{4}, 0.1, 0.1 + 0.2, std::int64_t{4 * 31}});

  const Table by_status = groups({.filters = {parse_filter("speed<0.5")},
                                  .aggregates = {parse_aggregate("mean speed"), parse_aggregate("stddev speed")},
                                  .by = {"status"},
                                  .sort = {"-mean_speed"}});
  REQUIRE(by_status.rows.size() == 2);
  CHECK(by_status.rows[0] == Row{std::string("not_converged"), 0.4, Cell{}});  // one row has no spread
  CHECK(std::get<double>(by_status.rows[1][1]) == Approx(0.2).epsilon(1e-14));
  CHECK(std::get<double>(by_status.rows[1][2]) == Approx(0.1).epsilon(1e-14));

  CHECK(groups({.aggregates = {{}}, .by = {"speed"}, .sort = {"-speed"}, .limit = 2}).rows ==
        std::vector<Row>{{0.5, std::int64_t{1}}, {0.4, std::int64_t{1}}});
  CHECK(groups({.by = {"study", "status"}}).rows ==
        std::vector<Row>{{std::string("a study"), std::string("converged")}});
  CHECK(groups({.filters = {parse_filter("speed>9")}, .aggregates = {{}}}).rows.empty());
}

TEST_CASE("values that differ beyond the twelfth digit are one group", "[db][query]") {
  const TemporaryDirectory folder;
  ResultStore store(folder / "a.db");
  for (const double load : {1e4, 2e4})
    for (const double speed : {0.3, 0.1 + 0.2}) {
      const RollingScene scene = plain_scene(speed, speed == 0.3 ? load : load + 1);
      const Evaluation one{evaluation_key(scene), scene, closed_form(scene)};
      store.save({&one, 1});
    }
  const Table table = run_group_query(store.database(), {.aggregates = {{}}, .by = {"speed"}});
  REQUIRE(table.rows.size() == 1);
  CHECK(table.rows[0] == std::vector<Cell>{0.3, std::int64_t{4}});
}

TEST_CASE("a wrong statistic is refused with what is known", "[db][query]") {
  const Filled store;
  CHECK(message_of([] { parse_aggregate("medan speed"); }) == "aggregate = medan speed: did you mean mean?");
  CHECK(message_of([] { parse_aggregate("quartile speed"); }) ==
        "aggregate = quartile speed: must be one of count, min, max, mean, median, stddev, sum, and a column");
  CHECK(message_of([] { parse_aggregate("mean"); }) ==
        "aggregate = mean: needs a column, as in mean rolling_resistance");
  CHECK(message_of([] { parse_aggregate("mean speed load"); }) ==
        "aggregate = mean speed load: must be a statistic and one column, as in mean approach, or mean approach "
        "weighted COLUMN");
  auto refusal = [&](const GroupQuery& query) { return message_of([&] { store.group(query); }); };
  CHECK(refusal({.aggregates = {parse_aggregate("mean sped")}}) == "sped: unknown column; did you mean speed?");
  CHECK(refusal({.aggregates = {parse_aggregate("max status")}}) == "status: has no max, it is a text");
  CHECK(refusal({.aggregates = {{}}, .sort = {"speed"}}).starts_with("speed: unknown column"));
  CHECK(refusal({.aggregates = {{}}, .by = {"load; DROP TABLE evaluation"}}).find("unknown column") !=
        std::string::npos);
}

TEST_CASE("SQL may ask anything, and change nothing", "[db][query]") {
  const TemporaryDirectory folder;
  const auto file = folder / "a.db";
  {
    ResultStore store(file);
    const Evaluation one{evaluation_key(plain_scene()), plain_scene(), closed_form(plain_scene())};
    store.save({&one, 1});
  }
  const std::string before = file_text(file);
  {
    const Database database = open_database(file, Access::read);
    auto ask = [&](const std::string& sql) { return run_sql(database, sql); };
    CHECK(ask("SELECT speed AS v, count(*) FROM evaluation -- a remark\n;;").columns ==
          std::vector<std::string>{"v", "count(*)"});
    CHECK(ask("WITH t(x) AS (VALUES (1.0), (2.0), (7.0)) SELECT median(x), stddev(x) FROM t").rows[0] ==
          std::vector<Cell>{2.0, std::sqrt(62.0 / 6)});
    CHECK(ask("SELECT median(x), stddev(x) FROM (SELECT 1 AS x WHERE 0)").rows[0] == std::vector<Cell>{{}, {}});
    CHECK(ask("SELECT median('text')").rows[0] == std::vector<Cell>{{}});
    for (const std::string sql :
         {"DELETE FROM evaluation", "UPDATE evaluation SET speed = 1", "INSERT INTO provenance DEFAULT VALUES",
          "DROP TABLE evaluation", "CREATE TABLE more(x)", "CREATE TEMP TABLE more(x)", "PRAGMA user_version = 1",
          "PRAGMA query_only = OFF", "PRAGMA journal_mode = delete", "BEGIN IMMEDIATE", "VACUUM",
          "VACUUM INTO 'copy.db'", "ATTACH 'other.db' AS other", "SELECT 1; DELETE FROM evaluation", "REINDEX",
          "WITH t AS (SELECT 1) DELETE FROM evaluation"}) {
      INFO(sql);
      CHECK(message_of([&] { ask(sql); }) == "sql: must only read");
    }
    CHECK(message_of([&] { ask("SELECT 1; SELECT 2"); }) == "sql: must be one statement");
    for (const std::string nothing : {"", " -- only a remark", ";"})
      CHECK(message_of([&] { ask(nothing); }) == "sql: must be a statement, as in SELECT * FROM resistance");
    CHECK(message_of([&] { ask("SELECT sped FROM evaluation"); }) == "sql: no such column: sped");
    CHECK(message_of([&] { ask("SELECT abs(-9223372036854775808)"); }) == file.string() + ": integer overflow");
    CHECK(run_query(database, {}).rows.size() == 1);
  }
  CHECK(file_text(file) == before);
}

TEST_CASE("a question ends when a stop is asked for", "[db][query]") {
  const TemporaryDirectory folder;
  { ResultStore created(folder / "a.db"); }
  Database database = open_database(folder / "a.db", Access::read);
  std::atomic<bool> stop = false;
  database.stop_when(stop);
  CHECK(run_sql(database, "SELECT 1").rows.size() == 1);
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    stop = true;
  });
  CHECK(message_of([&] {
          run_sql(database, "WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT count(*) FROM c");
        }) == (folder / "a.db").string() + ": interrupted");
  later.join();
}
