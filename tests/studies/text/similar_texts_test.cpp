#include "studies/text/similar_texts.hpp"

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("messages that differ in their numbers only become one with the ranges of these", "[studies][words]") {
  const std::vector<std::string> texts{"at 2 m/s, a = 1e-3", "no answer", "at 10 m/s, a = 5e-4", "at rest"};
  const std::string both = "at 2 to 10 m/s, a = 5e-4 to 1e-3";
  CHECK(with_ranges(texts) == std::vector<std::string>{both, "no answer", both, "at rest"});
  CHECK(with_ranges({"at 2 m/s", "at 2 m/s"}) == std::vector<std::string>{"at 2 m/s", "at 2 m/s"});
  CHECK(with_ranges({"1.5e-06 of 3. and 4e, 7e+2x"}) == std::vector<std::string>{"1.5e-06 of 3. and 4e, 7e+2x"});
  CHECK(with_ranges({"1e3 then 1000", "1000 then 2"}) == std::vector<std::string>(2, "1e3 then 2 to 1000"));
  CHECK(with_ranges({}).empty());
}
