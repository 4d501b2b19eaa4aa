#include "core/numerics/parallel.hpp"

#include <stdexcept>

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("each piece of work is done once, by however many threads", "[core][parallel]") {
  for (const int jobs : {0, 1, 2, 7}) {
    std::vector<std::atomic<int>> done(100);
    for_each_piece(done.size(), jobs, [&](std::size_t piece) { ++done[piece]; });
    CHECK(std::all_of(done.begin(), done.end(), [](const std::atomic<int>& count) { return count == 1; }));
  }
  for_each_piece(0, 3, [](std::size_t) { throw std::logic_error("nothing to do"); });
  CHECK(jobs_for(5, 3) == 3);
  CHECK(jobs_for(2, 3) == 2);
  CHECK(cores_for_each(1000000) == 1);
}

TEST_CASE("an exception of one piece is thrown again after all have ended", "[core][parallel]") {
  std::atomic<int> running = 0;
  const auto work = [&](std::size_t piece) {
    ++running;
    --running;
    if (piece == 3) throw std::runtime_error("three");
  };
  CHECK_THROWS_WITH(for_each_piece(50, 4, work), "three");
  CHECK(running == 0);
}
