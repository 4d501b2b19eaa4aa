#include "db/rows/result_store.hpp"
#include "core/model/scene_rules.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <set>

#include "db/rows/schema.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers evaluation_key, evaluation_row and digest, too.

using namespace rollres;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Gives each value another one than its default.
struct Different {
  double next = 0.1;
  void operator()(const Quantity&, double& value) { value = next += 1.0 / 3; }
  void operator()(const Quantity&, std::optional<double>& value) { value = next += 1.0 / 7; }
  void operator()(const Quantity&, int& value) { value = static_cast<int>(next += 2); }
  void operator()(const Quantity& quantity, std::string& value) {
    value = "text of " + std::string(quantity.key) + " μ";
  }
  void operator()(const Quantity&, std::vector<double>& value) { value = {next += 1.0 / 3, 1e-300 / 7, 1e17 / 3}; }
  void operator()(const Quantity&, BondedLayers& value) {
    value.resize(2);
    for (BondedLayer& layer : value) {
      visit_layer_inputs(layer, *this);
      layer.layer_thickness = &layer == &value.back() ? infinity : layer.layer_thickness;
    }
  }
  void operator()(const Quantity&, std::vector<std::string>& value) { value = {"first; 'quoted'", "second \"too\""}; }
  template <class Choice>
  requires std::is_enum_v<Choice>
  void operator()(const Quantity&, Choice& value) {
    value = static_cast<Choice>(ChoiceNames<Choice>::names.size() - 1);
  }
};

/// Values of a scene or solution as texts that differ whenever a bit does.
struct Bits {
  std::vector<std::string> all = {};
  void operator()(const Quantity& quantity, double value) {
    char text[64];
    std::snprintf(text, sizeof text, "%a", value);
    all.push_back(std::string(quantity.key) + " " + text);
  }
  void operator()(const Quantity& quantity, const std::optional<double>& value) {
    if (value)
      (*this)(quantity, *value);
    else
      all.push_back(std::string(quantity.key) + " none");
  }
  void operator()(const Quantity& quantity, const std::string& value) {
    all.push_back(std::string(quantity.key) + " " + value);
  }
  void operator()(const Quantity& quantity, const std::vector<double>& value) {
    for (const double number : value) (*this)(quantity, number);
  }
  void operator()(const Quantity&, const BondedLayers& value) {
    for (const BondedLayer& layer : value) visit_layer_inputs(layer, *this);
  }
  void operator()(const Quantity& quantity, const std::vector<std::string>& value) {
    for (const std::string& line : value) (*this)(quantity, line);
  }
  template <class Count>
  requires std::is_enum_v<Count> || std::is_integral_v<Count>
  void operator()(const Quantity& quantity, const Count& value) {
    all.push_back(std::string(quantity.key) + " " + std::to_string(static_cast<int>(value)));
  }
};

std::vector<std::string> bits(const RollingScene& scene, const RollingSolution& solution) {
  Bits found;
  visit_inputs(scene, found);
  visit_outputs(solution, found);
  return found.all;
}

Evaluation evaluation(const RollingScene& scene) { return {evaluation_key(scene), scene, closed_form(scene)}; }

void save(ResultStore& store, const std::vector<RollingScene>& scenes) {
  std::vector<Evaluation> all;
  for (const RollingScene& scene : scenes) all.push_back(evaluation(scene));
  store.save(all);
}

}  // namespace

