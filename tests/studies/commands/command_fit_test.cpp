#include <cmath>
#include <nlohmann/json.hpp>

#include <sstream>

#include "core/solve/rolling_contact.hpp"
#include "db/rows/fit_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "tests/catch.hpp"
#include "tests/studies/fit_files.hpp"
#include "tests/studies/half_space_fit.hpp"

// Covers report_fit, fit_design, fit_file, fit_data, fit_record, coverage_summary, fit_chart, fit_curves,
// fit_comparison, fitted_scene and stored_fit, too.

using namespace rollres;
using nlohmann::json;

TEST_CASE("rollres fit reports, stores and recalls", "[studies][fit]") {
  const FitFiles files;
  const ProgramRun first = files.run(half_space_fit(), {"--json"});
  REQUIRE(first.status == 0);
  CHECK(first.err.empty());
  const json answer = json::parse(first.out);
  CHECK((answer["status"] == "GOOD" || answer["status"] == "USABLE WITH WARNINGS"));
  CHECK(answer["deviations"] == "absolute");
  CHECK(answer["degrees"] == 13);
  CHECK(answer["recalled"] == 0);
  REQUIRE(answer["parameters"].size() == 3);
  const json& time = answer["parameters"][0];
  CHECK(std::abs(time["value"].get<double>() - 0.1) < 4 * time["standard_error"].get<double>());
  CHECK(time["profile_interval"]["low"] == "closed");
  CHECK(time["start"] == 0.03);
  CHECK(answer["data"][0]["place"] == (files.directory / "table.csv").string() + ", line 2");

  const json again = json::parse(files.run(half_space_fit(), {"--json"}).out);
  CHECK(again["solved"] == 0);
  CHECK(again["parameters"] == answer["parameters"]);

  const auto stored = find_fit(open_database(files.database(), Access::read), "half space", FitParts::with_data);
  REQUIRE(stored);
  CHECK(stored->x_name == "speed");
  REQUIRE(stored->curves.size() >= 25);
  CHECK(stored->curves.front().band > 0);
  CHECK(stored->curves.front().value == stored->data.front().predicted);
  CHECK(stored->data.front().curve == 0);
  CHECK(stored->data.front().x == stored->curves.front().x);
  CHECK(stored->profiles.size() >= 6);
  CHECK(std::abs(stored->profile_threshold - 3.8415) < 1e-4);
  CHECK(stored->status == answer["status"]);
  CHECK(stored->parameters[0].value == time["value"].get<double>());
  CHECK(stored->data_digest == answer["data_digest"]);
  CHECK(stored->correlations.size() == answer["correlations"].size());

  const std::string page = (files.directory / "fit.html").string();
  REQUIRE(run_rollres({"report", "--db", files.database(), "--study", "half space", "--out", page}, quick_resistance)
              .status == 0);
  CHECK_THAT(file_text(page), Catch::Contains("95 % profile") && Catch::Contains("creep_time") &&
                                  Catch::Contains("degrees of freedom") && Catch::Contains("residuals of the fit"));

  const ProgramRun text = files.run(half_space_fit());
  CHECK_THAT(text.out, (Catch::StartsWith("half space: GOOD") || Catch::StartsWith("half space: USABLE")) &&
                           Catch::Contains("95 % profile") && Catch::Contains("degrees of freedom") &&
                           Catch::Contains("recalled"));
}

