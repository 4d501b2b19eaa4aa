#include "studies/run/work_list.hpp"

#include <set>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

std::vector<std::string> numbered(int count) {
  std::vector<std::string> keys;
  for (int i = 0; i < count; ++i) keys.push_back("key " + std::to_string(i));
  return keys;
}

}  // namespace

TEST_CASE("points that are stored, or that another point equals, are not handed out", "[studies][work_list]") {
  const std::set<std::string> stored{"b"};
  const std::vector<std::string> keys{"a", "b", "c", "a", "d"};
  WorkList list(keys, {false, true, false, false, false}, [&](const std::string& key) { return stored.contains(key); });
  CHECK(list.open() == 3);
  CHECK(list.next() == 0u);
  CHECK(list.next() == 2u);
  CHECK(list.next() == 4u);
  CHECK_FALSE(list.next());
  CHECK_FALSE(WorkList({}, {}, [](const std::string&) { return false; }).next());
}

TEST_CASE("two processes that start together on one study do little twice", "[studies][work_list]") {
  std::set<std::string> stored;
  auto known = [&](const std::string& key) { return stored.contains(key); };
  const auto keys = numbered(1000);
  const std::vector<bool> none(keys.size(), false);
  WorkList first(keys, none, known), second(keys, none, known);
  std::size_t solved = 0;
  for (bool left = true; left;) {
    const auto one = first.next(), two = second.next();  // solved at the same time, the first stores first
    left = one || two;
    if (one) {
      ++solved;
      if (!stored.insert(keys[*one]).second) first.move_away();
    }
    if (two) {
      ++solved;
      if (!stored.insert(keys[*two]).second) second.move_away();
    }
  }
  CHECK(stored.size() == keys.size());
  CHECK(solved <= keys.size() + 20);  // one meeting for each halving of the longest open stretch
}
