#include "core/zones/pattern_mending.hpp"

#include <cmath>

#include "core/model/contact_surface.hpp"
#include "tests/core/zones/spectral_scenes.hpp"

using namespace rollres;

namespace {

/// A state of which only the zones count.
SpectralState zoned(std::vector<int> slips, std::vector<Interval> sticks) {
  SpectralState state;
  state.pattern = {.shear = true, .slips = std::move(slips)};
  state.edges = {{-1, 1}, std::move(sticks)};
  return state;
}

class Mending {
 public:
  std::optional<PatternStart> operator()(const SpectralState& state, std::span<const WrongRun> runs) const {
    return mended(problem_, state, runs);
  }
  std::optional<PatternStart> operator()(const SpectralState& state, const WrongRun& run) const {
    return mended(problem_, state, {&run, 1});
  }

 private:
  ContactModel model_ = gridless_cylinder(0.2);
  SpectralProblem problem_{model_, near_spectrum(model_), 4e-3};
};

/// Zones follow one another from the trailing to the leading edge.
void check_order(const PatternStart& start) {
  REQUIRE(start.edges.sticks.size() == start.pattern.sticks());
  double at = start.edges.contact.from;
  for (const Interval& stick : start.edges.sticks) {
    CHECK(stick.from >= at);
    CHECK(stick.to > stick.from);
    at = stick.to;
  }
  CHECK(at <= start.edges.contact.to);
}

/// A rigid cylinder that rolls freely on a compressible elastic layer: zones of slip one way, the other and again.
RollingScene freely_rolling(double friction) {
  RollingScene scene;
  scene.indenter = Indenter::cylinder;
  scene.radius = 0.013;
  scene.layer_thickness = 1.65e-3;
  scene.poisson_ratio = 0.1;
  scene.static_shear_modulus = 1e6;
  scene.stiffening = 0;
  scene.inertia = Inertia::off;
  scene.speed = 0.1;
  scene.load = 140;
  scene.friction_coefficient = friction;
  scene.drive = Drive::free;
  return scene;
}

}  // namespace

TEST_CASE("a stick slips where it is overloaded", "[core][spectral]") {
  const Mending mend;
  SECTION("in its middle") {
    const auto start = mend(zoned({1, -1}, {{-0.5, 0.5}}), {true, 0, 1, -0.1, 0.2, 0.1});
    REQUIRE(start);
    CHECK(start->pattern.slips == std::vector<int>{1, 1, -1});
    CHECK(start->edges.sticks[0].to == -0.1);
    CHECK(start->edges.sticks[1].from == 0.2);
    check_order(*start);
  }
  SECTION("behind slip the other way, with a stick between") {
    const auto start = mend(zoned({1, -1}, {{-0.5, 0.5}}), {true, 0, 1, 0.3, 0.5, 0.1});
    REQUIRE(start);
    CHECK(start->pattern.slips == std::vector<int>{1, 1, -1});
    CHECK(start->edges.sticks[1].to == 0.5);
    check_order(*start);
  }
  SECTION("up to the trailing edge") {
    const auto start = mend(zoned({0, -1}, {{-1, 0.5}}), {true, 0, -1, -1, -0.8, 0.1});
    REQUIRE(start);
    CHECK(start->pattern.slips == std::vector<int>{-1, -1});
    CHECK(start->edges.sticks[0].from == -0.8);
  }
  SECTION("but not next to slip the same way, whose border the search moves") {
    CHECK_FALSE(mend(zoned({1, -1}, {{-0.5, 0.5}}), {true, 0, -1, 0.3, 0.5, 0.1}));
  }
}

TEST_CASE("a stick that is overloaded at the leading edge slips from where it is", "[core][spectral]") {
  const ContactModel model = gridless_cylinder(0.1);
  const SpectralProblem problem(model, near_spectrum(model), 4e-3);
  const std::optional<SpectralState> smooth = frictionless_start(problem);
  REQUIRE(smooth);
  const std::optional<PatternStart> behind = one_border_start(problem, smooth->edges.contact);
  REQUIRE(behind);
  REQUIRE(behind->pattern.slips.back() == 0);
  const std::optional<SpectralState> state = EdgeSearch(problem, behind->pattern).find(behind->edges, {24, 24}, 1e-9);
  REQUIRE(state);
  const std::vector<WrongRun> runs = assess(problem, *state).wrong_runs;
  REQUIRE(runs.size() == 1);
  const std::optional<PatternStart> start = mended(problem, *state, runs);
  REQUIRE(start);
  check_order(*start);
  CHECK(start->pattern.slips.back() == runs[0].direction);
  CHECK(start->edges.sticks.back().to ==
        Approx(runs[0].from).margin(0.05 * (start->edges.contact.to - start->edges.contact.from)));
}

