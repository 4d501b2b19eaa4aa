#include "core/numerics/recently_made.hpp"

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/influence/passage_kernel.hpp"
#include "core/numerics/solution_limits.hpp"
#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("what was made is kept until it is forgotten, and lives on with who holds it", "[core][recently_made]") {
  static RecentlyMade<int, int, 2> squares;
  int made = 0;
  const auto square = [&](int key) {
    return squares(key, [&] {
      ++made;
      return key * key;
    });
  };
  const auto nine = square(3);
  CHECK(square(3) == nine);
  CHECK(made == 1);
  square(4);
  square(3);
  square(5);  // the least recently used, 4, goes
  CHECK(square(3) == nine);
  CHECK(made == 3);
  square(4);
  CHECK(made == 4);
  forget_kernels();
  CHECK(square(3) != nine);
  CHECK(*nine == 9);
  CHECK(made == 5);
}

TEST_CASE("of threads that ask for the same one makes it, and the next does if that one fails",
          "[core][recently_made]") {
  static RecentlyMade<int, int, 2> doubles;
  std::atomic<int> begun = 0, asking = 0;
  const auto make = [&] {
    // Until all ask, so that none finds it made.
    while (asking < 4) std::this_thread::yield();
    if (++begun == 1) throw std::runtime_error("the first one fails");
    return 14;
  };
  std::atomic<int> answers = 0, failures = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      ++asking;
      try {
        answers += *doubles(7, make) == 14;
      } catch (const std::runtime_error&) {
        ++failures;
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(failures == 1);
  CHECK(answers == 3);
  CHECK(begun == 2);
}

TEST_CASE("who waits for what another thread makes ends when asked to", "[core][recently_made]") {
  static RecentlyMade<int, int, 2> slow;
  std::atomic<bool> begun = false, end = false;
  std::thread maker([&] {
    slow(1, [&] {
      begun = true;
      while (!end) std::this_thread::yield();
      return 1;
    });
  });
  while (!begun) std::this_thread::yield();
  {
    const Interruptible stop([] { return true; });
    const SolutionLimits limits(1e9);
    CHECK_THROWS_AS(slow(1, [] { return 2; }), Interrupted);
  }
  end = true;
  maker.join();
  CHECK(*slow(1, [] { return 2; }) == 1);
}

TEST_CASE("a kernel of more rows serves fewer, one of other columns does not, and all are forgotten together",
          "[core][recently_made]") {
  const auto kernel = [](int columns, int rows) {
    return shared_passage_kernel(3, Layer(0.005), 1e-3, 1e-3, columns, rows);
  };
  const auto cylinder = [] { return shared_passage_kernel(2, Layer(0.005, 0.4), 1e-3, 1e-3, 3, 0); };
  const auto large = kernel(4, 3), line = cylinder();
  CHECK(kernel(4, 2) == large);
  CHECK(kernel(3, 3) != large);
  CHECK(cylinder() == line);
  forget_kernels();
  CHECK(kernel(4, 3) != large);
  CHECK(cylinder() != line);
}
