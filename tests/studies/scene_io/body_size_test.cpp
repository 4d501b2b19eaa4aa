/// A body's diameter in place of its radius, and the width of a cylinder.

#include <nlohmann/json.hpp>

#include "db/rows/schema.hpp"
#include "studies/scene_io/formula.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/summary.hpp"
#include "studies/study/study.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/fit_files.hpp"
#include "tests/studies/half_space_fit.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

json rolling_body() {
  return {{"radius", 0.1},    {"layer_thickness", 0.01}, {"static_shear_modulus", 1e6},
          {"stiffening", 2},  {"creep_time", 0.1},       {"speed", 1},
          {"load", "20 kN/m"}};
}

json of_diameter(const json& diameter) {
  json scene = rolling_body();
  scene.erase("radius");
  scene["diameter"] = diameter;
  return scene;
}

json whole_roll() {
  json scene = rolling_body();
  scene["width"] = "50 mm";
  scene["load"] = "1 kN";
  return scene;
}

RollingScene scene_of(const json& object, const std::vector<std::string>& overrides = {}) {
  return parse_scene(object.dump(), "scene", overrides);
}

std::string refusal_of(const json& object, const std::vector<std::string>& overrides = {}) {
  return message_of([&] { scene_of(object, overrides); });
}

}  // namespace

TEST_CASE("a diameter in place of the radius is twice it", "[studies][scene_io]") {
  CHECK(scene_of(of_diameter("200 mm")).radius == 0.1);
  CHECK(scene_of(of_diameter(0.2)).radius == 0.1);
  CHECK(scene_of(rolling_body(), {"diameter=0.5 m"}).radius == 0.25);
  CHECK(scene_of(rolling_body(), {"diameter=3 m"}).radius == 1.5);  // its unit goes with it
  CHECK_THAT(refusal_of(rolling_body(), {"diameter=100"}), Contains("diameter = 100: did you mean \"100 mm\"?"));
  CHECK(scene_of(of_diameter(0.2), {"radius=0.25"}).radius == 0.25);
  CHECK(Formula("diameter / layer_thickness", FormulaNames::inputs)(scene_of(rolling_body())) == Approx(20));

  json both = rolling_body();
  both["diameter"] = 0.2;
  CHECK_THAT(refusal_of(both), Contains("give radius or diameter, once"));
  CHECK_THAT(refusal_of(rolling_body(), {"radius=0.5", "diameter=1"}), Contains("give radius or diameter, once"));
  CHECK_THAT(refusal_of(of_diameter(-1)), Contains("diameter = -1: must be > 0"));
  CHECK_THAT(refusal_of(of_diameter("5 kg")), Contains("diameter = \"5 kg\": "));
  json none = rolling_body();
  none.erase("radius");
  CHECK_THAT(refusal_of(none), Contains("radius is missing"));
}

TEST_CASE("diameters vary in studies, scatter and are bounds of designs, and stand in tables of measured values",
          "[studies][scene_io]") {
  const TemporaryDirectory folder;
  const auto file = [&](const json& study) { return folder.write("study.json", study.dump()); };
  json study{{"study", "diameters"},
             {"scene", rolling_body()},
             {"axes", {{"diameter", {{"from", "40 mm"}, {"to", "0.4 m"}, {"points", 3}, {"spacing", "logarithmic"}}}}}};
  const Study interval = read_study(file(study));
  REQUIRE(interval.axes.size() == 1);
  CHECK(interval.axes[0].key == "radius");
  CHECK(interval.axes[0].values.front() == Approx(0.02).epsilon(1e-15));
  CHECK(interval.axes[0].values[1] == Approx(0.02 * std::sqrt(10)).epsilon(1e-14));
  study["axes"] = {{"diameter", {"40 mm", 0.4}}};
  CHECK(read_study(file(study)).axes[0].values == std::vector<double>{0.02, 0.2});
  study["axes"] = {{"diameter", {0.1, 0.4}}, {"radius", {0.1, 0.2}}};
  CHECK_THAT(message_of([&] { read_study(file(study)); }),
             Contains("axes: radius = [0.1,0.2]: diameter, the same input, varies already"));
  study.erase("axes");
  study["uncertain"] = {{"diameter", {{"normal", {"200 mm", "2 mm"}}}}};
  const Study uncertain = read_study(file(study));
  CHECK(uncertain.uncertain.inputs[0].key == "radius");
  CHECK(uncertain.uncertain.inputs[0].distribution.parameters == std::vector<double>{0.1, 0.001});

  const json design{{"study", "roll"},
                    {"scene", rolling_body()},
                    {"variables", {{"diameter", {{"from", "100 mm"}, {"to", "600 mm"}}}}},
                    {"minimise", "rolling_resistance * diameter"},
                    {"stop", {{"evaluations", 30}}}};
  const ProgramRun run =
      run_rollres({"optimise", file(design).string(), "--db", (folder / "d.db").string(), "--json"}, closed_form);
  const json found = json::parse(run.out);
  CHECK(found["variables"][0]["key"] == "radius");
  CHECK(found["variables"][0]["value"].get<double>() == Approx(0.05).epsilon(1e-6));  // the bound, R_r hangs not on it

  FitFiles files;
  json fit = half_space_fit();
  fit["scene"].erase("radius");
  fit["scene"]["diameter"] = 0.2;
  const json by_diameter = json::parse(files.run(fit, {"--json"}).out);
  const json by_radius = json::parse(files.run(half_space_fit(), {"--json"}).out);
  CHECK(by_diameter["parameters"] == by_radius["parameters"]);
  std::string with_column;
  for (std::size_t begin = 0; begin < files.table.size();) {
    const std::size_t end = files.table.find('\n', begin);
    with_column += files.table.substr(begin, end - begin) + (begin == 0 ? ",diameter [mm]\n" : ",200\n");
    begin = end + 1;
  }
  files.table = with_column;
  fit["scene"]["diameter"] = 0.7;  // each row has its own
  CHECK(json::parse(files.run(fit, {"--json"}).out)["parameters"] == by_radius["parameters"]);
}

