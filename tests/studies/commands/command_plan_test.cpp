
#include "studies/text/strict_json.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers study_outputs and cells, too.

using namespace rollres;
using Catch::Matchers::Contains;
namespace {

RollingSolution never(const RollingScene&) { throw std::logic_error("solved"); }

/// Those at the highest speed fail.
RollingSolution fails_when_very_fast(const RollingScene& scene) {
  if (scene.speed > 2.5) throw std::runtime_error("singular matrix");
  return closed_form(scene);
}

const std::string study_text = R"({"study": "small",
  "scene": {"radius": 0.1, "layer_thickness": "infinite", "static_shear_modulus": 1e6, "material": "elastic", "load": 1},
  "axes": {"load": ["10 kN/m", "20 kN/m"], "speed": [1, 2, 3]}, "constraints": ["load * speed <= 4e4"],
  "compute": ["contact_nodes", "rolling_resistance"],
  "charts": [{"x": "speed"}, {"name": "by load", "x": "load", "family": "speed"}]})";

}  // namespace

TEST_CASE("plan tells the points of a study and what is dropped, and solves nothing", "[studies][commands]") {
  const TemporaryDirectory folder;
  const std::string study = folder.write("study.json", study_text).string();
  const ProgramRun run = run_rollres({"plan", study, "--limit", "2"}, never);
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  CHECK(run.out ==
        "small: 5 points, 2 of load x 3 of speed\n"
        "dropped by load * speed <= 4e4: 1 point\n\n"
        "position  load [kN/m]  speed [m/s]\n"
        "       1           10            1\n"
        "       2           10            2\n"
        "and 3 more points\n");

  const Json object = Json::parse(run_rollres({"plan", study, "--json"}, never).out);
  CHECK(object["study"] == "small");
  CHECK(object["points"] == 5);
  CHECK(object["dropped"] == 1);
  CHECK(object["axes"][1] == Json{{"key", "speed"}, {"values", 3}});
  CHECK(object["constraints"][0] == Json{{"constraint", "load * speed <= 4e4"}, {"dropped", 1}});
  CHECK(object["compute"] == Json{"contact_nodes", "rolling_resistance"});
  CHECK(object["fields"] == false);
  CHECK(object["charts"][1]["name"] == "by load");
  REQUIRE(object["plan"].size() == 5);
  CHECK(object["plan"][4] == Json{{"position", 5}, {"load", 2e4}, {"speed", 2.0}});
  CHECK_FALSE(object.contains("stored"));

  CHECK(run_rollres({"plan", study, "--format", "csv", "--limit", "1"}, never).out ==
        "position,load,speed\n1,10000,1\n");
  CHECK(run_rollres({"plan", study, "--format", "jsonl", "--limit", "1"}, never).out ==
        "{\"position\":1,\"load\":10000.0,\"speed\":1.0}\n");
  CHECK(run_rollres({"plan", study, "--limit", "0"}, never).out ==
        "small: 5 points, 2 of load x 3 of speed\ndropped by load * speed <= 4e4: 1 point\n");
}

TEST_CASE("plan tells which points a database has, whichever study asked for them", "[studies][commands]") {
  const TemporaryDirectory folder;
  const std::string study = folder.write("study.json", study_text).string(), database = (folder / "a.db").string();
  std::string part = study_text;
  part.replace(part.find("small"), 5, "other").replace(part.find("\"20 kN/m\""), 9, "\"30 kN/m\"");
  const std::string other = folder.write("other.json", part).string();
  CHECK(run_rollres({"sweep", other, "--db", database}, fails_when_very_fast).status == 1);

  const Json object = Json::parse(run_rollres({"plan", study, "--db", database, "--json"}, never).out);
  CHECK(object["stored"] == 3);
  CHECK(object["failed"] == 1);
  CHECK(object["plan"][0]["status"] == "converged");
  CHECK(object["plan"][2]["status"] == "not_converged");
  CHECK(object["plan"][3]["status"].is_null());
  CHECK_THAT(run_rollres({"plan", study, "--db", database}, never).out,
             Contains("3 of them in " + database + ", 1 failed\n") && Contains("  converged\n"));
}

TEST_CASE("plan refuses a wrong study, wrong words and a database that is not there", "[studies][commands]") {
  const TemporaryDirectory folder;
  const std::string study = folder.write("study.json", study_text).string();
  const std::string wrong = folder.write("wrong.json", R"({"study": "s", "axes": {"sped": [1]}})").string();
  CHECK(run_rollres({"plan", wrong}, never).err ==
        "rollres: " + wrong + ": axes: sped = [1]: unknown key; did you mean speed?\n");
  CHECK(run_rollres({"plan", wrong}, never).status == 2);
  CHECK(run_rollres({"plan", study, "--json", "--format", "csv"}, never).status == 2);
  CHECK(run_rollres({"plan", study, "--format", "xml"}, never).status == 2);
  CHECK(run_rollres({"plan", study, "--limit", "-1"}, never).status == 2);
  CHECK(run_rollres({"plan", (folder / "none.json").string()}, never).status == 3);
  CHECK(run_rollres({"plan", study, "--db", (folder / "none.db").string()}, never).status == 3);
}

TEST_CASE("sweep and show follow what the study file computes and drops", "[studies][commands]") {
  const TemporaryDirectory folder;
  const std::string study = folder.write("study.json", study_text).string(), database = (folder / "a.db").string();
  const ProgramRun sweep = run_rollres({"sweep", study, "--db", database}, closed_form);
  CHECK(sweep.status == 0);
  CHECK_THAT(sweep.out, Contains("5 of 5 points"));
  CHECK(sweep.err == "1 point is dropped by constraints\n");
  CHECK(Json::parse(run_rollres({"sweep", study, "--db", database, "--json"}, closed_form).out)["dropped"] == 1);
  const Json shown = Json::parse(run_rollres({"show", "small", "--db", database, "--json"}, closed_form).out);
  const Json& row = shown["results"][0];
  CHECK(row["contact_nodes"] == 31);
  CHECK(row["rolling_resistance"] == 50);
  CHECK(row["status"] == "converged");
  CHECK(row.size() == 7);  // position, id, load, speed and the three above
}

TEST_CASE("every example study has the points that its plan tells", "[studies][commands]") {
  for (const auto& [name, count] :
       {std::pair<std::string, int>{"speed_resistance", 180}, {"speed_resistance_sphere", 13}, {"layer_design", 92}}) {
    CAPTURE(name);
    const std::string file = source_directory().string() + "/studies/examples/" + name + ".json";
    CHECK(Json::parse(run_rollres({"plan", file, "--json"}, never).out)["points"] == count);
  }
}

TEST_CASE("plan tells the model of a point, and solves nothing", "[studies][commands]") {
  const TemporaryDirectory folder;
  const std::string study = folder.write("study.json", study_text).string();
  const ProgramRun run = run_rollres({"plan", study, "--explain", "--point", "2"}, never);
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("V = 2 m/s, load 1e+04 N/m, "));
  CHECK_THAT(run.out, Contains("  method   spectral: continuous edges of contact, and a grid where they give no answer\n"));
  CHECK_THAT(run_rollres({"plan", study, "--explain"}, never).out, Contains("V = 1 m/s, load 1e+04 N/m, "));
  CHECK(Json::parse(run_rollres({"plan", study, "--explain", "--json"}, never).out)["method"] == "spectral");

  const ProgramRun none = run_rollres({"plan", study, "--explain", "--point", "6"}, never);
  CHECK(none.status != 0);
  CHECK_THAT(none.err, Contains("--point = 6: ") && Contains(" has 5 points, counted from 1"));
}
