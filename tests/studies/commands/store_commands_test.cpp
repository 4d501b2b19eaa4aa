#include <SQLiteCpp/SQLiteCpp.h>

#include "db/rows/result_store.hpp"
#include "studies/text/strict_json.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"
#include "tests/studies/with_variable.hpp"

// Covers command_sweep and command_show, too.

using namespace rollres;
namespace {

/// Six points; those at the highest speed fail.
RollingSolution fails_when_fast(const RollingScene& scene) {
  if (scene.speed > 0.9) throw std::runtime_error("singular matrix");
  return closed_form(scene);
}

class Studied {
 public:
  Studied() {
    study_ = folder_.write("study.json", R"({"study": "speed and load",
      "scene": {"indenter": "cylinder", "radius": "10 cm", "layer_thickness": "infinite", "static_shear_modulus": "1 MPa",
                "stiffening": 2, "creep_time": 0.1, "friction_coefficient": 0.3, "speed": 1, "load": 1},
      "axes": {"speed": [0.1, 0.5, 1], "load": ["10 kN/m", "20 kN/m"]}})");
  }

  std::string database() const { return (folder_.path / "a.db").string(); }
  std::string study() const { return study_.string(); }
  const TemporaryDirectory& folder() const { return folder_; }

  /// `rollres COMMAND --db FILE WORDS...`
  ProgramRun run(const std::string& command, std::vector<std::string> words = {}) const {
    words.insert(words.begin(), {command, "--db", database()});
    return run_rollres(words, fails_when_fast);
  }
  ProgramRun sweep() const { return run("sweep", {study()}); }

 private:
  TemporaryDirectory folder_;
  std::filesystem::path study_;
};

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("sweep says in one line what became of a study, and why points failed", "[studies][commands]") {
  const Studied studied;
  const ProgramRun first = studied.sweep();
  CHECK(first.status == ExitStatus::no_answer);
  CHECK(lines_in(first.out) == 1);
  CHECK(first.out.starts_with("speed and load: 6 of 6 points in " + studied.database() + ", 0 recalled, 6 solved in "));
  CHECK(first.out.ends_with(", 2 failed\n"));
  CHECK(first.err == "2 x not_converged: singular matrix\n");

  const ProgramRun again = studied.run("sweep", {studied.study(), "--json", "--jobs", "1"});
  CHECK(again.status == ExitStatus::no_answer);
  CHECK(again.err.empty());
  const Json object = Json::parse(again.out);
  CHECK(object["study"] == "speed and load");
  CHECK(object["points"] == 6);
  CHECK(object["answered"] == 6);
  CHECK(object["recalled"] == 6);
  CHECK(object["solved"] == 0);
  CHECK(object["failed"] == 2);
  CHECK(object["interrupted"] == false);
  CHECK(object["failures"][0]["reason"] == "singular matrix");
  CHECK(object["failures"][0]["points"] == 2);
}

TEST_CASE("ROLLRES_DB stands in for the database that a command needs and is not given, and for no other",
          "[studies][commands]") {
  const Studied files;
  const std::string usual = (files.folder().path / "usual.db").string();
  const WithVariable variable("ROLLRES_DB", usual);
  files.sweep();  // --db goes before the variable
  CHECK(std::filesystem::exists(files.database()));
  CHECK(run_rollres({"plan", files.study()}, fails_when_fast).status == 0);  // needs none
  CHECK_FALSE(std::filesystem::exists(usual));
  run_rollres({"sweep", files.study()}, fails_when_fast);
  REQUIRE(std::filesystem::exists(usual));
  CHECK(ResultStore(usual, Access::read).study_names() == std::vector<std::string>{"speed and load"});
  std::vector<std::string> query{"query", "--format", "csv"};
  const ProgramRun by_variable = run_rollres(query, fails_when_fast);
  query.insert(query.end(), {"--db", usual});
  CHECK(by_variable.status == 0);
  CHECK(by_variable.out == run_rollres(query, fails_when_fast).out);
  CHECK_THAT(run_rollres({"complete", "chart", "--study", "sp"}, fails_when_fast).out,
             Catch::Contains("speed and load"));
}

