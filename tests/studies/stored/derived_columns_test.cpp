#include "studies/stored/derived_columns.hpp"

#include "studies/optimise/design_file.hpp"
#include "studies/stored/study_rows.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

const std::string derived_base = R"("scene": {"radius": 0.02, "layer_thickness": 0.005, "static_shear_modulus": 1e6,
  "stiffening": 1, "creep_time": 0.5, "load": 2e4})";

std::string derived_study(const std::string& name, const std::string& compute, const std::string& more = "") {
  return R"({"study": ")" + name + R"(", )" + derived_base + R"(, "axes": {"speed": [1, 2, 4]}, "compute": )" +
         compute + more + "}";
}

const std::string deborah = R"(["rolling_resistance", {"deborah": "speed * creep_time / radius",
  "power": "rolling_resistance * speed", "twice": "2 * deborah"}])";

std::string derived_refusal(const std::string& compute, const std::string& more = "") {
  const TemporaryDirectory folder;
  return message_of([&] { read_study(folder.write("s.json", derived_study("s", compute, more))); });
}

}  // namespace

TEST_CASE("derived numbers are columns of a study: filtered, sorted, grouped, shown and drawn", "[studies][derived]") {
  const TemporaryDirectory folder;
  const auto run = [](const std::vector<std::string>& words) { return run_rollres(words, closed_form); };
  const std::string db = folder / "a.db";
  const std::string study =
      folder.write("s.json", derived_study("s", deborah, R"(, "chart": {"x": "deborah", "y": "power"})"));
  REQUIRE(run({"sweep", study, "--db", db}).status == 0);
  const ProgramRun rows = run(
      {"query", "--db", db, "deborah>30", "--columns", "speed,deborah,twice", "--sort=-deborah", "--format", "csv"});
  CHECK(rows.out == "speed,deborah,twice\n4,100,200\n2,50,100\n");
  const ProgramRun groups = run({"query", "--db", db, "--aggregate", "max power,count", "--by", "deborah", "study=s"});
  CHECK(groups.status == 0);
  CHECK_THAT(groups.out, Contains("max_power") && Contains("100"));
  const double power = 4 * closed_form(plain_scene(4.0, 2e4)).rolling_resistance;
  ResultStore store(db, Access::read);
  const StudyRows stored(store, "s");
  const StudySummary summary = stored_study(store, "s");
  CHECK(stored.number(2, column_of("power", summary, stored, "y")) == Approx(power).epsilon(1e-12));
  CHECK(column_of("power", summary, stored, "y").quantity.unit_for(Indenter::cylinder) == "W/m");
  CHECK(column_of("power", summary, stored, "y").quantity.unit_for(Indenter::sphere) == "W");
  CHECK(StudyRows(store, "s", {parse_filter("twice>150")}).size() == 1);
  CHECK_THAT(run({"show", "--db", db, "s"}).out, Contains("deborah") && Contains("power [W/m]"));
  CHECK_THAT(run({"query", "--db", db, "power>0.001 kW/m", "--columns", "power"}).out, Contains("power"));
  CHECK_THAT(run({"query", "--db", db, "power>3 s"}).err, Contains("power = 3 s: must have a unit"));
  CHECK(run({"chart", "--db", db, "--out", folder / "c"}).status == 0);
  CHECK_THAT(file_text(folder / "c.dat"), Contains("deborah"));
  CHECK(run({"report", "--db", db, "--out", folder / "r.html"}).status == 0);
  CHECK_THAT(file_text(folder / "r.html"), Contains("deborah"));
  CHECK_THAT(run({"chart", "--db", db, "--x", "debora"}).err,
             Contains("x = debora: unknown key; did you mean deborah?"));
}

TEST_CASE("numbers that go with zipped inputs are columns, of every body, and formulas use them",
          "[studies][derived]") {
  const TemporaryDirectory folder;
  const auto run = [](const std::vector<std::string>& words) { return run_rollres(words, closed_form); };
  const auto study = [](const std::string& body, const std::string& unit, const std::string& columns) {
    return R"({"study": "cycle", "scene": {"radius": 0.02, "layer_thickness": 0.005, "static_shear_modulus": 1e6,
      "stiffening": 1, "creep_time": 0.5, "speed": 1, "load": 3)" +
           body + R"(}, "axes": {"cycle": {"zip":
      {"load": ["50 )" +
           unit + R"(", "0.2 k)" + unit + R"("]}, "columns": )" + columns + R"(}, "radius": [0.01, 0.02]},
      "compute": {"worth": "2 * load * hours"}})";
  };
  const std::string columns = R"({"share": [0.75, 0.25], "hours": [3, 5]})";
  const std::pair<std::string, std::string> bodies[] = {
      {"", "N/m"}, {R"(, "width": "1 m")", "N"}, {R"(, "indenter": "sphere")", "N"}};
  for (const auto& [body, unit] : bodies) {
    const std::string db = folder / ("a" + std::to_string(body.size()) + ".db");
    REQUIRE(run({"sweep", folder.write("s.json", study(body, unit, columns)), "--db", db}).status == 0);
    const ProgramRun rows = run({"query", "--db", db, "study=cycle", "radius=0.02", "--columns", "share,hours,worth",
                                 "--sort", "hours", "--format", "csv"});
    CHECK(rows.out == "share,hours,worth\n0.75,3,300\n0.25,5,2000\n");
    const ProgramRun sums = run({"query", "--db", db, "study=cycle", "--aggregate",
                                 "sum worth, mean load weighted share", "--by", "radius", "--format", "csv"});
    CHECK_THAT(sums.out, Contains(",2300,87.5\n"));
  }
  const auto refusal = [&](const std::string& wrong) {
    return message_of([&] { read_study(folder.write("s.json", study("", "N/m", wrong))); });
  };
  CHECK_THAT(refusal(R"({"share": [1]})"), Contains("axes: cycle: columns: share = [1]: has 1 values, but load has 2"));
  CHECK_THAT(refusal(R"({"share": ["1", 2]})"), Contains("must be a list of numbers"));
  CHECK_THAT(refusal(R"({"radius": [1, 2]})"), Contains("columns: radius = [1,2]: names a column"));
  CHECK_THAT(refusal("{}"), Contains("must be an object of names and lists of numbers"));
}