TEST_CASE("with a width loads are those of the whole body, and each unit is refused where it has no place",
          "[studies][scene_io][width]") {
  const RollingScene scene = scene_of(whole_roll());
  CHECK(scene.width == 0.05);
  CHECK(scene.load == 1000);
  CHECK_THAT(
      refusal_of(rolling_body(), {"load=1 kN"}),
      Contains("load = \"1 kN\": ") && Contains("for a cylinder; give its width too for that of the whole body"));
  CHECK_THAT(
      refusal_of(whole_roll(), {"load=20 kN/m"}),
      Contains("load = \"20 kN/m\": ") && Contains("for a cylinder with a width: leave width out for that of a metre"));
  CHECK_THAT(refusal_of(rolling_body(), {"width=50 mm"}), Contains("load = \"20 kN/m\": "));
  // What is wrong with the digits is so for any body.
  CHECK_THAT(refusal_of(rolling_body(), {"load=5,5 kN/m"}), Catch::Matchers::EndsWith("a decimal point, not a comma"));
  json plain = rolling_body();
  plain["load"] = 20000;  // no unit tells
  CHECK_THAT(refusal_of(plain, {"width=0.05"}),
             Contains("width = 0.05: load = 20000 was given per metre: give it too, of the whole body"));
  CHECK(scene_of(plain, {"width=0.05", "load=1000"}).load == 1000);
  json torque = whole_roll();
  torque["drive"] = "torque";
  torque["friction_coefficient"] = 0.3;
  torque["driving_torque"] = "2 N.m";
  CHECK(scene_of(torque).driving_torque == 2);
  json sphere = whole_roll();
  sphere["indenter"] = "sphere";
  CHECK_THAT(refusal_of(sphere), Contains("width = 0.05: only for a cylinder"));
}

TEST_CASE("forces of a body with a width have units of forces in answers, tables, charts, formulas and limits",
          "[studies][scene_io][width]") {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("roll.json", whole_roll().dump()).string(), data = (folder / "w.db").string();
  const ProgramRun solved = run_rollres({"solve", scene}, closed_form);
  CHECK_THAT(solved.out, Contains("R_r    5 N\n") && !Contains("N/m"));

  const Body roll(Indenter::cylinder, true);
  CHECK(unit_of(Formula("rolling_resistance * speed", FormulaNames::inputs_and_outputs), roll) == "W");
  CHECK(Condition("load <= 2 kN", FormulaNames::inputs, roll).holds(scene_of(whole_roll())));
  CHECK_THAT(message_of([&] { Condition("load <= 2 kN/m", FormulaNames::inputs, roll); }), Contains("load"));

  const json study{{"study", "widths"},
                   {"scene", whole_roll()},
                   {"axes", {{"width", {"50 mm", "0.1 m"}}, {"load", {"1 kN", "2 kN", "3 kN"}}}},
                   {"constraints", {"load <= 2.5 kN"}}};
  const std::string file = folder.write("study.json", study.dump()).string();
  REQUIRE(run_rollres({"sweep", file, "--db", data}, closed_form).status == 0);
  const ProgramRun table = run_rollres({"query", "--db", data, "--columns", "load,rolling_resistance"}, closed_form);
  CHECK_THAT(table.out, Contains("load [kN]") && Contains("rolling_resistance [N]"));
  const ProgramRun means =
      run_rollres({"query", "--db", data, "--aggregate", "mean load", "--by", "width"}, closed_form);
  CHECK_THAT(means.out, Contains("mean_load [kN]"));
  const ProgramRun chart = run_rollres(
      {"chart", "--db", data, "--x", "load", "--y", "rolling_resistance", "--out", (folder / "w.svg").string()},
      closed_form);
  CHECK(chart.status == 0);
  CHECK_THAT(file_text(folder / "w.svg"), Contains("[kN]") && !Contains("N/m"));

  json metre = study;
  metre["study"] = "per metre";
  metre["scene"] = rolling_body();
  metre["axes"] = {{"load", {"20 kN/m", "30 kN/m"}}};
  metre.erase("constraints");
  REQUIRE(run_rollres({"sweep", folder.write("m.json", metre.dump()).string(), "--db", data}, closed_form).status == 0);
  const ProgramRun mixed = run_rollres({"query", "--db", data, "--columns", "load"}, closed_form);
  CHECK_THAT(mixed.out, Contains("1 kN\n") && Contains("20 kN/m"));

  // 1 kN and 1 kN/m are the same number in the store.
  json light = metre;
  light["study"] = "light";
  light["axes"] = {{"load", {"1 kN/m", "2 kN/m"}}};
  REQUIRE(run_rollres({"sweep", folder.write("l.json", light.dump()).string(), "--db", data}, closed_form).status == 0);
  const auto count = [&](const std::string& filter) {
    return run_rollres({"query", "--db", data, filter, "--aggregate", "count", "--format", "csv"}, closed_form).out;
  };
  CHECK(count("load=1 kN/m") == "count\n1\n");
  CHECK(count("load=1 kN") == "count\n2\n");  // of two widths
  CHECK(count("load=1000") == "count\n3\n");
  CHECK(count("load!=1 kN/m") == "count\n7\n");
  CHECK(count("load<25 kN/m") == "count\n3\n");
}

