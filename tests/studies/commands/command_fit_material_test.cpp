#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/material/fractional_zener.hpp"
#include "db/rows/fit_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers material_file, shift_file and material_curves.

using namespace rollres;
using nlohmann::json;

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

TEST_CASE("a fitted material is written as a scene with all digits, and kept in the store", "[studies][fit][long]") {
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

TEST_CASE("columns of a table of moduli are known, left out with a note, or refused as misspelt", "[studies][fit]") {
  const TemporaryDirectory directory;
  const auto run = [&](const std::string& heading, const std::string& rows, const json& more = json::object()) {
    json fit{{"fit", "sheet"}, {"material", "zener"}, {"data", "table.csv"}, {"listed_moduli", "shear"}};
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
  CHECK_THAT(json::parse(run(known + "strain [%]", rows, {{"ignore_columns", {"strain"}}}).out)["model"].dump(),
             !Catch::Contains("left out"));
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

TEST_CASE(
    "a fit of a material reads Young's moduli as the names of columns or listed_moduli say, and asks where neither "
    "does",
    "[studies][fit]") {
  const TemporaryDirectory directory;
  std::ostringstream rows;
  for (int i = 0; i < 12; ++i) {  // E = 3 G, for nu = 1/2
    const double omega = std::pow(10, -2 + i / 2.0);
    const auto modulus = 3.0 * complex_modulus(FractionalZener{1e6, 3, 1, 1}, omega);
    rows << omega << ',' << modulus.real() << ',' << modulus.imag() << '\n';
  }
  const auto run = [&](const std::string& storage, const json& more = json::object()) {
    json fit{{"fit", "sheet"}, {"material", "zener"}, {"data", "table.csv"}};
    fit.update(more);
    directory.write("table.csv", "angular_frequency [rad/s]," + storage + " [Pa],loss_modulus [Pa]\n" + rows.str());
    return run_rollres({"fit", directory.write("fit.json", fit.dump()).string(), "--db", (directory / "m.db").string(),
                        "--json", "--no-profiles"},
                       quick_resistance);
  };
  const auto modulus_at_rest = [&](const std::string& storage, const json& more = json::object()) {
    return json::parse(run(storage, more).out)["parameters"][0]["value"].get<double>();
  };
  CHECK(modulus_at_rest("storage_modulus", {{"listed_moduli", "young"}}) == Approx(1e6).epsilon(1e-4));
  CHECK(modulus_at_rest("storage_modulus", {{"listed_moduli", "shear"}}) == Approx(3e6).epsilon(1e-4));
  CHECK(modulus_at_rest("storage_young_modulus") == Approx(1e6).epsilon(1e-4));
  CHECK(modulus_at_rest("G'") == Approx(3e6).epsilon(1e-4));
  CHECK(modulus_at_rest("storage_modulus", {{"modulus", "young"}}) == Approx(1e6).epsilon(1e-4));  // its former name
  CHECK_THAT(run("storage_modulus").err,
             Catch::Contains("fit.json: listed_moduli is missing: storage_modulus of table.csv: of shear or Young's?"));
  CHECK_THAT(run("E'", {{"listed_moduli", "shear"}}).err, Catch::Contains("the columns of table.csv say young"));
  CHECK_THAT(run("E'", {{"listed_moduli", "young"}, {"modulus", "young"}}).err,
             Catch::Contains("modulus = \"young\": is the former name of listed_moduli: leave out one of them"));
}

TEST_CASE("Kraus's model is fitted to a strain sweep, drawn, stored and solved with", "[studies][fit][long]") {
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
             Catch::Contains("line 3: frequency [Hz] = 10: must be the same in all rows: a strain sweep is made at "
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
