#include <cmath>
#include <limits>
#include <regex>

#include "core/material/material.hpp"
#include "core/scene/scene_input.hpp"
#include "db/queries/query.hpp"
#include "db/rows/result_store.hpp"
#include "studies/charts/study_chart.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/sensitivity/sensitivity.hpp"
#include "studies/study/plan_table.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/words.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/study_points.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers command_material and layer_list, too.

using namespace rollres;
using Catch::Matchers::Contains;
namespace {

constexpr const char* thickness = "coating_layers[0].layer_thickness";
constexpr const char* modulus = "coating_layers[0].static_shear_modulus";

/// Least, 100 N/m, for a coating of 8 mm and 3 MPa; more by its friction.
RollingSolution bowl(const RollingScene& scene) {
  RollingSolution solution = closed_form(scene);
  const BondedLayer& coating = scene.coating_layers.at(0);
  const double h = std::log(coating.layer_thickness / 8e-3), g = std::log(static_modulus(coating) / 3e6);
  solution.rolling_resistance = 100 * (1 + h * h + g * g) * (1 + scene.friction_coefficient);
  return solution;
}

Json coated_scene() {
  const Json coating{
      {"layer_thickness", "12 mm"}, {"static_shear_modulus", "2 MPa"}, {"stiffening", 1}, {"creep_time", "5 ms"}};
  return {{"radius", "50 mm"},
          {"layer_thickness", "infinite"},
          {"material", "elastic"},
          {"static_young_modulus", "30 GPa"},
          {"coating_layers", {coating}},
          {"load", "8 kN/m"},
          {"speed", 1},
          {"friction_coefficient", 0}};
}

Json study_of(const Json& axes) { return {{"study", "tyres"}, {"scene", coated_scene()}, {"axes", axes}}; }

/// A folder in which the program runs on files written for it.
struct Workshop {
  TemporaryDirectory folder;
  std::string database = folder / "results.db";

  std::string write(const Json& object) const { return folder.write("input.json", object.dump()).string(); }
  ProgramRun run(std::vector<std::string> words) const { return run_rollres(words, bowl); }
  ProgramRun solve(const std::vector<std::string>& overrides) const {
    std::vector<std::string> words{"solve", write(coated_scene()), "--json"};
    for (const std::string& word : overrides) words.insert(words.end(), {"--set", word});
    return run(words);
  }
  std::vector<RollingScene> points(const Json& study) const { return rollres::points(read_study(write(study))); }
  std::string refusal(const Json& study) const {
    const std::string file = write(study);
    return message_of([&] { rollres::points(read_study(file)); }).substr(file.size() + 2);
  }
  Json query(std::vector<std::string> words) const {
    words.insert(words.begin(), {"query", "--db", database, "--format", "json"});
    const ProgramRun found = run(words);
    CHECK(found.err.empty());
    return Json::parse(found.out);
  }
};

}  // namespace

TEST_CASE("an override replaces one input of a further layer and keeps the others", "[studies][layers]") {
  const Workshop shop;
  const ProgramRun run = shop.solve({std::string(thickness) + "=8 mm", "coating_layers[0].static_young_modulus=9 MPa"});
  REQUIRE(run.status == 0);
  const Json coating = Json::parse(run.out)["scene"]["coating_layers"][0];
  CHECK(coating["layer_thickness"] == 8e-3);
  CHECK(coating["static_young_modulus"] == 9e6);
  CHECK_FALSE(coating.contains("static_shear_modulus"));  // its place was taken
  CHECK(coating["creep_time"] == 5e-3);
}

TEST_CASE("the words for a solved scene name its layers' inputs by the keys that an override takes",
          "[studies][layers]") {
  const Workshop shop;
  const ProgramRun run = shop.run({"solve", shop.write(coated_scene())});
  CHECK_THAT(std::regex_replace(run.out, std::regex(" +"), " "),
             Contains("coating_layers[0].layer_thickness H 12 mm\n"));
  CHECK_THAT(run.out, !Contains("coating_layers[0].poisson_ratio"));  // at its default
}

