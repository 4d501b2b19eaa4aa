#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/material/fractional_zener.hpp"
#include "db/queries/query.hpp"
#include "db/rows/fit_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/half_space_fit.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers report_fit, fit_design, fit_file, fit_data, material_file, fit_summary, fit_json, fit_chart, fit_curves,
// fit_comparison, fitted_scene, stored_fit, shift_file and material_curves, too.

using namespace rollres;
using nlohmann::json;

namespace {

/// A fit file, its table, and a database, in a directory of their own.
struct FitFiles {
  TemporaryDirectory directory;
  std::string table = "load [kN/m],speed [cm/s],rolling_resistance [N/m],sigma [%]\n";

  explicit FitFiles(double noise = 0.02) {
    for (const MeasuredScene& row : measured(quick_resistance, spread_speeds(0.005, 5, 8), {1e4, 4e4}, noise)) {
      std::ostringstream line;
      line << *row.scene.load / 1e3 << ',' << row.scene.speed * 100 << ',' << row.measured.value << ',' << 100 * noise << '\n';
      table += line.str();
    }
  }

  std::string database() const { return (directory / "fit.db").string(); }
  ProgramRun run(const json& fit, std::vector<std::string> more = {}) const {
    directory.write("table.csv", table);
    std::vector<std::string> words{"fit", directory.write("fit.json", fit.dump()).string(), "--db", database()};
    words.insert(words.end(), more.begin(), more.end());
    return run_rollres(words, quick_resistance);
  }
};

}  // namespace

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

