#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using nlohmann::json;

namespace {

/// Half of an error of second order, and three methods that all answer.
RollingSolution answer(const RollingScene& scene) {
  RollingSolution solution = closed_form(scene);
  solution.rolling_resistance *= 1 + 1e4 * std::pow(scene.spacing.value_or(0), 2);
  solution.law_violation = 0;
  return solution;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("the program holds the paper's scenes as they stand in the examples", "[studies][accuracy]") {
  REQUIRE(paper_scenes().size() == 2);
  for (const PaperScene& paper : paper_scenes()) {
    const std::string name(paper.name);
    CHECK(scene_json(parse_scene(paper.json, name)) ==
          scene_json(read_scene(source_directory().string() + "/studies/examples/" + name + ".json")));
  }
}

TEST_CASE("accuracy writes one row for each scene, method and spacing, and a chart for each scene",
          "[studies][accuracy]") {
  const TemporaryDirectory folder;
  const std::string out = (folder / "a/b").string();
  const ProgramRun run = run_rollres({"accuracy", "--out", out, "--levels", "3", "--repeats", "1"}, answer);
  INFO(run.err);
  CHECK(run.status == 0);
  const std::vector<std::string> csv = lines_of(file_text(out + "/accuracy.csv"));
  const std::size_t methods = 3;         // those on a grid
  constexpr std::size_t tolerances = 9;  // of the spectral method, which solves the cylinder
  REQUIRE(csv.size() == 1 + 2 * methods * 3 + tolerances);
  CHECK(csv.front().starts_with(
      "scene,method,spacing,tolerance,contact_nodes,rolling_resistance,relative_error,seconds,"));
  for (const PaperScene& paper : paper_scenes())
    for (const std::string_view method : {"newton", "newton_dense", "active_set"}) {
      const std::string start = std::string(paper.name) + "," + std::string(method) + ",0.001,,31,";
      CHECK(std::count_if(csv.begin(), csv.end(), [&](const auto& line) { return line.starts_with(start); }) == 1);
    }
  for (const std::string ending : {".svg", ".png", ".gp", ".dat"})
    for (const PaperScene& paper : paper_scenes()) {
      const std::string file = out + "/accuracy_" + std::string(paper.name) + ending;
      CHECK(std::filesystem::file_size(file) > 0);
      CHECK_THAT(run.out, Catch::Contains(file));
    }
}

TEST_CASE("accuracy as JSON is one object, and as Markdown nothing but Markdown", "[studies][accuracy]") {
  const TemporaryDirectory folder;
  const std::string out = (folder / "out").string();
  std::vector<std::string> words{"accuracy",  "paper_sphere", "--out",     out, "--spacings", "1 mm,0.0005",
                                 "--methods", "newton",       "--repeats", "1", "--set",      "load=100 N"};
  words.push_back("--json");
  const json object = json::parse(run_rollres(words, answer).out);
  REQUIRE(object["scenes"].size() == 1);
  const json& scene = object["scenes"][0];
  CHECK(scene["scene"] == "paper_sphere");
  CHECK(scene["reference"]["method"] == "newton");
  REQUIRE(scene["points"].size() == 2);
  CHECK(scene["points"][1]["spacing"] == 0.0005);
  CHECK(object["files"].size() == 5);

  words.back() = "--format=markdown";
  const std::vector<std::string> lines = lines_of(run_rollres(words, answer).out);
  CHECK(lines.at(0) == "### paper_sphere");
  CHECK_THAT(lines.at(3), Catch::StartsWith("|---"));
  for (const std::string& line : lines)
    CHECK((line.empty() || line.starts_with("| ") || line.starts_with("|-") || line.starts_with("- ") ||
           line.starts_with("###")));
}

TEST_CASE("a method that gives no answer is told by the exit status", "[studies][accuracy]") {
  const TemporaryDirectory folder;
  const Evaluate partly = [](const RollingScene& scene) {
    if (scene.method == Method::active_set) throw std::runtime_error("no method for this");
    return answer(scene);
  };
  const ProgramRun run = run_rollres(
      {"accuracy", "paper_cylinder", "--out", (folder / "out").string(), "--levels", "2", "--repeats", "1"}, partly);
  CHECK(run.status == 1);
  CHECK_THAT(run.out, Catch::Contains("active_set at 1 mm: failed: no method for this"));
}

TEST_CASE("wrong words after accuracy end with exit status 2 and one line", "[studies][accuracy]") {
  const TemporaryDirectory folder;
  const std::string out = (folder / "out").string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> commands{
      {{}, "--out"},
      {{"--out", out, "--methods", "newtn"}, "did you mean newton"},
      {{"--out", out, "--spacings", "1 mm", "--levels", "2"}, "excludes"},
      {{"--out", out, "--spacings", "1 s"}, "spacing"},
      {{"--out", out, "--spacings", "1 m"}, "a fifth of the radius"},
      {{"--out", out, "--levels", "0"}, "levels"},
      {{"--out", out, "--repeats", "0"}, "repeats"},
      {{"--out", out, "--seconds-limit", "0"}, "seconds-limit"},
      {{"--out", out, "--format", "html"}, "format"}};
  for (auto [words, message] : commands) {
    words.insert(words.begin(), "accuracy");
    const ProgramRun run = run_rollres(words, answer);
    CAPTURE(words);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK_THAT(run.err, Catch::StartsWith("rollres: ") && Catch::Contains(message));
    CHECK(run.err.find('\n') == run.err.size() - 1);
  }
  CHECK(run_rollres({"accuracy", "/nowhere.json", "--out", out}, answer).status == 3);
}
