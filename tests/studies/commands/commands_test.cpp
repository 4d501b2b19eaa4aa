#include "studies/program/commands.hpp"

#include <cmath>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "studies/scene_io/fields_file.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "tests/catch.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"
#include "tests/studies/vtk_numbers.hpp"

// Covers command_line, command_solve and command_quantities, too.

using namespace rollres;
using nlohmann::json;

namespace {

const std::string examples = source_directory().string() + "/studies/examples/";
const std::string cylinder = examples + "paper_cylinder.json";
const std::string sphere = examples + "paper_sphere.json";

/// An answer with known numbers in place of the solver's.
RollingSolution made_up(const RollingScene& scene) {
  RollingSolution solution;
  solution.rolling_resistance = 357.5;
  solution.approach = 0.00036982;
  solution.load = scene.load.value_or(1);
  solution.contact_nodes = 3;
  solution.method = scene.method;
  solution.status = Status::converged;
  solution.warnings = {"strain d/H = 0.07", "a \"second\" one"};
  const bool three = scene.indenter == Indenter::sphere;
  SurfaceFields& fields = solution.fields;
  fields.grid = {.spacing_x = 0.5,
                 .spacing_y = three ? 0.25 : 1.0,
                 .origin_x = 0.125,
                 .first_column = -1,
                 .columns = 3,
                 .rows = three ? 2 : 1};
  const auto nodes = static_cast<std::size_t>(fields.grid.size());
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto number = static_cast<double>(i);
    fields.w.push_back(-0.5 * number);
    fields.u.push_back(0.1 * number);
    fields.pressure.push_back(1e6 * number);
    fields.shear_x.push_back(number);
    fields.slip_x.push_back(0.01 * number);
    if (three) fields.v.push_back(0.2), fields.shear_y.push_back(-number), fields.slip_y.push_back(0.5);
    fields.zone.push_back(static_cast<Zone>(i % 3));
  }
  return solution;
}

}  // namespace

TEST_CASE("solve --json prints one object with every output by its key and the scene it answers",
          "[studies][commands]") {
  const ProgramRun run = run_rollres({"solve", cylinder, "--json", "--set", "speed=36 km/h"}, made_up);
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  const json object = json::parse(run.out);
  for (const std::string_view key : output_keys()) {
    INFO(key);
    CHECK(object.contains(std::string(key)));
  }
  CHECK(object.size() == output_keys().size() + 1);
  CHECK(object["rolling_resistance"] == 357.5);
  CHECK(object["half_width"].is_null());
  CHECK(object["contact_nodes"] == 3);
  CHECK(object["status"] == "converged");
  CHECK(object["warnings"] == json({"strain d/H = 0.07", "a \"second\" one"}));
  CHECK(object["scene"]["speed"] == 10);
  CHECK_FALSE(object["scene"].contains("approach"));
  CHECK(parse_scene(object["scene"].dump(), "scene").load == 20e3);
}

TEST_CASE("the summary shows values with units, and status and warnings first", "[studies][commands]") {
  const ProgramRun run = run_rollres({"solve", cylinder}, made_up);
  CHECK(run.status == 0);
  CHECK(run.out.starts_with("status   converged\nwarning  strain d/H = 0.07\n"));
  CHECK(run.out.find("rolling_resistance  R_r  357.5 N/m\n") != std::string::npos);
  CHECK(run.out.find("369.82 µm") != std::string::npos);
  CHECK(run.out.find("half_width") == std::string::npos);
  CHECK(run_rollres({"solve", sphere}, made_up).out.find("357.5 N\n") != std::string::npos);
  // An error has the unit of its value: not 1 mN/m.
  const Evaluate with_error = [](const RollingScene& scene) {
    RollingSolution solution = made_up(scene);
    solution.rolling_resistance_error = 1e-3;
    return solution;
  };
  CHECK(run_rollres({"solve", cylinder}, with_error).out.find(" 0.001 N/m\n") != std::string::npos);
}

TEST_CASE("a scene without an answer says so and ends with exit status 1", "[studies][commands]") {
  for (const Status status : {Status::no_steady_state, Status::not_converged}) {
    const Evaluate evaluate = [status](const RollingScene&) {
      RollingSolution solution;
      solution.status = status;
      solution.reason = "friction_coefficient would have to be 0.009";
      return solution;
    };
    const ProgramRun text = run_rollres({"solve", cylinder}, evaluate);
    CHECK(text.status == 1);
    CHECK(text.out.find("reason   friction_coefficient would have to be 0.009\n") != std::string::npos);
    const ProgramRun object = run_rollres({"solve", cylinder, "--json"}, evaluate);
    CHECK(object.status == 1);
    CHECK(json::parse(object.out)["status"] == std::string(name_of(status)));
  }
}