TEST_CASE("an offset is fitted, stored and left out of the fitted scene; columns are ignored by name",
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
  CHECK_THAT(files.run(fit).err, Catch::Contains("relative_noise") && Catch::Contains("empty object"));
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

TEST_CASE("the example of moduli at three temperatures gives its WLF constants back", "[studies][fit]") {
  const TemporaryDirectory directory;
  const std::string file = (source_directory() / "studies/examples/fit_temperatures.json").string();
  const ProgramRun run = run_rollres({"fit", file, "--db", (directory / "m.db").string(), "--json"}, quick_resistance);
  CHECK(run.status == 0);
  const json answer = json::parse(run.out);
  const std::map<std::string, double> truth{{"static_shear_modulus", 1e6},
                                            {"stiffening", 200},
                                            {"creep_time", 20},
                                            {"order", 0.6},
                                            {"wlf_c1", 8.86},
                                            {"wlf_c2", 101.6}};
  for (const json& fitted : answer["parameters"]) {
    const double distance = fitted["value"].get<double>() - truth.at(fitted["name"]);
    CHECK(std::abs(distance) < 3 * fitted["standard_error"].get<double>());
  }
}

TEST_CASE("the example of measured moduli is fitted", "[studies][fit]") {
  const TemporaryDirectory directory;
  const std::string file = (source_directory() / "studies/examples/fit_rubber.json").string();
  const ProgramRun run = run_rollres({"fit", file, "--db", (directory / "m.db").string(), "--json"}, quick_resistance);
  const json answer = json::parse(run.out);
  CHECK(run.status == 0);
  CHECK(answer["kind"] == "material");
  CHECK(answer["values"] == 18);
  CHECK(answer["relative_rms"].get<double>() < 0.03);
  CHECK(answer["evaluations"].get<int>() < 100);
  // The rows stand up to three decades apart: the fit says that they leave the loss between them open.
  CHECK_THAT(answer["warnings"].dump(), Catch::Contains("leave the loss modulus between them open"));
}

TEST_CASE("a fitted material is written as a scene with all digits, and kept in the store", "[studies][fit]") {
  const TemporaryDirectory directory;
  const std::string file = (source_directory() / "studies/examples/fit_rubber.json").string();
  const std::string database = (directory / "m.db").string(), scene = (directory / "new/scene.json").string();
  const json answer =
      json::parse(run_rollres({"fit", file, "--db", database, "--json", "--scene", scene}, quick_resistance).out);
  const RollingScene read = read_scene(scene);
  CHECK(read.material == MaterialModel::prony);
  CHECK(read.listed_moduli == ListedModuli::shear);
  CHECK(*read.static_shear_modulus == answer["parameters"][0]["value"].get<double>());
  REQUIRE(read.relaxation_moduli.size() + 1 == answer["parameters"].size());
  for (std::size_t j = 0; j < read.relaxation_moduli.size(); ++j)
    CHECK(read.relaxation_moduli[j] == answer["parameters"][j + 1]["value"].get<double>());
  CHECK(read.radius == read_scene(source_directory() / "studies/examples/paper_cylinder.json").radius);
  CHECK(answer["scene"] == json::parse(file_text(scene)));

  const auto told = [&](std::vector<std::string> words) {
    words.insert(words.begin() + 1, {"--db", database});
    return run_rollres(words, quick_resistance);
  };
  CHECK_THAT(told({"list"}).out, Catch::Contains("fit_rubber") && Catch::Contains("material"));
  CHECK(json::parse(told({"list", "--json"}).out)["fits"][0]["fit"] == "fit_rubber");
  CHECK_THAT(told({"show", "fit_rubber"}).out, Catch::StartsWith("fit_rubber: USABLE") && Catch::Contains("+-"));
  CHECK(json::parse(told({"show", "fit_rubber", "--json"}).out)["scene"] == answer["scene"]);
  CHECK_THAT(told({"show", "fit_ruber"}).err, Catch::Contains("did you mean fit_rubber?"));
  const std::string folder = (directory / "handed_on").string();
  CHECK(told({"export", "--out", folder}).status == 0);
  CHECK(json::parse(file_text(folder + "/scene.json")) == answer["scene"]);
  CHECK_THAT(file_text(folder + "/parameters.csv"), Catch::StartsWith("name,unit,") && Catch::Contains("\nmodulus ("));
  CHECK(told({"report", "--out", (directory / "r.html").string()}).status == 0);
  const std::string merged = (directory / "all.db").string();
  CHECK(run_rollres({"merge", database, "--db", merged}, quick_resistance).status == 0);
  CHECK(stored_fits(open_database(merged, Access::read)).size() == 1);
}

TEST_CASE("models fitted to the same data are compared, a case of another by its likelihood", "[studies][fit]") {
  const TemporaryDirectory directory;
  const auto example = [](const std::string& name) {
    return (source_directory() / "studies/examples" / (name + ".json")).string();
  };
  const std::vector<std::string> words{"fit",  example("fit_sheet_zener"),   example("fit_sheet"), "--compare",
                                       "--db", (directory / "m.db").string()};
  const ProgramRun text = run_rollres(words, quick_resistance);
  CHECK(text.status == 0);
  CHECK_THAT(text.out, Catch::Contains("fit_sheet_zener is a case of fit_sheet") &&
                           Catch::Contains("the two best differ most, by "));
  std::vector<std::string> as_json = words;
  as_json.emplace_back("--json");
  const json answer = json::parse(run_rollres(as_json, quick_resistance).out);
  CHECK(answer["best"] == "fit_sheet");
  const json &best = answer["fits"][0], &other = answer["fits"][1];
  CHECK(best["parameters"] == 5);
  CHECK(best["weight"].get<double>() > 0.999);
  const double n = 34, k = 5;  // deviations are known
  CHECK(best["aicc"].get<double>() ==
        Approx(best["chi_squared"].get<double>() + 2 * k + 2 * k * (k + 1) / (n - k - 1)));
  CHECK(best["bic"].get<double>() == Approx(best["chi_squared"].get<double>() + k * std::log(n)));
  const json& ratio = answer["likelihood_ratios"][0];
  CHECK(ratio["degrees"] == 2);
  CHECK(ratio["rise"].get<double>() == Approx(other["chi_squared"].get<double>() - best["chi_squared"].get<double>()));

  CHECK_THAT(run_rollres({"fit", example("fit_sheet"), example("fit_rubber"), "--compare", "--db",
                          (directory / "n.db").string()},
                         quick_resistance)
                 .err,
             Catch::Contains("only fits of the same data can be compared"));
  CHECK_THAT(run_rollres({"fit", example("fit_sheet"), "--compare", "--db", "x.db"}, quick_resistance).err,
             Catch::Contains("needs two fit files"));
  CHECK_THAT(run_rollres({"fit", example("fit_sheet"), example("fit_rubber"), "--db", "x.db"}, quick_resistance).err,
             Catch::Contains("several fits: need --compare"));
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

TEST_CASE("columns of a table of moduli are known, left out with a note, or refused as misspelt", "[studies][fit]") {
  const TemporaryDirectory directory;
  const auto run = [&](const std::string& heading, const std::string& rows, const json& more = json::object()) {
    json fit{{"fit", "sheet"}, {"material", "zener"}, {"data", "table.csv"}};
    fit.update(more);
    directory.write("table.csv", heading + "\n" + rows);
    return run_rollres({"fit", directory.write("fit.json", fit.dump()).string(), "--db", (directory / "m.db").string(),
                        "--json", "--no-profiles"},
                       quick_resistance);
  };
  std::string rows;
  for (int i = 0; i < 12; ++i) {
    const double omega = std::pow(10, -2 + i / 2.0);
    const auto modulus = complex_modulus(FractionalZener{1e6, 3, 1, 1}, omega);
    std::ostringstream line;
    line.precision(12);
    line << omega << ',' << modulus.real() << ',' << modulus.imag() << ",25\n";
    rows += line.str();
  }
  const std::string known = "angular_frequency [rad/s],storage_modulus [Pa],loss_modulus [Pa],";
  const json noted = json::parse(run(known + "strain [%]", rows).out);
  CHECK_THAT(noted["model"].dump(), Catch::Contains("columns of table.csv left out: strain"));
  CHECK(noted["parameters"][2]["value"].get<double>() == Approx(1).epsilon(1e-6));
  CHECK(json::parse(run(known + "strain [%]", rows, {{"ignore_columns", {"strain"}}}).out)["model"].empty());
  CHECK_THAT(run(known + "temprature [K]", rows).err, Catch::Contains("did you mean temperature?"));

  const auto errors = [&](const json& sigma) {
    return json::parse(run(known + "note", rows, {{"sigma", sigma}}).out)["parameters"][2]["standard_error"];
  };
  const double equal = errors("2 %");
  CHECK(errors({{"storage_modulus", "2 %"}, {"loss_modulus", "2 %"}}).get<double>() == equal);
  CHECK(errors({{"storage_modulus", "2 %"}, {"loss_modulus", "20 %"}}).get<double>() > 1.2 * equal);
  CHECK_THAT(run(known + "note", rows, {{"sigma", {{"loss_modulus", "2 %"}}}}).err,
             Catch::Contains("sigma: storage_modulus is missing"));
  CHECK_THAT(run(known + "note", rows, {{"sigma", 2}}).err, Catch::Contains("must be a percentage > 0"));
}

TEST_CASE("Kraus's model is fitted to a strain sweep, drawn, stored and solved with", "[studies][fit]") {
  const TemporaryDirectory directory;
  const auto run = [&](const std::string& fit, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"fit", fit, "--db", (directory / "m.db").string()});
    return run_rollres(more, quick_resistance);
  };
  const std::string file = (source_directory() / "studies/examples/fit_kraus.json").string(),
                    scene = (directory / "scene.json").string();
  const ProgramRun made = run(file, {"--json", "--out", (directory / "pictures").string(), "--scene", scene});
  CHECK(made.status == 0);
  CHECK(json::parse(made.out)["kind"] == "strain");
  CHECK(std::filesystem::file_size(directory / "pictures/fit_kraus_data.svg") > 1000);
  CHECK(run_rollres({"solve", scene}, quick_resistance).status == 0);
  CHECK_THAT(run_rollres({"show", "fit_kraus", "--db", (directory / "m.db").string()}, quick_resistance).out,
             Catch::Contains("payne_strain"));

  const auto told = [&](const std::string& table, const std::string& more = "") {
    directory.write("t.csv", table);
    const auto fit = directory.write("t.json", R"({"fit": "t", "material": "kraus", "data": "t.csv")" + more + "}");
    return run(fit.string()).err;
  };
  const std::string head = "strain [%],storage_modulus [MPa],loss_modulus [MPa]\n";
  CHECK_THAT(told(head + "0.1,5,0.5\n1,4,0.6\n10,3,0.5\n"),
             Catch::Contains("t.json: Kraus's model needs moduli at four strains at least; the sweep has 3"));
  CHECK_THAT(told(head + "0.1,5,0.5\n0,4,0.6\n"), Catch::Contains("t.csv, line 3: strain [%] = 0: must be > 0"));
  CHECK_THAT(told(head + "0.1,5,0.5\n1,-4,0.6\n"), Catch::Contains("line 3: storage_modulus [MPa] = -4: must be > 0"));
  CHECK_THAT(told("frequency [Hz]," + head + "1,0.1,5,0.5\n10,1,4,0.6\n"),
             Catch::Contains("line 3: frequency [Hz] = 10: must be that of the first row: a strain sweep is made at "
                             "one frequency and temperature"));
  CHECK_THAT(told("storage_modulus [MPa],loss_modulus [MPa]\n5,0.5\n"), Catch::Contains("strain"));
  CHECK_THAT(told(head + "0.1,5,0.5\n", R"(, "sweep_deformation": "torsion")"),
             Catch::Contains("sweep_deformation = \"torsion\": must be one of shear, tension"));
  CHECK_THAT(told(head + "0.1,5,0.5\n", R"(, "shift": "wlf")"), Catch::Contains("shift"));
  CHECK_THAT(run(file, {"--design"}).err, Catch::Contains("--design and --coverage are for fits of scenes"));
}

