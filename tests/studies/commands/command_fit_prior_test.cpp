#include <nlohmann/json.hpp>

#include "tests/catch.hpp"
#include "tests/studies/fit_files.hpp"
#include "tests/studies/half_space_fit.hpp"

using nlohmann::json;

TEST_CASE("what a former fit says, with its correlations, is worth its data", "[studies][fit]") {
  FitFiles files(0.002);  // so little that both fits are linear within their errors
  const std::size_t head = files.table.find('\n') + 1,
                    middle = files.table.find('\n', head + (files.table.size() - head) / 2) + 1;
  const std::string all = files.table, one = all.substr(0, middle), other = all.substr(0, head) + all.substr(middle);
  json file = half_space_fit();
  const auto fitted = [&](const std::string& name, const std::string& table) {
    files.table = table;
    file["fit"] = name;
    const ProgramRun run = files.run(file, {"--json", "--no-profiles"});
    INFO(run.err);
    REQUIRE(run.status == 0);
    return json::parse(run.out);
  };
  const json together = fitted("together", all), alone = fitted("alone", other);
  fitted("former", one);
  file["prior"] = {{"name", "former"}, {"db", "fit.db"}};
  const json after = fitted("after", other);
  REQUIRE(after["parameters"].size() == together["parameters"].size());
  for (std::size_t j = 0; j < after["parameters"].size(); ++j) {
    const json &here = after["parameters"][j], &there = together["parameters"][j];
    CAPTURE(here["name"]);
    const double error = there["standard_error"];
    CHECK(std::abs(here["value"].get<double>() - there["value"].get<double>()) < 0.1 * error);
    CHECK(here["standard_error"].get<double>() == Approx(error).epsilon(0.05));
    CHECK(alone["parameters"][j]["standard_error"].get<double>() > 1.2 * error);
  }

  const auto refusal = [&](const json& prior) {
    file["prior"] = prior;
    return files.run(file).err;
  };
  using Catch::Contains;
  CHECK_THAT(refusal("former"), Contains("must be an object with name and db"));
  CHECK_THAT(refusal({{"name", "formre"}, {"db", "fit.db"}}),
             Contains("prior: name = \"formre\"") && Contains("holds no fit"));
  file["parameters"] = {{"friction_coefficient", {{"start", 0.1}}}};
  CHECK_THAT(refusal({{"name", "former"}, {"db", "fit.db"}}), Contains("prior former: it has none of the parameters"));
}