TEST_CASE("every quantity returns from the store as it went in", "[db][result_store]") {
  const TemporaryDirectory folder;
  Evaluation full, empty, infinite;
  Different different;
  visit_inputs(full.scene, different);
  visit_outputs(full.solution, different);
  full.key = evaluation_key(full.scene);
  empty.key = "empty";
  infinite.scene = plain_scene();
  infinite.scene.layer_thickness = infinity;
  infinite.solution.rolling_resistance = -1e-300;
  infinite.solution.approach = 5e-324;
  infinite.key = evaluation_key(infinite.scene);

  ResultStore store(folder.path / "a.db");
  const std::vector<Evaluation> all{full, empty, infinite};
  REQUIRE(store.save(all) == 3);
  ResultStore reader(folder.path / "a.db", Access::read);
  for (const Evaluation& one : all) {
    const auto found = reader.find(one.key);
    REQUIRE(found);
    CHECK(bits(found->scene, found->solution) == bits(one.scene, one.solution));
    CHECK(found->provenance == this_program());
    CHECK(reader.find(found->id)->key == one.key);
  }
  CHECK_FALSE(reader.find("unknown"));
  CHECK_FALSE(reader.find(std::int64_t{4}));
}

TEST_CASE("a plain SQLite shell finds found and given values under their names", "[db][result_store]") {
  const TemporaryDirectory folder;
  RollingScene scene = plain_scene();
  scene.layer_thickness = infinity;
  Evaluation one = evaluation(scene);
  one.solution.load = 10001;
  one.solution.approach = 2e-4;
  ResultStore(folder.path / "a.db").save({&one, 1});
  SQLite::Database plain((folder.path / "a.db").string());
  CHECK(plain.execAndGet("SELECT given_load FROM evaluation").getDouble() == 1e4);
  CHECK(plain.execAndGet("SELECT load FROM evaluation").getDouble() == 10001);
  CHECK(plain.execAndGet("SELECT given_approach FROM evaluation").isNull());
  CHECK(plain.execAndGet("SELECT approach FROM evaluation").getDouble() == 2e-4);
  CHECK(plain.execAndGet("SELECT peak_shear_y FROM evaluation").isNull());
  CHECK(plain.execAndGet("SELECT layer_thickness = 9e999 FROM evaluation").getInt() == 1);
  CHECK(plain.execAndGet("SELECT indenter || given_method || status FROM evaluation").getString() ==
        "cylinderautomaticconverged");
}

TEST_CASE("0.3 and 0.1 + 0.2 are one evaluation, 0.3 and 0.300000000001 are two", "[db][result_store]") {
  CHECK(evaluation_key(plain_scene(0.3)) == evaluation_key(plain_scene(0.1 + 0.2)));
  CHECK(evaluation_key(plain_scene(0.3)) != evaluation_key(plain_scene(0.300000000001)));
  const TemporaryDirectory folder;
  ResultStore store(folder.path / "a.db");
  save(store, {plain_scene(0.3), plain_scene(0.1 + 0.2)});
  save(store, {plain_scene(0.1 + 0.2), plain_scene(0.300000000001)});
  CHECK(store.find(std::int64_t{2}));
  CHECK_FALSE(store.find(std::int64_t{3}));
  CHECK(store.find(evaluation_key(plain_scene(0.1 + 0.2)))->scene.speed == 0.3);
}

TEST_CASE("a method has one key whether it was named or chosen by itself", "[db][result_store]") {
  RollingScene scene = plain_scene(), named = scene;
  named.method = resolved_method(scene);
  REQUIRE(scene.method == Method::automatic);
  CHECK(evaluation_key(named) == evaluation_key(scene));
}

TEST_CASE("the key of an evaluation tells every input, given from absent, and the solver", "[db][result_store]") {
  RollingScene plain = plain_scene();
  plain.method = Method::newton;
  std::set<std::string> keys{evaluation_key(plain)};
  std::size_t inputs = 0;
  for (const std::string_view wanted : input_keys()) {
    RollingScene scene = plain;
    visit_inputs(scene, [&](const Quantity& quantity, auto& value) {
      if (quantity.key == wanted) Different{}(quantity, value);
    });
    keys.insert(evaluation_key(scene));
    ++inputs;
  }
  CHECK(keys.size() == inputs + 1);
  RollingScene zero = plain_scene(), negative = plain_scene(), none = plain_scene();
  zero.rotation_ratio = 0;
  negative.rotation_ratio = -0.0;
  CHECK(evaluation_key(zero) == evaluation_key(negative));
  CHECK(evaluation_key(zero) != evaluation_key(none));
  CHECK(evaluation_key(none, "a") != evaluation_key(none, "b"));
  CHECK(evaluation_key(none).size() == 32);
  CHECK(evaluation_key({}, "") == "fcc0f57607cd797b543108fdab85f7eb");  // FNV-1a of "solver=\nmethod=spectral"
}

