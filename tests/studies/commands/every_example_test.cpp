#include <set>

#include "core/solve/rolling_contact.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/optimise/design_keys.hpp"
#include "studies/study/study_keys.hpp"
#include "studies/study/uncertain_inputs.hpp"
#include "studies/text/strict_json.hpp"
#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

namespace {

/// All keys of an object and of what stands in it.
void add_keys(const Json& value, std::set<std::string>& keys) {
  for (const auto& [key, inside] : value.items()) {
    if (value.is_object()) keys.insert(key);
    if (inside.is_structured()) add_keys(inside, keys);
  }
}

/// The example files that have this key.
std::vector<std::filesystem::path> examples_with(const std::string& key) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(source_directory() / "studies/examples"))
    if (entry.path().extension() == ".json" && read_object(entry.path().string()).contains(key))
      files.push_back(entry.path());
  return files;
}

}  // namespace

TEST_CASE("every key of studies and optimisations has an example", "[studies][examples]") {
  std::set<std::string> of_studies, of_designs;
  for (const auto& file : examples_with("study")) {
    const Json object = read_object(file.string());
    add_keys(object, object.contains("variables") ? of_designs : of_studies);
  }
  const auto check = [](const auto& keys, const std::set<std::string>& used) {
    for (const FileKey& key : keys) {
      CAPTURE(key.key);
      CHECK(used.contains(std::string(key.key)));
    }
  };
  check(study_keys, of_studies);
  check(interval_keys, of_studies);
  check(zip_keys, of_studies);
  check(sample_keys, of_studies);
  check(range_keys, of_studies);
  check(chart_keys, of_studies);
  check(distribution_keys, of_studies);
  check(uncertain_keys, of_studies);
  check(design_keys, of_designs);
  check(variable_keys, of_designs);
  check(duty_keys, of_designs);
  check(stop_keys, of_designs);
  check(pareto_keys, of_designs);
  for (const char* const key : {"variant", "master_curve_file", "shift_table_file"}) CHECK(of_studies.contains(key));
  CHECK(of_designs.contains("variant"));
}

TEST_CASE("every key of fits of scenes has an example, and each of these is fitted", "[studies][examples][fit]") {
  std::set<std::string> used;
  const TemporaryDirectory folder;
  for (const char* const name : {"fit_rig", "fit_flank", "fit_robust", "fit_design", "fit_moduli"}) {
    CAPTURE(name);
    const std::string file = (source_directory() / "studies/examples" / (std::string(name) + ".json")).string();
    add_keys(read_object(file), used);
    const ProgramRun run =
        run_rollres({"fit", file, "--db", (folder / "fits.db").string(), "--json", "--no-profiles"}, quick_resistance);
    CHECK(run.status <= 1);  // a formula in place of the solver: whatever it makes of the data
    const Json answer = Json::parse(run.out);
    CHECK(answer["fit"] == name);
    CHECK(answer["noise_terms"].size() == (std::string(name) == "fit_rig" ? 2 : 0));
  }
  const auto check = [&](const auto& keys) {
    for (const FileKey& key : keys) {
      CAPTURE(key.key);
      CHECK(used.contains(std::string(key.key)));
    }
  };
  check(fit_keys);
  check(data_set_keys);
  check(fit_parameter_keys);
  check(prior_keys);
  check(design_wish_keys);
  check(design_range_keys);
  for (const char* const key : {"offset", "relative_noise"}) CHECK(used.contains(key));
}

