#include "core/solve/doubts.hpp"

#include "core/solve/resolve.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

// What an answer must break to be none: each is a good answer with one number changed.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

struct Answered {
  ContactModel model;
  RollingSolution solution;
};

Answered good_answer() {
  const RollingScene scene = paper_cylinder();
  Answered answered{resolve(scene), solve(scene)};
  REQUIRE(answered.solution.status == Status::converged);
  REQUIRE(doubt(answered.model, answered.solution).empty());
  return answered;
}

}  // namespace

TEST_CASE("an answer that breaks a law, gains power or does not balance it is none", "[core][doubts]") {
  const auto [model, good] = good_answer();
  RollingSolution broken = good;
  broken.law_violation = 1e-6;
  CHECK_THAT(doubt(model, broken),
             Contains("a law of contact is violated by 1e-06, more than 1e-08: take another spacing"));
  broken.method = Method::spectral;
  CHECK_THAT(doubt(model, broken), Contains(": take method \"newton\""));
  broken.method = Method::active_set;
  CHECK_THAT(doubt(model, broken), Contains(": take method \"newton\", or another spacing"));
  broken = good;
  broken.rolling_resistance *= -1;
  CHECK_THAT(doubt(model, broken), Contains("the body would gain power"));
  broken = good;
  broken.energy_residual = 0.5;
  CHECK_THAT(doubt(model, broken), Contains("the power balance misses 0.5 of it"));
  broken = good;
  broken.rolling_resistance_error = NAN;
  CHECK_THAT(doubt(model, broken), Contains("cannot be estimated"));
}

TEST_CASE("an error larger than the resistance is no answer, but where a layer hardly resists", "[core][doubts]") {
  const auto [model, good] = good_answer();
  CHECK(unknown_resistance(model, good).empty());
  RollingSolution open = good;
  open.rolling_resistance_error = 1.1 * open.rolling_resistance;
  CHECK_THAT(unknown_resistance(model, open),
             Contains("more than itself: give a smaller spacing, or a tolerance in its place"));
  open.rolling_resistance *= 1e-6;
  open.rolling_resistance_error *= 1e-6;
  CHECK(unknown_resistance(model, open).empty());
}

TEST_CASE("what the balance of power misses is in the stated error", "[core][doubts]") {
  const auto [model, good] = good_answer();
  RollingSolution taken = good;
  take_evidence(model, taken);
  CHECK(taken.error_estimate == good.error_estimate);
  taken.energy_residual = 0.02;
  take_evidence(model, taken);
  CHECK(taken.error_estimate == 0.02);
  CHECK(taken.rolling_resistance_error == Approx(0.02 * good.rolling_resistance));
  CHECK(misses_tolerance(model, 0.01, taken));
  CHECK_FALSE(misses_tolerance(model, 0.03, taken));
  CHECK_FALSE(misses_tolerance(model, std::nullopt, taken));
}
