#include "studies/run/progress.hpp"

#include <sstream>

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("the progress line tells rate, time left and failures, and never breaks", "[studies][progress]") {
  const SweepProgress halfway{.to_solve = 180, .solved = 90, .failed = 2, .left = 88, .seconds = 45};
  CHECK(progress_line(halfway, 100) == "[##################-------------------] 90 of 180, 2/s, 45 s left, 2 failed");
  CHECK(progress_line({.to_solve = 180, .left = 180}, 60) == "[" + std::string(37, '-') + "] 0 of 180");
  const SweepProgress stopping{.to_solve = 3, .solved = 3, .seconds = 6e4, .stopping = true};
  for (std::size_t width = 1; width < 120; ++width) CHECK(progress_line(stopping, width).size() <= width);
}

TEST_CASE("durations are said as people say them", "[studies][progress]") {
  CHECK(duration_in_words(0.214) == "0.21 s");
  CHECK(duration_in_words(41.4) == "41 s");
  CHECK(duration_in_words(59.9) == "1:00");
  CHECK(duration_in_words(185) == "3:05");
  CHECK(duration_in_words(7800) == "2:10:00");
}

TEST_CASE("there is no progress line where nobody watches", "[studies][progress]") {
  std::ostringstream text;
  StatusLine line(text);
  line.show("57 of 180");
  CHECK_FALSE(line);
  CHECK(text.str().empty());
}
