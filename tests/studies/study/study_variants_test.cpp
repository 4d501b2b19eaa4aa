#include "studies/study/study_variants.hpp"

#include "db/merge/merge.hpp"
#include "db/queries/query.hpp"
#include "db/rows/schema.hpp"
#include "studies/run/sweep.hpp"
#include "studies/study/study.hpp"
#include "studies/study/study_definition.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/study_points.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

const std::string bare_scene =
    R"("scene": {"radius": 0.02, "layer_thickness": 0.005, "load": 2e4, "friction_coefficient": 0.2})";
const std::string two_variants =
    R"("variant": {"soft": {"static_shear_modulus": "1 MPa", "stiffening": 1, "creep_time": "1 ms"},
  "hard": {"material": "master_curve", "master_curve_file": "hard.csv"}})";
const std::string small_curve =
    "frequency [Hz],storage_shear_modulus [MPa],loss_shear_modulus [MPa]\n1,1,0.1\n10,2,0.2\n100,3,0.3\n";

/// A study file of the scene and what is added to it, beside a table of a master small_curve.
struct VariantFile {
  TemporaryDirectory folder;
  std::string path;

  explicit VariantFile(const std::string& rest, const std::string& of = bare_scene) {
    folder.write("hard.csv", small_curve);
    folder.write("other.csv", small_curve + "1000,4,0.4\n");
    path = folder.write("study.json", R"({"study": "s", )" + of + ", " + rest + "}");
  }
};

std::string refusal_in(const std::string& rest) {
  const VariantFile file(rest);
  return message_of([&] { StudyPlan(read_study(file.path)); });
}

std::string refusal_of_variants(const std::string& variants, const std::string& others = R"("speed": [1, 2])") {
  return refusal_in(R"("axes": {"variant": )" + variants + (others.empty() ? "" : ", " + others) + "}");
}

}  // namespace

TEST_CASE("a variant's inputs go together, with every combination of the axes, and nothing of one is left in another",
          "[studies][variants]") {
  const VariantFile file(R"("axes": {"speed": [1, 2], )" + two_variants + R"(, "friction_coefficient": [0, 0.1]})");
  const Study study = read_study(file.path);
  REQUIRE(study.axes.size() == 3);
  CHECK(study.axes[0].key == "variant");
  CHECK(study.axes[0].texts == std::vector<std::string>{"soft", "hard"});
  const auto scenes = points(study);
  REQUIRE(scenes.size() == 8);
  for (std::size_t i = 0; i < 8; ++i) {
    CHECK(scenes[i].speed == (i % 4 < 2 ? 1 : 2));
    CHECK(scenes[i].friction_coefficient == (i % 2 == 0 ? 0 : 0.1));
    CHECK(scenes[i].material == (i < 4 ? MaterialModel::zener : MaterialModel::master_curve));
    CHECK(scenes[i].static_shear_modulus.has_value() == (i < 4));
    CHECK(scenes[i].frequencies.size() == (i < 4 ? 0 : 3));
  }
  const std::vector<std::string> names = StudyPlan(study).variants();
  CHECK(names == std::vector<std::string>{"soft", "soft", "soft", "soft", "hard", "hard", "hard", "hard"});
  CHECK(StudyPlan(study).scene(5).friction_coefficient == 0.1);
}

TEST_CASE("constraints drop points of a variant, and the others keep their names", "[studies][variants]") {
  const VariantFile file(
      R"("axes": {"variant": {"thin": {"layer_thickness": "1 mm"}, "thick": {"layer_thickness": "9 mm"}},
    "speed": [1, 2]}, "constraints": ["layer_thickness * speed < 0.01"])",
      R"("scene": {"radius": 0.02, "static_shear_modulus": 1e6, "stiffening": 1, "creep_time": 1,
    "load": 2e4})");
  CHECK(StudyPlan(read_study(file.path)).variants() == std::vector<std::string>{"thin", "thin", "thick"});
}

