#include "db/rows/study_upkeep.hpp"

#include "db/rows/result_store.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

TEST_CASE("studies are renamed, noted and deleted, and only rows of none are pruned", "[db][upkeep]") {
  const TemporaryDirectory folder;
  ResultStore store(folder / "a.db");
  std::vector<std::string> keys;
  for (const double speed : {1.0, 2.0, 3.0}) {
    const RollingScene scene = plain_scene(speed);
    const Evaluation one{evaluation_key(scene), scene, closed_form(scene)};
    store.save({&one, 1});
    keys.push_back(one.key);
  }
  store.start_study({"one", {"speed"}, "{}"}, std::span(keys).first(2));
  store.start_study({"other", {"speed"}, "{}"}, std::span(keys).subspan(1, 1));
  const Database& database = store.database();

  rename_study(database, "one", "first");
  CHECK_FALSE(store.study("one"));
  CHECK(store.points("first").size() == 2);
  CHECK(message_of([&] { rename_study(database, "first", "other"); }).ends_with("study = other: is there already"));
  CHECK(message_of([&] { rename_study(database, "one", "new"); }) == "study = one: there is no such study");
  set_note(database, "first", "second supplier; 'quoted'");
  CHECK(store.study("first")->note == "second supplier; 'quoted'");
  CHECK(store.study("other")->note.empty());

  CHECK(rows_of_no_study(database) == 1);
  delete_study(database, "first");
  CHECK(rows_of_no_study(database) == 2);
  CHECK(store.contains(keys[0]));
  delete_rows_of_no_study(database);
  CHECK_FALSE(store.contains(keys[0]));
  CHECK(store.contains(keys[1]));
  CHECK(store.study("other")->answered == 1);
  CHECK(message_of([&] { delete_study(database, "first"); }) == "study = first: there is no such study");
}
