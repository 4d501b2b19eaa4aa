#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// The recipes (readme_test) run what these files are for.

using namespace rollres;
using Catch::Matchers::Contains;

TEST_CASE("new writes a scene and a study of each kind, and tells how to go on", "[studies][new]") {
  const TemporaryDirectory folder;
  for (const std::string kind : {"belt", "wheel", "nip", "ball", "lab"}) {
    CAPTURE(kind);
    const auto there = folder / kind;
    const ProgramRun run = run_rollres({"new", kind, there.string()}, closed_form);
    REQUIRE(run.status == 0);
    CHECK_THAT(run.out, Contains("written: " + (there / "scene.json").string()) &&
                            Contains("rollres sweep " + (there / "study.json").string()));
    CHECK_THAT(file_text(there / "scene.json"), Contains("\"comment\""));
    CHECK(run_rollres({"solve", (there / "scene.json").string()}, closed_form).status == 0);
    if (kind != "lab") CHECK(run_rollres({"plan", (there / "study.json").string()}, closed_form).status == 0);
    CHECK((run.out.find("rollres fit ") != std::string::npos) == (kind == "lab"));
  }
}

TEST_CASE("new keeps files that are there, and quotes names that a shell would take apart", "[studies][new]") {
  const TemporaryDirectory folder;
  const auto there = folder / "two words";
  const ProgramRun first = run_rollres({"new", "belt", there.string()}, closed_form);
  CHECK(first.status == 0);
  CHECK_THAT(first.out, Contains("rollres solve '" + (there / "scene.json").string() + "'"));
  std::filesystem::remove(there / "cover.csv");
  folder.write("two words/study.json", "mine");
  const ProgramRun second = run_rollres({"new", "belt", there.string()}, closed_form);
  CHECK(second.status == 2);
  CHECK_THAT(second.err, Contains("is there already, and is kept; name another folder"));
  CHECK(file_text(there / "study.json") == "mine");
  CHECK_FALSE(std::filesystem::exists(there / "cover.csv"));
  CHECK(run_rollres({"new", "train", there.string()}, closed_form).status == 2);
}
