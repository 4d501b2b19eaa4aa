#include "studies/run/forked_work.hpp"

#include <unistd.h>

#include <csignal>
#include <map>
#include <string>
#include <vector>

#include "tests/catch.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

TEST_CASE("work in child processes is answered piece by piece, whatever the number of processes",
          "[studies][forked_work]") {
  for (const int jobs : {1, 3}) {
    std::map<std::size_t, std::string> answers;
    ForkedWork work{.pieces = 20, .jobs = jobs};
    const pid_t parent = getpid();
    work.work = [&](std::size_t piece) {
      return getpid() == parent ? "not in a child" : std::string(piece * 10'000, 'x') + std::to_string(piece);
    };
    work.done = [&](PieceEnd end) {
      CHECK(end.death.empty());
      answers[end.piece] = end.answer;
      return true;
    };
    run_forked(work);
    REQUIRE(answers.size() == 20);
    for (const auto& [piece, answer] : answers)
      CHECK(answer == std::string(piece * 10'000, 'x') + std::to_string(piece));
  }
}

TEST_CASE("a piece of work that ends its process, throws or hangs costs itself alone", "[studies][forked_work]") {
  std::map<std::size_t, PieceEnd> ends;
  ForkedWork work{.pieces = 8, .jobs = 2, .time_limit = 0.5};
  work.work = [](std::size_t piece) {
    if (piece == 2) std::raise(SIGKILL);
    if (piece == 3) _exit(7);
    if (piece == 4) throw 1;
    if (piece == 5)
      for (;;) pause();
    return std::string("well");
  };
  work.done = [&](const PieceEnd& end) {
    ends[end.piece] = end;
    return end.death.empty();
  };
  run_forked(work);

  REQUIRE(ends.size() == 8);
  for (const std::size_t piece : {0, 1, 6, 7}) {
    CHECK(ends[piece].answer == "well");
    CHECK(ends[piece].death.empty());
  }
  CHECK_THAT(ends[2].death, Contains("signal 9"));
  CHECK_THAT(ends[3].death, Contains("exit status 7"));
  CHECK_THAT(ends[4].death, Contains("signal 6"));
  CHECK(ends[5].out_of_time);
  for (const auto& [piece, end] : ends) CHECK(end.out_of_time == (piece == 5));
}

TEST_CASE("work in child processes stops when it is asked to", "[studies][forked_work]") {
  std::atomic<bool> stop = false;
  std::size_t answered = 0;
  ForkedWork work{.pieces = 1000, .jobs = 2};
  work.stop = &stop;
  work.work = [](std::size_t piece) {
    if (piece > 10)
      for (;;) pause();
    return std::string();
  };
  work.done = [&](const PieceEnd&) {
    if (++answered == 10) stop = true;
    return true;
  };
  run_forked(work);
  CHECK(answered >= 10);
  CHECK(answered <= 11);  // the other child may have had its answer ready
}
