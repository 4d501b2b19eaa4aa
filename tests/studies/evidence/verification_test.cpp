#include "studies/evidence/verification.hpp"

#include <algorithm>
#include <set>

#include "studies/text/strict_json.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"

// Covers command_verify, verification_checks, verification_inside, verification_heat and verification_bodies, too.

using namespace rollres;
using Catch::Matchers::Contains;

TEST_CASE("each case of the verification stands once, and names its source and why it may differ as it may",
          "[studies][verify]") {
  // That the program passes them is seen where the README's table is compared (readme_test.cpp).
  const std::vector<VerificationRow> rows = verify(closed_form);
  std::set<std::string> names;
  for (const VerificationRow& row : rows) {
    INFO(row.quantity << " (" << row.source << ")");
    CHECK_FALSE(row.source.empty());
    CHECK_FALSE(row.allowance.empty());
    CHECK(names.insert(row.quantity + row.source).second);
  }
  CHECK(rows.size() > 40);
}

TEST_CASE("a difference is relative, absolute where zero is expected, and no answer passes nothing",
          "[studies][verify]") {
  VerificationRow row;
  row.expected = 200;
  row.got = 202;
  row.tolerance = 0.01;
  CHECK(row.difference() == Approx(0.01));
  CHECK(row.passed() == (row.difference() <= 0.01));
  row.got = 203;
  CHECK_FALSE(row.passed());
  row.expected = 0;
  row.got = -0.01;
  CHECK(row.passed());
  row.got = RollingSolution::absent;
  CHECK_FALSE(row.passed());
}

TEST_CASE("rollres verify ends with status 1 where a solver is wrong or has no answer", "[studies][verify]") {
  const ProgramRun wrong = run_rollres({"verify"}, closed_form);
  CHECK(wrong.status == 1);
  CHECK_THAT(wrong.out, Contains("FAIL") && Contains("Hunter (1961)"));

  const ProgramRun summary = run_rollres({"verify", "--summary", "--format", "markdown"}, closed_form);
  CHECK(summary.status == 1);
  CHECK_THAT(summary.out, Contains("| source ") && Contains("| Hunter (1961) ") && !Contains("Vτ/a = 0.1,"));

  const Evaluate silent = [](const RollingScene&) -> RollingSolution { throw std::runtime_error("no solver today"); };
  const ProgramRun none = run_rollres({"verify", "--json"}, silent);
  CHECK(none.status == 1);
  const Json object = parse_object(none.out, "output");
  constexpr int given = 8;  // stresses under bells and temperatures of given losses, which need no solver
  CHECK(object["passed"] == given);
  CHECK(object["failed"] == object["rows"].size() - given);
  CHECK(object["rows"][0]["got"].is_null());
  CHECK_THAT(object["rows"][0]["reason"].get<std::string>(), Contains("no solver today"));
}
