#include <nlohmann/json.hpp>

#include "db/rows/fit_store.hpp"
#include "db/rows/schema.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers fit_query and fit_question, too.

using namespace rollres;
using Catch::Contains;
using nlohmann::json;

namespace {

FitParameterRecord parameter(const std::string& name, const std::string& unit, double value, double error) {
  FitParameterRecord one{.name = name, .unit = unit, .value = value, .standard_error = error};
  one.linear_lowest = value - 2 * error;
  one.linear_highest = value + 2 * error;
  return one;
}

/// Three fits, of which two share a parameter.
class FittedThings {
 public:
  FittedThings() {
    const Database database = open_database(file(), Access::write);
    FitRecord drum = fit("drum", "GOOD", 1.1);
    drum.parameters = {parameter("static_shear_modulus", "Pa", 2e6, 1e5), parameter("creep_time", "s", 0.02, 0.001)};
    drum.parameters[1].profile_low = drum.parameters[1].profile_high = "closed";
    drum.parameters[1].profile_lowest = 0.0175;
    drum.parameters[1].profile_highest = 0.0225;
    FitRecord rig = fit("rig", "MISFIT", 40);
    rig.parameters = {parameter("static_shear_modulus", "Pa", 3e6, 4e5), parameter("offset (it's)", "N/m", 15, 1)};
    rig.parameters[1].profile_low = "closed";
    rig.parameters[1].profile_high = "open";
    rig.parameters[1].profile_lowest = 12;
    FitRecord shift = fit("shift", "USABLE WITH WARNINGS", 2);
    shift.parameters = {parameter("vft_temperature", "K", 193.15, 2)};
    for (const FitRecord& one : {drum, rig, shift}) save_fit(database, one);
  }

  std::string file() const { return (folder_ / "fits.db").string(); }
  ProgramRun query(std::vector<std::string> words) const {
    words.insert(words.begin(), {"query", "--db", file(), "--fits"});
    return run_rollres(words, closed_form);
  }
  /// The names that a question finds.
  std::vector<std::string> names(std::vector<std::string> words) const {
    words.insert(words.end(), {"--format", "json"});
    std::vector<std::string> found;
    for (const json& row : json::parse(query(words).out)) found.push_back(row["name"]);
    return found;
  }

 private:
  static FitRecord fit(const std::string& name, const std::string& status, double reduced) {
    FitRecord fit{};
    fit.name = name;
    fit.kind = "resistance";
    fit.definition = "{}";
    fit.status = status;
    fit.reduced_chi_squared = reduced;
    fit.data = {{"row", 1, 0.1, 1, 0, 0.05}, {"row", 2, 0.1, 2, 0, 0.05}};
    return fit;
  }
  TemporaryDirectory folder_;
};

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("fits are found by name, status, statistics and what they fitted, in any unit", "[studies][query][fit]") {
  const FittedThings things;
  CHECK(things.names({}) == Names{"drum", "rig", "shift"});
  CHECK(things.names({"name=rig"}) == Names{"rig"});
  CHECK(things.names({"name~r", "status!=MISFIT"}) == Names{"drum"});
  CHECK(things.names({"status=good"}) == Names{"drum"});
  CHECK(things.names({"reduced_chi_squared<3", "--sort=-reduced_chi_squared"}) == Names{"shift", "drum"});
  CHECK(things.names({"values=2"}).size() == 3);
  CHECK(things.names({"parameters~offset"}) == Names{"rig"});
  CHECK(things.names({"static_shear_modulus>2.5 MPa"}) == Names{"rig"});
  CHECK(things.names({"static_shear_modulus_error<=100 kPa"}) == Names{"drum"});
  CHECK(things.names({"creep_time_lowest>17 ms", "creep_time_highest<23 ms"}) == Names{"drum"});  // of the profile
  CHECK(things.names({"static_shear_modulus_highest<2.3 MPa"}) == Names{"drum"});                 // of the slopes
  CHECK(things.names({"offset (it's)>10 N/m"}) == Names{"rig"});
  CHECK(things.names({"vft_temperature<-79 degC"}) == Names{"shift"});
  CHECK(things.names({"creep_time="}) == Names{"rig", "shift"});
  CHECK(things.names({"--sort", "static_shear_modulus", "--limit", "1"}) == Names{"drum"});
}

TEST_CASE("a question to fits shows parameters with their errors, and all of it to programs", "[studies][query][fit]") {
  const FittedThings things;
  const std::string table = things.query({"static_shear_modulus>1 MPa"}).out;
  CHECK_THAT(table, Contains("static_shear_modulus [MPa]") && Contains("creep_time [ms]") && Contains("MISFIT"));
  CHECK_THAT(table, !Contains("vft_temperature"));  // of no fit that is shown
  CHECK_THAT(things.query({"name=shift", "--columns", "vft_temperature,vft_temperature_error"}).out,
             Contains("vft_temperature [°C]  vft_temperature_error [K]") && Contains("-80"));
  CHECK_THAT(things.query({"name=drum", "--si", "--columns", "creep_time"}).out, Contains("creep_time [s]"));
  const json rows = json::parse(things.query({"name=rig", "--format", "json"}).out);
  REQUIRE(rows.size() == 1);
  CHECK(rows[0]["static_shear_modulus"] == 3e6);
  CHECK(rows[0]["offset (it's)_lowest"] == 12);
  CHECK(rows[0]["offset (it's)_highest"].is_null());  // open
  CHECK(rows[0]["creep_time"].is_null());
  CHECK(rows[0]["parameters"] == "static_shear_modulus, offset (it's)");
  CHECK_FALSE(rows[0].contains("definition"));
}

TEST_CASE("a question to fits that makes no sense is refused with what there is", "[studies][query][fit]") {
  const FittedThings things;
  const auto refused = [&](std::vector<std::string> words) {
    const ProgramRun run = things.query(std::move(words));
    CHECK(run.status == 2);
    return run.err;
  };
  CHECK_THAT(refused({"creep_tim<1"}), Contains("creep_tim: unknown column of fits; did you mean creep_time?"));
  CHECK_THAT(refused({"verdict=GOOD"}), Contains("verdict: unknown column of fits; there are id, name, kind, "));
  CHECK_THAT(refused({"status=fine"}), Contains("status = fine: must be one of NOT CONVERGED, DID NOT MOVE, MISFIT"));
  CHECK_THAT(refused({"creep_time<1 m"}), Contains("creep_time = 1 m"));
  CHECK_THAT(refused({"--by", "name"}), Contains("--fits: has no place beside --sql, --aggregate and --by"));
  const ProgramRun none = things.query({"name=other"});
  CHECK(none.status == 1);
  CHECK_THAT(none.err, Contains("nothing matches"));
}

TEST_CASE("a database of fits alone says so to who asks for a study", "[studies][commands][fit]") {
  const FittedThings fitted;
  for (const std::vector<std::string>& words : {std::vector<std::string>{"rename", "drum", "roll"}, {"delete", "drum"}}) {
    std::vector<std::string> asked = words;
    asked.insert(asked.end(), {"--db", fitted.file()});
    const ProgramRun run = run_rollres(asked, closed_form);
    CHECK(run.status == 2);
    CHECK(run.err == "rollres: " + fitted.file() + ": holds no study, only fits, 3 (rollres list names them)\n");
  }
}