TEST_CASE("a stored fit is shown with the keys, numbers and words that the fit itself told", "[studies][fit]") {
  FitFiles files;
  json noisy = half_space_fit(), partly = half_space_fit();
  noisy["fit"] = "noisy";
  noisy["data"] = {{"file", "table.csv"}, {"ignore_columns", {"sigma"}}};
  noisy["parameters"]["relative_noise"] = json::object();
  partly["fit"] = "partly";
  partly["scene"]["spacing"] = "1 mm";  // left out, with a note
  partly["parameters"]["stiffening"] = {{"start", 2}, {"fixed", true}};
  for (const json& fit : {noisy, partly}) {
    const json told = json::parse(files.run(fit, {"--json"}).out);
    const std::vector<std::string> show{"show", fit["fit"].get<std::string>(), "--db", files.database()};
    std::vector<std::string> as_json = show;
    as_json.emplace_back("--json");
    const json shown = json::parse(run_rollres(as_json, quick_resistance).out);
    const json told_flat = told.flatten(), shown_flat = shown.flatten();
    for (const auto& [key, value] : told_flat.items()) {
      CAPTURE(key);
      CHECK(shown_flat.contains(key));
      if (shown_flat.contains(key)) CHECK(shown_flat[key] == value);
    }
    for (const auto& [key, value] : shown_flat.items()) {
      CAPTURE(key);
      CHECK(told_flat.contains(key));
    }
    CHECK(told["parameters"][0]["profile"].size() >= 3);
    CHECK(told["data"][3].contains("speed"));
    const std::string text = run_rollres(show, quick_resistance).out;
    const auto without_time = [](const std::string& all) { return all.substr(0, all.find("evaluations")); };
    CHECK(without_time(text) == without_time(files.run(fit).out));
    CHECK_THAT(text, Catch::Contains("correlations above 0.1"));
  }
}

TEST_CASE("a fit with an offset or a scale of its measured values is stored, written and compared", "[studies][fit]") {
  const FitFiles files;
  for (const char* term : {"offset", "scale"}) {
    json fit = half_space_fit();
    fit["fit"] = term;
    fit["parameters"].erase("creep_time");
    fit["scene"]["creep_time"] = 0.1;
    const json plain = fit;
    fit["parameters"][term] = json::object();
    const std::string scene = (files.directory / "fitted.json").string();
    const ProgramRun run = files.run(fit, {"--scene", scene, "--json"});
    INFO(run.err);
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    const json answer = json::parse(run.out);
    for (const json& fitted : answer["parameters"])
      if (fitted["name"] == "stiffening") CHECK(read_scene(scene).stiffening == fitted["value"].get<double>());
    files.directory.write("plain.json", plain.dump());
    const ProgramRun compared =
        run_rollres({"fit", (files.directory / "plain.json").string(), (files.directory / "fit.json").string(),
                     "--compare", "--db", files.database()},
                    quick_resistance);
    INFO(compared.err);
    CHECK(compared.status == 0);
  }
}

TEST_CASE("rollres fit designs, counts coverage and says what it keeps fixed", "[studies][fit]") {
  const FitFiles files;
  json fit = half_space_fit();
  fit["parameters"]["stiffening"] = {{"start", 2}, {"fixed", true}};
  fit["parameters"]["creep_time"] = json::object();  // from closed forms
  const json answer = json::parse(files.run(fit, {"--json", "--design", "--coverage", "20", "--seed", "5"}).out);
  CHECK(answer["fixed"][0]["name"] == "stiffening");
  CHECK(answer["parameters"].size() == 2);
  CHECK(answer["design"]["speeds"].size() == 5);
  CHECK(answer["design"]["speeds"][0]["ratio"].get<double>() < 1);
  CHECK(answer["design"]["loads"][0]["relative_errors"].contains("creep_time"));
  CHECK(answer["coverage"]["seed"] == 5);
  CHECK(answer["coverage"]["draws"] == 20);
  CHECK(answer["coverage"]["parameters"][1]["linear"].get<int>() >= 15);
}

TEST_CASE("an offset is fitted, stored and left out of the fitted scene, columns are ignored by name",
          "[studies][fit]") {
  FitFiles files;
  files.table.replace(files.table.find("sigma [%]"), 9, "sigma [%],oven");
  for (std::size_t end = files.table.find('\n') + 1; (end = files.table.find('\n', end)) != std::string::npos; end += 5)
    files.table.insert(end, ",any");
  json fit = half_space_fit();
  fit["parameters"]["offset"] = json::object();
  const ProgramRun refused = files.run(fit);
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Catch::Contains("oven") && Catch::Contains("ignore_columns"));
  fit["data"] = {{"file", "table.csv"}, {"ignore_columns", {"oven"}}};
  const ProgramRun run = files.run(fit, {"--json"});
  REQUIRE(run.status == 0);
  const json answer = json::parse(run.out);
  CHECK(answer["parameters"][1]["name"] == "offset");
  CHECK(!answer["scene"].contains("offset"));
}

