
#include "db/rows/result_store.hpp"
#include "studies/scene_io/fields_file.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/text/strict_json.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers command_query, too.

using namespace rollres;
namespace {

SurfaceFields two_nodes(double speed) {
  SurfaceFields fields;
  fields.grid = {.spacing_x = 0.5, .spacing_y = 1, .columns = 2, .rows = 1};
  for (auto* values : {&fields.u, &fields.w, &fields.pressure, &fields.shear_x, &fields.slip_x}) *values = {speed, 0.1};
  fields.zone = {Zone::stick, Zone::free};
  return fields;
}

RollingSolution with_fields_unless_fast(const RollingScene& scene) {
  if (scene.speed > 0.9) throw std::runtime_error("singular matrix");
  RollingSolution solution = closed_form(scene);
  solution.fields = two_nodes(scene.speed);
  return solution;
}

/// A study of six points, of which two have no answer.
class StudiedWithFields {
 public:
  StudiedWithFields() {
    study_ = folder_
                 .write("study.json", R"({"study": "speed and load",
      "scene": {"indenter": "cylinder", "radius": "10 cm", "layer_thickness": "1 cm", "static_shear_modulus": "1 MPa",
                "stiffening": 2, "creep_time": 0.1, "friction_coefficient": 0.3, "speed": 1, "load": 1},
      "axes": {"speed": [0.1, 0.5, 1], "load": ["10 kN/m", "20 kN/m"]}})")
                 .string();
    sweep({});
  }
  std::string database() const { return (folder_ / "a.db").string(); }
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }

  ProgramRun run(const std::string& command, std::vector<std::string> words,
                 const Evaluate& evaluate = with_fields_unless_fast) const {
    words.insert(words.begin(), {command, "--db", database()});
    return run_rollres(words, evaluate);
  }
  ProgramRun sweep(std::vector<std::string> words, const Evaluate& evaluate = with_fields_unless_fast) const {
    words.push_back(study_);
    return run("sweep", words, evaluate);
  }

 private:
  TemporaryDirectory folder_;
  std::string study_;
};

}  // namespace

TEST_CASE("the CSV and the JSON of one study have its formulas, and show and report what its chart shows",
          "[studies][commands]") {
  const TemporaryDirectory folder;
  const std::string db = (folder / "a.db").string();
  const std::string study = folder.write("study.json", R"({"study": "belt",
      "scene": {"indenter": "cylinder", "radius": "10 cm", "layer_thickness": "1 cm", "static_shear_modulus": "1 MPa",
                "stiffening": 2, "creep_time": 0.1, "friction_coefficient": 0.3, "speed": 1, "load": 1e4},
      "compute": [{"double_force": "2 * rolling_resistance"}],
      "axes": {"speed": [0.1, 0.5]}, "chart": {"y": "contact_nodes"}})");
  const auto estimated = [](const RollingScene& scene) {
    RollingSolution solution = closed_form(scene);
    solution.error_estimate = 1e-3;
    return solution;
  };
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.begin() + 1, {"--db", db});
    return run_rollres(words, estimated).out;
  };
  run({"sweep", study});
  const std::string csv = run({"query", "study=belt", "--format", "csv"});
  CHECK(csv.substr(0, csv.find('\n')).ends_with(",double_force"));
  CHECK(Json::parse(run({"query", "study=belt", "--format", "json"}))[0].contains("double_force"));
  const std::string plain = run({"query", "--format", "csv"});
  CHECK(plain.substr(0, plain.find('\n')).find("double_force") == std::string::npos);
  CHECK(run({"show", "belt"}).find("contact_nodes") != std::string::npos);
  run({"report", "--out", (folder / "belt.html").string()});
  const std::string report = file_text(folder / "belt.html");
  CHECK(report.find("contact nodes") < report.find("double force"));
  CHECK(report.find("error estimate of R_r") != std::string::npos);
}

TEST_CASE("query groups rows and prints one line for each group", "[studies][commands]") {
  const StudiedWithFields studied;
  CHECK(studied
            .run("query", {"speed<36 m/min", "--aggregate", "max rolling_resistance, mean speed,count", "--by", "load",
                           "--sort=-load"})
            .out ==
        "load [kN/m]  max_rolling_resistance [N/m]  mean_speed [mm/s]  count\n"
        "         20                            80                300      2\n"
        "         10                            40                300      2\n");
  const ProgramRun lines = studied.run("query", {"--by", "status", "--aggregate", "count", "--format", "jsonl"});
  CHECK(lines.out == "{\"status\":\"converged\",\"count\":4}\n{\"status\":\"not_converged\",\"count\":2}\n");
  CHECK(studied.run("query", {"--by", "status", "--format", "csv"}).out == "status\nconverged\nnot_converged\n");
  const ProgramRun nothing = studied.run("query", {"speed>5", "--aggregate", "count"});
  CHECK(nothing.status == ExitStatus::no_answer);
  CHECK(nothing.out.empty());
  CHECK(nothing.err == studied.database() + ": nothing matches\n");
}