TEST_CASE("a command that is told no database takes rollres.db of its folder, and says so where there is none",
          "[studies][commands]") {
  const Studied files;
  const WithVariable none("ROLLRES_DB", "");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(files.folder().path);
  const ProgramRun missing = run_rollres({"list"}, fails_when_fast);
  const ProgramRun swept = run_rollres({"sweep", files.study()}, fails_when_fast);
  const ProgramRun listed = run_rollres({"list"}, fails_when_fast), status = run_rollres({"status"}, fails_when_fast);
  const ProgramRun of_study = run_rollres({"status", files.study()}, fails_when_fast);
  std::filesystem::current_path(before);
  CHECK(missing.status == ExitStatus::failure);
  CHECK_THAT(missing.err,
             Catch::Contains("rollres.db: no such file; --db FILE, or ROLLRES_DB=FILE in the environment"));
  CHECK_THAT(swept.out + swept.err, Catch::Contains(" in rollres.db"));
  CHECK(ResultStore(files.folder().path / "rollres.db", Access::read).study_names() ==
        std::vector<std::string>{"speed and load"});
  CHECK_THAT(listed.out, Catch::Contains("speed and load"));
  CHECK_THAT(status.out, Catch::Contains("speed and load"));
  CHECK(of_study.status == 0);
  CHECK_THAT(of_study.out, Catch::Contains("; 0 missing"));
}

TEST_CASE("list tells the studies of a database and how far they are", "[studies][commands]") {
  const Studied studied;
  { ResultStore empty(studied.database()); }
  const ProgramRun none = studied.run("list");
  CHECK(none.status == 0);
  CHECK(none.out.empty());
  CHECK(none.err == studied.database() + ": holds no study\n");
  studied.sweep();
  {
    ResultStore store(studied.database());
    store.start_study({"later", {"speed"}, "{}"}, std::vector<std::string>{"a", "b"});
  }
  const ProgramRun text = studied.run("list");
  CHECK(lines_in(text.out) == 3);
  CHECK(text.out.find("speed and load       6         6       2  20") != std::string::npos);
  const Json object = Json::parse(studied.run("list", {"--json"}).out);
  REQUIRE(object["studies"].size() == 2);
  CHECK(object["studies"][0]["study"] == "later");
  CHECK(object["studies"][0]["answered"] == 0);
  CHECK(object["studies"][0]["last_result"] == "");
  CHECK(object["studies"][1]["axes"] == Json({"speed", "load"}));
  CHECK(object["studies"][1]["failed"] == 2);
}

TEST_CASE("show prints a study's axes and main outputs with units, in the order of its points", "[studies][commands]") {
  const Studied studied;
  studied.sweep();
  const ProgramRun text = studied.run("show", {"speed and load"});
  CHECK(text.status == 0);
  CHECK(text.out.starts_with("speed and load: 6 of 6 points answered, 2 failed\n"));
  CHECK(text.out.find("speed [m/s]  load [kN/m]  rolling_resistance [N/m]  rolling_resistance_coefficient  status") !=
        std::string::npos);
  CHECK(lines_in(text.out) == 2 + 1 + 6);
  const Json object = Json::parse(studied.run("show", {"speed and load", "--json"}).out);
  REQUIRE(object["results"].size() == 6);
  CHECK(object["results"][2]["position"] == 3);
  CHECK(object["results"][2]["speed"] == 0.5);
  CHECK(object["results"][2]["load"] == 1e4);
  CHECK(object["results"][5]["load"] == 2e4);  // as given: this point has no answer
  CHECK(object["results"][5]["rolling_resistance"].is_null());
  CHECK(object["results"][5]["status"] == "not_converged");
}