TEST_CASE("an override of a layer that is not there, or of what it has not, is refused", "[studies][layers]") {
  const Workshop shop;
  const auto refused = [&](const std::string& word) {
    const ProgramRun run = shop.solve({word});
    CHECK(run.status == 2);
    return run.err;
  };
  CHECK_THAT(refused("coating_layers[1].layer_thickness=8 mm"),
             Contains("--set: coating_layers[1].layer_thickness = \"8 mm\": the scene has one layer in coating_layers: "
                      "coating_layers[0]"));
  CHECK_THAT(refused("lower_layers[0].layer_thickness=8 mm"), Contains("the scene has no lower_layers"));
  CHECK_THAT(refused("coating_layers[0].layer_thicknes=8 mm"),
             Contains("did you mean coating_layers[0].layer_thickness?"));
  CHECK_THAT(refused("coating_layers[0].layer_thickness=8 kg"), Contains("must have a unit of length (m)"));
  CHECK_THAT(refused("coating_layers[0].layer_thickness=-1"), Contains("must be > 0"));
  CHECK_THAT(refused("coating_layers[0].material=fractional_zener"), Contains("fractional_order is missing"));
  const ProgramRun both = shop.solve({std::string(modulus) + "=1 MPa", "coating_layers[0].static_young_modulus=9 MPa"});
  CHECK(both.status == 2);
  Json scene = coated_scene();
  scene[thickness] = "8 mm";
  const ProgramRun misplaced = shop.run({"solve", shop.write(scene)});
  CHECK(misplaced.status == 2);
  CHECK_THAT(misplaced.err, Contains("must stand in the layer's own object, in the list coating_layers"));
}

TEST_CASE("further layers' inputs are axes: lists, intervals, choices, zips, samples and constraints",
          "[studies][layers]") {
  const Workshop shop;
  const auto scenes =
      shop.points(study_of({{thickness, {"4 mm", "8 mm"}},
                            {modulus, {{"from", "1 MPa"}, {"to", "4 MPa"}, {"points", 3}, {"spacing", "logarithmic"}}},
                            {"coating_layers[0].material", {"zener", "elastic"}}}));
  REQUIRE(scenes.size() == 12);
  CHECK(scenes[0].coating_layers[0].layer_thickness == 4e-3);
  CHECK(scenes[11].coating_layers[0].layer_thickness == 8e-3);
  CHECK(*scenes[2].coating_layers[0].static_shear_modulus == Approx(2e6).epsilon(1e-14));
  CHECK(scenes[1].coating_layers[0].material == MaterialModel::elastic);

  Json varied = study_of({{"tyre", {{"zip", {{thickness, {"4 mm", "8 mm"}}, {"load", {"8 kN/m", "9 kN/m"}}}}}}});
  varied["sample"] = {
      {"method", "sobol"}, {"points", 8}, {"ranges", {{modulus, {{"from", "1 MPa"}, {"to", "4 MPa"}}}}}};
  varied["set"] = {{"coating_layers[0].stiffening", 3}};
  CHECK(shop.points(varied).size() == 16);
  CHECK(shop.points(varied).back().coating_layers[0].stiffening == 3);
  varied["constraints"] = {"coating_layers[0].layer_thickness >= 5 mm",
                           "coating_layers[0].layer_thickness/radius<1.5e-1 + .1"};
  CHECK(shop.points(varied).size() == 8);
}

TEST_CASE("the example of a tyre varies its thickness and its modulus", "[studies][examples][layers]") {
  const auto scenes = points(read_study(source_directory() / "studies/examples/tyre_design.json"));
  REQUIRE(scenes.size() == 9 * 9);
  CHECK(scenes.front().coating_layers[0].layer_thickness == 4e-3);
  CHECK(scenes.back().coating_layers[0].layer_thickness == 20e-3);
  CHECK(*scenes.back().coating_layers[0].static_shear_modulus == 10e6);
}