TEST_CASE("files of master curves vary as variants of their names, and the stored study needs none of them",
          "[studies][variants]") {
  const VariantFile file(R"("axes": {"master_curve_file": ["hard.csv", "other.csv"], "speed": [1, 2]})",
                         bare_scene.substr(0, bare_scene.size() - 1) + R"(, "material": "master_curve"})");
  const Study study = read_study(file.path);
  CHECK(study.axes[0].texts == std::vector<std::string>{"hard.csv", "other.csv"});
  const auto scenes = points(study);
  REQUIRE(scenes.size() == 4);
  CHECK(scenes[0].frequencies.size() == 3);
  CHECK(scenes[3].frequencies.size() == 4);
  const TemporaryDirectory elsewhere;
  const auto again = points(read_study(elsewhere.write("s.json", study.definition)));
  REQUIRE(again.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(evaluation_key(again[i]) == evaluation_key(scenes[i]));
  CHECK(definition_in(study.definition, "s").logarithmic.empty());
}

TEST_CASE("layer stacks are variants, and an axis may vary what a stack leaves open", "[studies][variants]") {
  const std::string layer = R"({"layer_thickness": "2 mm", "static_shear_modulus": "5 MPa", "stiffening": 1)";
  const std::string stacks = R"("variant": {"one": {"lower_layers": [)" + layer + R"(, "creep_time": 1}]},
    "two": {"lower_layers": [)" +
                             layer + R"(, "creep_time": 1}, )" + layer + R"(, "creep_time": 2}]}})";
  const std::string base = R"("scene": {"radius": 0.02, "layer_thickness": 0.005, "load": 2e4, "speed": 1,
    "static_shear_modulus": 1e6, "stiffening": 1, "creep_time": 1})";
  const VariantFile file(R"("axes": {)" + stacks + R"(, "lower_layers[0].poisson_ratio": [0.4, 0.5]})", base);
  const auto scenes = points(read_study(file.path));
  REQUIRE(scenes.size() == 4);
  CHECK(scenes[0].lower_layers.size() == 1);
  CHECK(scenes[2].lower_layers.size() == 2);
  CHECK(scenes[2].lower_layers[0].poisson_ratio == 0.4);
  const VariantFile twice(R"("axes": {)" + stacks + R"(, "lower_layers[0].layer_thickness": ["1 mm", "2 mm"]})", base);
  CHECK_THAT(message_of([&] { read_study(twice.path); }),
             Contains("variant: one: lower_layers[0].layer_thickness") && Contains("is an axis of the study too"));
}