TEST_CASE("where only stored inputs can be named a diameter is refused with the name of the radius",
          "[studies][scene_io][width]") {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("roll.json", rolling_body().dump()).string();
  const std::string data = (folder / "d.db").string();
  const json study{
      {"study", "sizes"}, {"scene", rolling_body()}, {"axes", {{"diameter", {"100 mm", "200 mm", "300 mm"}}}}};
  REQUIRE(run_rollres({"sweep", folder.write("s.json", study.dump()).string(), "--db", data}, closed_form).status == 0);
  const auto refused = [](const std::vector<std::string>& words) {
    const ProgramRun run = run_rollres(words, closed_form);
    CHECK(run.status == ExitStatus::wrong_input);
    return run.err;
  };
  const auto held = Contains("diameter: is stored as radius, which is 0.5 times it: name radius");
  CHECK_THAT(refused({"chart", "--db", data, "--x", "diameter"}), held);
  CHECK_THAT(refused({"query", "--db", data, "diameter=100 mm"}), held);
  CHECK_THAT(refused({"gradient", scene, "--inputs", "speed,diameter"}), held);
}

TEST_CASE("a width that scatters about none in the scene never makes a load per metre that of the whole body",
          "[studies][scene_io][width]") {
  const TemporaryDirectory folder;
  const auto refusal = [&](const json& scene) {
    const json study{{"study", "scatter"},
                     {"scene", scene},
                     {"uncertain", {{"width", {{"normal", {"50 mm", "1 mm"}}}}, {"points", 8}}}};
    const std::filesystem::path file = folder.write("study.json", study.dump());
    return message_of([&] { read_study(file); });
  };
  json plain = rolling_body();
  plain["load"] = 20000;
  CHECK_THAT(refusal(plain), Contains("load = 20000 was given per metre: give it too, of the whole body"));
  CHECK_THAT(refusal(rolling_body()), Contains("load = \"20 kN/m\": "));
  CHECK(refusal(whole_roll()) == "nothing");
}

TEST_CASE("the list of quantities has no default for what listed moduli are", "[studies][scene_io]") {
  const json listed = json::parse(run_rollres({"quantities", "--json"}, closed_form).out);
  bool found = false;
  for (const json& input : listed["inputs"])
    if (input["key"] == "listed_moduli") {
      found = true;
      CHECK(input["default"] == "required beside storage_moduli");
    }
  CHECK(found);
}

TEST_CASE("a fit of loads and resistances in N finds what one of the same per metre finds", "[studies][fit][width]") {
  const FitFiles metre;
  FitFiles body;
  // One metre wide: the numbers of the table are the same, their units are not.
  body.table.replace(0, body.table.find('\n'), "load [kN],speed [cm/s],rolling_resistance [N],sigma [%]");
  json fit = half_space_fit();
  fit["scene"]["width"] = "1 m";
  const json per_metre = json::parse(metre.run(half_space_fit(), {"--json"}).out);
  const ProgramRun run = body.run(fit, {"--json"});
  REQUIRE(run.status == 0);
  const json whole = json::parse(run.out);
  CHECK(whole["parameters"] == per_metre["parameters"]);
  CHECK_THAT(metre.run(fit).err, Contains("load") && Contains("with a width: leave width out"));
  CHECK_THAT(body.run(half_space_fit()).err, Contains("load") && Contains("give its width too"));
}