TEST_CASE("axes of layers that a scene has not are refused by name", "[studies][layers]") {
  const Workshop shop;
  const auto refusal = [&](const std::string& key, const Json& values) {
    return shop.refusal(study_of({{key, values}}));
  };
  CHECK_THAT(refusal("coating_layers[1].layer_thickness", {1e-3, 2e-3}),
             Contains("the scene has one layer in coating_layers"));
  CHECK_THAT(refusal("coating_layer[0].layer_thickness", {1e-3, 2e-3}),
             Contains("did you mean coating_layers[0].layer_thickness?"));
  CHECK_THAT(refusal("coating_layers[0].frequencies", {1, 2}),
             Contains("a list cannot vary by itself; give each list in a variant"));
  CHECK_THAT(refusal(thickness, {1e-3, "2 m"}),
             Contains("axes at coating_layers[0].layer_thickness = 2: coating_layers"));
  CHECK_THAT(shop.refusal(study_of({{modulus, {1e6, 2e6}}, {"coating_layers[0].static_young_modulus", {3e6, 4e6}}})),
             Contains("cannot be an axis together with coating_layers[0].static_young_modulus"));
  Json unknown_name = study_of({{thickness, {1e-3, 2e-3}}});
  unknown_name["constraints"] = {"coating_layers[0].layer_thicknes > 0"};
  CHECK_THAT(shop.refusal(unknown_name), Contains("did you mean coating_layers[0].layer_thickness?"));
}

TEST_CASE("what a query reads of stored layers are the inputs of the scenes", "[studies][db][layers]") {
  const Workshop shop;
  ResultStore store(shop.database);
  RollingScene scene = plain_scene();
  scene.lower_layers.resize(2);
  scene.lower_layers[0].static_young_modulus = 3e6;
  scene.lower_layers[0].creep_time = 1e-6;
  scene.lower_layers[0].layer_thickness = 0.1 + 0.2;
  scene.lower_layers[1].material = MaterialModel::elastic;
  scene.lower_layers[1].static_shear_modulus = 2e9;
  scene.lower_layers[1].layer_density = 0;
  scene.lower_layers[1].layer_thickness = std::numeric_limits<double>::infinity();
  const std::vector<Evaluation> rows{{evaluation_key(scene), scene, closed_form(scene)},
                                     {evaluation_key(plain_scene()), plain_scene(), closed_form(plain_scene())}};
  store.save(rows);
  int compared = 0;
  visit_all_inputs(scene, [&](const Quantity& quantity, const auto&) {
    if (!layer_key(quantity.key)) return;
    const std::string key(quantity.key);
    CAPTURE(key);
    const Table found = run_query(store.database(), {.columns = {key}});
    REQUIRE(found.rows.size() == 2);
    CHECK(found.rows[0][0] == input_of(scene, key));
    CHECK(found.rows[1][0] == Cell());
    ++compared;
  });
  CHECK(compared == 72);
}

TEST_CASE("queries filter, sort and group by further layers' inputs", "[studies][layers]") {
  const Workshop shop;
  const std::string study =
      shop.write(study_of({{thickness, {"4 mm", "8 mm", "12 mm"}}, {modulus, {"1 MPa", "3 MPa"}}}));
  REQUIRE(shop.run({"sweep", study, "--db", shop.database}).status == 0);
  const Json thin = shop.query({std::string(thickness) + "<9 mm", std::string("--sort=-") + modulus + "," + thickness,
                                "--columns", std::string(thickness) + "," + modulus});
  REQUIRE(thin.size() == 4);
  CHECK(thin[0][thickness] == 4e-3);
  CHECK(thin[0][modulus] == 3e6);
  CHECK(thin[3][modulus] == 1e6);
  CHECK(shop.query({"coating_layers[0].material=zener", "lower_layers[0].material="}).size() == 6);
  const Json groups =
      shop.query({"--by", thickness, "--aggregate", std::string("count, max ") + modulus, "--sort", "-count"});
  REQUIRE(groups.size() == 3);
  CHECK(groups[0][std::string("max_") + modulus] == 3e6);
  const ProgramRun misspelt = shop.run({"query", "--db", shop.database, "coating_layers[0].thickness=1"});
  CHECK(misspelt.status == 2);
  CHECK_THAT(misspelt.err, Contains("did you mean coating_layers[0].layer_thickness?"));
}

