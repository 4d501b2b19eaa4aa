#include "studies/text/file_kind.hpp"

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"
#include "tests/studies/with_variable.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

TEST_CASE("a file given to the wrong command is told what it is and where it belongs", "[studies][text]") {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("scene.json", R"({"indenter": "cylinder"})").string();
  const std::string study = folder.write("study.json", R"({"study": "a", "axes": {}})").string();
  const std::string design = folder.write("design.json", R"({"study": "a", "variables": {}})").string();
  const std::string fit = folder.write("fit.json", R"({"fit": "a"})").string();
  const auto refusal = [](const std::vector<std::string>& words) { return run_rollres(words, closed_form).err; };
  CHECK(refusal({"solve", study}) ==
        "rollres: " + study + ": is a study, not a scene: rollres plan and sweep take it\n");
  CHECK(refusal({"sweep", scene, "--db", "x"}) ==
        "rollres: " + scene + ": is a scene, not a study: rollres solve and gradient take it\n");
  CHECK_THAT(refusal({"sweep", design, "--db", "x"}), Contains("is a design problem, not a study"));
  CHECK_THAT(refusal({"optimise", study, "--db", "x"}), Contains("is a study, not a design problem"));
  CHECK_THAT(refusal({"fit", study, "--db", "x"}), Contains("is a study, not a fit"));
  CHECK_THAT(refusal({"solve", fit}), Contains("rollres fit takes it"));
}

TEST_CASE("words that people try first are understood", "[studies][program]") {
  const auto run = [](const std::vector<std::string>& words) { return run_rollres(words, closed_form); };
  CHECK(run({}).out == run({"--help"}).out);
  CHECK(run({}).status == ExitStatus::answered);
  CHECK(run({"help"}).out == run({"--help"}).out);
  CHECK(run({"help", "solve"}).out == run({"solve", "--help"}).out);
  CHECK(run({"version"}).out == run({"--version"}).out);
  CHECK(run({"sweep", "a.json", "--bd", "x"}).err == "rollres: --bd: unknown option of sweep; did you mean --db?\n");
  CHECK_THAT(run({"slurm", "a.json", "--tasks", "2", "--out", "shards"}).err, Contains("--db is required"));
}