TEST_CASE("every key of fits of materials has an example, and each of these gives back what its data were drawn from",
          "[studies][examples][fit]") {
  std::set<std::string> of_materials, of_shifts, of_strains;
  const TemporaryDirectory folder;
  const auto fitted = [&](const std::string& name, std::set<std::string>& used) {
    CAPTURE(name);
    const std::string file = (source_directory() / "studies/examples" / (name + ".json")).string();
    add_keys(read_object(file), used);
    const ProgramRun run =
        run_rollres({"fit", file, "--db", (folder / "fits.db").string(), "--json", "--no-profiles"}, quick_resistance);
    CHECK(run.status == 0);
    return Json::parse(run.out);
  };
  const auto check = [](const Json& fit, const std::string& name, double truth) {
    CAPTURE(name);
    const auto& all = fit["parameters"];
    const auto one = std::find_if(all.begin(), all.end(), [&](const Json& other) { return other["name"] == name; });
    REQUIRE(one != all.end());
    CHECK(std::abs((*one)["value"].get<double>() - truth) < 3 * (*one)["standard_error"].get<double>());
  };
  const Json shifted = fitted("fit_shifted", of_materials);
  check(shifted, "static_shear_modulus", 1e6);
  check(shifted, "stiffening", 200);
  check(shifted, "creep_time", 20);
  check(shifted, "order", 0.6);
  CHECK(shifted["scene"]["shift_temperatures"].size() == 6);
  const Json vft = fitted("fit_shift_vft", of_shifts);
  check(vft, "vft_b", 8.86 * 101.6 * std::log(10.0));
  check(vft, "vft_temperature", 293.15 - 101.6);
  CHECK(of_materials.contains("shift_table_file"));
  const Json kraus = fitted("fit_kraus", of_strains);
  check(kraus, "storage_modulus", 3 * 5.1e6);
  check(kraus, "loss_modulus", 3 * 0.48e6);
  check(kraus, "payne_drop", 0.62);
  check(kraus, "payne_strain", 0.012);
  check(kraus, "payne_exponent", 0.55);
  check(kraus, "payne_loss_peak", 1.45);
  CHECK(kraus["scene"]["payne_drop"].is_number());
  CHECK_FALSE(kraus["scene"].contains("sweep_strains"));
  CHECK(of_strains.contains("sweep_deformation"));
  CHECK(of_strains.contains("sweep_amplitude"));
}

TEST_CASE("every example of a study and of an optimisation is planned, run and drawn", "[studies][examples][long]") {
  const TemporaryDirectory folder;
  for (const auto& file : examples_with("study")) {
    if (file.stem() == "fit_scatter") continue;  // needs a stored fit: below
    CAPTURE(file);
    const std::string name = file.stem().string(), db = folder / (name + ".db");
    const bool design = read_object(file.string()).contains("variables");
    const ProgramRun run = run_rollres({design ? "optimise" : "sweep", file.string(), "--db", db}, closed_form);
    CHECK(run.err.find("rollres:") == std::string::npos);
    CHECK(run.status <= (design ? 1 : 0));  // a closed form in place of the solver need have no optimum
    CHECK(
        run_rollres({"show", "--db", db, read_object(file.string())["study"].get<std::string>()}, closed_form).status ==
        0);
    if (design) continue;
    CHECK(run_rollres({"plan", file.string(), "--limit", "3"}, closed_form).status == 0);
  }
}

TEST_CASE("the example that scatters as a stored fit says takes the one that the README stores",
          "[studies][examples][long]") {
  // README and guide store fits in out/results.db.
  const TemporaryDirectory folder;
  const auto examples = folder.path / "studies" / "examples";
  std::filesystem::create_directories(examples);
  std::filesystem::create_directory(folder.path / "out");
  for (const char* const name : {"fit_scatter.json", "paper_cylinder.json"})
    std::filesystem::copy(source_directory() / "studies/examples" / name, examples / name);
  const std::string study = (examples / "fit_scatter.json").string(), db = folder / "out/results.db";
  CHECK(run_rollres({"plan", study}, quick_resistance).status != 0);
  const std::string fit = (source_directory() / "studies/examples/fit_cylinder.json").string();
  CHECK(run_rollres({"fit", fit, "--db", db, "--no-profiles"}, solve).status == 0);
  const ProgramRun run = run_rollres({"sweep", study, "--db", db}, quick_resistance);
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK(run.out.find("224 of 224 points") != std::string::npos);
}