TEST_CASE("what is wrong at both edges is mended at once", "[core][spectral]") {
  const Mending mend;
  const std::vector<WrongRun> within{{true, 0, 1, 0.1, 0.2, 0.1}, {true, 0, -1, -0.2, -0.1, 0.1}};
  CHECK_FALSE(mend(zoned({1, -1}, {{-0.5, 0.5}}), within));  // two in one stick
  const std::vector<WrongRun> apart{{false, 1, 1, 0.6, 1, 0.1}, {false, 0, -1, -1, -0.6, 0.1}};
  const auto start = mend(zoned({1, -1}, {{-0.5, 0.5}}), apart);
  REQUIRE(start);
  CHECK(start->pattern.slips == std::vector<int>{-1, 1, -1, 1});
  check_order(*start);
}

TEST_CASE("slip against its shear becomes slip the other way, or stick", "[core][spectral]") {
  const Mending mend;
  SECTION("over a short stick at the edge of contact") {
    const auto start = mend(zoned({1, -1}, {{-0.5, 0.5}}), {false, 0, -1, -1, -0.9, 0.1});
    REQUIRE(start);
    CHECK(start->pattern.slips == std::vector<int>{-1, 1, -1});
    CHECK(start->edges.sticks[0].centre() == Approx(-0.9));
    check_order(*start);
  }
  SECTION("at the leading edge as at the trailing one") {
    const auto start = mend(zoned({1, -1}, {{-0.5, 0.5}}), {false, 1, 1, 0.6, 1, 0.1});
    REQUIRE(start);
    CHECK(start->pattern.slips == std::vector<int>{1, -1, 1});
    check_order(*start);
    const auto mirrored = mend(zoned({-1, 1}, {{-0.5, 0.5}}), {false, 0, 1, -1, -0.6, 0.1});
    REQUIRE(mirrored);
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(start->edges.sticks[i].from == Approx(-mirrored->edges.sticks[1 - i].to));
      CHECK(start->edges.sticks[i].to == Approx(-mirrored->edges.sticks[1 - i].from));
    }
  }
  SECTION("by a stick in the middle of a zone") {
    const auto start = mend(zoned({1, -1}, {{-0.5, 0.5}}), {false, 0, -1, -0.8, -0.7, 0.1});
    REQUIRE(start);
    CHECK(start->pattern.slips == std::vector<int>{1, 1, -1});
    check_order(*start);
  }
  SECTION("all over a zone at the edge, which turns round") {
    const auto start = mend(zoned({1, -1}, {{-0.5, 0.5}}), {false, 0, -1, -1, -0.5, 0.1});
    REQUIRE(start);
    CHECK(start->pattern.slips == std::vector<int>{-1, -1});
  }
  SECTION("all over a zone between two sticks, which become one") {
    const auto start = mend(zoned({1, -1, 1}, {{-0.5, -0.2}, {0.1, 0.5}}), {false, 1, 1, -0.2, 0.1, 0.1});
    REQUIRE(start);
    CHECK(start->pattern.slips == std::vector<int>{1, 1});
    CHECK(start->edges.sticks[0].from == -0.5);
    CHECK(start->edges.sticks[0].to == 0.5);
  }
  SECTION("but not next to a stick, whose border the search moves") {
    CHECK_FALSE(mend(zoned({1, -1}, {{-0.5, 0.5}}), {false, 0, -1, -0.7, -0.5, 0.1}));
  }
}

TEST_CASE("rolling freely on a compressible layer has slip of both directions, as on a fine grid", "[core][spectral]") {
  for (const double friction : {0.1, 0.3, 0.6}) {
    RollingScene gridded = freely_rolling(friction);
    gridded.spacing = 1e-6;
    const RollingSolution fine = solve(gridded), smooth = spectral(freely_rolling(friction));
    CAPTURE(friction);
    CHECK(std::abs(smooth.rolling_resistance - fine.rolling_resistance) <
          smooth.rolling_resistance_error + fine.rolling_resistance_error);
    CHECK(smooth.rolling_resistance_error < 1e-5 * smooth.rolling_resistance);
    CHECK(smooth.rotation_ratio == Approx(fine.rotation_ratio).epsilon(1e-6));
  }
}

TEST_CASE("free rolling is not refused where sliding all over has no solution", "[core][spectral]") {
  RollingScene scene = freely_rolling(0.5);
  scene.radius = 0.0339;
  scene.layer_thickness = 0.388e-3;
  scene.poisson_ratio = 0.45;
  scene.load.reset();
  scene.approach = 0.215e-3;
  scene.tolerance = 1e-3;
  CHECK(solve(scene).status == Status::converged);
}