TEST_CASE("noise is fitted where no sigma is given, and refused where there is one", "[studies][fit]") {
  FitFiles files;
  json fit = half_space_fit();
  fit["parameters"]["relative_noise"] = json::object();
  const ProgramRun refused = files.run(fit);
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Catch::Contains("relative_noise: the data have a sigma"));
  fit["data"] = {{"file", "table.csv"}, {"ignore_columns", {"sigma"}}};
  const ProgramRun run = files.run(fit, {"--json", "--no-profiles"});
  REQUIRE(run.status == 0);
  const json noise = json::parse(run.out)["noise_terms"][0];
  CHECK(noise["name"] == "relative_noise");
  CHECK(std::abs(noise["value"].get<double>() - 0.02) < 3 * noise["standard_error"].get<double>());
  fit["parameters"]["relative_noise"] = 0.02;
  CHECK_THAT(files.run(fit).err, Catch::Contains("relative_noise") && Catch::Contains("needs no start"));
}

TEST_CASE("rollres fit warns of a row given twice and of a negative resistance", "[studies][fit]") {
  FitFiles files;
  const std::string row = files.table.substr(files.table.find('\n') + 1);
  files.table.replace(files.table.find("[%]"), 3, "[N/m]");
  files.table += row.substr(0, row.find('\n') + 1) + "10,700,-1,30\n";
  const json answer = json::parse(files.run(half_space_fit(), {"--json", "--no-profiles"}).out);
  const std::string warnings = answer["warnings"].dump();
  CHECK_THAT(warnings, Catch::Contains("line 18: the same row as") && Catch::Contains("line 2; both count") &&
                           Catch::Contains("line 19: rolling_resistance [N/m] = -1: is negative"));
}

TEST_CASE("rollres fit says by name what weighs values of very different sizes", "[studies][fit]") {
  FitFiles files;
  const std::string advice = "\\\"weights\\\": \\\"relative\\\"";  // in JSON
  const auto warnings = [&](const std::string& largest, bool relative) {
    files.table = "speed [m/s],rolling_resistance [N/m]\n0.01,60\n0.1,40\n0.3,20\n1,5\n3," + largest + "\n";
    json fit = half_space_fit();
    if (relative) fit["weights"] = "relative";
    return json::parse(files.run(fit, {"--json", "--no-profiles"}).out)["warnings"].dump();
  };
  CHECK_THAT(warnings("2", false),
             Catch::Contains("rolling_resistance from 2 to 60 N/m without a sigma") && Catch::Contains(advice));
  CHECK_THAT(warnings("2", true), !Catch::Contains("without a sigma"));
  CHECK_THAT(warnings("4", false), !Catch::Contains("without a sigma"));
}

TEST_CASE("rollres fit refuses a wrong table in one line with file and line", "[studies][fit]") {
  FitFiles files;
  const auto refused = [&](const std::string& table) {
    files.table = table;
    const ProgramRun run = files.run(half_space_fit());
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    return run.err;
  };
  const std::string names = "speed [m/s],rolling_resistance [N/m],sigma [N/m]\n";
  CHECK_THAT(refused("speed [m/s],rolling_resistance [N/m],sigma [%]\n1,-3,2\n"),
             Catch::Contains("table.csv, line 2: rolling_resistance [N/m] = -3: must be > 0 where deviations are"));
  CHECK_THAT(refused(names + "1,x,2\n"), Catch::Contains("table.csv, line 2: rolling_resistance [N/m] = x: must be a"));
  CHECK_THAT(refused(names + "\n# note\n1,5,\n"), Catch::Contains("table.csv, line 4: sigma [N/m] is missing"));
  CHECK_THAT(refused(names + "1,5,0\n"), Catch::Contains("line 2: sigma [N/m] = 0: must be > 0"));
  CHECK_THAT(refused(names + "1,5\n"), Catch::Contains("line 2: 2 cells where the first line names 3 columns"));
  CHECK_THAT(refused(names + "-1,5,1\n"), Catch::Contains("line 2: speed = \"-1 m/s\": must be > 0"));
  CHECK_THAT(refused(names + "1,\"5,1\n"), Catch::Contains("line 2: a quote does not end"));
  CHECK_THAT(refused(names), Catch::Contains("has no row"));
  CHECK_THAT(refused(names + "1,5,1\n2,5,1\n"), Catch::Contains("2 measurements cannot tell 3 parameters"));
  CHECK_THAT(refused("sped [m/s],rolling_resistance [N/m]\n1,5\n"), Catch::Contains("did you mean speed?"));
  CHECK_THAT(refused("speed,rolling_resistance [N/m]\n1,5\n"), Catch::Contains("must name a unit of speed"));
  CHECK_THAT(refused("speed [m/s]\n1\n"), Catch::Contains("has no column rolling_resistance"));
}

