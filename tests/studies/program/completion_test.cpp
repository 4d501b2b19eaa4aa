#include "studies/program/completion.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>

#include "db/rows/fit_store.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/text/words.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/shell.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers manual_page and command_completion, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

std::string script_of(const std::string& shell) {
  const ProgramRun run = run_rollres({"completion", shell}, closed_form);
  REQUIRE(run.status == 0);
  return run.out;
}

/// What may follow these words, with the kind before it.
std::string offered(std::vector<std::string> words) {
  words.insert(words.begin(), "complete");
  std::string text = run_rollres(words, closed_form).out;
  std::replace(text.begin(), text.end(), '\n', ';');
  return text;
}

}  // namespace

TEST_CASE("commands, options, choices, keys and stored studies are completed", "[studies][completion]") {
  CHECK(offered({"so"}) == "words;solve\tSolve one scene and print its rolling resistance;");
  CHECK_THAT(offered({"--"}), Contains("--help\t") && Contains("--version\t"));
  CHECK_THAT(offered({"solve", "--"}), Contains("--set\t") && Contains("--json\t"));
  CHECK(offered({"solve", "scene.json", "--set", "spe"}) == "open;speed=;");
  CHECK(offered({"solve", "scene.json", "--set", "drive=t"}) == "words;drive=top_force;drive=torque;");
  CHECK(offered({"solve", "--set=drive=t"}) == "words;--set=drive=top_force;--set=drive=torque;");
  CHECK(offered({"query", "--format", "js"}) == "words;json;jsonl;");
  CHECK(offered({"query", "--columns", "speed,viscous"}) == "open;speed,viscous_loss;");
  CHECK(offered({"query", "sta"}) == "open;static_shear_modulus=;static_young_modulus=;status=;");
  CHECK(offered({"schema", "fi"}) == "words;fit;");
  CHECK(offered({"sweep", "absent"}) == "files;");
  CHECK(offered({"figures", "--out", ""}) == "folders;");
  CHECK(offered({"sweep", "--jobs", ""}) == "words;");
  CHECK(offered({"no_command", ""}) == "words;");
  const TemporaryDirectory directory;
  const std::string file = (directory / "results.db").string();
  for (const char* const name : {"belt", "wheel 2"}) ResultStore(file).start_study({name, {}, ""}, {});
  CHECK(offered({"chart", "--db", file, "--study", "w"}) == "words;wheel 2;");
  CHECK(offered({"chart", "--study", "w"}) == "words;");
  std::filesystem::create_directory(directory / "rubber");
  for (const char* const other : {"results.svg", "rolls.json"}) directory.write(other, "{}");
  const std::string begun = directory.path.string() + "/r";
  CHECK(offered({"chart", "--db", begun}) == "open;" + file + ";" + begun + "ubber/;");
  CHECK(offered({"chart", "--db=" + begun + "e"}) == "words;--db=" + file + ";");
  CHECK(offered({"merge", "--db", "all.db", begun + "es"}) == "words;" + file + ";");
  CHECK(offered({"solve", begun + "o"}) == "words;" + begun + "olls.json;");
  CHECK(offered({"solve", begun + "x"}) == "files;");
  FitRecord fit{};
  fit.name = "wool";
  save_fit(open_database(file, Access::write), fit);
  CHECK(offered({"report", "--db", file, "--study", "w"}) == "words;wheel 2;wool;");  // it takes fits, too
  CHECK(offered({"chart", "--db", file, "--study", "w"}) == "words;wheel 2;wool;");
  CHECK(offered({"film", "--db", file, "--study", "w"}) == "words;wheel 2;");
}

TEST_CASE("bash, fish and zsh offer what the program tells them", "[studies][completion][long]") {
  const TemporaryDirectory directory;
  std::filesystem::create_symlink(rollres_program(), directory / "rollres");
  const std::string path = "PATH=" + directory.path.string() + ":$PATH HOME=" + directory.path.string() + " ";
  ResultStore(directory / "results.db").start_study({"wheel 2", {}, ""}, {});
  const std::string file = (directory / "results.db").string();
  const auto bash = [&](const std::string& words) {  // as it cuts the line into words
    directory.write("script", script_of("bash") + "compopt() { :; }\nCOMP_WORDS=(" + words +
                                  ") COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                                  "_rollres\nprintf '%s;' \"${COMPREPLY[@]}\"\n");
    return run_shell(path + "bash " + shell_word((directory / "script").string())).out;
  };
  CHECK(bash("rollres so") == "solve;");
  CHECK(bash("rollres solve scene.json --set spe") == "speed=;");
  CHECK(bash("rollres solve scene.json --set drive = t") == "top_force;torque;");
  CHECK(bash("rollres solve scene.json --set = drive =") == "top_force;torque;free;rotation;");
  CHECK(bash("rollres query --columns speed,viscous") == "speed,viscous_loss;");
  CHECK(bash("rollres chart --db " + file + " --study w") == "wheel\\ 2;");
  CHECK(bash("rollres sweep absent") == ";");  // files, by readline itself
  directory.write("results.svg", "");
  CHECK(bash("rollres chart --db '~/res'") == "~/results.db;");  // as it was typed
  if (installed("fish")) {
    const auto fish = [&](const std::string& line) {
      directory.write("script", script_of("fish") + "complete -C \"" + line + "\" | cut -f 1 | paste -s -d ';'\n");
      return run_shell(path + "fish --no-config " + (directory / "script").string()).out;
    };
    CHECK(fish("rollres so") == "solve\n");
    CHECK_THAT(fish("rollres solve --"), Contains("--json;") && Contains("--set"));
    CHECK(fish("rollres solve scene.json --set spe") == "speed=\n");
    CHECK(fish("rollres solve scene.json --set drive=t") == "drive=top_force;drive=torque\n");
    CHECK(fish("rollres query --columns speed,viscous") == "speed,viscous_loss\n");
    CHECK(fish("rollres chart --db " + file + " --study w") == "wheel 2\n");
    CHECK(fish("rollres chart --db " + directory.path.string() + "/res") == file + "\n");
    CHECK(fish("rollres sweep " + directory.path.string() + "/scr") == directory.path.string() + "/script\n");
  } else {
    WARN("fish is not installed");
  }
  if (installed("zsh")) {
    // In a terminal of its own: what the line becomes when Tab is pressed.
    directory.write("_rollres", script_of("zsh"));
    directory.write("setup", "fpath=(" + directory.path.string() + " $fpath)\n" +
                                 "autoload -U compinit; compinit -u -D; setopt no_beep; print LOADED\n");
    directory.write("script", "zmodload zsh/zpty\nzpty shell zsh -f -i\nzpty -w shell '. " + directory.path.string() +
                                  "/setup'\n"
                                  "zpty -r shell text '*LOADED*'\n"
                                  "zpty -w -n shell $'rollres solve scene.json --set spe\\t'\n"
                                  "zpty -r shell text '*speed=*' && print found\n"
                                  "zpty -w -n shell $'\\x15rollres chart --db " +
                                  directory.path.string() +
                                  "/res\\t'\n"
                                  "zpty -r shell text '*results.db*' && print database\n"
                                  "zpty -d shell\n");
    CHECK_THAT(run_shell(path + "TERM=dumb timeout 60 zsh -f " + (directory / "script").string()).out,
               Contains("found") && Contains("database"));
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
                                            Contains("rollres slurm --tasks N --db FILE") &&
                                            Contains("creep (retardation) time"));
}