TEST_CASE("a law of shift is fitted to a table of shift factors, and written into a scene", "[studies][fit]") {
  const TemporaryDirectory directory;
  const std::string file = (source_directory() / "studies/examples/fit_shift.json").string();
  const auto run = [&](const std::string& fit, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"fit", fit, "--db", (directory / "m.db").string()});
    return run_rollres(more, quick_resistance);
  };
  const ProgramRun made = run(file, {"--json", "--out", (directory / "pictures").string()});
  CHECK(made.status == 0);
  CHECK(std::filesystem::file_size(directory / "pictures/fit_shift_data.svg") > 1000);
  const json answer = json::parse(made.out);
  CHECK(answer["kind"] == "shift");
  CHECK(answer["scene"]["reference_temperature"] == 293.15);
  CHECK(answer["scene"]["wlf_c1"] == answer["parameters"][0]["value"]);
  CHECK(std::abs(answer["parameters"][0]["value"].get<double>() - 8.86) <
        4 * answer["parameters"][0]["standard_error"].get<double>());
  CHECK_THAT(answer["model"].dump(), Catch::Contains("left out: b_T"));

  directory.write("t.csv", "temperature [K],a_T,log10_a_T\n280,10,1\n290,1,0\n300,0.1,-1\n310,0.02,-1.7\n");
  const std::string both = directory.write("t.json", R"({"fit": "t", "material": "shift", "data": "t.csv"})").string();
  CHECK_THAT(run(both).err, Catch::Contains("t.csv: give a_T or log10_a_T, not both"));
  directory.write("t.csv", "temperature [K],a_T\n280,10\n290,0\n300,0.1\n310,0.02\n");
  CHECK_THAT(run(both).err, Catch::Contains("t.csv, line 3: a_T = 0: must be > 0"));
  const std::string law =
      directory.write("l.json", R"({"fit": "t", "material": "shift", "shift": "none", "data": "t.csv"})").string();
  CHECK_THAT(run(law).err, Catch::Contains("shift = \"none\": must be one of wlf, arrhenius, vft"));
}

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