TEST_CASE("show prints one evaluation in full, with what computed it", "[studies][commands]") {
  const Studied studied;
  studied.sweep();
  const std::string id = std::to_string(ResultStore(studied.database(), Access::read).find(std::int64_t{1})->id);
  const ProgramRun text = studied.run("show", {id});
  CHECK(text.status == 0);
  for (const std::string part : {"evaluation 1, stored 20", "a point of the study speed and load", "layer_thickness",
                                 "infinite", "rolling_resistance", "GNU"})
    CHECK(text.out.find(part) != std::string::npos);
  const Json object = Json::parse(studied.run("show", {id, "--json"}).out);
  CHECK(object["id"] == 1);
  CHECK(object["scene"]["layer_thickness"] == "infinite");
  CHECK(object["studies"] == Json({"speed and load"}));
  CHECK(object["provenance"]["solver"] == this_program().solver);
  CHECK(object.contains("rolling_resistance"));

  for (const std::string what : {"7", "speed and laod", "1x"}) {
    const ProgramRun unknown = studied.run("show", {what});
    CHECK(unknown.status == ExitStatus::wrong_input);
    CHECK(unknown.err == "rollres: " + studied.database() + ": " + what + ": no such study, fit or evaluation" +
                             (what == "speed and laod" ? "; did you mean speed and load?\n" : "\n"));
  }
}

TEST_CASE("query prints the same rows as table, CSV and JSON", "[studies][commands]") {
  const Studied studied;
  studied.sweep();
  const std::vector<std::string> words{
      "study=speed and load", "speed>36 m/min", "given_load=20 kN/m",
      "--sort=-speed",        "--columns",      "speed,status,reason,layer_thickness,approach"};
  auto as = [&](const std::string& format) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--format", format});
    return studied.run("query", all);
  };
  CHECK(as("table").out ==
        "speed [m/s]  status         reason           layer_thickness [m]  approach [m]\n"
        "          1  not_converged  singular matrix             infinite             -\n");
  CHECK(as("csv").out == "speed,status,reason,layer_thickness,approach\n1,not_converged,singular matrix,inf,\n");
  CHECK(Json::parse(as("json").out) == Json::parse(R"([{"speed": 1.0, "status": "not_converged",
        "reason": "singular matrix", "layer_thickness": "infinite", "approach": null}])"));
  CHECK(as("csv").status == 0);

  const ProgramRun all = studied.run("query", {"--format", "csv"});
  CHECK(lines_in(all.out) == 7);
  CHECK(
      all.out.starts_with("id,key,created,provenance,indenter,radius,transverse_radius,crown,profile_places,profile_"
                          "heights,pressure_shape,pressure_distribution,traction_coefficient,deflection_places_x,"
                          "deflection_places_y,width,layer_thickness,"));
  CHECK(lines_in(studied.run("query", {"status=converged", "--limit", "3"}).out) == 4);

  const ProgramRun nothing = studied.run("query", {"speed>5", "--format", "json"});
  CHECK(nothing.status == ExitStatus::no_answer);
  CHECK(nothing.out == "[]\n");
  CHECK(nothing.err == studied.database() + ": nothing matches\n");
}

TEST_CASE("CSV quotes what would break it, JSON replaces what is no text", "[studies][commands]") {
  const Studied studied;
  RollingSolution solution = closed_form(plain_scene());
  solution.reason = "a \"quoted\", reason";
  solution.model = "\xff";
  solution.warnings = {"one", "two"};
  const Evaluation one{evaluation_key(plain_scene()), plain_scene(), solution};
  ResultStore(studied.database()).save({&one, 1});
  CHECK(studied.run("query", {"--columns", "reason,warnings", "--format", "csv"}).out ==
        "reason,warnings\n\"a \"\"quoted\"\", reason\",\"one\ntwo\"\n");
  CHECK(Json::parse(studied.run("query", {"--columns", "model", "--format", "json"}).out)[0]["model"] == "\uFFFD");
}

