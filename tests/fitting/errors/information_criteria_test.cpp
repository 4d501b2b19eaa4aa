#include "fitting/errors/information_criteria.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("criteria of models are those of least squares with the scale known or fitted", "[fitting][criteria]") {
  // Ten values, three parameters, by hand: 12 + 6 + 24/6, 12 + 3 ln 10.
  const InformationCriteria known = information_criteria(12, 10, 3, true);
  CHECK(known.likelihood == Approx(12));
  CHECK(known.aicc == Approx(22));
  CHECK(known.bic == Approx(12 + 3 * std::log(10)));
  // The scale is a fourth: 10 ln 1.2 + 8 + 40/5.
  const InformationCriteria scaled = information_criteria(12, 10, 3, false);
  CHECK(scaled.likelihood == Approx(10 * std::log(1.2)));
  CHECK(scaled.aicc == Approx(10 * std::log(1.2) + 16));
  CHECK(scaled.bic == Approx(10 * std::log(1.2) + 4 * std::log(10)));
  // A fit that widens its deviations pays for it.
  CHECK(information_criteria(12, 10, 3, true, 5).likelihood == Approx(17));
  // As many parameters as values, but one: nothing is left to correct by.
  CHECK(std::isinf(information_criteria(12, 4, 3, true).aicc));
}
