#include <nlohmann/json.hpp>

#include "tests/catch.hpp"
#include "tests/studies/fit_files.hpp"
#include "tests/studies/half_space_fit.hpp"

using nlohmann::json;

TEST_CASE("a list of moduli is fitted number by number", "[studies][fit]") {
  const FitFiles files;
  json file = half_space_fit();
  json& scene = file["scene"];
  scene["material"] = "prony";
  scene["relaxation_times"] = {0.01, 0.1, 1};
  scene["relaxation_moduli"] = {"0.5 MPa", "1 MPa", "0.5 MPa"};
  for (const char* const key : {"stiffening", "creep_time"}) scene.erase(key);
  file["parameters"] = {{"static_shear_modulus", "1.2 MPa"}, {"relaxation_moduli", {{"smooth", 2}}}};
  const ProgramRun run = files.run(file, {"--json"});
  INFO(run.err);
  const json answer = json::parse(run.out);
  REQUIRE(answer["parameters"].size() == 4);
  CHECK(answer["parameters"][0]["name"] == "relaxation_moduli[0]");
  CHECK(answer["parameters"][2]["name"] == "relaxation_moduli[2]");
  CHECK(answer["parameters"][1]["start"] == 1e6);

  const auto refusal = [&](const json& parameters) {
    file["parameters"] = parameters;
    return files.run(file).err;
  };
  using Catch::Contains;
  CHECK_THAT(refusal({{"static_shear_modulus", {{"smooth", 1}}}}), Contains("smooth = 1: is for a whole list"));
  CHECK_THAT(refusal({{"relaxation_moduli", {{"smooth", 0}}}}), Contains("smooth = 0"));
  CHECK_THAT(refusal({{"relaxation_moduli", {{"fixed", true}}}}), Contains("fixed"));
  CHECK_THAT(refusal({{"relaxation_moduli[3]", "1 MPa"}}), Contains("the scene has 3 relaxation_moduli: [0] to [2]"));
  CHECK_THAT(refusal({{"relaxation_moduli[1]", "1 m"}}), Contains("relaxation_moduli[1]"));
  CHECK_THAT(refusal({{"storage_moduli", json::object()}}), Contains("the scene has no storage_moduli to start from"));
  CHECK_THAT(refusal({{"relaxation_moduli[0]", "1 MPa"}, {"relaxation_moduli", json::object()}}),
             Contains("relaxation_moduli[0]: is given twice"));
}