TEST_CASE("two studies share the evaluations they have in common", "[db][result_store]") {
  const TemporaryDirectory folder;
  ResultStore store(folder.path / "a.db");
  auto keys_for = [](std::initializer_list<double> speeds) {
    std::vector<std::string> keys;
    for (const double speed : speeds) keys.push_back(evaluation_key(plain_scene(speed)));
    return keys;
  };
  store.start_study({"slow", {"speed"}, "{}"}, keys_for({1, 2, 3}));
  store.start_study({"fast", {"speed", "load"}, "{}"}, keys_for({3, 2, 4, 5}));
  RollingSolution failed;
  failed.status = Status::no_steady_state;
  failed.reason = "needs more friction";
  const Evaluation bad{evaluation_key(plain_scene(3)), plain_scene(3), failed};
  save(store, {plain_scene(1), plain_scene(2)});
  store.save({&bad, 1});

  const auto all = store.studies();
  REQUIRE(all.size() == 2);
  CHECK(all[0].name == "fast");
  CHECK(all[0].axes == std::vector<std::string>{"speed", "load"});
  CHECK(all[0].points == 4);
  CHECK(all[0].answered == 2);
  CHECK(all[0].failed == 1);
  CHECK(all[1].points == 3);
  CHECK(all[1].answered == 3);
  CHECK(store.find(evaluation_key(plain_scene(2)))->studies == std::vector<std::string>{"fast", "slow"});
  const auto failures = store.failures("fast");
  REQUIRE(failures.size() == 1);
  CHECK(failures[0].reason == "needs more friction");
  CHECK(failures[0].points == 1);

  SQLite::Statement order(store.database().connection(),
                          "SELECT speed FROM result WHERE study = 'fast' ORDER BY position");
  order.executeStep();
  CHECK(order.getColumn(0).getDouble() == 3);
  order.executeStep();
  CHECK(order.getColumn(0).getDouble() == 2);

  store.start_study({"fast", {"speed"}, "{}"}, keys_for({1}));
  CHECK(store.study("fast")->points == 1);
  CHECK(store.study("fast")->created == all[0].created);
  CHECK(store.study("slow")->answered == 3);
  CHECK_FALSE(store.study("none"));
}

TEST_CASE("a group of evaluations is stored whole or not at all", "[db][result_store]") {
  const TemporaryDirectory folder;
  ResultStore store(folder.path / "a.db");
  save(store, {plain_scene(1)});
  // Triggers, which a stranger's file may have, are off.
  sqlite3* const connection = store.database().connection().getHandle();
  REQUIRE(sqlite3_db_config(connection, SQLITE_DBCONFIG_ENABLE_TRIGGER, 1, nullptr) == SQLITE_OK);
  store.database().connection().exec(
      "CREATE TRIGGER full BEFORE INSERT ON evaluation WHEN NEW.speed = 4 "
      "BEGIN SELECT RAISE(ABORT, 'disk is full'); END");
  CHECK(message_of([&] {
          save(store, {plain_scene(2), plain_scene(3), plain_scene(4)});
        }) == (folder.path / "a.db").string() + ": disk is full");
  CHECK_FALSE(store.contains(evaluation_key(plain_scene(2))));
  save(store, {plain_scene(2), plain_scene(3)});
  CHECK(store.contains(evaluation_key(plain_scene(3))));
}