TEST_CASE("fields are written for each node with units in the header", "[studies][commands][long]") {
  const TemporaryDirectory directory;
  const auto out = directory.path / "a" / "b";
  CHECK(run_rollres({"solve", cylinder, "--fields", out.string()}, made_up).status == 0);
  CHECK(file_text(out / "fields.csv") ==
        "x [m],w [m],u [m],sigma_z [Pa],tau_xz [Pa],slip_x [m/s],zone\n"
        "-0.375,0,0,0,0,0,free\n"
        "0.125,-0.5,0.1,-1e+06,1,5e-04,stick\n"
        "0.625,-1,0.2,-2e+06,2,0.001,slip\n");

  CHECK(run_rollres({"solve", sphere, "--fields", out.string()}, made_up).status == 0);
  const std::string csv = file_text(out / "fields.csv");
  CHECK(csv.starts_with(
      "x [m],y [m],w [m],u [m],v [m],sigma_z [Pa],tau_xz [Pa],tau_yz [Pa],slip_x [m/s],slip_y [m/s],zone\n"
      "-0.375,0,0,0,0.2,0,0,0,0,0.025,free\n"));
  CHECK(csv.find("\n0.125,0.25,-2,0.4,0.2,-4e+06,4,-4,0.002,0.025,stick\n") != std::string::npos);

  const std::string vti = file_text(out / "fields.vti");
  CHECK(vti.find("WholeExtent=\"0 2 0 1 0 0\" Origin=\"-0.375 0 0\" Spacing=\"0.5 0.25 1\"") != std::string::npos);
  CHECK(vtk_numbers<double>(vti, "sigma_z [Pa]") == std::vector<double>{0, -1e6, -2e6, -3e6, -4e6, -5e6});
  CHECK(
      vti.find("<FieldData>\n<DataArray type=\"String\" Name=\"scene\" NumberOfTuples=\"1\" format=\"ascii\">\n123 ") !=
      std::string::npos);  // {
  CHECK(
      vti.find(
          "<DataArray type=\"String\" Name=\"zone\" NumberOfTuples=\"1\" format=\"ascii\">\n48 32 102 114 101 101 ") !=
      std::string::npos);  // 0 free
  CHECK(vti.find("Name=\"rolling_resistance [N]\" NumberOfTuples=\"1\" format=\"ascii\">\n") != std::string::npos);
  CHECK(vtk_numbers<std::int8_t>(vti, "zone") == std::vector<std::int8_t>{0, 1, 2, 0, 1, 2});
  CHECK(std::distance(std::filesystem::directory_iterator(out), {}) == 9);  // nothing temporary is left
}

TEST_CASE("an unknown number is an empty cell, and left out of the VTK file", "[studies][commands]") {
  const RollingScene scene = read_scene(cylinder);
  RollingSolution solution = made_up(scene);
  solution.fields.slip_x[1] = RollingSolution::absent;
  CHECK(fields_csv(scene, solution.fields, solution).find("-1e+06,1,,stick\n") != std::string::npos);
  CHECK(fields_vti(scene, solution.fields, solution).find("slip_x") == std::string::npos);
  for (const double value : vtk_numbers<double>(fields_vti(scene, solution.fields, solution), "velocity [m/s]"))
    CHECK(std::isfinite(value));
}

TEST_CASE("files and streams that fail end with exit status 3 and one line", "[studies][commands]") {
  const TemporaryDirectory directory;
  const std::string file = directory.write("file", "").string();
  const ProgramRun blocked = run_rollres({"solve", cylinder, "--fields", file}, made_up);
  CHECK(blocked.status == 3);
  CHECK(blocked.err == "rollres: " + file + ": cannot be made a directory: Not a directory\n");
  CHECK(run_rollres({"solve", cylinder, "--fields", file + "/below"}, made_up).status == 3);

  std::filesystem::create_directories(directory.path / "out/fields.csv/in_the_way");
  const ProgramRun taken = run_rollres({"solve", cylinder, "--fields", (directory.path / "out").string()}, made_up);
  CHECK(taken.status == 3);
  CHECK(taken.err.starts_with("rollres: " + (directory.path / "out/fields.csv").string() + ": cannot be written: "));
  CHECK(std::distance(std::filesystem::directory_iterator(directory.path / "out"), {}) == 1);

  CHECK(run_rollres({"solve", "/nowhere/scene.json"}, made_up).status == 3);

  std::ofstream full("/dev/full");
  std::ostringstream err;
  CHECK(run_program({"solve", cylinder, "--json"}, {full, err, made_up}) == 3);
  CHECK(err.str() == "rollres: standard output: cannot be written\n");
}

