#include "studies/text/words.hpp"

#include <sstream>

#include "studies/text/table_output.hpp"
#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("lists of words are taken apart and put together again", "[studies][words]") {
  CHECK(split_at_commas("speed, load ,drive") == std::vector<std::string>{"speed", "load", "drive"});
  CHECK(split_at_commas("").empty());
  CHECK(split_at_commas("a,,b") == std::vector<std::string>{"a", "", "b"});
  CHECK(joined(std::vector<std::string>{"speed", "load"}) == "speed, load");
  CHECK(joined(std::vector<std::string>{}) == "");
  CHECK(joined(std::vector<int>{1, 2, 3}, " x ", [](int one) { return std::to_string(one); }) == "1 x 2 x 3");
  CHECK(trimmed(" \t a b\r ") == "a b");
  CHECK(trimmed("  ") == "");
}

TEST_CASE("a word of the shell and the name of a file hold what they are given", "[studies][words]") {
  CHECK(shell_word("it's") == "'it'\\''s'");
  CHECK(file_name("speed / load: 1") == "speed___load__1");
  CHECK(file_name("..") == "_");
  CHECK(file_name(std::string(300, 'a')).size() == 120);
}

TEST_CASE("texts of an aligned table stand to the left, numbers to the right", "[studies][table_output]") {
  const Table table{{"name", "n"}, {{std::string("µ"), std::int64_t{7}}, {Cell(), 12.5}}};
  std::ostringstream plain, indented;
  write_aligned(plain, table);
  CHECK(plain.str() == "name     n\nµ        7\n-     12.5\n");
  write_aligned(indented, {{"", ""}, {{std::string("key"), std::string("1 m")}, {Cell(), std::string("2 m")}}}, "",
                "  ");
  CHECK(indented.str() == "  key  1 m\n       2 m\n");
}
