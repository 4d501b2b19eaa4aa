#include "db/merge/gathered.hpp"

#include <array>
#include <filesystem>
#include <limits>
#include <span>

#include "db/queries/query.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

/// A database with one study of these speeds.
void fill_study(const std::filesystem::path& file, const std::string& study, const std::vector<double>& speeds) {
  ResultStore store(file);
  std::vector<std::string> keys;
  for (const double speed : speeds) {
    const Evaluation one{evaluation_key(plain_scene(speed)), plain_scene(speed), closed_form(plain_scene(speed))};
    store.save({&one, 1});
    keys.push_back(one.key);
  }
  store.start_study({study, {"speed"}, "{\"axes\": {\"speed\": [" + std::to_string(speeds.front()) + "]}}"}, keys);
}

}  // namespace

TEST_CASE("several databases are read as one, which is gone afterwards, and they are not written to", "[db][merge]") {
  const TemporaryDirectory folder;
  const std::array<std::string, 2> files{folder / "one.db", folder / "two.db"};
  fill_study(files[0], "s", {1, 2});
  fill_study(files[1], "s", {3, 4, 5});
  const std::string before = file_text(files[0]);
  std::filesystem::path place;
  {
    const GatheredDatabases gathered(files);
    place = gathered.file();
    REQUIRE(gathered.renamed().size() == 1);
    CHECK(gathered.renamed()[0].file == files[1]);
    CHECK(gathered.renamed()[0].here == "s 2");
    const Database all = open_database(place, Access::read);
    CHECK(run_query(all, {.filters = {parse_filter("study=s 2")}}).rows.size() == 3);
    CHECK(run_query(all, {.filters = {parse_filter("study=s"), parse_filter("study=s 2")}}).rows.size() == 5);
    CHECK(run_query(all, {.filters = {parse_filter("study=s"), parse_filter("study=s 2"), parse_filter("speed>1.5")},
                          .sort = {"-rolling_resistance"},
                          .limit = 3})
              .rows.size() == 3);
  }
  CHECK_FALSE(std::filesystem::exists(place));
  CHECK(file_text(files[0]) == before);
  const GatheredDatabases one(std::span<const std::string>{files.data(), 1});
  CHECK(one.file() == files[0]);
}

TEST_CASE("a weighted mean counts each row by another column, computed or not", "[db][query]") {
  const TemporaryDirectory folder;
  fill_study(folder / "a.db", "s", {1, 2, 5});
  const Database database = open_database(folder / "a.db", Access::read);
  const auto number = [&](const GroupQuery& query) {
    return std::get<double>(run_group_query(database, query).rows[0][0]);
  };
  const GroupQuery by_speed{.aggregates = {parse_aggregate("mean speed weighted speed")}};
  CHECK(number(by_speed) == Approx(30.0 / 8));
  CHECK(run_group_query(database, by_speed).columns == std::vector<std::string>{"mean_speed_weighted"});
  const ComputedColumn share{
      "share", {"speed"}, [](std::span<const double> speed) { return speed[0] < 3 ? 0.25 : 0.5; }};
  CHECK(number({.aggregates = {parse_aggregate("mean speed weighted share")}, .computed = {share}}) == Approx(3.25));
  CHECK(number({.aggregates = {parse_aggregate("sum speed weighted share")}, .computed = {share}}) == Approx(3.25));
  const ComputedColumn absent{"half", {"speed"}, [](std::span<const double> speed) {
                                return speed[0] > 4 ? std::numeric_limits<double>::quiet_NaN() : speed[0];
                              }};
  CHECK(number({.aggregates = {parse_aggregate("mean half weighted speed")}, .computed = {absent}}) == Approx(5.0 / 3));
  CHECK(message_of([] { parse_aggregate("max speed weighted load"); }).find("only a mean and a sum") !=
        std::string::npos);
  CHECK(message_of([&] {
          number({.aggregates = {parse_aggregate("mean speed weighted method")}});
        }).find("it is a text") != std::string::npos);
}