TEST_CASE("a variant that conflicts with other inputs is refused by name", "[studies][variants]") {
  const std::string soft = R"("soft": {"static_shear_modulus": 1e6, "stiffening": 1, "creep_time": 1)";
  const std::string other = R"("other": {"static_shear_modulus": 2e6, "stiffening": 1, "creep_time": 1})";
  const auto message = [&](const std::string& added) {
    return refusal_of_variants("{" + soft + added + "}, " + other + "}");
  };
  CHECK(message("") == "nothing");
  CHECK_THAT(message(R"(, "speed": 3)"),
             Contains("study.json: axes: variant: soft: speed = 3: is an axis of the study too"));
  CHECK_THAT(message(R"(, "sped": 3)"), Contains("variant: soft: sped = 3: unknown key; did you mean speed?"));
  CHECK_THAT(message(R"(, "creep_time": 3)"), Contains("creep_time") && Contains("twice"));
  CHECK_THAT(message(R"(, "layer_thickness": "3 s")"), Contains("variant: soft: layer_thickness = \"3 s\""));
  CHECK_THAT(message(R"(, "layer_thickness": -1)"), Contains("variant: soft: layer_thickness = -1"));
  const std::string valid = "{" + soft + "}, " + other + "}";
  CHECK_THAT(refusal_in(R"("axes": {"speed": [1], "variant": )" + valid + R"(}, "set": {"stiffening": 2})"),
             Contains("variant: soft: stiffening = 1: is in \"set\" too"));
  CHECK_THAT(
      refusal_of_variants("{" + soft + R"(, "approach": 1e-4}, )" + other + "}", R"("speed": [1], "load": [1e3, 2e3])"),
      Contains("soft: approach = 0.0001: load, which takes its place, is an axis of the study too"));
  CHECK_THAT(refusal_of_variants("{" + soft + "}}"), Contains("two or more variants"));
  CHECK_THAT(refusal_of_variants(R"(["a", "b"])"), Contains("two or more variants"));
  CHECK_THAT(refusal_of_variants("{" + soft + "}, " + other + R"(, "same": {"static_shear_modulus": 2e6,
    "stiffening": 1, "creep_time": 1}})"),
             Contains("variant: same = ") && Contains("has the inputs of variant other"));
  CHECK_THAT(refusal_of_variants(R"({"a": {"stiffening": 1}, "b": {"stiffening": 2}})"),
             Contains("axes: variant: a: creep_time is missing"));
  CHECK_THAT(refusal_of_variants(valid, R"("speed": [1], "master_curve_file": ["hard.csv", "other.csv"])"),
             Contains("put each file into the variant"));
  CHECK_THAT(refusal_in(R"("axes": {"speed": [1], "master_curve_file": ["hard.csv", "hard.csv"]})"),
             Contains("value given twice"));
  CHECK_THAT(refusal_in(R"("axes": {"z": {"zip": {"speed": [1, 2], "master_curve_file": ["a", "b"]}}})"),
             Contains("cannot be zipped"));
  CHECK_THAT(refusal_in(R"("axes": {"speed": [1], "frequencies": [[1], [2]]})"),
             Contains("give each list in a variant"));
}

TEST_CASE("the variant is a column of the study's points: filtered, grouped, drawn as families, and merged",
          "[studies][variants]") {
  const VariantFile file(
      R"("axes": {"variant": {"thin": {"layer_thickness": "1 mm"}, "thick": {"layer_thickness": "9 mm"},
    "as it is": {"layer_thickness": "5 mm"}}, "speed": [1, 2, 3]}, "chart": {"x": "speed", "family": "variant"})",
      R"("scene": {"radius": 0.02, "static_shear_modulus": 1e6, "stiffening": 1, "creep_time": 1,
    "load": 2e4})");
  const auto run = [&](const std::vector<std::string>& words) { return run_rollres(words, closed_form); };
  const std::string database = file.folder / "a.db", merged = file.folder / "b.db";
  CHECK(run({"sweep", file.path, "--db", database}).status == 0);
  CHECK_THAT(run({"sweep", file.path, "--db", database}).out, Contains("9 recalled"));
  CHECK(run({"merge", database, "--db", merged}).status == 0);
  for (const std::string& one : {database, merged}) {
    const ProgramRun groups = run({"query", "--db", one, "--aggregate", "count", "--by", "variant", "study=s"});
    CHECK_THAT(groups.out, Contains("as it is") && Contains("thick") && Contains("thin"));
    const Database db = open_database(one, Access::read);
    const Table thin = run_query(db, {.filters = {parse_filter("variant=thin")}, .columns = {"layer_thickness"}});
    REQUIRE(thin.rows.size() == 3);
    CHECK(thin.rows[0][0] == Cell(1e-3));
  }
  const ProgramRun chart = run({"chart", "--db", database, "--out", file.folder / "c"});
  CHECK(chart.status == 0);
  const std::string script = file_text(file.folder / "c.gp");
  for (const char* const name : {"thin", "thick", "as it is"}) CHECK_THAT(script, Contains(name));
  CHECK_THAT(run({"show", "--db", database, "s"}).out, Contains("variant"));
  CHECK(run({"report", "--db", database, "--out", file.folder / "r.html"}).status == 0);
  CHECK_THAT(file_text(file.folder / "r.html"), Contains("as it is"));
  CHECK_THAT(run({"plan", file.path}).out, Contains("3 of variant x 3 of speed"));
  CHECK_THAT(run({"sensitivity", file.path, "--indices", "morris"}).err, Contains("a name has no range"));
}

