#include "studies/drawing/text_plot.hpp"

#include <limits>

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("points stand as letters where their numbers are, lowest at the bottom left",
          "[studies][drawing][text_plot]") {
  const std::string plot =
      text_plot({"speed [m/s]", true}, {"load [N]"}, {{"one", {{0.1, 1}, {0.9, 2}, {10, 3}}}, {"two", {{10, 1}}}}, 33, 3);
  CHECK(plot ==
        "load [N]\n"
        "3 |                             a\n"
        "  |              a\n"
        "1 |a                            b\n"
        "  +------------------------------\n"
        "   0.1       speed [m/s]       10\n"
        "a one  b two\n");
}

TEST_CASE("what has no number is left out, and without any there is no plot", "[studies][drawing][text_plot]") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  CHECK(text_plot({"x"}, {"y"}, {{"", {{1, none}}}}, 40, 5).empty());
  CHECK(text_plot({"x", true}, {"y"}, {{"", {{-1, 1}}}}, 40, 5).empty());
  CHECK(text_plot({"x"}, {"y"}, {{"", {{1, 1}}}}, 40, 5).find('o') != std::string::npos);
}