TEST_CASE("studies whose coatings differ are compared point by point, and exported with columns for them",
          "[studies][compare][layers]") {
  const Workshop shop;
  Json study = study_of({{thickness, {"4 mm", "8 mm"}}});
  REQUIRE(shop.run({"sweep", shop.write(study), "--db", shop.database}).status == 0);
  study["study"] = "harder tyres";
  study["set"] = {{modulus, "3 MPa"}};
  REQUIRE(shop.run({"sweep", shop.write(study), "--db", shop.database}).status == 0);
  const ProgramRun run = shop.run({"compare", "tyres", "harder tyres", "--db", shop.database});
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("coating_layers[0].static_shear_modulus: 2 MPa against 3 MPa"));
  CHECK_THAT(run.out, Contains("2 points match"));
  const ProgramRun ignoring = shop.run({"compare", "tyres", "tyres", "--db", shop.database, "--ignore", thickness});
  CHECK_THAT(ignoring.err, Contains("differ only in inputs that are ignored"));
  REQUIRE(shop.run({"export", "--db", shop.database, "--study", "tyres", "--out", shop.folder / "out"}).status == 0);
  const std::string csv = file_text(shop.folder / "out" / "results.csv");
  CHECK_THAT(csv.substr(0, csv.find('\n')), Contains(std::string(",") + thickness + ","));
}

TEST_CASE("a further layer's input is the axis or the family of a chart, and named there", "[studies][chart][layers]") {
  const Workshop shop;
  const std::string study =
      shop.write(study_of({{thickness, {"4 mm", "8 mm", "12 mm"}}, {modulus, {"1 MPa", "3 MPa"}}}));
  REQUIRE(shop.run({"sweep", study, "--db", shop.database}).status == 0);
  ResultStore store(shop.database, Access::read);
  const ChartRequest chart = stored_chart(store, {}).request;
  CHECK(chart.x.name == "layer thickness of coating [0]");
  CHECK(chart.x.symbol == "H");
  CHECK(chart.x.unit == "mm");
  CHECK(chart.family.symbol == "G0 of coating [0]");
  REQUIRE(chart.curves.size() == 2);
  CHECK(chart.curves[1].label == "3 MPa");
  CHECK(chart.curves[1].points[1].x == Approx(8));
  CHECK(chart.curves[1].points[1].y == Approx(100));
  CHECK_THAT(chart.comment, Contains("coating_layers[0].creep_time = 5 ms"));
  CHECK_THAT(message_of([&] { stored_chart(store, {.x = "coating_layers[1].stiffening"}); }),
             Contains("no point of the study has this layer"));

  const ProgramRun map = shop.run({"chart", "--db", shop.database, "--map", "rolling_resistance", "--x", thickness,
                                   "--y", modulus, "--out", shop.folder / "map"});
  REQUIRE(map.status == 0);
  const std::string drawn = file_text(shop.folder / "map.svg");
  for (const char* const label : {"layer thickness of coating [0]", "static shear modulus of coating [0]"})
    CHECK_THAT(drawn, Contains(label));
  const ProgramRun report = shop.run({"report", "--db", shop.database, "--out", shop.folder / "report.html"});
  REQUIRE(report.status == 0);
  CHECK_THAT(file_text(shop.folder / "report.html"), Contains("layer thickness of coating [0]"));
}

TEST_CASE("an optimisation finds the best thickness and modulus of a coating", "[studies][optimise][layers][long]") {
  const Workshop shop;
  const std::string file = shop.write(
      {{"study", "best tyre"},
       {"scene", coated_scene()},
       {"variables",
        {{thickness, {{"from", "2 mm"}, {"to", "20 mm"}}}, {modulus, {{"from", "1 MPa"}, {"to", "10 MPa"}}}}},
       {"minimise", "rolling_resistance"},
       {"constraints", {"coating_layers[0].layer_thickness >= 10 mm"}}});
  const ProgramRun run = shop.run({"optimise", file, "--db", shop.database, "--json"});
  REQUIRE(run.status == 0);
  const Json variables = Json::parse(run.out)["best"]["variables"];
  CHECK(variables[thickness].get<double>() == Approx(10e-3).epsilon(1e-3));
  CHECK(variables[modulus].get<double>() == Approx(3e6).epsilon(1e-2));
  CHECK(shop.run({"report", "--db", shop.database, "--out", shop.folder / "report.html"}).status == 0);
}

