#include "studies/drawing/colour_map.hpp"

#include <sstream>

#include "tests/catch.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

TEST_CASE("logarithmic levels enclose the values with round numbers", "[studies][chart]") {
  CHECK(logarithmic_levels(1.5, 80) == std::vector<double>{1, 2, 5, 10, 20, 50, 100});
  CHECK(logarithmic_levels(1, 100) == std::vector<double>{1, 2, 5, 10, 20, 50, 100});
  CHECK(logarithmic_levels(3, 3.5) == std::vector<double>{2, 5});
  CHECK(logarithmic_levels(10, 10) == std::vector<double>{10, 20});
  const std::vector<double> many = logarithmic_levels(0.05, 2500);  // nearly five decades
  CHECK(many.front() == Approx(0.03));
  CHECK(many.back() == Approx(3000));
  CHECK(many.size() == 11);
  CHECK(logarithmic_levels(1e-6, 1e6).size() == 13);
}

TEST_CASE("even levels leave out zero where all values are far from it", "[studies][chart]") {
  const ColourBands far = ColourBands::between(301, 362);
  CHECK(far.levels.front() == Approx(300));
  CHECK(far.levels.back() == Approx(370));
  CHECK(far.step() == Approx(10));
  CHECK(ColourBands::between(10, 362).levels.front() == 0);
  CHECK(ColourBands::between(-3, 4).diverging);
  CHECK(ColourBands::between(5, 5).levels.size() >= 2);
  const ColourBands below = ColourBands::between(-362, -301);
  CHECK(below.levels.front() == Approx(-370));
  CHECK(below.levels.back() == Approx(-300));
}

TEST_CASE("few bands have a colour each, from the first of the palette to its last", "[studies][chart]") {
  std::ostringstream script;
  write_numbered_colours(script, {1, 2, 5, 10}, "R");
  CHECK_THAT(script.str(), Contains("0 '#440154', 1 '#440154', 1 '#21918C', 2 '#21918C', 2 '#FDE725', 3 '#FDE725'"));
  CHECK_THAT(script.str(), Contains("set cbrange [0:3]") && Contains("set cbtics ('1' 0, '2' 1, '5' 2, '10' 3)"));
}