TEST_CASE("query prints the answer to SQL in every format, and none as exit status 1", "[studies][commands]") {
  const StudiedWithFields studied;
  const std::vector<std::string> words{"--sql", "SELECT speed, count(*) AS n FROM converged GROUP BY speed"};
  auto as = [&](const std::string& format) { return studied.run("query", {words[0], words[1], "--format", format}); };
  CHECK(as("table").out == "speed  n\n  0.1  2\n  0.5  2\n");
  CHECK(as("csv").out == "speed,n\n0.1,2\n0.5,2\n");
  CHECK(as("jsonl").out == "{\"speed\":0.1,\"n\":2}\n{\"speed\":0.5,\"n\":2}\n");
  CHECK(as("markdown").out == "| speed | n |\n|------:|--:|\n|   0.1 | 2 |\n|   0.5 | 2 |\n");
  const char* const with_bar = "SELECT 'a|b' AS text";
  CHECK(studied.run("query", {"--sql", with_bar, "--format", "markdown"}).out == "| text |\n|------|\n| a\\|b |\n");
  CHECK(Json::parse(as("json").out) == Json::parse(R"([{"speed": 0.1, "n": 2}, {"speed": 0.5, "n": 2}])"));
  CHECK(studied.run("query", {"--sql", "SELECT 1 WHERE 0"}).status == ExitStatus::no_answer);
}

TEST_CASE("query takes a temperature on any scale", "[studies][commands]") {
  const StudiedWithFields studied;
  CHECK(studied.run("query", {"temperature>200 degC"}).status == 1);  // nothing matches
  CHECK(read_filter("temperature=20 degC").value == "293.15");
  CHECK(read_filter("temperature>-4 degF").value == "253.15");
}

TEST_CASE("a bare number of a filter that looks as if it were in another unit is asked about, as in files",
          "[studies][commands]") {
  const StudiedWithFields studied;
  const ProgramRun run = studied.run("query", {"peak_temperature>40"});
  CHECK(run.status == ExitStatus::wrong_input);
  CHECK(run.err ==
        "rollres: peak_temperature = 40: did you mean \"40 degC\"? A number without a unit is in K: write \"40 K\" if "
        "that is meant\n");
  for (const char* text : {"temperature>-10", "radius>50", "peak_pressure<=2", "skew_angle=1"})
    CHECK_THAT(message_of([&] { read_filter(text); }), Contains("did you mean"));
  for (const char* text :
       {"temperature>300", "radius>0.05", "peak_pressure<=2 Pa", "radius<=2 m", "half_width=", "speed>50"})
    CHECK(message_of([&] { read_filter(text); }) == "nothing");
  CHECK_THAT(studied.run("chart", {"--where", "radius=20"}).err, Contains("did you mean \"20 mm\"?"));
}

TEST_CASE("query refuses in one line what does not go together", "[studies][commands]") {
  const StudiedWithFields studied;
  const std::vector<std::pair<std::vector<std::string>, std::string>> refusals{
      {{"--sql", "DELETE FROM evaluation"}, "sql: must only read"},
      {{"--sql", ""}, "sql: must be a statement, as in SELECT * FROM resistance"},
      {{"--sql", "SELECT 1", "speed>1"}, "--sql: stands alone; write filters, columns, order and limit in SQL"},
      {{"--sql", "SELECT 1", "--limit", "1"}, "--sql: stands alone; write filters, columns, order and limit in SQL"},
      {{"--by", "load", "--columns", "speed"}, "--columns = speed: has no place beside --aggregate and --by"},
      {{"--by", "laod"}, "laod: unknown column; did you mean load?"},
      {{"--aggregate", "count, maen speed"}, "aggregate = maen speed: did you mean mean?"}};
  for (const auto& [words, message] : refusals) {
    const ProgramRun run = studied.run("query", words);
    CHECK(run.status == ExitStatus::wrong_input);
    CHECK(run.err == "rollres: " + message + "\n");
    CHECK(run.out.empty());
  }
}

TEST_CASE("sweep --retry solves failed points again", "[studies][commands]") {
  const StudiedWithFields studied;
  const ProgramRun still = studied.sweep({"--retry", "failed"});
  CHECK(still.status == ExitStatus::no_answer);
  CHECK(still.out.find("6 of 6 points in " + studied.database() + ", 4 recalled, 2 solved in ") != std::string::npos);
  const Json mended = Json::parse(studied.sweep({"--retry", "not_converged", "--json"}, closed_form).out);
  CHECK(mended["solved"] == 2);
  CHECK(mended["failed"] == 0);
  CHECK(Json::parse(studied.sweep({"--retry", "all", "--json"}, closed_form).out)["solved"] == 6);
  CHECK(studied.sweep({"--retry", "some"}).status == ExitStatus::wrong_input);
}

TEST_CASE("show --fields writes the files that solve --fields writes", "[studies][commands]") {
  const StudiedWithFields studied;
  const std::string out = studied.path("out").string();
  const ProgramRun none = studied.run("show", {"1", "--fields", out});
  CHECK(none.status == ExitStatus::no_answer);
  CHECK(none.err ==
        studied.database() + ": evaluation 1: no fields are stored; rollres sweep STUDY --fields stores them\n");
  CHECK_FALSE(std::filesystem::exists(out));

  studied.sweep({"--fields"});
  const auto stored = ResultStore(studied.database(), Access::read).find(std::int64_t{1});
  REQUIRE(stored);
  CHECK(studied.run("show", {"1", "--fields", out}).status == 0);
  const SurfaceFields fields = two_nodes(stored->scene.speed);
  CHECK(file_text(studied.path("out/fields.csv")) == fields_csv(stored->scene, fields, stored->solution));
  CHECK(file_text(studied.path("out/fields.vti")) == fields_vti(stored->scene, fields, stored->solution));

  CHECK(studied.run("show", {"1", "--fields", ""}).status == ExitStatus::wrong_input);
  const ProgramRun study = studied.run("show", {"speed and load", "--fields", out});
  CHECK(study.status == ExitStatus::wrong_input);
  CHECK(study.err == "rollres: --fields = " + out + ": needs the number of an evaluation, not a study\n");
}
