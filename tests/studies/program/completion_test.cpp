#include "studies/program/completion.hpp"

#include <filesystem>
#include <regex>

#include "studies/text/shell_word.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/shell.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

std::string script_of(const std::string& shell) {
  const ProgramRun run = run_rollres({"completion", shell}, closed_form);
  REQUIRE(run.status == 0);
  return run.out;
}

/// What bash offers after these words, as it cuts the line into words itself.
std::string offered_by_bash(const std::string& words) {
  const TemporaryDirectory directory;
  directory.write("script", script_of("bash") +
                                "compopt() { :; }\n"
                                "rollres() { printf 'name\\nbelt\\nwheel 2\\n'; }\n"  // the studies of any database
                                "COMP_WORDS=(" +
                                words +
                                ") COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                                "_rollres\nprintf '%s;' \"${COMPREPLY[@]}\"\n");
  return run_shell("bash " + shell_word((directory / "script").string())).out;
}

}  // namespace

TEST_CASE("bash completes commands, options, choices, keys and stored studies", "[studies][completion]") {
  CHECK(offered_by_bash("rollres so") == "solve;");
  CHECK_THAT(offered_by_bash("rollres solve --"), Contains("--set;") && Contains("--json;"));
  CHECK(offered_by_bash("rollres solve scene.json --set spe") == "speed=;");
  CHECK(offered_by_bash("rollres solve scene.json --set drive = t") == "top_force;torque;");
  CHECK(offered_by_bash("rollres solve scene.json --set = drive =") == "top_force;torque;free;rotation;");
  CHECK(offered_by_bash("rollres query --format js") == "json;jsonl;");
  CHECK(offered_by_bash("rollres query --columns speed,viscous") == "speed,viscous_loss;");
  CHECK(offered_by_bash("rollres query sta") == "static_shear_modulus=;static_young_modulus=;status=;");
  CHECK(offered_by_bash("rollres schema fi") == "fit;");
  CHECK(offered_by_bash("rollres chart --db results.db --study w") == "wheel\\ 2;");
  CHECK(offered_by_bash("rollres sweep stu") == ";");  // files, by readline itself
  CHECK(offered_by_bash("rollres sweep --jobs ''") == ";");
}

TEST_CASE("fish completes the same, and zsh can read what it is given", "[studies][completion]") {
  const TemporaryDirectory directory;
  if (installed("fish")) {
    const auto offered = [&](const std::string& line) {
      directory.write("script", script_of("fish") + "complete -C \"" + line + "\" | cut -f 1 | paste -s -d ';'\n");
      return run_shell("HOME=" + directory.path.string() + " fish --no-config " + (directory / "script").string()).out;
    };
    CHECK(offered("rollres so") == "solve\n");
    CHECK(offered("rollres solve scene.json --set spe") == "speed=\n");
    CHECK(offered("rollres solve scene.json --set drive=t") == "drive=top_force;drive=torque\n");
    CHECK(offered("rollres query --format js") == "json;jsonl\n");
    CHECK(offered("rollres query --columns speed,viscous") == "speed,viscous_loss\n");
    CHECK(offered("rollres schema fi") == "fit\n");
  } else {
    WARN("fish is not installed");
  }
  if (installed("zsh")) {
    const std::string script = directory.write("_rollres", script_of("zsh")).string();
    const ShellRun run = run_shell("zsh -f -n " + script);
    INFO(run.out);
    CHECK(run.status == 0);
  } else {
    WARN("zsh is not installed");
  }
}

TEST_CASE("the manual page names every command and option, and man renders it without a warning",
          "[studies][completion]") {
  const ProgramRun page = run_rollres({"manual"}, closed_form);
  REQUIRE(page.status == 0);
  CHECK_THAT(page.out, Contains(".SS sweep") && Contains("\\fB\\-\\-shard\\fR \\fII/N\\fR") &&
                           Contains("\\fBlayer_thickness\\fR \\fIH\\fR [m]"));
  const std::regex example(R"(studies/examples/[a-z_.]+)");
  for (std::sregex_iterator at(page.out.begin(), page.out.end(), example), end; at != end; ++at) {
    INFO(at->str());
    CHECK(std::filesystem::exists(source_directory() / at->str()));
  }
  if (!installed("man")) {
    WARN("man is not installed");
    return;
  }
  const TemporaryDirectory directory;
  const std::string file = directory.write("rollres.1", page.out).string();
  const ShellRun run = run_shell("LC_ALL=C.UTF-8 MANWIDTH=100 man --warnings -l " + file + " 2>&1 > " + file + ".text");
  CHECK(run.status == 0);
  CHECK(run.out == "");
  CHECK_THAT(file_text(file + ".text"), Contains("rollres - rolling resistance") &&
                                            Contains("rollres sweep --db FILE") &&
                                            Contains("creep (retardation) time"));
}
