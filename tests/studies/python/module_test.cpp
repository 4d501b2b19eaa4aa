#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "core/solve/rolling_contact.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/words.hpp"
#include "tests/catch.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/shell.hpp"
#include "tests/studies/temporary_directory.hpp"

// The Python package (module, package, stubs): what a user does with it stands in package.py
// and pools.py.

using namespace rollres;

namespace {

#ifdef ROLLRES_PYTHON
/// The interpreter that the package was built for, with the package.
const std::string python = "PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=" + shell_word(ROLLRES_PYTHON_FOLDER) + " " +
                           shell_word(ROLLRES_PYTHON) + " ";

bool can_import(const std::string& modules) {
  if (run_shell(python + "-c 'import " + modules + "'").status == 0) return true;
  WARN("Python's " << modules << " is not there");
  return false;
}
#else
const std::string python;
bool can_import(const std::string&) {
  WARN("the Python package is not built");
  return false;
}
#endif

void run_part(const std::string& part, const std::string& file = "package.py") {
  if (!can_import("numpy")) return;
  const ShellRun run =
      run_shell(python + shell_word((source_directory() / "tests/studies/python" / file).string()) + " " + part);
  INFO(run.out);
  CHECK(run.status == 0);
}

/// Runs an example, which compares what it finds with the program's own answer.
void run_example(const std::string& name, const std::string& needs, const std::string& word = "") {
  if (!can_import(needs)) return;
  const TemporaryDirectory folder;
  const std::string file = (source_directory() / "studies/examples/python" / name).string();
  const ShellRun run =
      run_shell("cd " + shell_word(folder.path.string()) + " && " + python + shell_word(file) + " " + word);
  INFO(run.out);
  CHECK(run.status == 0);
}

/// Numbers of an answer but the time that it took.
std::vector<double> numbers(const Json& answer) {
  std::vector<double> found;
  const RollingSolution none;
  visit_outputs(none, [&](const Quantity& quantity, const auto& value) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
      if (const auto number = answer.find(std::string(quantity.key));
          quantity.key != "seconds" && number != answer.end() && number->is_number())
        found.push_back(number->get<double>());
  });
  return found;
}

}  // namespace

TEST_CASE("in Python inputs are those of scene files, answers have the keys of the lists", "[studies][python]") {
  run_part("values");
}
TEST_CASE("Python refuses in the words of the command line", "[studies][python]") { run_part("refusals"); }
TEST_CASE("Python refuses in words what is no input", "[studies][python]") { run_part("hostile"); }
TEST_CASE("fields are arrays of numpy that share the answer's memory", "[studies][python]") { run_part("fields"); }
TEST_CASE("Python solves many scenes by threads, from tables and through a database", "[studies][python]") {
  run_part("many");
}
TEST_CASE("Ctrl-C ends what Python computes", "[studies][python]") { run_part("interrupts"); }
TEST_CASE("objectives of Python have gradients that agree with the program's", "[studies][python]") {
  run_part("functions");
}
TEST_CASE("Python sweeps, fits and reads databases", "[studies][python]") { run_part("studies"); }
TEST_CASE("docstrings and type stubs name every quantity with its unit", "[studies][python]") {
  run_part("documentation");
}
TEST_CASE("the memory of a Python process stays flat over thousands of solutions", "[studies][python]") {
  run_part("memory");
}

TEST_CASE("examples for Python find what the program finds", "[studies][python][examples]") {
  run_example("ask_and_tell.py", "numpy");
  run_example("posterior.py", "numpy");
  run_example("speed_resistance.py", "matplotlib");
  run_example("optimise_layer.py", "scipy");
  run_example("fit_cylinder.py", "lmfit");
}

TEST_CASE("answers, fields and objectives pickle to the last bit", "[studies][python][pools]") {
  run_part("pickles", "pools.py");
  run_part("objectives", "pools.py");
}
TEST_CASE("two hundred scenes by a pool are those of one process", "[studies][python][pools]") {
  run_part("processes", "pools.py");
}
TEST_CASE("the example of pools works with processes, joblib and dask.distributed", "[studies][python][pools]") {
  run_example("pools.py", "numpy", "processes");
  run_example("pools.py", "joblib", "joblib");
  run_example("pools.py", "dask.distributed", "dask");
}

TEST_CASE("the library, the command line, the service and Python answer the same to the last bit",
          "[studies][python][serve]") {
  const TemporaryDirectory folder;
  const std::string examples = (source_directory() / "studies/examples").string();
  folder.write("coated.json", R"({"radius": "20 mm", "speed": "1 m/s", "load": "4 kN/m", "friction_coefficient": 0.3,
    "layer_thickness": "infinite", "material": "elastic", "static_shear_modulus": "10 GPa", "poisson_ratio": 0.2,
    "coating_layers": [{"layer_thickness": "5 mm", "static_shear_modulus": "2 MPa", "stiffening": 1.5, "creep_time": "5 ms"}]})");
  const std::vector<std::string> files{examples + "/paper_cylinder.json", examples + "/paper_sphere.json",
                                       (folder / "coated.json").string()};
  std::string words;
  for (const std::string& file : files) words += " " + shell_word(file);
  std::vector<Json> from_python;
  if (can_import("numpy")) {
    const ShellRun run = run_shell(
        python + shell_word((source_directory() / "tests/studies/python/package.py").string()) + " answers" + words);
    INFO(run.out);
    REQUIRE(run.status == 0);
    for (const Json& answer : Json::parse(run.out)) from_python.push_back(answer);
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    INFO(files[i]);
    const RollingSolution solution = solve(read_scene(files[i]));
    std::vector<double> expected;
    visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
      if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
        if (quantity.key != "seconds" && std::isfinite(value)) expected.push_back(value);
    });
    const std::string program = shell_word(rollres_program());
    CHECK(numbers(Json::parse(run_shell(program + " solve --json " + shell_word(files[i])).out)) == expected);
    CHECK(numbers(Json::parse(run_shell("echo '{}' | " + program + " serve " + shell_word(files[i])).out)) == expected);
    if (!from_python.empty()) CHECK(numbers(from_python[i]) == expected);
  }
}