TEST_CASE("a file from before some inputs and outputs were known is read as it is", "[studies][commands]") {
  const Studied studied;
  studied.sweep();
  const auto answers = [&](const std::string& command, std::vector<std::string> words) {
    CAPTURE(command);
    const ProgramRun run = studied.run(command, std::move(words));
    CHECK_THAT(run.err, !Catch::Matchers::Contains("rollres:"));
    CHECK(run.status == 0);
    return run.out;
  };
  const std::string picture = (studied.folder() / "old").string(), page = (studied.folder() / "old.html").string();
  const std::string shown = answers("show", {"speed and load"}), found = answers("query", {"speed<0.9"});
  {
    SQLite::Database file(studied.database(), SQLite::OPEN_READWRITE);
    for (const char* const key : {"vft_b", "yeoh_second", "shift_factors", "interior_loss", "softening"})
      file.exec(std::string("ALTER TABLE evaluation DROP COLUMN ") + key);
  }
  CHECK(answers("show", {"speed and load"}) == shown);
  CHECK(answers("query", {"speed<0.9"}) == found);
  CHECK(answers("query", {"--columns", "speed,vft_b", "speed=0.1", "--limit", "1", "--format", "csv"}) ==
        "speed,vft_b\n0.1,\n");
  answers("chart", {"--out", picture});
  answers("report", {"--out", page});
  answers("export", {"--study", "speed and load", "--out", (studied.folder() / "exported").string()});
}

TEST_CASE("the commands of the store refuse in one line what they cannot do", "[studies][commands]") {
  const Studied studied;
  studied.sweep();
  const std::string missing = (studied.folder().path / "none.db").string();
  const std::string text = studied.folder().write("text.db", "no database").string();
  struct Refusal {
    std::vector<std::string> words;
    int status;
    std::string message;
  };
  const std::vector<Refusal> refusals{
      {{"list", "--db", missing}, 3, missing + ": no such file"},
      {{"show", "1", "--db", missing}, 3, missing + ": no such file"},
      {{"query", "--db", text}, 3, text + ": file is not a database"},
      {{"sweep", studied.study(), "--db", text}, 3, text + ": file is not a database"},
      {{"sweep", studied.study(), "--db", ""}, 2, "db = \"\": must name a file"},
      {{"import", "", "--db", studied.database()}, 2, "folder = \"\": must name a folder"},
      {{"query", "--db", studied.database(), "sped>1"}, 2, "sped: unknown column; did you mean speed?"},
      {{"query", "--db", studied.database(), "speed>1 kg"}, 2, "speed = 1 kg: must have a unit of speed (m/s)"},
      {{"query", "--db", studied.database(), "speed=fast"}, 2, "speed = fast: "},
      {{"query", "--db", studied.database(), "--sort", "colour"}, 2, "colour: unknown column; see rollres quantities"},
      {{"query", "--db", studied.database(), "--limit", "-1"}, 2, ""},
      {{"query", "--db", studied.database(), "--limit", "1.5"}, 2, ""},
      {{"query", "--db", studied.database(), "--format", "xml"}, 2, ""},
      {{"sweep", studied.study(), "--db", studied.database(), "--jobs", "0"}, 2, ""},
      {{"sweep", studied.study(), "--db", studied.database(), "--jobs", "two"}, 2, ""},
      {{"slurm", studied.study(), "--tasks", "2", "--out", "shards"}, 2, "--db is required"},
      {{"sweep", missing, "--db", studied.database()}, 3, missing},
  };
  for (const Refusal& refusal : refusals) {
    const ProgramRun run = run_rollres(refusal.words, closed_form);
    INFO(refusal.message + " / " + run.err);
    CHECK(run.status == refusal.status);
    CHECK(run.out.empty());
    CHECK(run.err.starts_with("rollres: " + refusal.message));
    CHECK(lines_in(run.err) == 1);
  }
  CHECK(file_text(text) == "no database");
  CHECK_FALSE(std::filesystem::exists(missing));
}