TEST_CASE("rollres fit refuses a wrong file naming key and rule", "[studies][fit]") {
  const FitFiles files;
  const auto refused = [&](const json& patch) {
    json fit = half_space_fit();
    fit.merge_patch(patch);
    const ProgramRun run = files.run(fit);
    CHECK(run.status == 2);
    return run.err;
  };
  CHECK_THAT(refused({{"los", "huber"}}), Catch::Contains("los") && Catch::Contains("did you mean loss?"));
  CHECK_THAT(refused({{"loss", "hubber"}}), Catch::Contains("must be one of none, huber, cauchy"));
  CHECK_THAT(refused({{"parameters", {{"creep_tine", 1}}}}), Catch::Contains("did you mean creep_time?"));
  CHECK_THAT(refused({{"parameters", {{"speed", 1}}}}), Catch::Contains("is a column of the data too"));
  CHECK_THAT(refused({{"parameters", {{"creep_time", {{"start", "1 m"}}}}}}), Catch::Contains("unit of time"));
  CHECK_THAT(refused({{"parameters", {{"creep_time", {{"start", 1}, {"highest", 0.5}}}}}}),
             Catch::Contains("must be inside its bounds"));
  CHECK_THAT(refused({{"output", "rolling"}}), Catch::Contains("output"));
  CHECK_THAT(refused({{"starts", 0}}), Catch::Contains("starts = 0: must be a whole number from 1"));
  CHECK_THAT(refused({{"step", 1}}), Catch::Contains("step = 1"));
}

TEST_CASE("noise of the model above the scatter of the data is told in words, with what to do", "[studies][fit]") {
  const FitFiles files;
  json fit = half_space_fit();
  fit["set"] = {{"spacing", "1 mm"}, {"method", "newton"}};
  files.directory.write("table.csv", files.table);
  const std::string file = files.directory.write("fit.json", fit.dump()).string();
  const Evaluate jumping = [](const RollingScene& scene) {
    RollingSolution solution = quick_resistance(scene);
    solution.rolling_resistance *= 1 + 0.05 * std::sin(1e12 * solution.rolling_resistance);
    return solution;
  };
  const ProgramRun run = run_rollres({"fit", file, "--db", files.database(), "--no-profiles"}, jumping);
  CHECK_THAT(run.out, Catch::Contains("the noise of the model") && Catch::Contains("times the scatter of the data") &&
                          Catch::Contains("leave out spacing and method"));
}

TEST_CASE("a fit leaves out the scene's own spacing where there are smooth answers", "[studies][fit]") {
  const FitFiles files;
  json fit = half_space_fit();
  fit["scene"]["spacing"] = "1 mm";
  CHECK_THAT(files.run(fit, {"--no-profiles"}).out, Catch::Contains("model    spacing = 1 mm of the scene left out"));
  fit["set"] = {{"spacing", "1 mm"}};  // insisted on
  CHECK_THAT(files.run(fit, {"--no-profiles"}).out, !Catch::Contains("left out"));
}