TEST_CASE("sensitivities of a scene are also those by its further layers' inputs", "[studies][sensitivity][layers]") {
  const Workshop shop;
  const ProgramRun run = shop.run({"sensitivity", shop.write(coated_scene()), "--json"});
  REQUIRE(run.status == 0);
  const Json answer = Json::parse(run.out);
  double found = 0;
  for (const Json& input : answer["inputs"])
    if (input["key"] == thickness) found = input["elasticity"];
  const double h = std::log(12.0 / 8), g = std::log(2.0 / 3);
  CHECK(found == Approx(2 * h / (1 + h * h + g * g)).epsilon(1e-4));
  const ProgramRun sobol =
      shop.run({"sensitivity", shop.write(coated_scene()), "--indices", "sobol", "--range",
                std::string(thickness) + "=4 mm:16 mm:logarithmic", "--range", "load=8 kN/m:9 kN/m"});
  REQUIRE(sobol.status == 0);
  CHECK_THAT(sobol.out, Contains(thickness));
}

TEST_CASE("a fit finds a coating's modulus from tests on coatings of several thicknesses",
          "[studies][fit][layers][long]") {
  const Workshop shop;
  std::string table = "coating_layers[0].layer_thickness [mm],rolling_resistance [N/m]\n";
  for (const double millimetres : {2.0, 4.0, 6.0, 9.0, 13.0, 18.0}) {
    const double h = std::log(millimetres / 8), g = std::log(5.0 / 3);
    table += std::to_string(millimetres) + "," + std::to_string(100 * (1 + h * h + g * g)) + "\n";
  }
  shop.folder.write("tyres.csv", table);
  const std::string file = shop.write({{"fit", "tyre"},
                                       {"scene", coated_scene()},
                                       {"data", "tyres.csv"},
                                       {"parameters", {{modulus, {{"start", "4 MPa"}, {"lowest", "3.5 MPa"}}}}}});
  const ProgramRun run = shop.run({"fit", file, "--db", shop.database, "--json", "--out", shop.folder / "fit"});
  CHECK(run.status == 0);
  const Json parameter = Json::parse(run.out)["parameters"][0];
  CHECK(parameter["name"] == modulus);
  CHECK(parameter["value"].get<double>() == Approx(5e6).epsilon(1e-4));
}

TEST_CASE("a material is shown of the layer that loses something, and of the one asked for",
          "[studies][material][layers]") {
  const Workshop shop;
  const std::string scene = shop.write(coated_scene());
  const auto material = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"material", scene});
    return shop.run(words);
  };
  const ProgramRun tyre = material({});
  CHECK_THAT(tyre.out, Contains("layer        coating_layers[0] (--layer shows layer)\nmaterial     zener\n"));
  CHECK_THAT(tyre.out, Contains("at once      G = 4 MPa\n"));
  const ProgramRun floor = material({"--layer", "layer"});
  CHECK_THAT(floor.out, Contains("layer        layer (--layer shows coating_layers[0])\nmaterial     elastic\n"));
  CHECK_THAT(floor.out, Contains("at rest      G = 10 GPa\n"));
  CHECK_THAT(material({"--layer", "coating_layers[1]"}).err,
             Contains("--layer coating_layers[1]: the scene has layer, coating_layers[0]"));
  const Json handed = Json::parse(material({"--format", "scene"}).out);
  CHECK(handed["material"] == "elastic");
  CHECK(handed["coating_layers"][0]["material"] == "prony");
  CHECK(handed["coating_layers"][0]["relaxation_moduli"][0].get<double>() == Approx(2e6));
}

TEST_CASE("the list of quantities tells how further layers' inputs are named", "[studies][layers]") {
  const Workshop shop;
  CHECK_THAT(shop.run({"quantities"}).out, Contains("LIST[N].KEY"));
  const Json layers = Json::parse(shop.run({"quantities", "--json"}).out)["further_layers"];
  CHECK(layers["lists"] == Json{"lower_layers", "coating_layers"});
  CHECK(layers["keys"].size() == 36);
  CHECK(in_words(thickness) == "layer thickness of coating [0]");
  CHECK(in_words("rolling_resistance") == "rolling resistance");
}