TEST_CASE("what a former fit says, with its correlations, is worth its data", "[studies][fit]") {
  FitFiles files(0.002);  // so little that both fits are linear within their errors
  const std::size_t head = files.table.find('\n') + 1, middle = files.table.find('\n', head + (files.table.size() - head) / 2) + 1;
  const std::string all = files.table, one = all.substr(0, middle), other = all.substr(0, head) + all.substr(middle);
  json file = half_space_fit();
  const auto fitted = [&](const std::string& name, const std::string& table) {
    files.table = table;
    file["fit"] = name;
    const ProgramRun run = files.run(file, {"--json", "--no-profiles"});
    INFO(run.err);
    REQUIRE(run.status == 0);
    return json::parse(run.out);
  };
  const json together = fitted("together", all), alone = fitted("alone", other);
  fitted("former", one);
  file["prior"] = {{"name", "former"}, {"db", "fit.db"}};
  const json after = fitted("after", other);
  REQUIRE(after["parameters"].size() == together["parameters"].size());
  for (std::size_t j = 0; j < after["parameters"].size(); ++j) {
    const json &here = after["parameters"][j], &there = together["parameters"][j];
    CAPTURE(here["name"]);
    const double error = there["standard_error"];
    CHECK(std::abs(here["value"].get<double>() - there["value"].get<double>()) < 0.1 * error);
    CHECK(here["standard_error"].get<double>() == Approx(error).epsilon(0.05));
    CHECK(alone["parameters"][j]["standard_error"].get<double>() > 1.2 * error);
  }

  const auto refusal = [&](const json& prior) {
    file["prior"] = prior;
    return files.run(file).err;
  };
  using Catch::Contains;
  CHECK_THAT(refusal("former"), Contains("must be an object with name and db"));
  CHECK_THAT(refusal({{"name", "formre"}, {"db", "fit.db"}}), Contains("prior: name = \"formre\"") && Contains("holds no fit"));
  file["parameters"] = {{"friction_coefficient", {{"start", 0.1}}}};
  CHECK_THAT(refusal({{"name", "former"}, {"db", "fit.db"}}), Contains("prior former: it has none of the parameters"));
}