TEST_CASE("a forced step below the noise ends with exit status 1 and the reason", "[studies][fit]") {
  const FitFiles files;
  json fit = half_space_fit();
  fit["step"] = 1e-8;
  files.directory.write("table.csv", files.table);
  const std::string file = files.directory.write("fit.json", fit.dump()).string();
  const Evaluate noisy = [](const RollingScene& scene) {
    RollingSolution solution = quick_resistance(scene);
    solution.rolling_resistance *= 1 + 1e-3 * std::sin(1e12 * solution.rolling_resistance);
    return solution;
  };
  const ProgramRun run = run_rollres({"fit", file, "--db", files.database(), "--no-profiles"}, noisy);
  CHECK(run.status == 1);
  CHECK_THAT(run.out, Catch::StartsWith("half space: NOT CONVERGED") && Catch::Contains("are noise"));
}

TEST_CASE("rollres fit draws data, residuals, profiles and the ellipse", "[studies][fit]") {
  const FitFiles files;
  const auto folder = files.directory / "pictures";
  const ProgramRun run = files.run(half_space_fit(), {"--out", folder.string()});
  REQUIRE(run.status == 0);
  for (const char* name :
       {"data", "residuals", "profile_creep_time", "profile_stiffening", "profile_static_shear_modulus", "ellipse"})
    CHECK(std::filesystem::file_size(folder / ("half space_" + std::string(name) + ".svg")) > 1000);
}

TEST_CASE("a fit of scenes is compared with one whose inputs it leaves fixed", "[studies][fit]") {
  const FitFiles files;
  files.directory.write("table.csv", files.table);
  json free = half_space_fit(), fixed = half_space_fit();
  fixed["fit"] = "two parameters";
  fixed["parameters"].erase("stiffening");
  const ProgramRun run = run_rollres({"fit", files.directory.write("a.json", fixed.dump()).string(),
                                      files.directory.write("b.json", free.dump()).string(), "--compare", "--db",
                                      files.database(), "--json", "--no-profiles"},
                                     quick_resistance);
  const json answer = json::parse(run.out);
  REQUIRE(answer["likelihood_ratios"].size() == 1);
  CHECK(answer["likelihood_ratios"][0]["case_of"] == "half space");
  CHECK(answer["likelihood_ratios"][0]["degrees"] == 1);
  CHECK(answer["likelihood_ratios"][0]["p_value"].get<double>() > 1e-3);  // stiffening 2 is true
  CHECK_THAT(answer["largest_difference"]["where"].get<std::string>(), Catch::Contains("table.csv, line "));
}

TEST_CASE("temperatures that were measured give the heat transfer to the air", "[studies][fit]") {
  const auto by_core = [](const RollingScene& scene) { return solve(scene); };
  const TemporaryDirectory folder;
  const json belt{{"radius", 0.05},
                  {"layer_thickness", 0.008},
                  {"static_shear_modulus", 2e6},
                  {"stiffening", 2},
                  {"creep_time", 0.003},
                  {"speed", 2},
                  {"friction_coefficient", 0},
                  {"heat", "on"},
                  {"thermal_conductivity", 0.2},
                  {"turn_length", "3 m"},
                  {"ambient_temperature", "20 degC"},
                  {"surface_heat_transfer", 15}};
  std::ostringstream table;
  table.precision(12);
  table << "load [N/m],surface_temperature [K],sigma [K]\n";
  for (const double load : {2e3, 5e3, 8e3, 1.2e4}) {
    json one = belt;
    one["load"] = load;
    const RollingSolution s = solve(read_scene(folder.write("scene.json", one.dump()).string()));
    REQUIRE(s.surface_temperature > 293.15 + 0.5);
    table << load << ',' << s.surface_temperature << ",0.1\n";
  }
  folder.write("table.csv", table.str());
  json scene = belt;
  scene.erase("surface_heat_transfer");
  const json fit{{"fit", "warm"},
                 {"scene", scene},
                 {"data", "table.csv"},
                 {"output", "surface_temperature"},
                 {"parameters", {{"surface_heat_transfer", {{"start", 40}}}}}};
  const ProgramRun run = run_rollres(
      {"fit", folder.write("fit.json", fit.dump()).string(), "--db", (folder / "fit.db").string(), "--json"}, by_core);
  INFO(run.err);
  const json answer = json::parse(run.out);
  CHECK(answer["parameters"][0]["value"].get<double>() == Approx(15).epsilon(1e-4));
}
