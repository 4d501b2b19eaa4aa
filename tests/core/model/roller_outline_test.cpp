#include "core/model/roller_outline.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// A roller with a groove of 2 mm on one side of its middle and rounded ends.
RollerOutline grooved() {
  return {0.02, {-0.01, -0.008, -0.002, -0.001, 0.001, 0.002, 0.008, 0.01}, {3e-3, 0, 0, 0, 0, 1e-3, 0, 3e-3}};
}

}  // namespace

TEST_CASE("a profile passes through its points and is monotone between them", "[core][roller_outline]") {
  const std::vector<double> places{-0.01, -0.004, 0, 0.003, 0.01}, heights{4e-3, 1e-4, 0, 0, 6e-3};
  const RollerOutline outline(0.02, places, heights);
  for (std::size_t i = 0; i < places.size(); ++i)
    CHECK(outline.squared_radius(places[i]) == Approx(std::pow(0.02 - heights[i], 2)).epsilon(1e-14));
  double before = 0;
  for (int i = 0; i <= 100; ++i) {
    const double fallen = outline.fallen_square(0.003 + 7e-5 * i);
    CHECK(fallen >= before);
    before = fallen;
    CHECK(outline.fallen_square(3e-5 * i) == 0);
  }
  CHECK_FALSE(outline.even());
  CHECK(outline.reach() == 0.01);
  CHECK(outline.reaches(0.01));
  CHECK_FALSE(outline.reaches(0.0101));
}

TEST_CASE("the slope of an outline is that of its radius", "[core][roller_outline]") {
  constexpr double step = 1e-7;
  for (const RollerOutline& outline :
       {grooved(), RollerOutline(0.02, 0.05, Crown::circle), RollerOutline(0.02, 0.05, Crown::ellipse)})
    for (const double along : {-0.0093, -0.0061, 0.0013, 0.0051}) {
      const double change = outline.squared_radius(along + step) - outline.squared_radius(along - step);
      CHECK(outline.half_slope(along) == Approx(change / (4 * step)).margin(1e-9));
    }
}

TEST_CASE("the lowest place of a profile is the middle of what is lowest", "[core][roller_outline]") {
  const RollerOutline flat(0.02, {-0.01, -0.004, 0.006, 0.01}, {1e-3, 0, 0, 1e-3});
  CHECK(flat.lowest(0).along == Approx(0.001).epsilon(1e-12));
  CHECK(flat.lowest(0).depth == Approx(0.02).epsilon(1e-14));
  // A raised left end, y > 0, lowers the right one.
  CHECK(flat.lowest(0.1).along < -0.004 + 1e-9);
  CHECK(flat.lowest(-0.1).along > 0.006 - 1e-9);
}

TEST_CASE("a camber that hides the bottom of a groove is found", "[core][roller_outline]") {
  const RollerOutline outline = grooved();
  CHECK_FALSE(outline.hidden_place(0));
  CHECK_FALSE(outline.hidden_place(0.1));
  CHECK(outline.hidden_place(0.75));
  const RollerOutline round(0.02, {-0.01, -0.008, 0.008, 0.01}, {9e-3, 0, 0, 9e-3});
  CHECK_FALSE(round.hidden_place(0.75));  // its end turns back for good
}

TEST_CASE("the shortest flank of a profile is that of its narrowest deep hollow", "[core][roller_outline]") {
  CHECK(grooved().shortest_flank(0.5e-3) == Approx(1e-3));
  CHECK(std::isinf(grooved().shortest_flank(2e-3)));
  CHECK(std::isinf(RollerOutline(0.02, 0.05, Crown::circle).shortest_flank(1e-6)));
}

TEST_CASE("a profile is even where its points are mirror images", "[core][roller_outline]") {
  CHECK(RollerOutline(0.02, {-0.01, 0, 0.01}, {1e-3, 0, 1e-3}).even());
  CHECK_FALSE(RollerOutline(0.02, {-0.01, 0, 0.0101}, {1e-3, 0, 1e-3}).even());
  CHECK_FALSE(RollerOutline(0.02, {-0.01, 0, 0.01}, {1e-3, 0, 1.1e-3}).even());
}
