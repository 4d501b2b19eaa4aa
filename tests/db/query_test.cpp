#include "db/query.hpp"

#include "db/result_store.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

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