TEST_CASE("a derived number that a row has no value for is absent", "[studies][derived]") {
  const TemporaryDirectory folder;
  const std::string db = folder / "a.db";
  const std::string study = folder.write("s.json", derived_study("s", R"({"of_absent": "half_width / radius"})"));
  REQUIRE(run_rollres({"sweep", study, "--db", db}, closed_form).status == 0);
  const auto count = [&](const std::string& filter) {
    const ProgramRun run = run_rollres({"query", "--db", db, filter, "--aggregate", "count"}, closed_form);
    return run.out;
  };
  CHECK_THAT(count("of_absent="), Contains("3"));
  CHECK_THAT(count("of_absent>0"), !Contains("3"));
}

TEST_CASE("studies that compute one name differently are told apart by the filter on the study", "[studies][derived]") {
  const TemporaryDirectory folder;
  const std::string db = folder / "a.db";
  for (const auto& [name, formula] : {std::pair("one", "speed / 2"), {"other", "speed * 2"}})
    REQUIRE(run_rollres(
                {"sweep", folder.write("s.json", derived_study(name, R"({"half": ")" + std::string(formula) + "\"}")),
                 "--db", db},
                closed_form)
                .status == 0);
  CHECK_THAT(run_rollres({"query", "--db", db, "half>0"}, closed_form).err,
             Contains("half: is computed differently in the studies one and other; choose one with study=NAME"));
  CHECK(run_rollres({"query", "--db", db, "half>1.5", "study=one", "--columns", "half", "--format", "csv"}, closed_form)
            .out == "half\n2\n");
}

TEST_CASE("formulas stand in constraints and charts, and in goals of an optimisation", "[studies][derived]") {
  const TemporaryDirectory folder;
  const Study study = read_study(folder.write(
      "s.json", derived_study("s", deborah, R"(, "constraints": ["deborah <= 60"], "chart": {"y": "power"})")));
  CHECK(StudyPlan(study).size() == 2);
  CHECK(study.compute == std::vector<std::string>{"rolling_resistance", "deborah", "power", "twice"});
  const DesignProblem problem = read_design_problem(folder.write("d.json", R"({"study": "d", )" + derived_base + R"(,
    "set": {"speed": 2}, "variables": {"layer_thickness": {"from": 0.001, "to": 0.01}},
    "compute": {"power": "rolling_resistance * speed", "deborah": "speed * creep_time / radius"},
    "minimise": "power", "constraints": ["deborah <= 30", "power <= 2 kW/m"]})"));
  const RollingScene scene = problem.scenes.front().scene;
  const RollingSolution solution = closed_form(scene);
  CHECK(problem.goal.formula(scene, solution) == Approx(solution.rolling_resistance * 2));
  CHECK(problem.unit(problem.goal.formula) == "W/m");
  CHECK_FALSE(problem.constraints[0].holds(scene, solution));
  CHECK(problem.constraints[1].excess(scene, solution) == Approx(solution.rolling_resistance * 2 - 2000));
}

TEST_CASE("formulas that are wrong are refused with file, name, formula and rule", "[studies][derived]") {
  CHECK(derived_refusal(deborah) == "nothing");
  CHECK_THAT(
      derived_refusal(R"({"a": "speed + load"})"),
      Contains("s.json: compute: a: speed + load: its terms have different units; a number without brackets has none: "
               "speed [m/s], load [N/m]"));
  CHECK_THAT(derived_refusal(R"({"a": "creep_tim"})"), Contains("unknown key; did you mean creep_time?"));
  CHECK_THAT(derived_refusal(R"({"speed": "load"})"), Contains("names a column that is there already"));
  CHECK_THAT(derived_refusal(R"({"variant": "load"})"), Contains("names a column that is there already"));
  CHECK_THAT(derived_refusal(R"({"max": "load"})"), Contains("names a function"));
  CHECK_THAT(derived_refusal(R"({"2a": "load"})"), Contains("a name is of letters"));
  CHECK_THAT(derived_refusal(R"([{"a": "load"}, {"a": "speed"}])"), Contains("a = \"speed\": given twice"));
  CHECK_THAT(derived_refusal(R"({"a": 3})"), Contains("must be a formula"));
  CHECK_THAT(derived_refusal(R"({"a": "b", "b": "load"})"), Contains("b: unknown key"));  // no earlier one
  CHECK_THAT(derived_refusal("[]"), Contains("must be a list of outputs and of objects"));
  CHECK_THAT(derived_refusal(R"(["speed * load"])"), Contains("a formula is {name: formula}"));
  CHECK_THAT(derived_refusal(deborah, R"(, "constraints": ["power <= 3"])"),
             Contains("is an output; here only inputs are known"));
  CHECK_THAT(derived_refusal(deborah, R"(, "chart": {"y": "powr"})"), Contains("did you mean power?"));
}