TEST_CASE("a variant is no part of an evaluation: the same scene is solved once, whatever it is called",
          "[studies][variants]") {
  const std::string other = R"("scene": {"radius": 0.02, "static_shear_modulus": 1e6, "stiffening": 1, "creep_time": 1,
    "load": 2e4, "speed": 1})";
  const auto axes = [](const char* one) {
    return R"("axes": {"variant": {")" + std::string(one) +
           R"(": {"layer_thickness": "1 mm"}, "b": {"layer_thickness": "2 mm"}}})";
  };
  const VariantFile first(axes("a"), other), second(axes("other"), other);
  const std::string database = first.folder / "a.db";
  const auto named = [&] {
    const Database db = open_database(database, Access::read);
    return run_query(db, {.filters = {parse_filter("variant=a")}, .columns = {"id"}}).rows.size();
  };
  CHECK(run_rollres({"sweep", first.path, "--db", database}, closed_form).status == 0);
  CHECK(named() == 1);
  CHECK_THAT(run_rollres({"sweep", second.path, "--db", database}, closed_form).out, Contains("2 recalled"));
  CHECK(named() == 0);
}

TEST_CASE("several studies are drawn together, each a family with points of its own", "[studies][variants][chart]") {
  const TemporaryDirectory folder;
  const auto run = [](const std::vector<std::string>& words) { return run_rollres(words, closed_form); };
  const auto study = [&](const std::string& name, const std::string& speeds) {
    return folder.write(name + ".json", R"({"study": ")" + name + R"(", "scene": {"radius": 0.02, "load": 2e4,
      "layer_thickness": 0.005, "static_shear_modulus": 1e6, "stiffening": 1, "creep_time": 1}, "axes": {"speed": )" +
                                            speeds + "}}");
  };
  const std::string one = folder / "one.db", other = folder / "other.db";
  REQUIRE(run({"sweep", study("summer", "[1, 2, 3]"), "--db", one}).status == 0);
  REQUIRE(run({"sweep", study("winter", "[1.5, 2.5, 3.5]"), "--db", other}).status == 0);
  const ProgramRun chart =
      run({"chart", "--db", one, "--db", other, "--study", "summer", "--study", "winter", "--out", folder / "c"});
  CHECK(chart.err == "");
  CHECK(chart.status == 0);
  const std::string data = file_text(folder / "c.dat");
  for (const char* const name : {"summer", "winter"}) CHECK_THAT(file_text(folder / "c.gp"), Contains(name));
  CHECK_THAT(data, !Contains("nan") && !Contains("NaN"));  // no curve is broken at the other's places
  CHECK(run({"chart", "--db", one, "--db", other, "--out", folder / "d"}).status == 0);
  CHECK_THAT(run({"chart", "--db", one, "--study", "summer", "--study", "wintr", "--out", folder / "e"}).err,
             Contains("study = wintr: unknown study"));
  CHECK_THAT(run({"chart", "--db", one, "--db", other, "--map", "approach", "--out", folder / "f"}).err,
             Contains("a map is of one study"));
  REQUIRE(run({"merge", other, "--db", one}).status == 0);
  CHECK_THAT(run({"report", "--db", one, "--study", "summer", "--study", "winter", "--out", folder / "r.html"}).out,
             Contains("summer, winter"));
  CHECK_THAT(file_text(folder / "r.html"), Contains("All studies") && Contains("<h1>winter</h1>"));
  CHECK_THAT(run({"compare", "summer", "winter", "summer", "--db", one}).out,
             Contains("summer and winter\n") && Contains("summer and summer\n3 points match"));
  CHECK_THAT(run({"compare", "summer", "winter", "summer", "--db", one, "--format", "json"}).err,
             Contains("is for two studies"));
  const ProgramRun groups = run({"query", "--db", one, "--db", other, "study=summer", "study=winter", "--by", "study",
                                 "--aggregate", "count", "--format", "csv"});
  CHECK(groups.out == "study,count\nsummer,3\nwinter,3\n");
}
