#include "core/numerics/recently_made.hpp"

#include "core/influence/passage_kernel.hpp"
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