TEST_CASE("no exception leaves the program", "[studies][commands]") {
  const auto status_of = [](auto error) {
    return run_rollres({"solve", cylinder}, [&](const RollingScene&) -> RollingSolution { throw error; }).status;
  };
  CHECK(status_of(std::invalid_argument("speed = 0: must be > 0")) == 2);
  CHECK(status_of(std::runtime_error("disk")) == 3);
  CHECK(status_of(std::logic_error("ours")) == 3);
  CHECK(status_of(std::bad_alloc()) == 3);
  CHECK(status_of(42) == 3);
}

TEST_CASE("wrong commands end with exit status 2 and one line", "[studies][commands]") {
  const std::vector<std::vector<std::string>> commands{{"sovle", cylinder},
                                                       {"solve"},
                                                       {"--nothing"},
                                                       {"solve", cylinder, "--jsn"},
                                                       {"solve", cylinder, cylinder},
                                                       {"solve", cylinder, "--set"},
                                                       {"solve", cylinder, "--fields"},
                                                       {"solve", cylinder, "--fields", ""},
                                                       {"quantities", "all"},
                                                       {""}};
  for (const auto& words : commands) {
    const ProgramRun run = run_rollres(words, made_up);
    CAPTURE(words);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK(run.err.starts_with("rollres: "));
    CHECK(run.err.find('\n') == run.err.size() - 1);
  }
  CHECK(run_rollres({"sovle"}, made_up).err == "rollres: sovle: unknown command; did you mean solve?\n");
}

TEST_CASE("every command explains itself with an example", "[studies][commands]") {
  const ProgramRun help = run_rollres({"--help"}, made_up);
  CHECK(help.status == 0);
  CHECK(help.err.empty());
  for (const std::string name : {"solve", "quantities"}) {
    CHECK(help.out.find("\n  " + name) != std::string::npos);
    const ProgramRun run = run_rollres({name, "--help"}, made_up);
    CHECK(run.status == 0);
    CHECK(run.out.find("Example: rollres " + name) != std::string::npos);
  }
  CHECK(run_rollres({"--version"}, made_up).out == "rollres 1.0.0\n");
  // Fails if a library lacks its version or licence: who hands the program on has to know them.
  const json handed_on = json::parse(run_rollres({"--version", "--json"}, made_up).out);
  CHECK(handed_on["version"] == "1.0.0");
  REQUIRE(handed_on["libraries"].size() > 10);
  for (const json& library : handed_on["libraries"])
    for (const char* key : {"name", "version", "licence"}) {
      INFO(library.dump());
      CHECK(!library.at(key).get<std::string>().empty());
    }
}

TEST_CASE("quantities lists every input and output with unit, values and meaning", "[studies][commands]") {
  const json object = json::parse(run_rollres({"quantities", "--json"}, made_up).out);
  const std::string text = run_rollres({"quantities"}, made_up).out;
  REQUIRE(object["inputs"].size() == written_kinds().size());
  REQUIRE(object["outputs"].size() == output_keys().size());
  for (const char* const part : {"inputs", "outputs"})
    for (const json& quantity : object[part]) {
      INFO(quantity.dump());
      CHECK_FALSE(quantity["values"].get<std::string>().empty());
      CHECK_FALSE(quantity["meaning"].get<std::string>().empty());
      CHECK(text.find("\n" + quantity["key"].get<std::string>() + " ") != std::string::npos);
    }
  const json load = *std::find_if(object["inputs"].begin(), object["inputs"].end(),
                                  [](const json& quantity) { return quantity["key"] == "load"; });
  CHECK(load["unit_2d"] == "N/m");
  CHECK(load["unit_3d"] == "N");
  CHECK(load["default"] == "or approach");
}
